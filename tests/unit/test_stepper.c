/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The body of the integration loop with every method: accuracy, rejections, failures that leave nothing
 * behind, landing on times, looking into a step.
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

#include "solve/stepper.h"
#include "solve/weights.h"

/* q'' = -omega^2 q - c v + g + force cos(2 t), and what may go wrong with it. */
struct scene {
    double omega, c, g, force;
    double trouble;  /* from this time on (if above 0) */
    int code;        /* ... the right-hand side returns this, */
    bool not_finite; /* ... or a NaN */
    long calls;
};

static int rhs(double t, const double y[], double f[], void *params)
{
    struct scene *scene = params;
    scene->calls++;
    bool trouble = scene->trouble > 0 && t >= scene->trouble;
    f[0] = y[1];
    f[1] = -scene->omega * scene->omega * y[0] - scene->c * y[1] + scene->g + scene->force * cos(2 * t);
    if (trouble && scene->not_finite) f[1] = NAN;
    return trouble ? scene->code : GSL_SUCCESS;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    const struct scene *scene = params;
    (void)y;
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -scene->omega * scene->omega;
    dfdy[3] = -scene->c;
    dfdt[0] = 0;
    dfdt[1] = -2 * scene->force * sin(2 * t);
    return GSL_SUCCESS;
}

/* A stepper with its system and present state. */
struct run {
    gsl_odeiv2_system inner;
    struct counted_system system;
    struct stepper *stepper;
    double t, h, y[2], f[2];
};

static void start_with(struct run *run, struct scene *scene, const struct stepper_options *options, double t,
                       double q, double v, double t_limit)
{
    run->inner = (gsl_odeiv2_system){rhs, jacobian, 2, scene};
    counted_system_init(&run->system, &run->inner);
    run->stepper = stepper_alloc(options);
    assert_non_null(run->stepper);
    run->t = t;
    run->y[0] = q;
    run->y[1] = v;
    assert_int_equal(stepper_reset(run->stepper, &run->system, t, run->y, run->f, t_limit, &run->h),
                     GSL_SUCCESS);
}

static void start(struct run *run, struct scene *scene, const struct method *method, double tolerance,
                  double q, double v, double t_limit)
{
    struct stepper_options options = {.method = method, .layout = {.pairs = 1}, .tolerance = tolerance};
    start_with(run, scene, &options, 0, q, v, t_limit);
}

static enum stepper_status step(struct run *run, double t_limit)
{
    return stepper_step(run->stepper, &run->system, &run->t, run->y, run->f, &run->h, t_limit);
}

static void run_to(struct run *run, double t_limit)
{
    while (run->t < t_limit) assert_int_equal(step(run, t_limit), stepper_ok);
    assert_true(run->t == t_limit);
}

/* q'' = -q + cos 2t from q = 1, v = 0. */
static double forced_q(double t)
{
    return (4 * cos(t) - cos(2 * t)) / 3;
}

static double forced_v(double t)
{
    return (-4 * sin(t) + 2 * sin(2 * t)) / 3;
}

static double deviation(const double y[2], double t)
{
    return fmax(fabs(y[0] - forced_q(t)), fabs(y[1] - forced_v(t)));
}

/* Tolerances for which each method takes a bearable number of steps. */
static double tolerance_for(const struct method *method)
{
    return method->order >= 4 ? 1e-8 : method->order >= 2 ? 1e-6 : 1e-4;
}

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
                assert_int_equal(stepper_dense(run.stepper, t, y), GSL_SUCCESS);
                within = fmax(within, deviation(y, t));
                assert_int_equal(stepper_partial(run.stepper, t, y, f), GSL_SUCCESS);
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

/* Its energy v^2 / 2 - 9.81 cos q stays: at a tolerance t, a step changes it by v dv + 9.81 sin q dq < 20 t +
 * 20 t. */
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
        double t = 0, h, y[2] = {2, 0}, f[2];
        assert_int_equal(stepper_reset(stepper, &system, t, y, f, 10, &h), GSL_SUCCESS);
        while (t < 10) assert_int_equal(stepper_step(stepper, &system, &t, y, f, &h, 10), stepper_ok);
        double gain = y[1] * y[1] / 2 - 9.81 * (cos(y[0]) - cos(2));
        unsigned long steps = stepper_get_counts(stepper)->accepted;
        assert_true(fabs(gain) < 40 * options.tolerance * (double)steps);
        stepper_free(stepper);
    }
}

