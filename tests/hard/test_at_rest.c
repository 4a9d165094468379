/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A block at rest in stick for eleven days.
 *
 * What makes it hard: nothing happens, so nothing may be paid for.
 *
 * Reference: x = v = 0 exactly, and the number of steps of a run of one second, within 3.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static void a_million_seconds_cost_what_one_does(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        double steps[2];
        struct trial trial;
        for (int k = 0; k < 2; k++) {
            trial = trial_open("hard/at_rest.yaml", NULL);
            hard_start(&trial, &method, k == 0 ? 1 : 1e6);
            hard_done(&checks, &trial);
            steps[k] = (double)fbd_simulation_stats(trial.simulation).steps;
            check_that(&checks, "it rests", trial_get(&trial, "x") == 0 && trial_get(&trial, "v") == 0);
            if (k == 1)
                hard_case(&checks, &trial, "steps more for 1e6 s than for 1 s", fmax(steps[1] - steps[0], 0),
                          3);
            trial_close(&trial);
        }
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_million_seconds_cost_what_one_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
