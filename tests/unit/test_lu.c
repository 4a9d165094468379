/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * LU decomposition of small matrices.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "numeric/lu.h"
#include "random_numbers.h"

enum { largest = 12 };

static void solutions_leave_no_residual_but_rounding(void **state)
{
    (void)state;
    struct random_numbers random = {20240607};
    for (size_t n = 1; n <= largest; n++) {
        double a[largest * largest], lu[largest * largest], b[largest], x[largest];
        size_t pivot[largest];
        for (size_t i = 0; i < n * n; i++) a[i] = random_between(&random, -1, 1);
        for (size_t i = 0; i < n; i++) x[i] = b[i] = random_between(&random, -1, 1);
        memcpy(lu, a, sizeof lu);
        assert_true(lu_decompose(n, lu, pivot));
        lu_solve(n, lu, pivot, x);
        for (size_t i = 0; i < n; i++) {
            double sum = 0, magnitude = fabs(b[i]);
            for (size_t j = 0; j < n; j++) {
                sum += a[i * n + j] * x[j];
                for (size_t m = 0; m < n; m++) magnitude += fabs(x[j]);
            }
            /* Backward stability of partial pivoting: n roundings of sums whose terms have grown little. */
            assert_true(fabs(sum - b[i]) <= 4 * (double)n * DBL_EPSILON * magnitude);
        }
    }
}

/* With the pivots of the diagonal all digits would be lost, or the division fail. */
static void rows_are_exchanged_where_the_diagonal_is_small_or_zero(void **state)
{
    (void)state;
    size_t pivot[3];
    double tiny[4] = {1e-20, 1, 1, 1}, b[2] = {1, 2};
    assert_true(lu_decompose(2, tiny, pivot));
    lu_solve(2, tiny, pivot, b);
    assert_true(fabs(b[0] - 1) <= 2 * DBL_EPSILON && fabs(b[1] - 1) <= 2 * DBL_EPSILON);
    double cycle[9] = {0, 2, 0, 0, 0, 4, 8, 0, 0}, c[3] = {2, 8, 24};
    assert_true(lu_decompose(3, cycle, pivot));
    lu_solve(3, cycle, pivot, c);
    assert_true(c[0] == 3 && c[1] == 1 && c[2] == 2);
}

static void a_matrix_that_is_singular_or_not_finite_is_refused(void **state)
{
    (void)state;
    size_t pivot[2];
    double zero[1] = {0}, dependent[4] = {1, 2, 2, 4}, nan[4] = {NAN, 1, 1, 1},
           infinite[4] = {1, 1, INFINITY, 1};
    assert_false(lu_decompose(1, zero, pivot));
    assert_false(lu_decompose(2, dependent, pivot));
    assert_false(lu_decompose(2, nan, pivot));
    assert_false(lu_decompose(2, infinite, pivot));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_leave_no_residual_but_rounding),
        cmocka_unit_test(rows_are_exchanged_where_the_diagonal_is_small_or_zero),
        cmocka_unit_test(a_matrix_that_is_singular_or_not_finite_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
