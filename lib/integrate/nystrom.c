/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/nystrom.h"

#include <gsl/gsl_errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "integrate/nystrom_sums.h"
#include "integrate/system.h"

struct nystrom {
    size_t n; /* pairs */
    double t, h;
    bool stepped, prepared;
    bool has_end;     /* entry 0 of the stages holds the accelerations at the end of the step */
    double *k;        /* n rows of the stages 1 .. 17 of one coordinate each */
    double *y0, *y1;  /* 2 n each: start and end of the last step */
    double *argument; /* 2 n: of the right-hand side */
    double *slopes;   /* 2 n: its result */
    double *a;        /* n rows of accelerations at the nodes of the dense output */
    double *q, *v;    /* n rows each: Legendre coefficients of the dense output */
    double memory[];
};

/* The stages of one coordinate are adjacent, as the sums over them take most of the time. Entry 0 is unused:
 * stage i of the paper is entry i. */
enum { row = nystrom_stages + 1 };

/* Dense output: a has a degree of 10 at most, v one and q two more. */
enum { q_terms = nystrom_nodes + 2, v_terms = nystrom_nodes + 1 };

static void *nystrom_alloc(size_t dim)
{
    size_t n = dim / 2, numbers = n * (row + nystrom_nodes + q_terms + v_terms) + 4 * dim;
    if (dim == 0 || dim % 2 != 0 || n > SIZE_MAX / sizeof(double) / (8 * (size_t)row)) return NULL;
    struct nystrom *s = block_alloc(sizeof *s + numbers * sizeof(double));
    if (!s) return NULL;
    s->n = n;
    s->k = s->memory;
    s->y0 = s->k + n * row;
    s->y1 = s->y0 + dim;
    s->argument = s->y1 + dim;
    s->slopes = s->argument + dim;
    s->a = s->slopes + dim;
    s->q = s->a + n * nystrom_nodes;
    s->v = s->q + n * q_terms;
    return s;
}

static void nystrom_free(void *state)
{
    free(state);
}

static int nystrom_reset(void *state, size_t dim)
{
    struct nystrom *s = state;
    (void)dim;
    s->stepped = s->prepared = false;
    return GSL_SUCCESS;
}

static unsigned int nystrom_order(void *state)
{
    (void)state;
    return 12;
}

static int nystrom_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state, (void)driver;
    return GSL_SUCCESS;
}

/* Stage i, whose argument is ready. */
static inline int evaluate(struct nystrom *s, int i, const gsl_odeiv2_system *sys)
{
    int status = counted_system_eval(sys, 2 * s->n, s->t + nystrom_c[i] * s->h, s->argument, s->slopes);
    if (status != GSL_SUCCESS) return status;
    for (size_t m = 0; m < s->n; m++) s->k[m * row + (size_t)i] = s->slopes[s->n + m];
    return GSL_SUCCESS;
}

/* Stage i: its argument, given the sum over the stages before, and its value. */
#define A(i, j) (nystrom_a[i][j] * k[j])
#define STAGE(i, sum)                                                                                        \
    for (size_t m = 0; m < s->n; m++) {                                                                      \
        const double *k = s->k + m * row;                                                                    \
        s->argument[m] = y[m] + (nystrom_c[i] * s->h * y[s->n + m] + s->h * s->h * (sum));                   \
    }                                                                                                        \
    if ((status = evaluate(s, i, sys))) return status;

static int stages_2_to_9(struct nystrom *s, const double *y, const gsl_odeiv2_system *sys)
{
    int status;
    NYSTROM_STAGES_2_TO_9(STAGE, A)
    return GSL_SUCCESS;
}

static int stages_10_to_14(struct nystrom *s, const double *y, const gsl_odeiv2_system *sys)
{
    int status;
    NYSTROM_STAGES_10_TO_14(STAGE, A)
    return GSL_SUCCESS;
}

static int stages_15_to_17(struct nystrom *s, const double *y, const gsl_odeiv2_system *sys)
{
    int status;
    NYSTROM_STAGES_15_TO_17(STAGE, A)
    return GSL_SUCCESS;
}

#undef A
#undef STAGE

