/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A cart of a millionth of a kilogram with a pole, released level: each time the pole passes the vertical the
 * forces, and with them the rounding of accelerations, are some 1e9 times what they are a step later. What is
 * allowed to that rounding has to be that of the place: with what was known up to 64 steps before, rk8pd lost
 * 0.3 J of 10 J at a tolerance of 1e-10. And what the pole passes on to the cart there, sin^2 of a thousandth of a
 * radian, must not be a difference of ones: its acceleration had ten digits, which ended every method at 1e-9.
 *
 * Reference: N. Parsons, light cart-pole benchmark, proposed to the IFToMM library of multibody benchmarks.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "gallery.h"

static const char model[] = "fbd: 1\n"
                            "bodies:\n"
                            "  cart: {mass: 1e-6 kg, motion: slide, forces: [gravity]}\n"
                            "  pole:\n"
                            "    mass: 1 kg\n"
                            "    center: [0, -1 m]\n"
                            "    motion: {pivot: {on: cart}}\n"
                            "    initial: {theta: 90 deg}\n"
                            "    forces: [gravity]\n"
                            "simulate: {until: 10 s}\n";

/* The larger error of x and theta after 10 s; what is lost of the energy [J]. */
static double error_of(const char *method, double tolerance, double *lost)
{
    const double x = 1.99976328246162, theta = -1.549129441897076;
    struct trial trial = trial_parse(model);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = method;
    options.tolerance = tolerance;
    trial_run(&trial, &options);
    double at_x = NAN, at_theta = NAN;
    fbd_state *end = fbd_result_state(trial.result);
    assert_true(fbd_state_get(end, "cart.x", &at_x) && fbd_state_get(end, "pole.theta", &at_theta));
    double error = fmax(fabs(at_x - x), fabs(at_theta - theta));
    *lost = fabs(fbd_result_energy(trial.result).residual);
    trial_close(&trial);
    return error;
}

/* Rounding: some 1e4 steps, in which a rounding of the angle at the peak is 1e-13 of the rate. */
static const double rounding = 1e-10;

/* Ten times less tolerance is never more error, from 1e-6 on, by any method; the default one keeps what is asked of
 * it. The energy is kept to some tolerances, of 10 J that pass through the spike each half second. */
static void tighter_is_better(void **unused)
{
    (void)unused;
    static const char *const methods[] = {NULL, "rk8pd", "rkf45", "rkck", "rodas5p", "msadams"};
    struct checks checks = {0};
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        double before = HUGE_VAL;
        for (int digits = 6; digits <= 13; digits++) {
            double tolerance = pow(10, -digits), lost, error = error_of(methods[m], tolerance, &lost);
            print_message("# %-8s 1e-%d: error %.1e, lost %.1e J\n", methods[m] ? methods[m] : "auto", digits,
                          error, lost);
            check_that(&checks, "tighter is no worse", error <= fmax(before, rounding));
            check_that(&checks, "the energy is kept", lost <= 3e6 * tolerance);
            if (m == 0 && digits >= 10)
                check_that(&checks, "what is asked of the default method",
                           error <= 100 * tolerance + rounding);
            before = error;
        }
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tighter_is_better),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
