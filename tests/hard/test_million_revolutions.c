/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A wheel under a periodic moment over a million revolutions (10 000 for methods of order 3 and less, and
 * under a sanitizer).
 *
 * What makes it hard: theta grows to 6e6 rad beside a ripple of 5 mrad; an error control relative to theta
 * would forget it.
 *
 * Reference: I omega' = M cos(w t): omega = omega0 + M/(I w) sin(w t), theta = omega0 t + M/(I w^2) (1 -
 * cos(w t)).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double omega0 = 1000, M = 2, I = 1, w = 20;

static void the_angle_stays_accurate(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        double until = method.order >= 4 && thorough() ? 6283.2 : 62.832;
        struct trial trial = trial_open("hard/million_revolutions.yaml", NULL);
        hard_start(&trial, &method, until);
        if (hard_done(&checks, &trial)) {
            double theta = omega0 * until + M / (I * w * w) * (1 - cos(w * until));
            double omega = omega0 + M / (I * w) * sin(w * until);
            double steps = (double)fbd_simulation_stats(trial.simulation).steps;
            /* theta itself is known to half a rounding of 6e6 rad in each step. An error of a step by the
             * tolerance times a radian is also one of omega by the tolerance times w, which acts on average
             * half of the time; over a period of the moment these errors cancel but for one in ten. The
             * default is held to 3e-10 of the angle, its own relative tolerance three times. */
            double rounding = 1.1e-16 * theta * steps, promise = hard_promise(&trial);
            hard_case(&checks, &trial, "angle [rad]", fabs(trial_get(&trial, "theta") - theta),
                      i == 0 ? 3e-10 * theta : rounding + promise * (1 + w * until / 20));
            hard_case(&checks, &trial, "speed, relative", fabs(trial_get(&trial, "omega") - omega) / omega0,
                      promise);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_angle_stays_accurate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
