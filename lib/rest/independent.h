/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Independent coordinates: a subset of all n coordinates of a scene with couplings that may be chosen freely
 * near a position on the couplings, and the dependence of the others on them.
 *
 * The admissible velocities are the range of the projection S = 1 - P, with P orthogonal in the mass metric
 * (project.h). Its dimension is the number of degrees of freedom, the trace of S. Gauss-Jordan elimination of
 * the columns gives a basis T of the range in which f coordinates are independent (their rows of T are those
 * of 1), also with redundant constraints:
 *
 *     dq = T dz,   z = the independent coordinates
 *
 * Rows are chosen by the size of their pivots; within a factor of ten, coordinates listed first in the file
 * are preferred.
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

/* Is coordinate i prescribed by a drive? */
bool coordinate_is_driven(const struct fbd_model *model, size_t i);

/* S, n x n row by row, for a state at rest on its couplings; leaves it at rest and evaluated. */
void independent_share(struct fbd_state *state, double *share);

/* Allocate for the scene of the state. False when memory is out; call independent_free in any case. */
bool independent_new(struct independent *independent, const struct fbd_state *state);
void independent_free(struct independent *independent);

/* Choose them at a state at rest on its couplings. False where the number of degrees of freedom is not clear:
 * a singular position. */
bool independent_choose(struct independent *independent, struct fbd_state *state);

/* Compute T of the same coordinates at another state; false where they are not independent there. */
bool independent_follow(struct independent *independent, struct fbd_state *state);

#endif
