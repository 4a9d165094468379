/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Singular values of a small dense matrix of any shape, for systems that may have too many or too few
 * equations.
 *
 * One-sided Jacobi rotations (Hestenes 1958; Golub and Van Loan, Matrix Computations, section 8.6.3): pairs
 * of columns are rotated until all are orthogonal, A V = U S. Of GSL's methods (2.7.1) two allocate memory
 * without a check, and its Jacobi method failed for the equations of a truss of a hundred rods.
 */
#ifndef FBD_NUMERIC_SVD_H
#define FBD_NUMERIC_SVD_H

#include <stdbool.h>
#include <stddef.h>

/* A = U S V^T; singular values below 1e-10 of the largest count as zero, and come last. */
struct svd {
    size_t rows, cols, rank;
    double *U; /* cols of rows: U S, column after column */
    double *V; /* cols of cols, column after column */
    double *S; /* cols, decreasing */
};

/* For a matrix given row by row. False when memory is out; svd_free in any case. */
bool svd_decompose(struct svd *svd, size_t rows, size_t cols, const double *a);
void svd_free(struct svd *svd);

/* x += the minimum-norm least-squares solution of |A x - b|. */
void svd_add_solution(const struct svd *svd, const double *b, double *x);

/* Entry i of null vector k, 0 <= k < cols - rank: orthonormal; A times a null vector is zero. */
static inline double svd_null(const struct svd *svd, size_t i, size_t k)
{
    return svd->V[(svd->rank + k) * svd->cols + i];
}

#endif
