/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The body of the integration loop where it has a hard time: rejections, failures that leave nothing
 * behind, blow-up, stiffness, rest in a balance of forces, misuse.
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
#include "stepper_scene.h"

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
            assert_int_equal(stepper_dense(run.stepper, time_dd_at(t), y), GSL_EINVAL);
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
        struct time_dd t = time_dd_at(0), end = time_dd_at(2);
        double h, y = 1, f, before = 1;
        assert_int_equal(stepper_reset(stepper, &system, t, &y, &f, end, &h), GSL_SUCCESS);
        enum stepper_status status;
        while ((status = stepper_step(stepper, &system, &t, &y, &f, &h, end)) == stepper_ok) before = y;
        assert_int_equal(status, stepper_underflow);
        assert_true(y == before && isfinite(y) && y > 1e6);
        assert_true(fabs(t.t - 1) < 1e-6);
        stepper_free(stepper);
    }
}

static int growth(double t, const double y[], double f[], void *params)
{
    (void)t;
    f[0] = *(const double *)params * y[0];
    return GSL_SUCCESS;
}

static int growth_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    (void)t, (void)y;
    dfdy[0] = *(const double *)params;
    dfdt[0] = 0;
    return GSL_SUCCESS;
}

/* y' = k y by the exact method: the slope is beyond the largest double while y is not yet. Steps get shorter until
 * no time passes; of the same length they would be rejected for ever. */
static void exact_growth_ends_where_its_slope_does(void **state)
{
    (void)state;
    double rates[] = {1e3, 1e15};
    for (size_t k = 0; k < 2; k++) {
        gsl_odeiv2_system inner = {growth, growth_jacobian, 1, &rates[k]};
        struct counted_system system;
        counted_system_init(&system, &inner);
        const struct method exact = {
            .name = "linear", .type = &step_linear, .order = 8, .estimate_order = 8, .exact = true};
        struct stepper_options options = {.method = &exact, .layout = {.extra = 1}, .tolerance = 1e-9};
        struct stepper *stepper = stepper_alloc(&options);
        struct time_dd t = time_dd_at(0), end = time_dd_at(2);
        double h, y = 1, f;
        assert_int_equal(stepper_reset(stepper, &system, t, &y, &f, end, &h), GSL_SUCCESS);
        enum stepper_status status;
        while ((status = stepper_step(stepper, &system, &t, &y, &f, &h, end)) == stepper_ok)
            assert_true(isfinite(y) && isfinite(f));
        assert_int_equal(status, stepper_underflow);
        double expected = log(DBL_MAX / rates[k]) / rates[k];
        assert_true(fabs(t.t - expected) < 1e-5 * expected);
        stepper_free(stepper);
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

/* A mass of 1 kg hangs at rest on a spring of 100 N/m. Its acceleration is rounding noise of 1e-15 m/s^2. */
static void a_body_in_balance_costs_few_steps(void **state)
{
    (void)state;
    const char *names[] = {"dop853", "rk8pd", "rkf45"};
    for (size_t m = 0; m < 3; m++) {
        for (int i = 0; i < 12; i++) {
            const double g = 9.80665 + i * 0.017;
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

/* k = 1e8 N/m, m = 1 kg, critically damped, pulled along by a force cos 2t: q = cos 2t / k up to 4e-8 of
 * it, h |lambda| up to 1e4. What is read between the steps must be as good as the steps, for every method
 * that can do it at all. */
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
                assert_int_equal(stepper_dense(run.stepper, time_dd_at(t), y), GSL_SUCCESS);
                within = fmax(within, fabs(y[0] - cos(2 * (t - 2e-4))));
            }
        }
        print_message("# %s: %lu steps, error %.1e at their ends, %.1e within\n", names[m],
                      stepper_get_counts(run.stepper)->accepted, ends, within);
        assert_true(ends < 1e-4 && within < 2 * ends + 1e-6);
        stepper_free(run.stepper);
    }
}

/* A limit as near as two doubles can tell (the start of a pulse of 1e-15 s at t = 8 s), and as DBL_MIN, over
 * which an implicit method cannot divide: the step is made or given up, after some halvings. */
static void a_limit_next_to_nothing_away_ends_the_step(void **state)
{
    (void)state;
    const double rooms[] = {8 * DBL_EPSILON, 1e-20, 8 * DBL_EPSILON * DBL_EPSILON, 1e-300, DBL_MIN};
    for (size_t m = 0; method_at(m); m++)
        for (size_t k = 0; k < sizeof rooms / sizeof *rooms; k++) {
            const struct method *method = method_at(m);
            struct scene scene = {.omega = 1, .force = 1};
            struct run run;
            start(&run, &scene, method, tolerance_for(method), 1, 0, 9);
            run_to(&run, 8);
            struct time_dd t = time_dd_at(run.t), limit = {run.t, rooms[k]};
            double q = run.y[0];
            enum stepper_status status =
                stepper_step(run.stepper, &run.system, &t, run.y, run.f, &run.h, limit);
            bool resolved = rooms[k] >= 8 * DBL_EPSILON * DBL_EPSILON;
            assert_true(status == stepper_ok || (status == stepper_underflow && !resolved));
            assert_true(fabs(run.y[0] - q) <= 1e-12);
            stepper_free(run.stepper);
        }
}

static void misuse_is_refused(void **state)
{
    (void)state;
    struct scene scene = {.omega = 1};
    struct run run;
    start(&run, &scene, method_find("dop853"), 1e-6, 1, 0, 1);
    double y[2], f[2];
    assert_int_equal(stepper_dense(run.stepper, time_dd_at(0), y), GSL_EINVAL);
    assert_int_equal(stepper_partial(run.stepper, time_dd_at(0), y, f), GSL_EINVAL);
    assert_int_equal(step(&run, 0), stepper_misuse);
    assert_int_equal(step(&run, -1), stepper_misuse);
    run.h = NAN;
    assert_int_equal(step(&run, 1), stepper_misuse);
    assert_int_equal(stepper_reset(run.stepper, &run.system, time_dd_at(1), run.y, run.f, time_dd_at(1),
                                   &run.h),
                     GSL_EINVAL);
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

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_step_far_too_large_is_rejected_until_it_is_right),
        cmocka_unit_test(trouble_leaves_the_state_bit_for_bit),
        cmocka_unit_test(a_blow_up_ends_in_underflow_at_its_time),
        cmocka_unit_test(exact_growth_ends_where_its_slope_does),
        cmocka_unit_test(a_fixed_step_that_fails_is_not_made_smaller),
        cmocka_unit_test(a_body_in_balance_costs_few_steps),
        cmocka_unit_test(stiff_steps_can_be_looked_into),
        cmocka_unit_test(a_limit_next_to_nothing_away_ends_the_step),
        cmocka_unit_test(misuse_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
