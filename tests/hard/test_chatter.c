/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dry friction written as c*sign(v), which changes its branch for ever at v = 0.
 *
 * What makes it hard: there is no motion beyond the stop that agrees with a branch; a loop without a memory
 * goes on for ever while no time passes. It slides on the switch instead (Filippov), which is to stick.
 *
 * The same with an attraction -F sign(x) under friction, which has passed x = 0 infinitely often after a
 * finite time.
 *
 * Reference: it stops at t = m v0/c = 1.5 s and stays. In the second motion each passage is slower by r =
 * sqrt(a/b), a = F/m - mu g, b = F/m + mu g, the first one at v = sqrt(2 a x0) after v/a; the others take v
 * (1/b + r/a)(1 + r + r^2 + ...).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

#include <string.h>

static void it_stops_and_stays(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/chatter.yaml", NULL);
        hard_start(&trial, &method, NAN);
        if (!hard_done(&checks, &trial)) continue;
        check_that(&checks, "at rest", trial_get(&trial, "v") == 0);
        check_that(&checks, "one event", fbd_simulation_event_count(trial.simulation) == 1);
        hard_case(&checks, &trial, "time", fabs(trial_event(&trial, FBD_EVENT_SLIDING, "rub", 0) - 1.5),
                  fmax(1e-12, 1.5 * hard_promise(&trial)));
        hard_case(&checks, &trial, "place", fabs(trial_get(&trial, "x") - 2.25),
                  fmax(1e-12, 3 * hard_promise(&trial)));
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Between events the motion is a parabola, which methods of order 2 and above follow without an error, so that the
 * end is where the events put it; bsimp and multistep methods, which start anew at each event with an order of 1, are
 * off by their tolerance in a passage, or in time by its square root when the passage itself is as small. */
static void infinitely_many_passages_come_to_their_end(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    const double a = 5 - 0.2 * 9.81, b = 5 + 0.2 * 9.81, r = sqrt(a / b), v = sqrt(2 * a);
    const double end = v / a + v * (1 / b + r / a) / (1 - r);
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        if (method.order == 1) continue; /* the last passages are below what it resolves */
        struct trial trial = trial_open("hard/zeno_stop.yaml", NULL);
        hard_start(&trial, &method, NAN);
        if (!hard_done(&checks, &trial)) continue;
        bool exact =
            !method.name || (strncmp(method.name, "ms", 2) != 0 && strcmp(method.name, "bsimp") != 0);
        double room = exact ? fmax(1e-10, 3 * hard_promise(&trial)) : 100 * sqrt(method.tolerance);
        hard_case(&checks, &trial, "infinitely many passages: time of the end",
                  fabs(trial_event(&trial, FBD_EVENT_SLIDING, "pull", 0) - end), room);
        check_close(&checks, "sticks at the same time", trial_event(&trial, FBD_EVENT_STICK, NULL, 0),
                    trial_event(&trial, FBD_EVENT_SLIDING, "pull", 0), 0);
        check_that(&checks, "at rest", trial_get(&trial, "x") == 0 && trial_get(&trial, "v") == 0);
        check_that(&checks, "at the end", trial_get(&trial, "t") == 30);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_stops_and_stays),
        cmocka_unit_test(infinitely_many_passages_come_to_their_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
