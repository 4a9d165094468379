/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A pendulum released 1e-6 rad from the upright (models/rotation/near_upright.yaml, case D03).
 *
 * What makes it hard: whatever error is made at the start has grown 8e6 times when the pendulum hangs. An
 * error that is measured against a radian, and not against the 1e-6 rad that there are, decides on which side
 * it falls.
 *
 * Reference: t = K(cos(theta0/2)) sqrt(L/g) to the bottom, with K by the arithmetic-geometric mean; the same
 * to the other side; omega^2 = 2 g/L (1 + cos(theta0)).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double pi = 3.14159265358979323846, g = 9.81, theta0 = 1e-6;

/* K(k) with k' = sin(theta0/2) given, which 1 - k^2 would lose. */
static double quarter_period(void)
{
    double a = 1, b = sin(theta0 / 2);
    for (int i = 0; i < 10; i++) {
        double mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
    }
    return pi / (2 * a) / sqrt(g);
}

static void it_falls_in_time(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    double bottom = quarter_period(), omega = sqrt(2 * g * (1 + cos(theta0)));
    check_close(&checks, "D03.t_bottom", bottom, 5.07486764112373, 1e-14);
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("rotation/near_upright.yaml", NULL);
        hard_start(&trial, &method, NAN);
        double t = trial_to_event(&trial, FBD_EVENT_USER, "bottom", 0);
        double v = isnan(t) ? NAN : trial_get(&trial, "omega");
        /* In the first 4.5 s an error counts relative to theta itself, which grows as exp(w t): the promise
         * of relative errors moves the fall by it over w = 3.1/s. Later errors count relative to a radian.
         * The rounding of theta0 adds nothing. */
        hard_case(&checks, &trial, "time to the bottom", fabs(t - bottom),
                  i == 0 ? 1e-9 : hard_promise(&trial));
        hard_case(&checks, &trial, "speed at the bottom", fabs(v - omega) / omega,
                  i == 0 ? 1e-9 : hard_promise(&trial));
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_falls_in_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
