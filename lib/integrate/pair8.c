/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/pair8.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/zeroed.h"
#include "integrate/dop853_table.h"
#include "integrate/rk8pd_table.h"

enum { dense_terms = 8 };

/* Where the vectors of n numbers lie in the one block of memory. Stage i of the book is vector i, and 13 is the slope at the
 * end; stage 13 of rk8pd, which has no dense output of its own, lies where dop853 has the first stage of that. */
enum {
    v_stage_13 = 14,             /* of rk8pd */
    v_start = dop853_stages + 1, /* y0 */
    v_end,                       /* y1 */
    v_rest,                      /* what y0 has lost by rounding so far */
    v_rest_end,                  /* ... and y1 */
    v_argument,                  /* argument of the right-hand side */
    v_dense,
    v_count = v_dense + dense_terms
};

struct pair8 {
    size_t n;
    double t, h;        /* start and size of the last step */
    bool stepped;       /* a step stands in the vectors */
    bool has_rest;      /* so do the rests of its ends */
    bool has_end_slope; /* so does the slope at its end */
    bool prepared;      /* so does the dense output */
    double v[];
};

#define INLINE static inline __attribute__((always_inline))

/* Both pairs have their stages from the same of those before, so their sums are written once. */
struct tableau {
    const double *c;
    const double (*a)[dop853_stages + 1];
    const double *b, *e; /* weights of the step; of the difference to its companion, */
    const double *low;   /* and of that to one of lower order, or NULL */
    bool more;           /* stage 13 is one of the step */
};

static const struct tableau dop853 = {dop853_c, dop853_a, dop853_a[13], dop853_e5, dop853_e3, false};
static const struct tableau rk8pd = {rk8pd_c, rk8pd_a, rk8pd_a[14], rk8pd_e7, NULL, true};

/* Of the n numbers that the caller knows to be s->n: see `stages`. */
INLINE double *vector_of(struct pair8 *s, size_t n, int index)
{
    return s->v + (size_t)index * n;
}

static double *vector(struct pair8 *s, int index)
{
    return vector_of(s, s->n, index);
}

static void *pair8_alloc(size_t n)
{
    if (n > (SIZE_MAX - sizeof(struct pair8)) / (v_count * sizeof(double))) return NULL;
    struct pair8 *s = zeroed(sizeof *s + v_count * n * sizeof(double));
    if (s) s->n = n;
    return s;
}

static void pair8_free(void *state)
{
    free(state);
}

static int pair8_reset(void *state, size_t n)
{
    struct pair8 *s = state;
    (void)n;
    s->stepped = s->prepared = s->has_rest = false;
    return GSL_SUCCESS;
}

static unsigned int pair8_order(void *state)
{
    (void)state;
    return 8;
}

static int pair8_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state, (void)driver;
    return GSL_SUCCESS;
}

/* Stage i, whose argument is ready. */
INLINE int evaluate(struct pair8 *s, const struct tableau *tableau, size_t n, int i,
                    const gsl_odeiv2_system *sys)
{
    double *argument = vector_of(s, n, v_argument);
    return GSL_ODEIV_FN_EVAL(sys, s->t + tableau->c[i] * s->h, argument, vector_of(s, n, i));
}

/* Sums are written out: a loop over the coefficients takes a tenth more time for the step of a pendulum.
 *
 * `volatile` keeps compilers from using vector instructions. Vectors of two would be filled from what the
 * right-hand side has just stored number by number, and a wide load must wait for narrow stores to leave
 * the processor's store buffer: in the systems of two numbers that most scenes are, the step takes 40 %
 * more time (gcc -O3, clang -O2). In a system of twenty the vectors would save a tenth of the sums, which
 * are little beside its right-hand side. */
