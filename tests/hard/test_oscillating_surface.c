/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A block on a shaken table, v_table = V cos(w t) with V w = 1.25 mu_s g.
 *
 * What makes it hard: to stick is to move as the table, with the force m s'; to slip ends where a straight
 * line v(t) meets a cosine.
 *
 * Reference: from sticking it breaks away at |sin(w t)| = 1/1.25 with sin growing, since that is where the
 * table's acceleration is mu_s g; then v changes with mu_d g until it meets the cosine (by bisection to
 * rounding), where the table's acceleration is below the limit again; the next half period is the same with
 * the other sign.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double pi = 3.14159265358979323846, g = 9.81, mu_s = 0.3, mu_d = 0.2, V = 0.6;

enum { halves = 19 };

static double frequency(void)
{
    return 1.25 * mu_s * g / V;
}

/* Velocity of the block relative to the table after it has broken away at t0; the table brakes harder. */
static double relative(double t, const void *breakaway)
{
    double t0 = *(const double *)breakaway, w = frequency();
    return V * cos(w * t0) - mu_d * g * (t - t0) - V * cos(w * t);
}

static void check_table(struct checks *checks, struct trial *trial, bool is_default)
{
    double w = frequency(), t0 = asin(1 / 1.25) / w, t1 = hard_root(relative, &t0, t0 + 0.05, pi / w + t0);
    double error = 0;
    for (int n = 0; n < halves; n++) {
        double slips = trial_event(trial, FBD_EVENT_BREAKAWAY, NULL, n) - t0 - n * pi / w;
        double sticks = trial_event(trial, FBD_EVENT_STICK, NULL, n) - t1 - n * pi / w;
        error = isnan(slips + sticks) ? HUGE_VAL : fmax(error, fmax(fabs(slips), fabs(sticks)));
    }
    /* The velocity is a straight line from a known point. Where they meet the table is about 2 m/s^2 faster
     * in its change: an error of V times the promise is 0.3 s times the promise. */
    hard_case(checks, trial, "19 times slip and stick", error,
              is_default ? 1e-12 : fmax(1e-12, 0.3 * hard_promise(trial)));
    trial_to(trial, t1 + (halves - 1) * pi / w + 0.01);
    double t = trial_get(trial, "t");
    check_close(checks, "sticking is moving with the table", trial_get(trial, "v"), V * cos(w * t), 1e-14);
}

static void it_sticks_and_slips_with_the_table(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/oscillating_surface.yaml", NULL);
        hard_start(&trial, &method, NAN);
        trial_to_event(&trial, FBD_EVENT_STICK, NULL, halves - 1);
        check_table(&checks, &trial, i == 0);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_sticks_and_slips_with_the_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
