/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The exact steppers for linear equations and constant accelerations, against closed forms.
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

#include "integrate/linear.h"
#include "integrate/parabola.h"

/* x'' = -k (x - x0) - c x', two of them with different numbers side by side. */
struct oscillators {
    double k[2], c[2], x0[2];
};

static int rhs(double t, const double y[], double f[], void *params)
{
    const struct oscillators *o = params;
    (void)t;
    for (int i = 0; i < 2; i++) {
        f[i] = y[2 + i];
        f[2 + i] = -o->k[i] * (y[i] - o->x0[i]) - o->c[i] * y[2 + i];
    }
    return GSL_SUCCESS;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    const struct oscillators *o = params;
    (void)t, (void)y;
    memset(dfdy, 0, 16 * sizeof *dfdy);
    memset(dfdt, 0, 4 * sizeof *dfdt);
    for (int i = 0; i < 2; i++) {
        dfdy[i * 4 + 2 + i] = 1;
        dfdy[(2 + i) * 4 + i] = -o->k[i];
        dfdy[(2 + i) * 4 + 2 + i] = -o->c[i];
    }
    return GSL_SUCCESS;
}

/* From rest at x = 1, by the roots of l^2 + c l + k: under- or overdamped. */
static void exact(const struct oscillators *o, int i, double t, double *x, double *v)
{
    double half = o->c[i] / 2, square = half * half - o->k[i], from = 1 - o->x0[i];
    if (square < 0) {
        double w = sqrt(-square), decay = exp(-half * t);
        *x = o->x0[i] + from * decay * (cos(w * t) + half / w * sin(w * t));
        *v = -from * decay * o->k[i] / w * sin(w * t);
        return;
    }
    double fast = -half - sqrt(square), slow = o->k[i] / fast;
    double A = from * fast / (fast - slow), B = -from * slow / (fast - slow);
    *x = o->x0[i] + A * exp(slow * t) + B * exp(fast * t);
    *v = A * slow * exp(slow * t) + B * fast * exp(fast * t);
}

/* Errors relative to 1 in x and to the largest speed in v. */
static double error_at(const struct oscillators *o, double t, const double *y)
{
    double most = 0;
    for (int i = 0; i < 2; i++) {
        double x, v;
        exact(o, i, t, &x, &v);
        most = fmax(most, fabs(y[i] - x));
        most = fmax(most, fabs(y[2 + i] - v) / sqrt(o->k[i]));
    }
    return most;
}

/* `steps` steps of size h from rest, looked into everywhere; returns the largest error. */
static double carry(const struct oscillators *o, double h, int steps)
{
    gsl_odeiv2_system system = {rhs, jacobian, 4, (void *)o};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_linear, 4);
    double y[4] = {1, 1, 0, 0}, f[4], yerr[4], within[4], most = 0;
    rhs(0, y, f, (void *)o);
    for (int i = 0; i < steps; i++) {
        assert_int_equal(gsl_odeiv2_step_apply(step, i * h, h, y, yerr, f, f, &system), GSL_SUCCESS);
        for (int j = 0; j < 4; j++) assert_true(yerr[j] == 0);
        most = fmax(most, error_at(o, (i + 1) * h, y));
        assert_int_equal(linear_dense_prepare(step, &system), GSL_SUCCESS);
        for (int j = 1; j < 10; j++) {
            linear_dense_eval(step, j / 10.0 * h, within);
            most = fmax(most, error_at(o, (i + j / 10.0) * h, within));
        }
    }
    gsl_odeiv2_step_free(step);
    return most;
}

static void short_and_long_steps_agree_with_the_closed_form(void **state)
{
    (void)state;
    const struct oscillators o = {{100, 7}, {1, 30}, {0, 0.3}};
    /* h rho from 0.3 to 3e3: the series alone, and up to 12 doublings, each of which adds a rounding of the
     * phase (10 rad/s). */
    for (int k = 0; k < 5; k++) {
        double h = 0.01 * pow(10, k);
        int steps = h < 1 ? 20 : 3;
        double error = carry(&o, h, steps);
        print_message("# h = %g: error %.1e\n", h, error);
        assert_true(error < 20 * DBL_EPSILON * (10 + 30 * h * steps));
    }
}

