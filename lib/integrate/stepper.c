/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/stepper.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "integrate/error_norm.h"
#include "integrate/first_step.h"
#include "integrate/linear.h"
#include "integrate/pair8.h"
#include "integrate/rodas5p.h"
#include "integrate/stepper_state.h"
#include "integrate/stiffness.h"
#include "numeric/tolerances.h"

/* Not by gsl_odeiv2_step_alloc, which calls GSL's error handler when memory is out; the methods of GSL
 * (method.c) still do. */
static gsl_odeiv2_step *step_alloc(const struct method *method, size_t n, const gsl_odeiv2_driver *driver)
{
    gsl_odeiv2_step *step = malloc(sizeof *step);
    void *state = step ? (*method->type)->alloc(n) : NULL;
    if (!state) {
        free(step);
        return NULL;
    }
    *step = (gsl_odeiv2_step){.type = *method->type, .dimension = n, .state = state};
    if (method->needs_driver) step->type->set_driver(state, driver);
    return step;
}

static struct stepper *state_alloc(size_t n)
{
    enum { vectors = 8 };
    if (n == 0 || n > (SIZE_MAX - sizeof(struct stepper)) / (vectors * sizeof(double))) return NULL;
    struct stepper *s = block_alloc(sizeof *s + vectors * n * sizeof(double));
    if (!s) return NULL;
    s->n = n;
    s->y0 = s->memory;
    s->f0 = s->y0 + n;
    s->y1 = s->f0 + n;
    s->f1 = s->y1 + n;
    s->yerr = s->f1 + n;
    s->work = s->yerr + n;
    return s;
}

/* Largest dimension for which a Jacobian limits the steps of an explicit method. */
enum { most_guarded = 200 };

/* Is the dense output of this method made by repeated steps? So it is for implicit methods without an
 * interpolant, and for explicit ones with components outside the pairs, for which dense.h is too inaccurate
 * over such long steps: at a tolerance of 1e-9 the current of a motor was off by 1e-5 within steps of rk8pd,
 * a state that oscillates by 2e-6 within those of rk4. */
static bool redoes_inside(const struct method *method, const struct layout *layout)
{
    if (method->implicit) return *method->type != step_rodas5p;
    return *method->type != step_dop853 && layout->extra > 0;
}

struct stepper *stepper_alloc(const struct stepper_options *options)
{
    const struct method *method = options->method;
    if (!(options->tolerance > 0) || !(options->h_max >= 0) || !(options->h_fixed >= 0)) return NULL;
    struct stepper *s = state_alloc(layout_size(&options->layout));
    if (!s) return NULL;
    s->method = method;
    s->layout = options->layout;
    s->layout.angle = NULL;
    s->h_max = options->h_max > 0 ? options->h_max : INFINITY;
    s->h_fixed = options->h_fixed;
    struct step_law law = step_law_for(method->estimate_order);
    law.by_time = method->by_time;
    s->control = error_norm_alloc(&options->layout, options->tolerance, law);
    s->driver = (gsl_odeiv2_driver){.c = s->control};
    s->dense = dense_alloc(&options->layout);
    s->step = step_alloc(method, s->n, &s->driver);
    bool redo = !method->multistep && !method->exact, history = method->multistep && method->implicit;
    bool inside = redo && redoes_inside(method, &options->layout);
    if (redo) s->redo = step_alloc(method, s->n, &s->driver);
    s->substeps = redo ? substeps_alloc(s->n) : NULL;
    if (history) s->history = history_alloc(s->n);
    if (inside) s->inside = resteps_alloc(s->n);
    bool guarded = method->stable > 0 && s->n <= most_guarded;
    if (guarded) s->jacobian = malloc((s->n * s->n + 3 * s->n) * sizeof(double));
    if (!s->control || !s->dense || !s->step || (redo && !(s->redo && s->substeps)) ||
        (history && !s->history) || (inside && !s->inside) || (guarded && !s->jacobian)) {
        stepper_free(s);
        return NULL;
    }
    if (method->multistep) dense_set_errors(s->dense, s->yerr);
    return s;
}

