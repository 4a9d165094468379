/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A fall into a centre that attracts with K/x^2, and a throw at one that repels.
 *
 * What makes it hard: the fall ends at a finite time with infinite speed; in the throw the force is 5e9 times
 * larger for 1e-8 s than ever before, and between the stages of a long step there is no sign of it.
 *
 * Reference. Fall from rest at x0: t = pi/2 sqrt(m x0^3/(2 K)); energy v^2/2 - K/x = -K/x0. Throw: with E =
 * v^2/2 + K/x and b = K/E the turning point, the time to it is (sqrt(x0 (x0 - b)) + b ln((sqrt(x0) + sqrt(x0
 * - b))/sqrt(b)))/sqrt(2 E), and after twice that time it is at x0 again with the opposite velocity.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

#include <float.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static void the_fall_ends_at_the_centre_and_never_beyond(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/singular_reached.yaml", NULL);
        hard_start(&trial, &method, NAN);
        check_that(&checks, "the run fails", hard_finish(&trial) == FBD_FAILED);
        check_that(&checks, "the reason names the body",
                   strstr(fbd_simulation_reason(trial.simulation), "`body`"));
        double x = trial_get(&trial, "x"), v = trial_get(&trial, "v");
        check_that(&checks, "it is not beyond", x > 0);
        hard_case(&checks, &trial, "fall: time of the last state", fabs(trial_get(&trial, "t") - pi / 4),
                  fmax(hard_promise(&trial), 1e-10));
        hard_case(&checks, &trial, "fall: distance left", x, 1e-8);
        /* Energy relative to the kinetic energy at the end. */
        if (method.order > 2)
            hard_case(&checks, &trial, "fall: energy", fabs(v * v / 2 - 2 / x + 2) / (2 / x),
                      100 * hard_promise(&trial));
        trial_close(&trial);
    }
    checks_end(&checks);
}

static const double x0 = 1, v0 = 10, K = 1e-6;

/* The time when it is back. */
static double return_time(void)
{
    double E = v0 * v0 / 2 + K / x0, b = K / E;
    return 2 * (sqrt(x0 * (x0 - b)) + b * log((sqrt(x0) + sqrt(x0 - b)) / sqrt(b))) / sqrt(2 * E);
}

/* Relative to x0 the turning point is 2e-8, and the force is below every tolerance until the body is as near
 * as that: nothing but its divisor tells of it. Speed errs in each step by the tolerance at most. That all of
 * them do so near the turning point, where energy is potential for some steps, may double it. */
static void check_throw(struct checks *checks, const struct hard_method *method)
{
    struct trial trial = trial_open("hard/singular_approached.yaml", NULL);
    hard_start(&trial, method, return_time());
    if (hard_done(checks, &trial)) {
        double tolerance = fmax(2 * hard_promise(&trial), 2 * DBL_EPSILON * x0 / (2 * K / (v0 * v0)));
        hard_case(checks, &trial, "throw: speed", fabs(trial_get(&trial, "v") - v0) / v0, tolerance);
        hard_case(checks, &trial, "throw: place", fabs(trial_get(&trial, "x") - x0), tolerance);
    }
    trial_close(&trial);
}

static void the_throw_comes_back_with_its_speed(void **unused)
{
    (void)unused;
    hard_each_tolerance(check_throw);
}

/* With K so small that it would turn at 2e-20 m, numbers cannot tell where it turns, and passing through
 * would be wrong. */
static void a_needle_finer_than_numbers_is_refused(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/singular_approached.yaml", SET("K=1e-18"));
        hard_start(&trial, &method, NAN);
        check_that(&checks, "the run fails", hard_finish(&trial) == FBD_FAILED);
        hard_case(&checks, &trial, "needle: time", fabs(trial_get(&trial, "t") - 0.1),
                  fmax(hard_promise(&trial), 1e-12));
        check_that(&checks, "it is not beyond", trial_get(&trial, "x") > 0);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_fall_ends_at_the_centre_and_never_beyond),
        cmocka_unit_test(the_throw_comes_back_with_its_speed),
        cmocka_unit_test(a_needle_finer_than_numbers_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
