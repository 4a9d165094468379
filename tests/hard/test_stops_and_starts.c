/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A block under A sin(w t), A = 1.01 mu m g: it stops and starts in every half period.
 *
 * What makes it hard: the force exceeds the limit by 1 % at most, for 9 % of the time, in steps that nothing
 * else bounds, since the block is at rest; at breakaway position, velocity and acceleration are all zero.
 *
 * Reference: breakaway at t0 = asin(1/1.01)/w, then v = A/(m w) (cos(w t0) - cos(w t)) - mu g (t - t0), which
 * returns to zero at t1 (by bisection to rounding); each half period repeats it with the other sign.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double pi = 3.14159265358979323846, g = 9.81, mu = 0.5, w = 3, excess = 1.01;

enum { halves = 20 };

static double velocity(double t, const void *breakaway)
{
    double t0 = *(const double *)breakaway, peak = excess * mu * g;
    return peak / w * (cos(w * t0) - cos(w * t)) - mu * g * (t - t0);
}

static double displacement(double t0, double t)
{
    double s = t - t0, peak = excess * mu * g;
    return peak / w * (cos(w * t0) * s - (sin(w * t) - sin(w * t0)) / w) - mu * g * s * s / 2;
}

/* After n half periods the block has gone forth and back; the largest error of x at rest relative to the
 * stroke, and of the times. */
static void check_halves(struct checks *checks, struct trial *trial, bool is_default)
{
    double t0 = asin(1 / excess) / w, t1 = hard_root(velocity, &t0, t0 + 0.1, pi / w), time_error = 0,
           x_error = 0;
    double stroke = displacement(t0, t1);
    for (int n = 0; n < halves; n++) {
        double starts = trial_event(trial, FBD_EVENT_BREAKAWAY, NULL, n);
        double stops = trial_event(trial, FBD_EVENT_STICK, NULL, n);
        double error = fmax(fabs(starts - t0 - n * pi / w), fabs(stops - t1 - n * pi / w));
        time_error = isnan(starts + stops) ? HUGE_VAL : fmax(time_error, error);
    }
    x_error = fabs(trial_get(trial, "x")) / stroke; /* an even number of strokes */
    check_that(checks, "20 starts", hard_count(trial, FBD_EVENT_BREAKAWAY) == halves);
    check_that(checks, "20 stops", hard_count(trial, FBD_EVENT_STICK) == halves);
    /* The block decelerates with about what it has accelerated with: an error of v by tolerance times its
     * largest value shifts the stop by that share of the 0.2 s that it moves; forces and times are exact to
     * rounding. */
    hard_case(checks, trial, "20 starts and stops", time_error,
              is_default ? 1e-9 : fmax(hard_promise(trial), 1e-12));
    hard_case(checks, trial, "x after 20 strokes", x_error,
              is_default ? 1e-9 : fmax(hard_promise(trial), 1e-12));
}

static void twenty_starts_and_stops(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/stops_and_starts.yaml", NULL);
        hard_start(&trial, &method, NAN);
        if (hard_done(&checks, &trial)) check_halves(&checks, &trial, i == 0);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(twenty_starts_and_stops)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
