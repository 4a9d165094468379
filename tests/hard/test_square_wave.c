/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A thousand periods of a square-wave force.
 *
 * What makes it hard: 2000 jumps at times that are not exact in binary; a method is exact between them, so
 * what is seen is how well they are placed. (Case D07 itself, ten seconds with pulses and with friction, is
 * in tests/unit.)
 *
 * Reference: after n periods of T = 0.7 s from rest v = 0 and x = n F T^2/(4 m) = 0.6125 m n.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static void a_thousand_periods(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/square_wave.yaml", NULL);
        hard_start(&trial, &method, NAN);
        if (hard_done(&checks, &trial)) {
            check_that(&checks, "2000 jumps", hard_count(&trial, FBD_EVENT_SWITCH) == 2000);
            /* A jump of 10 m/s^2 is placed to two roundings of t, 2.3e-13 s at 700 s, which are 2.3e-12 m/s;
             * of 2000 such errors of random sign sqrt(2000) remain, 1e-10 m/s, for half of 700 s in x. The
             * size of the motion is 1.75 m/s. Methods of first order have errors of their own in a parabola.
             */
            double own =
                method.order == 1 || method.order == 12 || method.order == 5 ? hard_promise(&trial) : 0;
            hard_case(&checks, &trial, "1000 periods: velocity", fabs(trial_get(&trial, "v")),
                      fmax(1e-10, 1.75 * own));
            hard_case(&checks, &trial, "1000 periods: place", fabs(trial_get(&trial, "x") - 612.5),
                      fmax(4e-8, 612.5 * own));
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_thousand_periods),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
