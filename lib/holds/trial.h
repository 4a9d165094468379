/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces of unilateral constraints in given modes.
 */
#ifndef FBD_HOLDS_TRIAL_H
#define FBD_HOLDS_TRIAL_H

#include "holds/holds.h"

struct trial {
    struct hold_problem *problem;
    int *side; /* of the guides: the sign of N */
    double *A, *f, *first;
    double *row; /* scale factors of the rows of A */
    size_t *pivot;
    int solutions;
};

/* False when memory is out; call trial_free in any case. */
bool trial_new(struct trial *trial, struct hold_problem *problem);
void trial_free(struct trial *trial);

/* The system A f = right (right is stored in f) of the modes: A f = -free of closed or sticking constraints,
 * f = 0 of open ones, f + mode mu P = 0 of slipping ones; rows are scaled to comparable sizes. A compliance
 * `give`, relative to the diagonal of A, regularizes redundant constraints. */
void trial_set_system(struct trial *trial, double give);

/* Forces and accelerations in the modes; false where they are indeterminate. */
bool trial_find_forces(struct trial *trial);

/* Store forces f in the problem, with the resulting accelerations and guide forces. */
void trial_take_forces(struct hold_problem *problem, const double *f);

#endif
