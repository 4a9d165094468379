/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/implicit_rk.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "integrate/newton.h"
#include "numeric/lu.h"

enum { most_stages = 2 };

/* z_i = h sum_j a_ij f(t + c_j h, y + z_j), and y1 = y + sum d_i z_i with d = b A^-1: so f is not evaluated
 * once more, which in a stiff system would magnify the remaining error of the iteration (Hairer & Wanner II,
 * IV.8). */
struct table {
    unsigned order, stages;
    double c[most_stages], a[most_stages][most_stages], d[most_stages];
};

#define SQRT3 1.7320508075688772935

static const struct table euler = {1, 1, {1}, {{1}}, {1}};
static const struct table midpoint = {2, 1, {0.5}, {{0.5}}, {2}};
static const struct table gauss = {4,
                                   2,
                                   {0.5 - SQRT3 / 6, 0.5 + SQRT3 / 6},
                                   {{0.25, 0.25 - SQRT3 / 6}, {0.25 + SQRT3 / 6, 0.25}},
                                   {-SQRT3, SQRT3}};

struct implicit_rk {
    const struct table *table;
    size_t n;
    const gsl_odeiv2_control *control;
    size_t *pivot;                                 /* stages n */
    double *jacobian, *dfdt, *lu;                  /* n^2, n, (stages n)^2 */
    double *z, *correction, *slopes;               /* stages n each */
    double *argument, *level, *f, *whole, *halved; /* n each */
    double memory[];
};

static void *alloc(const struct table *table, size_t n)
{
    size_t m = table->stages * n;
    if (n == 0 || n > 1u << 20) return NULL; /* n^2 numbers cannot be allocated either */
    size_t doubles = n * n + m * m + 3 * m + 6 * n;
    struct implicit_rk *s = calloc(1, sizeof *s + doubles * sizeof(double) + m * sizeof(size_t));
    if (!s) return NULL;
    s->table = table;
    s->n = n;
    s->jacobian = s->memory;
    s->lu = s->jacobian + n * n;
    s->z = s->lu + m * m;
    s->correction = s->z + m;
    s->slopes = s->correction + m;
    s->dfdt = s->slopes + m;
    s->argument = s->dfdt + n;
    s->level = s->argument + n;
    s->f = s->level + n;
    s->whole = s->f + n;
    s->halved = s->whole + n;
    void *behind_doubles = s->halved + n; /* aligned for a size_t as well */
    s->pivot = behind_doubles;
    return s;
}

static void *euler_alloc(size_t n)
{
    return alloc(&euler, n);
}

static void *midpoint_alloc(size_t n)
{
    return alloc(&midpoint, n);
}

static void *gauss_alloc(size_t n)
{
    return alloc(&gauss, n);
}

/* LU of I - h A (x) J. */
static bool decompose(struct implicit_rk *s, double h)
{
    const struct table *table = s->table;
    size_t n = s->n, m = table->stages * n;
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++)
            s->lu[i * m + j] = (i == j) - h * table->a[i / n][j / n] * s->jacobian[i % n * n + j % n];
    return lu_decompose(m, s->lu, s->pivot);
}

/* f at all stages, into slopes. */
static int evaluate(struct implicit_rk *s, double t, double h, const double *y, const gsl_odeiv2_system *sys)
{
    size_t n = s->n;
    int status = GSL_SUCCESS;
    for (size_t j = 0; j < s->table->stages && status == GSL_SUCCESS; j++) {
        for (size_t i = 0; i < n; i++) s->argument[i] = y[i] + s->z[j * n + i];
        status = GSL_ODEIV_FN_EVAL(sys, t + s->table->c[j] * h, s->argument, s->slopes + j * n);
    }
    return status;
}

/* Add the Newton correction of all stages to z; returns its size. */
static double correct(struct implicit_rk *s, double h, const double *y)
{
    const struct table *table = s->table;
    size_t n = s->n, m = table->stages * n;
    for (size_t i = 0; i < m; i++) {
        double sum = 0;
        for (size_t j = 0; j < table->stages; j++) sum += table->a[i / n][j] * s->slopes[j * n + i % n];
        s->correction[i] = h * sum - s->z[i];
    }
    lu_solve(m, s->lu, s->pivot, s->correction);
    double size = 0;
    for (size_t j = 0; j < table->stages; j++)
        size = fmax(size, newton_size(n, s->correction + j * n, y, s->level));
    for (size_t i = 0; i < m; i++) s->z[i] += s->correction[i];
    return size;
}

