/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The error control: independence of units, scales, step size law, use with GSL's evolve.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <gsl/gsl_errno.h>
#include <math.h>

#include "integrate/error_norm.h"

static const double tolerance = 1e-6;

static gsl_odeiv2_control *control_for(size_t pairs, size_t extra, const bool *angle, int estimate_order)
{
    struct layout layout = {.pairs = pairs, .extra = extra, .angle = angle};
    gsl_odeiv2_control *control = error_norm_alloc(&layout, tolerance, step_law_for(estimate_order));
    assert_non_null(control);
    return control;
}

/* Ratio of one pair with these values, in units in which a length is `length` times as large as a number
 * and a time `time` times. */
static double ratio_in_units(double length, double time)
{
    gsl_odeiv2_control *control = control_for(1, 0, NULL, 5);
    double v = length / time, a = v / time, h = 0.125 * time;
    double before[2] = {3 * length, -2 * v}, slopes[2] = {-2 * v, 7 * a};
    error_norm_update(control, before, slopes);
    double y[2] = {2.5 * length, -4 * v}, f[2] = {-4 * v, 5 * a}, yerr[2] = {1.1e-6 * length, 3e-6 * v};
    double ratio = error_norm_ratio(control, h, y, yerr, f);
    gsl_odeiv2_control_free(control);
    return ratio;
}

static void the_error_ratio_does_not_depend_on_units(void **state)
{
    (void)state;
    double ratio = ratio_in_units(1, 1);
    assert_true(fabs(ratio - 3e-6 / (tolerance * 4)) < 1e-15);
    assert_true(ratio_in_units(1024, 1) == ratio); /* powers of two: the same digits */
    assert_true(ratio_in_units(1, 1.0 / 4096) == ratio);
    assert_true(ratio_in_units(0x1p40, 0x1p-30) == ratio);
    assert_true(fabs(ratio_in_units(0.3048, 60) / ratio - 1) < 8 * DBL_EPSILON); /* a few roundings */
    assert_true(fabs(ratio_in_units(1e-9, 1e12) / ratio - 1) < 8 * DBL_EPSILON);
}

/* The ratio that an error of 1 in v has after a peak of 1000 and then a state before and one now. */
static double ratio_after_peak(const double before[3], const double now[3])
{
    gsl_odeiv2_control *control = control_for(1, 0, NULL, 8);
    const double peak[2] = {0, 1000}, flat[2] = {1000, 0}, error[2] = {0, 1};
    const double slopes[2] = {before[1], before[2]}, f[2] = {now[1], now[2]};
    error_norm_update(control, peak, flat);
    error_norm_update(control, before, slopes);
    double ratio = tolerance * error_norm_ratio(control, 1e-3, now, error, f);
    gsl_odeiv2_control_free(control);
    return ratio;
}

/* q = A sin(w t): the amplitude A w whatever the phase, up to what the peak was and down to its thousandth. */
static void a_rate_counts_up_to_its_amplitude(void **state)
{
    (void)state;
    const double w = 3, A = 4;
    for (int i = 0; i < 12; i++) {
        double before[3], now[3], *both[] = {before, now};
        for (int k = 0; k < 2; k++) {
            double phase = 0.1 + 0.5 * i + 0.2 * k;
            both[k][0] = A * sin(phase);
            both[k][1] = A * w * cos(phase);
            both[k][2] = -A * w * w * sin(phase);
        }
        double size = 1 / ratio_after_peak(before, now);
        /* The larger rate and the mean acceleration are a tenth of a radian apart. */
        assert_true(size > 0.94 * A * w && size < 1.06 * A * w);
    }
    const double steady[3] = {5, 7, 2}, rest[3] = {1, 0, 0}, still[3] = {1 + 1e-9, 0, 1e-9};
    assert_true(1 / ratio_after_peak((const double[]){4, 7, 2}, steady) > 999);
    assert_true(fabs(1 / ratio_after_peak(rest, still) - 1) < 1e-9);
}

