/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Chains on which nothing acts but constant forces and, in their joints, springs, dampers and constant moments:
 * pivots on pivots, the first of them on the ground or on a slide of it. Pendulums, and carts with poles, are such
 * trees, and gravity asks for no place in the world. So of all that tree.h computes, the right-hand side leaves out
 * where the points O are and how fast they move, and of what moves on the ground all that only the ground would
 * feel. Short chains have closed forms (tree_short.h), which are state_rates to rounding. In others each number
 * that remains is made by the same operations in the same order as there: the bits are those of state_rates.
 */
#ifndef FBD_DYNAMICS_TREE_BARE_H
#define FBD_DYNAMICS_TREE_BARE_H

#include "dynamics/spatial.h"
#include "model/model.h"

struct tree_work;

/* What is left of tree_state and tree_rhs. */
struct tree_bare {
    struct vec turn, d, mr, h; /* h of what it has with all behind it */
    struct wrench p;           /* of the link alone */
    double g, u, D;
};

/* Is it made of such chains, whatever acts on them? */
bool tree_is_in_chains(const struct tree *tree);

/* Is it one on which nothing else acts, without couplings, and is there nothing in the scene beside it? */
bool tree_is_bare(const struct fbd_model *model);

enum tree_form { tree_form_none, tree_form_pole, tree_form_two_pivots, tree_form_three_pivots };

/* The closed form (tree_short.h) of such a tree, where it has one, is a single chain and has nothing in its joints. */
enum tree_form tree_bare_form(const struct fbd_model *model);

/* dydt[2 n] at y; of the workspace only `bare` is used. */
void tree_bare_rates(const struct fbd_model *model, struct tree_work *work, const double *y, double *dydt);

#endif
