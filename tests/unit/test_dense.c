/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dense output: measured orders for the order of each method, exact ends, laziness, failures, very short
 * steps; and the polynomial through the last points.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "integrate/dense.h"
#include "integrate/dense_by_resteps.h"
#include "integrate/history.h"
#include "integrate/linear.h"
#include "integrate/method.h"
#include "integrate/pair8.h"
#include "integrate/parabola.h"

enum { size = 3 };

/* The solution is chosen, q = sin 2t + t^2 / 10 and x = q^2 / 2 - 1, and the right-hand side built around
 * it: with e the deviations from it, q'' = exact - e_q - e_v - e_v^3 and x' = v q + e_x, which depends on
 * its own state. */
struct problem {
    long calls;
    int code; /* returned when not zero */
};

static double q_of(double t)
{
    return sin(2 * t) + t * t / 10;
}

static double v_of(double t)
{
    return 2 * cos(2 * t) + t / 5;
}

/* x = q^2 / 2 - 1 has x' = q v. */
static double x_of(double t)
{
    return q_of(t) * q_of(t) / 2 - 1;
}

static void exact(double t, double y[size])
{
    y[0] = q_of(t);
    y[1] = v_of(t);
    y[2] = x_of(t);
}

static int rhs(double t, const double y[], double f[], void *params)
{
    struct problem *problem = params;
    problem->calls++;
    if (problem->code != GSL_SUCCESS) return problem->code;
    double e_q = y[0] - q_of(t), e_v = y[1] - v_of(t);
    f[0] = y[1];
    f[1] = -4 * sin(2 * t) + 0.2 - e_q - e_v - e_v * e_v * e_v;
    f[2] = y[1] * y[0] + (y[2] - x_of(t));
    return GSL_SUCCESS;
}

/* Largest errors of q, v, x inside of a step from t = 0.4 with exact ends. */
static void errors(struct layout layout, int order, double h, double worst[size])
{
    struct problem problem = {0};
    gsl_odeiv2_system sys = {.function = rhs, .dimension = size, .params = &problem};
    double t0 = 0.4, y0[size], y1[size], f0[size], f1[size], y[size], z[size];
    exact(t0, y0);
    exact(t0 + h, y1);
    rhs(t0, y0, f0, &problem);
    rhs(t0 + h, y1, f1, &problem);
    struct dense *dense = dense_alloc(&layout);
    dense_set(dense, order, time_dd_at(t0), y0, f0, time_dd_at(t0 + h), y1, f1, &sys, NULL);
    for (int i = 0; i < size; i++) worst[i] = 0;
    for (int k = 1; k < 64; k++) {
        double t = t0 + h * k / 64;
        assert_int_equal(dense_eval(dense, time_dd_at(t), y), GSL_SUCCESS);
        exact(t, z);
        for (int i = 0; i < size; i++) worst[i] = fmax(worst[i], fabs(y[i] - z[i]));
    }
    dense_free(dense);
}

/* Slopes between h and h/2 may differ from the power of h by 0.5, as the next term has its share; an order
 * too low differs by 1. A slope that is too high is no fault. */
static void expect_powers(const char *what, struct layout layout, int order, double h,
                          const double power[size])
{
    double coarse[size], fine[size];
    errors(layout, order, h, coarse);
    errors(layout, order, h / 2, fine);
    print_message("# %s, order %d: slopes %.2f %.2f %.2f for powers %g %g %g\n", what, order,
                  log2(coarse[0] / fine[0]), log2(coarse[1] / fine[1]), log2(coarse[2] / fine[2]), power[0],
                  power[1], power[2]);
    for (int i = 0; i < size; i++) assert_true(log2(coarse[i] / fine[i]) > power[i] - 0.5);
}

static void pairs_gain_from_their_structure(void **state)
{
    (void)state;
    const struct layout layout = {.pairs = 1, .extra = 1};
    for (int order = 1; order <= 4; order++)
        expect_powers("level 0", layout, order, 0.25, (const double[]){6, 5, 4});
    for (int order = 5; order <= 12; order++)
        expect_powers("level 2", layout, order, 0.5, (const double[]){9, 8, 5});
}