INLINE int stages_2_to_7(struct pair8 *s, const struct tableau *tableau, size_t n, const double *y,
                         const gsl_odeiv2_system *sys)
{
    const double(*a)[dop853_stages + 1] = tableau->a;
    const double *k1 = vector_of(s, n, 1), *k2 = vector_of(s, n, 2), *k3 = vector_of(s, n, 3);
    const double *k4 = vector_of(s, n, 4), *k5 = vector_of(s, n, 5), *k6 = vector_of(s, n, 6);
    const double *r = vector_of(s, n, v_rest);
    volatile double *u = vector_of(s, n, v_argument);
    double h = s->h;
    int status;
    for (size_t i = 0; i < n; i++) u[i] = y[i] + (r[i] + h * (a[2][1] * k1[i]));
    if ((status = evaluate(s, tableau, n, 2, sys))) return status;
    for (size_t i = 0; i < n; i++) u[i] = y[i] + (r[i] + h * (a[3][1] * k1[i] + a[3][2] * k2[i]));
    if ((status = evaluate(s, tableau, n, 3, sys))) return status;
    for (size_t i = 0; i < n; i++) u[i] = y[i] + (r[i] + h * (a[4][1] * k1[i] + a[4][3] * k3[i]));
    if ((status = evaluate(s, tableau, n, 4, sys))) return status;
    for (size_t i = 0; i < n; i++)
        u[i] = y[i] + (r[i] + h * (a[5][1] * k1[i] + a[5][3] * k3[i] + a[5][4] * k4[i]));
    if ((status = evaluate(s, tableau, n, 5, sys))) return status;
    for (size_t i = 0; i < n; i++)
        u[i] = y[i] + (r[i] + h * (a[6][1] * k1[i] + a[6][4] * k4[i] + a[6][5] * k5[i]));
    if ((status = evaluate(s, tableau, n, 6, sys))) return status;
    for (size_t i = 0; i < n; i++)
        u[i] = y[i] + (r[i] + h * (a[7][1] * k1[i] + a[7][4] * k4[i] + a[7][5] * k5[i] + a[7][6] * k6[i]));
    return evaluate(s, tableau, n, 7, sys);
}

INLINE int stages_8_to_12(struct pair8 *s, const struct tableau *tableau, size_t n, const double *y,
                          const gsl_odeiv2_system *sys)
{
    const double(*a)[dop853_stages + 1] = tableau->a;
    const double *k1 = vector_of(s, n, 1), *k4 = vector_of(s, n, 4), *k5 = vector_of(s, n, 5);
    const double *k6 = vector_of(s, n, 6), *k7 = vector_of(s, n, 7), *k8 = vector_of(s, n, 8);
    const double *k9 = vector_of(s, n, 9), *k10 = vector_of(s, n, 10), *k11 = vector_of(s, n, 11);
    const double *r = vector_of(s, n, v_rest);
    volatile double *u = vector_of(s, n, v_argument);
    double h = s->h;
    int status;
    for (size_t i = 0; i < n; i++)
        u[i] = y[i] + (r[i] + h * (a[8][1] * k1[i] + a[8][4] * k4[i] + a[8][5] * k5[i] + a[8][6] * k6[i] +
                                   a[8][7] * k7[i]));
    if ((status = evaluate(s, tableau, n, 8, sys))) return status;
    for (size_t i = 0; i < n; i++)
        u[i] = y[i] + (r[i] + h * (a[9][1] * k1[i] + a[9][4] * k4[i] + a[9][5] * k5[i] + a[9][6] * k6[i] +
                                   a[9][7] * k7[i] + a[9][8] * k8[i]));
    if ((status = evaluate(s, tableau, n, 9, sys))) return status;
    for (size_t i = 0; i < n; i++)
        u[i] = y[i] + (r[i] + h * (a[10][1] * k1[i] + a[10][4] * k4[i] + a[10][5] * k5[i] + a[10][6] * k6[i] +
                                   a[10][7] * k7[i] + a[10][8] * k8[i] + a[10][9] * k9[i]));
    if ((status = evaluate(s, tableau, n, 10, sys))) return status;
    for (size_t i = 0; i < n; i++)
        u[i] =
            y[i] + (r[i] + h * (a[11][1] * k1[i] + a[11][4] * k4[i] + a[11][5] * k5[i] + a[11][6] * k6[i] +
                                a[11][7] * k7[i] + a[11][8] * k8[i] + a[11][9] * k9[i] + a[11][10] * k10[i]));
    if ((status = evaluate(s, tableau, n, 11, sys))) return status;
    for (size_t i = 0; i < n; i++)
        u[i] = y[i] + (r[i] + h * (a[12][1] * k1[i] + a[12][4] * k4[i] + a[12][5] * k5[i] + a[12][6] * k6[i] +
                                   a[12][7] * k7[i] + a[12][8] * k8[i] + a[12][9] * k9[i] +
                                   a[12][10] * k10[i] + a[12][11] * k11[i]));
    return evaluate(s, tableau, n, 12, sys);
}