/* y1 and its error. False if y1 is not finite. */
static bool finish(struct nystrom *s, const double *y, double *yerr)
{
    size_t n = s->n;
    double h = s->h, probe = 0;
    for (size_t m = 0; m < n; m++) {
        const double *k = s->k + m * row;
        double b = NYSTROM_SUM(nystrom_b, k), d = NYSTROM_SUM(nystrom_d, k);
        s->y1[m] = y[m] + (h * y[n + m] + h * h * b);
        s->y1[n + m] = y[n + m] + h * d;
        yerr[m] = h * h * (b - NYSTROM_SUM(nystrom_b_low, k));
        yerr[n + m] = h * (d - NYSTROM_SUM(nystrom_d_low, k));
        probe += 0 * (s->y1[m] + s->y1[n + m]);
    }
    return probe == 0;
}

static void keep_end(struct nystrom *s, const double *slopes)
{
    for (size_t m = 0; m < s->n; m++) s->k[m * row] = slopes[s->n + m];
    s->has_end = true;
}

static int nystrom_apply(void *state, size_t dim, double t, double h, double y[], double yerr[],
                         const double dydt_in[], double dydt_out[], const gsl_odeiv2_system *sys)
{
    struct nystrom *s = state;
    size_t n = s->n;
    int status = GSL_SUCCESS;
    s->stepped = s->prepared = false;
    s->t = t;
    s->h = h;
    if (!dydt_in) status = GSL_ODEIV_FN_EVAL(sys, t, y, s->slopes);
    if (status != GSL_SUCCESS) return status;
    const double *a0 = (dydt_in ? dydt_in : s->slopes) + n;
    for (size_t m = 0; m < n; m++) s->k[m * row + 1] = a0[m];
    memcpy(s->argument + n, y + n, n * sizeof *y);
    if ((status = stages_2_to_9(s, y, sys))) return status;
    if ((status = stages_10_to_14(s, y, sys))) return status;
    if ((status = stages_15_to_17(s, y, sys))) return status;
    if (!finish(s, y, yerr)) return GSL_FAILURE;
    s->has_end = false;
    if (dydt_out) {
        if ((status = GSL_ODEIV_FN_EVAL(sys, t + h, s->y1, dydt_out))) return status;
        keep_end(s, dydt_out);
    }
    memcpy(s->y0, y, dim * sizeof *y);
    memcpy(y, s->y1, dim * sizeof *y);
    s->stepped = true;
    return GSL_SUCCESS;
}

/* ---- dense output */

/* The integral from -1 of a Legendre series of `terms` coefficients; the result has one more:
 * int P_m = (P_(m+1) - P_(m-1)) / (2 m + 1), int P_0 = P_1 + P_0. */
static void integrate(const double *series, int terms, double *result)
{
    for (int m = 0; m <= terms; m++) result[m] = 0;
    result[0] = result[1] = series[0];
    for (int m = 1; m < terms; m++) {
        double part = series[m] / (2 * m + 1);
        result[m + 1] += part;
        result[m - 1] -= part;
    }
}

/* The curve of coordinate m, given the coefficients of its acceleration times h / 2. */
static void set_curve(struct nystrom *s, size_t m, const double *a)
{
    double half = s->h / 2, *q = s->q + m * q_terms, *v = s->v + m * v_terms;
    integrate(a, nystrom_nodes, v);
    v[0] += s->y0[s->n + m];
    integrate(v, v_terms, q);
    for (int i = 0; i < q_terms; i++) q[i] *= half;
    q[0] += s->y0[m];
}

/* The curve through the accelerations of the stages. */
static void curve_of_stages(struct nystrom *s)
{
    for (size_t m = 0; m < s->n; m++) {
        double a[nystrom_nodes] = {0};
        const double *k = s->k + m * row;
        for (int i = 0; i < nystrom_stage_nodes; i++) {
            for (int j = 0; j < nystrom_stage_nodes; j++)
                a[i] += nystrom_stage_legendre[i][j] * k[nystrom_node_stage[j]];
            a[i] *= s->h / 2;
        }
        set_curve(s, m, a);
    }
}