static void systems_without_pairs_are_served_too(void **state)
{
    (void)state;
    const struct layout layout = {.extra = size};
    expect_powers("general, level 0", layout, 4, 0.2, (const double[]){4, 4, 4});
    expect_powers("general, level 1", layout, 5, 0.2, (const double[]){5, 5, 5});
    expect_powers("general, level 2", layout, 8, 0.2, (const double[]){6, 6, 6});
}

/* q'' = -sin q - 0.3 v^2 by level, against 20 steps of rk8pd over the same time. */
static int swing(double t, const double y[], double f[], void *params)
{
    (void)t;
    (*(long *)params)++;
    f[0] = y[1];
    f[1] = -sin(y[0]) - 0.3 * y[1] * y[1];
    return GSL_SUCCESS;
}

static void reference(double t, const gsl_odeiv2_system *sys, double y[2])
{
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 2);
    double yerr[2];
    y[0] = 1;
    y[1] = 0.7;
    for (int i = 0; i < 20; i++) gsl_odeiv2_step_apply(step, i * t / 20, t / 20, y, yerr, NULL, NULL, sys);
    gsl_odeiv2_step_free(step);
}

static void swing_errors(int order, double h, double worst[2], long *calls)
{
    long count = 0;
    const struct layout layout = {.pairs = 1};
    gsl_odeiv2_system sys = {.function = swing, .dimension = 2, .params = &count};
    double y0[2] = {1, 0.7}, y1[2], f0[2], f1[2], y[2], z[2];
    reference(h, &sys, y1);
    swing(0, y0, f0, &count);
    swing(h, y1, f1, &count);
    struct dense *dense = dense_alloc(&layout);
    dense_set(dense, order, time_dd_at(0), y0, f0, time_dd_at(h), y1, f1, &sys, NULL);
    count = 0;
    assert_int_equal(dense_eval(dense, time_dd_at(h / 2), y), GSL_SUCCESS);
    *calls = count;
    worst[0] = worst[1] = 0;
    for (int k = 1; k < 32; k++) {
        dense_eval(dense, time_dd_at(h * k / 32), y);
        reference(h * k / 32, &sys, z);
        for (int i = 0; i < 2; i++) worst[i] = fmax(worst[i], fabs(y[i] - z[i]));
    }
    dense_free(dense);
}

static void every_level_has_its_order_and_cost(void **state)
{
    (void)state;
    const struct {
        int order, q, v;
        long calls;
    } levels[] = {{4, 6, 5, 0}, {5, 7, 6, 1}, {8, 9, 8, 4}};
    for (size_t i = 0; i < 3; i++) {
        double coarse[2], fine[2];
        long calls;
        swing_errors(levels[i].order, 0.8, coarse, &calls);
        swing_errors(levels[i].order, 0.4, fine, &calls);
        double q = log2(coarse[0] / fine[0]), v = log2(coarse[1] / fine[1]);
        print_message("# order %d: slopes %.2f %.2f for powers %d %d, %ld evaluations\n", levels[i].order, q,
                      v, levels[i].q, levels[i].v, calls);
        assert_int_equal(calls, levels[i].calls);
        assert_true(q > levels[i].q - 0.75 &&
                    v > levels[i].v - 0.75); /* h is large, for the errors to be seen */
    }
}

static void every_method_gets_a_level_of_its_order(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        int order = method_at(m)->order < 8 ? method_at(m)->order : 8;
        double coarse[2], fine[2];
        long calls;
        swing_errors(method_at(m)->order, 0.8, coarse, &calls);
        swing_errors(method_at(m)->order, 0.4, fine, &calls);
        assert_true(log2(coarse[0] / fine[0]) > order - 0.5);
        assert_true(log2(coarse[1] / fine[1]) > order - 0.75);
    }
}

