/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The explicit pairs of order 8: conditions of their coefficients, measured orders, use with GSL's own control,
 * failures.
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

#include "integrate/dop853_table.h"
#include "integrate/pair8.h"
#include "integrate/rk8pd_table.h"

enum { size = 2, pairs = 2 };

static const gsl_odeiv2_step_type *const *const types[pairs] = {&step_dop853, &step_rk8pd};

/* y0' = -2 t y0^2, y1' = y1 cos t: y0 = 1 / (1 + t^2), y1 = exp(sin t). Not linear, not autonomous. */
struct problem {
    long calls;
    long fail_at; /* number of the call that fails, from 1; 0: none */
    int code;     /* with this return code, or with a NaN if it is GSL_SUCCESS */
};

static int rhs(double t, const double y[], double f[], void *params)
{
    struct problem *problem = params;
    f[0] = -2 * t * y[0] * y[0];
    f[1] = y[1] * cos(t);
    if (++problem->calls != problem->fail_at) return GSL_SUCCESS;
    if (problem->code == GSL_SUCCESS) f[0] = NAN;
    return problem->code;
}

static void exact(double t, double y[size])
{
    y[0] = 1 / (1 + t * t);
    y[1] = exp(sin(t));
}

static double distance(const double a[size], const double b[size])
{
    return fmax(fabs(a[0] - b[0]), fabs(a[1] - b[1]));
}

static gsl_odeiv2_system system_of(struct problem *problem)
{
    return (gsl_odeiv2_system){.function = rhs, .dimension = size, .params = problem};
}

/* ---- conditions of order
 *
 * A formula of order p has sum_i w_i Phi_i(t) = 1/gamma(t) for all rooted trees t of p nodes at most (HNW I, II.2). A tree
 * is one of fewer nodes with one more branch at its root; each comes up once if branches are added in the order of
 * their numbers. Phi of t with the branch u is Phi(t) times A Phi(u), and 1/gamma is a product alike.
 */
enum { stage_count = 14, most_order = 9, most_trees = 600 };

struct tree {
    int order, last;                            /* number of its last branch */
    double weight;                              /* gamma / order: of its branches */
    double phi[stage_count], size[stage_count]; /* by stage, from 1; and what its roundings are counted by */
};

static struct tree trees[most_trees];

/* All trees up to `order`; returns their number. */
static int grow(const double (*a)[dop853_stages + 1], int order)
{
    int count = 1;
    trees[0] = (struct tree){.order = 1, .last = 0, .weight = 1};
    for (int i = 1; i < stage_count; i++) trees[0].phi[i] = trees[0].size[i] = 1;
    for (int n = 2; n <= order; n++)
        for (int t = 0, known = count; t < known; t++)
            for (int u = trees[t].last; u < known; u++) {
                if (trees[t].order + trees[u].order != n) continue;
                assert_true(count < most_trees);
                struct tree *tree = &trees[count++];
                *tree = (struct tree){.order = n, .last = u};
                tree->weight = trees[t].weight * trees[u].weight * trees[u].order;
                for (int i = 1; i < stage_count; i++) {
                    double sum = 0, size_of_sum = 0;
                    for (int j = 1; j < i; j++) {
                        sum += a[i][j] * trees[u].phi[j];
                        size_of_sum += fabs(a[i][j]) * trees[u].size[j];
                    }
                    tree->phi[i] = trees[t].phi[i] * sum;
                    tree->size[i] = trees[t].size[i] * size_of_sum;
                }
            }
    return count;
}

/* How many trees of this order are not met by `share` of the weights w. */
static int missed(const double *w, double share, int order, int count)
{
    int misses = 0;
    for (int k = 0; k < count; k++) {
        if (trees[k].order != order) continue;
        double sum = 0, magnitude = 0;
        for (int i = 1; i < stage_count; i++) {
            sum += w[i] * trees[k].phi[i];
            magnitude += fabs(w[i]) * trees[k].size[i];
        }
        misses += fabs(sum - share / (trees[k].weight * order)) > 64 * DBL_EPSILON * magnitude;
    }
    return misses;
}

static void formulas_meet_the_conditions_of_all_trees_of_their_order(void **state)
{
    (void)state;
    static const struct {
        const double (*a)[dop853_stages + 1];
        const double *w;
        int order;
        double share; /* 1 for the formula, 0 for differences of formulas */
    } rows[] = {{dop853_a, dop853_a[13], 8, 1},
                {dop853_a, dop853_e5, 5, 0},
                {dop853_a, dop853_e3, 3, 0},
                {rk8pd_a, rk8pd_a[14], 8, 1},
                {rk8pd_a, rk8pd_e7, 7, 0}};
    static const int trees_of[most_order + 1] = {0, 1, 1, 2, 4, 9, 20, 48, 115, 286};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        int count = grow(rows[r].a, most_order), all = 0;
        for (int n = 1; n <= most_order; n++) all += trees_of[n];
        assert_int_equal(count, all);
        for (int n = 1; n <= rows[r].order; n++)
            assert_int_equal(missed(rows[r].w, rows[r].share, n, count), 0);
        assert_true(missed(rows[r].w, rows[r].share, rows[r].order + 1, count) > 0);
    }
}

