/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/linear.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "integrate/stiffness.h"

enum { terms = 26, matrices = 6 };

static const double series_reach = 2 + 1e-9; /* of h rho: a step of 2 / rho may be rounded up */

struct linear {
    size_t dim;
    bool has_matrix, stepped, has_terms;
    int used; /* terms of the series */
    double rho, h;
    double kept;                             /* the step size that `phi` belongs to, 0 for none */
    double *y0, *f0, *work;                  /* dim, dim, 2 dim */
    double *term;                            /* terms x dim: h^(k+1) A^k f0 / (k+1)! */
    double *A, *phi, *exponential, *spare;   /* dim x dim */
    double *phi_within, *exponential_within; /* dim x dim: for dense output */
    double memory[];
};

static void *linear_alloc(size_t dim)
{
    const size_t most = 2 * (size_t)linear_most_pairs;
    if (dim == 0 || dim > most) return NULL;
    size_t numbers = 4 * dim + terms * dim + matrices * dim * dim;
    struct linear *s = calloc(1, sizeof *s + numbers * sizeof(double));
    if (!s) return NULL;
    s->dim = dim;
    s->y0 = s->memory;
    s->f0 = s->y0 + dim;
    s->work = s->f0 + dim;
    s->term = s->work + 2 * dim;
    s->A = s->term + terms * dim;
    s->phi = s->A + dim * dim;
    s->exponential = s->phi + dim * dim;
    s->spare = s->exponential + dim * dim;
    s->phi_within = s->spare + dim * dim;
    s->exponential_within = s->phi_within + dim * dim;
    return s;
}

static void linear_free(void *state)
{
    free(state);
}

static int linear_reset(void *state, size_t dim)
{
    struct linear *s = state;
    (void)dim;
    s->has_matrix = s->stepped = false;
    return GSL_SUCCESS;
}

static unsigned int linear_order(void *state)
{
    (void)state;
    return 8; /* any order: the estimate is zero */
}

static int linear_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state, (void)driver;
    return GSL_SUCCESS;
}

/* ---- small matrices, row by row */

static void apply_matrix(size_t dim, const double *matrix, const double *x, double *result)
{
    if (dim == 2) { /* one body on a line or a pivot, the most frequent scene */
        double first = matrix[0] * x[0] + matrix[1] * x[1];
        result[1] = matrix[2] * x[0] + matrix[3] * x[1];
        result[0] = first;
        return;
    }
    for (size_t i = 0; i < dim; i++) {
        double sum = 0;
        for (size_t j = 0; j < dim; j++) sum += matrix[i * dim + j] * x[j];
        result[i] = sum;
    }
}

static void multiply(size_t dim, const double *a, const double *b, double *result)
{
    for (size_t i = 0; i < dim; i++) {
        for (size_t j = 0; j < dim; j++) {
            double sum = 0;
            for (size_t k = 0; k < dim; k++) sum += a[i * dim + k] * b[k * dim + j];
            result[i * dim + j] = sum;
        }
    }
}

/* exponential = 1 + A phi */
static void set_exponential(struct linear *s)
{
    multiply(s->dim, s->A, s->phi, s->exponential);
    for (size_t i = 0; i < s->dim; i++) s->exponential[i * s->dim + i] += 1;
}

/* phi = Phi(h) for any h > 0, and its exponential. */
static void set_phi(struct linear *s, double h)
{
    size_t dim = s->dim, size = dim * dim;
    int doublings;
    frexp(h * s->rho, &doublings); /* h rho < 2^doublings */
    if (doublings < 0 || !(h * s->rho > 0)) doublings = 0;
    double part = ldexp(h, -doublings);
    /* Horner: h (1 + hA/2 (1 + hA/3 (1 + ...))) */
    memset(s->phi, 0, size * sizeof *s->phi);
    for (int k = terms; k >= 1; k--) {
        multiply(dim, s->A, s->phi, s->spare);
        for (size_t i = 0; i < size; i++) s->phi[i] = s->spare[i] * part / (k + 1);
        for (size_t i = 0; i < dim; i++) s->phi[i * dim + i] += 1;
    }
    for (size_t i = 0; i < size; i++) s->phi[i] *= part;
    set_exponential(s);
    for (int k = 0; k < doublings; k++) {
        multiply(dim, s->exponential, s->phi, s->spare);
        for (size_t i = 0; i < size; i++) s->phi[i] += s->spare[i];
        multiply(dim, s->exponential, s->exponential, s->spare);
        memcpy(s->exponential, s->spare, size * sizeof *s->spare);
    }
    s->kept = h;
}

/* ---- steps */

/* The terms of the series for the present step, as many as count: the norm of the weights says nothing of
 * what is no longer there after dim - 1 products. */
