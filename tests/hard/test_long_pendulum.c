/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A pendulum over 10 000 swings of 60 degrees; energy and phase errors and how they grow, for every method.
 *
 * What makes it hard: what a method does to the energy in each step adds up, changes the period, and so
 * shifts the phase with the square of the time.
 *
 * Reference: T = 2 pi sqrt(L/g)/M(1, cos(theta0/2)), M the arithmetic-geometric mean; a quarter period after
 * n whole ones it passes the bottom with omega = -2 sqrt(g/L) sin(theta0/2).
 *
 * So that the suite stays short, all but the default swing 2000 times, those of order 2 and 3 500 times, and fewer under a
 * sanitizer; FBD_DRAWS=5 is five times as many.
 * Implicit Euler damps: at 1e-5 it loses the swing in some hundred periods whatever the tolerance allows in
 * one step; its 10 swings are the limit that is held.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double pi = 3.14159265358979323846, g = 9.81;

static double period(double theta0)
{
    double a = 1, b = cos(theta0 / 2);
    for (int i = 0; i < 8; i++) {
        double mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
    }
    return 2 * pi / sqrt(g) / a;
}

struct drift {
    double energy; /* relative to the depth of the swing */
    double phase;  /* as a time [s] */
};

static struct drift drift_after(struct trial *trial, int swings)
{
    double theta0 = pi / 3;
    trial_to(trial, (swings + 0.25) * period(theta0));
    double theta = trial_get(trial, "theta"), omega = trial_get(trial, "omega");
    double energy = omega * omega / 2 - g * cos(theta) + g * cos(theta0);
    return (struct drift){fabs(energy) / (g * (1 - cos(theta0))), fabs(theta / omega)};
}

/* An error of theta by the tolerance times a radian, and one of omega by it times 3 rad/s, change the energy
 * by up to 4 tolerances of its depth. A change of energy changes the period by 0.08 as much, relatively (60
 * degrees), and has half of the time on average to act. That is what a method may do at worst. The default
 * chooses its steps for an estimate of 0.7^8 = 1/17 of the tolerance (step_law_for) and is held to twice
 * that. It is all truncation: both errors fall with the tolerance down to 1e-14 (1.7e-6, 1.3e-8 and 8e-11 of
 * the energy at 1e-10, 1e-12 and 1e-14), and rounding is carried along by dop853. */
static void check_swings(struct checks *checks, const struct hard_method *method)
{
    const bool is_default = !method->name && !method->no_structure && thorough();
    int swings = method->order < 2 ? 10 : is_default ? 10000 : draws_of(method->order >= 4 ? 2000 : 500);
    struct trial trial = trial_open("hard/long_pendulum.yaml", NULL);
    hard_start(&trial, method, 21800);
    struct drift half = drift_after(&trial, swings / 2), full = drift_after(&trial, swings);
    double promise = hard_promise(&trial);
    if (!method->name) promise *= 2 * pow(0.7, 8);
    double energy = 2 * promise, phase = promise + 0.04 * energy * swings * period(pi / 3);
    printf("# %d swings, twice as long is %.2g times the energy error, %.2g times the phase error:\n", swings,
           full.energy / half.energy, full.phase / half.phase);
    hard_case(checks, &trial, "  energy", full.energy, energy);
    hard_case(checks, &trial, "  phase [s]", full.phase, phase);
    trial_close(&trial);
}

static void errors_grow_no_faster_than_they_must(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) check_swings(&checks, &method);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_grow_no_faster_than_they_must),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
