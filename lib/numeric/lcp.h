/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The linear complementarity problem: w = M z + q with w >= 0, z >= 0 and w_i z_i = 0 for each i.
 *
 * Lemke's method (Cottle, Pang and Stone, The Linear Complementarity Problem, section 4.4): a further unknown
 * z_0 with a column of ones makes the start feasible, and pivots on complements of what has just left drive
 * it out. Rows that tie are told apart by the lexicographic rule, so that it cannot cycle: redundant holds,
 * as the feet of a block, always tie. Rows and columns are brought to one size first, which changes neither
 * signs nor what is complementary; so accelerations, forces and moments may stand in one problem.
 *
 * It ends in a solution, or in a ray. For M of the kinds that holds without friction give (positive
 * semi-definite) a ray means that there is no solution; with friction it usually does.
 */
#ifndef FBD_NUMERIC_LCP_H
#define FBD_NUMERIC_LCP_H

#include <stdbool.h>
#include <stddef.h>

enum lcp {
    lcp_solved,
    lcp_ray,  /* none was found */
    lcp_lost, /* in rounding */
    lcp_no_memory
};

/* M is n by n, row by row; z and w take n. Of a solution z_i = 0 or w_i = 0 exactly. */
enum lcp lcp_solve(size_t n, const double *M, const double *q, double *z, double *w);

/* The same from start number `cover`, which is another column in place of the one of ones (0): where one way ends in a ray
 * or in rounding another may not. */
enum lcp lcp_solve_from(size_t n, const double *M, const double *q, int cover, double *z, double *w);

#endif
