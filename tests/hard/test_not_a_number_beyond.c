/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A force whose formula is not a number beyond x = 1 m.
 *
 * What makes it hard: the formula is smooth to its end, nothing announces it, and GSL's methods take NaN for
 * success.
 *
 * Reference: with z = 1 - x, z'' = -z, z(0) = 1, z'(0) = -1: z = sqrt(2) cos(t + pi/4), zero at t = pi/4 with
 * v = sqrt(2).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

#include <string.h>

static const double pi = 3.14159265358979323846;

static void the_run_ends_where_the_formula_does(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/not_a_number_beyond.yaml", NULL);
        hard_start(&trial, &method, NAN);
        check_that(&checks, "the run fails", hard_finish(&trial) == FBD_FAILED);
        const char *reason = fbd_simulation_reason(trial.simulation);
        check_that(&checks, "the reason names the body", strstr(reason, "`block` is not finite") != NULL);
        check_that(&checks, "the reason names the time", strstr(reason, "t = 0.785") != NULL);
        double x = trial_get(&trial, "x");
        check_that(&checks, "the last state is good", x <= 1 && isfinite(trial_get(&trial, "v")));
        /* A step ends where an attempt a rounding longer fails; before that the methods' own error. */
        hard_case(&checks, &trial, "time of the last state", fabs(trial_get(&trial, "t") - pi / 4),
                  fmax(1e-10, hard_promise(&trial)));
        hard_case(&checks, &trial, "speed there", fabs(trial_get(&trial, "v") - sqrt(2)),
                  fmax(1e-10, 2 * hard_promise(&trial)));
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_run_ends_where_the_formula_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
