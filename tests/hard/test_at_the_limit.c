/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A force of exactly mu m g on a block with friction mu.
 *
 * What makes it hard: one rounding more or less than the limit, with numbers that are not exact in binary.
 *
 * Reference: at rest it stays. Thrown against the force it stops at |v0|/(2 mu g) and stays; along the force
 * it goes on at constant speed.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double g = 9.81, mu = 0.3;

static void at_rest_it_stays(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    char setting[32];
    for (size_t i = 0; hard_method_at(i, &method); i++)
        for (int k = 1; k < 40; k++) {
            snprintf(setting, sizeof setting, "mu=%g", 0.017 * k);
            struct trial trial = trial_open("hard/at_the_limit.yaml", SET(setting));
            hard_start(&trial, &method, NAN);
            hard_done(&checks, &trial);
            double moved = fabs(trial_get(&trial, "x")) + fabs(trial_get(&trial, "v"));
            check_that(&checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
            if (k == 1) hard_case(&checks, &trial, "at rest: motion", moved, 1e-300);
            check_that(&checks, "at rest: motion", moved == 0);
            trial_close(&trial);
        }
    checks_end(&checks);
}

static void thrown_against_the_force_it_stops_and_stays(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/at_the_limit.yaml", SET("v0=-3"));
        hard_start(&trial, &method, NAN);
        hard_done(&checks, &trial);
        double stops = 3 / (2 * mu * g), x = -3 * stops / 2;
        /* The motion is a parabola: exact for order 2 and above but for roundings. */
        double tolerance = fmax(1e-13, 3 * hard_promise(&trial));
        hard_case(&checks, &trial, "thrown against it: time of the stop",
                  fabs(trial_event(&trial, FBD_EVENT_STICK, NULL, 0) - stops), tolerance);
        hard_case(&checks, &trial, "thrown against it: place", fabs(trial_get(&trial, "x") - x), tolerance);
        check_that(&checks, "it stays",
                   trial_get(&trial, "v") == 0 && fbd_simulation_event_count(trial.simulation) == 1);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void thrown_along_the_force_it_goes_on(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/at_the_limit.yaml", SET("v0=3"));
        hard_start(&trial, &method, NAN);
        hard_done(&checks, &trial);
        /* 100 s with an acceleration that is one rounding of mu g at most. */
        hard_case(&checks, &trial, "thrown along it: velocity", fabs(trial_get(&trial, "v") - 3), 1e-13);
        check_that(&checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A trillionth more than the limit moves it: 1e-12 mu g, known to 4 roundings of mu g, for 100 s. */
static void a_trillionth_more_moves_it(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("hard/at_the_limit.yaml", SET("share=1+1e-12"));
    hard_start(&trial, NULL, NAN);
    hard_done(&checks, &trial);
    double v = 1e-12 * mu * g * 100;
    hard_case(&checks, &trial, "1e-12 above: velocity", fabs(trial_get(&trial, "v") - v), 1e-3 * v);
    trial_close(&trial);
    trial = trial_open("hard/at_the_limit.yaml", SET("share=1-1e-12"));
    hard_start(&trial, NULL, NAN);
    hard_done(&checks, &trial);
    hard_case(&checks, &trial, "1e-12 below: velocity", fabs(trial_get(&trial, "v")), 1e-300);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_rest_it_stays),
        cmocka_unit_test(thrown_against_the_force_it_stops_and_stays),
        cmocka_unit_test(thrown_along_the_force_it_goes_on),
        cmocka_unit_test(a_trillionth_more_moves_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
