/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/bdf.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "integrate/newton.h"
#include "numeric/lu.h"
#include "numeric/tolerances.h"

enum { most_order = 5, most_points = most_order + 2 };

struct bdf {
    size_t n;
    const gsl_odeiv2_control *control;
    int count; /* number of points */
    double t[most_points];
    double *y[most_points];
    int order;         /* of the last step */
    int since;         /* accepted steps since the order was chosen */
    int refused;       /* rejected attempts at this step */
    bool rising;       /* no rejection since the start: the order rises with each step */
    bool tried;        /* an attempt was made ... */
    double end;        /* ... ending at this time */
    double matrix_for; /* alpha of the decomposition lu; 0: none */
    double rate;       /* convergence rate of its iterations; 1: unknown */
    int age;           /* steps since the last Jacobian; -1: none */
    size_t *pivot;
    double *jacobian, *lu, *dfdt;
    double *divided; /* most_points n: divided differences of the points */
    double *predicted, *slope, *now, *f, *change, *level;
    double memory[];
};

static void *bdf_alloc(size_t n)
{
    enum { vectors = 7 };
    if (n == 0 || n > 1u << 20) return NULL; /* n^2 numbers cannot be allocated either */
    size_t doubles = 2 * n * n + (vectors + 2 * most_points) * n;
    struct bdf *s = calloc(1, sizeof *s + doubles * sizeof(double) + n * sizeof(size_t));
    if (!s) return NULL;
    s->n = n;
    s->jacobian = s->memory;
    s->lu = s->jacobian + n * n;
    s->divided = s->lu + n * n;
    for (size_t i = 0; i < most_points; i++) s->y[i] = s->divided + (most_points + i) * n;
    s->dfdt = s->divided + 2 * (size_t)most_points * n;
    s->predicted = s->dfdt + n;
    s->slope = s->predicted + n;
    s->now = s->slope + n;
    s->f = s->now + n;
    s->change = s->f + n;
    s->level = s->change + n;
    void *behind_doubles = s->level + n; /* aligned for a size_t as well */
    s->pivot = behind_doubles;
    s->order = 1;
    s->age = -1;
    return s;
}

static int bdf_reset(void *state, size_t n)
{
    struct bdf *s = state;
    (void)n;
    s->count = s->since = s->refused = 0;
    s->order = 1;
    s->age = -1;
    s->tried = false;
    s->rising = true;
    return GSL_SUCCESS;
}

/* ---- points */

static void add_point(struct bdf *s, double t, const double *y)
{
    double *oldest = s->y[most_points - 1];
    for (int i = most_points - 1; i > 0; i--) {
        s->t[i] = s->t[i - 1];
        s->y[i] = s->y[i - 1];
    }
    s->t[0] = t;
    s->y[0] = oldest;
    memcpy(oldest, y, s->n * sizeof *y);
    if (s->count < most_points) s->count++;
}

/* Start a step at (t, y): determine whether it follows the last one or repeats it. Changes of y since then,
 * as by a projection onto constraints, are taken over. */
static void begin(struct bdf *s, double t, const double *y)
{
    const double roundings = 4; /* of the sum that gives the end */
    bool again = s->count > 0 && t == s->t[0];
    bool accepted = s->tried && !again && fabs(t - s->end) <= round_off(roundings, fabs(t));
    if (!accepted && !again) bdf_reset(s, s->n);
    if (again) {
        memcpy(s->y[0], y, s->n * sizeof *y);
        s->refused++;
        s->rising = false;
        return;
    }
    if (accepted) {
        s->since++;
        s->age += s->age >= 0;
    }
    add_point(s, t, y);
    s->refused = 0;
}

/* Divided differences of y_0 ... y_j for all j (HNW I, III.5), into row j. */
static void divide(struct bdf *s)
{
    size_t n = s->n;
    for (int j = 0; j < s->count; j++) memcpy(s->divided + (size_t)j * n, s->y[j], n * sizeof(double));
    for (int m = 1; m < s->count; m++)
        for (int j = s->count - 1; j >= m; j--) {
            double *row = s->divided + (size_t)j * n, *before = row - n, span = s->t[j] - s->t[j - m];
            for (size_t i = 0; i < n; i++) row[i] = (row[i] - before[i]) / span;
        }
}

