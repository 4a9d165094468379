/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linearisation about an equilibrium: x' = A x with x = (q - q0, v), A the exact Jacobian there.
 *
 * For one coordinate, I q'' + c q' + k q = 0 has lambda = -zeta w0 +- i w0 sqrt(1 - zeta^2), so that w0 =
 * |lambda| is the natural frequency and zeta = -Re(lambda) / |lambda| the damping ratio. The same is reported
 * for every eigenvalue.
 */
#ifndef FBD_SOLVE_LINEARIZE_H
#define FBD_SOLVE_LINEARIZE_H

#include "dynamics/state.h"

struct fbd_linearization {
    const struct fbd_model *model;
    size_t size; /* 2 n */
    double *A;   /* size x size, row by row (and df/dt behind it) */
    fbd_mode *modes;
    double *q;       /* the equilibrium */
    bool degenerate; /* forces without a slope there have been told, and their rows of A are zero */
};

#endif
