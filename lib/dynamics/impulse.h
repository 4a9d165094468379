/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The response to impulses: the velocities of all bodies by unit impulses along rows of one-sided couplings,
 * through all joints and bilateral couplings.
 *
 * Contacts, ropes and rolling or cam surfaces are not among these constraints: their impulses are the
 * unknowns. So are those of dry friction on slides and in slots, which depend on the impulses across their
 * guides. A bearing whose friction is a moment has none.
 */
#ifndef FBD_DYNAMICS_IMPULSE_H
#define FBD_DYNAMICS_IMPULSE_H

#include "dynamics/state.h"

/* Impulses along rows of couplings, then along slides and slots, by the modes of their friction. */
struct impulse_lines {
    int row_count, slide_count;
    const int *rows, *slides;
};

/* With the rows of the state evaluated, compute W[count x count], the velocity along line i by a unit impulse
 * along line j, B[slides x count], the impulse across the guide of each slide, and answers[count x n], the
 * velocities of the coordinates by each. W = 0 for a slide that couplings hold. `modes` has room for
 * plan.mode_count numbers. */
void impulse_answers(struct fbd_state *state, const struct impulse_lines *lines, int *modes, double *W,
                     double *B, double *answers);

/* Find the slides whose guides are loaded by impulses along the rows, or by the friction of such a slide, from the answers:
 * loaded[slide_count] is 0 for the others, whose friction has no impulse. Returns their number. */
int impulse_loaded_slides(const struct impulse_lines *lines, const double *W, const double *B, int *loaded);

/* Evaluate links and rows at the state, with its velocities. */
void impulse_look(struct fbd_state *state);

#endif
