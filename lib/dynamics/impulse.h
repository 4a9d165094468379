/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What impulses do: the velocities that unit impulses along rows of one-sided ties give to all bodies,
 * through every joint and every coupling that holds both ways.
 *
 * Contacts and ropes are no part of what holds: their impulses are what is asked about. Dry friction of
 * slides and bearings gives way, for its impulse is that of its normal force, which an impact elsewhere has
 * little of.
 */
#ifndef FBD_DYNAMICS_IMPULSE_H
#define FBD_DYNAMICS_IMPULSE_H

#include "dynamics/state.h"

/* For `count` rows, the state's rows being evaluated: W[count x count], the velocity of row i by a unit
 * impulse along row j, and answers[count x n], the velocities of the coordinates by each. `modes` has room
 * for plan.mode_count numbers. */
void impulse_answers(struct fbd_state *state, const int *rows, int count, int *modes, double *W,
                     double *answers);

/* Rows and links where the state is, with its velocities. */
void impulse_look(struct fbd_state *state);

#endif