static double alpha_of(const struct bdf *s, int order, double t)
{
    double alpha = 0;
    for (int i = 0; i < order; i++) alpha += 1 / (t - s->t[i]);
    return alpha;
}

/* ---- order */

/* Expected error of a step of this order to t, relative to the allowed error; requires order + 2 points. */
static double expected(const struct bdf *s, int order, double t)
{
    const double *difference = s->divided + (size_t)(order + 1) * s->n;
    double factor = 1 / alpha_of(s, order, t), size = 0;
    for (int i = 0; i < order; i++) factor *= t - s->t[i];
    for (size_t i = 0; i < s->n; i++) size = fmax(size, fabs(factor * difference[i]) / s->level[i]);
    return size;
}

/* Factor by which a step could be longer. */
static double reach(const struct bdf *s, int order, double t)
{
    return pow(expected(s, order, t) + least_error_ratio, -1.0 / (order + 1));
}

/* Choose the order that allows the longest step. At the start it rises with each step until one is rejected;
 * later only after the differences have settled, and for a sufficient gain. */
static void choose_order(struct bdf *s, double t)
{
    const double gain = 1.2;
    int k = s->order;
    if (s->refused > 2) k = 1;
    if (s->count < k + 2) k = s->count > 2 ? s->count - 2 : 1;
    bool may_rise = s->refused == 0 && k < most_order && s->count >= k + 2;
    int best = k;
    if (s->count >= k + 2) {
        double most = reach(s, k, t);
        if (k > 1 && reach(s, k - 1, t) > most) {
            best = k - 1;
            most = reach(s, k - 1, t);
        }
        if (may_rise && s->count >= k + 3 && s->since > k && reach(s, k + 1, t) > gain * most) best = k + 1;
    }
    if (may_rise && s->rising && best == k) best = k + 1;
    if (best != s->order) s->since = 0;
    if (best < s->order) s->rising = false;
    s->order = best;
}

/* ---- step */

/* P and P' at t: Newton's form through y_0 ... y_k, and of order 1 at the start the tangent. */
static void predict(struct bdf *s, double t, const double *f0)
{
    size_t n = s->n;
    double product = 1, derivative = 0;
    memcpy(s->predicted, s->y[0], n * sizeof(double));
    memset(s->slope, 0, n * sizeof(double));
    if (s->count == 1) {
        for (size_t i = 0; i < n; i++) s->predicted[i] += (t - s->t[0]) * f0[i];
        memcpy(s->slope, f0, n * sizeof(double));
    }
    for (int j = 1; j <= s->order && j < s->count; j++) {
        const double *row = s->divided + (size_t)j * n;
        derivative = derivative * (t - s->t[j - 1]) + product;
        product *= t - s->t[j - 1];
        for (size_t i = 0; i < n; i++) {
            s->predicted[i] += product * row[i];
            s->slope[i] += derivative * row[i];
        }
    }
}

static int linearize(struct bdf *s, double t, const gsl_odeiv2_system *sys)
{
    s->age = -1;
    s->matrix_for = 0;
    s->rate = 1;
    int status = GSL_ODEIV_JA_EVAL(sys, t, s->predicted, s->jacobian, s->dfdt);
    if (status == GSL_SUCCESS) s->age = 0;
    return status;
}

/* LU of alpha I - J. */
static bool decompose(struct bdf *s, double alpha)
{
    size_t n = s->n;
    if (s->matrix_for == alpha) return true;
    for (size_t i = 0; i < n * n; i++) s->lu[i] = -s->jacobian[i];
    for (size_t i = 0; i < n; i++) s->lu[i * n + i] += alpha;
    s->matrix_for = lu_decompose(n, s->lu, s->pivot) ? alpha : 0;
    return s->matrix_for > 0;
}