void stepper_free(struct stepper *s)
{
    if (!s) return;
    if (s->redo) gsl_odeiv2_step_free(s->redo);
    if (s->step) gsl_odeiv2_step_free(s->step);
    if (s->control) gsl_odeiv2_control_free(s->control);
    dense_free(s->dense);
    history_free(s->history);
    resteps_free(s->inside);
    substeps_free(s->substeps);
    free(s->jacobian);
    free(s);
}

/* Forget all steps; false without time to the limit. */
static bool forget_steps(struct stepper *s, struct time_dd t, struct time_dd t_limit)
{
    s->stepped = false;
    s->stable_h = s->rate = 0;
    if (!(time_dd_since(t_limit, t) > 0)) return false;
    gsl_odeiv2_step_reset(s->step);
    if (s->redo) gsl_odeiv2_step_reset(s->redo); /* rodas5p keeps a Jacobian */
    return true;
}

int stepper_restart(struct stepper *s, struct time_dd t, const double *y, const double *f,
                    struct time_dd t_limit, double *h)
{
    if (!forget_steps(s, t, t_limit)) return GSL_EINVAL;
    error_norm_update(s->control, y, f);
    *h = fmin(time_dd_since(t_limit, t), s->h_max);
    return GSL_SUCCESS;
}

int stepper_reset(struct stepper *s, struct counted_system *system, struct time_dd t, const double *y,
                  double *f, struct time_dd t_limit, double *h)
{
    double room = time_dd_since(t_limit, t);
    if (!forget_steps(s, t, t_limit)) return GSL_EINVAL;
    int code = counted_system_rhs(system, t.t, y, f);
    if (code != GSL_SUCCESS) return code;
    error_norm_update(s->control, y, f);
    if (s->history) {
        history_clear(s->history);
        history_add(s->history, t.t, y);
    }
    if (s->h_fixed > 0 || s->method->exact) {
        *h = s->h_fixed > 0 ? s->h_fixed : fmin(room, s->h_max);
        return GSL_SUCCESS;
    }
    int order = s->method->multistep ? 1 : s->method->order; /* initial order */
    return first_step(system, &s->layout, s->control, order, t.t, y, f, fmin(room, s->h_max), s->work, h);
}

/* A step to be tried. */
struct plan {
    double asked;      /* size before t1 was rounded; it shrinks from retry to retry */
    double h;          /* its size */
    struct time_dd t1; /* and end */
    bool cut;          /* limited by t_limit */
};

/* Does the remaining time span a few doubles only? Steps within a pulse of that length end between doubles. */
static bool is_between_doubles(struct time_dd t, double room)
{
    return room <= round_off(time_roundings, fabs(t.t));
}

static struct plan plan_step(const struct stepper *s, struct time_dd t, double h, struct time_dd t_limit)
{
    double room = time_dd_since(t_limit, t);
    if (1.01 * h >= room) return (struct plan){room, room, t_limit, true};
    if (s->h_fixed > 0) return (struct plan){h, h, time_dd_at(t.t + h), false};
    bool half = 2 * h > room;
    if (half) h = room / 2;
    if (is_between_doubles(t, room)) return (struct plan){h, h, time_dd_after(t, h), half};
    struct time_dd t1 = time_dd_at(t.t + h);
    /* The size that corresponds to the rounded t1, so that t and the stages agree. Multistep methods keep a
     * constant step instead. */
    return (struct plan){h, s->method->multistep ? h : time_dd_since(t1, t), t1, half};
}

/* Is the step so short that t does not change? If the remaining time spans a few doubles, or t = 0, shorter
 * steps always exist; then compare with the remaining time. */
static bool is_nothing(const struct plan *plan, struct time_dd t, double room)
{
    return (!is_between_doubles(t, room) && t.t + plan->h == t.t) || !(plan->h > least_step * room);
}

