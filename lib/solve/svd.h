/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Singular values of a small dense matrix of any shape, for systems that may have too many or too few
 * equations.
 */
#ifndef FBD_SOLVE_SVD_H
#define FBD_SOLVE_SVD_H

#include <gsl/gsl_matrix.h>
#include <stdbool.h>
#include <stddef.h>

/* A = U S V^T; singular values below 1e-10 of the largest are zero, and come last. */
struct svd {
    size_t rows, cols, rank;
    gsl_matrix *U, *V; /* U with as many rows as the larger of the two; V square */
    gsl_vector *S;
};

/* Of a matrix given row by row. False when memory is out; svd_free in any case. */
bool svd_decompose(struct svd *svd, size_t rows, size_t cols, const double *a);
void svd_free(struct svd *svd);

/* x += the least x of least squares, |A x - b|. */
void svd_add_solution(const struct svd *svd, const double *b, double *x);

/* Entry i of null vector k, 0 <= k < cols - rank: orthonormal, A times them is zero. */
static inline double svd_null(const struct svd *svd, size_t i, size_t k)
{
    return gsl_matrix_get(svd->V, i, svd->rank + k);
}

#endif
