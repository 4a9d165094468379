/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Progress: a run that gains no time for its work ends by name, its state kept. Work is counted and no clock is read, so that
 * the same run ends at the same step everywhere.
 */
#include <float.h>
#include <math.h>

#include "loop/run.h"

/* Steps of a few roundings of the time, one after the other: before a place that cannot be passed, by a method without a
 * fine sense of error, or between events that crowd. */
static void check_crawl(struct run *run)
{
    enum { most_steps = 100 };
    bool tiny = moment_since(run_end(run), run_start(run)) <= 8 * DBL_EPSILON * fabs(run->state->t);
    run->step.crawl = tiny ? run->step.crawl + 1 : 0;
    if (run->step.crawl <= most_steps) return;
    if (run->recent.crowd > 0)
        run_fail_chatter(run);
    else
        run_fail_step(run, stepper_underflow);
}

/* Right-hand sides, event samples, and Jacobians and events at the price of sixteen, each for all components of the state. */
static double work_done(const struct run *run)
{
    const double price = 16;
    double samples = (double)run->search.moving.samples + (double)run->search.timed.samples;
    double evaluations = (double)run->system.rhs + samples;
    evaluations += price * ((double)run->system.jacobians + (double)run->log.count);
    return evaluations * (double)plan_size(&run->model->plan);
}

/* Is the time gained since the last check negligible? Beside the time that has passed, or the first step where
 * that is longer, and the length of the run, which may be very long as an event is to end it: `stands` ten million times as
 * much work gains no more than has passed; `struggles` a thousand times as much, of steps most of which are rejected;
 * `is_endless` after a hundred times as much work as this, a million times as much would be left. */
static bool gains_nothing(const struct run *run, double gain, bool rejects)
{
    const double length = run->options.until - run->progress.start,
                 passed = run->state->t - run->progress.start;
    const double scale = fmin(length, fmax(passed, run->step.first));
    bool stands = gain < 1e-7 * scale || gain < 1e-15 * length;
    bool struggles = rejects && gain < 1e-3 * scale;
    bool is_endless = gain < 1e-2 * passed && gain < 1e-6 * length;
    return stands || struggles || is_endless;
}

void run_check_progress(struct run *run)
{
    const double window = 1e7; /* some seconds of processor time */
    struct progress *progress = &run->progress;
    check_crawl(run);
    const double work = work_done(run), gain = run->state->t - progress->t;
    if (work - progress->work < window) return;
    const struct stepper_counts counts = switcher_counts(run->stepper);
    unsigned long rejected = 0;
    for (int k = 0; k < rejection_kinds; k++) rejected += counts.rejected[k];
    bool rejects = rejected - progress->rejected > counts.accepted - progress->accepted;
    if (gains_nothing(run, gain, rejects)) run_fail_progress(run, gain);
    *progress = (struct progress){progress->start, run->state->t, work, counts.accepted, rejected};
}