static void every_row_sums_to_its_node(void **state)
{
    (void)state;
    for (int p = 0; p < pairs; p++)
        for (int i = 2; i <= (p == 0 ? dop853_stages : 14); i++) {
            const double *row = p == 0 ? dop853_a[i] : rk8pd_a[i];
            double sum = 0, magnitude = 0;
            for (int j = 1; j < i; j++) {
                sum += row[j];
                magnitude += fabs(row[j]);
            }
            /* Each of up to 12 numbers is rounded, and each addition. */
            assert_true(fabs(sum - (p == 0 ? dop853_c : rk8pd_c)[i]) <= 12 * DBL_EPSILON * magnitude);
            for (int j = i; j <= dop853_stages; j++) assert_true(row[j] == 0);
        }
}

/* ---- steps */

/* Local errors of a step of size h from t = 0.3: of y1, of the interpolant within, and the estimate. */
static void local_errors(int pair, double h, double *step_error, double *dense_error, double *estimate)
{
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(*types[pair], size);
    double t = 0.3, y[size], yerr[size], f0[size], f1[size], z[size], zero[size] = {0};
    exact(t, y);
    rhs(t, y, f0, &problem);
    assert_int_equal(gsl_odeiv2_step_apply(step, t, h, y, yerr, f0, f1, &sys), GSL_SUCCESS);
    exact(t + h, z);
    *step_error = distance(y, z);
    *estimate = distance(yerr, zero);
    *dense_error = 0;
    assert_int_equal(dop853_dense_prepare(step, &sys), pair == 0 ? GSL_SUCCESS : GSL_EINVAL);
    for (int i = 1; pair == 0 && i < 40; i++) {
        double theta = i / 40.0, dense[size];
        exact(t + theta * h, z);
        dop853_dense_eval(step, theta, dense);
        *dense_error = fmax(*dense_error, distance(dense, z));
    }
    gsl_odeiv2_step_free(step);
}

/* The expected powers are 9, 8 and 8. The leading term of an error changes with h, so measured slopes lie
 * around them; a method of one order less would be off by 1. rk8pd has no dense output of its own. */
static void local_errors_fall_with_their_orders(void **state)
{
    (void)state;
    for (int pair = 0; pair < pairs; pair++) {
        double step[2], dense[2], estimate[2];
        local_errors(pair, 0.8, &step[0], &dense[0], &estimate[0]);
        local_errors(pair, 0.2, &step[1], &dense[1], &estimate[1]);
        double step_slope = log2(step[0] / step[1]) / 2, estimate_slope = log2(estimate[0] / estimate[1]) / 2;
        print_message("# %s: slopes: step %.2f, estimate %.2f\n", (*types[pair])->name, step_slope,
                      estimate_slope);
        assert_true(step_slope > 8.5);
        assert_true(fabs(estimate_slope - 8) < 0.6);
        assert_true(estimate[1] > step[1]);
        if (pair == 0) assert_true(fabs(log2(dense[0] / dense[1]) / 2 - 8) < 0.6);
    }
}

/* Largest error of y1 at the ends of `steps` equal steps over 0 <= t <= 10. */
static double global_error(int pair, int steps)
{
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(*types[pair], size);
    double y[size], z[size], yerr[size], h = 10.0 / steps, worst = 0;
    exact(0, y);
    for (int i = 0; i < steps; i++) {
        assert_int_equal(gsl_odeiv2_step_apply(step, i * h, h, y, yerr, NULL, NULL, &sys), GSL_SUCCESS);
        exact((i + 1) * h, z);
        worst = fmax(worst, fabs(y[1] - z[1]));
    }
    gsl_odeiv2_step_free(step);
    return worst;
}

/* On exp(sin t), which has no singularity near the real axis (1 / (1 + t^2) shows its order for smaller h
 * only). */
static void the_order_is_8(void **state)
{
    (void)state;
    for (int pair = 0; pair < pairs; pair++) {
        double slope = log2(global_error(pair, 32) / global_error(pair, 64));
        print_message("# %s: global slope %.2f\n", (*types[pair])->name, slope);
        assert_true(fabs(slope - 8) < 0.5);
    }
}

