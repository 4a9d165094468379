/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_complex_math.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "integrate/linear.h"
#include "integrate/stiffness.h"
#include "numeric/tolerances.h"

/* One block: structures, doubles, ints. */
bool linear_pace_init(struct linear_pace *pace, size_t dim, size_t modes)
{
    *pace = (struct linear_pace){.dim = dim, .modes = modes};
    size_t of_modes = dim * dim + 2 * dim, doubles = linear_most_kept * of_modes + 2 * dim * dim + 3 * dim;
    size_t structures = linear_most_kept * sizeof *pace->kept + linear_most_keys * sizeof *pace->keys;
    pace->kept = block_alloc(structures + doubles * sizeof(double) + linear_most_keys * modes * sizeof(int));
    if (!pace->kept) return false;
    pace->keys = (struct linear_key *)(pace->kept + linear_most_kept);
    double *next = (double *)(pace->keys + linear_most_keys);
    for (size_t i = 0; i < linear_most_kept; i++, next += of_modes)
        pace->kept[i] =
            (struct linear_modes){.A = next, .rho = NAN, .eigenvalues = next + dim * dim}; /* of no matrix */
    pace->jacobian = next;
    pace->copy = pace->jacobian + dim * dim;
    pace->work = pace->copy + dim * dim;
    void *behind = pace->work + 3 * dim;
    int *numbers = behind;
    for (size_t i = 0; i < linear_most_keys; i++) pace->keys[i].modes = numbers + i * modes;
    return true;
}

void linear_pace_free(struct linear_pace *pace)
{
    free(pace->kept);
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

/* The eigenvalues of a matrix of two rows, the most frequent one; false where squares of its elements overflow. */
static bool eigenvalues_of_two(const double *A, double *values)
{
    double mean = (A[0] + A[3]) / 2, half = (A[0] - A[3]) / 2, square = half * half + A[1] * A[2];
    double root = sqrt(fabs(square)), real = square > 0 ? root : 0;
    double large = mean + copysign(real, mean), determinant = A[0] * A[3] - A[1] * A[2];
    values[0] = large;
    values[2] = real > 0 ? determinant / large : large;
    values[1] = square < 0 ? root : 0;
    values[3] = -values[1];
    return isfinite(square) && isfinite(determinant);
}

/* If the eigenvalues are not found, every mode counts as the fastest. False when memory is out. */
static bool find_eigenvalues(struct linear_pace *pace, struct linear_modes *modes)
{
    if (pace->dim == 2 && eigenvalues_of_two(modes->A, modes->eigenvalues)) return true;
    gsl_eigen_nonsymm_workspace *eigen = gsl_eigen_nonsymm_alloc(pace->dim);
    if (!eigen) return false;
    memcpy(pace->copy, modes->A, pace->dim * pace->dim * sizeof *modes->A);
    gsl_matrix_view matrix = gsl_matrix_view_array(pace->copy, pace->dim, pace->dim);
    gsl_vector_complex_view eigenvalues = gsl_vector_complex_view_array(modes->eigenvalues, pace->dim);
    if (gsl_eigen_nonsymm(&matrix.matrix, &eigenvalues.vector, eigen) != GSL_SUCCESS)
        gsl_vector_complex_set_all(&eigenvalues.vector, gsl_complex_rect(0, modes->rho));
    gsl_eigen_nonsymm_free(eigen);
    return true;
}

/* Analyse pace->jacobian, in place of the oldest matrix. NULL when memory is out. */
static struct linear_modes *make_modes(struct linear_pace *pace)
{
    struct linear_modes *modes = &pace->kept[pace->oldest];
    size_t dim = pace->dim, size = dim * dim * sizeof *pace->jacobian;
    pace->oldest = (pace->oldest + 1) % linear_most_kept;
    forget(pace, modes);
    memcpy(modes->A, pace->jacobian, size);
    modes->even = true;
    for (size_t i = dim * dim / 2; i < dim * dim; i++) modes->even &= modes->A[i] == 0;
    modes->rho = stiffness_rate(dim, modes->A, pace->work);
    return find_eigenvalues(pace, modes) ? modes : NULL;
}

bool linear_pace_start(struct linear_pace *pace, struct counted_system *system, double t, const double *y,
                       const int *modes)
{
    double *dfdt = pace->work;
    pace->start = t;
    pace->now = met_in(pace, modes);
    if (pace->now) return true;
    if (GSL_ODEIV_JA_EVAL(&system->gsl, t, y, pace->jacobian, dfdt) != GSL_SUCCESS) return true;
    pace->now = find_modes(pace);
    if (!pace->now) pace->now = make_modes(pace);
    if (modes && pace->now) remember(pace, modes);
    return pace->now != NULL;
}

/* The largest measure of an eigenvalue among the modes that have not died out at t. */
static double fastest(const struct linear_pace *pace, double t, double (*measure)(gsl_complex))
{
    const double died_out = 40;
    double most = 0;
    for (size_t i = 0; pace->now && i < pace->dim; i++) {
        const double *value = pace->now->eigenvalues + 2 * i;
        gsl_complex l = gsl_complex_rect(value[0], value[1]);
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

static double growth(gsl_complex l)
{
    return fmax(0, GSL_REAL(l));
}

double linear_pace_leap(const struct linear_pace *pace)
{
    if (!pace->now) return linear_pace_step(pace, pace->start);
    double fastest_growth = fastest(pace, pace->start, growth);
    return fastest_growth > 0 ? 1 / fastest_growth : HUGE_VAL;
}
