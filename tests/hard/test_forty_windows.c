/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The long row of IFToMM benchmark A02 (windows.h) keeps its energy.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>

#include "windows.h"

static const double g = 9.81;

/* The benchmark: 40 windows, and less than 0.1 J of error. A conservative loop keeps its energy to 1e-8 of
 * what it turns over at 1e-10: the weights of its rods fall by 1 m and 2 m and rise again in each turn. */
static void forty_windows_keep_their_energy(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const struct row_of_windows row = {40, 1, 1, 0, 1, false};
    const double fall = g * (41 * 1 + 40 * 2);
    static const double tolerances[] = {1e-6, 1e-7, 1e-10};
    for (size_t i = 0; i < (thorough() ? sizeof tolerances / sizeof *tolerances : 1); i++) {
        struct hard_method method = {.tolerance = tolerances[i]};
        windows_turn(&checks, &row, &method);
        char *text = windows_text(&row);
        assert_non_null(text);
        struct trial trial = trial_parse(text);
        free(text);
        trial_run(&trial, &(fbd_options){.until = 10, .tolerance = tolerances[i]});
        fbd_energy energy = fbd_result_energy(trial.result);
        check_close(&checks, "residual", energy.residual, 0, fmin(0.1, 100 * tolerances[i] * fall));
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forty_windows_keep_their_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