static void zero_with_zero_error_is_no_error(void **state)
{
    (void)state;
    gsl_odeiv2_control *control = control_for(1, 1, NULL, 5);
    const double zero[3] = {0};
    assert_true(error_norm_ratio(control, 0.1, zero, zero, zero) == 0);
    assert_true(error_norm_factor(control, 0, 5) == 5);
    gsl_odeiv2_control_free(control);
}

static void a_body_at_rest_dilutes_nothing(void **state)
{
    (void)state;
    gsl_odeiv2_control *one = control_for(1, 0, NULL, 5), *many = control_for(3, 0, NULL, 5);
    const double y1[2] = {1, 2}, e1[2] = {1e-7, 3e-6}, f1[2] = {2, -1};
    const double y3[6] = {0, 1, 0, 0, 2, 0}, e3[6] = {0, 1e-7, 0, 0, 3e-6, 0}, f3[6] = {0, 2, 0, 0, -1, 0};
    assert_true(error_norm_ratio(one, 0.1, y1, e1, f1) == error_norm_ratio(many, 0.1, y3, e3, f3));
    gsl_odeiv2_control_free(one);
    gsl_odeiv2_control_free(many);
}

static void what_is_not_finite_is_an_infinite_error(void **state)
{
    (void)state;
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t b = 0; b < 3; b++) {
        for (int where = 0; where < 9; where++) {
            gsl_odeiv2_control *control = control_for(1, 1, NULL, 5);
            double values[3][3] = {{1, 1, 1}, {0, 0, 0}, {1, 1, 1}}, h = 0.5;
            if (where == 6) { /* f of q is v itself, which is looked at as v */
                gsl_odeiv2_control_free(control);
                continue;
            }
            values[where / 3][where % 3] = bad[b];
            assert_true(error_norm_ratio(control, h, values[0], values[1], values[2]) == INFINITY);
            int code = control->type->hadjust(control->state, 3, 5, values[0], values[1], values[2], &h);
            assert_int_equal(code, GSL_ODEIV_HADJ_DEC);
            assert_true(h == 0.05);
            gsl_odeiv2_control_free(control);
        }
    }
}

static void an_angle_counts_up_to_one_radian_and_its_rate_in_full(void **state)
{
    (void)state;
    const bool angle[2] = {true, false};
    gsl_odeiv2_control *control = control_for(2, 0, angle, 5);
    const double y[4] = {500, 500, 300, 300}, f[4] = {300, 300, 1, 1};
    double scales[4];
    error_norm_update(control, y, f);
    error_norm_scales(control, 0.1, y, f, scales);
    assert_true(scales[0] == 1 && scales[1] == 500 && scales[2] == 300 && scales[3] == 300);
    const double small[4] = {1e-4, 0, 0, 0}, rest[4] = {0};
    gsl_odeiv2_control_free(control);
    control = control_for(2, 0, angle, 5);
    error_norm_scales(control, 0.1, small, rest, scales);
    assert_true(scales[0] == 1e-4);
    gsl_odeiv2_control_free(control);
}

static void the_scale_survives_a_passage_through_zero(void **state)
{
    (void)state;
    gsl_odeiv2_control *control = control_for(1, 0, NULL, 5);
    const double top[2] = {-3, 0}, middle[2] = {0, 5}, slopes[2] = {0, 0}, yerr[2] = {3e-6, 0};
    error_norm_update(control, top, slopes);
    assert_true(fabs(error_norm_ratio(control, 0.1, middle, yerr, slopes) - 1) < 4 * DBL_EPSILON);
    gsl_odeiv2_control_free(control);
    control = control_for(1, 0, NULL, 5); /* what is left is h v = 0.5, since q = 0 */
    assert_true(fabs(error_norm_ratio(control, 0.1, middle, yerr, slopes) - 6) < 16 * DBL_EPSILON);
    error_norm_set_floor(control, 0, 6);
    assert_true(fabs(error_norm_ratio(control, 0.1, middle, yerr, slopes) - 0.5) < 4 * DBL_EPSILON);
    gsl_odeiv2_control_free(control);
}

