/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * LU decomposition of small dense matrices, in place and without allocation.
 *
 * GSL's gsl_linalg_LU_decomp allocates memory on every call (2.7) and calls the error handler for a singular
 * matrix; neither is acceptable within an integration step.
 */
#ifndef FBD_NUMERIC_LU_H
#define FBD_NUMERIC_LU_H

#include <stdbool.h>
#include <stddef.h>

/* Replace the n by n matrix `a`, row by row, by L and U with P a = L U; `pivot` takes n numbers. False if a
 * pivot is zero or not finite; then `a` is invalid. Partial pivoting. */
bool lu_decompose(size_t n, double *a, size_t *pivot);

/* Replace b by the solution x of a x = b. */
void lu_solve(size_t n, const double *lu, const size_t *pivot, double *b);

#endif
