/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/linear.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "integrate/linear_doublings.h"
#include "integrate/stiffness.h"
#include "numeric/tolerances.h"

enum { terms = linear_terms, works = 4, power_room = linear_most_powers + 1 };

static const double series_reach = 2 + rounded_reach; /* of h rho: a step of 2 / rho may be rounded up */

struct linear {
    size_t dim;
    bool has_matrix, stepped, has_terms;
    int used; /* terms of the series */
    double rho, h;
    double *y0, *f0, *work; /* dim, dim, works dim */
    double *term;           /* terms x dim: h^(k+1) A^k f0 / (k+1)! */
    double *power;          /* (most powers + 1) x dim: of a piece of the step, in powers of s from -1 to 1 */
    struct powers_piece piece;
    int degree; /* of that piece; below zero: none */
    double *A;  /* dim x dim */
    struct doublings doublings;
    double memory[];
};

static void *linear_alloc(size_t dim)
{
    const size_t most = 2 * (size_t)linear_most_pairs;
    if (dim == 0 || dim > most) return NULL;
    size_t numbers = (2 + works + terms + power_room + dim) * dim;
    struct linear *s = malloc(sizeof *s + numbers * sizeof(double));
    if (!s) return NULL;
    *s = (struct linear){.dim = dim, .rho = NAN}; /* rho of no matrix */
    s->y0 = s->memory;
    s->f0 = s->y0 + dim;
    s->work = s->f0 + dim;
    s->term = s->work + works * dim;
    s->power = s->term + terms * dim;
    s->A = s->power + power_room * dim;
    return s;
}

