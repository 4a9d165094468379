/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction of journal bearings: a moment of at most k R against the rotation in a pin, k = mu r the radius of
 * the friction circle and R = |F| the reaction of the pin.
 *
 * The reactions F of the pins are affine in the moments c of those that slip, F_i = F_i0 + sum D_ij c_j, and
 *
 *     c_i = -side_i k_i |F_i|
 *
 * is one equation with a square root for each. With n_i = F_i/|F_i| the magnitude is |F_i| = n_i . F_i, and for
 * a fixed n_i the bearing is as a slide with normal force n_i . F_i and coefficient k_i: a row of tree_system.h.
 * The direction of the resulting reaction is the next n_i. As d|F| = n . dF this is Newton's method, with
 * quadratic convergence, and variations are exact with n fixed.
 *
 * Uniqueness. ||F| - |F'|| <= |F - F'|, so that c -> k |F_0 + D c| is a contraction in the maximum norm where the
 * gain
 *
 *     max_i k_i sum_j |D_ij| < 1,
 *
 * which then has one fixed point. Of one bearing c + k |F(c)| increases with c: it sticks if and only if the
 * moment for sticking is at most k |F|, and otherwise slips to one side. With a gain of 1 or more there may be
 * two solutions or none, and the scene is refused; k |D| is about k over the distance from the pin to the
 * centre of mass, or to the point where the body acts on others. So are pins whose reactions are statically
 * indeterminate.
 *
 * An impact has no impulse of this friction.
 */
#ifndef FBD_DYNAMICS_JOURNALS_H
#define FBD_DYNAMICS_JOURNALS_H

#include "dynamics/tree.h"

struct fbd_state;

/* A change d of n changes n . F by d^2/2 of it. The direction of a small reaction, the sum of large forces, has
 * the rounding of these. */
static const double journal_negligible_turn = 1e-8;

/* The force in the joint of link i for the right-hand side solved last. */
static inline struct vec journal_force(const struct tree_work *work, int i)
{
    return inertia_wrench(&work->links[i].I, work->x[i].A, work->x[i].p).force;
}

/* Direct n of journal i along a reaction; zero for none. Returns the change of n. */
double journal_aim(const struct tree *tree, struct tree_work *work, int i, struct vec F);

/* Direct all of them along their reactions in a complete tree. */
void journals_aim(const struct tree *tree, struct tree_work *work);

/* After tree_system_solve: direct them along the resulting reactions. True when that changes the solution. */
bool journals_turn(const struct tree *tree, const struct instant *at);

/* Does the evaluated state determine their friction? Else the reason is in state->holds, with the gain, or 0
 * where reactions are indeterminate, as its answer. Evaluates the state again. */
bool journals_determined(struct fbd_state *state);

#endif