/* One step of size h from y to `end`. */
static int step(struct implicit_rk *s, double t, double h, const double *y, double *end,
                const gsl_odeiv2_system *sys)
{
    size_t n = s->n;
    struct newton newton = {.rate = 1};
    memset(s->z, 0, s->table->stages * n * sizeof *s->z);
    for (;;) {
        int status = evaluate(s, t, h, y, sys);
        if (status != GSL_SUCCESS) return status;
        enum newton_verdict verdict = newton_judge(&newton, correct(s, h, y));
        if (verdict == newton_diverges) return GSL_FAILURE;
        if (verdict == newton_done) break;
    }
    for (size_t i = 0; i < n; i++) {
        end[i] = y[i];
        for (size_t j = 0; j < s->table->stages; j++) end[i] += s->table->d[j] * s->z[j * n + i];
    }
    return GSL_SUCCESS;
}

static int apply(void *state, size_t n, double t, double h, double y[], double yerr[], const double dydt_in[],
                 double dydt_out[], const gsl_odeiv2_system *sys)
{
    struct implicit_rk *s = state;
    if (!s->control) return GSL_EFAULT;
    int status = dydt_in ? GSL_SUCCESS : GSL_ODEIV_FN_EVAL(sys, t, y, s->f);
    if (dydt_in) memcpy(s->f, dydt_in, n * sizeof *s->f);
    if (status == GSL_SUCCESS) status = GSL_ODEIV_JA_EVAL(sys, t, y, s->jacobian, s->dfdt);
    if (status != GSL_SUCCESS) return status;
    newton_levels(s->control, n, y, s->f, h, s->level);
    if (!decompose(s, h)) return GSL_FAILURE;
    status = step(s, t, h, y, s->whole, sys);
    if (status != GSL_SUCCESS) return status;
    if (!decompose(s, h / 2)) return GSL_FAILURE;
    status = step(s, t, h / 2, y, s->halved, sys);
    if (status == GSL_SUCCESS) status = step(s, t + h / 2, h / 2, s->halved, s->halved, sys);
    if (status != GSL_SUCCESS) return status;
    if (dydt_out) status = GSL_ODEIV_FN_EVAL(sys, t + h, s->halved, dydt_out);
    if (status != GSL_SUCCESS) return status;
    double share = 4 / (scalbn(1, (int)s->table->order) - 1);
    for (size_t i = 0; i < n; i++) yerr[i] = share * (s->halved[i] - s->whole[i]);
    memcpy(y, s->halved, n * sizeof *y);
    return GSL_SUCCESS;
}

static int set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    struct implicit_rk *s = state;
    s->control = driver->c;
    return GSL_SUCCESS;
}

/* There is no state between steps. */
static int reset(void *state, size_t n)
{
    (void)state, (void)n;
    return GSL_SUCCESS;
}

static unsigned int order(void *state)
{
    const struct implicit_rk *s = state;
    return s->table->order;
}

#define STEP_TYPE(method_name, method_alloc)                                                                 \
    {                                                                                                        \
        .name = (method_name), .can_use_dydt_in = 1, .gives_exact_dydt_out = 1, .alloc = (method_alloc),     \
        .apply = apply, .set_driver = set_driver, .reset = reset, .order = order, .free = free               \
    }

static const gsl_odeiv2_step_type rk1imp = STEP_TYPE("rk1imp", euler_alloc);
static const gsl_odeiv2_step_type rk2imp = STEP_TYPE("rk2imp", midpoint_alloc);
static const gsl_odeiv2_step_type rk4imp = STEP_TYPE("rk4imp", gauss_alloc);

const gsl_odeiv2_step_type *const step_rk1imp = &rk1imp;
const gsl_odeiv2_step_type *const step_rk2imp = &rk2imp;
const gsl_odeiv2_step_type *const step_rk4imp = &rk4imp;
