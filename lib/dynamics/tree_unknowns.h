/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Between the files of the system of tree_system.h: its matrix (constraint_matrix.c), and its factors
 * (constraint_solve.c).
 */
#ifndef FBD_DYNAMICS_TREE_UNKNOWNS_H
#define FBD_DYNAMICS_TREE_UNKNOWNS_H

#include "dynamics/tree_system.h"

/* Is it a row of a coupling? */
static inline bool unknown_is_row(const struct tree *tree, int k)
{
    return k < tree->row_count;
}

/* Is it the force along a massless coordinate? */
static inline bool unknown_is_massless(const struct tree *tree, int k)
{
    return k >= tree->row_count + tree->pair_count;
}

static inline const struct tree_massless *massless_of(const struct tree *tree, int k)
{
    return &tree->massless[k - tree->row_count - tree->pair_count];
}

/* Entry k of the row or column j, stored from column or row first[j]. */
static inline double *system_entry(const struct tree_work *work, double *kept, int j, int k)
{
    return &kept[work->envelope[j] + (size_t)(k - work->first[j])];
}

static inline double system_value(const struct tree_work *work, const double *kept, int j, int k)
{
    return kept[work->envelope[j] + (size_t)(k - work->first[j])];
}

/* Is the system assembled by paths? Piles of contacts are so sensitive that their motions stay as they are. */
static inline bool system_has_paths(const struct tree *tree, const struct tree_work *work)
{
    return work->symmetric && tree->meeting_count == 0;
}

/* Set up the matrix in work->whole and work->diagonal. */
void tree_system_assemble(const struct fbd_model *model, const struct instant *at);

/* The response of the trees to all unknowns: work->x and work->unit; in steps of a symmetric system only the
 * accelerations of work->x. */
void tree_system_answer(const struct fbd_model *model, const struct instant *at, const double *z);

#endif