static void a_stiff_spring_takes_steps_of_any_size(void **state)
{
    (void)state;
    /* Rates of 1e4/s and 1/s beside each other; critical would be c = 2e4. */
    const struct oscillators o = {{1e8, 1}, {3e4, 2.5}, {0, 0}};
    double error = carry(&o, 0.5, 20);
    print_message("# error %.1e\n", error);
    assert_true(error < 1e-12); /* 15 doublings of a norm of 1e4 */
}

static void equilibrium_is_kept_to_the_last_bit(void **state)
{
    (void)state;
    struct oscillators o = {{100, 7}, {1, 30}, {0.7, 0.3}};
    gsl_odeiv2_system system = {rhs, jacobian, 4, &o};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_linear, 4);
    double y[4] = {0.7, 0.3, 0, 0}, f[4], yerr[4];
    rhs(0, y, f, &o);
    for (int i = 0; i < 10; i++)
        assert_int_equal(gsl_odeiv2_step_apply(step, i, 1, y, yerr, f, f, &system), GSL_SUCCESS);
    assert_true(y[0] == 0.7 && y[1] == 0.3 && y[2] == 0 && y[3] == 0);
    gsl_odeiv2_step_free(step);
}

/* The oscillation at 10 rad/s lets steps of two radians pass; once it has died out (40 / 0.5 = 80 s) the
 * steps follow the age of the rest. */
static void the_pace_follows_what_is_still_there(void **state)
{
    (void)state;
    struct oscillators o = {{100, 0.01}, {1, 0.5}, {0, 0}};
    struct counted_system system;
    counted_system_init(&system, &(gsl_odeiv2_system){rhs, jacobian, 4, &o});
    struct linear_pace pace;
    double y[4] = {1, 1, 0, 0};
    assert_true(linear_pace_init(&pace, 4, 0));
    linear_pace_start(&pace, &system, 5, y, NULL);
    double early = linear_pace_step(&pace, 5), later = linear_pace_step(&pace, 45);
    double dead = linear_pace_step(&pace, 95);
    assert_true(early > 0.08 && early <= 0.2002); /* between one and two radians at 10 rad/s */
    assert_true(later > 0.1 && later <= 0.2006);  /* 1 / sqrt(100 - 0.25) */
    assert_true(dead > 40 && dead <= 90);
    assert_true(fabs(linear_pace_rate(&pace, 45) - 10) < 1e-9);
    linear_pace_free(&pace);
}

static int fall(double t, const double y[], double f[], void *params)
{
    long *calls = params;
    (void)t;
    (*calls)++;
    f[0] = y[1];
    f[1] = -9.81;
    return GSL_SUCCESS;
}

static void a_fall_is_a_parabola_in_one_step(void **state)
{
    (void)state;
    long calls = 0;
    gsl_odeiv2_system system = {fall, NULL, 2, &calls};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(step_parabola, 2);
    double y[2] = {3, 20}, f[2], yerr[2], within[2], T = 1e3;
    fall(0, y, f, &calls);
    assert_int_equal(gsl_odeiv2_step_apply(step, 0, T, y, yerr, f, f, &system), GSL_SUCCESS);
    assert_int_equal(calls, 1);
    /* Four roundings of the largest term. */
    assert_true(fabs(y[0] - (3 + 20 * T - 9.81 * T * T / 2)) <= 4 * DBL_EPSILON * 9.81 * T * T / 2);
    assert_true(fabs(y[1] - (20 - 9.81 * T)) <= 4 * DBL_EPSILON * 9.81 * T);
    assert_true(yerr[0] == 0 && yerr[1] == 0 && f[0] == y[1] && f[1] == -9.81);
    assert_int_equal(parabola_dense_prepare(step, &system), GSL_SUCCESS);
    parabola_dense_eval(step, 2, within);
    assert_true(fabs(within[0] - (3 + 40 - 9.81 * 2)) <= 4 * DBL_EPSILON * 43);
    parabola_dense_eval(step, 0, within);
    assert_true(within[0] == 3 && within[1] == 20);
    gsl_odeiv2_step_free(step);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(short_and_long_steps_agree_with_the_closed_form),
        cmocka_unit_test(a_stiff_spring_takes_steps_of_any_size),
        cmocka_unit_test(equilibrium_is_kept_to_the_last_bit),
        cmocka_unit_test(the_pace_follows_what_is_still_there),
        cmocka_unit_test(a_fall_is_a_parabola_in_one_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
