/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The Rosenbrock step type: measured orders, stiff components, use with GSL's own control, failures.
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

#include "integrate/rodas5p.h"
#include "integrate/rodas5p_table.h"

enum { size = 2 };

enum trouble { no_trouble, in_rhs, in_jacobian, in_dfdt };

/* y0' = -2 t y0^2, y1' = y1 cos t: y0 = 1 / (1 + t^2), y1 = exp(sin t). Not linear, not autonomous. */
struct problem {
    long calls, jacobians;
    enum trouble trouble;
    long fail_at; /* number of the call of the right-hand side that fails, from 1 */
    int code;     /* with this return code, or with a NaN if it is GSL_SUCCESS */
};

static int rhs(double t, const double y[], double f[], void *params)
{
    struct problem *problem = params;
    f[0] = -2 * t * y[0] * y[0];
    f[1] = y[1] * cos(t);
    if (++problem->calls != problem->fail_at || problem->trouble != in_rhs) return GSL_SUCCESS;
    if (problem->code == GSL_SUCCESS) f[0] = NAN;
    return problem->code;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    struct problem *problem = params;
    dfdy[0] = -4 * t * y[0];
    dfdy[1] = dfdy[2] = 0;
    dfdy[3] = cos(t);
    dfdt[0] = -2 * y[0] * y[0];
    dfdt[1] = -y[1] * sin(t);
    problem->jacobians++;
    if (problem->trouble == in_jacobian && problem->code == GSL_SUCCESS) dfdy[3] = NAN;
    if (problem->trouble == in_dfdt && problem->code == GSL_SUCCESS) dfdt[1] = NAN;
    return problem->trouble >= in_jacobian ? problem->code : GSL_SUCCESS;
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
    return (gsl_odeiv2_system){rhs, jacobian, size, problem};
}

/* Local errors of a step of size h from t = 0.3: of y1, of the interpolant within, and the estimate. */
static void local_errors(double h, double *step_error, double *dense_error, double *estimate)
{
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, size);
    double t = 0.3, y[size], yerr[size], z[size], zero[size] = {0};
    exact(t, y);
    assert_int_equal(gsl_odeiv2_step_apply(step, t, h, y, yerr, NULL, NULL, &sys), GSL_SUCCESS);
    exact(t + h, z);
    *step_error = distance(y, z);
    *estimate = distance(yerr, zero);
    assert_int_equal(rodas5p_dense_prepare(step), GSL_SUCCESS);
    *dense_error = 0;
    for (int i = 1; i < 40; i++) {
        double theta = i / 40.0, dense[size];
        exact(t + theta * h, z);
        rodas5p_dense_eval(step, theta, dense);
        *dense_error = fmax(*dense_error, distance(dense, z));
    }
    gsl_odeiv2_step_free(step);
}

/* The leading term of an error changes with h, so measured slopes lie around the expected powers; a method of
 * one order less would be off by 1. */
static void local_errors_fall_with_their_orders(void **state)
{
    (void)state;
    double step[2], dense[2], estimate[2];
    local_errors(0.04, &step[0], &dense[0], &estimate[0]);
    local_errors(0.01, &step[1], &dense[1], &estimate[1]);
    double step_slope = log2(step[0] / step[1]) / 2, dense_slope = log2(dense[0] / dense[1]) / 2;
    double estimate_slope = log2(estimate[0] / estimate[1]) / 2;
    print_message("# slopes: step %.2f, dense output %.2f, estimate %.2f\n", step_slope, dense_slope,
                  estimate_slope);
    assert_true(fabs(step_slope - 6) < 0.4);
    assert_true(fabs(dense_slope - 5) < 0.4);
    assert_true(fabs(estimate_slope - 5) < 0.4);
    assert_true(estimate[1] > step[1]);
}

/* Largest error of y at the ends of `steps` equal steps over 0 <= t <= 10. */
static double global_error(int steps)
{
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, size);
    double y[size], z[size], yerr[size], h = 10.0 / steps, worst = 0;
    exact(0, y);
    for (int i = 0; i < steps; i++) {
        assert_int_equal(gsl_odeiv2_step_apply(step, i * h, h, y, yerr, NULL, NULL, &sys), GSL_SUCCESS);
        exact((i + 1) * h, z);
        worst = fmax(worst, distance(y, z));
    }
    gsl_odeiv2_step_free(step);
    return worst;
}

