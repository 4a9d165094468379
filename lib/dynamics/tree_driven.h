/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Unilateral constraints of mechanisms that drives move, whatever the forces: friction that slips there never
 * sticks, and contacts that open are not held.
 */
#ifndef FBD_DYNAMICS_TREE_DRIVEN_H
#define FBD_DYNAMICS_TREE_DRIVEN_H

#include "dynamics/constraint.h"
#include "dynamics/modes.h"

/* The row along which a unilateral constraint of a coupling acts. */
static inline const struct row *hold_row(const struct fbd_state *state, const struct mode *hold)
{
    const struct coupling *coupling = &state->model->tree->couplings[hold->coupling];
    return &state->tree->rows[hold->kind == mode_tangent || hold->kind == mode_plane ? coupling->along_row
                                                                                     : coupling->first_row];
}

/* The force of a rope is opposite to the gradient of its row. */
static inline int hold_sign(const struct mode *hold)
{
    return hold->kind == mode_rope ? -1 : 1;
}

/* Is an acceleration [m/s^2] larger than the rounding of those of the links? */
bool tree_seen_acceleration(const struct fbd_state *state, double a);

/* The largest acceleration along a row by its own force, in the units of the row. */
double tree_coupled_acceleration(const struct fbd_state *state);

/* The acceleration along a unilateral constraint, evaluated at this instant: of friction along its surface,
 * of contacts and ropes in the opening direction. */
double tree_hold_acceleration(const struct fbd_state *state, const struct instant *at, int pair);

/* A bound for the rounding of a speed [m/s]: relative to the other speeds, and of positions that differ by
 * that speed over `time` (0: without), as for a drive that starts from rest. */
double tree_unseen_speed(const struct fbd_state *state, double time);

/* The motion of constraint `pair`, which no force moves, due to drives, with the constraints loose as in
 * `slip` (plan.mode_count): its velocity, or a number with the sign of the velocity as soon as that exceeds
 * rounding; 0 if it stays at rest. Sets state->holds.found when memory is out. */
double tree_driven(struct fbd_state *state, const int *slip, int pair);

/* Is every velocity zero within the rounding of positions? */
bool tree_rests(const struct fbd_state *state);

/* The same for forces that move a mechanism out of the dead centre in which it rests, given the accelerations
 * in state->a: the motion along the constraint is of second order. 0 if the mechanism does not rest, or
 * stays. */
double tree_sets_out(struct fbd_state *state, const int *slip, int pair);

/* Is the mechanism at rest and about to move, but locked to second order by sticking friction? */
bool tree_is_locked(struct fbd_state *state);

/* May modes that are consistent with the forces differ from those of the motion? Then the solved modes
 * decide. */
bool tree_is_doubtful(const struct fbd_state *state);

#endif
