/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * An oscillator on rough ground with mu_s = mu_d, and with mu_s = 80 mu_d.
 *
 * What makes it hard: a turning point is a decision between stick and two slips, with no gap between the laws
 * when the coefficients are equal; 102 of them follow each other, and the last depends on all.
 *
 * Reference, w = sqrt(k/m), xd = mu_d m g/k: the half swings are harmonic about +-xd, so the turning points
 * come at n pi/w with amplitudes x0 - 2 n xd, until k times the amplitude is at most mu_s m g.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double pi = 3.14159265358979323846, m_g = 9.81, k = 100, w = 10;

struct swing {
    const char *name;
    const char *const *settings;
    double mu_s, mu_d, x0;
};

/* The turning point at which it stays. */
static int last_turn(const struct swing *swing)
{
    int n = 0;
    while (k * (swing->x0 - 2 * n * swing->mu_d * m_g / k) > swing->mu_s * m_g) n++;
    return n;
}

static void check_swing(struct checks *checks, const struct swing *swing, const struct hard_method *method,
                        bool is_default)
{
    struct trial trial = trial_open("hard/dying_oscillator.yaml", swing->settings);
    int turns = last_turn(swing);
    double time_error = 0, x = (turns % 2 ? -1 : 1) * (swing->x0 - 2 * turns * swing->mu_d * m_g / k);
    hard_start(&trial, method, NAN);
    hard_done(checks, &trial);
    for (int n = 1; n <= turns; n++) {
        double t = n < turns ? trial_event(&trial, FBD_EVENT_REVERSAL, NULL, n - 1)
                             : trial_event(&trial, FBD_EVENT_STICK, NULL, 0);
        time_error = isnan(t) ? HUGE_VAL : fmax(time_error, fabs(t - n * pi / w));
    }
    /* An error dv of v = w x moves the turning point by dv/(w^2 A) with the amplitude A at that point: errors
     * made at full size count x0/A as much there, and the smallest A is that of the last turn. */
    double magnified = swing->x0 / fabs(x), promise = hard_promise(&trial);
    hard_case(checks, &trial, swing->name, time_error, is_default ? 1e-7 : promise * magnified / w);
    hard_case(checks, &trial, "  where it stays", fabs(trial_get(&trial, "x") - x),
              is_default ? 1e-9 * swing->x0 : promise * swing->x0);
    check_that(checks, "it stays", trial_get(&trial, "v") == 0);
    trial_close(&trial);
}

static void check_swings(const struct swing *swing, int least_order)
{
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++)
        if (method.order >= least_order) check_swing(&checks, swing, &method, i == 0);
    checks_end(&checks);
}

/* The last turn lies 0.6 mm from the middle, after 101 swings from 1 m: implicit Euler at 1e-5 loses 15 of
 * the swings to its own damping, so it has no part in it. */
static void equal_coefficients(void **unused)
{
    (void)unused;
    check_swings(&(struct swing){"mu_s = mu_d: 102 turns", NULL, 0.05, 0.05, 1}, 2);
}

static void a_static_coefficient_of_eighty_times_the_other(void **unused)
{
    (void)unused;
    check_swings(&(struct swing){"mu_s = 80 mu_d: 62 turns", SET("mu_s=0.8", "mu_d=0.01", "x0=0.2"), 0.8,
                                 0.01, 0.2},
                 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_coefficients),
        cmocka_unit_test(a_static_coefficient_of_eighty_times_the_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
