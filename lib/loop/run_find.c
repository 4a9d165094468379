/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The first event within a step, and the state there.
 */
#include <gsl/gsl_errno.h>
#include <string.h>

#include "loop/contacts.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

/* The time until the zero of function i of the moving set, from its value and rate at an event; negative when
 * it has passed. */
static double time_left(const struct run *run, size_t i)
{
    double value = run->work.values[i], rate = run->work.values[run->search.moving.count + i];
    return rate < 0 && value < HUGE_VAL ? -value / rate : HUGE_VAL;
}

/* Events separated by rounding of the time are simultaneous. */
static double instant_at(double t)
{
    return round_off(64, fabs(t));
}

/* The state at t within the step, as if the step ended there: by a partial step, with prescribed motions
 * imposed, projected onto the couplings. Without the projection the error of a long step would displace
 * shapes about to touch, by much where a body lies almost flat. */
static bool end_at(struct run *run, double t)
{
    if (switcher_partial(run->stepper, time_dd_at(t), run->work.y, run->work.f) != GSL_SUCCESS) return false;
    impose_drives(run, t, run->work.y);
    project_within(run, t, run->work.y);
    return true;
}

/* Evaluate the functions at the state set by end_at. */
static void evaluate_at(struct run *run, double t)
{
    double *values = run->work.values, *rates = values + run->search.moving.count;
    if (watchers_evaluate_affine(&run->watchers, run->work.y, run->work.f, values, rates)) return;
    watchers_evaluate(&run->watchers, &run->watchers.moving, run->during, time_dd_at(t), run->work.y, NULL,
                      values, rates);
}

/* Set the functions at t; returns the size of the lowest one that crosses, and the time until the first zero. */
static bool look_near(struct run *run, double t, double *size, double *move)
{
    const struct scan *scan = &run->search.moving;
    double lowest = HUGE_VAL;
    if (!end_at(run, t)) return false;
    evaluate_at(run, t);
    *move = HUGE_VAL;
    for (size_t i = 0; i < scan->count; i++) {
        if (!scan->crossed[i]) continue;
        lowest = fmin(lowest, run->work.values[i]);
        *move = fmin(*move, time_left(run, i));
    }
    *size = fabs(lowest);
    return true;
}

/* Refine the time of the event that the scan has found, by partial steps with the full accuracy of the
 * method; the dense output may have less. Newton's method on the function that reaches zero first; y and f
 * are set to the result at *t + *move, where the move is of the size of a rounding if it has converged. Just
 * before a kink, as where one corner takes over from another that hardly moves, the slope leads away from the
 * zero: then its time is that of the dense output. */
static bool polish(struct run *run, double step_end, double *t, double *move)
{
    enum { most_steps = 4 };
    const struct scan *scan = &run->search.moving;
    double before = HUGE_VAL, last = *t, size;
    for (int step = 0;; step++) {
        if (!look_near(run, *t, &size, move)) return false;
        if (size > before) {
            *t = last;
            if (!look_near(run, *t, &size, move)) return false;
            *move = 0;
            break;
        }
        before = size;
        last = *t;
        double next = *t + *move;
        bool there = !(next > run->step.from && next < step_end) || fabs(*move) <= round_off(4, fabs(next));
        if (there || step == most_steps) break;
        *t = next;
    }
    /* Where Newton's method has moved far back, to the zero of another crossing function, the function that
     * was found has a later time. */
    const double far = 1e-4, share = 1e-3;
    double back = scan->t - *t;
    bool parted = fabs(*move) <= instant_at(*t) && back > far * (step_end - run->step.from);
    for (size_t i = 0; i < scan->count; i++) {
        double left = time_left(run, i);
        if (fabs(left) <= instant_at(*t)) scan->crossed[i] = true;
        if (parted && left > fmax(instant_at(*t), share * back)) scan->crossed[i] = false;
    }
    return true;
}

/* Does one of the functions that crossed decrease at t, to zero before the step ends? The dense output of a
 * low-order step may dip below zero where the function rises, as the velocity just after a breakaway, or may
 * stay above it; the state and rate at t, which are those of the motion and not of the interpolant, decide. */
static bool goes_down(const struct run *run, double t, double end)
{
    for (size_t i = 0; i < run->search.moving.count; i++) {
        double value = run->work.values[i], rate = run->work.values[run->search.moving.count + i];
        if (!run->search.moving.crossed[i] || rate > 0) continue;
        if (value <= 0 || t + time_left(run, i) <= end) return true;
    }
    return false;
}

/* Is one of them below zero at the end of the step? Then it has crossed, whatever the dense output shows. On
 * return y and f are those at t again. */
static bool is_down_at_end(struct run *run, double t, double end)
{
    const double *values = run->work.values;
    bool down = false;
    if (!end_at(run, end)) return true;
    evaluate_at(run, end);
    for (size_t i = 0; i < run->search.moving.count; i++)
        down |= run->search.moving.crossed[i] && values[i] < 0;
    return end_at(run, t) && down;
}