/* Result of an attempt. */
struct outcome {
    bool accepted;
    enum rejection why; /* reason of a rejection */
    double factor;      /* for the next step size */
};

static struct outcome judge_failure(const struct stepper *s, const struct counted_system *system)
{
    if (system->last_code == system_not_finite) return (struct outcome){false, rejected_not_finite, 0.25};
    if (system->last_code != GSL_SUCCESS) return (struct outcome){false, rejected_rhs, 0.5};
    if (s->method->implicit || s->method->multistep) return (struct outcome){false, rejected_iteration, 0.5};
    return (struct outcome){false, rejected_not_finite, 0.25};
}

/* Limit the step by stability. Near the limit, h |lambda| = 5 or 6, a step of rk8pd or dop853 may by chance
 * end accurately while its dense output is off by many times the tolerance. Measured where a motion settles
 * down (terminal speed, drag, an overdamped spring) and tolerances of 1e-4 to 1e-12: without this the dense
 * output errs by up to 460 tolerances; with a limit of 4 by at most 24, in as many steps, with fewer
 * rejections and more accurate ends. Oscillations that are followed have h w < 2. */
static struct outcome keep_stable(struct stepper *s, double h, const double *y, struct outcome outcome)
{
    const double most = 5, goal = 4, kept = 0.9;
    const double *dy, *df;
    if (!outcome.accepted || s->h_fixed > 0 || !pair8_differences(s->step, &dy, &df)) return outcome;
    /* The rate estimated from the differences varies from step to step. */
    s->rate = fmax(error_norm_rate(s->control, y, dy, df), kept * s->rate);
    double h_rate = h * s->rate;
    if (h_rate > most) return (struct outcome){false, rejected_error, fmax(goal / h_rate, 0.1)};
    if (h_rate * outcome.factor > goal) outcome.factor = goal / h_rate;
    return outcome;
}

/* The same for GSL's methods, which have no such differences and whose estimates may vanish by accident
 * beyond the limit: rk4 at a tolerance of 1e-6 passed a terminal speed with twice the stable step and was off
 * by 3700 tolerances. So the limit is taken from the Jacobian, which is evaluated when a step is longer than
 * the last limit, and every 16 steps. */
static struct outcome guard_stability(struct stepper *s, struct counted_system *system, double h, double t,
                                      const double *y, struct outcome outcome)
{
    enum { interval = 16 };
    const double share = 0.9;
    if (!outcome.accepted || !s->jacobian || !system->gsl.jacobian || s->h_fixed > 0) return outcome;
    if (h > s->stable_h || ++s->since > interval) {
        double *dfdt = s->jacobian + s->n * s->n;
        s->since = 0;
        if (system->gsl.jacobian(t, y, s->jacobian, dfdt, system->gsl.params) != GSL_SUCCESS) return outcome;
        double rate = stiffness_rate(s->n, s->jacobian, dfdt + s->n);
        s->stable_h = rate > 0 ? s->method->stable / rate : INFINITY;
        if (h > s->stable_h)
            return (struct outcome){false, rejected_error, fmax(share * s->stable_h / h, 0.1)};
    }
    if (h * outcome.factor > s->stable_h) outcome.factor = fmax(share * s->stable_h / h, 0.1);
    return outcome;
}

static struct outcome judge(const struct stepper *s, double h, const double *y, const double *f)
{
    if (s->h_fixed > 0 || s->method->exact) {
        bool is_finite = all_finite(s->n, y, f);
        return (struct outcome){is_finite, rejected_not_finite, is_finite ? 1 : 0.25};
    }
    double ratio = error_norm_ratio(s->control, h, y, s->yerr, f);
    double factor = error_norm_factor(s->control, ratio, gsl_odeiv2_step_order(s->step));
    if (ratio <= 1) return (struct outcome){true, rejected_error, factor};
    if (ratio < INFINITY) return (struct outcome){false, rejected_error, factor};
    bool finite = all_finite(s->n, y, f);
    return (struct outcome){false, finite ? rejected_iteration : rejected_not_finite, factor};
}

