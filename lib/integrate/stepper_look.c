/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dense output of the last step: its interpolant where the method has one, else the step repeated in part.
 */
#include <gsl/gsl_errno.h>
#include <string.h>

#include "integrate/bsimp.h"
#include "integrate/error_norm.h"
#include "integrate/linear.h"
#include "integrate/nystrom.h"
#include "integrate/parabola.h"
#include "integrate/rodas5p.h"
#include "integrate/stepper_state.h"
#include "numeric/tolerances.h"

/* A step of size h by the same method from the start of the last one. */
static int redo(struct stepper *s, double h, double *y, double *f)
{
    memcpy(y, s->y0, s->n * sizeof *y);
    return gsl_odeiv2_step_apply(s->redo, s->t0.t, h, y, s->yerr, s->f0, f, &s->system->gsl);
}

/* Repeat a part of a step and check its error. A part may be wrong where the whole was accepted: the table of
 * bsimp may agree at the end of a step that is far too long for it, and nowhere inside, so its error must be
 * at most 1. Methods with a fixed number of stages err less in a shorter step, while their estimates include
 * stiff layers that do not affect them; their limit is 100, which is exceeded where the part ends at the
 * start of a pulse that the whole step has skipped. */
static bool redo_well(struct stepper *s, double h, double *y, double *f)
{
    if (redo(s, h, y, f) != GSL_SUCCESS || !all_finite(s->n, y, f)) return false;
    const double far_off = 100;
    double most = *s->method->type == step_bsimp ? 1 : far_off;
    return s->h_fixed > 0 || error_norm_ratio(s->control, h, y, s->yerr, f) <= most;
}

static bool redo_share(void *context, double share, double *y)
{
    struct stepper *s = context;
    return redo_well(s, share * time_dd_since(s->t1, s->t0), y, s->work);
}

static double substeps_part(void *context, double from, double h, double *y, double *f)
{
    struct stepper *s = context;
    double *y1 = s->work, *f1 = s->work + s->n;
    memcpy(y1, y, s->n * sizeof *y);
    gsl_odeiv2_step_reset(s->redo);
    int code = gsl_odeiv2_step_apply(s->redo, s->t0.t + from, h, y1, s->yerr, f, f1, &s->system->gsl);
    if (code != GSL_SUCCESS || !all_finite(s->n, y1, f1)) return INFINITY;
    memcpy(y, y1, s->n * sizeof *y);
    memcpy(f, f1, s->n * sizeof *f);
    return error_norm_ratio(s->control, h, y, s->yerr, f);
}

static int substeps_inside(struct stepper *s, struct time_dd t, double *y, double *f)
{
    const struct substeps_source source = {s, substeps_part};
    return substeps_to(s->substeps, &source, time_dd_since(s->t1, s->t0), s->y0, s->f0,
                       time_dd_since(t, s->t0), y, f);
}

static double excess(void *context, const double *error)
{
    const struct stepper *s = context;
    return error_norm_ratio(s->control, time_dd_since(s->t1, s->t0), s->y1, error, s->f1);
}

static bool is_end(const struct stepper *s, struct time_dd t)
{
    return time_dd_equal(t, s->t0) || time_dd_equal(t, s->t1);
}

/* Dense output of the method itself. */
static int own_dense(struct stepper *s, struct time_dd t, double *y)
{
    if (!(s->method->implicit || s->inside) || is_end(s, t)) return dense_eval(s->dense, t, y);
    double share = time_dd_since(t, s->t0) / time_dd_since(s->t1, s->t0);
    if (s->step->type == step_rodas5p) {
        int code = rodas5p_dense_prepare(s->step);
        if (code == GSL_SUCCESS) rodas5p_dense_eval(s->step, share, y);
        return code;
    }
    const struct resteps_source source = {s, redo_share, excess};
    if (s->inside && resteps_eval(s->inside, &source, share, y)) return GSL_SUCCESS;
    if (!s->history)
        return redo_well(s, time_dd_since(t, s->t0), y, s->work)
                   ? GSL_SUCCESS
                   : substeps_inside(s, t, y, s->work + 2 * s->n);
    history_eval(s->history, (int)gsl_odeiv2_step_order(s->step), t.t, y);
    return GSL_SUCCESS;
}