static void a_step_far_too_large_is_rejected_until_it_is_right(void **state)
{
    (void)state;
    for (size_t m = 0; method_at(m); m++) {
        const struct method *method = method_at(m);
        struct scene scene = {.omega = 1, .force = 1};
        struct run run;
        double tolerance = tolerance_for(method);
        start(&run, &scene, method, tolerance, 1, 0, 8);
        run_to(&run, 1);
        const struct stepper_counts *counts = stepper_get_counts(run.stepper);
        unsigned long before = counts->rejected[rejected_error] + counts->rejected[rejected_iteration];
        run.h = method->order > 8 && !method->multistep ? 7 : 3; /* bsimp would take 3 */
        assert_int_equal(step(&run, 8), stepper_ok);
        unsigned long after = counts->rejected[rejected_error] + counts->rejected[rejected_iteration];
        assert_true(after > before || run.h > 1);
        if (method->order <= 8 || method->multistep) assert_true(after > before);
        run_to(&run, 8);
        assert_true(deviation(run.y, 8) < 8 * tolerance * (double)counts->accepted);
        stepper_free(run.stepper);
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
            assert_int_equal(stepper_reset(run.stepper, &run.system, run.t, run.y, run.f, 20, &run.h),
                             GSL_SUCCESS);
            if (i % 2 == 0) {
                /* One period of time 1 of the kicked oscillator: dq = sin 1, dv = cos 1. */
                assert_true(fabs(run.y[0] - q - sin(1)) < 1e-5 && fabs(run.y[1] - v - cos(1)) < 1e-5);
                run.y[0] = q;
                run.y[1] = v;
                assert_int_equal(stepper_reset(run.stepper, &run.system, run.t, run.y, run.f, 20, &run.h), 0);
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

static void trouble_leaves_the_state_bit_for_bit(void **state)
{
    (void)state;
    const struct {
        int code;
        bool not_finite;
        enum stepper_status status;
        enum rejection why;
    } cases[] = {
        {GSL_EBADFUNC, false, stepper_bad_function, rejection_kinds},
        {GSL_EDOM, false, stepper_underflow, rejected_rhs},
        {GSL_SUCCESS, true, stepper_underflow, rejected_not_finite},
    };
    for (size_t c = 0; c < 3; c++) {
        for (size_t m = 0; method_at(m); m++) {
            struct scene scene = {.omega = 1,
                                  .force = 1,
                                  .trouble = 1,
                                  .code = cases[c].code,
                                  .not_finite = cases[c].not_finite};
            struct run run;
            start(&run, &scene, method_at(m), tolerance_for(method_at(m)), 1, 0, 2);
            enum stepper_status status;
            double t, h, y[2], f[2];
            do {
                t = run.t;
                h = run.h;
                memcpy(y, run.y, sizeof y);
                memcpy(f, run.f, sizeof f);
                status = step(&run, 2);
            } while (status == stepper_ok);
            assert_int_equal(status, cases[c].status);
            assert_true(run.t == t && run.h == h);
            assert_memory_equal(run.y, y, sizeof y);
            assert_memory_equal(run.f, f, sizeof f);
            assert_true(t < 1);
            assert_true(run.system.last_time >= 1);
            if (cases[c].not_finite) assert_int_equal(run.system.last_element, 1);
            if (status == stepper_underflow) {
                assert_int_equal(stepper_get_counts(run.stepper)->last, cases[c].why);
                assert_true(1 - t < 1e-10); /* as near as the numbers allow */
            }
            assert_int_equal(stepper_dense(run.stepper, t, y), GSL_EINVAL);
            stepper_free(run.stepper);
        }
    }
}

static int blow_up(double t, const double y[], double f[], void *params)
{
    (void)t, (void)params;
    f[0] = y[0] * y[0];
    return GSL_SUCCESS;
}

static int blow_up_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    (void)t, (void)params;
    dfdy[0] = 2 * y[0];
    dfdt[0] = 0;
    return GSL_SUCCESS;
}

/* y' = y^2, y = 1 / (1 - t). The relative error at the end of the steps grows like that of 1 - t. */
static void a_blow_up_ends_in_underflow_at_its_time(void **state)
{
    (void)state;
    const char *names[] = {"dop853", "rk8pd", "rkf45", "rk4", "msadams", "msbdf", "rk4imp"};
    for (size_t m = 0; m < sizeof names / sizeof *names; m++) {
        gsl_odeiv2_system inner = {blow_up, blow_up_jacobian, 1, NULL};
        struct counted_system system;
        counted_system_init(&system, &inner);
        struct stepper_options options = {.method = method_find(names[m]),
                                          .layout = {.extra = 1},
                                          .tolerance = 1e-9};
        struct stepper *stepper = stepper_alloc(&options);
        double t = 0, h, y = 1, f, before = 1;
        assert_int_equal(stepper_reset(stepper, &system, t, &y, &f, 2, &h), GSL_SUCCESS);
        enum stepper_status status;
        while ((status = stepper_step(stepper, &system, &t, &y, &f, &h, 2)) == stepper_ok) before = y;
        assert_int_equal(status, stepper_underflow);
        assert_true(y == before && isfinite(y) && y > 1e6);
        assert_true(fabs(t - 1) < 1e-6);
        stepper_free(stepper);
    }
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
        for (int k = 0; k < 2; k++, options.h_fixed /= 2) {
            start_with(&run, &scene, &options, 0, 1, 0, 4);
            run_to(&run, 4);
            assert_int_equal(stepper_get_counts(run.stepper)->accepted, k == 0 ? 32 : 64);
            error[k] = deviation(run.y, 4);
            stepper_free(run.stepper);
        }
        /* Above order 8 rounding is all that is left; below, halving h shows the order (8: near rounding
         * already). */
        int order = method_at(m)->order;
        if (order < 8) assert_true(fabs(log2(error[0] / error[1]) - order) < 0.75);
        if (order >= 8) assert_true(error[1] < 1e-12);
    }
}

static void a_fixed_step_that_fails_is_not_made_smaller(void **state)
{
    (void)state;
    struct scene scene = {.omega = 1, .trouble = 0.6, .code = GSL_EDOM};
    struct run run;
    struct stepper_options options = {.method = method_find("rk4"),
                                      .layout = {.pairs = 1},
                                      .tolerance = 1e-6,
                                      .h_fixed = 0.25};
    start_with(&run, &scene, &options, 0, 1, 0, 4);
    assert_int_equal(step(&run, 4), stepper_ok);
    assert_int_equal(step(&run, 4), stepper_ok);
    double y[2];
    memcpy(y, run.y, sizeof y);
    assert_int_equal(step(&run, 4), stepper_fixed_failed);
    assert_true(run.t == 0.5);
    assert_memory_equal(run.y, y, sizeof y);
    assert_int_equal(stepper_get_counts(run.stepper)->last, rejected_rhs);
    stepper_free(run.stepper);
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

/* A mass of 1 kg hangs at rest on a spring of 100 N/m. Its acceleration is rounding noise of 1e-15 m/s^2. */
static void a_body_in_balance_costs_few_steps(void **state)
{
    (void)state;
    const char *names[] = {"dop853", "rk8pd", "rkf45"};
    for (size_t m = 0; m < 3; m++) {
        for (double g = 9.80665; g < 10; g += 0.017) {
            struct scene scene = {.omega = 10, .g = g};
            struct run run;
            start(&run, &scene, method_find(names[m]), 1e-9, g / 100, 0, 100);
            run_to(&run, 100);
            /* An oscillation of that frequency takes dop853 10 000 steps. */
            assert_true(stepper_get_counts(run.stepper)->accepted < 10000);
            assert_true(fabs(run.y[0] - g / 100) < 1e-13);
            stepper_free(run.stepper);
        }
    }
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

/* All methods, in kilograms of 1e-9 and 1e12 so to speak: y in units of 1e-9 and 1e12, time in 1e-3 and 1e3.
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
                assert_int_equal(stepper_dense(watched.stepper, t0 + (watched.t - t0) * k / 4, y),
                                 GSL_SUCCESS);
                assert_int_equal(stepper_partial(watched.stepper, t0 + (watched.t - t0) * k / 4, y, f),
                                 GSL_SUCCESS);
            }
            assert_memory_equal(y, watched.y, sizeof y);
            assert_memory_equal(f, watched.f, sizeof f);
            assert_int_equal(stepper_dense(watched.stepper, nextafter(watched.t, 1e9), y), GSL_EINVAL);
        }
        stepper_free(quiet.stepper);
        stepper_free(watched.stepper);
    }
}

/* k = 1e8 N/m, m = 1 kg, critically damped, pulled along by a force cos 2t: q = cos 2t / k up to 4e-8 of it,
 * h |lambda| up to 1e4. What is read between the steps must be as good as the steps, for every method that
 * can do it at all. */
static void stiff_steps_can_be_looked_into(void **state)
{
    (void)state;
    const char *names[] = {"msbdf", "rk4imp", "rk2imp", "bsimp"};
    for (size_t m = 0; m < 4; m++) {
        struct scene scene = {.omega = 1e4, .c = 2e4, .force = 1e8};
        struct run run;
        start(&run, &scene, method_find(names[m]), 1e-5, 1, 0, 6);
        double ends = 0, within = 0;
        while (run.t < 6) {
            double t0 = run.t, y[2];
            assert_int_equal(step(&run, 6), stepper_ok);
            if (t0 < 0.1) continue;
            /* q lags by c / k = 2e-4 s. */
            ends = fmax(ends, fabs(run.y[0] - cos(2 * (run.t - 2e-4))));
            for (int k = 1; k < 8; k++) {
                double t = t0 + (run.t - t0) * k / 8;
                assert_int_equal(stepper_dense(run.stepper, t, y), GSL_SUCCESS);
                within = fmax(within, fabs(y[0] - cos(2 * (t - 2e-4))));
            }
        }
        print_message("# %s: %lu steps, error %.1e at their ends, %.1e within\n", names[m],
                      stepper_get_counts(run.stepper)->accepted, ends, within);
        assert_true(ends < 1e-4 && within < 2 * ends + 1e-6);
        stepper_free(run.stepper);
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

static void misuse_is_refused(void **state)
{
    (void)state;
    struct scene scene = {.omega = 1};
    struct run run;
    start(&run, &scene, method_find("dop853"), 1e-6, 1, 0, 1);
    double y[2], f[2];
    assert_int_equal(stepper_dense(run.stepper, 0, y), GSL_EINVAL);
    assert_int_equal(stepper_partial(run.stepper, 0, y, f), GSL_EINVAL);
    assert_int_equal(step(&run, 0), stepper_misuse);
    assert_int_equal(step(&run, -1), stepper_misuse);
    run.h = NAN;
    assert_int_equal(step(&run, 1), stepper_misuse);
    assert_int_equal(stepper_reset(run.stepper, &run.system, 1, run.y, run.f, 1, &run.h), GSL_EINVAL);
    stepper_free(run.stepper);

    start(&run, &scene, method_find("msbdf"), 1e-6, 1, 0, 1);
    run.system.gsl.jacobian = NULL;
    assert_int_equal(step(&run, 1), stepper_misuse);
    stepper_free(run.stepper);

    struct stepper_options options = {.method = method_find("dop853"), .layout = {.pairs = 1}};
    assert_null(stepper_alloc(&options)); /* tolerance 0 */
    options.tolerance = 1e-6;
    options.h_fixed = -1;
    assert_null(stepper_alloc(&options));
    options = (struct stepper_options){.method = method_find("dop853"), .tolerance = 1e-6};
    assert_null(stepper_alloc(&options)); /* no components */
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
        assert_true((run.system.jacobians > 0) == method_at(m)->implicit);
        if (strcmp(method_at(m)->name, "dop853") == 0)
            assert_int_equal(run.system.rhs, 2 + 12 * (counts->accepted + counts->rejected[rejected_error]));
        stepper_free(run.stepper);
    }
}

static void methods_are_found_by_name(void **state)
{
    (void)state;
    const char *names[] = {"dop853", "rk2",    "rk4",    "rkf45", "rkck",    "rk8pd",
                           "rk1imp", "rk2imp", "rk4imp", "bsimp", "msadams", "msbdf"};
    size_t count = 0;
    while (method_at(count)) count++;
    assert_int_equal(count, sizeof names / sizeof *names);
    for (size_t i = 0; i < count; i++) {
        const struct method *method = method_find(names[i]);
        assert_non_null(method);
        assert_string_equal((*method->type)->name, names[i]);
    }
    assert_string_equal(method_at(0)->name, "dop853");
    assert_null(method_find("euler"));
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(methods_are_found_by_name),
        cmocka_unit_test(every_method_reaches_its_accuracy_at_the_ends_and_within),
        cmocka_unit_test(a_pendulum_keeps_its_energy),
        cmocka_unit_test(a_step_far_too_large_is_rejected_until_it_is_right),
        cmocka_unit_test(multistep_methods_go_on_after_a_reset),
        cmocka_unit_test(it_lands_exactly_on_the_limit),
        cmocka_unit_test(no_sliver_is_left_before_the_limit),
        cmocka_unit_test(trouble_leaves_the_state_bit_for_bit),
        cmocka_unit_test(a_blow_up_ends_in_underflow_at_its_time),
        cmocka_unit_test(steps_of_fixed_size_are_what_they_say),
        cmocka_unit_test(a_fixed_step_that_fails_is_not_made_smaller),
        cmocka_unit_test(no_step_is_larger_than_the_bound),
        cmocka_unit_test(a_body_in_balance_costs_few_steps),
        cmocka_unit_test(steps_do_not_depend_on_units),
        cmocka_unit_test(accuracy_does_not_depend_on_units),
        cmocka_unit_test(looking_into_steps_changes_none),
        cmocka_unit_test(stiff_steps_can_be_looked_into),
        cmocka_unit_test(an_angle_stays_accurate_over_a_million_revolutions),
        cmocka_unit_test(misuse_is_refused),
        cmocka_unit_test(work_is_counted_honestly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