static void a_component_that_starts_from_zero_is_measured_by_its_motion(void **state)
{
    (void)state;
    gsl_odeiv2_control *control = control_for(1, 1, NULL, 5);
    const double y[3] = {0}, f[3] = {0, 8, 4};
    double scales[3];
    error_norm_scales(control, 0.5, y, f, scales);
    assert_true(scales[0] == 2 && scales[1] == 4 && scales[2] == 2); /* h^2 a, h a, h x' */
    const double moving[3] = {0, 6, 0};
    error_norm_scales(control, 0.5, moving, f, scales);
    assert_true(scales[0] == 5); /* h v + h^2 a */
    gsl_odeiv2_control_free(control);
}

/* A stiff direction: q errs by 1e-3 and a = 1e8 of it. */
static void slopes_at_the_end_of_a_bad_step_excuse_nothing(void **state)
{
    (void)state;
    gsl_odeiv2_control *control = control_for(1, 0, NULL, 5);
    const double start[2] = {1, 0}, slopes[2] = {0}, y[2] = {0.9, 1}, f[2] = {1, 1e7}, yerr[2] = {1e-3, 1e-3};
    error_norm_update(control, start, slopes);
    assert_true(error_norm_ratio(control, 3, y, yerr, f) > 900);
    gsl_odeiv2_control_free(control);
}

/* A mass that hangs on a spring: q = 1 m, v and a are rounding noise of 1e-16 g. */
static void rounding_noise_of_a_body_at_rest_is_no_error(void **state)
{
    (void)state;
    gsl_odeiv2_control *control = control_for(1, 0, NULL, 8);
    const double y[2] = {1, 4e-17}, f[2] = {4e-17, 1e-15}, yerr[2] = {1e-17, 1e-16};
    error_norm_update(control, y, f);
    assert_true(error_norm_ratio(control, 0.3, y, yerr, f) < 1);
    gsl_odeiv2_control_free(control);
}