/* Of rk8pd; its row has no stage 12. */
INLINE int stage_13(struct pair8 *s, const struct tableau *tableau, size_t n, const double *y,
                    const gsl_odeiv2_system *sys)
{
    const double *a = tableau->a[13];
    const double *k1 = vector_of(s, n, 1), *k4 = vector_of(s, n, 4), *k5 = vector_of(s, n, 5);
    const double *k6 = vector_of(s, n, 6), *k7 = vector_of(s, n, 7), *k8 = vector_of(s, n, 8);
    const double *k9 = vector_of(s, n, 9), *k10 = vector_of(s, n, 10), *k11 = vector_of(s, n, 11);
    const double *r = vector_of(s, n, v_rest);
    double *u = vector_of(s, n, v_argument), h = s->h;
    for (size_t i = 0; i < n; i++)
        ((volatile double *)u)[i] =
            y[i] + (r[i] + h * (a[1] * k1[i] + a[4] * k4[i] + a[5] * k5[i] + a[6] * k6[i] + a[7] * k7[i] +
                                a[8] * k8[i] + a[9] * k9[i] + a[10] * k10[i] + a[11] * k11[i]));
    return GSL_ODEIV_FN_EVAL(sys, s->t + h, u, vector_of(s, n, v_stage_13));
}

/* The error estimate of dop853 from its two parts. The test is `!= 0`, so that a NaN stays one for the
 * control. */
static inline double estimate(double e5, double e3)
{
    double square = e5 * e5 + 0.01 * e3 * e3;
    return square != 0 ? e5 * fabs(e5) / sqrt(square) : 0;
}

/* a + b - sum exactly, where `sum` is a + b rounded (Knuth, The Art of Computer Programming 2, 4.2.2, theorem
 * C). */
static inline double lost(double a, double b, double sum)
{
    double b_part = sum - a, a_part = sum - b_part;
    return (a - a_part) + (b - b_part);
}

/* y1 and its error. False if y1 is not finite: zero times a sum is zero unless an infinity or a NaN is
 * among its terms. */
INLINE bool finish(struct pair8 *s, const struct tableau *tableau, size_t n, const double *restrict y,
                   double *restrict yerr)
{
    const double *restrict r = vector_of(s, n, v_rest);
    double *restrict r1 = vector_of(s, n, v_rest_end);
    const double *b = tableau->b, *p = tableau->e, *q = tableau->low;
    const double *restrict k1 = vector_of(s, n, 1), *restrict k6 = vector_of(s, n, 6),
                           *restrict k7 = vector_of(s, n, 7);
    const double *restrict k8 = vector_of(s, n, 8), *restrict k9 = vector_of(s, n, 9),
                           *restrict k10 = vector_of(s, n, 10);
    const double *restrict k11 = vector_of(s, n, 11), *restrict k12 = vector_of(s, n, 12);
    const double *restrict more = vector_of(s, n, v_stage_13);
    double *restrict y1 = vector_of(s, n, v_end), h = s->h, probe = 0;
    for (size_t i = 0; i < n; i++) {
        double sum = b[1] * k1[i] + b[6] * k6[i] + b[7] * k7[i] + b[8] * k8[i] + b[9] * k9[i] +
                     b[10] * k10[i] + b[11] * k11[i] + b[12] * k12[i];
        double e = p[1] * k1[i] + p[6] * k6[i] + p[7] * k7[i] + p[8] * k8[i] + p[9] * k9[i] + p[10] * k10[i] +
                   p[11] * k11[i] + p[12] * k12[i];
        if (tableau->more) {
            sum += b[13] * more[i];
            e += p[13] * more[i];
        }
        yerr[i] = h * e;
        if (q) {
            double low = q[1] * k1[i] + q[6] * k6[i] + q[7] * k7[i] + q[8] * k8[i] + q[9] * k9[i] +
                         q[10] * k10[i] + q[11] * k11[i] + q[12] * k12[i];
            yerr[i] = estimate(h * e, h * low);
        }
        double rise = r[i] + h * sum;
        y1[i] = y[i] + rise;
        r1[i] = lost(y[i], rise, y1[i]);
        probe += 0 * y1[i];
    }
    return probe == 0;
}

