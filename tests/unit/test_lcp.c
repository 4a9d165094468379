/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linear complementarity problems: what is said to be a solution is one, and one is found wherever there is
 * one for the kinds of matrix for which Lemke's method ends so.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "numeric/lcp.h"
#include "numeric/lu.h"
#include "random_numbers.h"

enum { most = 12 };

/* The solution of the basis: M z + q = 0 in its rows. */
static enum lcp solve(size_t n, const double *M, const double *q, int cover, double *z, double *w)
{
    double A[most * most] = {0}, b[most] = {0};
    size_t pivot[most];
    bool is_basic[most] = {false};
    enum lcp found = lcp_find_basis(n, M, q, cover, is_basic);
    if (found != lcp_solved) return found;
    for (size_t i = 0; i < n; i++) {
        b[i] = -q[i];
        for (size_t k = 0; k < n; k++) A[i * n + k] = is_basic[k] ? M[i * n + k] : -(double)(i == k);
    }
    assert_true(lu_decompose(n, A, pivot));
    lu_solve(n, A, pivot, b);
    for (size_t k = 0; k < n; k++) {
        z[k] = is_basic[k] ? b[k] : 0;
        w[k] = is_basic[k] ? 0 : b[k];
    }
    return found;
}

static void check_solution(size_t n, const double *M, const double *q, const double *z, const double *w)
{
    const double rounding = 1e-9;
    for (size_t i = 0; i < n; i++) {
        double sum = q[i], size = fmax(fabs(q[i]), 1);
        for (size_t k = 0; k < n; k++) {
            sum += M[i * n + k] * z[k];
            size = fmax(size, fabs(M[i * n + k] * z[k]));
        }
        if (!(fabs(sum - w[i]) <= rounding * size)) fail_msg("off by %g of %g", sum - w[i], size);
        assert_true(z[i] == 0 || w[i] == 0);
        assert_true(w[i] >= -1e-7 * size);
        assert_true(z[i] >= -1e-7);
    }
}

static void one_unknown_is_found_or_there_is_none(void **unused)
{
    (void)unused;
    double z, w;
    assert_int_equal(solve(1, (double[]){2}, (double[]){3}, 0, &z, &w), lcp_solved);
    assert_true(z == 0 && w == 3);
    assert_int_equal(solve(1, (double[]){2}, (double[]){-3}, 0, &z, &w), lcp_solved);
    assert_true(fabs(z - 1.5) < 1e-15 && w == 0);
    assert_int_equal(solve(1, (double[]){-2}, (double[]){-3}, 0, &z, &w), lcp_ray);
    assert_int_equal(solve(1, (double[]){0}, (double[]){-1}, 0, &z, &w), lcp_ray);
    assert_int_equal(lcp_find_basis(0, NULL, NULL, 0, NULL), lcp_solved);
}

/* A block on two feet that are one: the rows are the same, and tie in every pivot. */
static void redundant_rows_do_not_cycle(void **unused)
{
    (void)unused;
    double M[36], q[6], z[6], w[6], sum = 0;
    for (size_t i = 0; i < 36; i++) M[i] = 0.5;
    for (size_t i = 0; i < 6; i++) q[i] = -9.81;
    assert_int_equal(solve(6, M, q, 0, z, w), lcp_solved);
    for (size_t i = 0; i < 6; i++) sum += z[i];
    assert_true(fabs(sum - 2 * 9.81) < 1e-12);
}

/* M = J J^T + K with K skew, J of any rank; q so that there is a solution. */
static void monotone_problems_are_solved(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        struct random_numbers numbers = {seed};
        size_t n = 1 + (size_t)random_between(&numbers, 0, most),
               rank = (size_t)random_between(&numbers, 0, (double)n + 1);
        double J[most * most] = {0}, M[most * most] = {0}, q[most], z[most], w[most];
        for (size_t i = 0; i < n * n; i++) J[i] = random_between(&numbers, -1, 1);
        for (size_t i = 0; i < n; i++)
            for (size_t k = 0; k < i; k++) {
                M[i * n + k] = random_between(&numbers, -1, 1);
                M[k * n + i] = -M[i * n + k];
            }
        for (size_t i = 0; i < n; i++)
            for (size_t k = 0; k < n; k++)
                for (size_t l = 0; l < rank; l++) M[i * n + k] += J[i * n + l] * J[k * n + l];
        for (size_t i = 0; i < n; i++) {
            z[i] = random_between(&numbers, -1, 1);
            w[i] = z[i] > 0 ? 0 : random_between(&numbers, 0, 1);
            z[i] = fmax(0, z[i]);
        }
        for (size_t i = 0; i < n; i++) {
            q[i] = w[i];
            for (size_t k = 0; k < n; k++) q[i] -= M[i * n + k] * z[k];
        }
        for (int cover = 0; cover < 4; cover++) {
            if (solve(n, M, q, cover, z, w) != lcp_solved) fail_msg("seed %d: not solved", (int)seed);
            check_solution(n, M, q, z, w);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_unknown_is_found_or_there_is_none),
        cmocka_unit_test(redundant_rows_do_not_cycle),
        cmocka_unit_test(monotone_problems_are_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
