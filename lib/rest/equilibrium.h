/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The equilibrium near a state: accelerations zero at rest.
 *
 * With couplings the coordinates are not independent. Let C(q) be the nearest place on the constraints (in
 * the sense of the mass matrix). Then
 *
 *     F(q) = a(C(q)) + k (C(q) - q) = 0,    dF/dq = da/dq (1 - P) - k P,   P = M^-1 J^T (J M^-1 J^T)^-1 J,
 *
 * has the equilibria on the constraints for its zeros, since a lies in the null space of J and C(q) - q
 * across it; k makes both of one size.
 */
#ifndef FBD_REST_EQUILIBRIUM_H
#define FBD_REST_EQUILIBRIUM_H

#include "dynamics/state.h"

/* Move the state to the equilibrium near it by GSL's hybrid Newton method with the exact Jacobian, in the
 * modes that it has; rates become zero. 1 found, 0 none near (the state is then anywhere), -1 out of memory.
 */
int equilibrium_search(struct fbd_state *state);

/* Where it comes to rest; where forces without a potential drive it round and round, or states of the file's own have
 * rates to be brought to zero, the nearest balance. 1 found, 0 none, -1 out of memory. */
int equilibrium_settle(struct fbd_state *state);

/* What messages call the place. */
static const char place_found[] = "the place found, where contacts are as at the start,";

/* The size that accelerations have at a place where nothing balances: what zero is measured against. */
double equilibrium_size(const struct fbd_state *state);

/* Say of a state of the file's own that its rate is never zero at rest; the state is put to rest for that. */
bool equilibrium_refuse_states(struct fbd_state *state, fbd_errors *errors);

/* Do forces balance with the branches that expressions have at the state, which need not be those in which it was
 * found? Its modes are settled by that. And saying that they do not. */
bool equilibrium_holds(struct fbd_state *state);
void equilibrium_refuse(fbd_errors *errors);

/* Note that a rope is hauled in or paid out, if one is, so that there is no state of rest. */
bool equilibrium_refuse_reels(const struct fbd_model *model, fbd_errors *errors);

#endif
