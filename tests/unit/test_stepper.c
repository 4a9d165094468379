/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The body of the integration loop with every method: accuracy, landing on times, looking into a step,
 * units. What goes wrong is in test_stepper_trouble.c.
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

#include "stepper_scene.h"

/* Every step may add its tolerance, times the scale 2; multistep methods at low orders and the Newton
 * iterations of the implicit ones, which end below the error level only, add somewhat more. */
static void every_method_reaches_its_accuracy_at_the_ends_and_within(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        const struct method *method = method_at(m);
        struct scene scene = {.omega = 1, .force = 1};
        struct run run;
        double tolerance = tolerance_for(method), ends = 0, within = 0, partial = 0;
        start(&run, &scene, method, tolerance, 1, 0, 20);
        while (run.t < 20) {
            double t0 = run.t, y[2], f[2];
            assert_int_equal(step(&run, 20), stepper_ok);
            ends = fmax(ends, deviation(run.y, run.t));
            for (int k = 1; k < 4; k++) {
                double t = t0 + (run.t - t0) * k / 4;
                assert_int_equal(stepper_dense(run.stepper, time_dd_at(t), y), GSL_SUCCESS);
                within = fmax(within, deviation(y, t));
                assert_int_equal(stepper_partial(run.stepper, time_dd_at(t), y, f), GSL_SUCCESS);
                partial = fmax(partial, deviation(y, t));
                assert_true(f[0] == y[1]);
            }
        }
        unsigned long steps = stepper_get_counts(run.stepper)->accepted;
        double bound = 16 * tolerance * (double)steps;
        print_message("# %-7s tolerance %.0e, %lu steps: error %.1e, within %.1e, partial %.1e, bound %.1e\n",
                      method->name, tolerance, steps, ends, within, partial, bound);
        assert_true(run.t == 20);
        assert_true(ends < bound);
        assert_true(within < fmax(bound, 10 * ends));
        assert_true(partial < fmax(bound, 10 * ends));
        stepper_free(run.stepper);
    }
}

static int pendulum(double t, const double y[], double f[], void *params)
{
    (void)t, (void)params;
    f[0] = y[1];
    f[1] = -9.81 * sin(y[0]);
    return GSL_SUCCESS;
}

static int pendulum_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    (void)t, (void)params;
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -9.81 * cos(y[0]);
    dfdy[3] = 0;
    dfdt[0] = dfdt[1] = 0;
    return GSL_SUCCESS;
}

/* Its energy v^2 / 2 - 9.81 cos q stays: at a tolerance t, a step changes it by v dv + 9.81 sin q dq < 20 t
 * + 20 t. */
static void a_pendulum_keeps_its_energy(void **state)
{
    (void)state;
    const bool angle[1] = {true};
    for (size_t m = 0; method_at(m); m++) {
        gsl_odeiv2_system inner = {pendulum, pendulum_jacobian, 2, NULL};
        struct counted_system system;
        counted_system_init(&system, &inner);
        struct stepper_options options = {.method = method_at(m),
                                          .layout = {1, 0, angle},
                                          .tolerance = tolerance_for(method_at(m))};
        struct stepper *stepper = stepper_alloc(&options);
        struct time_dd t = time_dd_at(0), end = time_dd_at(10);
        double h, y[2] = {2, 0}, f[2];
        assert_int_equal(stepper_reset(stepper, &system, t, y, f, end, &h), GSL_SUCCESS);
        while (t.t < 10) assert_int_equal(stepper_step(stepper, &system, &t, y, f, &h, end), stepper_ok);
        double gain = y[1] * y[1] / 2 - 9.81 * (cos(y[0]) - cos(2));
        unsigned long steps = stepper_get_counts(stepper)->accepted;
        assert_true(fabs(gain) < 40 * options.tolerance * (double)steps);
        stepper_free(stepper);
    }
}

