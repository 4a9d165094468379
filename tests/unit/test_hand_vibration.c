/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Springs and given forces on a line: assembled equations against formulas written out by hand (A08, D06,
 * D07).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

static const double places[][2] = {{0.5, 0}, {-0.37, 2}, {0.02, -6}, {1.3, 0.7}};
enum { place_count = sizeof places / sizeof *places };

static void set_place(struct trial *trial, size_t i, double scale)
{
    trial_set(trial, "x", scale * places[i][0]);
    trial_set(trial, "v", scale * places[i][1]);
}

static void check_cubic(struct checks *checks, const char *file, double k, double k3)
{
    struct trial trial = trial_open(file, NULL);
    for (size_t i = 0; i < place_count; i++) {
        double x = places[i][0];
        set_place(&trial, i, 1);
        check_equation(checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = 1,
                                       .terms = {{"spring", -k * x - k3 * x * x * x}},
                                       .acceleration = -(k + k3 * x * x) * x});
    }
    trial_close(&trial);
}

static void a_cubic_spring_is_the_same_as_a_force_and_as_a_potential(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    check_cubic(&checks, "energy/cubic_spring_force.yaml", 100, 500);
    check_cubic(&checks, "energy/cubic_spring_potential.yaml", 100, 500);
    check_cubic(&checks, "energy/softening_spring.yaml", 100, -150);
    checks_end(&checks);
}

static void the_inverse_square_force_draws_to_the_centre(void **unused)
{
    (void)unused;
    static const double distances[] = {1, 0.1, 0.013, 5};
    struct checks checks = {0};
    struct trial trial = trial_open("energy/inverse_square.yaml", NULL);
    for (size_t i = 0; i < 4; i++) {
        double x = distances[i], f = -2 / (x * x);
        trial_set(&trial, "x", x);
        check_equation(&checks, &trial,
                       &(fbd_expected){
                           .coordinate = "x", .inertia = 1, .terms = {{"attraction", f}}, .acceleration = f});
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* x and v scale with x0, all forces with k x0: nothing depends on the size but the size. */
static void check_oscillator(struct checks *checks, const char *const *settings, double m, double c, double k,
                             double x0)
{
    struct trial trial = trial_open("vibration/damped_oscillator.yaml", settings);
    for (size_t i = 0; i < place_count; i++) {
        double x = x0 * places[i][0], v = x0 * places[i][1];
        set_place(&trial, i, x0);
        check_equation(checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"spring", -k * x}, {"damper", -c * v}},
                                       .acceleration = -k / m * x - c / m * v});
    }
    trial_close(&trial);
}

static void the_oscillator_is_linear_at_every_scale(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    check_oscillator(&checks, NULL, 1, 1, 100, 1);
    check_oscillator(&checks, SET("mass=1e-9 kg", "c=1e-9 N*s/m", "k=1e-7 N/m", "x0=1e-6 m"), 1e-9, 1e-9,
                     1e-7, 1e-6);
    check_oscillator(&checks, SET("mass=1e12 kg", "c=1e12 N*s/m", "k=1e14 N/m", "x0=1e3 m"), 1e12, 1e12, 1e14,
                     1e3);
    checks_end(&checks);
}

static void a_hanging_spring_pulls_from_its_neutral_place(void **unused)
{
    (void)unused;
    const double m = 1.5, g = 9.81, k = 80, l0 = 0.3, c = 0.4;
    struct checks checks = {0};
    struct trial trial = trial_open("vibration/hanging_spring.yaml", NULL);
    for (size_t i = 0; i < place_count; i++) {
        double x = places[i][0], v = places[i][1];
        set_place(&trial, i, 1);
        check_equation(
            &checks, &trial,
            &(fbd_expected){.coordinate = "x",
                            .inertia = m,
                            .terms = {{"gravity", -m * g}, {"spring", -k * (x + l0)}, {"damper", -c * v}},
                            .acceleration = -g - (k * (x + l0) + c * v) / m});
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* Instants inside each half, in the first period and after many. */
static void a_square_wave_is_plus_then_minus(void **unused)
{
    (void)unused;
    static const double states[][2] = {{0.1, 10},   {0.34, 10}, {0.36, -10},
                                       {0.69, -10}, {70.1, 10}, {70.4, -10}};
    const double m = 2, g = 9.81, mu = 0.1;
    struct checks checks = {0};
    struct trial trial = trial_open("forcing/square_wave.yaml", NULL);
    struct trial rough = trial_open("forcing/square_wave_with_friction.yaml", NULL);
    for (size_t i = 0; i < sizeof states / sizeof *states; i++) {
        double f = states[i][1], v = i % 2 ? -0.8 : 0.3, friction = v > 0 ? -mu * m * g : mu * m * g;
        trial_set(&trial, "t", states[i][0]);
        check_equation(
            &checks, &trial,
            &(fbd_expected){.coordinate = "x", .inertia = m, .terms = {{"wave", f}}, .acceleration = f / m});
        trial_set(&rough, "t", states[i][0]);
        trial_set(&rough, "v", v);
        check_equation(&checks, &rough,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = m,
                                       .terms = {{"wave", f}, {"friction", friction}},
                                       .acceleration = (f + friction) / m,
                                       .normal = m * g});
    }
    trial_close(&trial);
    trial_close(&rough);
    checks_end(&checks);
}

static void a_train_of_pulses_has_gaps(void **unused)
{
    (void)unused;
    static const double states[][3] = {/* t, forward, backward */
                                       {0.1, 10, 0}, {0.4, 0, 0},  {0.5, 0, -10}, {0.76, 0, -10},
                                       {0.9, 0, 0},  {7.2, 10, 0}, {7.6, 0, -10}, {7.999, 0, 0}};
    struct checks checks = {0};
    struct trial trial = trial_open("forcing/pulse_train.yaml", NULL);
    for (size_t i = 0; i < sizeof states / sizeof *states; i++) {
        double forward = states[i][1], backward = states[i][2];
        trial_set(&trial, "t", states[i][0]);
        check_equation(&checks, &trial,
                       &(fbd_expected){.coordinate = "x",
                                       .inertia = 2,
                                       .terms = {{"forward", forward}, {"backward", backward}},
                                       .acceleration = (forward + backward) / 2});
    }
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cubic_spring_is_the_same_as_a_force_and_as_a_potential),
        cmocka_unit_test(the_inverse_square_force_draws_to_the_centre),
        cmocka_unit_test(the_oscillator_is_linear_at_every_scale),
        cmocka_unit_test(a_hanging_spring_pulls_from_its_neutral_place),
        cmocka_unit_test(a_square_wave_is_plus_then_minus),
        cmocka_unit_test(a_train_of_pulses_has_gaps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
