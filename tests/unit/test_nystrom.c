/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The Nystrom pair 12(10): coefficients, measured orders of steps and of dense output, failures.
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

#include "integrate/nystrom.h"
#include "integrate/nystrom_table.h"

/* A circle about a mass, with period 2 pi: x = cos t, y = sin t. */
enum { size = 4 };

struct problem {
    long calls, fail_at; /* number of the call that fails, from 1; 0: none */
};

static int rhs(double t, const double y[], double f[], void *params)
{
    struct problem *problem = params;
    (void)t;
    if (++problem->calls == problem->fail_at) return GSL_EDOM;
    double r = hypot(y[0], y[1]), r3 = r * r * r;
    f[0] = y[2];
    f[1] = y[3];
    f[2] = -y[0] / r3;
    f[3] = -y[1] / r3;
    return GSL_SUCCESS;
}

static void exact(double t, double y[size])
{
    y[0] = cos(t);
    y[1] = sin(t);
    y[2] = -sin(t);
    y[3] = cos(t);
}

/* sum over the stages of w_i c_i^k, and the magnitude of its terms. */
static double moment(const double *w, int k, int last, double *magnitude)
{
    double sum = 0;
    *magnitude = 0;
    for (int i = 1; i <= last; i++) {
        double term = w[i] * pow(nystrom_c[i], k);
        sum += term;
        *magnitude += fabs(term);
    }
    return sum;
}

/* Each of up to 17 numbers is rounded, and each addition. */
static void check_moment(const double *w, int k, int last, double want)
{
    double magnitude, sum = moment(w, k, last, &magnitude);
    assert_true(fabs(sum - want) <= 20 * DBL_EPSILON * magnitude);
}

static void rows_integrate_polynomials(void **state)
{
    (void)state;
    /* sum_j a_ij c_j^k = c_i^(k+2) / ((k+1) (k+2)), in all rows for k = 0, in those from the sixth up to
     * k = 4 */
    for (int i = 2; i <= nystrom_stages; i++) {
        for (int k = 0; k <= (i < 6 ? 0 : 4); k++)
            check_moment(nystrom_a[i], k, i - 1, pow(nystrom_c[i], k + 2) / ((k + 1) * (k + 2)));
        for (int j = i; j <= nystrom_stages; j++) assert_true(nystrom_a[i][j] == 0);
    }
}

static void sums_integrate_polynomials_up_to_their_orders(void **state)
{
    (void)state;
    for (int k = 0; k <= 11; k++) check_moment(nystrom_d, k, nystrom_stages, 1.0 / (k + 1));
    for (int k = 0; k <= 10; k++) check_moment(nystrom_b, k, nystrom_stages, 1.0 / ((k + 1) * (k + 2)));
    for (int k = 0; k <= 9; k++) check_moment(nystrom_d_low, k, nystrom_stages, 1.0 / (k + 1));
    for (int k = 0; k <= 8; k++) check_moment(nystrom_b_low, k, nystrom_stages, 1.0 / ((k + 1) * (k + 2)));
    for (int i = 1; i <= nystrom_stages; i++)
        assert_true(fabs(nystrom_b[i] - nystrom_d[i] * (1 - nystrom_c[i])) <= 2 * DBL_EPSILON);
}

/* The value of P_m(x). */
static double legendre(int m, double x)
{
    double value = 1, before = 0;
    for (int k = 0; k < m; k++) {
        double next = ((2 * k + 1) * x * value - k * before) / (k + 1);
        before = value;
        value = next;
    }
    return value;
}

/* The matrices of the dense output take the values of P_m at their nodes to the unit vector m. */
static void the_matrices_of_dense_output_know_legendre_polynomials(void **state)
{
    (void)state;
    const double rounding = 1e-14; /* eleven products of size 1 */
    for (int m = 0; m < nystrom_nodes; m++) {
        for (int i = 0; i < nystrom_nodes; i++) {
            double sum = 0, of_stages = 0;
            for (int j = 0; j < nystrom_nodes; j++)
                sum += nystrom_legendre[i][j] * legendre(m, 2 * nystrom_node[j] - 1);
            assert_true(fabs(sum - (i == m)) <= rounding);
            if (i >= nystrom_stage_nodes || m >= nystrom_stage_nodes) continue;
            for (int j = 0; j < nystrom_stage_nodes; j++) {
                int stage = nystrom_node_stage[j];
                of_stages += nystrom_stage_legendre[i][j] * legendre(m, stage ? 2 * nystrom_c[stage] - 1 : 1);
            }
            assert_true(fabs(of_stages - (i == m)) <= rounding);
        }
    }
}

