/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linearisation about an equilibrium: x' = A x with x = (q - q0, v), A the exact Jacobian there.
 *
 * For one coordinate, I q'' + c q' + k q = 0 has lambda = -zeta w0 +- i w0 sqrt(1 - zeta^2), so that w0 =
 * |lambda| is the natural frequency and zeta = -Re(lambda) / |lambda| the damping ratio. The same is reported
 * for every eigenvalue.
 *
 * With couplings the coordinates are not independent. Then z are those that are (independent.h), q - q0 = T z to
 * the first order, and since the accelerations vanish at q0 what T bends by does not count:
 *
 *     z'' = (rows of z of da/dq T) z + (rows of z of da/dv T) z'
 */
#ifndef FBD_REST_LINEARIZE_H
#define FBD_REST_LINEARIZE_H

#include "dynamics/state.h"
#include "fbd_study.h"

struct fbd_linearization {
    const struct fbd_model *model;
    size_t count; /* of independent coordinates */
    size_t size;  /* twice that, and the states of the file's own */
    int *which;   /* count: which they are, ascending */
    double *way;  /* n x count: how all coordinates follow them; NULL without couplings */
    double *A;    /* size x size, row by row (and df/dt behind it) */
    fbd_mode *modes;
    double *q;       /* plan_rates: the equilibrium, [q, z] */
    bool degrees;    /* the equilibrium is shown in degrees */
    bool degenerate; /* forces without a slope there have been told, and their rows of A are zero */
};

/* What entry i of x = [q, v, z] is called. */
const char *linearization_name(const struct fbd_linearization *linear, size_t i);

#endif
