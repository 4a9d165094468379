/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Singular values of random matrices of all shapes and ranks: the factors give the matrix back, are
 * orthogonal, and null vectors and least squares are what they say.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "numeric/svd.h"
#include "random_numbers.h"

enum { most = 30 };

static const double rounding = 1e-13; /* of sums of 30 products of size 1 */

/* rows x cols of the given rank: a product of two random ones. */
static void fill(struct random_numbers *numbers, size_t rows, size_t cols, size_t rank, double *a)
{
    double left[most * most], right[most * most];
    for (size_t i = 0; i < rows * rank; i++) left[i] = random_between(numbers, -1, 1);
    for (size_t i = 0; i < rank * cols; i++) right[i] = random_between(numbers, -1, 1);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < cols; j++) {
            a[i * cols + j] = 0;
            for (size_t k = 0; k < rank; k++) a[i * cols + j] += left[i * rank + k] * right[k * cols + j];
        }
}

static double product(const double *a, const double *b, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static void check_factors(const struct svd *svd, const double *a)
{
    size_t rows = svd->rows, cols = svd->cols;
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < cols; j++) {
            double sum = 0;
            for (size_t k = 0; k < cols; k++) sum += svd->U[k * rows + i] * svd->V[k * cols + j];
            assert_true(fabs(sum - a[i * cols + j]) < rounding);
        }
    for (size_t k = 0; k < cols; k++) {
        assert_true(k == 0 || svd->S[k] <= svd->S[k - 1]);
        for (size_t l = 0; l < cols; l++) {
            double v = product(svd->V + k * cols, svd->V + l * cols, cols);
            double u = product(svd->U + k * rows, svd->U + l * rows, rows);
            assert_true(fabs(v - (k == l)) < rounding);
            assert_true(k == l || fabs(u) <= rounding * svd->S[0] * svd->S[0]);
        }
    }
}

static void check_solution(struct random_numbers *numbers, const struct svd *svd, const double *a)
{
    size_t rows = svd->rows, cols = svd->cols;
    double b[most], x[most] = {0}, rest[most];
    for (size_t i = 0; i < rows; i++) b[i] = random_between(numbers, -1, 1);
    svd_add_solution(svd, b, x);
    for (size_t i = 0; i < rows; i++) rest[i] = b[i] - product(a + i * cols, x, cols);
    /* What is left is orthogonal to all columns, and x to all null vectors; over the least singular value. */
    double slack = 1e-11 / svd->S[svd->rank - 1];
    for (size_t j = 0; j < cols; j++) {
        double sum = 0;
        for (size_t i = 0; i < rows; i++) sum += a[i * cols + j] * rest[i];
        assert_true(fabs(sum) < slack);
    }
    for (size_t k = 0; k < cols - svd->rank; k++) {
        double along = 0, answer = 0;
        for (size_t j = 0; j < cols; j++) along += svd_null(svd, j, k) * x[j];
        assert_true(fabs(along) < slack);
        for (size_t i = 0; i < rows; i++) {
            answer = 0;
            for (size_t j = 0; j < cols; j++) answer += a[i * cols + j] * svd_null(svd, j, k);
            assert_true(fabs(answer) < rounding);
        }
    }
}

static void factors_solutions_and_null_vectors_are_what_they_say(void **unused)
{
    (void)unused;
    static const size_t shapes[][3] = {{1, 1, 1},  {5, 3, 3},    {3, 5, 3},    {6, 6, 4},   {20, 8, 5},
                                       {8, 20, 5}, {30, 30, 30}, {30, 30, 29}, {30, 12, 1}, {12, 30, 12}};
    struct random_numbers numbers = {4711};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (int trial = 0; trial < 5; trial++) {
            double a[most * most];
            struct svd svd;
            fill(&numbers, shapes[i][0], shapes[i][1], shapes[i][2], a);
            assert_true(svd_decompose(&svd, shapes[i][0], shapes[i][1], a));
            assert_int_equal(svd.rank, shapes[i][2]);
            check_factors(&svd, a);
            check_solution(&numbers, &svd, a);
            svd_free(&svd);
        }
}

static void nothing_and_zero_have_rank_zero(void **unused)
{
    (void)unused;
    static const double zero[6];
    struct svd svd;
    assert_true(svd_decompose(&svd, 2, 3, zero));
    assert_int_equal(svd.rank, 0);
    svd_free(&svd);
    assert_true(svd_decompose(&svd, 2, 0, zero));
    assert_int_equal(svd.rank, 0);
    svd_free(&svd);
    double x[3] = {1, 2, 3};
    assert_true(svd_decompose(&svd, 0, 3, zero));
    svd_add_solution(&svd, zero, x);
    assert_true(svd.rank == 0 && x[0] == 1 && x[1] == 2 && x[2] == 3);
    svd_free(&svd);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(factors_solutions_and_null_vectors_are_what_they_say),
        cmocka_unit_test(nothing_and_zero_have_rank_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
