/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Modes that are tried: what the forces of holds are in them.
 */
#ifndef FBD_HOLDS_TRIAL_H
#define FBD_HOLDS_TRIAL_H

#include "holds/holds.h"

struct trial {
    struct hold_problem *problem;
    int *side; /* of the guides: the sign of N */
    double *A, *f, *first;
    double *row; /* by what rows of A have been divided */
    size_t *pivot;
    int solutions;
};

/* False when memory is out; trial_free in any case. */
bool trial_new(struct trial *trial, struct hold_problem *problem);
void trial_free(struct trial *trial);

/* The system A f = right (left in f) of the modes: A f = -free of what keeps, f = 0 of what is open, f + mode mu P = 0
 * of what slips; with rows of comparable sizes. Some give, as a share of each hold's own answer, tells redundant holds
 * apart. */
void trial_set_system(struct trial *trial, double give);

/* Forces and accelerations in the modes; false where they are not determined. */
bool trial_find_forces(struct trial *trial);

/* Forces f for the holds, and what accelerations and guides make of them. */
void trial_take_forces(struct hold_problem *problem, const double *f);

#endif
