/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Chains whose only loads are constant forces and, in their joints, springs, dampers and constant moments:
 * pivots on pivots, the first of them on the ground or on a slide of it, as pendulums and carts with poles.
 * Such loads do not depend on positions in the world. So this right-hand side omits positions and velocities
 * of the points O, and of the links on the ground all terms that act on the ground only. Two links have a closed form,
 * equal to state_rates within rounding. In other chains each number results from the same operations in the same
 * order: the bits are those of state_rates. The right-hand side is bare_row (rates_row.h).
 */
#ifndef FBD_DYNAMICS_TREE_BARE_H
#define FBD_DYNAMICS_TREE_BARE_H

#include "dynamics/spatial.h"
#include "model/model.h"

/* The part of tree_state and tree_rhs that is needed. */
struct tree_bare {
    struct vec turn, d, mr, h; /* h of the articulated inertia */
    struct wrench p;           /* of the link */
    double g, u, D;
};

/* Does it consist of such chains, with any loads? */
bool tree_is_in_chains(const struct tree *tree);

/* Do the jointed bodies consist of such chains, with only such loads and no couplings? */
bool tree_is_bare(const struct fbd_model *model);

#endif
