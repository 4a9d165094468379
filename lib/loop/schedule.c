/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Schedule of an ensemble: the order of the islands' steps, and the common time.
 */
#include <stdio.h>
#include <stdlib.h>

#include "base/format.h"
#include "loop/ensemble.h"

/* Even after another end, up to which islands are integrated again. */
static void end_without_memory(struct ensemble *ensemble)
{
    ensemble->outcome = FBD_OUT_OF_MEMORY;
    ensemble->reason = "out of memory";
}

static void make_run(struct ensemble *ensemble, struct group *group)
{
    if (!ensemble_make_run(ensemble, group)) end_without_memory(ensemble);
}

/* ---- the queue: a binary heap with the island that is furthest behind on top */

static double end_of(const struct ensemble *ensemble, size_t group)
{
    return group_end(&ensemble->groups[group]);
}

/* At equal times the first island comes first. */
static bool before(const struct ensemble *ensemble, size_t a, size_t b)
{
    double end_a = end_of(ensemble, a), end_b = end_of(ensemble, b);
    return end_a < end_b || (end_a == end_b && a < b);
}

/* Restore the heap below index i, whose island has advanced. */
static void sift(struct ensemble *ensemble, size_t i)
{
    size_t *queue = ensemble->queue, group = queue[i];
    for (;;) {
        size_t child = 2 * i + 1;
        if (child >= ensemble->queued) break;
        if (child + 1 < ensemble->queued && before(ensemble, queue[child + 1], queue[child])) child++;
        if (!before(ensemble, queue[child], group)) break;
        queue[i] = queue[child];
        i = child;
    }
    queue[i] = group;
}

/* Queue the islands; with `lazy`, as ensemble_go has it, without the quiet ones. */
static void start(struct ensemble *ensemble, bool lazy)
{
    if (ensemble->started) return;
    ensemble->started = true;
    ensemble->calm = -HUGE_VAL;
    for (size_t p = 0; p < ensemble->count; p++) {
        struct group *group = &ensemble->groups[p];
        if (lazy && group->quiet) continue;
        ensemble->queue[ensemble->queued++] = p;
        if (!group->run) make_run(ensemble, group);
    }
}

/* ---- steps */

/* The work of forces over a step is integrated from states within it, which are not available. */
static void fail_within(struct ensemble *ensemble, const struct run *run)
{
    format_into(ensemble->own_reason, sizeof ensemble->own_reason,
                "between t = %.9g and t = %.9g the motion cannot be computed: the step is a rounding of the "
                "time, or a force has no value there",
                run->step.from, run->state->t);
    ensemble_fail(ensemble, FBD_FAILED, ensemble->own_reason);
}

/* One step of an island. A run that fails may have made none. */
static void step(struct ensemble *ensemble, size_t p)
{
    struct run *run = ensemble->groups[p].run;
    ensemble->stepping = true;
    size_t events = run->log.count;
    run_advance(run);
    for (; events < run->log.count && run->log.events[events].t < run->state->t; events++)
        if (run->log.events[events].t > run->step.from)
            ensemble->next_told = fmin(ensemble->next_told, run->log.events[events].t);
    const struct observer *observer = &ensemble->observer;
    if (observer->step && time_dd_since(run_end(run), run_start(run)) > 0 &&
        !observer->step(observer->context, ensemble, p))
        fail_within(ensemble, run);
    ensemble->stepping = false;
    if (run->end.outcome == FBD_OUT_OF_MEMORY) end_without_memory(ensemble);
}

static bool ended_early(const struct run *run)
{
    return run->end.outcome != FBD_GOING && run->end.outcome != FBD_DONE;
}

static void step_top(struct ensemble *ensemble)
{
    step(ensemble, ensemble->queue[0]);
    sift(ensemble, 0);
}

/* Advance the common time to t, with the events and ends there. due[0 .. count - 1] are the islands that may
 * have any. */
static void arrive(struct ensemble *ensemble, double t, size_t count)
{
    ensemble->t = t;
    ensemble->current = false;
    ensemble_release(ensemble, count);
    for (size_t i = 0; i < count; i++) {
        const struct run *run = ensemble->groups[ensemble->due[i]].run;
        if (run && ended_early(run) && run->state->t <= t)
            ensemble_fail(ensemble, run->end.outcome, run->end.reason);
    }
    if (ensemble->outcome == FBD_GOING && t >= ensemble->options.until) ensemble->outcome = FBD_DONE;
}

/* ---- step by step */

static int by_number(const void *a, const void *b)
{
    const size_t *first = a, *second = b;
    return *first < *second ? -1 : *first > *second;
}