static void keep(struct stepper *s, struct counted_system *system, struct time_dd t0, struct time_dd t1,
                 const double *y, const double *f)
{
    s->t0 = t0;
    s->t1 = t1;
    memcpy(s->y1, y, s->n * sizeof *y);
    memcpy(s->f1, f, s->n * sizeof *f);
    error_norm_update(s->control, y, f);
    dense_set(s->dense, s->method->order, t0, s->y0, s->f0, t1, s->y1, s->f1, &system->gsl, s->step);
    if (s->inside) resteps_set(s->inside, s->y0, s->y1);
    if (s->substeps) substeps_forget(s->substeps);
    if (s->history && t1.t > t0.t) history_add(s->history, t1.t, y);
    s->system = system;
    s->stepped = true;
    s->counts.accepted++;
}

int stepper_shorten(struct stepper *s, struct time_dd *t, double *y, double *f)
{
    const double far_off = 100, share = 0.875;
    const double room = time_dd_since(*t, s->t0);
    const bool within = s->stepped && room > 0 && time_dd_since(s->t1, *t) > 0;
    if (!within || !s->redo || s->history || s->method->exact || s->h_fixed > 0) return 0;
    const struct time_dd end = time_dd_at(s->t0.t + share * room);
    const double h = time_dd_since(end, s->t0);
    double *inside = s->work;
    if (!(h > 0 && h < room)) return 0;
    int code = stepper_partial(s, end, y, f);
    if (code == GSL_SUCCESS) code = stepper_dense(s, end, inside);
    if (code != GSL_SUCCESS) return code;
    for (size_t i = 0; i < s->n; i++) inside[i] -= y[i];
    if (error_norm_ratio(s->control, h, y, inside, f) <= far_off) return 0;
    memcpy(y, s->y0, s->n * sizeof *y);
    code = gsl_odeiv2_step_apply(s->step, s->t0.t, h, y, s->yerr, s->f0, f, &s->system->gsl);
    if (code != GSL_SUCCESS || !all_finite(s->n, y, f)) return GSL_EFAILED;
    s->counts.accepted--;
    s->counts.rejected[rejected_error]++;
    keep(s, s->system, s->t0, end, y, f);
    *t = end;
    return 1;
}

static enum stepper_status give_up(const struct stepper *s, double *y, double *f, enum stepper_status status)
{
    memcpy(y, s->y0, s->n * sizeof *y);
    memcpy(f, s->f0, s->n * sizeof *f);
    return status;
}

/* Count a rejection. An error of the right-hand side remains the reason, even if later retries fail
 * otherwise: with steps near round-off the implicit equations cannot be solved. */
static void count_rejection(struct stepper *s, enum rejection why, bool again)
{
    bool telling = s->counts.last == rejected_rhs || s->counts.last == rejected_not_finite;
    s->counts.rejected[why]++;
    if (!again || !telling || why == rejected_rhs || why == rejected_not_finite) s->counts.last = why;
}

/* Step to a limit between doubles, by the terms of first and second order. A multistep method computes its
 * step from differences of times, which are zero there. */
static enum stepper_status step_between(struct stepper *s, struct counted_system *system, struct time_dd *t,
                                        double *y, double *f, struct time_dd t_limit)
{
    size_t pairs = s->layout.pairs;
    struct time_dd t0 = *t;
    double h = time_dd_since(t_limit, t0);
    for (size_t i = 0; i < s->n; i++) y[i] += h * (f[i] + (i < pairs ? h / 2 * s->f0[pairs + i] : 0));
    if (counted_system_rhs(system, t_limit.t, y, f) != GSL_SUCCESS || !all_finite(s->n, y, f))
        return give_up(s, y, f, stepper_bad_function);
    memset(s->yerr, 0, s->n * sizeof *s->yerr);
    *t = t_limit;
    keep(s, system, t0, t_limit, y, f);
    return stepper_ok;
}

