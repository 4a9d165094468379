/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A fall through air, for 300 times as long as it takes to be in balance with it.
 *
 * What makes it hard: errors die out, so that steps grow to the limit of stability and live there; what looks
 * right at the ends of such steps need not be so inside. And a speed that is approached for ever must not be
 * reached by an error.
 *
 * Reference: v = v_t tanh(g t/v_t), x = v_t^2/g ln cosh(g t/v_t).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

#include <string.h>

static const double g = 9.81, v_t = 3.1320919526731650, fall = 1000;

struct worst {
    double ends, inside; /* errors of v relative to v_t */
};

static double error_at(struct trial *trial, double t)
{
    assert_true(fbd_simulation_state(trial->simulation, t, trial->state));
    return fabs(trial_get(trial, "v") / v_t - tanh(g * t / v_t));
}

static void take_step(struct trial *trial, struct worst *worst)
{
    enum { samples = 8 };
    double from, to;
    fbd_simulation_interval(trial->simulation, &from, &to);
    for (int k = 1; k < samples; k++)
        worst->inside = fmax(worst->inside, error_at(trial, from + (to - from) * k / samples));
    worst->ends = fmax(worst->ends, error_at(trial, to));
}

/* An error of a step by the tolerance times v_t is gone after the next few, as a step near the limit of
 * stability keeps a part of it only: 30 tolerances hold whatever the number of steps. Methods of order 1 and
 * 2 make their error in the second before, where they need most of their steps, and those of multistep
 * methods hang together for many steps: they are held to what their tolerance promises. Inside of a step
 * dop853 errs by up to 25 times what its ends do, as close to the limit of stability as it is let. */
static void check_fall(struct checks *checks, const struct hard_method *method)
{
    struct trial trial = trial_open("hard/terminal_speed.yaml", NULL);
    struct worst worst = {0, 0};
    hard_start(&trial, method, NAN);
    do {
        trial.outcome = fbd_simulation_advance(trial.simulation);
        take_step(&trial, &worst);
    } while (trial.outcome == FBD_GOING);
    check_that(checks, "the run reaches its end", trial.outcome == FBD_DONE);
    bool promise = method->order <= 2 || (method->name && strncmp(method->name, "ms", 2) == 0);
    double ends = promise ? hard_promise(&trial) : 30 * method->tolerance;
    double inside = fmax(ends, 100 * method->tolerance), x = v_t * v_t / g * (g * fall / v_t - log(2));
    hard_case(checks, &trial, "speed at the ends of steps", worst.ends, ends);
    hard_case(checks, &trial, "speed inside of steps", worst.inside, inside);
    hard_case(checks, &trial, "place", fabs(trial_get(&trial, "x") - x) / x, hard_promise(&trial));
    check_that(checks, "the terminal speed is not reached",
               fbd_simulation_event_count(trial.simulation) == 0);
    trial_close(&trial);
}

static void it_is_approached_and_not_reached(void **unused)
{
    (void)unused;
    hard_each_tolerance(check_fall);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_approached_and_not_reached),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