/* The curve through the accelerations at the nodes. */
static void curve_of_nodes(struct nystrom *s)
{
    for (size_t m = 0; m < s->n; m++) {
        double a[nystrom_nodes] = {0};
        for (int i = 0; i < nystrom_nodes; i++) {
            for (int j = 0; j < nystrom_nodes; j++)
                a[i] += nystrom_legendre[i][j] * s->a[m * nystrom_nodes + (size_t)j];
            a[i] *= s->h / 2;
        }
        set_curve(s, m, a);
    }
}

/* P_(i+1) = ahead[i] x P_i - back[i-1] P_(i-1): (2 i + 1)/(i + 1) and (i + 1)/(i + 2). Divisions would take
 * most of the time of an evaluation. */
static const double ahead[q_terms] = {1.0,      3.0 / 2,  5.0 / 3,   7.0 / 4,   9.0 / 5,   11.0 / 6, 13.0 / 7,
                                      15.0 / 8, 17.0 / 9, 19.0 / 10, 21.0 / 11, 23.0 / 12, 25.0 / 13};
static const double back[q_terms] = {1.0 / 2, 2.0 / 3,  3.0 / 4,   4.0 / 5,   5.0 / 6,   6.0 / 7,  7.0 / 8,
                                     8.0 / 9, 9.0 / 10, 10.0 / 11, 11.0 / 12, 12.0 / 13, 13.0 / 14};

/* sum c_i P_i(x) by Clenshaw's recurrence. */
static double legendre_sum(const double *c, int terms, double x)
{
    double next = 0, after = 0;
    for (int i = terms - 1; i > 0; i--) {
        double here = c[i] + ahead[i] * x * next - back[i] * after;
        after = next;
        next = here;
    }
    return c[0] + x * next - after / 2;
}

void nystrom_dense_eval(const gsl_odeiv2_step *step, double theta, double *y)
{
    const struct nystrom *s = step->state;
    for (size_t m = 0; m < s->n; m++) {
        y[m] = legendre_sum(s->q + m * q_terms, q_terms, 2 * theta - 1);
        y[s->n + m] = legendre_sum(s->v + m * v_terms, v_terms, 2 * theta - 1);
    }
}

/* The accelerations at the nodes, with inner positions from the present curve. */
static int fill_nodes(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys)
{
    struct nystrom *s = step->state;
    for (size_t m = 0; m < s->n; m++) {
        s->a[m * nystrom_nodes] = s->k[m * row + 1];
        s->a[m * nystrom_nodes + nystrom_nodes - 1] = s->k[m * row];
    }
    memcpy(s->argument, s->y0, 2 * s->n * sizeof *s->y0); /* the rates do not matter */
    for (size_t j = 1; j < nystrom_nodes - 1; j++) {
        for (size_t m = 0; m < s->n; m++)
            s->argument[m] = legendre_sum(s->q + m * q_terms, q_terms, 2 * nystrom_node[j] - 1);
        int status = GSL_ODEIV_FN_EVAL(sys, s->t + nystrom_node[j] * s->h, s->argument, s->slopes);
        if (status != GSL_SUCCESS) return status;
        for (size_t m = 0; m < s->n; m++) s->a[m * nystrom_nodes + j] = s->slopes[s->n + m];
    }
    return GSL_SUCCESS;
}

int nystrom_dense_prepare(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys)
{
    if (step->type != step_nystrom) return GSL_EINVAL;
    struct nystrom *s = step->state;
    if (!s->stepped) return GSL_EINVAL;
    if (s->prepared) return GSL_SUCCESS;
    if (!s->has_end) {
        int status = GSL_ODEIV_FN_EVAL(sys, s->t + s->h, s->y1, s->slopes);
        if (status != GSL_SUCCESS) return status;
        keep_end(s, s->slopes);
    }
    curve_of_stages(s);
    int status = fill_nodes(step, sys);
    if (status != GSL_SUCCESS) return status;
    curve_of_nodes(s);
    s->prepared = true;
    return GSL_SUCCESS;
}

static const gsl_odeiv2_step_type nystrom_type = {
    .name = "nystrom",
    .can_use_dydt_in = 1,
    .gives_exact_dydt_out = 1,
    .alloc = nystrom_alloc,
    .apply = nystrom_apply,
    .set_driver = nystrom_set_driver,
    .reset = nystrom_reset,
    .order = nystrom_order,
    .free = nystrom_free,
};

const gsl_odeiv2_step_type *const step_nystrom = &nystrom_type;