/* List the islands below index i of the queue whose last steps end at t; returns the new count of `due`. */
static size_t list_due(struct ensemble *ensemble, size_t i, double t, size_t count)
{
    if (i >= ensemble->queued || end_of(ensemble, ensemble->queue[i]) > t) return count;
    ensemble->due[count++] = ensemble->queue[i];
    count = list_due(ensemble, 2 * i + 1, t, count);
    return list_due(ensemble, 2 * i + 2, t, count);
}

/* The time of an event of an island within its last step that is not logged yet. */
static double told_within(const struct group *group)
{
    const struct run *run = group->run;
    if (group->released == run->log.count) return HUGE_VAL;
    double t = run->log.events[group->released].t;
    return t > run->step.from && t < run->state->t ? t : HUGE_VAL;
}

static void find_next_told(struct ensemble *ensemble)
{
    ensemble->next_told = HUGE_VAL;
    for (size_t p = 0; p < ensemble->count; p++)
        ensemble->next_told = fmin(ensemble->next_told, told_within(&ensemble->groups[p]));
}

static void arrive_all(struct ensemble *ensemble, double t)
{
    for (size_t p = 0; p < ensemble->count; p++) ensemble->due[p] = p;
    arrive(ensemble, t, ensemble->count);
}

fbd_outcome ensemble_advance(struct ensemble *ensemble)
{
    if (ensemble->outcome == FBD_GOING) start(ensemble, false);
    if (ensemble->outcome != FBD_GOING) return ensemble->outcome;
    ensemble->from = ensemble->t;
    while (end_of(ensemble, ensemble->queue[0]) <= ensemble->from) {
        if (ensemble->groups[ensemble->queue[0]].run->end.outcome != FBD_GOING) break;
        step_top(ensemble);
    }
    double t = end_of(ensemble, ensemble->queue[0]);
    if (ensemble->next_told < t) {
        arrive_all(ensemble, ensemble->next_told);
        find_next_told(ensemble);
        return ensemble->outcome;
    }
    size_t count = list_due(ensemble, 0, t, 0);
    if (count > 1) qsort(ensemble->due, count, sizeof *ensemble->due, by_number);
    arrive(ensemble, t, count);
    return ensemble->outcome;
}

/* ---- ensemble_go */

/* The time at which the whole has to stop for this island: an event to log, or its end, if that is early. */
static double stop_of(const struct ensemble *ensemble, size_t p, bool pause)
{
    const struct group *group = &ensemble->groups[p];
    bool untold = pause && group->released < group->run->log.count;
    double within = untold ? told_within(group) : HUGE_VAL;
    return within < HUGE_VAL || !(untold || ended_early(group->run)) ? within : group->run->state->t;
}

/* Advance the queued islands; returns the time that can be reached. */
static double go_queued(struct ensemble *ensemble, double target, double near, bool pause)
{
    double stop = HUGE_VAL;
    for (size_t i = 0; i < ensemble->queued; i++)
        stop = fmin(stop, stop_of(ensemble, ensemble->queue[i], pause));
    while (ensemble->queued > 0 && ensemble->outcome == FBD_GOING && !ensemble->cut) {
        size_t p = ensemble->queue[0];
        if (end_of(ensemble, p) >= fmin(target, stop) || ended_early(ensemble->groups[p].run)) break;
        step_top(ensemble);
        stop = fmin(stop, stop_of(ensemble, p, pause));
    }
    if (ensemble->cut && ensemble->queued > 0) stop = fmin(stop, end_of(ensemble, ensemble->queue[0]));
    return stop <= target + near ? stop : target;
}

/* Advance a quiet island to `target`; where runs are freed at their ends, to the end if that takes few steps. */
static void go_alone(struct ensemble *ensemble, size_t p, double target)
{
    enum { few = 1000 };
    struct group *group = &ensemble->groups[p];
    double goal = ensemble_frees_runs(ensemble) ? ensemble->options.until : target;
    if (!group->run && end_of(ensemble, p) < target && !ensemble->cut) make_run(ensemble, group);
    if (ensemble->outcome != FBD_GOING) return;
    for (int steps = 0; group->run && group->run->end.outcome == FBD_GOING && !ensemble->cut; steps++) {
        if (end_of(ensemble, p) >= (steps < few ? goal : target)) break;
        step(ensemble, p);
    }
}

/* Advance the quiet islands; returns the time that can be reached, less than `target` when one fails or is
 * interrupted: a stiff one may need many steps. Islands beyond that time are integrated again. */
