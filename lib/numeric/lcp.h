/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The linear complementarity problem: w = M z + q with w >= 0, z >= 0 and w_i z_i = 0 for each i.
 *
 * Lemke's method (Cottle, Pang and Stone, The Linear Complementarity Problem, section 4.4): an additional
 * unknown z_0 with a column of ones makes the start feasible, and pivots on the complement of the variable
 * that has just left the basis remove it. Ties between rows are broken by the lexicographic rule, so that it
 * cannot cycle: redundant constraints, as the feet of a block, always tie.
 *
 * It ends in a solution, or in a ray. For a positive semi-definite M, as of constraints without friction, a
 * ray means that there is no solution; with friction it usually does.
 */
#ifndef FBD_NUMERIC_LCP_H
#define FBD_NUMERIC_LCP_H

#include <stdbool.h>
#include <stddef.h>

enum lcp {
    lcp_solved,
    lcp_ray,  /* no solution was found */
    lcp_lost, /* failed by rounding */
    lcp_no_memory
};

/* Which z_k are basic in the solution; the others are zero. O(n^2) for each pivot. M is n by n, row by row; its entries, and
 * those of q, are of one size. Start number `cover` (0: the column of ones): if one start ends in a ray or fails by rounding,
 * another may succeed. */
enum lcp lcp_find_basis(size_t n, const double *M, const double *q, int cover, bool *is_basic);

#endif
