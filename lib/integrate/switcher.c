/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/switcher.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>

#include "base/block_alloc.h"
#include "integrate/error_norm.h"
#include "integrate/stiffness.h"

enum { by_exact = 2, kinds_of_stepper };

struct switcher {
    struct stepper
        *steppers[kinds_of_stepper]; /* explicit; implicit, NULL until it is tried; exact or NULL */
    const struct method *methods[kinds_of_stepper];
    struct stepper_options options;
    int now, made; /* the one that makes the next step; the one that has made the last */
    int general;   /* that of the first two which is in use, or was before the exact one */
    struct stiffness stiffness;
    size_t n;
    double *rate_work; /* 2 n */
};

/* The implicit stepper is made for its first attempt: most motions never need one. False when memory is out. */
static bool make_implicit(struct switcher *s)
{
    if (s->steppers[1]) return true;
    s->options.method = s->methods[1];
    if (!s->rate_work) s->rate_work = malloc(2 * s->n * sizeof(double));
    s->steppers[1] = s->rate_work ? stepper_alloc(&s->options) : NULL;
    return s->steppers[1] != NULL;
}

struct switcher *switcher_alloc(const struct stepper_options *options, const struct method *stiff)
{
    struct switcher *s = block_alloc(sizeof *s);
    if (!s) return NULL;
    s->n = layout_size(&options->layout);
    s->options = *options;
    s->methods[0] = options->method;
    s->methods[1] = options->h_fixed == 0 ? stiff : NULL;
    s->steppers[0] = stepper_alloc(options);
    stiffness_start(&s->stiffness, options->layout.pairs > 0 ? options->layout.pairs : s->n);
    if (s->steppers[0]) return s;
    switcher_free(s);
    return NULL;
}

void switcher_free(struct switcher *s)
{
    if (!s) return;
    for (int k = 0; k < kinds_of_stepper; k++) stepper_free(s->steppers[k]);
    free(s->rate_work);
    free(s);
}

bool switcher_add_exact(struct switcher *s, const struct stepper_options *options,
                        const struct method *method)
{
    struct stepper_options own = *options;
    own.method = s->methods[by_exact] = method;
    s->steppers[by_exact] = stepper_alloc(&own);
    return s->steppers[by_exact] != NULL;
}

void switcher_use_exact(struct switcher *s, bool exact)
{
    if (exact == (s->now == by_exact)) return;
    if (exact) s->general = s->now;
    s->now = exact ? by_exact : s->general;
}

/* Give the error norm of the other method the states that this one has reached. */
static void follow(struct switcher *s)
{
    error_norm_follow(stepper_control(s->steppers[!s->now]), stepper_control(s->steppers[s->now]));
}

void switcher_expect_stiff(struct switcher *s)
{
    if (s->now != 0 || !s->methods[1] || !make_implicit(s)) return;
    follow(s);
    s->now = 1;
    s->stiffness.implicit = true;
}

int switcher_reset(struct switcher *s, struct counted_system *system, struct time_dd t, const double *y,
                   double *f, struct time_dd t_limit, double *h)
{
    stiffness_forget(&s->stiffness);
    return stepper_reset(s->steppers[s->now], system, t, y, f, t_limit, h);
}

int switcher_restart(struct switcher *s, struct time_dd t, const double *y, const double *f,
                     struct time_dd t_limit, double *h)
{
    stiffness_forget(&s->stiffness);
    return stepper_restart(s->steppers[s->now], t, y, f, t_limit, h);
}

/* The fastest rate of the system at the start of the step that the implicit method has just made, for the
 * switch back to the explicit one; NAN without a Jacobian. */
static double last_rate(struct switcher *s)
{
    const double *jacobian = stepper_jacobian(s->steppers[1]);
    return jacobian ? stiffness_rate(s->n, jacobian, s->rate_work) : NAN;
}

/* Is the explicit method limited to steps for which the implicit one has no error at all? Then the implicit
 * one could make longer steps. In free flight and at rest the steps of both grow at the maximum rate. */
static bool is_confined(const struct switcher *s)
{
    const double freely = 4;
    return s->now == 0 && stepper_get_counts(s->steppers[0])->growth < freely;
}

/* The error ratio of the other method's attempt at a step of this size from t0; infinite if it would pass the
 * limit, as the equations may be different behind it. */
static double attempt(struct switcher *s, struct counted_system *system, struct time_dd t0,
                      struct time_dd t_limit, double size)
{
    if (time_dd_since(t_limit, t0) < size) return INFINITY;
    return stepper_attempt(s->steppers[!s->now], system, s->steppers[s->now], size);
}

/* Let the other method attempt the step that has just been made, and switch to it if it is better. */
static enum stepper_status consider(struct switcher *s, struct counted_system *system, struct time_dd t0,
                                    struct time_dd t, const double *y, double *f, double *h,
                                    struct time_dd t_limit)
{
    int other = !s->now, order = s->methods[other]->estimate_order;
    if (!make_implicit(s)) return stepper_no_memory;
    double size = stiffness_stride(&s->stiffness) * time_dd_since(t, t0);
    follow(s);
    double ratio = attempt(s, system, t0, t_limit, size);
    if (ratio == 0 && is_confined(s)) ratio = DBL_MIN;
    if (stiffness_doubts(&s->stiffness, ratio, order))
        ratio = fmin(ratio,
                     attempt(s, system, t0, t_limit, stiffness_reach * size) / pow(stiffness_reach, order));
    double h_rate = s->now == 1 ? size * last_rate(s) : 0;
    if (!stiffness_decide(&s->stiffness, ratio, order, h_rate)) return stepper_ok;
    /* The evaluations are counted by the system, not by the step; a reset that fails leaves the state
     * unchanged. */
    double first;
    if (stepper_reset(s->steppers[other], system, t, y, f, t_limit, &first) != GSL_SUCCESS) {
        s->stiffness.implicit = s->now == 1;
        return stepper_ok;
    }
    s->now = other;
    *h = fmax(first, size); /* it could have made at least this step */
    return stepper_ok;
}