/* Solve f(t, y) = P' + alpha (y - P) for y = now, starting from P. */
static int solve(struct bdf *s, double t, double alpha, const gsl_odeiv2_system *sys)
{
    size_t n = s->n;
    struct newton newton = {.rate = s->rate};
    memcpy(s->now, s->predicted, n * sizeof(double));
    for (;;) {
        int status = GSL_ODEIV_FN_EVAL(sys, t, s->now, s->f);
        if (status != GSL_SUCCESS) return status;
        for (size_t i = 0; i < n; i++)
            s->change[i] = s->f[i] - s->slope[i] - alpha * (s->now[i] - s->predicted[i]);
        lu_solve(n, s->lu, s->pivot, s->change);
        double size = newton_size(n, s->change, s->now, s->level);
        for (size_t i = 0; i < n; i++) s->now[i] += s->change[i];
        enum newton_verdict verdict = newton_judge(&newton, size);
        if (verdict == newton_done) {
            /* A rate that was not measured again is increased from step to step. */
            s->rate = newton.count > 1 ? newton.rate : fmin(fmax(2 * s->rate, least_newton_rate), 1);
            return GSL_SUCCESS;
        }
        if (verdict == newton_diverges) return GSL_FAILURE;
    }
}

/* Solve with the present Jacobian, if it is not too old; with a new one if that fails. */
static int solve_somehow(struct bdf *s, double t, double alpha, const gsl_odeiv2_system *sys)
{
    enum { oldest = 20 };
    bool fresh = s->age < 0 || s->age > oldest;
    int status = fresh ? linearize(s, t, sys) : GSL_SUCCESS;
    if (status != GSL_SUCCESS) return status;
    status = decompose(s, alpha) ? solve(s, t, alpha, sys) : GSL_FAILURE;
    if (status != GSL_FAILURE || fresh) return status;
    status = linearize(s, t, sys);
    if (status != GSL_SUCCESS) return status;
    return decompose(s, alpha) ? solve(s, t, alpha, sys) : GSL_FAILURE;
}

/* The error divided by y - P: for the first step, where P is the tangent, one half (h^2 y''/2 of h^2 y''). */
static double share_of_error(const struct bdf *s, double t, double alpha)
{
    return s->count == 1 ? 0.5 : 1 / (1 + alpha * (t - s->t[s->order]));
}

static int bdf_apply(void *state, size_t n, double t, double h, double y[], double yerr[],
                     const double dydt_in[], double dydt_out[], const gsl_odeiv2_system *sys)
{
    struct bdf *s = state;
    double end = t + h;
    if (!s->control) return GSL_EFAULT;
    int status = dydt_in ? GSL_SUCCESS : GSL_ODEIV_FN_EVAL(sys, t, y, s->f);
    if (status != GSL_SUCCESS) return status;
    if (dydt_in) memcpy(s->f, dydt_in, n * sizeof *dydt_in);
    begin(s, t, y);
    s->tried = true;
    s->end = end;
    newton_levels(s->control, n, y, s->f, h, s->level);
    divide(s);
    choose_order(s, end);
    predict(s, end, s->f);
    double alpha = alpha_of(s, s->order, end);
    status = solve_somehow(s, end, alpha, sys);
    if (status == GSL_SUCCESS && dydt_out) status = GSL_ODEIV_FN_EVAL(sys, end, s->now, dydt_out);
    if (status != GSL_SUCCESS) return status;
    double share = share_of_error(s, end, alpha);
    for (size_t i = 0; i < n; i++) yerr[i] = share * (s->now[i] - s->predicted[i]);
    memcpy(y, s->now, n * sizeof *y);
    return GSL_SUCCESS;
}

static int bdf_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    struct bdf *s = state;
    s->control = driver->c;
    return GSL_SUCCESS;
}

static unsigned int bdf_order(void *state)
{
    const struct bdf *s = state;
    return (unsigned)s->order;
}

static const gsl_odeiv2_step_type msbdf_type = {
    .name = "msbdf",
    .can_use_dydt_in = 1,
    .gives_exact_dydt_out = 1,
    .alloc = bdf_alloc,
    .apply = bdf_apply,
    .set_driver = bdf_set_driver,
    .reset = bdf_reset,
    .order = bdf_order,
    .free = free,
};

const gsl_odeiv2_step_type *const step_msbdf = &msbdf_type;
