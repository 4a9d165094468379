/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The nearest point of a polyhedron, against points that geometry gives and against the conditions of Kuhn
 * and Tucker: x is a sum of active rows with weights >= 0, and nothing is violated.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>

#include "numeric/least_distance.h"
#include "random_numbers.h"

static const double rounding = 1e-12; /* of numbers of size 1 */

static void the_origin_is_nearest_where_it_is_inside(void **unused)
{
    (void)unused;
    static const double G[] = {1, 0, 0, 1, -1, -1}, h[] = {-1, -2, -0.5};
    double x[2] = {7, 7};
    assert_int_equal(least_distance(3, 2, G, h, x), least_distance_found);
    assert_true(fabs(x[0]) + fabs(x[1]) < rounding);
}

static void a_half_plane_has_the_foot_of_the_perpendicular(void **unused)
{
    (void)unused;
    static const double G[] = {0.6, 0.8}, h[] = {2}; /* 0.6 x + 0.8 y >= 2 */
    double x[2];
    assert_int_equal(least_distance(1, 2, G, h, x), least_distance_found);
    assert_true(fabs(x[0] - 1.2) < rounding && fabs(x[1] - 1.6) < rounding);
}

static void a_wedge_has_its_tip(void **unused)
{
    (void)unused;
    static const double G[] = {1, 0, 0, 1, 1, 1}, h[] = {1, 0.5, 1}; /* x >= 1, y >= 0.5; the third is idle */
    double x[2];
    assert_int_equal(least_distance(3, 2, G, h, x), least_distance_found);
    assert_true(fabs(x[0] - 1) < rounding && fabs(x[1] - 0.5) < rounding);
}

static void inequalities_that_contradict_each_other_are_said(void **unused)
{
    (void)unused;
    static const double G[] = {1, 0, -1, 0, 0, 1}, h[] = {1, 1, 0}; /* x >= 1 and x <= -1 */
    double x[2];
    assert_int_equal(least_distance(3, 2, G, h, x), least_distance_empty);
}

/* Of random half planes that all hold at a known point: x holds in all of them, and no point between x and
 * that one is nearer (which for a convex set is enough: x . (p - x) >= 0 for points p of the set). */
static void random_polyhedra_have_no_nearer_point(void **unused)
{
    (void)unused;
    enum { rows = 9, size = 4, trials = 200 };
    struct random_numbers numbers = {20240611};
    for (int trial = 0; trial < trials; trial++) {
        double G[rows * size], h[rows], inside[size], x[size], product = 0;
        for (int k = 0; k < size; k++) inside[k] = random_between(&numbers, -2, 2);
        for (int i = 0; i < rows; i++) {
            h[i] = -random_between(&numbers, 0, 0.3);
            for (int k = 0; k < size; k++) {
                G[i * size + k] = random_between(&numbers, -1, 1);
                h[i] += G[i * size + k] * inside[k];
            }
        }
        assert_int_equal(least_distance(rows, size, G, h, x), least_distance_found);
        for (int i = 0; i < rows; i++) {
            double value = -h[i];
            for (int k = 0; k < size; k++) value += G[i * size + k] * x[k];
            assert_true(value > -1e-10); /* rounding over the smallest angle between rows */
        }
        for (int k = 0; k < size; k++) product += x[k] * (inside[k] - x[k]);
        assert_true(product > -1e-10);
    }
}

static void a_level_rises_to_the_middle_between_opposite_limits(void **unused)
{
    (void)unused;
    static const double G[] = {1, 0, -1, 0, 0, 1}, h[] = {1, -4, 0}; /* x >= 1 + s, x <= 4 - s */
    double u[3], level;
    assert_true(least_distance_rise(3, 2, G, h, 9, &level, u, NULL));
    assert_true(fabs(level - 1.5) < rounding && fabs(u[0] - 0.5) < rounding && fabs(u[1] - 0.5) < rounding);
    assert_true(u[2] == 0);
    assert_true(least_distance_rise(3, 2, G, h, 0.5, &level, u, NULL));
    assert_true(level == 0.5 && u[0] == 0 && u[1] == 0 && u[2] == 0);
}

/* A level with multipliers: no point reaches a higher one, since sum u (G x - h) = - sum u h = level for every x. */
static void assert_greatest(int rows, int size, const double *G, const double *h, double most)
{
    double u[64], x[16], lower[64], level, sum = 0, bound = 0;
    assert_true(least_distance_rise((size_t)rows, (size_t)size, G, h, most, &level, u, NULL));
    for (int i = 0; i < rows; i++) {
        assert_true(u[i] >= 0);
        sum += u[i];
        bound -= u[i] * h[i];
        lower[i] = h[i] + level - 1e-8;
    }
    assert_int_equal(least_distance((size_t)rows, (size_t)size, G, lower, x), least_distance_found);
    if (sum == 0) {
        assert_true(level == most);
        return;
    }
    assert_true(fabs(sum - 1) < rounding && fabs(bound - level) < 1e-9);
    for (int k = 0; k < size; k++) {
        double product = 0;
        for (int i = 0; i < rows; i++) product += u[i] * G[i * size + k];
        assert_true(fabs(product) < 1e-9);
    }
}

/* Small whole numbers: many limits are reached at once, and many depend on each other. */
static void greatest_levels_have_multipliers_that_prove_it(void **unused)
{
    (void)unused;
    enum { most_rows = 60, most_size = 15, trials = 2000 };
    struct random_numbers numbers = {20261128};
    for (int trial = 0; trial < trials; trial++) {
        double G[most_rows * most_size], h[most_rows];
        bool whole = random_chance(&numbers, 0.5);
        int size = 1 + (int)random_between(&numbers, 0, most_size),
            rows = 1 + (int)random_between(&numbers, 0, most_rows);
        double few = random_between(&numbers, 0.1, 1);
        for (int i = 0; i < rows; i++) {
            h[i] = random_between(&numbers, -3, 3);
            if (whole) h[i] = round(h[i]);
            for (int k = 0; k < size; k++) {
                G[i * size + k] = random_perhaps(&numbers, few, -2, 2);
                if (whole) G[i * size + k] = round(G[i * size + k]);
            }
        }
        assert_greatest(rows, size, G, h, random_between(&numbers, 3, 20));
    }
}

static int no_handler(void **unused)
{
    (void)unused;
    gsl_set_error_handler_off();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_origin_is_nearest_where_it_is_inside),
        cmocka_unit_test(a_half_plane_has_the_foot_of_the_perpendicular),
        cmocka_unit_test(a_wedge_has_its_tip),
        cmocka_unit_test(inequalities_that_contradict_each_other_are_said),
        cmocka_unit_test(random_polyhedra_have_no_nearer_point),
        cmocka_unit_test(a_level_rises_to_the_middle_between_opposite_limits),
        cmocka_unit_test(greatest_levels_have_multipliers_that_prove_it),
    };
    return cmocka_run_group_tests(tests, no_handler, NULL);
}