/* A function with kinks, such as the gap of the lowest of several corners, may have crossed before the first
 * zero found: it is below zero at that time. Sets *t to the first of all. False on failure. */
static bool look_before(struct run *run, double start, double *t, double *move)
{
    struct scan *scan = &run->search.moving;
    bool down = false;
    for (size_t i = 0; i < scan->count; i++)
        down |= run->work.values[i] < 0 && !(scan->crossed[i] && fabs(time_left(run, i)) <= instant_at(*t));
    if (!down) return true;
    memcpy(run->work.crossed, scan->crossed, scan->count * sizeof *run->work.crossed);
    double when = *t, others = *move;
    bool sooner = scan_interval(scan, start, *t) == 1 && scan->t < *t;
    if (sooner) *t = scan->t;
    if (sooner && !polish(run, when, t, move)) return false;
    if (sooner && *t < when) return true;
    memcpy(scan->crossed, run->work.crossed, scan->count * sizeof *run->work.crossed);
    *t = when;
    *move = others;
    return end_at(run, when);
}

/* Cut the step to t, without an event. 0, or -1 on failure. */
static int cut_step(struct run *run, struct time_dd t)
{
    return switcher_partial(run->stepper, t, run->work.y, run->work.f) == GSL_SUCCESS ? 0 : -1;
}

/* Cut a step that has passed a pole to a fixed fraction; the position of the pole is not determined. */
static int stay_before_poles(struct run *run, struct time_dd *t)
{
    const double share = 0.25;
    double h = time_dd_since(*t, run_start(run)), cut = run->step.from + share * h;
    if (run->options.step > 0 || !(cut > run->step.from)) return 0;
    if (!poles_passed(&run->poles, run->during, h, t->t, run->work.y, run->work.f)) return 0;
    *t = time_dd_at(cut);
    run->step.h = share * h;
    run->step.restart = true;
    return cut_step(run, *t);
}

/* The first panel of the search, for events that accumulate: about as long as the intervals between the last
 * ones, or the time since then; not so short that values are dominated by rounding. */
static double soon(const struct run *run, double length)
{
    const double intervals = 2, least_share = 1e-3;
    double last = fmax(run->recent.interval[0], run->recent.interval[1]);
    last = fmax(last, run->step.from - run->recent.moment.t);
    return fmax(intervals * last, least_share * length);
}

/* End the step before the event that cuts it, at *t, if its dense output, from which rows and works are computed, is not that
 * of a separate step: 1; else 0, with y and f unchanged, or -1. */
static int shorten_step(struct run *run, struct time_dd *t)
{
    const size_t bytes = plan_size(&run->model->plan) * sizeof *run->work.y;
    double *y = run->work.kept, *f = y + plan_size(&run->model->plan);
    int code = switcher_shorten(run->stepper, t, y, f);
    if (code != 1) return code == 0 ? 0 : -1;
    memcpy(run->work.y, y, bytes);
    memcpy(run->work.f, f, bytes);
    run->step.restart = true;
    trajectory_start(&run->trajectory);
    return 1;
}

/* Find the first event in (from, t] that changes the motion; on return *t is its time, with y and f there. 1
 * found, 0 none, -1 failed. Where the event functions vary so fast that the scan gives up, the step is cut to
 * the searched part; if it gives up at the very start, the function is round-off and not resolved further. A
 * function that dips below zero repeatedly, as the gaps of a pile that has just bounced do at round-off
 * level, cuts the step at the last dip; where that is at the very start the others are searched without it. */
static int find_change(struct run *run, struct time_dd *t)
{
    enum { most_dips = 8 };
    const double least_share = 1e-3;
    double start = run->step.from, end = t->t;
    run->search.moving.aside = false;
    run->search.moving.soon = soon(run, end - start);
    scan_start(&run->search.moving);
    for (int dip = 0; start < end; dip++) {
        if (dip == most_dips &&
            (start - run->step.from > instant_at(start) || !scan_leave_out(&run->search.moving)))
            break;
        dip %= most_dips;
        int found = scan_interval(&run->search.moving, start, end);
        if (run->search.moving.resolved < HUGE_VAL)
            run->step.h = fmin(run->step.h, run->search.moving.resolved);
        if (found <= 0) return found;
        if (found == 2) {
            if (run->search.moving.clear - run->step.from < least_share * (end - run->step.from)) return 0;
            *t = time_dd_at(run->search.moving.clear);
            run->step.restart = true;
            return cut_step(run, *t);
        }
        double when = run->search.moving.t, move;
        if (when >= end) return 1;
        if (!polish(run, end, &when, &move) || !look_before(run, start, &when, &move)) return -1;
        if (goes_down(run, when, end) || is_down_at_end(run, when, end)) {
            struct time_dd before = time_dd_at(when);
            const int shorter = shorten_step(run, &before);
            if (shorter < 0) return -1;
            if (shorter > 0) {
                *t = before;
                return find_change(run, t);
            }
            *t = run_pin_moving(run, when, move, *t);
            return 1;
        }
        if (cut_step(run, *t) < 0) return -1;
        scan_pass_over(&run->search.moving);
        start = fmax(when, run->search.moving.t);
    }
    if (!(start < end) || start - run->step.from <= instant_at(start)) return 0;
    *t = time_dd_at(start); /* no event up to here; not searched beyond */
    run->step.restart = true;
    return cut_step(run, *t);
}

