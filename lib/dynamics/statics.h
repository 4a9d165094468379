/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces at rest: what every joint passes on when nothing accelerates, given the multipliers of the
 * constraints.
 *
 * Without accelerations a tree is solved from its ends inward: what acts on a link and on all that hangs on
 * it, its joint passes on,
 *
 *     F_i = - (loads on i + sum of lambda_j g_j' on i) + sum of F_c over the links c that move on i,
 *
 * and what is left along a coordinate of the joint, Q = g - S . F with g the listed forces in the joint, has
 * to be zero, or is what its dry friction or its drive holds. All of this is affine in lambda:
 * rest_system.c finds lambda.
 */
#ifndef FBD_DYNAMICS_STATICS_H
#define FBD_DYNAMICS_STATICS_H

#include "dynamics/state.h"

/* Put the state to rest: rates zero, all that can stick sticks, a rope that is as long as its way is taut;
 * the links are where the coordinates say, the rows of the constraints evaluated. A surface that moves slips
 * under its body. False when no choice of branches agrees with the forces. */
bool rest_begin(struct fbd_state *state);

/* The forces at rest with these multipliers (row_count of them), with all loads or without any: sets F of the
 * links, lambda of the rows, and slots[plan.slots] as friction_at and diagram_fill expect them; and Q[n],
 * what is left along each coordinate. */
void rest_forces(const struct fbd_model *model, const struct instant *given, const double *lambda, bool loads,
                 double *slots, double *Q);

/* Is the coordinate held by dry friction that sticks, or by a drive? By index of the pair, or -1. */
int rest_holder(const struct fbd_model *model, const struct instant *at, int coordinate);

#endif
