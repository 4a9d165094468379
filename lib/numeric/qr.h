/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rank, null vectors and solutions of a small dense matrix of any shape.
 *
 * A P = Q R by Householder reflections, choosing in each step the column with the largest remainder (Businger
 * and Golub 1965; Golub and Van Loan, Matrix Computations, section 5.4.2). In contrast to singular vectors the
 * null vectors are neither orthogonal nor of length one; but each of them combines one dependent column with
 * columns of the basis, and so has entries only where its equations have. Where orthonormal ones are needed
 * they are made of these, which costs far less than singular values where they are few.
 */
#ifndef FBD_NUMERIC_QR_H
#define FBD_NUMERIC_QR_H

#include <stdbool.h>
#include <stddef.h>

struct qr {
    size_t rows, cols, rank;
    double *R;      /* cols of rows, in the order of the pivots: R, and below it the reflections */
    double *share;  /* of each reflection, 1 - share v v^T */
    double *null;   /* cols - rank of cols */
    size_t *column; /* cols: column of each pivot */
    size_t *row;    /* the row that each step has exchanged with its own */
};

/* For a matrix given row by row; columns whose remainder is below `zero` times the largest column count as
 * dependent. That remainder lies between the next singular value and, except for specially constructed
 * matrices, a few times that. False when memory is out; qr_free in any case. */
bool qr_decompose(struct qr *qr, size_t rows, size_t cols, const double *a, double zero);
void qr_free(struct qr *qr);

/* x += a least-squares solution of |A x - b|: zero outside the columns of the basis. b is overwritten. */
void qr_add_solution(const struct qr *qr, double *b, double *x);

/* cols - rank rows of `cols`: the null vectors, made orthonormal. */
void qr_set_orthonormal_null(const struct qr *qr, double *rows);

/* w = the row vector with w R = z P: zero beyond the rank. A P R^-1 has orthonormal columns. */
void qr_divide_by_triangle(const struct qr *qr, const double *z, double *w);

/* Entry i of null vector k, 0 <= k < cols - rank: A times a null vector is zero. */
static inline double qr_null(const struct qr *qr, size_t i, size_t k)
{
    return qr->null[k * qr->cols + i];
}

#endif