static void the_order_is_5(void **state)
{
    (void)state;
    double slope = log2(global_error(160) / global_error(320));
    print_message("# global slope %.2f\n", slope);
    assert_true(fabs(slope - 5) < 0.4);
}

/* y' = lambda (y - cos t) - sin t, with the solution cos t, which all others join at the rate lambda
 * (Prothero and Robinson). With lambda = 0 it is a quadrature, y' = -sin t. */
static int forced(double t, const double y[], double f[], void *params)
{
    double lambda = *(double *)params;
    f[0] = lambda * (y[0] - cos(t)) - sin(t);
    return GSL_SUCCESS;
}

static int forced_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    double lambda = *(double *)params;
    (void)y;
    dfdy[0] = lambda;
    dfdt[0] = lambda * sin(t) - cos(t);
    return GSL_SUCCESS;
}

struct forced_errors {
    double end, dense, estimate; /* largest ones over 0 <= t <= 2 */
};

static struct forced_errors follow(double lambda, int steps)
{
    gsl_odeiv2_system sys = {forced, forced_jacobian, 1, &lambda};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, 1);
    double y = 1, yerr, z, h = 2.0 / steps;
    struct forced_errors worst = {0};
    for (int i = 0; i < steps; i++) {
        assert_int_equal(gsl_odeiv2_step_apply(step, i * h, h, &y, &yerr, NULL, NULL, &sys), GSL_SUCCESS);
        worst.end = fmax(worst.end, fabs(y - cos((i + 1) * h)));
        worst.estimate = fmax(worst.estimate, fabs(yerr));
        assert_int_equal(rodas5p_dense_prepare(step), GSL_SUCCESS);
        for (int p = 1; p < 16; p++) {
            rodas5p_dense_eval(step, p / 16.0, &z);
            worst.dense = fmax(worst.dense, fabs(z - cos((i + p / 16.0) * h)));
        }
    }
    gsl_odeiv2_step_free(step);
    return worst;
}

/* The order of many methods falls to the one of their stages here. For h |lambda| >> 1 this one keeps 4
 * within a step; at the ends errors fall with h^3 / |lambda|, measured as 0.006 of it, and so are smaller
 * still. */
static void a_stiff_component_follows_its_forcing(void **state)
{
    (void)state;
    for (int decade = 4; decade <= 10; decade += 2) {
        double lambda = -pow(10, decade);
        struct forced_errors coarse = follow(lambda, 20), fine = follow(lambda, 40);
        double h = 2.0 / 40, dense_slope = log2(coarse.dense / fine.dense);
        print_message("# lambda %.0e: end %.1e, dense %.1e with slope %.2f, estimate %.1e\n", lambda,
                      fine.end, fine.dense, dense_slope, fine.estimate);
        assert_true(fine.end < 0.012 * h * h * h / -lambda + 4 * DBL_EPSILON); /* y is near 1 */
        assert_true(fabs(dense_slope - 4) < 0.2);
    }
}

/* The estimate of Rodas5, its predecessor, is blind for a quadrature. */
static void the_error_of_a_quadrature_is_seen(void **state)
{
    (void)state;
    struct forced_errors coarse = follow(0, 4), fine = follow(0, 8);
    double slope = log2(coarse.estimate / fine.estimate);
    print_message("# quadrature: estimate %.1e, error %.1e, slope %.2f\n", fine.estimate, fine.end, slope);
    assert_true(fine.estimate > fine.end);
    assert_true(fabs(slope - 5) < 0.5);
}

/* q'' = -k q - c q' with k = 1e6, c = 1e5: the rates -10 and -1e5. */
static int damped(double t, const double y[], double f[], void *params)
{
    (void)t, (void)params;
    f[0] = y[1];
    f[1] = -1e6 * y[0] - 1e5 * y[1];
    return GSL_SUCCESS;
}

static int damped_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    (void)t, (void)y, (void)params;
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -1e6;
    dfdy[3] = -1e5;
    dfdt[0] = dfdt[1] = 0;
    return GSL_SUCCESS;
}