static void set_terms(struct linear *s)
{
    const double least = 4e-18;
    double *term = s->term, bound = 1;
    for (size_t i = 0; i < s->dim; i++) term[i] = s->h * s->f0[i];
    for (s->used = 1; s->used < terms; s->used++, term += s->dim) {
        double factor = s->h / (s->used + 1), size = 0;
        bound *= factor * s->rho;
        if (bound < least && (size_t)s->used >= s->dim) break;
        apply_matrix(s->dim, s->A, term, term + s->dim);
        for (size_t i = 0; i < s->dim; i++) {
            term[s->dim + i] *= factor;
            size += fabs(term[s->dim + i]);
        }
        if (size == 0) break;
    }
    s->has_terms = true;
}

static void sum_terms(const struct linear *s, double theta, double *y)
{
    for (size_t i = 0; i < s->dim; i++) {
        double sum = 0;
        for (int k = s->used - 1; k >= 0; k--) sum = theta * (s->term[(size_t)k * s->dim + i] + sum);
        y[i] = s->y0[i] + sum;
    }
}

/* y0 + Phi(h) f0 for a step longer than the series goes. A step differs from the one before by the rounding
 * of the time, which is made up for along the slope. */
static void leap(struct linear *s, double h, double *y)
{
    const double rounding = 1e-12;
    size_t dim = s->dim;
    if (!(fabs(h - s->kept) <= rounding * h)) set_phi(s, h);
    apply_matrix(dim, s->phi, s->f0, y);
    apply_matrix(dim, s->exponential, s->f0, s->work);
    double rest = h - s->kept;
    for (size_t i = 0; i < dim; i++) y[i] = s->y0[i] + (y[i] + rest * s->work[i]);
}

void linear_set_matrix(gsl_odeiv2_step *step, const double *A, double rho)
{
    struct linear *s = step->state;
    size_t size = s->dim * s->dim * sizeof *A;
    s->has_matrix = true;
    if (rho == s->rho && memcmp(A, s->A, size) == 0) return; /* as before the reset, with its Phi */
    memcpy(s->A, A, size);
    s->rho = rho;
    s->kept = 0;
}

static int set_matrix(struct linear *s, double t, const double *y, const gsl_odeiv2_system *sys)
{
    double *dfdt = s->work;
    int status = GSL_ODEIV_JA_EVAL(sys, t, y, s->A, dfdt);
    if (status != GSL_SUCCESS) return status;
    s->rho = stiffness_rate(s->dim, s->A, s->work);
    if (!isfinite(s->rho)) return GSL_FAILURE;
    s->kept = 0;
    s->has_matrix = true;
    return GSL_SUCCESS;
}

static int linear_apply(void *state, size_t dim, double t, double h, double y[], double yerr[],
                        const double dydt_in[], double dydt_out[], const gsl_odeiv2_system *sys)
{
    struct linear *s = state;
    int status = GSL_SUCCESS;
    s->stepped = false;
    if (!s->has_matrix && (status = set_matrix(s, t, y, sys))) return status;
    if (dydt_in)
        memcpy(s->f0, dydt_in, dim * sizeof *y);
    else if ((status = GSL_ODEIV_FN_EVAL(sys, t, y, s->f0)))
        return status;
    s->h = h;
    s->has_terms = false;
    memcpy(s->y0, y, dim * sizeof *y);
    memset(yerr, 0, dim * sizeof *yerr);
    if (h * s->rho <= series_reach) {
        set_terms(s);
        sum_terms(s, 1, y);
    } else {
        leap(s, h, y);
    }
    double probe = 0;
    for (size_t i = 0; i < dim; i++) probe += 0 * y[i];
    if (probe != 0) status = GSL_FAILURE;
    if (status == GSL_SUCCESS && dydt_out) status = GSL_ODEIV_FN_EVAL(sys, t + h, y, dydt_out);
    if (status != GSL_SUCCESS) memcpy(y, s->y0, dim * sizeof *y);
    s->stepped = status == GSL_SUCCESS;
    return status;
}

int linear_dense_prepare(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys)
{
    (void)sys;
    return step->type == step_linear && ((struct linear *)step->state)->stepped ? GSL_SUCCESS : GSL_EINVAL;
}

void linear_dense_eval(const gsl_odeiv2_step *step, double theta, double *y)
{
    struct linear *s = step->state;
    if (s->has_terms) {
        sum_terms(s, theta, y);
        return;
    }
    /* The matrix of the whole step is kept for the next one. */
    struct linear part = *s;
    part.phi = s->phi_within;
    part.exponential = s->exponential_within;
    part.kept = 0;
    leap(&part, theta * s->h, y);
}

int linear_dense_degree(const gsl_odeiv2_step *step)
{
    const struct linear *s = step->state;
    return s->stepped && s->has_terms ? s->used : 0;
}

static const gsl_odeiv2_step_type linear_type = {
    .name = "linear",
    .can_use_dydt_in = 1,
    .gives_exact_dydt_out = 1,
    .alloc = linear_alloc,
    .apply = linear_apply,
    .set_driver = linear_set_driver,
    .reset = linear_reset,
    .order = linear_order,
    .free = linear_free,
};

const gsl_odeiv2_step_type *const step_linear = &linear_type;
