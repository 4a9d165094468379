/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Progress: a run that gains too little time per work ends with a message, and keeps its state. Work is
 * counted, and no clock is read, so that the same run ends at the same step on every machine.
 */
#include "loop/progress.h"

#include <math.h>

#include "loop/run.h"
#include "numeric/tolerances.h"

/* Fail after many successive steps of a few roundings of the time: before a singularity, by a method with a
 * coarse error estimate, or between events that accumulate. */
static void check_crawl(struct run *run)
{
    enum { most_steps = 100 };
    bool tiny = time_dd_since(run_end(run), run_start(run)) <= round_off(8, fabs(run->state->t));
    run->step.crawl = tiny ? run->step.crawl + 1 : 0;
    if (run->step.crawl <= most_steps) return;
    if (run->recent.crowd > 0)
        run_fail_chatter(run);
    else
        run_fail_step(run, stepper_underflow);
}

/* Work in evaluations times components: right-hand sides and event samples count 1, Jacobians and events 16. */
static unsigned long work_done(const struct run *run)
{
    const unsigned long price = 16;
    unsigned long samples = (unsigned long)(run->search.moving.samples + run->search.timed.samples);
    unsigned long dear = run->system.jacobians + (unsigned long)run->log.count;
    return (run->system.rhs + samples + price * dear) * (unsigned long)plan_size(&run->model->plan);
}

/* Work between checks: some tenths of a second to some seconds of processor time, depending on the right-hand
 * side. The cost of a check is negligible. */
static const unsigned long window = 10000000;

/* Each is a fraction of time gained in a window; its inverse is the number of windows left:
 *     - to double the elapsed time would take ten million windows;
 *     - the run would take 1e15 windows, even at its start, when little time has elapsed;
 *     - most steps are rejected, so that the pace decreases further, and doubling would take a thousand windows;
 *     - a hundred windows have passed (the pace is steady), and a million are left. */
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
    const unsigned long work = work_done(run);
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

struct run_totals run_totals(struct run *run)
{
    const struct stepper_counts counts = switcher_counts(run->stepper);
    const long samples = run->search.timed.samples + run->search.moving.samples;
    struct run_totals totals = {.t = run->state->t,
                                .kind = run->kind,
                                .steps = counts.accepted,
                                .stiff_steps = switcher_stiff_steps(run->stepper),
                                .rhs = run->system.rhs,
                                .jacobians = run->system.jacobians,
                                .event_samples = (unsigned long)samples,
                                .energy = run_energy_balance(run)};
    for (int kind = 0; kind < rejection_kinds; kind++) totals.rejected += counts.rejected[kind];
    return totals;
}