static void a_fast_component_dies_in_one_step_whatever_its_size(void **state)
{
    (void)state;
    gsl_odeiv2_system sys = {damped, damped_jacobian, 2, NULL};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, 2);
    const double root = sqrt(2.5e9 - 1e6), slow = -1e6 / (5e4 + root), fast = -5e4 - root;
    for (int i = 0; i < 6; i++) {
        double h = ldexp(1e-3, i); /* h |fast| = 100 ... 3200 */
        double y[2] = {1, slow + 1000}, yerr[2];
        assert_int_equal(gsl_odeiv2_step_apply(step, 0, h, y, yerr, NULL, NULL, &sys), GSL_SUCCESS);
        /* What is left of the fast part of v, 1000 at first: v - slow q, as v = slow q on the slow one.
         * |R(z)| is about 20 / |z|. */
        assert_true(fabs(y[1] - slow * y[0]) < 1000 * 40 / (h * -fast));
    }
    double y[2] = {1, 0}, yerr[2];
    assert_int_equal(gsl_odeiv2_step_apply(step, 0, 1e9, y, yerr, NULL, NULL, &sys), GSL_SUCCESS);
    assert_true(fabs(y[0]) < 1e-7);
    gsl_odeiv2_step_free(step);
}

static void dense_output_meets_the_ends(void **state)
{
    (void)state;
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, size);
    double y0[size], y[size], yerr[size], z[size];
    exact(0.3, y0);
    memcpy(y, y0, sizeof y);
    gsl_odeiv2_step_apply(step, 0.3, 0.25, y, yerr, NULL, NULL, &sys);
    rodas5p_dense_prepare(step);
    rodas5p_dense_eval(step, 0, z);
    assert_memory_equal(z, y0, sizeof z);
    rodas5p_dense_eval(step, 1, z);
    assert_true(distance(z, y) <= 2 * DBL_EPSILON); /* y0 + (y1 - y0) */
    gsl_odeiv2_step_free(step);
}

static void slopes_that_are_not_given_or_asked_for_change_no_bit(void **state)
{
    (void)state;
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *with = gsl_odeiv2_step_alloc(step_rodas5p, size);
    gsl_odeiv2_step *without = gsl_odeiv2_step_alloc(step_rodas5p, size);
    double y[size], z[size], yerr[size], zerr[size], f0[size], f1[size];
    exact(0.3, y);
    exact(0.3, z);
    rhs(0.3, y, f0, &problem);
    problem.calls = 0;
    gsl_odeiv2_step_apply(with, 0.3, 0.5, y, yerr, f0, f1, &sys);
    assert_int_equal(problem.calls, 8);
    gsl_odeiv2_step_apply(without, 0.3, 0.5, z, zerr, NULL, NULL, &sys);
    assert_int_equal(problem.calls, 16);
    assert_memory_equal(y, z, sizeof y);
    assert_memory_equal(yerr, zerr, sizeof yerr);
    gsl_odeiv2_step_free(with);
    gsl_odeiv2_step_free(without);
}

/* Attempt a step of size h from t, with y0 = 1 + shift, and count the Jacobians of all attempts. */
static long jacobians_after(gsl_odeiv2_step *step, struct problem *problem, double t, double h, double shift)
{
    gsl_odeiv2_system sys = system_of(problem);
    double y[size] = {1 + shift, 1}, yerr[size];
    assert_int_equal(gsl_odeiv2_step_apply(step, t, h, y, yerr, NULL, NULL, &sys), GSL_SUCCESS);
    return problem->jacobians;
}

static void the_jacobian_is_kept_for_further_attempts(void **state)
{
    (void)state;
    struct problem problem = {0}, other = {0};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, size);
    assert_null(rodas5p_jacobian(step));
    assert_int_equal(jacobians_after(step, &problem, 0, 0.5, 0), 1);
    assert_int_equal(jacobians_after(step, &problem, 0, 0.25, 0), 1);
    assert_true(rodas5p_jacobian(step)[3] == 1); /* cos 0 */
    assert_int_equal(jacobians_after(step, &problem, 1e-300, 0.25, 0), 2);
    assert_int_equal(jacobians_after(step, &problem, 1e-300, 0.25, DBL_EPSILON), 3);
    assert_int_equal(jacobians_after(step, &other, 1e-300, 0.25, DBL_EPSILON), 1);
    assert_int_equal(jacobians_after(step, &problem, 0, 0.5, 0), 4);
    gsl_odeiv2_step_reset(step);
    assert_null(rodas5p_jacobian(step));
    assert_int_equal(jacobians_after(step, &problem, 0, 0.5, 0), 5);
    gsl_odeiv2_step_free(step);
}

