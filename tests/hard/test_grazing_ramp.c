/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A force that touches the limit of static friction and goes down again, and one that exceeds it by 1e-6.
 *
 * What makes it hard: a double root of the event function, or two roots 0.004 s apart in a step of seconds.
 *
 * Reference: f = excess * limit (1 - (t/T - 1)^2) reaches the limit at t = T (1 - sqrt(1 - 1/excess)); with
 * the corner at t = T/excess. Then m v' = f - limit/2, a polynomial of t.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double T = 2, g = 9.81, mass = 2, excess = 1 + 1e-6;

/* With masses whose weights round differently: a rounding is no breakaway. */
static void a_force_that_touches_the_limit_moves_nothing(void **unused)
{
    (void)unused;
    static const char *const paths[] = {"hard/grazing_ramp.yaml", "hard/grazing_triangle.yaml"};
    static const char *const masses[] = {"mass=2",   "mass=0.1", "mass=0.3",
                                         "mass=0.7", "mass=1.1", "mass=1234.5"};
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++)
        for (size_t k = 0; k < 2 * sizeof masses / sizeof *masses; k++) {
            struct trial trial = trial_open(paths[k % 2], SET(masses[k / 2]));
            hard_start(&trial, &method, NAN);
            hard_done(&checks, &trial);
            check_that(&checks, masses[k / 2], hard_count(&trial, FBD_EVENT_BREAKAWAY) == 0);
            check_that(&checks, "x = 0", trial_get(&trial, "x") == 0);
            if (k == 0)
                hard_case(&checks, &trial, "touch: displacement", fabs(trial_get(&trial, "x")), 1e-300);
            trial_close(&trial);
        }
    checks_end(&checks);
}

/* m v = integral of f - limit/2, with u = t/T - 1: the polynomial excess limit (t - T u^3/3) - limit t/2. */
static double impulse(double t)
{
    double limit = 0.5 * mass * g, u = t / T - 1;
    return excess * limit * (t - T * u * u * u / 3) - limit / 2 * t;
}

static void a_millionth_more_breaks_away(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    double breaks = T * (1 - sqrt(1 - 1 / excess)), v = (impulse(2 * T) - impulse(breaks)) / mass;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/grazing_ramp.yaml", SET("excess=1+1e-6"));
        hard_start(&trial, &method, NAN);
        if (hard_done(&checks, &trial)) {
            /* The force rises by excess limit 2 (1 - t/T)/T = 1e-3 of the limit in a second there, and is
             * known to some roundings of the limit, 1e-15 of it each. */
            hard_case(&checks, &trial, "excess 1e-6: time of breakaway",
                      fabs(trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0) - breaks), 2e-11);
            hard_case(&checks, &trial, "excess 1e-6: velocity after", fabs(trial_get(&trial, "v") - v),
                      fmax(v * hard_promise(&trial), 1e-10));
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void a_millionth_more_at_a_corner_breaks_away(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/grazing_triangle.yaml", SET("excess=1+1e-6"));
        hard_start(&trial, &method, NAN);
        hard_done(&checks, &trial);
        /* The force rises by the limit in T: some roundings of the limit are as many of T. */
        hard_case(&checks, &trial, "corner, excess 1e-6: time of breakaway",
                  fabs(trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0) - T / excess), 1e-13);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_force_that_touches_the_limit_moves_nothing),
        cmocka_unit_test(a_millionth_more_breaks_away),
        cmocka_unit_test(a_millionth_more_at_a_corner_breaks_away),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