static double distance(const double *a, const double *b, int first, int count)
{
    double most = 0;
    for (int i = first; i < first + count; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* The error after one revolution in `steps` steps. */
static double error_of(int steps)
{
    struct problem problem = {0};
    gsl_odeiv2_system system = {rhs, NULL, size, &problem};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_nystrom, size);
    double y[size], f[size], yerr[size], want[size], h = 2 * acos(-1) / steps;
    exact(0, y);
    exact(0, want);
    rhs(0, y, f, &problem);
    for (int i = 0; i < steps; i++)
        assert_int_equal(gsl_odeiv2_step_apply(step, i * h, h, y, yerr, f, f, &system), GSL_SUCCESS);
    assert_int_equal(problem.calls, 1 + 17L * steps);
    gsl_odeiv2_step_free(step);
    return distance(y, want, 0, size);
}

static void errors_fall_with_the_twelfth_power(void **state)
{
    (void)state;
    double coarse = error_of(4), fine = error_of(8), slope = log(coarse / fine) / log(2);
    /* From 4e-9 to 1e-12, above rounding; the next terms still show. */
    print_message("# errors %.2e, %.2e, order %.2f\n", coarse, fine, slope);
    assert_true(slope > 11.5 && slope < 12.5);
}

/* Largest errors of q, of v within one step of size h from t = 1, and the step's own and its estimate. */
static void look_into(double h, double *q, double *v, double *end, double *estimate)
{
    struct problem problem = {0};
    gsl_odeiv2_system system = {rhs, NULL, size, &problem};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_nystrom, size);
    double y[size], f[size], yerr[size], want[size];
    exact(1, y);
    rhs(1, y, f, &problem);
    assert_int_equal(gsl_odeiv2_step_apply(step, 1, h, y, yerr, f, f, &system), GSL_SUCCESS);
    exact(1 + h, want);
    *end = distance(y, want, 0, size);
    *estimate = 0;
    for (int i = 0; i < size; i++) *estimate = fmax(*estimate, fabs(yerr[i]));
    long before = problem.calls;
    assert_int_equal(nystrom_dense_prepare(step, &system), GSL_SUCCESS);
    assert_int_equal(nystrom_dense_prepare(step, &system), GSL_SUCCESS);
    assert_int_equal(problem.calls - before, 9);
    *q = *v = 0;
    for (int i = 0; i <= 20; i++) {
        nystrom_dense_eval(step, i / 20.0, y);
        exact(1 + h * i / 20.0, want);
        *q = fmax(*q, distance(y, want, 0, 2));
        *v = fmax(*v, distance(y, want, 2, 2));
    }
    gsl_odeiv2_step_free(step);
}

static void dense_output_errs_like_the_estimate(void **state)
{
    (void)state;
    double q[2], v[2], end[2], estimate[2];
    look_into(1, &q[0], &v[0], &end[0], &estimate[0]);
    look_into(0.5, &q[1], &v[1], &end[1], &estimate[1]);
    double q_slope = log(q[0] / q[1]) / log(2), v_slope = log(v[0] / v[1]) / log(2);
    print_message(
        "# h = 1, 0.5: q %.1e, %.1e (%.1f), v %.1e, %.1e (%.1f), end %.1e, %.1e, estimate %.1e, %.1e\n", q[0],
        q[1], q_slope, v[0], v[1], v_slope, end[0], end[1], estimate[0], estimate[1]);
    /* q errs by h^12, v by h^11 */
    assert_true(q_slope > 11.5 && v_slope > 10.5);
    for (int i = 0; i < 2; i++) {
        assert_true(end[i] < estimate[i]);
        assert_true(q[i] < 10 * estimate[i] && v[i] < 100 * estimate[i]);
    }
}

static void a_failure_leaves_the_state_alone(void **state)
{
    (void)state;
    for (long call = 1; call <= 18; call++) {
        struct problem problem = {.fail_at = call};
        gsl_odeiv2_system system = {rhs, NULL, size, &problem};
        gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_nystrom, size);
        double y[size], yerr[size], f[size], before[size];
        exact(0, y);
        memcpy(before, y, sizeof y);
        assert_int_equal(gsl_odeiv2_step_apply(step, 0, 0.1, y, yerr, NULL, f, &system), GSL_EDOM);
        assert_memory_equal(y, before, sizeof y);
        assert_int_equal(nystrom_dense_prepare(step, &system), GSL_EINVAL);
        gsl_odeiv2_step_free(step);
    }
}

static void an_odd_dimension_is_refused(void **state)
{
    (void)state;
    assert_null(step_nystrom->alloc(3));
    assert_null(step_nystrom->alloc(0));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_integrate_polynomials),
        cmocka_unit_test(sums_integrate_polynomials_up_to_their_orders),
        cmocka_unit_test(the_matrices_of_dense_output_know_legendre_polynomials),
        cmocka_unit_test(errors_fall_with_the_twelfth_power),
        cmocka_unit_test(dense_output_errs_like_the_estimate),
        cmocka_unit_test(a_failure_leaves_the_state_alone),
        cmocka_unit_test(an_odd_dimension_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
