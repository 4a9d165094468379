/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/rodas5p.h"

#include <gsl/gsl_errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "integrate/rodas5p_table.h"
#include "numeric/lu.h"

enum { dense_terms = 3 };

/* Offsets of the vectors of n numbers in the one block of memory. u_i of the table is vector i. */
enum {
    v_start = rodas5p_stages + 1, /* y0 */
    v_argument,                   /* g_i; at last y1 */
    v_linearized,                 /* y of the Jacobian */
    v_dfdt,
    v_dense,
    v_count = v_dense + dense_terms
};

struct rodas5p {
    size_t n;
    double t, h;     /* start and size of the last step */
    bool stepped;    /* the vectors hold a step */
    bool prepared;   /* ... its dense output */
    bool has_matrix; /* the Jacobian is that at (matrix_t, v_linearized) of this system: */
    double matrix_t;
    gsl_odeiv2_system matrix_of;
    double *jacobian; /* n^2 */
    double *lu;       /* n^2 */
    size_t *pivot;    /* n */
    double v[];
};

static double *vector(struct rodas5p *s, int index)
{
    return s->v + (size_t)index * s->n;
}

static void *rodas5p_alloc(size_t n)
{
    if (n == 0 || n > SIZE_MAX / 64) return NULL;
    size_t columns = v_count + 2 * n, room = SIZE_MAX - sizeof(struct rodas5p);
    if (columns > room / n / sizeof(double) - 1) return NULL;
    struct rodas5p *s = block_alloc(sizeof *s + n * (columns * sizeof(double) + sizeof(size_t)));
    if (!s) return NULL;
    s->n = n;
    s->jacobian = vector(s, v_count);
    s->lu = s->jacobian + n * n;
    void *behind_doubles = s->lu + n * n; /* aligned for a size_t as well */
    s->pivot = behind_doubles;
    return s;
}

static void rodas5p_free(void *state)
{
    free(state);
}

static int rodas5p_reset(void *state, size_t n)
{
    struct rodas5p *s = state;
    (void)n;
    s->stepped = s->prepared = s->has_matrix = false;
    return GSL_SUCCESS;
}

static unsigned int rodas5p_order(void *state)
{
    (void)state;
    return 5;
}

static int rodas5p_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state, (void)driver;
    return GSL_SUCCESS;
}

static bool is_linearized(struct rodas5p *s, const double *y, const gsl_odeiv2_system *sys)
{
    const gsl_odeiv2_system *of = &s->matrix_of;
    return s->has_matrix && s->matrix_t == s->t && of->params == sys->params &&
           of->jacobian == sys->jacobian && memcmp(vector(s, v_linearized), y, s->n * sizeof *y) == 0;
}

/* Jacobian and df/dt at (t, y), unless computed in an earlier attempt. */
static int linearize(struct rodas5p *s, const double *y, const gsl_odeiv2_system *sys)
{
    if (is_linearized(s, y, sys)) return GSL_SUCCESS;
    s->has_matrix = false;
    if (!sys->jacobian) return GSL_EINVAL;
    int status = GSL_ODEIV_JA_EVAL(sys, s->t, y, s->jacobian, vector(s, v_dfdt));
    if (status != GSL_SUCCESS) return status;
    memcpy(vector(s, v_linearized), y, s->n * sizeof *y);
    s->matrix_t = s->t;
    s->matrix_of = *sys;
    s->has_matrix = true;
    return GSL_SUCCESS;
}

/* LU of W = I / (gamma h) - J. */
static int decompose(struct rodas5p *s)
{
    size_t n = s->n;
    double diagonal = 1 / (rodas5p_gamma * s->h);
    for (size_t i = 0; i < n * n; i++) s->lu[i] = -s->jacobian[i];
    for (size_t i = 0; i < n; i++) s->lu[i * n + i] += diagonal;
    return lu_decompose(n, s->lu, s->pivot) ? GSL_SUCCESS : GSL_FAILURE;
}

/* The sum over all stages before i with these coefficients, for component m. The inner loop is over the
 * stages, as most systems have only two or four components. */
static inline double combined(const struct rodas5p *s, int i, const double *coefficient, size_t m)
{
    const double *u = s->v + m;
    double sum = 0;
    for (int j = 1; j < i; j++) sum += coefficient[j] * u[(size_t)j * s->n];
    return sum;
}

/* Set g_i in v_argument, which holds g_(i-1). */
static void make_argument(struct rodas5p *s, int i, const double *y)
{
    size_t n = s->n;
    double *g = vector(s, v_argument);
    if (i > 6) {
        const double *last = vector(s, i - 1);
        for (size_t m = 0; m < n; m++) g[m] += last[m];
        return;
    }
    for (size_t m = 0; m < n; m++) g[m] = y[m] + combined(s, i, rodas5p_a[i], m);
}