static void the_ends_are_exact_and_cost_nothing(void **state)
{
    (void)state;
    const struct layout layout = {.pairs = 1, .extra = 1};
    struct problem problem = {0};
    gsl_odeiv2_system sys = {.function = rhs, .dimension = size, .params = &problem};
    const double y0[size] = {0.1, 1 / 3.0, 7}, y1[size] = {0.2, 1 / 7.0, 8}, f[size] = {1, 1, 1};
    double y[size];
    struct dense *dense = dense_alloc(&layout);
    for (int order = 1; order <= 8; order++) {
        dense_set(dense, order, time_dd_at(0.1), y0, f, time_dd_at(0.4), y1, f, &sys, NULL);
        assert_int_equal(dense_eval(dense, time_dd_at(0.1), y), GSL_SUCCESS);
        assert_memory_equal(y, y0, sizeof y);
        assert_int_equal(dense_eval(dense, time_dd_at(0.4), y), GSL_SUCCESS);
        assert_memory_equal(y, y1, sizeof y);
    }
    assert_int_equal(problem.calls, 0);
    assert_int_equal(dense_eval(dense, time_dd_at(0.2), y), GSL_SUCCESS);
    long once = problem.calls;
    assert_int_equal(dense_eval(dense, time_dd_at(0.3), y), GSL_SUCCESS);
    assert_int_equal(problem.calls, once);
    dense_free(dense);
}

static void a_failing_right_hand_side_is_reported(void **state)
{
    (void)state;
    const struct layout layout = {.pairs = 1, .extra = 1};
    struct problem problem = {.code = 33};
    gsl_odeiv2_system sys = {.function = rhs, .dimension = size, .params = &problem};
    const double y0[size] = {0}, f[size] = {0};
    double y[size] = {1, 2, 3};
    struct dense *dense = dense_alloc(&layout);
    dense_set(dense, 8, time_dd_at(0), y0, f, time_dd_at(1), y0, f, &sys, NULL);
    assert_int_equal(dense_eval(dense, time_dd_at(0.5), y), 33);
    assert_true(y[0] == 1 && y[1] == 2 && y[2] == 3);
    problem.code = GSL_SUCCESS;
    assert_int_equal(dense_eval(dense, time_dd_at(0.5), y), GSL_SUCCESS); /* tried again */
    dense_free(dense);
}

static void dop853_answers_by_itself(void **state)
{
    (void)state;
    const struct layout layout = {.pairs = 1, .extra = 1};
    struct problem problem = {0};
    gsl_odeiv2_system sys = {.function = rhs, .dimension = size, .params = &problem};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_dop853, size);
    double y0[size], y1[size], yerr[size], f0[size], f1[size], y[size], z[size];
    exact(0, y0);
    rhs(0, y0, f0, &problem);
    memcpy(y1, y0, sizeof y1);
    gsl_odeiv2_step_apply(step, 0, 0.2, y1, yerr, f0, f1, &sys);
    struct dense *dense = dense_alloc(&layout);
    dense_set(dense, 8, time_dd_at(0), y0, f0, time_dd_at(0.2), y1, f1, &sys, step);
    problem.calls = 0;
    assert_int_equal(dense_eval(dense, time_dd_at(0.05), y), GSL_SUCCESS);
    assert_int_equal(problem.calls, 3);
    dop853_dense_eval(step, 0.05 / 0.2, z);
    assert_memory_equal(y, z, sizeof y);
    dense_free(dense);
    gsl_odeiv2_step_free(step);
}

/* By powers of s over a piece of the step as by its time, to rounding. */
static void expect_same(struct dense *dense, struct time_dd from, struct time_dd to, int count)
{
    double c[dense_most_degree + 1], y[size];
    for (int i = 0; i < count; i++) {
        int degree = dense_powers(dense, from, to, (size_t)i, c);
        assert_true(degree >= 0 && degree <= dense_most_degree);
        for (int k = 0; k <= 16; k++) {
            double s = k / 8.0 - 1, sum = 0, terms = 0;
            assert_int_equal(dense_eval(dense, time_dd_at(from.t + (to.t - from.t) * (1 + s) / 2), y),
                             GSL_SUCCESS);
            for (int m = degree; m >= 0; m--) sum = c[m] + s * sum, terms += fabs(c[m]);
            assert_true(fabs(sum - y[i]) <= 16 * DBL_EPSILON * terms);
        }
    }
}

