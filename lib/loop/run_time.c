/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From a double next to an event to its moment; and what two runs that compare their errors may not share.
 */
#include <float.h>
#include <math.h>

#include "loop/run.h"

/* What a double may be away from a zero that has been searched for, in roundings. */
static const double near = 64;

/* A moment before the end of the run, that the double next to it may be: what is told of it has to come
 * before. */
static struct time_dd before_end(struct time_dd t, double until)
{
    if (t.t < until) return t;
    double before = nextafter(until, -HUGE_VAL);
    return (struct time_dd){before, time_dd_since(t, time_dd_at(before))};
}

/* The first moment after this one: what happens where a step begins has to wait for time to pass. As long as
 * two doubles can tell, and so that implicit methods can divide by it. */
static struct time_dd at_once(struct time_dd start)
{
    double least = start.t == 0 ? DBL_MIN / DBL_EPSILON : DBL_EPSILON * DBL_EPSILON * fabs(start.t);
    return (struct time_dd){start.t, nextafter(start.rest + least, HUGE_VAL)};
}

/* The moment at which the first of the functions that crossed is zero, by Newton from a double: the values
 * keep their rests, so nothing but the curvature of a function over some roundings of the time is left to a
 * second step. A function without a slope there stays where the search has seen it. */
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
        if (!(fabs(move) <= near * DBL_EPSILON * fabs(scan->t))) break;
        struct time_dd next = time_dd_after(t, move);
        if (time_dd_since(next, start) <= 0) next = at_once(start);
        t = next;
    }
    if (time_dd_since(time_dd_at(run->options.until), t) <= 0) t = time_dd_at(run->options.until);
    /* Those that are zero at the same moment, to the rounding of their values, happen together. */
    watchers_evaluate_timed(&run->watchers, run->during, t, values, rates, roundings);
    for (size_t i = 0; i < scan->count; i++)
        if (scan->crossed[i] && rates[i] < 0 && values[i] > roundings[i]) scan->crossed[i] = false;
    return t.t == run->options.until && t.rest == 0 ? t : before_end(t, run->options.until);
}

double run_time_to_switch(struct run *run)
{
    struct time_dd end = time_dd_at(run->options.until);
    bool found = scan_interval(&run->search.timed, run->state->t, end.t) == 1;
    return time_dd_since(found ? run_pin_timed(run) : end, run_end(run));
}

/* The motion over a rounding of the time is a line. */
struct time_dd run_pin_moving(struct run *run, double t, double move, struct time_dd end)
{
    struct time_dd there = time_dd_after(time_dd_at(t), move);
    bool is_near = fabs(move) <= near * DBL_EPSILON * fabs(t);
    if (!is_near || !(time_dd_since(there, run_start(run)) > 0 && time_dd_since(end, there) > 0))
        return time_dd_at(t);
    for (size_t i = 0; i < plan_size(&run->model->plan); i++) run->work.y[i] += move * run->work.f[i];
    return before_end(there, run->options.until);
}

/* ---- apart
 *
 * Where events come so often that every step ends at the next one, two runs of different tolerances make the
 * same steps, and with the same errors: of the method, and of rounding, which is all that an exact one has.
 * One that is to be apart makes two steps from each event to the next: halves have a 2^-p of the error. Likewise where
 * there are few steps in all: its steps are shorter than those that it is to be told from (step.most). The
 * next event of time alone is known; for others the last intervals tell, of which the longer one counts:
 * after a short one (a pulse, a stop) steps would have to grow again. */

static const double share = 0.6; /* of the way; the stepper makes the rest of it in halves */

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
