/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Loads that several holds of jointed bodies share (rest_system.h), for the decision which of them hold.
 */
#ifndef FBD_DYNAMICS_TREE_SHARED_H
#define FBD_DYNAMICS_TREE_SHARED_H

#include "dynamics/modes.h"
#include "dynamics/rest_system.h"

/* Do the modes agree with the forces? `at_limit`: not by rates, or by next to nothing. */
enum agreement { agrees, differs, at_limit };

/* Forces and their rates of change in the present modes, in the scratch of the state, and how that goes on. */
struct direction tree_evaluate(struct fbd_state *state);

/* What sticks on a guide that presses on either side: on which, by the least reactions. True when that has
 * changed. */
bool tree_choose_sides(struct fbd_state *state, const double *slots);

/* Is there a share within the limits? A little beyond them it is known what gives, and it does, in
 * state->slip and `forced`. */
enum agreement tree_judge(struct fbd_state *state, const struct rest_margin *margin, int *forced);

#endif
