/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The Dormand-Prince step type: coefficients, measured orders, use with GSL's own control, failures.
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

#include "integrate/dop853.h"
#include "integrate/dop853_table.h"

enum { size = 2 };

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

static void every_row_sums_to_its_node(void **state)
{
    (void)state;
    for (int i = 2; i <= dop853_stages; i++) {
        double sum = 0, magnitude = 0;
        for (int j = 1; j < i; j++) {
            sum += dop853_a[i][j];
            magnitude += fabs(dop853_a[i][j]);
        }
        /* Each of up to 12 numbers is rounded, and each addition. */
        assert_true(fabs(sum - dop853_c[i]) <= 12 * DBL_EPSILON * magnitude);
        for (int j = i; j <= dop853_stages; j++) assert_true(dop853_a[i][j] == 0);
    }
}

/* sum w_i c_i^(k-1) over stages 1 to 12, and the magnitude of its terms. */
static double moment(const double *w, int k, double *magnitude)
{
    double sum = 0;
    *magnitude = 0;
    for (int i = 1; i <= 12; i++) {
        double term = w[i] * pow(dop853_c[i], k - 1);
        sum += term;
        *magnitude += fabs(term);
    }
    return sum;
}

static void weights_integrate_polynomials_as_their_order_says(void **state)
{
    (void)state;
    const struct {
        const double *w;
        int order;     /* highest k for which the sum is `share` / k */
        double share;  /* 1 for the formula, 0 for differences of formulas */
        double beyond; /* the next one misses by more than this */
    } rows[] = {{dop853_a[13], 8, 1, 1e-5}, {dop853_e5, 5, 0, 1e-4}, {dop853_e3, 3, 0, 1e-2}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        double magnitude;
        for (int k = 1; k <= rows[r].order; k++) {
            double sum = moment(rows[r].w, k, &magnitude);
            assert_true(fabs(sum - rows[r].share / k) <= 12 * DBL_EPSILON * magnitude);
        }
        int next = rows[r].order + 1;
        assert_true(fabs(moment(rows[r].w, next, &magnitude) - rows[r].share / next) > rows[r].beyond);
    }
}

/* Local errors of a step of size h from t = 0.3: of y1, of the interpolant within, and the estimate. */
static void local_errors(double h, double *step_error, double *dense_error, double *estimate)
{
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_dop853, size);
    double t = 0.3, y[size], yerr[size], f0[size], f1[size], z[size], zero[size] = {0};
    exact(t, y);
    rhs(t, y, f0, &problem);
    assert_int_equal(gsl_odeiv2_step_apply(step, t, h, y, yerr, f0, f1, &sys), GSL_SUCCESS);
    exact(t + h, z);
    *step_error = distance(y, z);
    *estimate = distance(yerr, zero);
    assert_int_equal(dop853_dense_prepare(step, &sys), GSL_SUCCESS);
    *dense_error = 0;
    for (int i = 1; i < 40; i++) {
        double theta = i / 40.0, dense[size];
        exact(t + theta * h, z);
        dop853_dense_eval(step, theta, dense);
        *dense_error = fmax(*dense_error, distance(dense, z));
    }
    gsl_odeiv2_step_free(step);
}

/* The expected powers are 9, 8 and 8. The leading term of an error changes with h, so measured slopes lie
 * around them; a method of one order less would be off by 1. */
static void local_errors_fall_with_their_orders(void **state)
{
    (void)state;
    double step[2], dense[2], estimate[2];
    local_errors(0.8, &step[0], &dense[0], &estimate[0]);
    local_errors(0.2, &step[1], &dense[1], &estimate[1]);
    double step_slope = log2(step[0] / step[1]) / 2, dense_slope = log2(dense[0] / dense[1]) / 2;
    double estimate_slope = log2(estimate[0] / estimate[1]) / 2;
    print_message("# slopes: step %.2f, dense output %.2f, estimate %.2f\n", step_slope, dense_slope,
                  estimate_slope);
    assert_true(step_slope > 8.5);
    assert_true(fabs(dense_slope - 8) < 0.6);
    assert_true(fabs(estimate_slope - 8) < 0.6);
    assert_true(estimate[1] > step[1]);
}

/* Largest error of y1 at the ends of `steps` equal steps over 0 <= t <= 10. */
static double global_error(int steps)
{
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_dop853, size);
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
    double slope = log2(global_error(32) / global_error(64));
    print_message("# global slope %.2f\n", slope);
    assert_true(fabs(slope - 8) < 0.5);
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
    for (size_t c = 0; c < sizeof codes / sizeof *codes; c++) {
        for (long at = 1; at <= 12; at++) {
            if (codes[c] == GSL_SUCCESS && at == 12) continue; /* f(t + h, y1) is not part of y1 */
            struct problem problem = {.fail_at = at, .code = codes[c]};
            gsl_odeiv2_system sys = system_of(&problem);
            gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_dop853, size);
            const double y0[size] = {0.1, 1 / 3.0}, f0[size] = {0, 1 / 3.0};
            double y[size], yerr[size], f1[size];
            memcpy(y, y0, sizeof y);
            int expected = codes[c] == GSL_SUCCESS ? GSL_FAILURE : codes[c];
            assert_int_equal(gsl_odeiv2_step_apply(step, 0, 0.1, y, yerr, f0, f1, &sys), expected);
            assert_memory_equal(y, y0, sizeof y);
            assert_int_equal(dop853_dense_prepare(step, &sys), GSL_EINVAL);
            gsl_odeiv2_step_free(step);
        }
    }
}

static void it_serves_gsl_driver_and_control(void **state)
{
    (void)state;
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&sys, step_dop853, 1e-3, 1e-11, 0);
    double t = 0, y[size], z[size];
    exact(0, y);
    for (int i = 1; i <= 10; i++) {
        assert_int_equal(gsl_odeiv2_driver_apply(driver, &t, i, y), GSL_SUCCESS);
        exact(i, z);
        assert_true(distance(y, z) < 1e-9); /* 1e-11 for each of about 40 steps, little of which dies out */
    }
    assert_true(problem.calls < 3000); /* rk8pd takes 1700 for these ten outputs */
    gsl_odeiv2_driver_free(driver);
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
    for (int n = 2; n <= 9; n++) {
        gsl_odeiv2_system sys = {.function = linear, .dimension = (size_t)n, .params = &n};
        gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_dop853, (size_t)n);
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
        cmocka_unit_test(weights_integrate_polynomials_as_their_order_says),
        cmocka_unit_test(local_errors_fall_with_their_orders),
        cmocka_unit_test(the_order_is_8),
        cmocka_unit_test(dense_output_meets_the_ends_with_their_slopes),
        cmocka_unit_test(slopes_that_are_not_given_or_asked_for_change_no_bit),
        cmocka_unit_test(dense_output_is_refused_without_a_step_of_this_type),
        cmocka_unit_test(a_failure_leaves_y_bit_for_bit_as_it_was),
        cmocka_unit_test(it_serves_gsl_driver_and_control),
        cmocka_unit_test(components_do_not_depend_on_how_many_there_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
