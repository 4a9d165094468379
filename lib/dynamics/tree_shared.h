/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Redundant loads of several unilateral constraints of jointed bodies (rest_system.h), for the decision on
 * their modes.
 */
#ifndef FBD_DYNAMICS_TREE_SHARED_H
#define FBD_DYNAMICS_TREE_SHARED_H

#include "dynamics/modes.h"
#include "dynamics/rest_system.h"

/* Are the modes consistent with the forces? `at_limit`: not by rates, or by a negligible amount. */
enum agreement { agrees, differs, at_limit };

/* Compute forces and their rates of change in the present modes, in the scratch of the state; returns the
 * direction of motion. */
struct direction tree_evaluate(struct fbd_state *state);

/* Choose the loaded side of sticking two-sided guides by the least reactions. True when a side has changed. */
bool tree_choose_sides(struct fbd_state *state, const double *slots);

/* Are there reactions within the limits? If they are exceeded only slightly, change the modes at the limit,
 * in state->slip and `forced`. */
enum agreement tree_judge(struct fbd_state *state, const struct rest_margin *margin, int *forced);

#endif
