/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A kick of 1 ms in a coast of 1000 s.
 *
 * What makes it hard: a free body bounds no step; a method that goes by its error alone steps over the kick
 * with success.
 *
 * Reference: v = v0 + F dt/m = 1.1 m/s; x = v0 t + (v - v0)(t - t0 - dt/2).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static void a_millisecond_is_not_missed(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/pulse_in_a_coast.yaml", NULL);
        hard_start(&trial, &method, NAN);
        hard_done(&checks, &trial);
        double x = 1000 + 0.1 * (1000 - 617.3 - 0.0005);
        /* The edges are known to two roundings of t = 617 s each, 4.5e-13 s together, in which the kick
         * gives 4.5e-11 m/s, for 383 s. */
        hard_case(&checks, &trial, "velocity", fabs(trial_get(&trial, "v") - 1.1),
                  fmax(5e-11, hard_promise(&trial)));
        hard_case(&checks, &trial, "place", fabs(trial_get(&trial, "x") - x),
                  fmax(2e-8, x * hard_promise(&trial)));
        check_that(&checks, "two edges", hard_count(&trial, FBD_EVENT_SWITCH) == 2);
        check_that(&checks, "few steps", fbd_simulation_stats(trial.simulation).steps < 60);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_millisecond_is_not_missed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
