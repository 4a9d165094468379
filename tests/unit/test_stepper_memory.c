/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Steppers when memory runs out. Of GSL's own methods msadams is left out: it loses memory of its own on that
 * way (GSL 2.7.1).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>

#include "fail_alloc.h"
#include "integrate/stepper.h"

static void a_stepper_is_made_whole_or_not_at_all(void **state)
{
    (void)state;
    const bool angle[2] = {true, false};
    for (size_t m = 0; method_at(m); m++) {
        if (strcmp(method_at(m)->name, "msadams") == 0) continue;
        struct stepper_options options = {.method = method_at(m), .layout = {2, 1, angle}, .tolerance = 1e-6};
        for (size_t n = 0;; n++) {
            fail_alloc_at(n);
            struct stepper *stepper = stepper_alloc(&options);
            bool failed = fail_alloc_end();
            assert_true(failed == (stepper == NULL));
            stepper_free(stepper);
            if (!failed) break;
        }
    }
}

static int fall(double t, const double y[], double f[], void *params)
{
    (void)t, (void)params;
    f[0] = y[1];
    f[1] = -9.81;
    return GSL_SUCCESS;
}

static int slopes(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    (void)t, (void)y, (void)params;
    dfdy[0] = dfdy[2] = dfdy[3] = 0;
    dfdy[1] = 1;
    dfdt[0] = dfdt[1] = 0;
    return GSL_SUCCESS;
}

static void a_run_takes_no_memory(void **state)
{
    (void)state;
    gsl_odeiv2_system inner = {.function = fall, .jacobian = slopes, .dimension = 2};
    struct counted_system system;
    counted_system_init(&system, &inner);
    for (size_t m = 0; method_at(m); m++) {
        struct stepper_options options = {.method = method_at(m), .layout = {.pairs = 1}, .tolerance = 1e-6};
        struct stepper *stepper = stepper_alloc(&options);
        struct time_dd t = time_dd_at(0), end = time_dd_at(1);
        double h, y[2] = {0, 3}, f[2], z[2];
        fail_alloc_from(0);
        int code = stepper_reset(stepper, &system, t, y, f, end, &h);
        while (code == GSL_SUCCESS && t.t < 1) {
            double t0 = t.t;
            code = (int)stepper_step(stepper, &system, &t, y, f, &h, end);
            if (code == GSL_SUCCESS) code = stepper_dense(stepper, time_dd_at((t0 + t.t) / 2), z);
            if (code == GSL_SUCCESS) code = stepper_partial(stepper, time_dd_at((t0 + t.t) / 2), z, f);
            if (code == GSL_SUCCESS) code = fall(t.t, y, f, NULL);
        }
        size_t asked = fail_alloc_count();
        fail_alloc_end();
        assert_int_equal(code, GSL_SUCCESS);
        assert_int_equal(asked, 0);
        stepper_free(stepper);
    }
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stepper_is_made_whole_or_not_at_all),
        cmocka_unit_test(a_run_takes_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
