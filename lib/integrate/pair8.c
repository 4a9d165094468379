/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/pair8.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "integrate/dop853_table.h"
#include "integrate/pair8_sums.h"
#include "integrate/rk8pd_table.h"
#include "integrate/system.h"

enum { dense_terms = 8 };

/* Offsets of the vectors of n numbers in the one block of memory. Stage i of the book is vector i, and 13 is
 * the slope at the end; stage 13 of rk8pd, which has no dense output of its own, shares the offset of
 * dop853's first dense stage. */
enum {
    v_stage_13 = 14,             /* of rk8pd */
    v_start = dop853_stages + 1, /* y0 */
    v_end,                       /* y1 */
    v_rest,                      /* accumulated rounding error of y0 */
    v_rest_end,                  /* ... and y1 */
    v_argument,                  /* argument of the right-hand side */
    v_dense,
    v_count = v_dense + dense_terms
};

struct pair8 {
    size_t n;
    double t, h;        /* start and size of the last step */
    bool stepped;       /* the vectors hold a step */
    bool has_rest;      /* ... the rounding errors of its ends */
    bool has_end_slope; /* ... the slope at its end */
    bool prepared;      /* ... the dense output */
    double v[];
};

/* The stages of both pairs depend on the same earlier stages, so their sums are written once. */
struct tableau {
    const double *c;
    const double (*a)[dop853_stages + 1];
    const double *b, *e; /* weights of the step; of the difference to the embedded formula, */
    const double *low;   /* and to one of lower order, or NULL */
    bool more;           /* stage 13 belongs to the step */
};

static const struct tableau dop853 = {dop853_c, dop853_a, dop853_a[13], dop853_e5, dop853_e3, false};
static const struct tableau rk8pd = {rk8pd_c, rk8pd_a, rk8pd_a[14], rk8pd_e7, NULL, true};

/* `n` is s->n, a compile-time constant for small systems: see `make_stages`. */
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
    struct pair8 *s = block_alloc(sizeof *s + v_count * n * sizeof(double));
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
    return counted_system_eval(sys, n, s->t + tableau->c[i] * s->h, argument, vector_of(s, n, i));
}

/* u = y + h sum a_ij k_j, the argument of stage i of the row `row`; `rest`, if not NULL, is the rounding
 * error of y. */
INLINE void set_argument(struct pair8 *s, size_t n, const double *row, int i, const double *y,
                         const double *rest)
{
    const double *k = vector_of(s, n, 1), h = s->h;
    double *u = vector_of(s, n, v_argument);
    size_t c = 0;
    for (; c + 1 < n; c += 2) {
        simd2 rise = h * sum_of_two(row, i, k + c, n);
        simd2_store(u + c, simd2_load(y + c) + (rest ? simd2_load(rest + c) + rise : rise));
    }
    if (c == n) return;
    double rise = h * sum_of_one(row, i, k + c, n);
    u[c] = y[c] + (rest ? rest[c] + rise : rise);
}

INLINE int stage(struct pair8 *s, const struct tableau *tableau, size_t n, int i, const double *y,
                 const gsl_odeiv2_system *sys)
{
    set_argument(s, n, tableau->a[i], i, y, vector_of(s, n, v_rest));
    return evaluate(s, tableau, n, i, sys);
}

/* Unrolled: measured, a loop is slower for small systems. */
INLINE int stages_2_to_12(struct pair8 *s, const struct tableau *tableau, size_t n, const double *y,
                          const gsl_odeiv2_system *sys)
{
    int status = stage(s, tableau, n, 2, y, sys);
    if (status == GSL_SUCCESS) status = stage(s, tableau, n, 3, y, sys);
    if (status == GSL_SUCCESS) status = stage(s, tableau, n, 4, y, sys);
    if (status == GSL_SUCCESS) status = stage(s, tableau, n, 5, y, sys);
    if (status == GSL_SUCCESS) status = stage(s, tableau, n, 6, y, sys);
    if (status == GSL_SUCCESS) status = stage(s, tableau, n, 7, y, sys);
    if (status == GSL_SUCCESS) status = stage(s, tableau, n, 8, y, sys);
    if (status == GSL_SUCCESS) status = stage(s, tableau, n, 9, y, sys);
    if (status == GSL_SUCCESS) status = stage(s, tableau, n, 10, y, sys);
    if (status == GSL_SUCCESS) status = stage(s, tableau, n, 11, y, sys);
    return status == GSL_SUCCESS ? stage(s, tableau, n, 12, y, sys) : status;
}

/* Stage 13 of rk8pd; its row has no stage 12. */
INLINE int stage_13(struct pair8 *s, const struct tableau *tableau, size_t n, const double *y,
                    const gsl_odeiv2_system *sys)
{
    set_argument(s, n, tableau->a[13], 13, y, vector_of(s, n, v_rest));
    return counted_system_eval(sys, n, s->t + s->h, vector_of(s, n, v_argument), vector_of(s, n, v_stage_13));
}