static int swings(double t, const double y[], double f[], void *params)
{
    (void)t;
    f[0] = y[1];
    f[1] = *(const double *)params - (*(const double *)params == 0) * 3 * y[0];
    return GSL_SUCCESS;
}

static int swings_by(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    (void)t, (void)y, (void)params;
    dfdy[0] = dfdy[3] = dfdt[0] = dfdt[1] = 0;
    dfdy[1] = 1;
    dfdy[2] = -3;
    return GSL_SUCCESS;
}

/* The methods that have a dense output of their own: an oscillator, or a constant acceleration. */
static void expect_same_of(const gsl_odeiv2_step_type *type, double a, double h)
{
    gsl_odeiv2_system sys = {swings, swings_by, 2, &a};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(type, 2);
    double y0[2] = {0.7, -1.3}, y1[2] = {0.7, -1.3}, yerr[2], f0[2], f1[2];
    swings(0, y0, f0, &a);
    assert_int_equal(gsl_odeiv2_step_apply(step, 0.4, h, y1, yerr, f0, f1, &sys), GSL_SUCCESS);
    const struct layout layout = {.pairs = 1};
    struct dense *dense = dense_alloc(&layout);
    dense_set(dense, 8, time_dd_at(0.4), y0, f0, time_dd_at(0.4 + h), y1, f1, &sys, step);
    expect_same(dense, time_dd_at(0.4), time_dd_at(0.4 + h), 2);
    expect_same(dense, time_dd_at(0.4 + 0.3 * h), time_dd_at(0.4 + 0.4 * h), 2);
    dense_free(dense);
    gsl_odeiv2_step_free(step);
}

static void powers_over_a_piece_are_the_same_polynomial(void **state)
{
    (void)state;
    const struct layout layout = {.pairs = 1, .extra = 1};
    const double t0 = 0.4, h = 0.25;
    for (int order = 1; order <= 8; order++) {
        struct problem problem = {0};
        gsl_odeiv2_system sys = {.function = rhs, .dimension = size, .params = &problem};
        double y0[size], y1[size], f0[size], f1[size];
        exact(t0, y0);
        exact(t0 + h, y1);
        y1[0] += 1e-3; /* not what the method would have: every term of the polynomials counts */
        rhs(t0, y0, f0, &problem);
        rhs(t0 + h, y1, f1, &problem);
        struct dense *dense = dense_alloc(&layout);
        dense_set(dense, order, time_dd_at(t0), y0, f0, time_dd_at(t0 + h), y1, f1, &sys, NULL);
        expect_same(dense, time_dd_at(t0), time_dd_at(t0 + h), size);
        expect_same(dense, time_dd_at(t0 + 0.6 * h), time_dd_at(t0 + 0.85 * h), size);
        dense_free(dense);
    }
    expect_same_of(step_dop853, 0, 0.8);
    expect_same_of(step_linear, 0, 0.001);
    expect_same_of(step_parabola, 2.5, 0.8);
}

/* A train 1e6 m away at 10 m/s, over steps so short that the rounding of q is larger than the way made: the
 * quartic of v would show eps q / h, 2e-4 m/s. */
static void rounding_of_a_large_coordinate_is_not_seen_in_the_velocity(void **state)
{
    (void)state;
    const struct layout layout = {.pairs = 1};
    const double h = 1e-6, a = 2;
    const double y0[2] = {1e6 + 0.1, 10}, y1[2] = {1e6 + 0.1 + h * 10, 10 + h * a};
    const double f0[2] = {10, a}, f1[2] = {10 + h * a, a};
    double y[2];
    struct dense *dense = dense_alloc(&layout);
    dense_set(dense, 4, time_dd_at(0), y0, f0, time_dd_at(h), y1, f1, NULL, NULL);
    for (int k = 1; k < 16; k++) {
        assert_int_equal(dense_eval(dense, time_dd_at(h * k / 16), y), GSL_SUCCESS);
        assert_true(fabs(y[1] - (10 + a * h * k / 16)) < 16 * DBL_EPSILON * 10);
        assert_true(fabs(y[0] - y0[0] - 10 * h * k / 16) < 2 * DBL_EPSILON * 1e6);
    }
    dense_free(dense);
}

