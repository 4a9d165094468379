/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Events at t = 0, at the last instant, in two bodies at one instant, and on a constant.
 *
 * What makes it hard: each of them is lost or doubled by a rule that is only a little wrong.
 *
 * Reference: two bodies fall alike with 8 m/s^2: v = 8 t, x = 4 t^2.
 *
 * Rules: a function that is zero at the start has not passed zero; it is armed when it has left. What reaches
 * zero at the last instant has happened. A function that stays zero, or never is, never happens.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static void events_happen_once_and_where_they_should(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/events_at_the_edges.yaml", NULL);
        hard_start(&trial, &method, NAN);
        hard_done(&checks, &trial);
        double a = trial_event(&trial, FBD_EVENT_USER, "a_passes", 0);
        double b = trial_event(&trial, FBD_EVENT_USER, "b_passes", 0);
        hard_case(&checks, &trial, "x = 4 m", fabs(a - 1), fmax(1e-13, hard_promise(&trial)));
        check_that(&checks, "both bodies pass at the same instant", a == b);
        check_that(&checks, "t = 2 s happens at the last instant",
                   trial_event(&trial, FBD_EVENT_USER, "ends", 0) == 2);
        check_that(&checks, "nothing happens at t = 0",
                   isnan(trial_event(&trial, FBD_EVENT_USER, "starts", 0)));
        check_that(&checks, "a constant does not happen",
                   isnan(trial_event(&trial, FBD_EVENT_USER, "constant", 0)) &&
                       isnan(trial_event(&trial, FBD_EVENT_USER, "another_constant", 0)) &&
                       isnan(trial_event(&trial, FBD_EVENT_USER, "same", 0)));
        check_that(&checks, "three events", hard_count(&trial, FBD_EVENT_USER) == 3);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A run of no length does nothing, and says that it is done. */
static void a_run_of_no_length_is_done(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/events_at_the_edges.yaml", NULL);
        hard_start(&trial, &method, 0);
        check_that(&checks, "done", hard_finish(&trial) == FBD_DONE);
        check_that(&checks, "nothing happened", fbd_simulation_event_count(trial.simulation) == 0);
        check_that(&checks, "no step", fbd_simulation_stats(trial.simulation).steps == 0);
        check_that(&checks, "t = 0", trial_get(&trial, "t") == 0);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void an_end_before_the_start_is_refused(void **unused)
{
    (void)unused;
    struct trial trial = trial_open("hard/events_at_the_edges.yaml", NULL);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_errors *errors = fbd_errors_new();
    options.until = -1;
    assert_null(fbd_simulation_new(trial.model, &options, errors));
    assert_int_equal(fbd_errors_count(errors), 1);
    assert_string_equal(fbd_errors_get(errors, 0).id, "bad-option");
    fbd_errors_free(errors);
    trial_close(&trial);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(events_happen_once_and_where_they_should),
        cmocka_unit_test(a_run_of_no_length_is_done),
        cmocka_unit_test(an_end_before_the_start_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