/* A pair of 1 m and 2 m/s goes its own size in 0.5 s; another beside it, in 5 s. */
static void errors_of_short_steps_count_by_time_where_the_law_says_so(void **state)
{
    (void)state;
    struct layout layout = {.pairs = 2};
    struct step_law law = step_law_for(5);
    law.by_time = 0.5;
    gsl_odeiv2_control *control = error_norm_alloc(&layout, tolerance, law);
    const double y[4] = {1, 1, 2, 0.2}, f[4] = {2, 0.2, 0, 0};
    error_norm_update(control, y, f);
    const struct {
        double h, first, second; /* the tolerance over that of a long step */
    } cases[] = {{1, 1, 0.4}, {0.25, 1, 0.1}, {0.025, 0.1, 0.01}, {2.5e-6, 1e-3, 1e-3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double first[4] = {1e-7}, second[4] = {0, 1e-7}, rate[4] = {0, 0, 1e-7};
        double h = cases[i].h;
        assert_true(fabs(error_norm_ratio(control, h, y, first, f) * cases[i].first / 0.1 - 1) < 1e-12);
        assert_true(fabs(error_norm_ratio(control, h, y, second, f) * cases[i].second / 0.1 - 1) < 1e-12);
        assert_true(fabs(error_norm_ratio(control, h, y, rate, f) * cases[i].first / 0.05 - 1) < 1e-12);
    }
    gsl_odeiv2_control_free(control);

    /* Where rounding is near there is no less than 1e-12. */
    control = error_norm_alloc(&layout, 1e-11, law);
    error_norm_update(control, y, f);
    const double yerr[4] = {1e-12};
    assert_true(fabs(error_norm_ratio(control, 1e-4, y, yerr, f) - 1) < 1e-12);
    gsl_odeiv2_control_free(control);
}

static void the_step_follows_the_root_of_the_error_within_bounds(void **state)
{
    (void)state;
    struct step_law law = step_law_for(5);
    gsl_odeiv2_control *control = control_for(1, 0, NULL, 5);
    assert_true(fabs(error_norm_factor(control, 32, 5) - law.safety / 2) < 1e-15);
    assert_true(fabs(error_norm_factor(control, 1.0 / 32, 5) - law.safety * 2) < 1e-15);
    assert_true(error_norm_factor(control, 1e30, 5) == law.shrink);
    assert_true(error_norm_factor(control, 1e-30, 5) == law.grow);
    assert_true(error_norm_factor(control, INFINITY, 5) == 0.1);
    assert_true(error_norm_factor(control, NAN, 5) == 0.1);
    assert_true(error_norm_factor(control, 1, 5) == law.safety);
    gsl_odeiv2_control_free(control);

    control = control_for(1, 0, NULL, 8);
    law = step_law_for(8);
    assert_true(error_norm_factor(control, 256, 8) == law.safety / 2);
    assert_true(error_norm_factor(control, 0x1p-8, 8) == law.safety * 2);
    gsl_odeiv2_control_free(control);

    control = control_for(1, 0, NULL, 0); /* a multistep method of order 3: power 4, and no small changes */
    law = step_law_for(0);
    assert_true(fabs(error_norm_factor(control, 16, 3) - law.safety / 2) < 1e-15);
    assert_true(error_norm_factor(control, 0.5, 3) == 1);
    assert_true(error_norm_factor(control, 1, 3) == 1);
    assert_true(fabs(error_norm_factor(control, 1.0 / 256, 3) - law.safety * 4) < 1e-15);
    gsl_odeiv2_control_free(control);
}

static void gsl_is_told_what_was_decided(void **state)
{
    (void)state;
    gsl_odeiv2_control *control = control_for(1, 0, NULL, 5);
    const double y[2] = {1, 1}, f[2] = {1, 1};
    const struct {
        double error;
        int code;
    } cases[] = {{1e-3, GSL_ODEIV_HADJ_DEC},
                 {1.01e-6, GSL_ODEIV_HADJ_DEC},
                 {0.9e-6, GSL_ODEIV_HADJ_NIL},
                 {1e-9, GSL_ODEIV_HADJ_INC},
                 {0, GSL_ODEIV_HADJ_INC}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double h = 0.1, yerr[2] = {cases[i].error, 0};
        assert_int_equal(control->type->hadjust(control->state, 2, 5, y, yerr, f, &h), cases[i].code);
        if (cases[i].code == GSL_ODEIV_HADJ_DEC) assert_true(h < 0.1);
        if (cases[i].code == GSL_ODEIV_HADJ_INC) assert_true(h > 0.1);
        if (cases[i].code == GSL_ODEIV_HADJ_NIL) assert_true(h <= 0.1 && h >= 0.09 * (1 - DBL_EPSILON));
    }
    gsl_odeiv2_control_free(control);
}

static void the_error_level_is_the_error_of_ratio_one(void **state)
{
    (void)state;
    const bool angle[1] = {true};
    gsl_odeiv2_control *control = control_for(1, 1, angle, 5);
    const double y[3] = {40, 2, -7}, f[3] = {2, 3, 1}, h = 0.1;
    error_norm_update(control, y, f);
    for (size_t i = 0; i < 3; i++) {
        double level, yerr[3] = {0};
        assert_int_equal(gsl_odeiv2_control_errlevel(control, y[i], f[i], h, i, &level), GSL_SUCCESS);
        yerr[i] = level;
        assert_true(error_norm_ratio(control, h, y, yerr, f) == 1);
    }
    gsl_odeiv2_control_free(control);
}

static void the_error_level_is_never_zero(void **state)
{
    (void)state;
    gsl_odeiv2_control *control = control_for(2, 1, NULL, 5);
    double level;
    for (size_t i = 0; i < 5; i++) {
        assert_int_equal(gsl_odeiv2_control_errlevel(control, 0, 0, 0.1, i, &level), GSL_SUCCESS);
        assert_true(level > 0 && isfinite(level));
    }
    const double y[5] = {0, 3, 0, 5, 0}, f[5] = {0, 5, 0, 0, 0};
    error_norm_update(control, y, f);
    gsl_odeiv2_control_errlevel(control, 0, 0, 0.1, 0, &level);
    assert_true(level == tolerance * 3); /* of the other coordinate */
    gsl_odeiv2_control_errlevel(control, 0, 0, 0.1, 2, &level);
    assert_true(level == tolerance * 5);
    gsl_odeiv2_control_free(control);
}

static int oscillator(double t, const double y[], double f[], void *params)
{
    (void)t, (void)params;
    f[0] = y[1];
    f[1] = -y[0];
    return GSL_SUCCESS;
}

static void it_serves_gsl_evolve(void **state)
{
    (void)state;
    gsl_odeiv2_system sys = {.function = oscillator, .dimension = 2};
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rkf45, 2);
    gsl_odeiv2_evolve *evolve = gsl_odeiv2_evolve_alloc(2);
    gsl_odeiv2_control *control = control_for(1, 0, NULL, 5);
    double t = 0, h = 1e-3, y[2] = {1, 0};
    while (t < 10)
        assert_int_equal(gsl_odeiv2_evolve_apply(evolve, control, step, &sys, &t, 10, &h, y), GSL_SUCCESS);
    print_message("# %lu attempts\n", evolve->count);
    assert_true(evolve->count < 100); /* some 10 / 0.17 and a few to get started */
    /* Each step errs by 1e-6 at most, and an oscillator adds errors up. */
    assert_true(hypot(y[0] - cos(10), y[1] + sin(10)) < 1e-6 * (double)evolve->count);
    gsl_odeiv2_control_free(control);
    gsl_odeiv2_evolve_free(evolve);
    gsl_odeiv2_step_free(step);
}