static void linear_free(void *state)
{
    struct linear *s = state;
    doublings_free(&s->doublings);
    free(s);
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

static inline void apply_matrix(size_t dim, const double *matrix, const double *x, double *result)
{
    if (dim == 2) { /* one body on a slide or a pivot, the most frequent scene */
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

/* ---- steps */

/* The terms h^k A^(k-1) f/k! of the series of a step after the first, h f, which the caller has set: as many
 * as count, `most` at most. The norm bounds the terms only after dim - 1 products. Returns their number. */
static int continue_series(const struct linear *s, double h, int most, double *term)
{
    size_t dim = s->dim;
    double bound = 1;
    int used = 1;
    for (; used < most; used++, term += dim) {
        double factor = h / (used + 1), size = 0;
        bound *= factor * s->rho;
        if (bound < series_end && (size_t)used >= dim) break;
        apply_matrix(dim, s->A, term, term + dim);
        for (size_t i = 0; i < dim; i++) {
            term[dim + i] *= factor;
            size += fabs(term[dim + i]);
        }
        if (size == 0) break;
    }
    return used;
}

/* The same for two components, which stay in registers. */
static int continue_series_of_pair(const struct linear *s, double h, int most, double *term)
{
    const double a = s->A[0], b = s->A[1], c = s->A[2], d = s->A[3], rho = s->rho;
    double x = term[0], y = term[1], bound = 1;
    int used = 1;
    for (; used < most; used++) {
        double factor = h / (used + 1), first = (a * x + b * y) * factor;
        bound *= factor * rho;
        if (bound < series_end && used >= 2) break;
        y = (c * x + d * y) * factor;
        x = first;
        term += 2;
        term[0] = x;
        term[1] = y;
        if (x == 0 && y == 0) break;
    }
    return used;
}

static int make_series(const struct linear *s, double h, int most, const double *f, double *term)
{
    for (size_t i = 0; i < s->dim; i++) term[i] = h * f[i];
    return (s->dim == 2 ? continue_series_of_pair : continue_series)(s, h, most, term);
}

static void set_terms(struct linear *s)
{
    s->used = make_series(s, s->h, terms, s->f0, s->term);
    s->has_terms = true;
}

static void sum_terms(const struct linear *s, double theta, double *y)
{
    size_t dim = s->dim, i = 0;
    for (; i + 1 < dim; i += 2) { /* two at a time */
        const double *first = s->term + i, *term = first + (size_t)s->used * dim;
        double sum = 0, next = 0;
        while (term > first) {
            term -= dim;
            sum = theta * (term[0] + sum);
            next = theta * (term[1] + next);
        }
        y[i] = s->y0[i] + sum;
        y[i + 1] = s->y0[i + 1] + next;
    }
    if (i == dim) return;
    double sum = 0;
    for (int k = s->used - 1; k >= 0; k--) sum = theta * (s->term[(size_t)k * dim + i] + sum);
    y[i] = s->y0[i] + sum;
}

/* rise += Phi(h) f for |h| below the shortest doubling. */
static void climb_rest(const struct linear *s, double h, const double *f, double *term, double *rise)
{
    double *next = term + s->dim, bound = 1;
    for (size_t i = 0; i < s->dim; i++) term[i] = h * f[i];
    for (size_t k = 1; k <= terms; k++) {
        double factor = h / (double)(k + 1);
        for (size_t i = 0; i < s->dim; i++) rise[i] += term[i];
        bound *= fabs(factor) * s->rho;
        if (bound < series_end && k >= s->dim) break;
        apply_matrix(s->dim, s->A, term, next);
        for (size_t i = 0; i < s->dim; i++) term[i] = next[i] * factor;
    }
}

/* y0 + Phi(h) f0 for a step beyond the range of the series: split h into the lengths of the doublings,
 * advancing the slope f over each, and use the series for the remainder. A step of exactly one such length
 * may be shorter by the rounding of the time. */
static void leap(const struct linear *s, double h, double *y)
{
    size_t dim = s->dim;
    double *f = s->work, *step = f + dim, *rise = step + 2 * dim, rest = h;
    memcpy(f, s->f0, dim * sizeof *f);
    memset(rise, 0, dim * sizeof *rise);
    int k = doublings_within(&s->doublings, h);
    double length = doublings_length(&s->doublings, k);
    while (k >= 0) {
        if (!(rest >= (1 - negligible_sum) * length)) {
            k--;
            length /= 2;
            continue;
        }
        apply_matrix(dim, doublings_phi(&s->doublings, k), f, step);
        for (size_t i = 0; i < dim; i++) rise[i] += step[i];
        apply_matrix(dim, doublings_exponential(&s->doublings, k), f, step);
        memcpy(f, step, dim * sizeof *f);
        rest -= length;
    }
    climb_rest(s, rest, f, step, rise);
    for (size_t i = 0; i < dim; i++) y[i] = s->y0[i] + rise[i];
}

void linear_set_matrix(gsl_odeiv2_step *step, const double *A, double rho)
{
    struct linear *s = step->state;
    size_t size = s->dim * s->dim * sizeof *A;
    s->has_matrix = true;
    if (rho == s->rho && memcmp(A, s->A, size) == 0) return; /* as before the reset, with its doublings */
    memcpy(s->A, A, size);
    s->rho = rho;
    doublings_restart(&s->doublings, s->dim, rho);
}

static int set_matrix(struct linear *s, double t, const double *y, const gsl_odeiv2_system *sys)
{
    double *dfdt = s->work;
    int status = GSL_ODEIV_JA_EVAL(sys, t, y, s->A, dfdt);
    if (status != GSL_SUCCESS) return status;
    s->rho = stiffness_rate(s->dim, s->A, s->work);
    if (!isfinite(s->rho)) return GSL_FAILURE;
    doublings_restart(&s->doublings, s->dim, s->rho);
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
    s->degree = -1;
    memcpy(s->y0, y, dim * sizeof *y);
    memset(yerr, 0, dim * sizeof *yerr);
    if (!(h * s->rho < linear_reach)) return GSL_FAILURE;
    if (h * s->rho <= series_reach) {
        set_terms(s);
        sum_terms(s, 1, y);
    } else if (doublings_reach(&s->doublings, s->A, h)) {
        leap(s, h, y);
    } else {
        return GSL_ENOMEM; /* a shorter step needs none */
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

void linear_dense_eval(const gsl_odeiv2_step *step, double since, double *y)
{
    const struct linear *s = step->state;
    if (s->has_terms)
        sum_terms(s, since / s->h, y);
    else
        leap(s, since, y);
}

/* The series about the middle m of a piece, where the slope is f0 + A (y(m) - y0). Over half of a step h rho
 * is 1 at most, and the truncation error below 1/21! = 2e-20. Returns the degree. */
static int expand(const struct linear *s, const struct powers_piece *piece, double *c)
{
    double *f = s->work;
    sum_terms(s, piece->middle, c);
    for (size_t i = 0; i < s->dim; i++) c[s->dim + i] = c[i] - s->y0[i];
    apply_matrix(s->dim, s->A, c + s->dim, f);
    for (size_t i = 0; i < s->dim; i++) f[i] += s->f0[i];
    return make_series(s, piece->radius * s->h, linear_most_powers, f, c + s->dim);
}

int linear_dense_powers(const gsl_odeiv2_step *step, size_t i, const struct powers_piece *piece, double *c)
{
    struct linear *s = step->state;
    if (!s->stepped || !s->has_terms) return -1;
    bool same = s->degree >= 0 && piece->middle == s->piece.middle && piece->radius == s->piece.radius;
    if (!same) {
        s->piece = *piece;
        s->degree = expand(s, piece, s->power);
    }
    for (int k = 0; k <= s->degree; k++) c[k] = s->power[(size_t)k * s->dim + i];
    return s->degree;
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