static double go_quiet(struct ensemble *ensemble, double target)
{
    for (size_t p = 0; p < ensemble->count && ensemble->outcome == FBD_GOING; p++) {
        struct group *group = &ensemble->groups[p];
        bool alone = ensemble->count == 1; /* several are advanced to one time, if possible */
        if (!group->quiet) continue;
        go_alone(ensemble, p, target);
        if (alone || ensemble->cut || (group->run && ended_early(group->run)))
            target = fmin(target, end_of(ensemble, p));
        if (group->run && group->run->end.outcome == FBD_DONE) ensemble_free_run(ensemble, group);
    }
    return target;
}

static void rewind_group(struct ensemble *ensemble, size_t p, double t)
{
    struct group *group = &ensemble->groups[p];
    make_run(ensemble, group);
    if (ensemble->outcome == FBD_OUT_OF_MEMORY) return;
    if (ensemble->observer.restart) ensemble->observer.restart(ensemble->observer.context, ensemble, p);
    while (group->run->end.outcome == FBD_GOING && end_of(ensemble, p) < t) step(ensemble, p);
}

void ensemble_rewind(struct ensemble *ensemble, double t)
{
    for (size_t p = 0; p < ensemble->count && ensemble->outcome != FBD_OUT_OF_MEMORY; p++) {
        const struct group *group = &ensemble->groups[p];
        if ((group->run ? group->run->step.from : group->past.t) > t) rewind_group(ensemble, p, t);
    }
}

static void end_cut(struct ensemble *ensemble)
{
    format_into(ensemble->own_reason, sizeof ensemble->own_reason, "interrupted at t = %.9g", ensemble->t);
    ensemble_fail(ensemble, FBD_INTERRUPTED, ensemble->own_reason);
    ensemble_rewind(ensemble, ensemble->t);
}

void ensemble_interrupt(struct ensemble *ensemble)
{
    ensemble->cut = true;
    if (!ensemble->stepping) end_cut(ensemble);
}

double ensemble_next_end(const struct ensemble *ensemble)
{
    double first = HUGE_VAL;
    for (size_t p = 0; p < ensemble->count; p++) first = fmin(first, end_of(ensemble, p));
    /* An island at t has to step before its end is known. */
    return first > ensemble->t ? first : nextafter(ensemble->t, HUGE_VAL);
}

/* The time until which an island has no event to log and needs no step. */
static double calm_until(const struct group *group)
{
    const struct run *run = group->run;
    if (!run) return group->past.t;
    if (ended_early(run)) return -HUGE_VAL;
    return group->released < run->log.count ? fmin(run->state->t, run->log.events[group->released].t)
                                            : run->state->t;
}

/* Avoid a loop over all islands for every row of output: with many islands of long steps it would dominate. */
static void find_calm(struct ensemble *ensemble)
{
    ensemble->calm = HUGE_VAL;
    for (size_t p = 0; p < ensemble->count; p++)
        ensemble->calm = fmin(ensemble->calm, calm_until(&ensemble->groups[p]));
}

bool ensemble_has_reached(const struct ensemble *ensemble, double t)
{
    if (ensemble->started && t < ensemble->calm) return true;
    for (size_t p = 0; p < ensemble->count; p++)
        if (end_of(ensemble, p) < t) return false;
    return true;
}

/* Advance every island that is behind to t, the target or an earlier time. */
static void go(struct ensemble *ensemble, double target, double near, bool pause)
{
    double queued = go_queued(ensemble, target, near, pause);
    double t = ensemble->queued < ensemble->count ? go_quiet(ensemble, queued) : queued;
    if (ensemble->outcome == FBD_GOING && !ensemble_frees_runs(ensemble)) ensemble_rewind(ensemble, t);
    if (ensemble->outcome != FBD_GOING) return; /* memory is out */
    ensemble->from = t;
    arrive_all(ensemble, t);
    if (ensemble->outcome != FBD_GOING) ensemble_rewind(ensemble, t);
    find_calm(ensemble);
}

fbd_outcome ensemble_go(struct ensemble *ensemble, double target, double near, bool pause)
{
    if (ensemble->outcome != FBD_GOING) return ensemble->outcome;
    start(ensemble, true);
    target = fmin(target, ensemble->options.until);
    if (target + near < ensemble->calm && !ensemble->cut) {
        ensemble->from = target;
        arrive(ensemble, target, 0);
    } else
        go(ensemble, target, near, pause);
    if (ensemble->cut && ensemble->outcome == FBD_GOING) end_cut(ensemble);
    return ensemble->outcome;
}