INLINE int stages(struct pair8 *s, const struct tableau *tableau, size_t n, const double *y, double *yerr,
                  const gsl_odeiv2_system *sys)
{
    int status = stages_2_to_7(s, tableau, n, y, sys);
    if (status == GSL_SUCCESS) status = stages_8_to_12(s, tableau, n, y, sys);
    if (status == GSL_SUCCESS && tableau->more) status = stage_13(s, tableau, n, y, sys);
    if (status != GSL_SUCCESS) return status;
    return finish(s, tableau, n, y, yerr) ? GSL_SUCCESS : GSL_FAILURE;
}

/* Scenes of one, two and three coordinates are most, and the shortest: with their number a constant the stages lie at
 * constant places, which saves a third of the instructions of the sums. */
INLINE int make_stages(struct pair8 *s, const struct tableau *tableau, const double *y, double *yerr,
                       const gsl_odeiv2_system *sys)
{
    switch (s->n) {
    case 2: return stages(s, tableau, 2, y, yerr, sys);
    case 4: return stages(s, tableau, 4, y, yerr, sys);
    case 6: return stages(s, tableau, 6, y, yerr, sys);
    default: return stages(s, tableau, s->n, y, yerr, sys);
    }
}

/* Which rest belongs to the y that a step starts from: that of the last start when it is tried again, that of
 * the last end when it goes on; none for a component that someone has changed since. */
static void take_rest(struct pair8 *s, double t, const double *y)
{
    bool again = t == s->t;
    const double *known = vector(s, again ? v_start : v_end);
    const double *rest = vector(s, again ? v_rest : v_rest_end);
    double *r = vector(s, v_rest);
    for (size_t i = 0; i < s->n; i++) r[i] = s->has_rest && y[i] == known[i] ? rest[i] : 0;
}

INLINE int apply(struct pair8 *s, const struct tableau *tableau, size_t n, double t, double h, double y[],
                 double yerr[], const double dydt_in[], double dydt_out[], const gsl_odeiv2_system *sys)
{
    size_t size = n * sizeof(double);
    int status = GSL_SUCCESS;
    take_rest(s, t, y);
    memcpy(vector(s, v_start), y, size);
    s->stepped = s->prepared = s->has_rest = false;
    s->t = t;
    s->h = h;
    if (dydt_in)
        memcpy(vector(s, 1), dydt_in, size);
    else
        status = GSL_ODEIV_FN_EVAL(sys, t, y, vector(s, 1));
    if (status == GSL_SUCCESS) status = make_stages(s, tableau, y, yerr, sys);
    if (status != GSL_SUCCESS) return status;

    double *y1 = vector(s, v_end);
    s->has_end_slope = dydt_out != NULL;
    if (dydt_out) {
        status = GSL_ODEIV_FN_EVAL(sys, t + h, y1, dydt_out);
        if (status != GSL_SUCCESS) return status;
        memcpy(vector(s, 13), dydt_out, size);
    }
    memcpy(y, y1, size);
    s->stepped = s->has_rest = true;
    return GSL_SUCCESS;
}

static int dop853_apply(void *state, size_t n, double t, double h, double y[], double yerr[],
                        const double dydt_in[], double dydt_out[], const gsl_odeiv2_system *sys)
{
    return apply(state, &dop853, n, t, h, y, yerr, dydt_in, dydt_out, sys);
}

static int rk8pd_apply(void *state, size_t n, double t, double h, double y[], double yerr[],
                       const double dydt_in[], double dydt_out[], const gsl_odeiv2_system *sys)
{
    return apply(state, &rk8pd, n, t, h, y, yerr, dydt_in, dydt_out, sys);
}

/* The arguments of the stages that dense output alone needs, written out as those of the step: every step with something
 * to watch makes them. */