static void dense_output_meets_the_ends_with_their_slopes(void **state)
{
    (void)state;
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_dop853, size);
    double y0[size], y[size], yerr[size], f0[size], f1[size], z[size], h = 0.25, d = 1e-5;
    exact(0.3, y0);
    memcpy(y, y0, sizeof y);
    rhs(0.3, y, f0, &problem);
    gsl_odeiv2_step_apply(step, 0.3, h, y, yerr, f0, f1, &sys);
    dop853_dense_prepare(step, &sys);
    dop853_dense_eval(step, 0, z);
    assert_memory_equal(z, y0, sizeof z);
    dop853_dense_eval(step, 1, z);
    assert_true(distance(z, y) <= 2 * DBL_EPSILON); /* y0 + (y1 - y0) */
    for (int i = 0; i < size; i++) {
        double ahead[size], behind[size];
        dop853_dense_eval(step, d, ahead);
        dop853_dense_eval(step, 1 - d, behind);
        /* One-sided differences err by d h y'' / 2 < 1e-5. */
        assert_true(fabs((ahead[i] - y0[i]) / (d * h) - f0[i]) < 1e-5);
        assert_true(fabs((y[i] - behind[i]) / (d * h) - f1[i]) < 1e-5);
    }
    gsl_odeiv2_step_free(step);
}

static void slopes_that_are_not_given_or_asked_for_change_no_bit(void **state)
{
    (void)state;
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *with = gsl_odeiv2_step_alloc(step_dop853, size);
    gsl_odeiv2_step *without = gsl_odeiv2_step_alloc(step_dop853, size);
    double y[size], z[size], yerr[size], zerr[size], f0[size], f1[size];
    exact(0.3, y);
    exact(0.3, z);
    rhs(0.3, y, f0, &problem);
    problem.calls = 0;
    gsl_odeiv2_step_apply(with, 0.3, 0.5, y, yerr, f0, f1, &sys);
    assert_int_equal(problem.calls, 12);
    gsl_odeiv2_step_apply(without, 0.3, 0.5, z, zerr, NULL, NULL, &sys);
    assert_memory_equal(y, z, sizeof y);
    assert_memory_equal(yerr, zerr, sizeof yerr);
    problem.calls = 0;
    assert_int_equal(dop853_dense_prepare(with, &sys), GSL_SUCCESS);
    assert_int_equal(problem.calls, 3);
    assert_int_equal(dop853_dense_prepare(with, &sys), GSL_SUCCESS);
    assert_int_equal(problem.calls, 3);
    assert_int_equal(dop853_dense_prepare(without, &sys), GSL_SUCCESS);
    assert_int_equal(problem.calls, 7);
    dop853_dense_eval(with, 0.4, y);
    dop853_dense_eval(without, 0.4, z);
    assert_memory_equal(y, z, sizeof y);
    gsl_odeiv2_step_free(with);
    gsl_odeiv2_step_free(without);
}

static void dense_output_is_refused_without_a_step_of_this_type(void **state)
{
    (void)state;
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_dop853, size);
    gsl_odeiv2_step *other = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk4, size);
    double y[size] = {1, 1}, yerr[size];
    assert_int_equal(dop853_dense_prepare(step, &sys), GSL_EINVAL);
    gsl_odeiv2_step_apply(step, 0, 0.1, y, yerr, NULL, NULL, &sys);
    assert_int_equal(dop853_dense_prepare(step, &sys), GSL_SUCCESS);
    gsl_odeiv2_step_reset(step);
    assert_int_equal(dop853_dense_prepare(step, &sys), GSL_EINVAL);
    assert_int_equal(dop853_dense_prepare(other, &sys), GSL_EINVAL);
    gsl_odeiv2_step_free(step);
    gsl_odeiv2_step_free(other);
}

static void a_failure_leaves_y_bit_for_bit_as_it_was(void **state)
{
    (void)state;
    const int codes[] = {GSL_EBADFUNC, GSL_EDOM, 77, GSL_SUCCESS /* a NaN */};
    for (size_t c = 0; c < pairs * sizeof codes / sizeof *codes; c++) {
        const gsl_odeiv2_step_type *type = *types[c % pairs];
        int code = codes[c / pairs];
        const long calls = type == step_rk8pd ? 13 : 12;
        for (long at = 1; at <= calls; at++) {
            if (code == GSL_SUCCESS && at == calls) continue; /* f(t + h, y1) is not part of y1 */
            struct problem problem = {.fail_at = at, .code = code};
            gsl_odeiv2_system sys = system_of(&problem);
            gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(type, size);
            const double y0[size] = {0.1, 1 / 3.0}, f0[size] = {0, 1 / 3.0};
            double y[size], yerr[size], f1[size];
            memcpy(y, y0, sizeof y);
            int expected = code == GSL_SUCCESS ? GSL_FAILURE : code;
            assert_int_equal(gsl_odeiv2_step_apply(step, 0, 0.1, y, yerr, f0, f1, &sys), expected);
            assert_memory_equal(y, y0, sizeof y);
            assert_int_equal(dop853_dense_prepare(step, &sys), GSL_EINVAL);
            gsl_odeiv2_step_free(step);
        }
    }
}

