/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Normal forces that are zero: for an instant, where a body leaves its surface, and all the time, where the forces on
 * it are along its line and what a computer finds across is their rounding.
 *
 * FBD_SCENES=N runs N of each (default 100), FBD_SEED=S others.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { text_room = 2000 };

static const char *const methods[] = {"auto", "dop853", "rodas5p", "rkf45", "msadams", "msbdf"};

static int wanted(void)
{
    const char *number = getenv("FBD_SCENES");
    return number ? (int)strtol(number, NULL, 10) : thorough() ? 100 : 10;
}

static struct random_numbers seeded(uint64_t offset)
{
    const char *seed = getenv("FBD_SEED");
    return (struct random_numbers){offset + 1000 * (seed ? (uint64_t)strtol(seed, NULL, 10) : 1)};
}

/* Without gravity a damper to a fixed point presses a body on its line until that passes the foot of the point, where
 * the damper does not change its length, and would pull from there on. */
static void a_damper_lets_go_at_its_foot(void **unused)
{
    struct random_numbers numbers = seeded(1);
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int trial = 0; trial < wanted(); trial++) {
        double along = random_between(&numbers, -3, 3), foot = random_between(&numbers, 0.5, 2),
               off = random_between(&numbers, 0.3, 4);
        double c = random_between(&numbers, 0.1, 2), v = random_between(&numbers, 3, 5),
               tolerance = pow(10, random_between(&numbers, -13, -6));
        bool left = random_bits(&numbers) % 2;
        /* Ahead of its foot the damper is being shortened, and pushes away from its point: on to the line, if that is
         * on the other side of the point. */
        double across = left ? off : -off;
        double x = foot * cos(along) - across * sin(along), y = foot * sin(along) + across * cos(along);
        snprintf(text, sizeof text,
                 "fbd: 1\ngravity: [0, 0]\nbodies:\n  b:\n    mass: %.17g\n    motion: {slide: {along: "
                 "%.17g}}\n    initial: {v: "
                 "%.17g}\n    forces: [normal: {side: %s}, damper: {coefficient: %.17g, to: [%.17g, "
                 "%.17g]}]\nsimulate: "
                 "{until: 5, method: %s, tolerance: %.3g}\n",
                 random_between(&numbers, 1, 4), along, v, left ? "left" : "right", c, x, y,
                 methods[trial % 6], tolerance);
        struct trial run = trial_parse(text);
        trial_start(&run, NULL);
        while ((run.outcome = fbd_simulation_advance(run.simulation)) == FBD_GOING) continue;
        double from, to, at = (double)NAN;
        fbd_simulation_interval(run.simulation, &from, &to);
        fbd_simulation_state(run.simulation, to, run.state);
        at = trial_get(&run, "b.x");
        const char *why = fbd_simulation_reason(run.simulation);
        bool fine_0 = check_that(&checks, "it ends by name",
                                 run.outcome == FBD_BROKEN && strstr(why, "leaves its surface"));
        bool fine_1 = check_close(&checks, "at the foot", at, foot, 1e-9);
        bool fine = fine_0 && fine_1;
        if (!fine) print_message("trial %d: %s\n%s", trial, why, text);
        trial_close(&run);
    }
    checks_end(&checks);
}

/* Along a line in any direction act a potential and a rack, a wheel or nothing more: no force is across, so friction has none to
 * work with, whatever its coefficient. */
static void friction_without_a_force_is_none(void **unused)
{
    struct random_numbers numbers = seeded(2);
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int trial = 0; trial < wanted(); trial++) {
        double along = random_between(&numbers, -3, 3),
               mu = random_bits(&numbers) % 3 ? random_between(&numbers, 0, 1) : 0;
        double r = random_between(&numbers, 0.1, 0.5), start = random_between(&numbers, -1, 1), end[2][2];
        double k = random_between(&numbers, 1, 20), m = random_between(&numbers, 0.5, 3),
               v = random_between(&numbers, -1, 1);
        double surface = random_between(&numbers, -1, 1), push = random_between(&numbers, -5, 5);
        bool two_sided = random_bits(&numbers) % 2;
        char other[600] = "", coupling[200] = "";
        if (trial % 3 == 1) {
            /* A pinion whose axis is r off the line. */
            snprintf(other, sizeof other,
                     "  w: {mass: 1, shape: disc, radius: %.17g, motion: {pivot: {at: [%.17g, %.17g]}}, "
                     "initial: {omega: %.17g}}\n",
                     r, -r * sin(along), r * cos(along), v / r);
            snprintf(coupling, sizeof coupling, "couplings: [rack: {between: [w, b]}]\n");
        }
        for (int rubs = 0; rubs < 2; rubs++) {
            char friction[200] = "";
            if (rubs)
                snprintf(friction, sizeof friction,
                         ", friction: {static: %.17g, kinetic: %.17g, surface_speed: %.17g}", mu, mu,
                         surface);
            snprintf(text, sizeof text,
                     "fbd: 1\ngravity: [0, 0]\nbodies:\n  b:\n    mass: %.17g\n    motion: {slide: {along: "
                     "%.17g}}\n    initial: "
                     "{x: %.17g, v: %.17g}\n    forces: [normal: {two_sided: %s}, potential: "
                     "\"%.17g[N/m]*x^2\", applied: "
                     "%.17g%s]\n%s%ssimulate: {until: 2}\n",
                     m, along, start, v, two_sided ? "true" : "false", k, push, friction, other, coupling);
            struct trial run = trial_parse(text);
            trial_start(&run, NULL);
            trial_finish(&run);
            end[rubs][0] = trial_get(&run, "b.x");
            end[rubs][1] = trial_get(&run, "b.v");
            fbd_stats stats = fbd_simulation_stats(run.simulation);
            bool quick = check_that(&checks, "no more steps than friction takes", stats.steps < 400);
            if (!quick) print_message("trial %d: %zu steps\n%s", trial, stats.steps, text);
            trial_close(&run);
        }
        bool fine_0 = check_close(&checks, "x", end[1][0], end[0][0], 1e-8);
        bool fine_1 = check_close(&checks, "v", end[1][1], end[0][1], 1e-8);
        bool fine = fine_0 && fine_1;
        if (!fine) print_message("trial %d:\n%s", trial, text);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_damper_lets_go_at_its_foot),
        cmocka_unit_test(friction_without_a_force_is_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