/* The error estimate of dop853 from its two parts. The test is `!= 0`, so that a NaN is passed to the
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

/* The sums of the step, to y1, to yerr and, of dop853, to r1. Stage 13 of rk8pd is the last of all. */
INLINE void set_sums(struct pair8 *s, const struct tableau *tableau, size_t n, double *yerr)
{
    const double *k = vector_of(s, n, 1), *more = vector_of(s, n, v_stage_13);
    const double *b = tableau->b, *e = tableau->e;
    double *y1 = vector_of(s, n, v_end), *r1 = vector_of(s, n, v_rest_end);
    size_t c = 0;
    for (; c + 1 < n; c += 2) {
        simd2 rise = sum_of_two(b, 13, k + c, n), error = sum_of_two(e, 13, k + c, n);
        if (tableau->more) {
            rise += b[13] * load_young(more + c);
            error += e[13] * load_young(more + c);
        }
        simd2_store(y1 + c, rise);
        simd2_store(yerr + c, error);
        if (tableau->low) simd2_store(r1 + c, sum_of_two(tableau->low, 13, k + c, n));
    }
    if (c == n) return;
    y1[c] = sum_of_one(b, 13, k + c, n) + (tableau->more ? b[13] * more[c] : 0);
    yerr[c] = sum_of_one(e, 13, k + c, n) + (tableau->more ? e[13] * more[c] : 0);
    if (tableau->low) r1[c] = sum_of_one(tableau->low, 13, k + c, n);
}

/* y1 and its error. False if y1 is not finite: zero times a sum is zero unless an infinity or a NaN is
 * among its terms. */
INLINE bool finish(struct pair8 *s, const struct tableau *tableau, size_t n, const double *restrict y,
                   double *restrict yerr)
{
    const double *restrict r = vector_of(s, n, v_rest);
    double *restrict r1 = vector_of(s, n, v_rest_end), *restrict y1 = vector_of(s, n, v_end);
    double h = s->h, probe = 0;
    set_sums(s, tableau, n, yerr);
    for (size_t i = 0; i < n; i++) {
        yerr[i] = tableau->low ? estimate(h * yerr[i], h * r1[i]) : h * yerr[i];
        double rise = r[i] + h * y1[i];
        y1[i] = y[i] + rise;
        r1[i] = lost(y[i], rise, y1[i]);
        probe += 0 * y1[i];
    }
    return probe == 0;
}

INLINE int stages(struct pair8 *s, const struct tableau *tableau, size_t n, const double *y, double *yerr,
                  const gsl_odeiv2_system *sys)
{
    int status = stages_2_to_12(s, tableau, n, y, sys);
    if (status == GSL_SUCCESS && tableau->more) status = stage_13(s, tableau, n, y, sys);
    if (status != GSL_SUCCESS) return status;
    return finish(s, tableau, n, y, yerr) ? GSL_SUCCESS : GSL_FAILURE;
}

/* Most scenes have one, two or three coordinates: with their number a compile-time constant the stages are at
 * constant offsets, which saves instructions. */
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

/* Choose the rounding error of the y from which a step starts: that of the last start when it is repeated,
 * that of the last end when it continues; zero for a component that has been changed since. */
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

/* The stages for dense output only; their arguments ignore the rounding errors. They are made in every step
 * with event functions. */
INLINE int dense_stages(struct pair8 *s, size_t n, const gsl_odeiv2_system *sys)
{
    const double *y0 = vector_of(s, n, v_start);
    int status;
    set_argument(s, n, dop853_a[14], 14, y0, NULL);
    if ((status = evaluate(s, &dop853, n, 14, sys))) return status;
    set_argument(s, n, dop853_a[15], 15, y0, NULL);
    if ((status = evaluate(s, &dop853, n, 15, sys))) return status;
    set_argument(s, n, dop853_a[16], 16, y0, NULL);
    return evaluate(s, &dop853, n, 16, sys);
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
        for (size_t m = 0; m < 4; m++) c[(4 + m) * n + i] = s->h * sum_of_one(dop853_d[m], 17, k1 + i, n);
    }
}

INLINE int make_dense(struct pair8 *s, size_t n, const gsl_odeiv2_system *sys)
{
    int status = dense_stages(s, n, sys);
    if (status == GSL_SUCCESS) set_polynomial(s, n);
    return status;
}

/* With constant sizes, as make_stages. */
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
        bool falls = m % 2 == 1; /* as in dop853_dense_eval */
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

void pair8_lend(const gsl_odeiv2_step *step, struct stepper_state_view *view)
{
    struct pair8 *s = step->state;
    const double *known = vector(s, v_end), *rest = vector(s, v_rest_end);
    for (size_t i = 0; i < s->n; i++) view->rest[i] = s->has_rest && view->last[i] == known[i] ? rest[i] : 0;
}

/* With an invalid time: the next step is not a repeated one. */
void pair8_settle(gsl_odeiv2_step *step, const struct stepper_state_view *view)
{
    struct pair8 *s = step->state;
    memcpy(vector(s, v_end), view->last, s->n * sizeof(double));
    memcpy(vector(s, v_rest_end), view->rest, s->n * sizeof(double));
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
