/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A fall into a centre that attracts with K/x^2, and a throw at one that repels.
 *
 * What makes it hard: the fall ends at a finite time with infinite speed; in the throw the force is 5e9 times
 * larger for 1e-8 s than ever before.
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

/* Relative to x0 the turning point is 2e-8. A tolerance above it cannot see it: methods of order 2 and below
 * have no part in this one. */
static void the_throw_comes_back_with_its_speed(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    const double x0 = 1, v0 = 10, K = 1e-6, E = v0 * v0 / 2 + K / x0, b = K / E;
    double back = 2 * (sqrt(x0 * (x0 - b)) + b * log((sqrt(x0) + sqrt(x0 - b)) / sqrt(b))) / sqrt(2 * E);
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        if (method.order <= 2) continue;
        struct trial trial = trial_open("hard/singular_approached.yaml", NULL);
        hard_start(&trial, &method, back);
        if (hard_done(&checks, &trial)) {
            /* At the turning point an error of x by tolerance times 1 m is one of tolerance/2e-8 of the
             * energy. */
            double tolerance = i == 0 ? 1e-8 : method.tolerance / b;
            hard_case(&checks, &trial, "throw: speed", fabs(trial_get(&trial, "v") - v0) / v0, tolerance);
            hard_case(&checks, &trial, "throw: place", fabs(trial_get(&trial, "x") - x0), tolerance);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_fall_ends_at_the_centre_and_never_beyond),
        cmocka_unit_test(the_throw_comes_back_with_its_speed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
