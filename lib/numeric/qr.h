/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rank, null vectors and solutions of a small dense matrix of any shape.
 *
 * A P = Q R by Householder reflections, with that column first which has most left (Businger and Golub 1965;
 * Golub and Van Loan, Matrix Computations, section 5.4.2). Against singular values (svd.h) the null vectors are
 * neither orthogonal nor of length one; but each of them is one column by those of the basis, and so touches only
 * what its equations touch, and what is left to singular values afterwards are as many columns as there are null
 * vectors. It takes a tenth to a hundredth of the time.
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
    size_t *column; /* cols: which one each pivot is */
    size_t *row;    /* the row that each step has brought to its place */
};

/* Of a matrix given row by row; columns whose rest is below `zero` of the largest column count as dependent. That rest
 * lies between the next singular value and, but for matrices made for it, a few times that. False when memory is out;
 * qr_free in any case. */
bool qr_decompose(struct qr *qr, size_t rows, size_t cols, const double *a, double zero);
void qr_free(struct qr *qr);

/* x += an x of least squares, |A x - b|: zero in all but the columns of the basis. b is used up. */
void qr_add_solution(const struct qr *qr, double *b, double *x);

/* Entry i of null vector k, 0 <= k < cols - rank: A times them is zero. */
static inline double qr_null(const struct qr *qr, size_t i, size_t k)
{
    return qr->null[k * qr->cols + i];
}

#endif
