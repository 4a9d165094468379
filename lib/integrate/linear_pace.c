/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "integrate/linear.h"
#include "integrate/stiffness.h"
#include "numeric/tolerances.h"

static bool modes_init(struct linear_modes *modes, size_t dim)
{
    modes->A = calloc(dim * dim + 1, sizeof *modes->A);
    modes->rho = NAN; /* of no matrix */
    modes->eigenvalues = gsl_vector_complex_calloc(dim);
    return modes->A && modes->eigenvalues;
}

bool linear_pace_init(struct linear_pace *pace, size_t dim, size_t modes)
{
    *pace = (struct linear_pace){.dim = dim, .modes = modes};
    pace->kept = calloc(linear_most_kept, sizeof *pace->kept);
    pace->keys = calloc(linear_most_keys, sizeof *pace->keys + modes * sizeof(int));
    pace->jacobian = calloc(2 * dim * dim + 3 * dim + 1, sizeof *pace->jacobian);
    pace->eigen = gsl_eigen_nonsymm_alloc(dim);
    if (!pace->kept || !pace->keys || !pace->jacobian || !pace->eigen) return false;
    pace->copy = pace->jacobian + dim * dim;
    pace->work = pace->copy + dim * dim;
    for (size_t i = 0; i < linear_most_kept; i++)
        if (!modes_init(&pace->kept[i], dim)) return false;
    int *behind = (int *)(pace->keys + linear_most_keys);
    for (size_t i = 0; i < linear_most_keys; i++) pace->keys[i].modes = behind + i * modes;
    return true;
}

void linear_pace_free(struct linear_pace *pace)
{
    for (size_t i = 0; pace->kept && i < linear_most_kept; i++) {
        free(pace->kept[i].A);
        if (pace->kept[i].eigenvalues) gsl_vector_complex_free(pace->kept[i].eigenvalues);
    }
    if (pace->eigen) gsl_eigen_nonsymm_free(pace->eigen);
    free(pace->kept);
    free(pace->keys);
    free(pace->jacobian);
    *pace = (struct linear_pace){0};
}

static struct linear_modes *find_modes(const struct linear_pace *pace)
{
    size_t size = pace->dim * pace->dim * sizeof *pace->jacobian;
    for (size_t i = 0; i < linear_most_kept; i++) {
        struct linear_modes *modes = &pace->kept[i];
        if (!isnan(modes->rho) && memcmp(modes->A, pace->jacobian, size) == 0) return modes;
    }
    return NULL;
}

static struct linear_modes *met_in(const struct linear_pace *pace, const int *modes)
{
    for (size_t i = 0; modes && i < linear_most_keys; i++) {
        const struct linear_key *key = &pace->keys[i];
        if (key->of && memcmp(key->modes, modes, pace->modes * sizeof *modes) == 0) return key->of;
    }
    return NULL;
}

static void remember(struct linear_pace *pace, const int *modes)
{
    struct linear_key *key = &pace->keys[pace->oldest_key];
    pace->oldest_key = (pace->oldest_key + 1) % linear_most_keys;
    memcpy(key->modes, modes, pace->modes * sizeof *modes);
    key->of = pace->now;
}

static void forget(struct linear_pace *pace, const struct linear_modes *modes)
{
    for (size_t i = 0; i < linear_most_keys; i++)
        if (pace->keys[i].of == modes) pace->keys[i].of = NULL;
}

/* Analyse pace->jacobian, in place of the oldest matrix. */
static struct linear_modes *make_modes(struct linear_pace *pace)
{
    struct linear_modes *modes = &pace->kept[pace->oldest];
    size_t dim = pace->dim, size = dim * dim * sizeof *pace->jacobian;
    pace->oldest = (pace->oldest + 1) % linear_most_kept;
    forget(pace, modes);
    memcpy(modes->A, pace->jacobian, size);
    memcpy(pace->copy, pace->jacobian, size);
    modes->rho = stiffness_rate(dim, modes->A, pace->work);
    gsl_matrix_view matrix = gsl_matrix_view_array(pace->copy, dim, dim);
    /* If the eigenvalues are not found, every mode counts as the fastest. */
    if (gsl_eigen_nonsymm(&matrix.matrix, modes->eigenvalues, pace->eigen) != GSL_SUCCESS)
        gsl_vector_complex_set_all(modes->eigenvalues, gsl_complex_rect(0, modes->rho));
    return modes;
}

void linear_pace_start(struct linear_pace *pace, struct counted_system *system, double t, const double *y,
                       const int *modes)
{
    double *dfdt = pace->work;
    pace->start = t;
    pace->now = met_in(pace, modes);
    if (pace->now) return;
    if (GSL_ODEIV_JA_EVAL(&system->gsl, t, y, pace->jacobian, dfdt) != GSL_SUCCESS) return;
    pace->now = find_modes(pace);
    if (!pace->now) pace->now = make_modes(pace);
    if (modes) remember(pace, modes);
}

/* The largest measure of an eigenvalue among the modes that have not died out at t. */
static double fastest(const struct linear_pace *pace, double t, double (*measure)(gsl_complex))
{
    const double died_out = 40;
    double most = 0;
    for (size_t i = 0; pace->now && i < pace->dim; i++) {
        gsl_complex l = gsl_vector_complex_get(pace->now->eigenvalues, i);
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
    double rho = pace->now ? pace->now->rho : 0;
    if (!(rho > 0 && rho < INFINITY)) return HUGE_VAL;
    double omega = fastest(pace, t, frequency);
    double longest = fmin(fmax(t - pace->start, 2 / rho), omega > 0 ? 2 / omega : HUGE_VAL);
    int doublings;
    frexp(longest * rho * (1 + rounded_reach), &doublings); /* 2^(doublings - 1) <= longest rho */
    return scalbn(1 / rho, doublings > 0 ? doublings - 1 : 0);
}