/* Is there a last step, and t within? A double next to an end may be outside by less than its spacing; it is
 * set to the end. */
static bool find_within(const struct stepper *s, struct time_dd *t)
{
    if (!s->stepped || !(t->t >= s->t0.t && t->t <= s->t1.t)) return false;
    if (t->rest == 0 && t->t > s->t0.t && t->t < s->t1.t) return true;
    *t = time_dd_since(*t, s->t0) <= 0 ? s->t0 : time_dd_since(s->t1, *t) <= 0 ? s->t1 : *t;
    return true;
}

/* An implicit method may succeed in a step and fail in a part of it; then only the ends are used, as an
 * accepted step must have dense output. */
int stepper_dense(struct stepper *s, struct time_dd t, double *y)
{
    if (!find_within(s, &t)) return GSL_EINVAL;
    int last_code = s->system->last_code;
    if (own_dense(s, t, y) != GSL_SUCCESS) dense_eval_plain(s->dense, t, y);
    s->system->last_code = last_code; /* not a reason of later failures */
    return GSL_SUCCESS;
}

int stepper_powers_of_ends(struct stepper *s, struct time_dd from, struct time_dd to, size_t i, double *c)
{
    if (s->method->implicit || s->inside || !find_within(s, &from) || !find_within(s, &to)) return -1;
    return dense_powers_of_ends(s->dense, from, to, i, c);
}

int stepper_powers(struct stepper *s, struct time_dd from, struct time_dd to, size_t i, double *c)
{
    if (s->method->implicit || s->inside || !find_within(s, &from) || !find_within(s, &to)) return -1;
    int last_code = s->system->last_code;
    int degree = dense_powers(s->dense, from, to, i, c);
    s->system->last_code = last_code;
    return degree;
}

/* A step of the linear method is two radians of the fastest oscillation: the Bessel function J_14(1) of its
 * Chebyshev series is 7e-16. States of implicit methods are as accurate as the solution of their equations. */
int stepper_degree(const struct stepper *s, double *negligible)
{
    const gsl_odeiv2_step_type *type = s->step->type;
    *negligible = s->inside || s->history ? undecided_part : 0;
    if (type == step_parabola) return 2;
    if (type == step_linear) {
        const int most = 14;
        int degree = linear_dense_degree(s->step);
        if (degree >= 1 && degree <= most) return degree;
        *negligible = negligible_part;
        return most;
    }
    if (type == step_nystrom) return 12;
    return 8;
}

int stepper_partial(struct stepper *s, struct time_dd t, double *y, double *f)
{
    if (!find_within(s, &t)) return GSL_EINVAL;
    bool start = time_dd_equal(t, s->t0);
    if (start || time_dd_equal(t, s->t1)) {
        memcpy(y, start ? s->y0 : s->y1, s->n * sizeof *y);
        memcpy(f, start ? s->f0 : s->f1, s->n * sizeof *f);
        return GSL_SUCCESS;
    }
    if (s->redo && redo_well(s, time_dd_since(t, s->t0), y, f)) return GSL_SUCCESS;
    int code = stepper_dense(s, t, y);
    if (code != GSL_SUCCESS) return code;
    if (s->step->type != step_parabola) return counted_system_rhs(s->system, t.t, y, f);
    parabola_slopes(s->step, y, f);
    return GSL_SUCCESS;
}

int stepper_walk(struct stepper *s, struct time_dd t, double *y, double *f)
{
    if (!s->substeps || !find_within(s, &t) || is_end(s, t)) return GSL_EINVAL;
    return substeps_inside(s, t, y, f);
}

double stepper_attempt(struct stepper *s, struct counted_system *system, const struct stepper *other,
                       double h)
{
    if (!s->redo || !other->stepped) return INFINITY;
    double *y1 = s->work, *f1 = s->work + s->n;
    memcpy(y1, other->y0, s->n * sizeof *y1);
    gsl_odeiv2_step_reset(s->redo);
    int code = gsl_odeiv2_step_apply(s->redo, other->t0.t, h, y1, s->yerr, other->f0, f1, &system->gsl);
    return code == GSL_SUCCESS ? error_norm_ratio(s->control, h, y1, s->yerr, f1) : INFINITY;
}