INLINE int dense_stages(struct pair8 *s, size_t n, const gsl_odeiv2_system *sys)
{
    const double(*a)[dop853_stages + 1] = dop853_a;
    const double *k1 = vector_of(s, n, 1), *k6 = vector_of(s, n, 6), *k7 = vector_of(s, n, 7),
                 *k8 = vector_of(s, n, 8);
    const double *k9 = vector_of(s, n, 9), *k10 = vector_of(s, n, 10), *k11 = vector_of(s, n, 11),
                 *k12 = vector_of(s, n, 12);
    const double *k13 = vector_of(s, n, 13), *k14 = vector_of(s, n, 14), *k15 = vector_of(s, n, 15),
                 *y0 = vector_of(s, n, v_start);
    volatile double *u = vector_of(s, n, v_argument);
    double h = s->h;
    int status;
    for (size_t i = 0; i < n; i++)
        u[i] =
            y0[i] + h * (a[14][1] * k1[i] + a[14][7] * k7[i] + a[14][8] * k8[i] + a[14][9] * k9[i] +
                         a[14][10] * k10[i] + a[14][11] * k11[i] + a[14][12] * k12[i] + a[14][13] * k13[i]);
    if ((status = evaluate(s, &dop853, n, 14, sys))) return status;
    for (size_t i = 0; i < n; i++)
        u[i] =
            y0[i] + h * (a[15][1] * k1[i] + a[15][6] * k6[i] + a[15][7] * k7[i] + a[15][8] * k8[i] +
                         a[15][11] * k11[i] + a[15][12] * k12[i] + a[15][13] * k13[i] + a[15][14] * k14[i]);
    if ((status = evaluate(s, &dop853, n, 15, sys))) return status;
    for (size_t i = 0; i < n; i++)
        u[i] = y0[i] + h * (a[16][1] * k1[i] + a[16][6] * k6[i] + a[16][7] * k7[i] + a[16][8] * k8[i] +
                            a[16][9] * k9[i] + a[16][13] * k13[i] + a[16][14] * k14[i] + a[16][15] * k15[i]);
    return evaluate(s, &dop853, n, 16, sys);
}

/* h times the sum with a row d, for the component whose first stage is k; stages are n apart. */
INLINE double high_term(double h, const double *d, const double *k, size_t n)
{
    const double *k6 = k + 5 * n;
    return h * (d[1] * k[0] + d[6] * k6[0] + d[7] * k6[n] + d[8] * k6[2 * n] + d[9] * k6[3 * n] +
                d[10] * k6[4 * n] + d[11] * k6[5 * n] + d[12] * k6[6 * n] + d[13] * k6[7 * n] +
                d[14] * k6[8 * n] + d[15] * k6[9 * n] + d[16] * k6[10 * n]);
}

/* The polynomial of dop853_dense_eval from its end values and end slopes, and from the rows d (HNW I,
 * II.6).
 */
INLINE void set_polynomial(struct pair8 *s, size_t n)
{
    double *c = vector_of(s, n, v_dense);
    const double *y0 = vector_of(s, n, v_start), *y1 = vector_of(s, n, v_end);
    const double *k1 = vector_of(s, n, 1), *k13 = vector_of(s, n, 13);
    for (size_t i = 0; i < n; i++) {
        double rise = y1[i] - y0[i], bend = s->h * k1[i] - rise;
        c[i] = y0[i];
        c[n + i] = rise;
        c[2 * n + i] = bend;
        c[3 * n + i] = rise - s->h * k13[i] - bend;
        for (size_t m = 0; m < 4; m++) c[(4 + m) * n + i] = high_term(s->h, dop853_d[m], k1 + i, n);
    }
}

INLINE int make_dense(struct pair8 *s, size_t n, const gsl_odeiv2_system *sys)
{
    int status = dense_stages(s, n, sys);
    if (status == GSL_SUCCESS) set_polynomial(s, n);
    return status;
}

/* As make_stages. */
static int prepare_dense(struct pair8 *s, const gsl_odeiv2_system *sys)
{
    switch (s->n) {
    case 2: return make_dense(s, 2, sys);
    case 4: return make_dense(s, 4, sys);
    case 6: return make_dense(s, 6, sys);
    default: return make_dense(s, s->n, sys);
    }
}

