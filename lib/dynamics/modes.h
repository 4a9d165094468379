/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Modes: the branch of every switch and the mode of every unilateral constraint, decided at the start and
 * after each event.
 *
 * A decision requires the rates of change, which depend on the modes: so it is repeated until it does not
 * change. If no switching function is zero the first pass is final; repetition is for those that are exactly
 * at their threshold.
 */
#ifndef FBD_DYNAMICS_MODES_H
#define FBD_DYNAMICS_MODES_H

#include "dynamics/state.h"

/* Modes that an event has decided already: flags for plan.branches, and for plan.mode_count modes. */
struct decided {
    bool *branches;
    bool *slips, *pulls;
    bool *aims; /* of points on planes: the direction, too */
    bool later; /* the state is one slightly later than the settled one, see tree_settle_holds */
};

/* Settle all modes at the state; `decided` may be NULL. Relative velocities of sticking friction are set to
 * exactly zero. On return the state is evaluated. False when no choice is consistent (forces contradict each
 * other at their thresholds). */
bool modes_settle(struct fbd_state *state, const struct decided *decided);

/* Decide all unilateral constraints between jointed bodies together: friction, ropes, contacts
 * (tree_holds.c). False when that has changed state->slip; the cause of a failure is in state->holds. Sets
 * `jointly` to whether there are any to be decided, or indeterminate reactions. */
bool tree_settle_holds(struct fbd_state *state, const struct decided *decided, bool *jointly);

/* A constraint has reached the limit of a redundant load: change its mode and those that reach theirs with
 * it, in state->slip, and mark them decided. False when its load is not redundant. */
bool tree_give_shared(struct fbd_state *state, int pair, struct decided *decided);

/* Is it a mode of a coupling that has ended? Then it is open, and has no events. */
bool mode_has_ended(const struct fbd_state *state, int pair);

/* Has the rolling or touching body of a friction left its surface? Then there is no friction. */
bool mode_is_off_surface(const struct fbd_state *state, int pair);

/* The velocity of a friction constraint relative to its surface. */
double slip_velocity(const struct fbd_model *model, int pair, const struct instant *at);

/* The same for settling: during a run (with `decided`) sticking friction between jointed bodies has velocity
 * zero, without the rounding of the projection; where all bodies come to rest no other speed gives a scale
 * for that. */
double settling_velocity(const struct fbd_state *state, const struct decided *decided, int pair);

/* The excess over its limit up to which friction at rest is at the limit, so that rates decide: the change of
 * both within the rounding of the time, and during a run, if it has just come to rest, friction_return. */
double settling_slack(const struct fbd_state *state, const struct decided *decided, int pair,
                      const struct friction_values *now, const struct friction_values *rate);

/* Set the rates of sticking coordinates to the exact velocity of their surface. */
void modes_hold(struct fbd_state *state);

/* The same while modes settle (see sliding_project); returns whether coordinates or their rates have changed. */
bool modes_hold_settling(struct fbd_state *state);

/* Set prescribed coordinates and their rates to their values at the time of the state. */
void modes_drive(struct fbd_state *state);

struct tree_work;

/* The rounding of the normal force on a body, 1e-13 of the largest force: smaller normal forces count as
 * zero. `tree` may be NULL. */
double press_slack(const struct fbd_model *model, const struct tree_work *tree, int body);

#endif
