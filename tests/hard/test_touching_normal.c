/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A normal force that touches zero, and one that would go below it by 1e-6 of the weight.
 *
 * What makes it hard: a double root of a quantity that ends the run; a rounding must not throw a block off
 * its surface.
 *
 * Reference: N = m g (1 - lift (1 - (t/T - 1)^2)) is zero at t = T (1 - sqrt(1 - 1/lift)).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static void a_touch_loses_nothing(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/touching_normal.yaml", NULL);
        hard_start(&trial, &method, NAN);
        hard_done(&checks, &trial);
        check_that(&checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
        hard_case(&checks, &trial, "touch: place at the end", fabs(trial_get(&trial, "x") - 5), 1e-13);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void a_millionth_more_loses_contact(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    const double T = 2, lift = 1 + 1e-6;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/touching_normal.yaml", SET("lift=1+1e-6"));
        hard_start(&trial, &method, NAN);
        check_that(&checks, "the run is broken", hard_finish(&trial) == FBD_BROKEN);
        /* Contact counts as lost at 1e-13 of the weight below zero; N falls by 1e-3 of the weight in a second
         * there. */
        hard_case(&checks, &trial, "lift 1e-6: time of the loss",
                  fabs(trial_event(&trial, FBD_EVENT_CONTACT_LOST, NULL, 0) - T * (1 - sqrt(1 - 1 / lift))),
                  1.2e-10);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_touch_loses_nothing),
        cmocka_unit_test(a_millionth_more_loses_contact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
