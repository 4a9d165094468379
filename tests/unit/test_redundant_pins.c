/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A pin at the pivot of a body says nothing new, and a pin at a point of a free body makes it a pivot: three forms of one
 * pendulum have one motion. The pins may be at the centre of mass, beside the pivot by a rounding, or far from the origin:
 * none of that may weaken the error control. FBD_DRAWS: times as many.
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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(forms_of_a_pendulum_move_alike)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
