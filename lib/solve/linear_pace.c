/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "solve/linear.h"
#include "solve/stiffness.h"

bool linear_pace_init(struct linear_pace *pace, size_t dim)
{
    *pace = (struct linear_pace){.dim = dim};
    pace->jacobian = calloc(dim * dim + 3 * dim + 1, sizeof *pace->jacobian);
    pace->eigenvalues = gsl_vector_complex_calloc(dim);
    pace->eigen = gsl_eigen_nonsymm_alloc(dim);
    if (!pace->jacobian || !pace->eigenvalues || !pace->eigen) return false;
    pace->work = pace->jacobian + dim * dim;
    return true;
}

void linear_pace_free(struct linear_pace *pace)
{
    if (pace->eigen) gsl_eigen_nonsymm_free(pace->eigen);
    if (pace->eigenvalues) gsl_vector_complex_free(pace->eigenvalues);
    free(pace->jacobian);
    *pace = (struct linear_pace){0};
}

void linear_pace_start(struct linear_pace *pace, struct counted_system *system, double t, const double *y)
{
    size_t dim = pace->dim;
    pace->start = t;
    pace->rho = INFINITY;
    double *dfdt = pace->work + 2 * dim;
    if (GSL_ODEIV_JA_EVAL(&system->gsl, t, y, pace->jacobian, dfdt) != GSL_SUCCESS) return;
    pace->rho = stiffness_rate(dim, pace->jacobian, pace->work);
    gsl_matrix_view matrix = gsl_matrix_view_array(pace->jacobian, dim, dim);
    /* Where they are not found, every mode counts as the fastest. */
    if (gsl_eigen_nonsymm(&matrix.matrix, pace->eigenvalues, pace->eigen) != GSL_SUCCESS)
        gsl_vector_complex_set_all(pace->eigenvalues, gsl_complex_rect(0, pace->rho));
}

/* The largest measure of an eigenvalue among the modes that are still there at t. */
static double fastest(const struct linear_pace *pace, double t, double (*measure)(gsl_complex))
{
    const double died_out = 40;
    double most = 0;
    for (size_t i = 0; i < pace->dim; i++) {
        gsl_complex l = gsl_vector_complex_get(pace->eigenvalues, i);
        if (-GSL_REAL(l) * (t - pace->start) < died_out) most = fmax(most, measure(l));
    }
    return most;
}

static double frequency(gsl_complex l)
{
    return fabs(GSL_IMAG(l));
}

double linear_pace_rate(const struct linear_pace *pace, double t)
{
    return fastest(pace, t, gsl_complex_abs);
}

double linear_pace_step(const struct linear_pace *pace, double t)
{
    if (!(pace->rho > 0 && pace->rho < INFINITY)) return HUGE_VAL;
    double omega = fastest(pace, t, frequency);
    double longest = fmin(fmax(t - pace->start, 1 / pace->rho), omega > 0 ? 1 / omega : HUGE_VAL);
    int doublings;
    frexp(longest * pace->rho * (1 + 1e-9), &doublings); /* 2^(doublings - 1) <= longest rho */
    return ldexp(1 / pace->rho, doublings > 0 ? doublings - 1 : 0);
}