/* Solve for u_i in the vector that holds f(t + c_i h, g_i). */
static void solve_stage(struct rodas5p *s, int i)
{
    size_t n = s->n;
    double *u = vector(s, i);
    const double *dfdt = vector(s, v_dfdt), share = s->h * rodas5p_d[i], per_h = 1 / s->h;
    for (size_t m = 0; m < n; m++) u[m] += share * dfdt[m] + per_h * combined(s, i, rodas5p_C[i], m);
    lu_solve(n, s->lu, s->pivot, u);
}

static int make_stages(struct rodas5p *s, const double *y, const double *dydt_in,
                       const gsl_odeiv2_system *sys)
{
    for (int i = 1; i <= rodas5p_stages; i++) {
        int status = GSL_SUCCESS;
        make_argument(s, i, y);
        if (i == 1 && dydt_in)
            memcpy(vector(s, 1), dydt_in, s->n * sizeof *dydt_in);
        else
            status = GSL_ODEIV_FN_EVAL(sys, s->t + rodas5p_c[i] * s->h, vector(s, v_argument), vector(s, i));
        if (status != GSL_SUCCESS) return status;
        solve_stage(s, i);
    }
    return GSL_SUCCESS;
}

/* y1 and its error. False if y1 is not finite: zero times a sum is zero unless an infinity or a NaN is among
 * its terms. */
static bool finish(struct rodas5p *s, double *yerr)
{
    const double *last = vector(s, rodas5p_stages);
    double *y1 = vector(s, v_argument), probe = 0;
    for (size_t i = 0; i < s->n; i++) {
        y1[i] += last[i];
        yerr[i] = last[i];
        probe += 0 * y1[i];
    }
    return probe == 0;
}

static int rodas5p_apply(void *state, size_t n, double t, double h, double y[], double yerr[],
                         const double dydt_in[], double dydt_out[], const gsl_odeiv2_system *sys)
{
    struct rodas5p *s = state;
    s->stepped = s->prepared = false;
    s->t = t;
    s->h = h;
    int status = linearize(s, y, sys);
    if (status == GSL_SUCCESS) status = decompose(s);
    if (status == GSL_SUCCESS) status = make_stages(s, y, dydt_in, sys);
    if (status != GSL_SUCCESS) return status;

    const double *y1 = vector(s, v_argument);
    if (!finish(s, yerr)) return GSL_FAILURE;
    if (dydt_out) status = GSL_ODEIV_FN_EVAL(sys, t + h, y1, dydt_out);
    if (status != GSL_SUCCESS) return status;
    memcpy(vector(s, v_start), y, n * sizeof *y);
    memcpy(y, y1, n * sizeof *y);
    s->stepped = true;
    return GSL_SUCCESS;
}

int rodas5p_dense_prepare(gsl_odeiv2_step *step)
{
    if (step->type != step_rodas5p) return GSL_EINVAL;
    struct rodas5p *s = step->state;
    if (!s->stepped) return GSL_EINVAL;
    if (s->prepared) return GSL_SUCCESS;
    for (int m = 0; m < dense_terms; m++) {
        double *e = vector(s, v_dense + m);
        for (size_t i = 0; i < s->n; i++) {
            e[i] = 0;
            for (size_t j = 1; j <= rodas5p_stages; j++) e[i] += rodas5p_h[m][j] * s->v[j * s->n + i];
        }
    }
    s->prepared = true;
    return GSL_SUCCESS;
}

void rodas5p_dense_eval(const gsl_odeiv2_step *step, double theta, double *y)
{
    const struct rodas5p *s = step->state;
    size_t n = s->n;
    const double *y0 = s->v + v_start * n, *y1 = s->v + v_argument * n, *e = s->v + v_dense * n;
    double rest = 1 - theta;
    for (size_t i = 0; i < n; i++) {
        double bend = e[i] + theta * (e[n + i] + theta * e[2 * n + i]);
        y[i] = y0[i] + theta * (y1[i] - y0[i] + rest * bend);
    }
}

const double *rodas5p_jacobian(const gsl_odeiv2_step *step)
{
    if (step->type != step_rodas5p) return NULL;
    const struct rodas5p *s = step->state;
    return s->has_matrix ? s->jacobian : NULL;
}

static const gsl_odeiv2_step_type rodas5p_type = {
    .name = "rodas5p",
    .can_use_dydt_in = 1,
    .gives_exact_dydt_out = 1,
    .alloc = rodas5p_alloc,
    .apply = rodas5p_apply,
    .set_driver = rodas5p_set_driver,
    .reset = rodas5p_reset,
    .order = rodas5p_order,
    .free = rodas5p_free,
};

const gsl_odeiv2_step_type *const step_rodas5p = &rodas5p_type;
