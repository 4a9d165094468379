/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The exact motion of a linear system with constant coefficients, as a step type for GSL's odeiv2.
 *
 * For y' = f(y) = A y + g the slope along the motion is e^(hA) f0, so with f0 = f(y0)
 *
 *     y(h) = y0 + Phi(h) f0,   Phi(h) = int_0^h e^(sA) ds = sum_k h^(k+1) A^k / (k+1)!
 *
 * for any g, and a state of equilibrium is kept to the last bit. Let rho be the bound of stiffness_rate for
 * |A|: there is a weighted maximum norm with ||A|| <= rho. For h rho <= 2 the series with 26 terms errs by
 * less than 2^26/27! = 7e-21 in that norm; it is applied to f0 directly (with as many terms as count in
 * double precision), and its terms are dense output at the same time. Longer steps use doublings, which are
 * kept as long as the matrix is the same (scaling and squaring):
 *
 *     Phi(2h) = Phi(h) + e^(hA) Phi(h),   e^(hA) = 1 + A Phi(h),   e^(2hA) = e^(hA)^2
 *
 * from h rho = 1/8. A step, or a time within one, is a sum of such lengths: for each, y increases by Phi f
 * and f becomes e^(hA) f; the series covers the remaining length. The error estimate is zero. A step costs
 * one evaluation, for the slope at its end; the first one after a reset also a Jacobian.
 *
 * The step size is chosen by struct linear_pace.
 *
 * Source: N. J. Higham, Functions of Matrices, SIAM 2008, chapter 10 (scaling and squaring, Taylor), 10.7.4
 * (phi functions); the norm is that of Collatz and Wielandt, see stiffness.c.
 */
#ifndef FBD_INTEGRATE_LINEAR_H
#define FBD_INTEGRATE_LINEAR_H

#include <gsl/gsl_odeiv2.h>
#include <stdbool.h>

#include "integrate/powers.h"
#include "integrate/system.h"

extern const gsl_odeiv2_step_type *const step_linear;

/* After a reset: set the matrix A (dim x dim, row by row), with rho the result of stiffness_rate for it, so
 * that the Jacobian is not evaluated. */
void linear_set_matrix(gsl_odeiv2_step *step, const double *A, double rho);

/* As those of dop853, but at the time `since` the start of the step [s]; exact, without evaluations. Powers, linear_most_powers at most, exist where the last
 * step is a series (h rho <= 2); else -1. */
enum { linear_most_powers = 20 };
int linear_dense_prepare(gsl_odeiv2_step *step, const gsl_odeiv2_system *sys);
void linear_dense_eval(const gsl_odeiv2_step *step, double since, double *y);
int linear_dense_powers(const gsl_odeiv2_step *step, size_t i, const struct powers_piece *piece, double *c);

/* The degree of the polynomial of the last step, 0 where it is not a polynomial. */
int linear_dense_degree(const gsl_odeiv2_step *step);

/* Dense algebra beyond this many pairs costs more than it saves. */
enum { linear_most_pairs = 8 };

/* Steps short enough that a few samples resolve event functions and powers: two radians of the fastest
 * oscillation that has not died out. Right after a start that is any rate up to rho; a mode with the
 * eigenvalue l has died out after 40 / -Re l (e^-40 = 4e-18). In a decaying motion the step size doubles. The
 * sizes are powers of two over rho: one doubling each. */
struct linear_modes;

struct linear_pace {
    size_t dim;
    double start;              /* time of the last start */
    struct linear_modes *kept; /* linear_most_kept: of the latest matrices; the block with all other lists */
    struct linear_modes *now;
    size_t oldest;
    size_t modes;            /* number of ints that identify the matrix */
    struct linear_key *keys; /* linear_most_keys */
    size_t oldest_key;
    double *jacobian, *copy, *work; /* dim dim, dim dim, 3 dim */
};

/* A matrix with its eigenvalues. A scene alternates between a few: sticks, slips, sticks ... */
struct linear_modes {
    double *A; /* dim dim */
    double rho;
    double *eigenvalues; /* 2 dim: real and imaginary parts */
    bool even;           /* the accelerations depend on nothing: the lower half of A is zero */
};

/* Modes, and their matrix; NULL: none yet. Several modes may share a matrix, as of a block that slips in both
 * directions. */
struct linear_key {
    int *modes;
    struct linear_modes *of;
};

enum { linear_most_kept = 4, linear_most_keys = 16 };

/* For systems of this dimension, whose matrix is determined by so many ints. False when memory is out; to be
 * freed in any case. */
bool linear_pace_init(struct linear_pace *pace, size_t dim, size_t modes);
void linear_pace_free(struct linear_pace *pace);

/* At a start or after an event; sets pace->now to the matrix, or NULL if it is not available. For the same
 * modes as before, the matrix is reused without a Jacobian; with modes NULL it is always evaluated. False when memory is
 * out. */
bool linear_pace_start(struct linear_pace *pace, struct counted_system *system, double t, const double *y,
                       const int *modes);

/* The size of a step from t. */
double linear_pace_step(const struct linear_pace *pace, double t);

/* The longest step of a motion that need not be resolved: any, or that in which the fastest growing mode grows e-fold, so
 * that an overflow is located. */
double linear_pace_leap(const struct linear_pace *pace);

/* The largest |l| of the eigenvalues whose motion has not died out at t. */
double linear_pace_rate(const struct linear_pace *pace, double t);

#endif