int dop853_dense_prepare(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys)
{
    if (step->type != step_dop853) return GSL_EINVAL;
    struct pair8 *s = step->state;
    if (!s->stepped) return GSL_EINVAL;
    if (s->prepared) return GSL_SUCCESS;
    int status = GSL_SUCCESS;
    if (!s->has_end_slope) status = GSL_ODEIV_FN_EVAL(sys, s->t + s->h, vector(s, v_end), vector(s, 13));
    if (status == GSL_SUCCESS) status = prepare_dense(s, sys);
    s->prepared = status == GSL_SUCCESS;
    return status;
}

void dop853_dense_eval(const gsl_odeiv2_step *step, double theta, double *y)
{
    const struct pair8 *s = step->state;
    size_t n = s->n;
    const double *c = s->v + v_dense * n;
    double rest = 1 - theta;
    for (size_t i = 0; i < n; i++) {
        double high = c[4 * n + i] + theta * (c[5 * n + i] + rest * (c[6 * n + i] + theta * c[7 * n + i]));
        y[i] = c[i] + theta * (c[n + i] + rest * (c[2 * n + i] + theta * (c[3 * n + i] + rest * high)));
    }
}

int dop853_dense_powers(const gsl_odeiv2_step *step, size_t i, const struct powers_piece *piece, double *c)
{
    const struct pair8 *s = step->state;
    size_t n = s->n;
    const double *p = s->v + v_dense * n + i;
    int degree = 0;
    c[0] = p[7 * n];
    for (size_t m = 6;; m--) {
        bool falls = m % 2 == 1; /* as dop853_dense_eval has it */
        degree = falls ? powers_times_rest(degree, c, piece) : powers_times_theta(degree, c, piece);
        c[0] += p[m * n];
        if (m == 0) return degree;
    }
}

bool pair8_differences(const gsl_odeiv2_step *step, const double **dy, const double **df)
{
    if (step->type != step_dop853 && step->type != step_rk8pd) return false;
    struct pair8 *s = step->state;
    if (!s->stepped || s->prepared || !s->has_end_slope) return false;
    double *by = vector(s, v_dense), *bf = by + s->n;
    const double *y1 = vector(s, v_end), *u = vector(s, v_argument);
    const double *last = vector(s, step->type == step_rk8pd ? v_stage_13 : 12), *k13 = vector(s, 13);
    for (size_t i = 0; i < s->n; i++) by[i] = y1[i] - u[i];
    for (size_t i = 0; i < s->n; i++) bf[i] = k13[i] - last[i];
    *dy = by;
    *df = bf;
    return true;
}

void pair8_lend(const gsl_odeiv2_step *step, struct lent *lent)
{
    struct pair8 *s = step->state;
    const double *known = vector(s, v_end), *rest = vector(s, v_rest_end);
    for (size_t i = 0; i < s->n; i++) lent->rest[i] = s->has_rest && lent->last[i] == known[i] ? rest[i] : 0;
}

/* Of no time: the next step is not one that is tried again. */
void pair8_settle(gsl_odeiv2_step *step, const struct lent *lent)
{
    struct pair8 *s = step->state;
    memcpy(vector(s, v_end), lent->last, s->n * sizeof(double));
    memcpy(vector(s, v_rest_end), lent->rest, s->n * sizeof(double));
    s->stepped = s->prepared = false;
    s->has_rest = true;
    s->t = NAN;
}

static const gsl_odeiv2_step_type dop853_type = {
    .name = "dop853",
    .can_use_dydt_in = 1,
    .gives_exact_dydt_out = 1,
    .alloc = pair8_alloc,
    .apply = dop853_apply,
    .set_driver = pair8_set_driver,
    .reset = pair8_reset,
    .order = pair8_order,
    .free = pair8_free,
};

const gsl_odeiv2_step_type *const step_dop853 = &dop853_type;

static const gsl_odeiv2_step_type rk8pd_type = {
    .name = "rk8pd",
    .can_use_dydt_in = 1,
    .gives_exact_dydt_out = 1,
    .alloc = pair8_alloc,
    .apply = rk8pd_apply,
    .set_driver = pair8_set_driver,
    .reset = pair8_reset,
    .order = pair8_order,
    .free = pair8_free,
};

const gsl_odeiv2_step_type *const step_rk8pd = &rk8pd_type;