static void dense_output_is_refused_without_a_step_of_this_type(void **state)
{
    (void)state;
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, size);
    gsl_odeiv2_step *other = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk4, size);
    double y[size] = {1, 1}, yerr[size];
    assert_int_equal(rodas5p_dense_prepare(step), GSL_EINVAL);
    gsl_odeiv2_step_apply(step, 0, 0.1, y, yerr, NULL, NULL, &sys);
    assert_int_equal(rodas5p_dense_prepare(step), GSL_SUCCESS);
    gsl_odeiv2_step_reset(step);
    assert_int_equal(rodas5p_dense_prepare(step), GSL_EINVAL);
    assert_int_equal(rodas5p_dense_prepare(other), GSL_EINVAL);
    assert_null(rodas5p_jacobian(other));
    gsl_odeiv2_step_free(step);
    gsl_odeiv2_step_free(other);
}

/* One step that has to end with the code `expected`. */
static void fail_once(struct problem problem, int expected)
{
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, size);
    const double y0[size] = {0.1, 1 / 3.0}, f0[size] = {0, 1 / 3.0};
    double y[size], yerr[size], f1[size];
    memcpy(y, y0, sizeof y);
    assert_int_equal(gsl_odeiv2_step_apply(step, 0, 0.1, y, yerr, f0, f1, &sys), expected);
    assert_memory_equal(y, y0, sizeof y);
    assert_int_equal(rodas5p_dense_prepare(step), GSL_EINVAL);
    gsl_odeiv2_step_free(step);
}

static void a_failure_leaves_y_bit_for_bit_as_it_was(void **state)
{
    (void)state;
    const int codes[] = {GSL_EBADFUNC, GSL_EDOM, 77, GSL_SUCCESS /* a NaN */};
    for (size_t c = 0; c < sizeof codes / sizeof *codes; c++) {
        int code = codes[c], expected = code == GSL_SUCCESS ? GSL_FAILURE : code;
        for (long at = 1; at <= 8; at++) {
            if (code == GSL_SUCCESS && at == 8) continue; /* f(t + h, y1) is not part of y1 */
            fail_once((struct problem){.trouble = in_rhs, .fail_at = at, .code = code}, expected);
        }
        fail_once((struct problem){.trouble = in_jacobian, .code = code}, expected);
        fail_once((struct problem){.trouble = in_dfdt, .code = code}, expected);
    }
}

static void a_system_without_jacobian_is_refused(void **state)
{
    (void)state;
    struct problem problem = {0};
    gsl_odeiv2_system sys = {.function = rhs, .dimension = size, .params = &problem};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, size);
    double y[size] = {1, 1}, yerr[size];
    assert_int_equal(gsl_odeiv2_step_apply(step, 0, 0.1, y, yerr, NULL, NULL, &sys), GSL_EINVAL);
    assert_true(y[0] == 1 && y[1] == 1);
    gsl_odeiv2_step_free(step);
}

static void a_singular_matrix_is_a_failure_that_a_shorter_step_cures(void **state)
{
    (void)state;
    double h = 0.125, lambda = 1 / (rodas5p_gamma * h), y = 1, yerr;
    gsl_odeiv2_system sys = {forced, forced_jacobian, 1, &lambda};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, 1);
    assert_int_equal(gsl_odeiv2_step_apply(step, 0, h, &y, &yerr, NULL, NULL, &sys), GSL_FAILURE);
    assert_true(y == 1);
    assert_int_equal(gsl_odeiv2_step_apply(step, 0, h / 2, &y, &yerr, NULL, NULL, &sys), GSL_SUCCESS);
    gsl_odeiv2_step_free(step);
}

static void it_serves_gsl_driver_and_control(void **state)
{
    (void)state;
    struct problem problem = {0};
    gsl_odeiv2_system sys = system_of(&problem);
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&sys, step_rodas5p, 1e-3, 1e-9, 0);
    double t = 0, y[size], z[size];
    exact(0, y);
    for (int i = 1; i <= 10; i++) {
        assert_int_equal(gsl_odeiv2_driver_apply(driver, &t, i, y), GSL_SUCCESS);
        exact(i, z);
        assert_true(distance(y, z) < 2e-7); /* 1e-9 for each of some 200 steps */
    }
    print_message("# driver: %ld evaluations, %ld Jacobians\n", problem.calls, problem.jacobians);
    assert_true(problem.jacobians < 400);
    gsl_odeiv2_driver_free(driver);
}

