/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The first step size: independence of units, usefulness, starts from nothing, right-hand sides that fail.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <math.h>

#include "integrate/error_norm.h"
#include "integrate/first_step.h"

static const struct layout one_pair = {.pairs = 1};

/* q'' = -k q - c v + g, in a box |q| < wall. */
struct scene {
    double k, c, g, wall;
    int code; /* returned outside of the wall */
};

static int motion(double t, const double y[], double f[], void *params)
{
    const struct scene *scene = params;
    (void)t;
    if (fabs(y[0]) >= scene->wall) return scene->code;
    f[0] = y[1];
    f[1] = -scene->k * y[0] - scene->c * y[1] + scene->g;
    return GSL_SUCCESS;
}

/* The return code of first_step; *h its result. */
static int choose(struct scene scene, double q, double v, int order, double tolerance, double h_max,
                  double *h)
{
    gsl_odeiv2_system inner = {.function = motion, .dimension = 2, .params = &scene};
    struct counted_system system;
    counted_system_init(&system, &inner);
    gsl_odeiv2_control *control = error_norm_alloc(&one_pair, tolerance, step_law_for(order));
    double y[2] = {q, v}, f[2], work[6];
    assert_int_equal(counted_system_rhs(&system, 0, y, f), GSL_SUCCESS);
    error_norm_update(control, y, f);
    int code = first_step(&system, &one_pair, control, order, 0, y, f, h_max, work, h);
    gsl_odeiv2_control_free(control);
    return code;
}

static double chosen(struct scene scene, double q, double v, double h_max)
{
    double h = NAN;
    assert_int_equal(choose(scene, q, v, 8, 1e-9, h_max, &h), GSL_SUCCESS);
    assert_true(h > 0 && h <= h_max);
    return h;
}

static void it_scales_with_the_unit_of_time(void **state)
{
    (void)state;
    struct scene scene = {.k = 4, .c = 0.5, .g = 9.81, .wall = INFINITY};
    double h = chosen(scene, 1, 2, 100);
    for (int power = -40; power <= 40; power += 20) { /* powers of two: the same digits */
        double s = ldexp(1, power);
        struct scene other = {.k = 4 / s / s, .c = 0.5 / s, .g = 9.81 / s / s, .wall = INFINITY};
        assert_true(chosen(other, 1, 2 / s, 100 * s) == h * s);
    }
}

static void it_does_not_depend_on_the_unit_of_length(void **state)
{
    (void)state;
    struct scene scene = {.k = 4, .c = 0.5, .g = 9.81, .wall = INFINITY};
    double h = chosen(scene, 1, 2, 100);
    for (int power = -40; power <= 40; power += 20) {
        double s = ldexp(1, power);
        struct scene other = {.k = 4, .c = 0.5, .g = 9.81 * s, .wall = INFINITY};
        assert_true(chosen(other, s, 2 * s, 100) == h);
    }
}

/* The allowed step of order 8 at 1e-9 is about 0.25 / omega; a hundredth of that costs three steps of
 * growth.
 */
static void it_is_of_the_size_of_the_motion(void **state)
{
    (void)state;
    for (int decade = -6; decade < 7; decade++) {
        double omega = pow(10, decade);
        struct scene scene = {.k = omega * omega, .wall = INFINITY};
        const double starts[][2] = {
            {1, 0}, {0, omega}, {0.6, 0.8 * omega}, {1e-18, omega}, {1, 1e-17 * omega}};
        for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
            double h = chosen(scene, starts[i][0], starts[i][1], 1000 / omega);
            assert_true(h * omega > 0.0025 && h * omega < 0.25);
        }
    }
}

static void a_fast_damper_is_seen(void **state)
{
    (void)state;
    struct scene scene = {.c = 1e6, .g = 9.81, .wall = INFINITY};
    assert_true(chosen(scene, 1, 0, 10) < 1e-6); /* the time constant 1 / c */
    assert_true(chosen(scene, 1, 5, 10) < 1e-6);
}

static void nothing_at_all_gives_a_step_too(void **state)
{
    (void)state;
    struct scene rest = {.wall = INFINITY}, fall = {.g = 9.81, .wall = INFINITY};
    assert_true(chosen(rest, 0, 0, 10) == 1); /* a hundred Euler steps of 1/1000 */
    assert_true(chosen(fall, 0, 0, 10) >= 1e-3);
    assert_true(chosen(rest, 0, 3, 10) >= 1e-3); /* uniform motion */
    assert_true(chosen(rest, 7, 0, 10) >= 1e-3);
}

static void it_is_never_larger_than_the_bound(void **state)
{
    (void)state;
    struct scene scene = {.k = 1, .wall = INFINITY};
    assert_true(chosen(scene, 1, 0, 1e-5) == 1e-5);
    assert_true(chosen(scene, 0, 0, 1e-300) <= 1e-300);
}

static void it_shrinks_with_the_tolerance_by_the_order(void **state)
{
    (void)state;
    struct scene scene = {.k = 1, .wall = INFINITY};
    double coarse, fine;
    choose(scene, 1, 0, 4, 1e-5, 10, &coarse);
    choose(scene, 1, 0, 4, 1e-10, 10, &fine);
    assert_true(fabs(coarse / fine - 10) < 1e-9); /* (1e5)^(1/5) */
}

static void a_wall_nearby_shortens_the_euler_step(void **state)
{
    (void)state;
    struct scene scene = {.k = 1, .wall = 1 + 1e-7, .code = 1};
    double h = NAN;
    assert_int_equal(choose(scene, 1, 1, 8, 1e-9, 10, &h), GSL_SUCCESS);
    assert_true(h > 0 && h < 1e-4);
}

static void codes_are_passed_on(void **state)
{
    (void)state;
    double h = NAN;
    struct scene stop = {.k = 1, .wall = 1 + 1e-7, .code = GSL_EBADFUNC};
    assert_int_equal(choose(stop, 1, 1, 8, 1e-9, 10, &h), GSL_EBADFUNC);
    struct scene at_the_wall = {.k = 1, .wall = nextafter(1, 2), .code = 7};
    assert_int_equal(choose(at_the_wall, 1, 1, 8, 1e-9, 10, &h), 7);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_scales_with_the_unit_of_time),
        cmocka_unit_test(it_does_not_depend_on_the_unit_of_length),
        cmocka_unit_test(it_is_of_the_size_of_the_motion),
        cmocka_unit_test(a_fast_damper_is_seen),
        cmocka_unit_test(nothing_at_all_gives_a_step_too),
        cmocka_unit_test(it_is_never_larger_than_the_bound),
        cmocka_unit_test(it_shrinks_with_the_tolerance_by_the_order),
        cmocka_unit_test(a_wall_nearby_shortens_the_euler_step),
        cmocka_unit_test(codes_are_passed_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
