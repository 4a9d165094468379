/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Messages for runs that end early, in terms of the scene: time, body, quantity and advice.
 */
#include <gsl/gsl_errno.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/format.h"
#include "loop/run.h"
#include "numeric/tolerances.h"
#include "rest/fit.h"
#include "rest/start.h"

void run_fail(struct run *run, fbd_outcome outcome, const char *format, ...)
{
    if (run->end.outcome != FBD_GOING && run->end.outcome != FBD_STOPPED) return; /* keep the first reason */
    run->end.outcome = outcome;
    char *reason = arena_take(run->memory, reason_size, 1, false);
    run->end.reason = reason ? reason : "out of memory";
    if (!reason) return;
    va_list args;
    va_start(args, format);
    /* NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): it is, a line above */
    format_list(reason, reason_size, format, args);
    va_end(args);
}

double run_time(const struct run *run)
{
    const double nothing = 1e-20;
    return fabs(run->state->t) < nothing * run->step.first ? 0 : run->state->t;
}

double run_instant(const struct run *run)
{
    const double instant = negligible_sum, steps = 1e6;
    return instant * fmax(fabs(run->state->t), fmin(run->options.until, steps * run->step.longest));
}

const char *run_kink_name(const struct run *run, const struct kink *kink)
{
    if (kink->load >= 0) return run->model->loads[kink->load].source->name;
    return kink->own >= 0 ? run->model->scene->own[kink->own].name : NULL;
}

static const char *body_of(const struct run *run, size_t element)
{
    size_t n = (size_t)run->model->plan.n;
    const struct scene *scene = run->model->scene;
    if (element >= 2 * n) return scene->own[element - 2 * n].name;
    return run->model->bodies[scene->coordinates[element % n].body].name;
}

/* The coordinate or state with the largest relative rate: that of a solution that diverges. */
static size_t fastest(const struct run *run)
{
    size_t n = (size_t)run->model->plan.n, worst = 0;
    double most = -1;
    for (size_t i = 0; i < n; i++) {
        double v = fabs(run->work.y[n + i]), a = fabs(run->work.f[n + i]), rate = v > 0 ? a / v : 0;
        if (rate > most) most = rate, worst = i;
    }
    for (size_t i = 2 * n; i < plan_size(&run->model->plan); i++) {
        double z = fabs(run->work.y[i]), rate = z > 0 ? fabs(run->work.f[i]) / z : 0;
        if (rate > most) most = rate, worst = i;
    }
    return worst;
}

/* A rope that will be blocked by its pulley within a millionth of the run: its tension has no direction
 * there. */
static bool explain_blocked_rope(struct run *run)
{
    const double ahead = distinct_part * fmin(run->options.until, fabs(run->state->t));
    size_t n = (size_t)run->model->plan.n;
    struct fbd_state *next = state_new(run->model);
    struct text why = {0};
    if (next) {
        state_copy(next, run->state);
        for (size_t i = 0; i < n; i++) next->y[i] += ahead * next->y[n + i];
    }
    bool blocked = next && fit_blocked(next, NULL, &why) && !why.failed;
    if (blocked)
        run_fail(run, FBD_FAILED,
                 "at t = %.9g a rope reaches its pulley: %s, or end the run earlier by an event",
                 run_time(run), why.data);
    text_free(&why);
    state_free(next);
    return blocked;
}

static void explain_not_finite(struct run *run)
{
    if (explain_blocked_rope(run)) return;
    size_t n = (size_t)run->model->plan.n, element = run->system.last_element % plan_size(&run->model->plan);
    const char *what = isnan(run->system.last_value)
                           ? "an expression leaves its domain there (a root or logarithm of a negative "
                             "number, 0/0, beyond the end of a table, thresholds of `hysteresis` that cross)"
                           : "it is beyond the largest number (a division by zero, or an overflow)";
    if (element >= 2 * n) {
        run_fail(run, FBD_FAILED,
                 "the rate of the state `%s` is not finite at t = %.9g, just beyond the last good state at t "
                 "= %.9g: %s. "
                 "End the run before by an event, or restrict the expression",
                 run->model->scene->own[element - 2 * n].name, run->system.last_time, run_time(run), what);
        return;
    }
    run_fail(
        run, FBD_FAILED,
        "a force on `%s` is not finite at t = %.9g, just beyond the last good state at t = %.9g: %s. End the "
        "run before by an event, or restrict the expression",
        body_of(run, element), run->system.last_time, run_time(run), what);
}

