/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What impulses do: the velocities that unit impulses along rows of one-sided couplings give to all bodies,
 * through every joint and every coupling that holds both ways.
 *
 * Contacts, ropes and what rolls or follows a cam are no part of what holds: their impulses are what is asked about. So
 * are those of dry friction on slides and in slots, which go with the impulses across their guides. A bearing whose friction
 * is a moment has none.
 */
#ifndef FBD_DYNAMICS_IMPULSE_H
#define FBD_DYNAMICS_IMPULSE_H

#include "dynamics/state.h"

/* Impulses along rows of couplings, and behind them along slides and slots, by the pairs of their friction. */
struct impulse_lines {
    int row_count, slide_count;
    const int *rows, *slides;
};

/* The state's rows being evaluated: W[count x count], the velocity along line i by a unit impulse along line j,
 * B[slides x count], the impulse across the guide of each slide, and answers[count x n], the velocities of the
 * coordinates by each. A slide that couplings hold still has W = 0. `modes` has room for plan.mode_count numbers. */
void impulse_answers(struct fbd_state *state, const struct impulse_lines *lines, int *modes, double *W,
                     double *B, double *answers);

/* Rows and links where the state is, with its velocities. */
void impulse_look(struct fbd_state *state);

#endif