static void multistep_methods_go_on_after_a_reset(void **state)
{
    (void)state;
    const char *names[] = {"msadams", "msbdf"};
    for (size_t m = 0; m < 2; m++) {
        struct scene scene = {.omega = 1, .force = 1};
        struct run run;
        start(&run, &scene, method_find(names[m]), 1e-8, 1, 0, 20);
        for (int i = 1; i <= 10; i++) {
            run_to(&run, i);
            /* An impact: to another solution and, after the next reset, back. */
            run.y[1] += i % 2 ? 1 : 0;
            double q = forced_q(run.t), v = forced_v(run.t);
            assert_int_equal(stepper_reset(run.stepper, &run.system, time_dd_at(run.t), run.y, run.f,
                                           time_dd_at(20), &run.h),
                             GSL_SUCCESS);
            if (i % 2 == 0) {
                /* One period of time 1 of the kicked oscillator: dq = sin 1, dv = cos 1. */
                assert_true(fabs(run.y[0] - q - sin(1)) < 1e-5 && fabs(run.y[1] - v - cos(1)) < 1e-5);
                run.y[0] = q;
                run.y[1] = v;
                assert_int_equal(stepper_reset(run.stepper, &run.system, time_dd_at(run.t), run.y, run.f,
                                               time_dd_at(20), &run.h),
                                 0);
            }
        }
        stepper_free(run.stepper);
    }
}

static void it_lands_exactly_on_the_limit(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        struct scene scene = {.omega = 1, .force = 1};
        struct run run;
        start(&run, &scene, method_at(m), tolerance_for(method_at(m)), 1, 0, 10);
        double proposal = 0;
        for (int i = 1; i <= 30; i++) {
            double limit = 0.1 * i + 1e-7 * (i % 3);
            run_to(&run, limit);
            if (i == 20) proposal = run.h;
        }
        /* The cuts did not shrink the proposals: they are still of the size of free steps. */
        assert_true(run.h > 0.2 * proposal);
        stepper_free(run.stepper);
    }
}

static void no_sliver_is_left_before_the_limit(void **state)
{
    (void)state;
    struct scene scene = {.omega = 1, .force = 1};
    struct run run;
    start(&run, &scene, method_find("dop853"), 1e-8, 1, 0, 10);
    run.h = 0.1;
    assert_int_equal(step(&run, 0.1005), stepper_ok); /* 0.5 % more than the step: stretched */
    assert_true(run.t == 0.1005);
    run.h = 0.1;
    assert_int_equal(step(&run, 0.1005 + 0.102), stepper_ok); /* 2 % more: two halves */
    assert_true(fabs(run.t - 0.1515) < 1e-12);
    assert_true(run.h >= 0.1);
    stepper_free(run.stepper);
}

static void steps_of_fixed_size_are_what_they_say(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        if (method_at(m)->multistep) continue; /* their order stays at 1 for a while: no closed statement */
        struct scene scene = {.omega = 1, .force = 1};
        struct run run;
        struct stepper_options options = {.method = method_at(m),
                                          .layout = {.pairs = 1},
                                          .tolerance = 1e-10,
                                          .h_fixed = 0.125};
        double error[2];
        for (int k = 0; k < 2; k++) {
            start_with(&run, &scene, &options, 0, 1, 0, 4);
            run_to(&run, 4);
            assert_int_equal(stepper_get_counts(run.stepper)->accepted, k == 0 ? 32 : 64);
            error[k] = deviation(run.y, 4);
            stepper_free(run.stepper);
            options.h_fixed /= 2;
        }
        /* Above order 8 rounding is all that is left; below, halving h shows the order (8: near rounding
         * already). */
        int order = method_at(m)->order;
        if (order < 8) assert_true(fabs(log2(error[0] / error[1]) - order) < 0.75);
        if (order >= 8) assert_true(error[1] < 1e-12);
    }
}

static void no_step_is_larger_than_the_bound(void **state)
{
    (void)state;
    struct scene scene = {0};
    struct run run;
    struct stepper_options options = {.method = method_find("dop853"),
                                      .layout = {.pairs = 1},
                                      .tolerance = 1e-6,
                                      .h_max = 0.3};
    start_with(&run, &scene, &options, 0, 1, 1, 100);
    while (run.t < 100) {
        double t0 = run.t;
        assert_int_equal(step(&run, 100), stepper_ok);
        assert_true(run.t - t0 <= 0.303 * (1 + 4 * DBL_EPSILON)); /* 1 % at the end */
    }
    stepper_free(run.stepper);
}

/* The same oscillator in other units, by powers of two: the same steps and digits. GSL's implicit methods
 * choose pivots by size, which depends on units, and so round differently; bsimp limits the growth of y by
 * numbers of its own. */
