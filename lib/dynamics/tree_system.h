/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The linear system of a tree with closed loops: multipliers of its constraints, and friction of its slipping
 * slides.
 */
#ifndef FBD_DYNAMICS_TREE_SYSTEM_H
#define FBD_DYNAMICS_TREE_SYSTEM_H

#include "dynamics/constraint.h"

int tree_unknowns(const struct tree *tree);

/* The largest number of forces on joints by a row of the coupling. */
int tree_path_size(const struct tree *tree, const struct coupling *coupling);

/* Set up and factor the system from the rows' ports and the factored tree. Overwrites work->x. */
void tree_system_factor(const struct fbd_model *model, const struct instant *at);

/* Set work->scale, work->most and work->apart for the rows of the system, given its diagonal. */
void tree_set_scales(const struct tree *tree, struct tree_work *work);

/* Leave the system without active unknowns, solved. */
void tree_system_empty(const struct fbd_model *model, struct tree_work *work);

/* Factor it again with another damping. */
void tree_system_refactor(const struct tree *tree, struct tree_work *work);

/* Solve for the right-hand side z, which becomes the unknowns; leaves in work->x the solved right-hand side
 * of their forces only, and in work->unit the accelerations of the joints. */
void tree_system_solve(const struct fbd_model *model, const struct instant *at, double *z);

/* Add work->unit to the entries of a that belong to joints. */
void tree_add_unit(const struct tree *tree, const struct tree_work *work, double *a);

/* Set the right-hand side of massless coordinates for the accelerations a of the joints. */
void tree_want_massless(const struct tree *tree, const struct tree_work *work, const double *a, double *z);

/* J a of row j for the accelerations work->x.A. */
double tree_row_answer(const struct tree_work *work, int j);

/* Subtract the forces of a row with the multiplier lambda from p of the links. */
void row_apply(const struct row *row, double lambda, struct tree_rhs *x);

/* Subtract the variations of the constraint forces, at fixed multipliers, from p of the links. */
void tree_apply_variations(const struct fbd_model *model, const struct instant *at,
                           const struct direction *along);

/* Is unknown k active in the modes of the instant? */
bool tree_takes_part(const struct tree *tree, const struct instant *at, int k);

/* Is no row active, as in free flight? */
bool tree_rows_are_idle(const struct tree *tree, const struct instant *at);

/* The ratio of the friction of coupling `index` to its normal force, multipliers of its along_row and
 * normal_row, if it slips with friction; else 0. */
double tree_rubbing_share(const struct fbd_model *model, const struct instant *at, int index);

/* After tree_system_solve of work->z: set the multipliers of the rows. */
void tree_take_multipliers(const struct fbd_model *model, const struct instant *at);

#endif
