/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Independent coordinates: those among all n of a scene with couplings that may be chosen freely near a place on
 * the couplings, and how the others follow them.
 *
 * The couplings leave of velocities v what the projection S = 1 - P does, P along the masses (project.h). S has
 * as many dimensions as there are degrees of freedom, which is its trace, and its columns are ways that the
 * scene can go. Gauss-Jordan elimination of the columns gives a basis T of them in which f coordinates move by
 * themselves (their rows of T are those of 1), whatever conditions are redundant:
 *
 *     dq = T dz,   z = the independent coordinates
 *
 * Rows are taken by the size of their pivots, coordinates that the file lists first before others within a
 * factor of ten.
 */
#ifndef FBD_REST_INDEPENDENT_H
#define FBD_REST_INDEPENDENT_H

#include "dynamics/state.h"

struct independent {
    size_t n, count; /* all coordinates; independent ones */
    int *which;      /* count: ascending */
    double *way;     /* n x count, row by row: T */
    double *share, *size;
};

/* Is coordinate i prescribed? Nothing else moves it. */
bool coordinate_is_driven(const struct fbd_model *model, size_t i);

/* S, n x n row by row, for a state at rest on its couplings; leaves it at rest and evaluated. */
void independent_share(struct fbd_state *state, double *share);

/* Room for the scene of the state. False when memory is out; to be freed in any case. */
bool independent_new(struct independent *independent, const struct fbd_state *state);
void independent_free(struct independent *independent);

/* Choose them at a state at rest on its couplings. False where the couplings leave no clear number of degrees of
 * freedom: a singular position. */
bool independent_choose(struct independent *independent, struct fbd_state *state);

/* The ways of the same coordinates at another state; false where they are not independent there. */
bool independent_follow(struct independent *independent, struct fbd_state *state);

#endif