static void they_serve_gsl_driver_and_control(void **state)
{
    (void)state;
    for (int pair = 0; pair < pairs; pair++) {
        struct problem problem = {0};
        gsl_odeiv2_system sys = system_of(&problem);
        gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&sys, *types[pair], 1e-3, 1e-11, 0);
        double t = 0, y[size], z[size];
        exact(0, y);
        for (int i = 1; i <= 10; i++) {
            assert_int_equal(gsl_odeiv2_driver_apply(driver, &t, i, y), GSL_SUCCESS);
            exact(i, z);
            assert_true(distance(y, z) <
                        1e-9); /* 1e-11 for each of about 40 steps, little of which dies out */
        }
        assert_true(problem.calls < 3000); /* rk8pd takes 1700 for these ten outputs */
        gsl_odeiv2_driver_free(driver);
    }
}

static int linear(double t, const double y[], double f[], void *params)
{
    (void)t;
    const int *n = params;
    for (int i = 0; i < *n; i++) f[i] = -(1 + 0.1 * i) * y[i];
    return GSL_SUCCESS;
}

static void components_do_not_depend_on_how_many_there_are(void **state)
{
    (void)state;
    double alone[2], yerr[9];
    for (int k = 0; k < 8 * pairs; k++) {
        int n = 2 + k % 8;
        gsl_odeiv2_system sys = {.function = linear, .dimension = (size_t)n, .params = &n};
        gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(*types[k / 8], (size_t)n);
        double y[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
        assert_int_equal(gsl_odeiv2_step_apply(step, 0, 0.3, y, yerr, NULL, NULL, &sys), GSL_SUCCESS);
        if (n == 2) memcpy(alone, y, sizeof alone);
        assert_memory_equal(y, alone, sizeof alone);
        /* Local error: (0.3 (1 + 0.8))^9 / 9! = 1e-8 times an error constant well below 1. */
        for (int i = 0; i < n; i++) assert_true(fabs(y[i] - exp(-0.3 * (1 + 0.1 * i))) < 1e-9);
        gsl_odeiv2_step_free(step);
    }
}

static int constant_slope(double t, const double y[], double dydt[], void *params)
{
    (void)t, (void)y, (void)params;
    dydt[0] = 1;
    return GSL_SUCCESS;
}

/* 1e5 steps of 0.3 roundings of y each: y would stay where it is. Every other one is thrown away and tried
 * again. */
static void what_rounding_takes_is_given_back(void **state)
{
    (void)state;
    enum { steps = 100000 };
    const double unit = 0x1p-52, h = 0.3 * unit;
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_dop853, 1);
    gsl_odeiv2_system system = {constant_slope, NULL, 1, NULL};
    double y = 1, error, slope = 1, t = 0;
    for (int k = 0; k < steps; k++) {
        double before = y;
        if (k % 2)
            assert_int_equal(gsl_odeiv2_step_apply(step, t, 2 * h, &y, &error, &slope, &slope, &system), 0);
        y = before;
        assert_int_equal(gsl_odeiv2_step_apply(step, t, h, &y, &error, &slope, &slope, &system), 0);
        t += h;
    }
    assert_true(fabs((y - 1) / unit - 0.3 * steps) <= 1);
    /* Two states that are not its own: nothing is added to them. */
    y = 2;
    assert_int_equal(gsl_odeiv2_step_apply(step, t, h, &y, &error, &slope, &slope, &system), 0);
    assert_true(y == 2);
    gsl_odeiv2_step_reset(step);
    assert_int_equal(gsl_odeiv2_step_apply(step, t, h, &y, &error, &slope, &slope, &system), 0);
    assert_true(y == 2);
    gsl_odeiv2_step_free(step);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_rounding_takes_is_given_back),
        cmocka_unit_test(every_row_sums_to_its_node),
        cmocka_unit_test(formulas_meet_the_conditions_of_all_trees_of_their_order),
        cmocka_unit_test(local_errors_fall_with_their_orders),
        cmocka_unit_test(the_order_is_8),
        cmocka_unit_test(dense_output_meets_the_ends_with_their_slopes),
        cmocka_unit_test(slopes_that_are_not_given_or_asked_for_change_no_bit),
        cmocka_unit_test(dense_output_is_refused_without_a_step_of_this_type),
        cmocka_unit_test(a_failure_leaves_y_bit_for_bit_as_it_was),
        cmocka_unit_test(they_serve_gsl_driver_and_control),
        cmocka_unit_test(components_do_not_depend_on_how_many_there_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
