/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The equilibrium near a state: zero accelerations at rest.
 *
 * With couplings the coordinates are not independent. Let C(q) be the nearest point on the constraints (in
 * the mass metric). Then
 *
 *     F(q) = a(C(q)) + k (C(q) - q) = 0,    dF/dq = da/dq (1 - P) - k P,   P = M^-1 J^T (J M^-1 J^T)^-1 J,
 *
 * has the equilibria on the constraints as its zeros, since a lies in the null space of J and C(q) - q is
 * orthogonal to it; k scales both to comparable sizes.
 */
#ifndef FBD_REST_EQUILIBRIUM_H
#define FBD_REST_EQUILIBRIUM_H

#include "dynamics/state.h"

/* Move the state to the equilibrium near it by GSL's hybrid Newton method with the exact Jacobian, in its
 * present modes; rates become zero. 1 found, 0 none near (the state is then undefined), -1 out of memory. */
int equilibrium_search(struct fbd_state *state);

/* The position in which the scene comes to rest; where forces without a potential keep it moving, or user
 * states have rates that must vanish, the nearest equilibrium. 1 found, 0 none, -1 out of memory. */
int equilibrium_settle(struct fbd_state *state);

/* Name of the position in messages. */
static const char place_found[] = "the place found, where contacts are as at the start,";

/* Size of the accelerations without balance: the reference for zero. */
double equilibrium_size(const struct fbd_state *state);

/* Report a user state whose rate is never zero at rest; sets the state to rest. */
bool equilibrium_refuse_states(struct fbd_state *state, fbd_errors *errors);

/* Do forces balance in the branches of the expressions at the state, which may differ from those of the
 * search? Settles its modes. equilibrium_refuse reports that they do not. */
bool equilibrium_holds(struct fbd_state *state);
void equilibrium_refuse(fbd_errors *errors);

/* Report a rope that is hauled in or paid out, if there is one: then there is no state of rest. */
bool equilibrium_refuse_reels(const struct fbd_model *model, fbd_errors *errors);

#endif
