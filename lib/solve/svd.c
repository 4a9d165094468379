/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/svd.h"

#include <gsl/gsl_linalg.h>

bool svd_decompose(struct svd *svd, size_t rows, size_t cols, const double *a)
{
    const double zero = 1e-10;
    size_t tall = rows > cols ? rows : cols; /* GSL wants no more columns than rows */
    *svd = (struct svd){.rows = rows, .cols = cols};
    if (cols == 0) return true;
    svd->U = gsl_matrix_calloc(tall, cols);
    svd->V = gsl_matrix_alloc(cols, cols);
    svd->S = gsl_vector_alloc(cols);
    bool made = svd->U && svd->V && svd->S;
    for (size_t i = 0; made && i < rows; i++)
        for (size_t j = 0; j < cols; j++) gsl_matrix_set(svd->U, i, j, a[i * cols + j]);
    if (!made) return false;
    /* One-sided Jacobi: small singular values come out accurate, and no memory is taken, which the other
     * methods of GSL (2.7) do without looking. What it says when sweeps run out is a matter of the last
     * digits. */
    gsl_linalg_SV_decomp_jacobi(svd->U, svd->V, svd->S);
    while (svd->rank < cols && gsl_vector_get(svd->S, svd->rank) > zero * gsl_vector_get(svd->S, 0))
        svd->rank++;
    return true;
}

void svd_free(struct svd *svd)
{
    if (svd->U) gsl_matrix_free(svd->U);
    if (svd->V) gsl_matrix_free(svd->V);
    if (svd->S) gsl_vector_free(svd->S);
}

void svd_add_solution(const struct svd *svd, const double *b, double *x)
{
    for (size_t k = 0; k < svd->rank; k++) {
        double share = 0;
        for (size_t i = 0; i < svd->rows; i++) share += gsl_matrix_get(svd->U, i, k) * b[i];
        share /= gsl_vector_get(svd->S, k);
        for (size_t j = 0; j < svd->cols; j++) x[j] += share * gsl_matrix_get(svd->V, j, k);
    }
}