static void steps_do_not_depend_on_units(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        const struct method *method = method_at(m);
        if (method->implicit) continue;
        struct scene one = {.omega = 1, .c = 0.1}, other = {.omega = 0x1p-20, .c = 0.1 * 0x1p-20};
        struct run a, b;
        start(&a, &one, method, tolerance_for(method), 1, 0.5, 0x1p3);
        start(&b, &other, method, tolerance_for(method), 0x1p30, 0.5 * 0x1p10, 0x1p23);
        while (a.t < 0x1p3) {
            assert_int_equal(step(&a, 0x1p3), stepper_ok);
            assert_int_equal(step(&b, 0x1p23), stepper_ok);
            assert_true(b.t == a.t * 0x1p20 && b.y[0] == a.y[0] * 0x1p30 && b.y[1] == a.y[1] * 0x1p10);
        }
        stepper_free(a.stepper);
        stepper_free(b.stepper);
    }
}

/* All methods, in kilograms of 1e-9 and 1e12 so to speak: y in units of 1e-9 and 1e12, time in 1e-3 and
 * 1e3.
 */
static void accuracy_does_not_depend_on_units(void **state)
{
    (void)state;
    const double lengths[] = {1e-9, 1e12}, times[] = {1e-3, 1e3};
    for (size_t m = 0; method_at(m); m++) {
        for (int k = 0; k < 2; k++) {
            const struct method *method = method_at(m);
            double length = lengths[k], time = times[k];
            struct scene scene = {.omega = 1 / time};
            struct run run;
            start(&run, &scene, method, tolerance_for(method), length, 0, 8 * time);
            run_to(&run, 8 * time);
            double error = fmax(fabs(run.y[0] / length - cos(8)), fabs(run.y[1] / length * time + sin(8)));
            assert_true(error <
                        8 * tolerance_for(method) * (double)stepper_get_counts(run.stepper)->accepted);
            stepper_free(run.stepper);
        }
    }
}

static void looking_into_steps_changes_none(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        struct scene scene = {.omega = 1, .force = 1};
        struct run quiet, watched;
        start(&quiet, &scene, method_at(m), tolerance_for(method_at(m)), 1, 0, 5);
        start(&watched, &scene, method_at(m), tolerance_for(method_at(m)), 1, 0, 5);
        while (quiet.t < 5) {
            double t0 = quiet.t, y[2], f[2];
            assert_int_equal(step(&quiet, 5), stepper_ok);
            assert_int_equal(step(&watched, 5), stepper_ok);
            assert_true(quiet.t == watched.t && quiet.h == watched.h);
            assert_memory_equal(quiet.y, watched.y, sizeof quiet.y);
            for (int k = 0; k <= 4; k++) {
                assert_int_equal(stepper_dense(watched.stepper, time_dd_at(t0 + (watched.t - t0) * k / 4), y),
                                 GSL_SUCCESS);
                assert_int_equal(stepper_partial(watched.stepper, time_dd_at(t0 + (watched.t - t0) * k / 4),
                                                 y, f),
                                 GSL_SUCCESS);
            }
            assert_memory_equal(y, watched.y, sizeof y);
            assert_memory_equal(f, watched.f, sizeof f);
            assert_int_equal(stepper_dense(watched.stepper, time_dd_at(nextafter(watched.t, 1e9)), y),
                             GSL_EINVAL);
        }
        stepper_free(quiet.stepper);
        stepper_free(watched.stepper);
    }
}

static void an_angle_stays_accurate_over_a_million_revolutions(void **state)
{
    (void)state;
    const bool angle[1] = {true};
    struct scene scene = {.c = 1e-8};
    struct run run;
    struct stepper_options options = {.method = method_find("dop853"),
                                      .layout = {1, 0, angle},
                                      .tolerance = 1e-10,
                                      .h_max = 1e3};
    const double end = 1e6, rate = 2 * 3.14159265358979;
    start_with(&run, &scene, &options, 0, 0, rate, end);
    run_to(&run, end);
    double expected = -rate / 1e-8 * expm1(-1e-8 * end);
    /* 1e-10 rad for each of 1000 steps, and half an ulp of the angle (5e-10 rad) for each. */
    assert_true(fabs(run.y[0] - expected) < 1000 * (1e-10 + 5e-10));
    stepper_free(run.stepper);
}