/* Log the user events in (from, t]. They are searched after the length of the step is decided, and change
 * nothing in it, so that a run with them equals one without to the bit. One that ends the run cuts the step:
 * 1, else 0; -1 failed. With too many of them, as in the steps of a method that fails, the step is cut to the
 * searched part, so that the caller of the run regains control: 2. */
static int find_told(struct run *run, struct time_dd *t)
{
    enum { most_dips = 8, most_told = 10000 };
    double start = run->step.from, end = t->t;
    int told = 0;
    run->search.moving.aside = true;
    scan_start(&run->search.moving);
    for (int dip = 0; dip < most_dips && start < end;) {
        int found = scan_interval(&run->search.moving, start, end);
        if (found != 1) return found < 0 ? -1 : 0;
        double when = run->search.moving.t, move = 0;
        if (when < end && !polish(run, end, &when, &move)) return -1;
        bool passed = when >= end || goes_down(run, when, end) || is_down_at_end(run, when, end);
        if (passed && !log_user_events(run, when)) {
            if (when < end) *t = run_pin_moving(run, when, move, *t);
            return 1;
        }
        if (!passed) scan_pass_over(&run->search.moving);
        dip += !(passed && when > start);
        start = passed ? when : fmax(when, run->search.moving.t);
        told += passed;
        if (told < most_told || !(start < end)) continue;
        *t = time_dd_at(start);
        run->step.restart = true;
        return cut_step(run, *t) < 0 ? -1 : 2;
    }
    return 0;
}

int run_find_event(struct run *run, struct time_dd *t)
{
    if (stay_before_poles(run, t) < 0) return -1;
    trajectory_start(&run->trajectory);
    run_wake_contacts(run, t->t);
    return find_change(run, t);
}

int run_tell_events(struct run *run, struct time_dd *t, int change)
{
    if (run->model->plan.watch_count == 0) return change;
    size_t size = plan_size(&run->model->plan), bytes = size * sizeof *run->work.y;
    memcpy(run->work.kept, run->work.y, bytes);
    memcpy(run->work.kept + size, run->work.f, bytes);
    memcpy(run->work.crossed, run->search.moving.crossed,
           run->search.moving.count * sizeof *run->work.crossed);
    int told = find_told(run, t);
    if (told != 0) return told == 2 ? 0 : told;
    memcpy(run->work.y, run->work.kept, bytes);
    memcpy(run->work.f, run->work.kept + size, bytes);
    memcpy(run->search.moving.crossed, run->work.crossed,
           run->search.moving.count * sizeof *run->work.crossed);
    return change;
}

/* The time until the state is past switches that are a rounding of the time away; flags these as crossed
 * moving functions. */
static double time_to_brink(struct run *run, struct fbd_state *modes, double most)
{
    const struct watcher_set *set = &run->watchers.moving;
    double longest = -1;
    watchers_evaluate(&run->watchers, set, modes, state_moment(run->state), run->state->y, NULL,
                      run->work.values, run->work.values + set->count);
    for (size_t i = 0; i < set->count; i++) {
        double left = time_left(run, i);
        bool near = set->watchers[i].kind == watch_kink && left >= 0 && left <= most;
        run->search.moving.crossed[i] = near;
        if (near) longest = fmax(longest, left);
    }
    return longest;
}

static void go_on_by(struct run *run, double time, const double *slopes)
{
    for (size_t i = 0; i < plan_size(&run->model->plan); i++) run->state->y[i] += time * slopes[i];
    run->stale = true;
}

bool run_pass_brink(struct run *run)
{
    double most = fmax(instant_at(run->state->t), run->step.h);
    run_evaluate(run);
    double left = time_to_brink(run, run->state, most);
    if (left < 0) return false;
    go_on_by(run, 2 * left, state_flow(run->state, run->work.sample).dy);
    return true;
}

void step_past_switch(struct run *run)
{
    double probe = 0;
    for (size_t i = 0; i < plan_rates(&run->model->plan); i++) probe += 0 * run->state->a[i];
    double left = probe == 0 ? -1 : time_to_brink(run, run->during, instant_at(run->state->t));
    if (left < 0) return;
    go_on_by(run, 2 * left, run->work.f);
    run_evaluate(run);
}
