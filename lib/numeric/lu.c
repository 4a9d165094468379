/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "numeric/lu.h"

#include <math.h>

static size_t largest_in_column(size_t n, const double *a, size_t column)
{
    size_t best = column;
    for (size_t i = column + 1; i < n; i++)
        if (fabs(a[i * n + column]) > fabs(a[best * n + column])) best = i;
    return best;
}

static void swap_rows(size_t n, double *restrict a, double *restrict b)
{
    for (size_t j = 0; j < n; j++) {
        double kept = a[j];
        a[j] = b[j];
        b[j] = kept;
    }
}

/* The diagonal holds the reciprocals of the pivots, as a division is slower than a product. */
bool lu_decompose(size_t n, double *a, size_t *pivot)
{
    for (size_t k = 0; k < n; k++) {
        double *row = a + k * n;
        pivot[k] = largest_in_column(n, a, k);
        if (pivot[k] != k) swap_rows(n, row, a + pivot[k] * n);
        if (row[k] == 0 || !isfinite(row[k])) return false;
        row[k] = 1 / row[k];
        for (size_t i = k + 1; i < n; i++) {
            double *below = a + i * n, factor = below[k] * row[k];
            below[k] = factor;
            if (factor == 0) continue;
            for (size_t j = k + 1; j < n; j++) below[j] -= factor * row[j];
        }
    }
    return true;
}

/* Every body with one coordinate has two equations; loops over them would be mostly overhead. */
static inline void solve_two(const double *lu, const size_t *pivot, double *b)
{
    double first = b[pivot[0]], second = b[1 - pivot[0]] - lu[2] * first;
    b[1] = second * lu[3];
    b[0] = (first - lu[1] * b[1]) * lu[0];
}

void lu_solve(size_t n, const double *lu, const size_t *pivot, double *b)
{
    if (n == 2) {
        solve_two(lu, pivot, b);
        return;
    }
    for (size_t k = 0; k < n; k++) {
        double kept = b[pivot[k]];
        b[pivot[k]] = b[k];
        b[k] = kept;
    }
    for (size_t i = 1; i < n; i++)
        for (size_t j = 0; j < i; j++) b[i] -= lu[i * n + j] * b[j];
    for (size_t i = n; i-- > 0;) {
        for (size_t j = i + 1; j < n; j++) b[i] -= lu[i * n + j] * b[j];
        b[i] *= lu[i * n + i];
    }
}