/* Kept short by accuracy at first, then long: 1e5 s of a motion whose rates are 10 and 1e5 per second. An
 * explicit method takes 1e9 steps or more. */
static void it_serves_gsl_evolve_on_a_stiff_motion(void **state)
{
    (void)state;
    gsl_odeiv2_system sys = {damped, damped_jacobian, 2, NULL};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, 2);
    gsl_odeiv2_control *control = gsl_odeiv2_control_y_new(1e-8, 0);
    gsl_odeiv2_evolve *evolve = gsl_odeiv2_evolve_alloc(2);
    double t = 0, h = 1e-6, y[2] = {1, 0};
    while (t < 1e5 && evolve->count < 1000)
        assert_int_equal(gsl_odeiv2_evolve_apply(evolve, control, step, &sys, &t, 1e5, &h, y), GSL_SUCCESS);
    print_message("# evolve: %lu steps, %lu failed\n", evolve->count, evolve->failed_steps);
    assert_true(t == 1e5 && evolve->count < 300);
    assert_true(fabs(y[0]) < 1e-8);
    gsl_odeiv2_evolve_free(evolve);
    gsl_odeiv2_control_free(control);
    gsl_odeiv2_step_free(step);
}

/* y_i' = mean of all y - y_i: a full Jacobian. */
static int towards_the_mean(double t, const double y[], double f[], void *params)
{
    const int *n = params;
    double sum = 0;
    (void)t;
    for (int i = 0; i < *n; i++) sum += y[i];
    for (int i = 0; i < *n; i++) f[i] = sum / *n - y[i];
    return GSL_SUCCESS;
}

static int towards_the_mean_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    const int *n = params;
    (void)t, (void)y;
    for (int i = 0; i < *n * *n; i++) dfdy[i] = 1.0 / *n - (i % (*n + 1) == 0);
    for (int i = 0; i < *n; i++) dfdt[i] = 0;
    return GSL_SUCCESS;
}

/* The mean stays, differences from it die out like exp(-t). */
static void systems_of_any_size_are_solved(void **state)
{
    (void)state;
    for (int n = 1; n <= 9; n++) {
        gsl_odeiv2_system sys = {towards_the_mean, towards_the_mean_jacobian, (size_t)n, &n};
        gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_rodas5p, (size_t)n);
        double y[9], yerr[9], mean = (n - 1) / 2.0;
        for (int i = 0; i < n; i++) y[i] = i;
        assert_int_equal(gsl_odeiv2_step_apply(step, 0, 0.1, y, yerr, NULL, NULL, &sys), GSL_SUCCESS);
        /* Local error: 0.1^6 / 6! = 1e-9 times an error constant below 1, times differences of up to 4. */
        for (int i = 0; i < n; i++) assert_true(fabs(y[i] - mean - (i - mean) * exp(-0.1)) < 4e-9);
        gsl_odeiv2_step_free(step);
    }
    assert_null(step_rodas5p->alloc(0));
    assert_null(step_rodas5p->alloc(SIZE_MAX / 100));
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(local_errors_fall_with_their_orders),
        cmocka_unit_test(the_order_is_5),
        cmocka_unit_test(a_stiff_component_follows_its_forcing),
        cmocka_unit_test(the_error_of_a_quadrature_is_seen),
        cmocka_unit_test(a_fast_component_dies_in_one_step_whatever_its_size),
        cmocka_unit_test(dense_output_meets_the_ends),
        cmocka_unit_test(slopes_that_are_not_given_or_asked_for_change_no_bit),
        cmocka_unit_test(the_jacobian_is_kept_for_further_attempts),
        cmocka_unit_test(dense_output_is_refused_without_a_step_of_this_type),
        cmocka_unit_test(a_failure_leaves_y_bit_for_bit_as_it_was),
        cmocka_unit_test(a_system_without_jacobian_is_refused),
        cmocka_unit_test(a_singular_matrix_is_a_failure_that_a_shorter_step_cures),
        cmocka_unit_test(it_serves_gsl_driver_and_control),
        cmocka_unit_test(it_serves_gsl_evolve_on_a_stiff_motion),
        cmocka_unit_test(systems_of_any_size_are_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
