/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Phi(h) = int_0^h e^(sA) ds and e^(hA) of a small matrix A, for the lengths h = 2^k / (8 rho), k = 0, 1, 2, ...
 *
 * The first is a series; each of the others follows from the one before (linear.h). A relative error of the first
 * matrix persists through all doublings: after 1e6 s of an oscillation at 1 Hz, 26 of them, a rounding of 1e-16 would be
 * a phase of 1e-9 rad. They are therefore computed in double-double arithmetic, and each is rounded once.
 */
#ifndef FBD_INTEGRATE_LINEAR_DOUBLINGS_H
#define FBD_INTEGRATE_LINEAR_DOUBLINGS_H

#include <stdbool.h>
#include <stddef.h>

enum { linear_terms = 26, most_doublings = 128 };
static const double linear_reach = 0x1p125; /* h rho of the longest step */

struct doublings {
    size_t dim;
    double rho;                 /* bound of |A| */
    int made, room;             /* lengths that are computed, and that there is memory for */
    double *matrices;           /* for each length dim x dim: Phi, then the exponential; or NULL */
    struct double_double *last; /* the same of the last length, then scratch of twice the size; or NULL */
};

/* Forget all lengths: the matrix is another one. */
void doublings_restart(struct doublings *doublings, size_t dim, double rho);
void doublings_free(struct doublings *doublings);

/* Compute all lengths up to h; h rho is below linear_reach. False when memory is out. */
bool doublings_reach(struct doublings *doublings, const double *A, double h);

/* The index of the longest length up to h, and that length [s]. */
int doublings_within(const struct doublings *doublings, double h);
double doublings_length(const struct doublings *doublings, int index);

/* dim x dim, row by row. */
const double *doublings_phi(const struct doublings *doublings, int index);
const double *doublings_exponential(const struct doublings *doublings, int index);

#endif
