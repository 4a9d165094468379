/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Times of events in double-double arithmetic, from a double near them; and different steps for runs whose
 * errors are compared.
 */
#include <float.h>
#include <math.h>

#include "loop/run.h"
#include "numeric/tolerances.h"

/* Distance of a double from a zero found by the search, in roundings. */
static const double near = 64;

/* A time before the end of the run whose nearest double may be the end: represent it by the double before. */
static struct time_dd before_end(struct time_dd t, double until)
{
    if (t.t < until) return t;
    double before = nextafter(until, -HUGE_VAL);
    return (struct time_dd){before, time_dd_since(t, time_dd_at(before))};
}

/* The resolution of double-double times. */
static double resolution(double t)
{
    return DBL_EPSILON * DBL_EPSILON * fabs(t);
}

/* The earliest time after this one, for an event at the begin of a step: the smallest difference in
 * double-double arithmetic by which implicit methods can divide. */
static struct time_dd at_once(struct time_dd start)
{
    double least = start.t == 0 ? DBL_MIN / DBL_EPSILON : resolution(start.t);
    return (struct time_dd){start.t, nextafter(start.rest + least, HUGE_VAL)};
}

/* ---- functions of time that are affine */

/* Each function a + b t has one zero, from present values and rates: note the first one, and those that are zero to the
 * rounding of that time. It remains until the branches change. */
static void note_first_zero(struct run *run)
{
    struct scan *scan = &run->search.timed;
    double *values = run->work.values, *rates = values + scan->count, *roundings = rates + scan->count;
    struct time_dd now = run_end(run);
    watchers_evaluate_timed(&run->watchers, run->during, now, values, rates, roundings);
    double first = HUGE_VAL;
    for (size_t i = 0; i < scan->count; i++) {
        bool ahead = rates[i] < 0 && values[i] > 0;
        values[i] = ahead ? values[i] / -rates[i] : HUGE_VAL;
        first = fmin(first, values[i]);
    }
    scan->t = time_dd_after(now, first).t;
    for (size_t i = 0; i < scan->count; i++)
        scan->crossed[i] = values[i] < HUGE_VAL && values[i] - first <= round_off(near, fabs(scan->t));
}

/* Has a function whose zero rounds to this time crossed there? */
static bool has_crossed(struct run *run, double t)
{
    const struct scan *scan = &run->search.timed;
    double *values = run->work.values, *rates = values + scan->count, *roundings = rates + scan->count;
    watchers_evaluate_timed(&run->watchers, run->during, time_dd_at(t), values, rates, roundings);
    bool crossed = false;
    for (size_t i = 0; i < scan->count; i++) crossed |= scan->crossed[i] && values[i] < 0;
    return crossed;
}

int run_find_timed(struct run *run, double to)
{
    struct scan *scan = &run->search.timed;
    if (scan->count == 0) return 0;
    if (!run->watchers.timed_affine) return scan_interval(scan, run->state->t, to);
    if (!run->search.knows_timed) note_first_zero(run);
    run->search.knows_timed = true;
    return scan->t < to || (scan->t == to && has_crossed(run, to));
}

/* Functions that are zero at the same time, to the rounding of their values, are simultaneous. */
static void drop_later(struct run *run, struct time_dd t)
{
    const struct scan *scan = &run->search.timed;
    double *values = run->work.values, *rates = values + scan->count, *roundings = rates + scan->count;
    size_t count = 0;
    for (size_t i = 0; i < scan->count; i++) count += scan->crossed[i];
    if (count < 2) return;
    watchers_evaluate_timed(&run->watchers, run->during, t, values, rates, roundings);
    for (size_t i = 0; i < scan->count; i++)
        if (scan->crossed[i] && rates[i] < 0 && values[i] > roundings[i]) scan->crossed[i] = false;
}

/* The time at which the first of the functions that crossed is zero, by Newton's method from a double: values
 * include their low parts, so only the curvature over some roundings of the time is left to a second
 * iteration. A function with zero slope there keeps the time of the search. */
struct time_dd run_pin_timed(struct run *run)
{
    enum { steps = 3 };
    const struct scan *scan = &run->search.timed;
    double *values = run->work.values, *rates = values + scan->count, *roundings = rates + scan->count;
    struct time_dd start = run_end(run), t = time_dd_at(scan->t);
    for (int step = 0; step < steps; step++) {
        double move = HUGE_VAL;
        watchers_evaluate_timed(&run->watchers, run->during, t, values, rates, roundings);
        for (size_t i = 0; i < scan->count; i++)
            if (scan->crossed[i] && rates[i] < 0) move = fmin(move, -values[i] / rates[i]);
        if (!(fabs(move) <= round_off(near, fabs(scan->t)))) break;
        if (fabs(move) <= resolution(scan->t)) break;
        struct time_dd next = time_dd_after(t, move);
        if (time_dd_since(next, start) <= 0) next = at_once(start);
        t = next;
    }
    if (time_dd_since(time_dd_at(run->options.until), t) <= 0) t = time_dd_at(run->options.until);
    drop_later(run, t);
    return t.t == run->options.until && t.rest == 0 ? t : before_end(t, run->options.until);
}

double run_time_to_switch(struct run *run)
{
    struct time_dd end = time_dd_at(run->options.until);
    bool found = run_find_timed(run, end.t) == 1;
    return time_dd_since(found ? run_pin_timed(run) : end, run_end(run));
}

/* Over a rounding of the time the motion is linear. */
struct time_dd run_pin_moving(struct run *run, double t, double move, struct time_dd end)
{
    struct time_dd there = time_dd_after(time_dd_at(t), move);
    bool is_near = fabs(move) <= round_off(near, fabs(t));
    if (!is_near || !(time_dd_since(there, run_start(run)) > 0 && time_dd_since(end, there) > 0))
        return time_dd_at(t);
    for (size_t i = 0; i < plan_size(&run->model->plan); i++) run->work.y[i] += move * run->work.f[i];
    return before_end(there, run->options.until);
}

/* ---- independent steps (options.apart)
 *
 * Where every step ends at the next event, two runs of different tolerances make the same steps, with the
 * same errors: of the method, and of rounding, which is the only error of an exact one. A run with
 * options.apart makes two steps between events: halves have 2^-p of the error. Likewise where there are few
 * steps in all: its steps are shorter than those of the main run (step.most). The next event that depends on
 * time alone is known; for others the longer one of the last two intervals is used: after a short one (a
 * pulse, a stop) steps would have to grow again. */

static const double share = 0.6; /* of the interval; the stepper halves the rest */

void desync_steps(struct run *run)
{
    if (!run->options.apart || run->options.step > 0) return;
    double since = time_dd_since(run_start(run), run->recent.moment),
           interval = fmax(run->recent.interval[0], run->recent.interval[1]);
    if (interval > 0) run->step.h = fmin(run->step.h, share * interval + since);
    if (run->step.most > 0) run->step.h = fmin(run->step.h, run->step.most);
}

void desync_steps_from(struct run *run, struct time_dd limit)
{
    if (!run->options.apart || run->options.step > 0 || !time_dd_equal(run_start(run), run->recent.moment))
        return;
    run->step.h = fmin(run->step.h, share * time_dd_since(limit, run_start(run)));
}
