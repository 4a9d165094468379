/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rank, null vectors and least squares of random matrices of all shapes and ranks, against singular values.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "numeric/qr.h"
#include "random_numbers.h"

enum { most = 30 };

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

static double row_times(const double *a, size_t cols, size_t i, const double *x)
{
    double sum = 0;
    for (size_t j = 0; j < cols; j++) sum += a[i * cols + j] * x[j];
    return sum;
}

/* Rounding, by the condition. */
static double slack_of(const struct qr *qr)
{
    double last = qr->R[(qr->rank - 1) * qr->rows + qr->rank - 1];
    return 1e-12 * fabs(qr->R[0] / last);
}

/* What a solution leaves is orthogonal to all columns. */
static void check_solution(struct random_numbers *numbers, const struct qr *qr, const double *a)
{
    double b[most] = {0}, used[most] = {0}, x[most] = {0};
    for (size_t i = 0; i < qr->rows; i++) b[i] = used[i] = random_between(numbers, -1, 1);
    qr_add_solution(qr, used, x);
    for (size_t i = 0; i < qr->rows; i++) b[i] -= row_times(a, qr->cols, i, x);
    for (size_t j = 0; j < qr->cols; j++) {
        double sum = 0;
        for (size_t i = 0; i < qr->rows; i++) sum += a[i * qr->cols + j] * b[i];
        assert_true(fabs(sum) < slack_of(qr));
    }
}

static void check_null_vectors(const struct qr *qr, const double *a)
{
    const size_t n = qr->cols, open = n - qr->rank;
    double rows[most * most];
    qr_set_orthonormal_null(qr, rows);
    for (size_t k = 0; k < open; k++) {
        double z[most] = {0};
        int own = 0;
        for (size_t j = 0; j < n; j++) z[j] = qr_null(qr, j, k);
        for (size_t i = 0; i < qr->rows; i++) {
            assert_true(fabs(row_times(a, n, i, z)) < slack_of(qr));
            assert_true(fabs(row_times(a, n, i, rows + k * n)) < slack_of(qr));
        }
        for (size_t l = 0; l < open; l++) { /* one that is its own: so they are independent */
            own += qr_null(qr, qr->column[qr->rank + k], l) != 0;
            assert_true(fabs(row_times(rows, n, k, rows + l * n) - (k == l)) < 1e-14);
        }
        assert_int_equal(own, 1);
    }
}

static void ranks_solutions_and_null_vectors_are_those_of_the_matrix(void **unused)
{
    (void)unused;
    static const size_t shapes[][3] = {{1, 1, 1},  {5, 3, 3},    {3, 5, 3},    {6, 6, 4},   {20, 8, 5},
                                       {8, 20, 5}, {30, 30, 30}, {30, 30, 29}, {30, 12, 1}, {12, 30, 12}};
    struct random_numbers numbers = {4711};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (int trial = 0; trial < 20; trial++) {
            double a[most * most] = {0};
            struct qr qr;
            fill(&numbers, shapes[i][0], shapes[i][1], shapes[i][2], a);
            assert_true(qr_decompose(&qr, shapes[i][0], shapes[i][1], a, 1e-10));
            assert_int_equal(qr.rank, shapes[i][2]);
            check_null_vectors(&qr, a);
            check_solution(&numbers, &qr, a);
            qr_free(&qr);
        }
}

/* Blocks that share no equation: a null vector stays in its own. */
static void null_vectors_touch_only_what_their_equations_touch(void **unused)
{
    (void)unused;
    static const size_t rows = 3, cols = 4;
    enum { blocks = 5, size = blocks * 3 * blocks * 4 };
    struct random_numbers numbers = {12};
    double a[size] = {0};
    for (size_t i = 0; i < blocks * rows; i++)
        for (size_t j = 0; j < cols; j++)
            a[i * blocks * cols + i / rows * cols + j] = random_between(&numbers, -1, 1);
    struct qr qr;
    assert_true(qr_decompose(&qr, blocks * rows, blocks * cols, a, 1e-10));
    assert_int_equal(qr.rank, blocks * rows);
    for (size_t k = 0; k < blocks; k++)
        for (size_t j = 0; j < blocks * cols; j++)
            assert_true(j / cols == qr.column[qr.rank + k] / cols || qr_null(&qr, j, k) == 0);
    qr_free(&qr);
}

static void nothing_and_zero_have_rank_zero(void **unused)
{
    (void)unused;
    static const double zero[6];
    struct qr qr;
    assert_true(qr_decompose(&qr, 2, 3, zero, 1e-10));
    assert_int_equal(qr.rank, 0);
    for (size_t k = 0; k < 3; k++) assert_true(qr_null(&qr, qr.column[k], k) == 1);
    qr_free(&qr);
    assert_true(qr_decompose(&qr, 2, 0, zero, 1e-10));
    assert_int_equal(qr.rank, 0);
    qr_free(&qr);
    double x[3] = {1, 2, 3}, b[1] = {0};
    assert_true(qr_decompose(&qr, 0, 3, zero, 1e-10));
    qr_add_solution(&qr, b, x);
    assert_true(qr.rank == 0 && x[0] == 1 && x[1] == 2 && x[2] == 3);
    qr_free(&qr);
}

/* The columns of A P R^-1, from the rows of A. */
static void rows_divided_by_the_triangle_have_orthonormal_columns(void **unused)
{
    (void)unused;
    enum { rows = 12, cols = 9 };
    for (uint64_t seed = 1; seed <= 100; seed++) {
        struct random_numbers numbers = {seed};
        double a[rows * cols], q[rows * cols];
        struct qr qr;
        fill(&numbers, rows, cols, 1 + seed % cols, a);
        assert_true(qr_decompose(&qr, rows, cols, a, 1e-10));
        for (size_t i = 0; i < rows; i++) qr_divide_by_triangle(&qr, a + i * cols, q + i * cols);
        for (size_t k = 0; k < cols; k++)
            for (size_t l = 0; l < cols; l++) {
                double sum = 0;
                for (size_t i = 0; i < rows; i++) sum += q[i * cols + k] * q[i * cols + l];
                assert_true(fabs(sum - (k == l && k < qr.rank)) < 1e-9); /* rounding, by the condition */
            }
        qr_free(&qr);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranks_solutions_and_null_vectors_are_those_of_the_matrix),
        cmocka_unit_test(null_vectors_touch_only_what_their_equations_touch),
        cmocka_unit_test(nothing_and_zero_have_rank_zero),
        cmocka_unit_test(rows_divided_by_the_triangle_have_orthonormal_columns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
