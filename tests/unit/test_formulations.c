/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One system written in two ways moves in one way, and keeps its energy for long.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

/* The hardening spring of A08 (a): f = -k x - k3 x^3, V = k x^2/2 + k3 x^4/4, from 0.5 m at rest. */
static const double k = 100, k3 = 500, amplitude = 0.5, fastest = 6.37377439199098;
static const double energy_0 = 20.3125;
static const double period = 0.45363104893143447; /* A08.a_period */

static const fbd_options tight = {.until = 100 * 0.45363104893143447, .tolerance = 1e-12};

static double energy_by_hand(const struct trial *trial)
{
    double x = trial_get(trial, "x"), v = trial_get(trial, "v");
    return v * v / 2 + (k / 2 + k3 / 4 * x * x) * x * x;
}

static const char *const forms[] = {"energy/cubic_spring_force.yaml", "energy/cubic_spring_potential.yaml"};

static void a_force_and_its_potential_give_the_same_motion(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial force = trial_open(forms[0], NULL), potential = trial_open(forms[1], NULL);
    trial_start(&force, &tight);
    trial_start(&potential, &tight);
    for (int i = 1; i <= 400; i++) {
        double t = i * period / 4 * 0.999;
        trial_to(&force, t);
        trial_to(&potential, t);
        /* Two ways to round the same force, 1e-16 of it; the period of a hardening spring depends on the
         * energy, so the difference grows with the square of the number of periods, i.e. by 1e4. */
        const double rounding = 1e-16 * 1e4;
        check_close(&checks, "x", trial_get(&potential, "x"), trial_get(&force, "x"), rounding * amplitude);
        check_close(&checks, "v", trial_get(&potential, "v"), trial_get(&force, "v"), rounding * fastest);
    }
    trial_close(&force);
    trial_close(&potential);
    checks_end(&checks);
}

static void energy_stays_within_1e_10_over_100_periods(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (size_t f = 0; f < 2; f++) {
        struct trial trial = trial_open(forms[f], NULL);
        trial_start(&trial, &tight);
        double worst = 0;
        for (int i = 1; i <= 100 * 16; i++) {
            trial_to(&trial, i * period / 16 * 0.9999);
            worst = fmax(worst, fabs(energy_by_hand(&trial) - energy_0));
        }
        check_close(&checks, "KE + V", worst, 0, 1e-10 * energy_0);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void the_ledger_agrees_with_the_energy_by_hand(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (size_t f = 0; f < 2; f++) {
        struct trial trial = trial_open(forms[f], NULL);
        trial_run(&trial, &tight);
        fbd_energy energy = fbd_result_energy(trial.result);
        check_close(&checks, "E at the start", energy.initial_kinetic + energy.initial_potential, energy_0,
                    1e-12 * energy_0); /* the quadrature of V is asked for 1e-12 */
        check_close(&checks, "residual", energy.residual, 0, 1e-10 * energy_0);
        check_close(&checks, "no other work", energy.work, 0, 0);
        trial_finish(&trial);
        check_close(&checks, "KE + V by hand", energy.kinetic + energy.potential, energy_by_hand(&trial),
                    1e-12 * energy_0);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* After 100 periods it is where it started; an error dt of the whole moves v by a dt. */
static void a_hundred_periods_take_a_hundred_times_one(void **unused)
{
    (void)unused;
    const double acceleration = (k + k3 * amplitude * amplitude) * amplitude;
    struct checks checks = {0};
    for (size_t f = 0; f < 2; f++) {
        struct trial trial = trial_open(forms[f], NULL);
        trial_start(&trial, &tight);
        trial_finish(&trial);
        /* 1e-12 in each of some 60 steps a period moves the energy and so the period; over 100 periods the
         * phase is off by up to 1e-12 * 60 * 100^2/2 of one. */
        double late = 3e-7 * period;
        check_close(&checks, "v", trial_get(&trial, "v"), 0, acceleration * late);
        check_close(&checks, "x", trial_get(&trial, "x"), amplitude, 1e-10 * amplitude);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* The same pendulum as a pivot, and as a force along an arc: I_O omega_dot = M(theta). */
static void a_pendulum_is_a_moment_that_depends_on_the_angle(void **unused)
{
    (void)unused;
    static const char text[] = "fbd: 1\n"
                               "bodies:\n"
                               "  pendulum:\n"
                               "    mass: 3 kg\n"
                               "    center: [0, -1.06 m]\n"
                               "    motion: {pivot: {at: [0, 0]}}\n"
                               "    initial: {theta: 60 deg}\n"
                               "    moments:\n"
                               "      - applied: {name: weight, value: \"-m*g*1.06[m]*sin(theta)\"}\n"
                               "simulate: {until: 10 s}\n";
    static const double times[] = {0.5, 1, 2, 5, 10};
    struct checks checks = {0};
    struct trial gravity = trial_open("rotation/simple_pendulum.yaml", NULL), moment = trial_parse(text);
    trial_start(&gravity, NULL);
    trial_start(&moment, NULL);
    for (size_t i = 0; i < 5; i++) {
        trial_to(&gravity, times[i]);
        trial_to(&moment, times[i]);
        /* The first is stopped at its events, the second is not: other steps, each with the error of its
         * hundred at 1e-9. */
        check_close(&checks, "theta", trial_get(&moment, "theta"), trial_get(&gravity, "theta"), 1e-7);
    }
    trial_close(&gravity);
    trial_close(&moment);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_force_and_its_potential_give_the_same_motion),
        cmocka_unit_test(energy_stays_within_1e_10_over_100_periods),
        cmocka_unit_test(the_ledger_agrees_with_the_energy_by_hand),
        cmocka_unit_test(a_hundred_periods_take_a_hundred_times_one),
        cmocka_unit_test(a_pendulum_is_a_moment_that_depends_on_the_angle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
