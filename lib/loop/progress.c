/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Progress: a run that gains no time for its work ends by name, its state kept. Work is counted and no clock is read, so that
 * the same run ends at the same step everywhere.
 */
#include "loop/progress.h"

#include <float.h>
#include <math.h>

#include "loop/run.h"

/* Steps of a few roundings of the time, one after the other: before a place that cannot be passed, by a method without a
 * fine sense of error, or between events that crowd. */
static void check_crawl(struct run *run)
{
    enum { most_steps = 100 };
    bool tiny = time_dd_since(run_end(run), run_start(run)) <= 8 * DBL_EPSILON * fabs(run->state->t);
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

/* Work from check to check: some tenths of a second to some seconds of processor time, as right-hand sides are short or long. A
 * check costs nothing beside it, and who waits has not waited long when the first ones fail. */
static const double window = 1e7;

/* Each is a share of time in a window; its inverse says how many windows are left, and so how long one would wait:
 * - as much time again as has passed takes ten million windows;
 * - the run takes 1e15 windows even at its start, where little has passed yet;
 * - where most steps are rejected the pace falls further, so a thousand windows to double the time are too many;
 * - a hundred windows have been done (gain and pace are steady), and a million are left. */
static const double stands_share = 1e-7, hopeless_share = 1e-15, struggles_share = 1e-3, steady_share = 1e-2,
                    endless_share = 1e-6;

bool progress_is_none(const struct gain *gain)
{
    const double scale = fmin(gain->length, fmax(gain->passed, gain->first));
    bool stands = gain->time < stands_share * scale || gain->time < hopeless_share * gain->length;
    bool struggles = gain->rejects && gain->time < struggles_share * scale;
    bool is_endless = gain->time < steady_share * gain->passed && gain->time < endless_share * gain->length;
    return stands || struggles || is_endless;
}

void run_check_progress(struct run *run)
{
    struct progress *progress = &run->progress;
    check_crawl(run);
    const double work = work_done(run);
    if (work - progress->work < window) return;
    const struct stepper_counts counts = switcher_counts(run->stepper);
    unsigned long rejected = 0;
    for (int k = 0; k < rejection_kinds; k++) rejected += counts.rejected[k];
    const struct gain gain = {.time = run->state->t - progress->t,
                              .passed = run->state->t - progress->start,
                              .length = run->options.until - progress->start,
                              .first = run->step.first,
                              .rejects =
                                  rejected - progress->rejected > counts.accepted - progress->accepted};
    if (progress_is_none(&gain)) run_fail_progress(run, gain.time);
    *progress = (struct progress){progress->start, run->state->t, work, counts.accepted, rejected};
}