static void work_is_counted_honestly(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        struct scene scene = {.omega = 1, .force = 1};
        struct run run;
        start(&run, &scene, method_at(m), tolerance_for(method_at(m)), 1, 0, 5);
        run_to(&run, 5);
        const struct stepper_counts *counts = stepper_get_counts(run.stepper);
        assert_int_equal(run.system.rhs, scene.calls);
        bool implicit = method_at(m)->implicit, guarded = method_at(m)->stable > 0;
        assert_true((run.system.jacobians > 0) == (implicit || guarded));
        if (guarded) assert_true(run.system.jacobians <= 5 + counts->accepted / 8);
        if (!implicit && method_at(m)->stable == 0 && !method_at(m)->multistep)
            assert_int_equal(run.system.rhs, 2 + (strcmp(method_at(m)->name, "rk8pd") == 0 ? 13 : 12) *
                                                     (counts->accepted + counts->rejected[rejected_error]));
        stepper_free(run.stepper);
    }
}

/* Over every step 400 samples: what they cost, and how far they are from the steps that end there, of which
 * they are known to a hundredth of the tolerance. The stiff scene begins with a layer that its first step
 * leaps over: no polynomial follows that. At a tolerance of its roundings (bsimp's, which extrapolation makes
 * large) a step is no smoother than these, and its points do. */
enum sampled { smooth, layer, rounded };

static void sample_steps(const struct method *method, enum sampled which)
{
    enum { samples = 400, most_points = 45 };
    static const char *const names[] = {"smooth", "layer", "rounded"};
    const double force[] = {1, 0, 0}, omega[] = {1, 1e4, 1e4}, damping[] = {0, 2e4, 0}, fixed[] = {0, 0.1, 0};
    struct scene scene = {.omega = omega[which], .c = damping[which], .force = force[which]};
    struct run run;
    double tolerance = which == rounded ? 1e-13 : tolerance_for(method), worst = 0, v_most = 1;
    long most = 0;
    const struct stepper_options options = {.method = method,
                                            .layout = {.pairs = 1},
                                            .tolerance = tolerance,
                                            .h_fixed = fixed[which]};
    start_with(&run, &scene, &options, 0, 1, 0, 1);
    for (int k = 0; k < 30 && run.t < 1; k++) {
        double t0 = run.t, y[2], exact[2], f[2];
        assert_int_equal(step(&run, 1), stepper_ok);
        v_most = fmax(v_most, fabs(run.y[1]));
        long before = scene.calls, redone = 0;
        for (int i = 0; i < samples; i++) {
            struct time_dd t = time_dd_at(t0 + (run.t - t0) * (i + 0.37) / samples);
            assert_int_equal(stepper_dense(run.stepper, t, y), GSL_SUCCESS);
            if (i % 40 != 0) continue;
            long calls = scene.calls;
            assert_int_equal(stepper_partial(run.stepper, t, exact, f), GSL_SUCCESS);
            redone += scene.calls - calls;
            worst = fmax(worst, fmax(fabs(y[0] - exact[0]), fabs(y[1] - exact[1]) / v_most));
        }
        most = (long)fmax((double)most, (double)(scene.calls - before - redone) / ((double)redone / 10));
    }
    print_message("# %-7s %-6s samples cost %ld steps at most, off by %.1g tolerances\n", method->name,
                  names[which], most, worst / tolerance);
    assert_true(worst <= (which == rounded ? 10 : 0.02) * tolerance);
    assert_true(which == layer ? most >= samples : most <= most_points);
    stepper_free(run.stepper);
}

static void samples_of_an_implicit_step_are_no_steps(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        const struct method *method = method_at(m);
        if (!method->implicit || method->multistep || strcmp(method->name, "rodas5p") == 0) continue;
        sample_steps(method, smooth);
        sample_steps(method, layer);
        if (strcmp(method->name, "bsimp") == 0) sample_steps(method, rounded);
    }
}

/* One step over a third of a period, of fixed size, walked through at 50 places, forwards and then backwards:
 * as exact as the tolerance asks for, whatever that step is, and the same bits both times, where the second
 * time a place costs no more than a step. */
