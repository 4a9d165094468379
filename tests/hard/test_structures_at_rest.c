/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Structures that cannot move: a beam on two and on three supports, a ladder, a truss.
 *
 * What makes it hard: nothing is left of the motion but rounding, so that no size of it can serve as a
 * measure: neither of what a projection may take from the motion nor of an error.
 *
 * Reference: every coordinate stays where it is.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

/* How far the structure of a model moves, by a method (NULL: what the library does). */
static void check_structure(struct checks *checks, const char *model, const struct hard_method *method,
                            double until, double way)
{
    struct trial trial = trial_open(model, NULL);
    size_t n = fbd_model_coordinate_count(trial.model);
    double start[16], most = 0;
    assert_true(n <= 16);
    for (size_t k = 0; k < n; k++) start[k] = trial_get(&trial, fbd_model_coordinate(trial.model, k).name);
    hard_start(&trial, method, until);
    hard_done(checks, &trial);
    for (size_t k = 0; k < n; k++)
        most = fmax(most, fabs(trial_get(&trial, fbd_model_coordinate(trial.model, k).name) - start[k]));
    hard_case(checks, &trial, model, most, way);
    trial_close(&trial);
}

static void check_structures(double until, double way)
{
    struct checks checks = {0};
    static const char *const models[] = {"statics/beam.yaml", "statics/beam_on_three_supports.yaml",
                                         "statics/ladder.yaml", "statics/truss.yaml"};
    for (size_t i = 0; i < sizeof models / sizeof *models; i++)
        check_structure(&checks, models[i], NULL, until, way);
    checks_end(&checks);
}

/* Multistep methods began anew at each step, for the rounding that a projection takes back. */
static void it_stays_there_by_every_method(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++)
        check_structure(&checks, "statics/beam.yaml", &method, 1, 1e-12);
    checks_end(&checks);
}

/* Accelerations of a thousand roundings of gravity would make this way in a second. */
static void a_structure_stays_where_it_is(void **unused)
{
    (void)unused;
    check_structures(1, 1e-12);
}

/* They would make 1 m in this time, but supports leave them no way. */
static void it_stays_there_for_twelve_days(void **unused)
{
    (void)unused;
    check_structures(1e6, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_structure_stays_where_it_is),
        cmocka_unit_test(it_stays_there_for_twelve_days),
        cmocka_unit_test(it_stays_there_by_every_method),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
