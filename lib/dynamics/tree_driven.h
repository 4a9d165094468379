/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Holds of mechanisms that drives move, whatever the forces are: what slips there never sticks, and what
 * opens is not held.
 */
#ifndef FBD_DYNAMICS_TREE_DRIVEN_H
#define FBD_DYNAMICS_TREE_DRIVEN_H

#include "dynamics/constraint.h"
#include "dynamics/modes.h"

/* The row along which a hold of a coupling acts. */
static inline const struct row *hold_row(const struct fbd_state *state, const struct mode *hold)
{
    int first = state->model->tree->couplings[hold->coupling].first_row;
    return &state->tree->rows[first + (hold->kind == mode_tangent)];
}

/* A rope pulls against its row. */
static inline int hold_sign(const struct mode *hold)
{
    return hold->kind == mode_rope ? -1 : 1;
}

/* Is an acceleration [m/s^2] more than rounding of those of the links? */
bool tree_seen_acceleration(const struct fbd_state *state, double a);

/* The largest acceleration along a row that its own force would make, in the units of the row. */
double tree_coupled_acceleration(const struct fbd_state *state);

/* The acceleration along a hold, evaluated at this instant: of what slips along its surface, of what is
 * one-sided away from it. */
double tree_hold_acceleration(const struct fbd_state *state, const struct instant *at, int pair);

/* A speed [m/s] that may well be rounding: of the other speeds, and of the places between which it was made
 * in so much time (0: at once), as that of a drive that starts from rest is. */
double tree_unseen_speed(const struct fbd_state *state, double time);

/* How drives move hold `pair`, along which no force moves anything, with the holds loose in the modes `slip`
 * (plan.mode_count): the velocity along it, else, by its sign alone, what that becomes as soon as it is
 * more than rounding; 0 where it stays at rest. Sets state->holds.found when memory is out. */
double tree_driven(struct fbd_state *state, const int *slip, int pair);

/* Is every velocity zero, but for what may well be rounding of the places? */
bool tree_rests(const struct fbd_state *state);

/* The same of forces that move a mechanism out of the dead centre in which it rests, as state->a tells: nothing moves
 * along the hold at once, but to the second order of the motion. 0 where the mechanism does not rest, or stays. */
double tree_sets_out(struct fbd_state *state, const int *slip, int pair);

/* Does it rest, is it about to move, and does something that sticks not let it, to the second order? */
bool tree_is_locked(struct fbd_state *state);

/* May modes that agree with the forces not be those that it goes on in? The ones that are solved for then decide. */
bool tree_is_doubtful(const struct fbd_state *state);

#endif
