/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/bsimp.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/lu.h"

enum { rows = 7 };

/* Half of each is odd, so that all errors oscillate alike where the system is stiff. */
static const int sequence[rows] = {2, 6, 10, 14, 22, 34, 50};

struct bsimp {
    size_t n;
    size_t *pivot;
    double *jacobian, *lu;             /* n^2 each */
    double *dfdt, *f0, *f, *y, *delta; /* n each */
    double *table;                     /* rows n: the latest row of the extrapolation */
    double memory[];
};

static void *bsimp_alloc(size_t n)
{
    enum { vectors = 5 };
    if (n == 0 || n > 1u << 20) return NULL; /* n^2 numbers cannot be allocated either */
    size_t doubles = 2 * n * n + (vectors + rows) * n;
    struct bsimp *s = calloc(1, sizeof *s + doubles * sizeof(double) + n * sizeof(size_t));
    if (!s) return NULL;
    s->n = n;
    s->jacobian = s->memory;
    s->lu = s->jacobian + n * n;
    s->dfdt = s->lu + n * n;
    s->f0 = s->dfdt + n;
    s->f = s->f0 + n;
    s->y = s->f + n;
    s->delta = s->y + n;
    s->table = s->delta + n;
    void *behind_doubles = s->table + rows * n; /* aligned for a size_t as well */
    s->pivot = behind_doubles;
    return s;
}

/* LU of I - h J. */
static bool decompose(struct bsimp *s, double h)
{
    size_t n = s->n;
    for (size_t i = 0; i < n * n; i++) s->lu[i] = -h * s->jacobian[i];
    for (size_t i = 0; i < n; i++) s->lu[i * n + i] += 1;
    return lu_decompose(n, s->lu, s->pivot);
}

/* Solve (I - h J) x = h f - delta, add x `times` times to delta, and delta to y. */
static void advance(struct bsimp *s, double h, double times)
{
    size_t n = s->n;
    double *x = s->f;
    for (size_t i = 0; i < n; i++) x[i] = h * x[i] - s->delta[i];
    lu_solve(n, s->lu, s->pivot, x);
    for (size_t i = 0; i < n; i++) {
        s->delta[i] += times * x[i];
        s->y[i] += s->delta[i];
    }
}

/* `count` steps over H from y0 and the smoothing step, into s->y. */
static int midpoint(struct bsimp *s, double t, double H, int count, const double *y0,
                    const gsl_odeiv2_system *sys)
{
    size_t n = s->n;
    double h = H / count;
    if (!decompose(s, h)) return GSL_FAILURE;
    memcpy(s->y, y0, n * sizeof *y0);
    memset(s->delta, 0, n * sizeof *s->delta);
    for (size_t i = 0; i < n; i++) s->f[i] = s->f0[i] + h * s->dfdt[i];
    advance(s, h, 1);
    for (int k = 1; k < count; k++) {
        int status = GSL_ODEIV_FN_EVAL(sys, t + k * h, s->y, s->f);
        if (status != GSL_SUCCESS) return status;
        advance(s, h, 2);
    }
    int status = GSL_ODEIV_FN_EVAL(sys, t + H, s->y, s->f);
    if (status != GSL_SUCCESS) return status;
    for (size_t i = 0; i < n; i++) s->f[i] = h * s->f[i] - s->delta[i];
    lu_solve(n, s->lu, s->pivot, s->f);
    for (size_t i = 0; i < n; i++) s->y[i] += s->f[i];
    return GSL_SUCCESS;
}

/* Row k of Aitken and Neville's scheme in h^2 begins with s->y; its last two entries differ by yerr. In a
 * step that is far too long for the scheme they may agree by accident, after rows that do not: so the error
 * also contains a part of the result of the row before, about as much as a row gains in steps of suitable
 * length, a multiple of (n_0 / n_k)^2. */
static void extrapolate(struct bsimp *s, int k, double *yerr)
{
    const double share = 0.02;
    size_t n = s->n;
    for (size_t i = 0; i < n; i++) {
        double value = s->y[i], change = 0, before_that = k > 1 ? share * fabs(yerr[i]) : 0;
        for (int j = 0; j < k; j++) {
            double *before = &s->table[(size_t)j * n + i];
            double ratio = (double)sequence[k] / sequence[k - 1 - j];
            change = (value - *before) / (ratio * ratio - 1);
            *before = value;
            value += change;
        }
        s->table[(size_t)k * n + i] = value;
        yerr[i] = k == rows - 1 ? fmax(fabs(change), before_that) : change;
    }
}

static int bsimp_apply(void *state, size_t n, double t, double h, double y[], double yerr[],
                       const double dydt_in[], double dydt_out[], const gsl_odeiv2_system *sys)
{
    struct bsimp *s = state;
    int status = dydt_in ? GSL_SUCCESS : GSL_ODEIV_FN_EVAL(sys, t, y, s->f0);
    if (dydt_in) memcpy(s->f0, dydt_in, n * sizeof *s->f0);
    if (status == GSL_SUCCESS) status = GSL_ODEIV_JA_EVAL(sys, t, y, s->jacobian, s->dfdt);
    for (int k = 0; k < rows && status == GSL_SUCCESS; k++) {
        status = midpoint(s, t, h, sequence[k], y, sys);
        if (status == GSL_SUCCESS) extrapolate(s, k, yerr);
    }
    if (status != GSL_SUCCESS) return status;
    const double *end = s->table + (rows - 1) * n;
    if (dydt_out) status = GSL_ODEIV_FN_EVAL(sys, t + h, end, dydt_out);
    if (status == GSL_SUCCESS) memcpy(y, end, n * sizeof *y);
    return status;
}

static int bsimp_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state, (void)driver;
    return GSL_SUCCESS;
}

/* There is no state between steps. */
static int bsimp_reset(void *state, size_t n)
{
    (void)state, (void)n;
    return GSL_SUCCESS;
}

static unsigned int bsimp_order(void *state)
{
    (void)state;
    return 2 * (rows - 1);
}

static const gsl_odeiv2_step_type bsimp_type = {
    .name = "bsimp",
    .can_use_dydt_in = 1,
    .gives_exact_dydt_out = 1,
    .alloc = bsimp_alloc,
    .apply = bsimp_apply,
    .set_driver = bsimp_set_driver,
    .reset = bsimp_reset,
    .order = bsimp_order,
    .free = free,
};

const gsl_odeiv2_step_type *const step_bsimp = &bsimp_type;
