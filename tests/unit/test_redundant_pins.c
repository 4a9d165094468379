/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A pin at the pivot of a body says nothing new, and a pin at a point of a free body makes it a pivot: three forms of one
 * pendulum have one motion. The pins may be at the centre of mass, beside the pivot by a rounding, or far from the origin:
 * none of that may weaken the error control. Nor may a slot or a floor on which a bead has no arm. FBD_DRAWS: times as many.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "random_numbers.h"
#include "run_checks.h"
#include "thorough.h"

struct pendulum {
    double px, py, x, y, theta, omega, stiffness, depth;
};

static struct pendulum draw_pendulum(struct random_numbers *numbers)
{
    const double far = random_bits(numbers) % 4 ? 2 : 1000;
    const bool centre = random_bits(numbers) % 4 == 0;
    return (struct pendulum){.px = centre ? 0 : random_between(numbers, -0.4, 0.4),
                             .py = centre ? 0 : random_between(numbers, -0.4, 0.4),
                             .x = random_between(numbers, -far, far),
                             .y = random_between(numbers, -far, far),
                             .theta = random_between(numbers, -3, 3),
                             .omega = random_between(numbers, -4, 4),
                             .stiffness = random_between(numbers, 1, 30),
                             .depth = random_between(numbers, -5, 5)};
}

enum form { pivot, pivot_and_pin, free_and_pin, forms };

static void write_scene(const struct pendulum *p, enum form form, char *text)
{
    const double Gx = p->x - (cos(p->theta) * p->px - sin(p->theta) * p->py),
                 Gy = p->y - (sin(p->theta) * p->px + cos(p->theta) * p->py);
    char motion[300];
    if (form == free_and_pin)
        snprintf(motion, sizeof motion,
                 "    motion: planar\n    initial: {x: %.17g, y: %.17g, theta: %.17g, vx: %.17g, vy: %.17g, "
                 "omega: %.17g}\n",
                 Gx, Gy, p->theta, -p->omega * (Gy - p->y), p->omega * (Gx - p->x), p->omega);
    else
        snprintf(motion, sizeof motion,
                 "    motion: {pivot: {at: Q, point: P}}\n    initial: {theta: %.17g, omega: %.17g}\n",
                 p->theta, p->omega);
    snprintf(
        text, text_room,
        "fbd: 1\nground: {points: {Q: [%.17g, %.17g], R: [%.17g, %.17g]}}\nbodies:\n  disc:\n    shape: "
        "disk\n    mass: 2 kg\n"
        "    radius: 0.5 m\n    points: {P: [%.17g, %.17g], A: [0.2, 0.3]}\n%s    forces:\n      - gravity\n"
        "      - spring: {name: spring, stiffness: %.17g, at: A, to: [%.17g, %.17g], free_length: 0.1}\n"
        "    moments: [{potential: {name: well, V: \"%.17g[J]*atan(theta)\"}}]\n%ssimulate: {until: 1.5}\n",
        p->x, p->y, nextafter(p->x, HUGE_VAL), nextafter(p->y, HUGE_VAL), p->px, p->py, motion, p->stiffness,
        p->x - 1.5, p->y + 0.5, p->depth,
        form == pivot ? "" : "couplings: [{pin: {name: bolt, between: [disc.P, ground.R]}}]\n");
}

static void forms_of_a_pendulum_move_alike(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {.state = 1};
    const char *const names[] = {"pivot", "pivot and pin", "pin"};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = 1e-9;
    for (int draw = 0; draw < draws_of(20); draw++) {
        const struct pendulum pendulum = draw_pendulum(&numbers);
        double omega[forms];
        for (enum form form = pivot; form < forms; form++) {
            char text[text_room];
            write_scene(&pendulum, form, text);
            struct trial trial = trial_parse(text);
            trial_run(&trial, &options);
            omega[form] = get(&trial, "disc.omega");
            trial_close(&trial);
            const double size = 1 + fabs(pendulum.omega) + sqrt(pendulum.stiffness);
            check_close(&checks, names[form], (omega[form] - omega[pivot]) / size, 0, 1e-6);
        }
    }
    checks_end(&checks);
}

/* ---- beads: the force of a slot or a floor has no arm on them */

enum bead { on_slide, particle_in_slot, disc_in_slot, particle_on_floor, beads };

/* A bead on a line through `far` times its direction, with a spring and a force that pulls it onto the line. */
static void write_bead(const struct pendulum *p, enum bead bead, char *text)
{
    const double along = p->theta / 3, c = cos(along), s = sin(along), far = p->x;
    char motion[300], coupling[300] = "";
    if (bead == on_slide)
        snprintf(motion, sizeof motion, "motion: {slide: {along: %.17g}}, initial: {v: %.17g}", along,
                 p->omega);
    else
        snprintf(motion, sizeof motion, "motion: %s, initial: {x: 0, y: 0, vx: %.17g, vy: %.17g}%s",
                 bead == disc_in_slot ? "planar" : "particle", p->omega * c, p->omega * s,
                 bead == disc_in_slot ? ", shape: disk, radius: 0.1" : "");
    if (bead == particle_on_floor)
        snprintf(coupling, sizeof coupling, "contacts: [{name: floor, between: [bead, ground.line]}]\n");
    else if (bead != on_slide)
        snprintf(coupling, sizeof coupling,
                 "couplings: [{slot: {name: slot, between: [bead.G, ground.F], along: %.17g}}]\n", along);
    snprintf(text, text_room,
             "fbd: 1\nground:\n  points: {F: [%.17g, %.17g]}\n  lines: {line: {through: [%.17g, %.17g], "
             "along: %.17g}}\n"
             "bodies:\n  bead:\n    {mass: 2, %s, forces: [{spring: {name: s, stiffness: %.17g, to: [%.17g, "
             "%.17g], "
             "free_length: 0.1}},\n     {applied: {name: press, value: [%.17g, %.17g]}}]}\n%ssimulate: "
             "{until: 1.5}\n",
             far * c, far * s, far * c, far * s, along, motion, p->stiffness, 0.7 * c + 0.2 * s,
             0.7 * s - 0.2 * c, 200 * s, -200 * c, coupling);
}

static void beads_on_a_line_move_alike(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {.state = 2};
    const char *const names[] = {"slide", "particle in a slot", "disc in a slot", "particle on a floor"};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = 1e-9;
    for (int draw = 0; draw < draws_of(20); draw++) {
        const struct pendulum pendulum = draw_pendulum(&numbers);
        const double c = cos(pendulum.theta / 3), s = sin(pendulum.theta / 3);
        double speed[beads];
        for (enum bead bead = on_slide; bead < beads; bead++) {
            char text[text_room];
            write_bead(&pendulum, bead, text);
            struct trial trial = trial_parse(text);
            trial_run(&trial, &options);
            speed[bead] = bead == on_slide ? get(&trial, "bead.v")
                                           : get(&trial, "bead.vx") * c + get(&trial, "bead.vy") * s;
            trial_close(&trial);
            const double size = 1 + fabs(pendulum.omega) + sqrt(pendulum.stiffness);
            check_close(&checks, names[bead], (speed[bead] - speed[on_slide]) / size, 0, 1e-6);
        }
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forms_of_a_pendulum_move_alike),
        cmocka_unit_test(beads_on_a_line_move_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