enum stepper_status stepper_step(struct stepper *s, struct counted_system *system, struct time_dd *t,
                                 double *y, double *f, double *h, struct time_dd t_limit)
{
    struct time_dd t0 = *t;
    double room = time_dd_since(t_limit, t0);
    if (!(room > 0) || !(*h > 0) || system->gsl.dimension != s->n) return stepper_misuse;
    if (s->method->implicit && !system->gsl.jacobian) return stepper_misuse;
    s->stepped = false;
    memcpy(s->y0, y, s->n * sizeof *y);
    memcpy(s->f0, f, s->n * sizeof *f);
    if (s->method->multistep && is_between_doubles(t0, room))
        return step_between(s, system, t, y, f, t_limit);
    double proposal = s->h_fixed > 0 ? s->h_fixed : fmin(*h, s->h_max);
    bool rejected = false;
    for (;;) {
        struct plan plan = plan_step(s, t0, proposal, t_limit);
        if (is_nothing(&plan, t0, room)) return give_up(s, y, f, stepper_underflow);
        system->last_code = GSL_SUCCESS;
        int code = gsl_odeiv2_step_apply(s->step, t0.t, plan.h, y, s->yerr, s->f0, f, &system->gsl);
        if (code == GSL_EBADFUNC) return give_up(s, y, f, stepper_bad_function);
        struct outcome outcome = code == GSL_SUCCESS ? judge(s, plan.h, y, f) : judge_failure(s, system);
        outcome = keep_stable(s, plan.h, y, outcome);
        outcome = guard_stability(s, system, plan.h, plan.t1.t, y, outcome);
        if (outcome.accepted) {
            double next = plan.h * (rejected ? fmin(outcome.factor, 1) : outcome.factor);
            *h = fmin(plan.cut ? fmax(next, proposal) : next, s->h_max);
            *t = plan.t1;
            s->counts.growth = outcome.factor;
            keep(s, system, t0, plan.t1, y, f);
            return stepper_ok;
        }
        count_rejection(s, outcome.why, rejected);
        if (s->h_fixed > 0) return give_up(s, y, f, stepper_fixed_failed);
        rejected = true;
        proposal = plan.asked * outcome.factor;
        memcpy(y, s->y0, s->n * sizeof *y);
    }
}

void stepper_set_linear(struct stepper *s, const double *A, double rho)
{
    if (s->step->type == step_linear) linear_set_matrix(s->step, A, rho);
}

const struct stepper_counts *stepper_get_counts(const struct stepper *s)
{
    return &s->counts;
}

double stepper_h_rate(const struct stepper *s)
{
    return s->rate > 0 ? time_dd_since(s->t1, s->t0) * s->rate : INFINITY;
}

const double *stepper_jacobian(const struct stepper *s)
{
    return s->stepped ? rodas5p_jacobian(s->step) : NULL;
}

bool stepper_lend(const struct stepper *s, struct stepper_state_view *view)
{
    const struct method *method = s->method;
    bool plain = !method->implicit && !method->multistep && !method->exact && !(method->by_time > 0);
    if (!plain || s->h_fixed > 0 || s->h_max < INFINITY || s->jacobian) return false;
    view->type = s->step->type;
    view->rate = s->rate;
    view->growth = s->counts.growth;
    view->accepted = view->rejected = 0;
    if (!error_norm_view(s->control, view)) return false;
    if (view->type == step_rk8pd || view->type == step_dop853) pair8_lend(s->step, view);
    return true;
}

void stepper_settle(struct stepper *s, const struct stepper_state_view *view)
{
    s->stepped = false;
    s->rate = view->rate;
    s->counts.accepted += view->accepted;
    s->counts.rejected[rejected_error] += view->rejected;
    if (view->rejected > 0) s->counts.last = rejected_error;
    s->counts.growth = view->growth;
    error_norm_settle(s->control, view);
    if (view->type == step_rk8pd || view->type == step_dop853) pair8_settle(s->step, view);
}

gsl_odeiv2_control *stepper_control(struct stepper *s)
{
    return s->control;
}
