/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Switches at one instant with what holds a body or drives it: closed forms.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

static void run_to_its_end(struct trial *trial)
{
    trial_start(trial, NULL);
    trial_finish(trial);
    if (fbd_simulation_reason(trial->simulation)[0])
        print_message("# %s\n", fbd_simulation_reason(trial->simulation));
}

/* A belt, or a rope that is let out down a slope, which is a faster belt, takes a body along with V(t) = V_0 + V_1 sin(w t)
 * to where x - c + T v is zero. The force of the switch is then too much for friction, or for what makes the rope taut: the
 * body falls behind, and stays on the switch, v = V(t_0) exp(-(t - t_0)/T). The instant is a double, where u may be further
 * from zero than its own rounding. */

struct carried {
    double m, V0, V1, w, T, t0, c, end;
};

static double carrying_speed(const struct carried *carried, double t)
{
    return carried->V0 + carried->V1 * sin(carried->w * t);
}

static double carried_to(const struct carried *carried, double t)
{
    return carried->V0 * t + carried->V1 / carried->w * (1 - cos(carried->w * t));
}

/* False where the switch is not passed for the first time at t_0, or where the body is caught up with before the end. */
static bool finish_carried(struct carried *carried)
{
    const int points = 200;
    bool fits = true;
    carried->c = carried->T * carrying_speed(carried, carried->t0); /* where x is 0 */
    carried->end = carried->t0 + 0.3 * carried->T;
    for (int i = 0; i <= points; i++) {
        double t = carried->t0 * i / points, V = carrying_speed(carried, t);
        double later = carried->t0 + (i + 1) * (carried->end - carried->t0) / points;
        fits &= V + carried->T * carried->V1 * carried->w * cos(carried->w * t) > 0;
        fits &= carrying_speed(carried, later) >
                carrying_speed(carried, carried->t0) * exp((carried->t0 - later) / carried->T);
    }
    return fits;
}

static bool draw_carried(struct random_numbers *numbers, bool rope, char *text, size_t size,
                         struct carried *carried)
{
    const double g = 10, mu = random_between(numbers, 0.1, 0.5), gives = rope ? g : mu * g;
    *carried = (struct carried){.m = random_between(numbers, 0.5, 2),
                                .V0 = random_between(numbers, 0.1, 0.4),
                                .w = random_between(numbers, 2, 10),
                                .t0 = random_between(numbers, 2, 20)};
    carried->V1 = random_between(numbers, 0, 1) * fmin(0.5 * carried->V0, 0.3 * gives / carried->w);
    const double most = carried->V0 + carried->V1;
    carried->T = most / (0.7 * gives) * random_between(numbers, 1, 8);
    const bool fits = finish_carried(carried);
    const double from = -carried_to(carried, carried->t0);
    const double F =
        carried->m * (rope ? g + mu * g + most / carried->T : gives) * random_between(numbers, 1.2, 2.5);
    const double push = -F + random_between(numbers, -0.6, 0.6) * carried->m * gives;
    char way[300], joined[400] = "";
    if (rope) {
        snprintf(way, sizeof way, "[gravity, normal, friction: {coefficient: %.17g, surface_speed: 1}", mu);
        snprintf(joined, sizeof joined,
                 "ground: {points: {P: [-10, 17.320508075688775]}}\ncouplings:\n  - rope: {through: "
                 "[ground.P, b.G], "
                 "length: \"%.17g[m] + %.17g[m/s]*t + %.17g[m]*(1 - cos(%.17g[1/s]*t))\"}\n",
                 20 + from, carried->V0, carried->V1 / carried->w, carried->w);
    } else {
        snprintf(way, sizeof way,
                 "[gravity, normal, friction: {coefficient: %.17g, surface_speed: "
                 "\"%.17g[m/s] + %.17g[m/s]*sin(%.17g[1/s]*t)\"}, applied: \"%.17g[N]\"",
                 mu, carried->V0, carried->V1, carried->w, push);
    }
    snprintf(
        text, size,
        "fbd: 1\ngravity: 10\nbodies:\n  b:\n    mass: %.17g\n    motion: {slide: {along: %s, through: [0, "
        "0]}}\n    initial: {x: %.17g, v: %.17g}\n    forces: %s, applied: "
        "\"-%.17g[N]*sign(x - %.17g[m] + %.17g[s]*v)\"]\n%ssimulate: {until: %.17g}\n",
        carried->m, rope ? "-60 deg" : "0", from, carried->V0, way, F, carried->c, carried->T, joined,
        carried->end);
    return fits;
}

static void what_carries_onto_a_switch_lets_go_there(void **unused)
{
    struct checks checks = {0};
    struct random_numbers numbers = {1543};
    (void)unused;
    for (int i = 0; i < draws_of(400); i++) {
        char text[1600];
        struct carried carried;
        if (!draw_carried(&numbers, i % 2, text, sizeof text, &carried)) continue;
        double v = carrying_speed(&carried, carried.t0) * exp((carried.t0 - carried.end) / carried.T);
        struct trial trial = trial_parse(text);
        run_to_its_end(&trial);
        check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
        check_close(&checks, "it decays", trial_get(&trial, "b.v"), v, 1e-9);
        check_close(&checks, "on the switch", trial_get(&trial, "b.x"), carried.c - carried.T * v, 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_carries_onto_a_switch_lets_go_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