static void unusable_arguments_make_no_control(void **state)
{
    (void)state;
    const struct layout none = {0}, one = {.pairs = 1};
    assert_null(error_norm_alloc(&none, 1e-6, step_law_for(5)));
    assert_null(error_norm_alloc(&one, 0, step_law_for(5)));
    assert_null(error_norm_alloc(&one, -1, step_law_for(5)));
    assert_null(error_norm_alloc(&one, NAN, step_law_for(5)));
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_error_ratio_does_not_depend_on_units),
        cmocka_unit_test(a_rate_counts_up_to_its_amplitude),
        cmocka_unit_test(zero_with_zero_error_is_no_error),
        cmocka_unit_test(a_body_at_rest_dilutes_nothing),
        cmocka_unit_test(what_is_not_finite_is_an_infinite_error),
        cmocka_unit_test(an_angle_counts_up_to_one_radian_and_its_rate_in_full),
        cmocka_unit_test(the_scale_survives_a_passage_through_zero),
        cmocka_unit_test(a_component_that_starts_from_zero_is_measured_by_its_motion),
        cmocka_unit_test(slopes_at_the_end_of_a_bad_step_excuse_nothing),
        cmocka_unit_test(rounding_noise_of_a_body_at_rest_is_no_error),
        cmocka_unit_test(errors_of_short_steps_count_by_time_where_the_law_says_so),
        cmocka_unit_test(the_step_follows_the_root_of_the_error_within_bounds),
        cmocka_unit_test(gsl_is_told_what_was_decided),
        cmocka_unit_test(the_error_level_is_the_error_of_ratio_one),
        cmocka_unit_test(the_error_level_is_never_zero),
        cmocka_unit_test(it_serves_gsl_evolve),
        cmocka_unit_test(unusable_arguments_make_no_control),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