void run_fail_pole(struct run *run, const struct pole *pole)
{
    const struct fbd_model *model = run->model;
    if (pole->own >= 0) {
        run_fail(run, FBD_FAILED,
                 "at t = %.9g the rate of the state `%s` divides by zero, to the rounding of the time: it is "
                 "infinite "
                 "there. End the run before by an event, or bound the rate",
                 run_time(run), model->scene->own[pole->own].name);
        return;
    }
    const struct load *load = model->loads[pole->load].source;
    if (load->kind == load_carried) {
        run_fail(run, FBD_BROKEN,
                 "at t = %.9g the mass of `%s` reaches zero, and its acceleration has no bound. End the run "
                 "earlier by an event, or keep some mass: `max(..., 2[kg])`",
                 run_time(run), model->bodies[pole->body].name);
        return;
    }
    if (load->toward && pole->formula.expr == load->angle.expr) {
        run_fail(
            run, FBD_FAILED,
            "at t = %.9g `%s` of `%s` acts at the very point that it is directed to (%s), to the rounding "
            "of the time: it has no direction there. End the run before by an event",
            run_time(run), load->name, model->bodies[pole->body].name, load->toward);
        return;
    }
    if (load->zero_distance.expr && pole->formula.expr == load->zero_distance.expr) {
        run_fail(run, FBD_FAILED,
                 "at t = %.9g the two points of the actuator `%s` meet, to the rounding of the time: its "
                 "force has no direction there. End the run before by an event, or give it a direction by "
                 "`along`",
                 run_time(run), load->name);
        return;
    }
    run_fail(
        run, FBD_FAILED,
        "at t = %.9g `%s` of `%s` divides by zero, to the rounding of the time: the force is infinite there, "
        "and rounding decides how the motion continues. End the run earlier by an event, or bound the force",
        run_time(run), load->name, model->bodies[pole->body].name);
}

void run_fail_step(struct run *run, enum stepper_status status)
{
    const struct stepper_counts counts = switcher_counts(run->stepper);
    /* Before an underflow of the step size the last attempts may have been rejected for their error only,
     * near the same point. */
    bool not_finite = run->system.last_code == system_not_finite ||
                      counts.rejected[rejected_not_finite] > run->step.not_finite;
    if (status == stepper_no_memory) {
        run_fail(run, FBD_OUT_OF_MEMORY, "out of memory");
    } else if (status == stepper_misuse) {
        run_fail(run, FBD_FAILED, "the method `%s` cannot be used here", run->options.method->name);
    } else if (not_finite) {
        explain_not_finite(run);
    } else if (counts.last == rejected_iteration) {
        run_fail(
            run, FBD_FAILED,
            "at t = %.9g the implicit equations of `%s` were not solved (body `%s`): the motion may run away "
            "there, or the method be at its end. Try another one",
            run_time(run), run->options.method->name, body_of(run, fastest(run)));
    } else {
        run_fail(run, FBD_FAILED,
                 "the step size underflows at t = %.9g: `%s` moves ever faster, as towards a singular point, "
                 "and no step is "
                 "small enough. End the run before by an event, or look for a missing force",
                 run_time(run), body_of(run, fastest(run)));
    }
}

void run_fail_progress(struct run *run, double gain)
{
    run_fail(
        run, FBD_FAILED,
        "at t = %.9g the run makes no progress: its steps of the last seconds of computing time advanced by "
        "%.3g s. `%s` moves the fastest there. A motion in the scene is much faster than the rest, or forces "
        "alternate: end the run earlier by an event, or try a larger tolerance or `--method "
        "rodas5p`",
        run_time(run), gain, body_of(run, fastest(run)));
}

void run_fail_chatter_of(struct run *run, int load, bool state, const char *name)
{
    run_fail(run, FBD_FAILED,
             "at t = %.9g events chatter: `%s` changes again and again while hardly any time passes. %s",
             run_time(run), name,
             state ? "A rate that jumps against its state leaves it no way on: give it two thresholds, "
                     "`hysteresis`, or a slope between"
                   : unsettled_advice(run->model, load));
}

void run_fail_chatter(struct run *run)
{
    static const struct run_event nothing = {.load = -1, .watch = -1, .own = -1};
    const struct run_event *event = run->log.count > 0 ? &run->log.events[run->log.count - 1] : &nothing;
    const char *name = event->load >= 0    ? run->model->loads[event->load].source->name
                       : event->watch >= 0 ? run->model->plan.watches[event->watch].source->name
                       : event->own >= 0   ? run->model->scene->own[event->own].name
                                           : "an expression";
    run_fail_chatter_of(run, event->load, event->own >= 0, name);
}
