/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linear and quadratic drag slow two bodies down without ever stopping them.
 *
 * What makes it hard: v = exp(-t) falls far below any tolerance, and no rounding may make it stop or turn
 * round.
 *
 * Reference: v = v0 exp(-c t/m) and v = v0/(1 + k v0 t/m).
 *
 * Limit: an error control relative to the motion so far leaves v as it is when it is below tolerance times 1
 * m/s, and a method may then carry it through zero. So the sign of v is claimed to where v is 100 tolerances
 * (1e-8 m/s for the default); that it never counts as stopped, for the whole run.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static void check_drag(struct checks *checks, const struct hard_method *method, double until)
{
    struct trial trial = trial_open("hard/drag_without_end.yaml", NULL);
    hard_start(&trial, method, until);
    if (hard_done(checks, &trial)) {
        double linear = trial_get(&trial, "linear.v"), quadratic = trial_get(&trial, "quadratic.v");
        hard_case(checks, &trial, "linear", fabs(linear - exp(-until)), hard_promise(&trial));
        hard_case(checks, &trial, "quadratic", fabs(quadratic - 1 / (1 + until)), hard_promise(&trial));
        check_that(checks, "both still move", linear > 0 && quadratic > 0);
        check_that(checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
    }
    trial_close(&trial);
}

static void it_never_stops(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++)
        check_drag(&checks, &method, -log(100 * method.tolerance));
    checks_end(&checks);
}

static void check_rest(struct checks *checks, const struct hard_method *method)
{
    struct trial trial = trial_open("hard/drag_without_end.yaml", NULL);
    hard_start(&trial, method, NAN);
    if (hard_done(checks, &trial)) {
        hard_case(checks, &trial, "linear, 100 s", fabs(trial_get(&trial, "linear.v")),
                  10 * method->tolerance);
        check_that(checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
    }
    trial_close(&trial);
}

/* To 1e-44 m/s, with the events of the file that wait for v = 0. An error of v by the tolerance decays as v
 * does. */
static void nothing_ever_happens(void **unused)
{
    (void)unused;
    hard_each_tolerance(check_rest);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_never_stops),
        cmocka_unit_test(nothing_ever_happens),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