static void a_step_is_walked_through_once(void **state)
{
    (void)state;
    enum { places = 50, dearest = 300 };
    for (size_t m = 0; method_at(m); m++) {
        const struct method *method = method_at(m);
        struct scene scene = {.omega = 1, .force = 1};
        double tolerance = method->order == 1 ? 1e-2 : tolerance_for(method), first[places][2], worst = 0;
        const struct stepper_options options = {.method = method,
                                                .layout = {.pairs = 1},
                                                .tolerance = tolerance,
                                                .h_fixed = 2};
        struct run run;
        start_with(&run, &scene, &options, 0, 1, 0, 2);
        double y[2], f[2];
        if (step(&run, 2) != stepper_ok || method->multistep) {
            assert_int_equal(stepper_walk(run.stepper, time_dd_at(1), y, f), GSL_EINVAL);
            stepper_free(run.stepper);
            continue;
        }
        for (int i = 0; i < places; i++) {
            double t = run.t * (i + 0.5) / places;
            assert_int_equal(stepper_walk(run.stepper, time_dd_at(t), first[i], f), GSL_SUCCESS);
            worst = fmax(worst, deviation(first[i], t));
        }
        long calls = scene.calls;
        for (int i = places - 1; i >= 0; i--) {
            assert_int_equal(stepper_walk(run.stepper, time_dd_at(run.t * (i + 0.5) / places), y, f),
                             GSL_SUCCESS);
            assert_memory_equal(y, first[i], sizeof y);
            assert_true(f[0] == y[1]);
        }
        print_message("# %-7s off by %.1g tolerances, %ld calls a place\n", method->name, worst / tolerance,
                      (scene.calls - calls) / places);
        assert_true(worst <= 50 * tolerance);
        assert_true(scene.calls - calls <= (long)places * dearest);
        stepper_free(run.stepper);
    }
}

static int decay(double t, const double y[], double dydt[], void *rate)
{
    (void)t;
    dydt[0] = -*(const double *)rate * y[0];
    return GSL_SUCCESS;
}

/* |y1 / y0| of a step of size 1 of y' = -rate y. */
static double growth(const struct method *method, double rate)
{
    double y = 1, error;
    gsl_odeiv2_step *step = gsl_odeiv2_step_alloc(*method->type, 1);
    gsl_odeiv2_system system = {decay, NULL, 1, &rate};
    assert_int_equal(gsl_odeiv2_step_apply(step, 0, 1, &y, &error, NULL, NULL, &system), GSL_SUCCESS);
    gsl_odeiv2_step_free(step);
    return fabs(y);
}

static void limits_of_stability_are_where_the_table_says(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        const struct method *method = method_at(m);
        if (method->stable == 0 || method->multistep) continue;
        assert_true(growth(method, method->stable - 0.01) < 1);
        assert_true(growth(method, method->stable + 0.01) > 1);
    }
}

static void methods_are_found_by_name(void **state)
{
    (void)state;
    const char *names[] = {"dop853", "rk2",    "rk4",   "rkf45",   "rkck",  "rk8pd",  "rk1imp",
                           "rk2imp", "rk4imp", "bsimp", "msadams", "msbdf", "rodas5p"};
    size_t count = 0;
    while (method_at(count)) count++;
    assert_int_equal(count, sizeof names / sizeof *names);
    for (size_t i = 0; i < count; i++) {
        const struct method *method = method_find(names[i]);
        assert_non_null(method);
        assert_string_equal((*method->type)->name, names[i]);
    }
    assert_string_equal(method_at(0)->name, "rk8pd");
    assert_null(method_find("euler"));
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(methods_are_found_by_name),
        cmocka_unit_test(limits_of_stability_are_where_the_table_says),
        cmocka_unit_test(every_method_reaches_its_accuracy_at_the_ends_and_within),
        cmocka_unit_test(a_pendulum_keeps_its_energy),
        cmocka_unit_test(multistep_methods_go_on_after_a_reset),
        cmocka_unit_test(it_lands_exactly_on_the_limit),
        cmocka_unit_test(no_sliver_is_left_before_the_limit),
        cmocka_unit_test(steps_of_fixed_size_are_what_they_say),
        cmocka_unit_test(no_step_is_larger_than_the_bound),
        cmocka_unit_test(steps_do_not_depend_on_units),
        cmocka_unit_test(accuracy_does_not_depend_on_units),
        cmocka_unit_test(looking_into_steps_changes_none),
        cmocka_unit_test(an_angle_stays_accurate_over_a_million_revolutions),
        cmocka_unit_test(work_is_counted_honestly),
        cmocka_unit_test(samples_of_an_implicit_step_are_no_steps),
        cmocka_unit_test(a_step_is_walked_through_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
