/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Starts at rest where couplings have no slope. A particle on two rods in one line, loaded across it, cannot
 * move, as both rods would have to become longer to the second order, and no finite force along the line
 * balances the load. On two rods of one length from one side it is a pendulum, and a bar on three parallel
 * rods swings: what is redundant there is so all the way.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gallery.h"
#include "random_numbers.h"

enum { scenes = 200 };

static const double g = 9.81;

/* A particle at (x, y) on rods to places on a line through it at an angle, at `ends` (with their signs). */
static struct trial on_a_line(double x, double y, double angle, const double ends[2], double load)
{
    char text[800];
    double c = cos(angle), s = sin(angle);
    snprintf(
        text, sizeof text,
        "fbd: 1\ngravity: 0\nground: {points: {A: [%.17g, %.17g], B: [%.17g, %.17g]}}\nbodies:\n"
        "  p: {mass: 1, motion: particle, initial: {x: %.17g, y: %.17g}, forces: [applied: {value: 3, angle: "
        "%.17g rad}]}\n"
        "couplings: [rod: {between: [p, ground.A]}, rod: {between: [p, ground.B]}]\nsimulate: {until: 0.1}\n",
        x + ends[0] * c, y + ends[0] * s, x + ends[1] * c, y + ends[1] * s, x, y, load);
    return trial_parse(text);
}

/* Refused, by name; or done, having moved by so much. */
static void check_start(struct checks *checks, struct trial *trial, bool refused, double x, double y,
                        double way)
{
    trial_start(trial, NULL);
    if (!refused) trial_finish(trial);
    if (refused) {
        const fbd_recording motion = {.motion_only = true};
        trial->result = fbd_simulation_run(trial->simulation, &motion);
        trial->outcome = fbd_result_outcome(trial->result);
        const char *reason = fbd_simulation_reason(trial->simulation);
        check_that(checks, "it is refused",
                   trial->outcome == FBD_FAILED && strstr(reason, "singular position"));
    } else {
        check_that(checks, "it runs", trial->outcome == FBD_DONE);
        check_close(checks, "way", hypot(trial_get(trial, "p.x") - x, trial_get(trial, "p.y") - y), way,
                    1e-3 * way + 1e-12);
    }
    trial_close(trial);
}

static void between_rods_in_line_nothing_moves_across(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {1};
    for (int i = 0; i < scenes; i++) {
        double angle = random_between(&numbers, -3, 3), x = random_between(&numbers, -5, 5),
               y = random_between(&numbers, -5, 5), across = random_between(&numbers, 0.2, 2.9);
        double near = exp(random_between(&numbers, -3, 1.6)), far = near * random_between(&numbers, 1.3, 4);
        const double both[] = {-near, far}, one[] = {near, far};
        struct trial trial =
            on_a_line(x, y, angle, i % 2 ? both : one, angle + (i % 4 < 2 ? across : -across));
        check_start(&checks, &trial, true, x, y, 0);
        trial = on_a_line(x, y, angle, both, angle); /* along it rests */
        check_start(&checks, &trial, false, x, y, 0);
    }
    checks_end(&checks);
}

/* From rest, for 0.1 s of a swing of a second or more: a t^2/2 but for the share of (t/T)^2. */
static void what_is_redundant_all_the_way_moves(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {2};
    for (int i = 0; i < scenes; i++) {
        double angle = random_between(&numbers, -3, 3), length = random_between(&numbers, 200, 500);
        const double same[] = {length, length};
        struct trial trial = on_a_line(1, 2, angle, same, angle + 1.5707963267948966);
        check_start(&checks, &trial, false, 1, 2, 3 * 0.1 * 0.1 / 2);
    }
    checks_end(&checks);
}

/* Three parallel rods of one length l at an angle phi to the vertical: a bar that swings as a pendulum does.
 */
static void a_bar_on_three_rods_swings(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {3};
    for (int i = 0; i < scenes; i++) {
        double l = random_between(&numbers, 0.5, 2), phi = random_between(&numbers, 0.1, 1.4);
        double sx = l * sin(phi), sy = -l * cos(phi);
        char text[900];
        snprintf(text, sizeof text,
                 "fbd: 1\ngravity: %.17g\nground: {points: {A: [-1, 0], B: [0, 0], C: [1, 0]}}\nbodies:\n"
                 "  p: {mass: 1, shape: rod, length: 2, points: {l: [-1, 0], m: [0, 0], r: [1, 0]}, motion: "
                 "planar, "
                 "initial: {x: %.17g, y: %.17g}, forces: [gravity]}\n"
                 "couplings: [rod: {between: [p.l, ground.A]}, rod: {between: [p.m, ground.B]}, rod: "
                 "{between: [p.r, "
                 "ground.C]}]\nsimulate: {until: 0.1}\n",
                 g, sx, sy);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, "it runs", trial.outcome == FBD_DONE);
        double v = hypot(trial_get(&trial, "p.vx"), trial_get(&trial, "p.vy"));
        check_close(&checks, "energy", v * v / 2 + g * trial_get(&trial, "p.y"), g * sy, 1e-8 * g * l);
        check_that(&checks, "it moved", v > 0.05);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(between_rods_in_line_nothing_moves_across),
        cmocka_unit_test(what_is_redundant_all_the_way_moves),
        cmocka_unit_test(a_bar_on_three_rods_swings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