/* Step with the explicit method where the steps of the implicit one underflow: rounding in a Jacobian may
 * matter more than in a right-hand side. If it fails too, the state is unchanged. */
static enum stepper_status step_explicitly(struct switcher *s, struct counted_system *system,
                                           struct time_dd *t, double *y, double *f, double *h,
                                           struct time_dd t_limit)
{
    double first;
    follow(s);
    if (stepper_reset(s->steppers[0], system, *t, y, f, t_limit, &first) != GSL_SUCCESS)
        return stepper_underflow;
    enum stepper_status status = stepper_step(s->steppers[0], system, t, y, f, &first, t_limit);
    if (status != stepper_ok) return stepper_underflow;
    s->now = 0;
    s->stiffness.implicit = false;
    *h = first;
    return stepper_ok;
}

enum stepper_status switcher_step(struct switcher *s, struct counted_system *system, struct time_dd *t,
                                  double *y, double *f, double *h, struct time_dd t_limit)
{
    struct time_dd t0 = *t;
    enum stepper_status status = stepper_step(s->steppers[s->now], system, t, y, f, h, t_limit);
    if (status == stepper_underflow && s->now == 1) status = step_explicitly(s, system, t, y, f, h, t_limit);
    s->made = s->now;
    if (s->now == by_exact || status != stepper_ok || !s->methods[1] || !(time_dd_since(t_limit, *t) > 0))
        return status;
    if (s->stiffness.wait > 1) { /* as stiffness_due, without the rate */
        s->stiffness.wait--;
        return status;
    }
    if (stiffness_due(&s->stiffness, stepper_h_rate(s->steppers[s->now])))
        return consider(s, system, t0, *t, y, f, h, t_limit);
    return status;
}

int switcher_dense(struct switcher *s, struct time_dd t, double *y)
{
    return stepper_dense(s->steppers[s->made], t, y);
}

int switcher_powers(struct switcher *s, struct time_dd from, struct time_dd to, size_t i, double *c)
{
    return stepper_powers(s->steppers[s->made], from, to, i, c);
}

int switcher_powers_of_ends(struct switcher *s, struct time_dd from, struct time_dd to, size_t i, double *c)
{
    return stepper_powers_of_ends(s->steppers[s->made], from, to, i, c);
}

int switcher_degree(const struct switcher *s, double *negligible)
{
    return stepper_degree(s->steppers[s->made], negligible);
}

int switcher_partial(struct switcher *s, struct time_dd t, double *y, double *f)
{
    return stepper_partial(s->steppers[s->made], t, y, f);
}

int switcher_shorten(struct switcher *s, struct time_dd *t, double *y, double *f)
{
    return stepper_shorten(s->steppers[s->made], t, y, f);
}

int switcher_walk(struct switcher *s, struct time_dd t, double *y, double *f)
{
    return stepper_walk(s->steppers[s->made], t, y, f);
}

bool switcher_lend(const struct switcher *s, struct stepper_state_view *view)
{
    if (s->now != 0 || s->made != 0 || s->steppers[by_exact] || !stepper_lend(s->steppers[0], view))
        return false;
    view->steps = INFINITY;
    if (!s->methods[1]) return true;
    view->steps = s->stiffness.wait - 1;
    return view->steps > 0;
}

void switcher_settle(struct switcher *s, const struct stepper_state_view *view)
{
    if (view->accepted == 0) return;
    stepper_settle(s->steppers[0], view);
    if (s->methods[1]) s->stiffness.wait -= (int)view->accepted;
}

unsigned long switcher_rejected(const struct switcher *s, enum rejection why)
{
    unsigned long sum = 0;
    for (int k = 0; k < kinds_of_stepper; k++)
        if (s->steppers[k]) sum += stepper_get_counts(s->steppers[k])->rejected[why];
    return sum;
}

struct stepper_counts switcher_counts(const struct switcher *s)
{
    struct stepper_counts sum = *stepper_get_counts(s->steppers[0]);
    for (int k = 1; k < kinds_of_stepper; k++) {
        if (!s->steppers[k]) continue;
        const struct stepper_counts *more = stepper_get_counts(s->steppers[k]);
        sum.accepted += more->accepted;
        for (int kind = 0; kind < rejection_kinds; kind++) sum.rejected[kind] += more->rejected[kind];
        if (s->now == k) sum.last = more->last;
    }
    return sum;
}

bool switcher_made_implicitly(const struct switcher *s)
{
    return s->methods[s->made]->implicit;
}

unsigned long switcher_stiff_steps(const struct switcher *s)
{
    return s->steppers[1] ? stepper_get_counts(s->steppers[1])->accepted : 0;
}

void switcher_set_linear(struct switcher *s, const double *A, double rho)
{
    stepper_set_linear(s->steppers[0], A, rho);
}

void switcher_set_noise(struct switcher *s, size_t rate, double noise, double passing)
{
    error_norm_set_roundoff(stepper_control(s->steppers[s->now]), rate, noise, passing);
}

bool switcher_noise_counts(const struct switcher *s, double h)
{
    return error_norm_roundoff_counts(stepper_control(s->steppers[s->made]), h);
}

void switcher_set_floor(struct switcher *s, size_t component, double floor)
{
    if (floor > 0 && floor < INFINITY)
        error_norm_set_floor(stepper_control(s->steppers[s->now]), component, floor);
}
