/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces at rest: the wrenches in all joints for zero accelerations, given the multipliers of the
 * constraints.
 *
 * Without accelerations a tree is solved from its ends inward: the joint of a link transmits all that acts on
 * its subtree,
 *
 *     F_i = - (loads on i + sum of lambda_j g_j' on i) + sum of F_c over the links c that move on i,
 *
 * and the residual along a coordinate of the joint, Q = g - S . F with g the listed forces in the joint, has
 * to be zero, or is the force of its dry friction or drive. All of this is affine in lambda: rest_system.c
 * computes lambda.
 */
#ifndef FBD_DYNAMICS_STATICS_H
#define FBD_DYNAMICS_STATICS_H

#include "dynamics/state.h"

/* Set the state to rest: rates zero, friction sticking, a rope taut if its path has its length; the links are
 * moved to the coordinates, the rows of the constraints evaluated. A moving surface slips under its body.
 * False when no choice of branches is consistent with the forces. */
bool rest_begin(struct fbd_state *state);

/* The forces at rest with these multipliers (row_count of them), with or without loads: sets F of the links,
 * lambda of the rows, slots[plan.slots] as friction_at and diagram_fill expect them, and the residuals Q[n]
 * along the coordinates. */
void rest_forces(const struct fbd_model *model, const struct instant *given, const double *lambda, bool loads,
                 double *slots, double *Q);

/* The part of these forces that is due to a row, with the friction that its normal force has where it slips:
 * `lambda` is zero for the rows of other couplings. Flags the links that it reaches, from its ports to the ground
 * (tree.count of them), and sets F of these alone, their entries of slots and Q, and those of the coupling. */
void rest_forces_of_row(const struct fbd_model *model, const struct instant *at, int row,
                        const double *lambda, bool *reached, double *slots, double *Q);

/* The sticking friction or drive that holds the coordinate, as the index of its mode, or -1. */
int rest_holder(const struct fbd_model *model, const struct instant *at, int coordinate);

#endif