static void a_step_back_in_time_is_a_step(void **state)
{
    (void)state;
    double forward[2], back[size];
    errors((struct layout){.pairs = 1, .extra = 1}, 8, -0.25, back);
    assert_true(back[0] < 1e-9 && back[1] < 1e-8);
    long calls;
    swing_errors(8, -0.4, forward, &calls);
    assert_true(forward[0] < 1e-10 && forward[1] < 1e-8);
}

/* y = 1 + s - s^3 in a step whose points are samples: also as near to an end as numbers are. */
static bool sample_of_a_cubic(void *unused, double share, double *y)
{
    (void)unused;
    *y = 1 + share - share * share * share;
    return true;
}

static double no_excess(void *unused, const double *deviation)
{
    (void)unused;
    (void)deviation;
    return 0;
}

static void a_step_has_a_state_beside_its_ends(void **state)
{
    static const double shares[] = {DBL_TRUE_MIN, DBL_MIN, 1e-30, 0.3, 1 - DBL_EPSILON, 1};
    const struct resteps_source source = {.sample = sample_of_a_cubic, .excess = no_excess};
    const double ends[] = {1, 1};
    struct resteps *inside = resteps_alloc(1);
    (void)state;
    assert_non_null(inside);
    resteps_set(inside, &ends[0], &ends[1]);
    for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
        double y, exactly;
        sample_of_a_cubic(NULL, shares[i], &exactly);
        assert_true(resteps_eval(inside, &source, shares[i], &y));
        assert_true(fabs(y - exactly) <= 8 * DBL_EPSILON);
    }
    resteps_free(inside);
}

static void the_last_points_give_polynomials_exactly(void **state)
{
    (void)state;
    struct history *history = history_alloc(2);
    history_clear(history);
    for (int k = -3; k <= 7; k++) {
        double t = k + 0.1 * k * k, y[2] = {t * t * t - 2 * t, 5};
        history_add(history, t, y);
    }
    double y[2], t = 10;
    history_eval(history, 3, t, y);
    assert_true(fabs(y[0] - 980) < 1e-11 &&
                fabs(y[1] - 5) < 1e-14); /* a few roundings of numbers like 1700 */
    history_eval(history, 5, t, y);
    assert_true(fabs(y[0] - 980) < 1e-11);
    history_clear(history);
    history_add(history, 1, (const double[]){4, -4});
    history_eval(history, 5, 7, y);
    assert_true(y[0] == 4 && y[1] == -4);
    history_add(history, 2, (const double[]){6, -6});
    history_eval(history, 5, 1.5, y);
    assert_true(y[0] == 5 && y[1] == -5);
    history_free(history);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_gain_from_their_structure),
        cmocka_unit_test(systems_without_pairs_are_served_too),
        cmocka_unit_test(every_level_has_its_order_and_cost),
        cmocka_unit_test(every_method_gets_a_level_of_its_order),
        cmocka_unit_test(the_ends_are_exact_and_cost_nothing),
        cmocka_unit_test(a_failing_right_hand_side_is_reported),
        cmocka_unit_test(dop853_answers_by_itself),
        cmocka_unit_test(powers_over_a_piece_are_the_same_polynomial),
        cmocka_unit_test(rounding_of_a_large_coordinate_is_not_seen_in_the_velocity),
        cmocka_unit_test(a_step_back_in_time_is_a_step),
        cmocka_unit_test(a_step_has_a_state_beside_its_ends),
        cmocka_unit_test(the_last_points_give_polynomials_exactly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
