/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Chains whose only loads are constant forces and, in their joints, springs, dampers and constant moments:
 * pivots on pivots, the first of them on the ground or on a slide of it, as pendulums and carts with poles.
 * Such loads do not depend on positions in the world. So this right-hand side omits positions and velocities
 * of the points O, and of the links on the ground all terms that act on the ground only. Short chains have
 * closed forms (tree_short.h), equal to state_rates within rounding. In others each number results from the
 * same operations in the same order: the bits are those of state_rates.
 */
#ifndef FBD_DYNAMICS_TREE_BARE_H
#define FBD_DYNAMICS_TREE_BARE_H

#include "dynamics/spatial.h"
#include "model/model.h"

struct tree_work;

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

enum tree_form { tree_form_none, tree_form_pole, tree_form_two_pivots, tree_form_three_pivots };

/* The closed form (tree_short.h) of such a tree, if it has one: a single chain without forces in its joints. */
enum tree_form tree_bare_form(const struct fbd_model *model);

/* Compute dydt[2 n] at y; of the workspace only `bare` is used. */
void tree_bare_rates(const struct fbd_model *model, struct tree_work *work, const double *y, double *dydt);

#endif
