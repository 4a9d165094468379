/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/parabola.h"

#include <gsl/gsl_errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"

struct parabola {
    size_t n; /* pairs */
    double h;
    bool stepped;
    double *y0, *a; /* 2 n and n: start of the last step */
    double *slopes; /* 2 n: scratch */
    double memory[];
};

static void *parabola_alloc(size_t dim)
{
    size_t n = dim / 2;
    if (dim == 0 || dim % 2 != 0 || n > SIZE_MAX / sizeof(double) / 16) return NULL;
    struct parabola *s = block_alloc(sizeof *s + 5 * n * sizeof(double));
    if (!s) return NULL;
    s->n = n;
    s->y0 = s->memory;
    s->a = s->y0 + dim;
    s->slopes = s->a + n;
    return s;
}

static void parabola_free(void *state)
{
    free(state);
}

static int parabola_reset(void *state, size_t dim)
{
    (void)dim;
    ((struct parabola *)state)->stepped = false;
    return GSL_SUCCESS;
}

static unsigned int parabola_order(void *state)
{
    (void)state;
    return 8; /* any order: the estimate is zero */
}

static int parabola_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state, (void)driver;
    return GSL_SUCCESS;
}

static void move(const struct parabola *s, double h, double *y)
{
    for (size_t i = 0; i < s->n; i++) {
        double v = s->y0[s->n + i];
        y[i] = s->y0[i] + h * (v + h * s->a[i] / 2);
        y[s->n + i] = v + h * s->a[i];
    }
}

static void slopes_at(const struct parabola *s, const double *y, double *f)
{
    memcpy(f, y + s->n, s->n * sizeof *y);
    memcpy(f + s->n, s->a, s->n * sizeof *y);
}

static int parabola_apply(void *state, size_t dim, double t, double h, double y[], double yerr[],
                          const double dydt_in[], double dydt_out[], const gsl_odeiv2_system *sys)
{
    struct parabola *s = state;
    size_t n = s->n;
    s->stepped = false;
    if (!dydt_in) {
        int status = GSL_ODEIV_FN_EVAL(sys, t, y, s->slopes);
        if (status != GSL_SUCCESS) return status;
        dydt_in = s->slopes;
    }
    s->h = h;
    memcpy(s->y0, y, dim * sizeof *y);
    memcpy(s->a, dydt_in + n, n * sizeof *y);
    memset(yerr, 0, dim * sizeof *yerr);
    move(s, h, y);
    double probe = 0;
    for (size_t i = 0; i < dim; i++) probe += 0 * y[i];
    if (probe != 0) {
        memcpy(y, s->y0, dim * sizeof *y);
        return GSL_FAILURE;
    }
    if (dydt_out) slopes_at(s, y, dydt_out);
    s->stepped = true;
    return GSL_SUCCESS;
}

int parabola_dense_prepare(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys)
{
    (void)sys;
    return step->type == step_parabola && ((struct parabola *)step->state)->stepped ? GSL_SUCCESS
                                                                                    : GSL_EINVAL;
}

void parabola_dense_eval(const gsl_odeiv2_step *step, double since, double *y)
{
    move(step->state, since, y);
}

void parabola_slopes(const gsl_odeiv2_step *step, const double *y, double *f)
{
    slopes_at(step->state, y, f);
}

int parabola_dense_powers(const gsl_odeiv2_step *step, size_t i, const struct powers_piece *piece, double *c)
{
    const struct parabola *s = step->state;
    bool place = i < s->n;
    double a = s->a[place ? i : i - s->n], v = s->y0[place ? s->n + i : i];
    int degree = 0;
    c[0] = (place ? s->h / 2 : 1) * a * s->h;
    if (place) {
        degree = powers_times_theta(degree, c, piece);
        c[0] += s->h * v;
    }
    degree = powers_times_theta(degree, c, piece);
    c[0] += s->y0[i];
    return degree;
}

static const gsl_odeiv2_step_type parabola_type = {
    .name = "parabola",
    .can_use_dydt_in = 1,
    .gives_exact_dydt_out = 1,
    .alloc = parabola_alloc,
    .apply = parabola_apply,
    .set_driver = parabola_set_driver,
    .reset = parabola_reset,
    .order = parabola_order,
    .free = parabola_free,
};

const gsl_odeiv2_step_type *const step_parabola = &parabola_type;
