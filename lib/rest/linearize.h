/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linearization about an equilibrium: x' = A x with x = (q - q0, v), A the exact Jacobian there.
 *
 * For one coordinate, I q'' + c q' + k q = 0 has lambda = -zeta w0 +- i w0 sqrt(1 - zeta^2), so w0 = |lambda|
 * is the natural frequency and zeta = -Re(lambda) / |lambda| the damping ratio. The same is reported for
 * every eigenvalue.
 *
 * With couplings let z be independent coordinates (independent.h), q - q0 = T z to first order. Since the
 * accelerations vanish at q0 the derivative of T does not contribute:
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
    size_t size;  /* 2 count, plus the user states */
    int *which;   /* count: their indices, ascending */
    double *way;  /* n x count: the matrix T; NULL without couplings */
    double *A;    /* size x size, row by row (and df/dt behind it) */
    fbd_mode *modes;
    double *q;               /* plan_rates: the equilibrium, [q, z] */
    struct fbd_state *state; /* at the equilibrium, at rest */
    bool degrees;            /* the equilibrium is shown in degrees */
    bool degenerate;         /* forces without a derivative there were reported; their rows of A are zero */
};

/* The name of entry i of x = [q, v, z]. */
const char *linearization_name(const struct fbd_linearization *linear, size_t i);

#endif
