/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * State of a stepper, shared by stepper.c, which makes steps, and stepper_look.c, which evaluates the last
 * one.
 */
#ifndef FBD_INTEGRATE_STEPPER_STATE_H
#define FBD_INTEGRATE_STEPPER_STATE_H

#include "integrate/dense.h"
#include "integrate/dense_by_resteps.h"
#include "integrate/history.h"
#include "integrate/stepper.h"
#include "integrate/substeps.h"

struct stepper {
    const struct method *method;
    struct layout layout;
    size_t n;
    double h_max, h_fixed;
    gsl_odeiv2_control *control;
    gsl_odeiv2_step *step;
    gsl_odeiv2_step *redo;     /* of the same type, for parts of steps, as `step` keeps its dense output */
    gsl_odeiv2_driver driver;  /* GSL's steppers only read its control */
    struct dense *dense;       /* of explicit methods and msadams */
    struct history *history;   /* of msbdf, else NULL */
    struct resteps *inside;    /* of methods without an interpolant as accurate as their steps, else NULL */
    struct substeps *substeps; /* of one-step methods, else NULL */
    struct stepper_counts counts;
    double *jacobian; /* n n + 3 n, for the limit of stability; NULL: no such limit */
    double stable_h;  /* the largest stable step by the last Jacobian */
    int since;        /* accepted steps since that Jacobian */
    double rate;      /* fastest rate that rk8pd or dop853 has detected lately */
    bool stepped;     /* the following members hold a last step */
    struct counted_system *system;
    struct time_dd t0, t1;
    double *y0, *f0, *y1, *f1;
    double *yerr, *work; /* n and 3 n */
    double memory[];
};

static inline bool all_finite(size_t n, const double *restrict y, const double *restrict f)
{
    double probe = 0;
    for (size_t i = 0; i < n; i++) probe += 0 * (y[i] + f[i]);
    return probe == 0;
}

#endif
