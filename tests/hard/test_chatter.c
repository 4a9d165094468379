/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dry friction written as c*sign(v), which changes its branch for ever at v = 0.
 *
 * What makes it hard: there is no motion beyond the stop that agrees with the expression; a loop without a
 * memory goes on for ever while no time passes.
 *
 * Reference: it stops at t = m v0/c = 1.5 s. It is refused there, with the advice to declare friction, and
 * what was before is kept.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

#include <string.h>

static void it_is_refused_with_advice(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/chatter.yaml", NULL);
        hard_start(&trial, &method, NAN);
        check_that(&checks, "the run fails", hard_finish(&trial) == FBD_FAILED);
        const char *reason = fbd_simulation_reason(trial.simulation);
        check_that(&checks, "the reason names the force and the remedy",
                   strstr(reason, "`rub`") && strstr(reason, "declare it as `friction`"));
        hard_case(&checks, &trial, "time", fabs(trial_get(&trial, "t") - 1.5),
                  fmax(1e-12, 1.5 * hard_promise(&trial)));
        hard_case(&checks, &trial, "place", fabs(trial_get(&trial, "x") - 2.25),
                  fmax(1e-12, 3 * hard_promise(&trial)));
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_refused_with_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
