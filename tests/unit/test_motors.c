/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Motors whose current is a state of the file's own: random ones against closed forms, by all methods, at the ends of their
 * steps and within them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <complex.h>
#undef I

#include "fbd_study.h"
#include "random_numbers.h"
#include "run_checks.h"
#include "thorough.h"

/* L i' = U - R i - k w, J w' = k i - b w */
struct motor {
    double U, R, k, L, J, b;
};

static struct motor random_motor(struct random_numbers *numbers)
{
    return (struct motor){random_between(numbers, 5, 20),   random_between(numbers, 0.5, 3),
                          random_between(numbers, 0.1, 1),  random_between(numbers, 0.05, 1),
                          random_between(numbers, 0.05, 1), random_between(numbers, 0.01, 0.1)};
}

/* By the exponential of the matrix, from its two eigenvalues (Sylvester's formula, complex ones too); no digits
 * cancel where one is far larger. */
static void motor_at(const struct motor *m, double t, double *w, double *i)
{
    double a = -m->b / m->J, c = m->k / m->J, d = -m->k / m->L, e = -m->R / m->L, det = a * e - c * d;
    double w_end = m->k * m->U / (m->R * m->b + m->k * m->k), i_end = m->b * w_end / m->k;
    double complex root = csqrt((a + e) * (a + e) - 4 * det), q = (a + e - root) / 2, p = det / q,
                   P = cexp(p * t) / (p - q), Q = cexp(q * t) / (p - q);
    *w = w_end - creal(P * ((p - e) * w_end + c * i_end) - Q * ((q - e) * w_end + c * i_end));
    *i = i_end - creal(P * (d * w_end + (p - a) * i_end) - Q * (d * w_end + (q - a) * i_end));
}

static void write_motor(char *text, const struct motor *m, double until)
{
    snprintf(text, text_room,
             "fbd: 1\nstates:\n  i: {rate: (%.17g - %.17g*i - %.17g*rotor.omega)/%.17g, unit: 1}\nbodies:\n"
             "  rotor:\n    mass: 1\n    inertia: %.17g\n    motion: pivot\n    moments: [applied: {name: "
             "drive, value: %.17g*states.i}, damper: %.17g]\nsimulate: {until: %.17g}\n",
             m->U, m->R, m->k, m->L, m->J, m->k, m->b, until);
}

static void a_motor_spins_up(void **unused)
{
    struct random_numbers numbers = {31};
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int k = 0; k < trials; k++) {
        struct motor m = random_motor(&numbers);
        double t = random_between(&numbers, 0.2, 5), w, i;
        write_motor(text, &m, t);
        struct trial trial = run_of(text);
        motor_at(&m, t, &w, &i);
        check_close(&checks, "omega", get(&trial, "rotor.omega"), w, same * (1 + fabs(w)));
        check_close(&checks, "current", get(&trial, "states.i"), i, same * (1 + fabs(i)));
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Explicit, implicit and multistep ones; of the order that they have, so each by its own measure. */
static const struct {
    const char *name;
    double tolerance, error;
} methods[] = {{"auto", 1e-10, 1e-8},  {"dop853", 1e-10, 1e-8}, {"rodas5p", 1e-10, 1e-7},
               {"rk8pd", 1e-10, 1e-7}, {"rkf45", 1e-10, 1e-7},  {"rkck", 1e-10, 1e-7},
               {"rk4", 1e-10, 1e-7},   {"rk2", 1e-9, 1e-6},     {"msadams", 1e-10, 1e-6},
               {"msbdf", 1e-9, 1e-5},  {"bsimp", 1e-10, 1e-7},  {"rk4imp", 1e-9, 1e-6},
               {"rk2imp", 1e-8, 1e-5}, {"rk1imp", 1e-5, 1e-2}};

static void all_methods_know_states(void **unused)
{
    const struct motor m = {12, 2, 0.3, 0.5, 0.1, 0.02};
    struct checks checks = {0};
    char text[text_room];
    double w, i;
    (void)unused;
    write_motor(text, &m, 2);
    motor_at(&m, 2, &w, &i);
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        fbd_options options = FBD_OPTIONS_DEFAULT;
        options.method = methods[k].name;
        options.tolerance = methods[k].tolerance;
        struct trial trial = trial_parse(text);
        trial_run(&trial, &options);
        check_close(&checks, methods[k].name, get(&trial, "states.i"), i, methods[k].error * i);
        check_close(&checks, methods[k].name, get(&trial, "rotor.omega"), w, methods[k].error * w);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* The largest error of the current within the steps, over the current that flows at rest. */
static double worst_inside(const char *text, const struct motor *m, const fbd_options *options)
{
    enum { looks = 5 };
    double worst = 0, from, to, w, i;
    struct trial trial = trial_parse(text);
    trial_start(&trial, options);
    while (fbd_simulation_advance(trial.simulation) == FBD_GOING) {
        fbd_simulation_interval(trial.simulation, &from, &to);
        for (int k = 1; k <= looks; k++) {
            double t = from + (to - from) * k / (looks + 1);
            assert_true(fbd_simulation_state(trial.simulation, t, trial.state));
            motor_at(m, t, &w, &i);
            worst = fmax(worst, fabs(get(&trial, "states.i") - i));
        }
    }
    trial_close(&trial);
    return worst / (m->U / m->R);
}

/* Between its ends a step of rk8pd, which is the default, was known to 1e-6 where they were to 1e-12. */
static void states_within_steps_are_as_good_as_at_their_ends(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {37};
    char text[text_room];
    for (int motor = 0; motor < draws_of(8); motor++) {
        struct motor m = random_motor(&numbers);
        write_motor(text, &m, random_between(&numbers, 1, 4));
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
            fbd_options options = FBD_OPTIONS_DEFAULT;
            options.method = methods[k].name;
            options.tolerance = methods[k].tolerance;
            check_close(&checks, methods[k].name, worst_inside(text, &m, &options), 0, methods[k].error);
        }
    }
    checks_end(&checks);
}

/* A circuit a million times as fast as the shaft: the stiff method is found, and the bars hold the error. */
static void a_stiff_circuit_with_error_bars(void **unused)
{
    const struct motor m = {12, 2, 0.3, 5e-7, 0.1, 0.02};
    struct checks checks = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    char text[text_room];
    double w, i;
    (void)unused;
    options.error_bars = true;
    options.tolerance = 1e-8;
    write_motor(text, &m, 2);
    motor_at(&m, 2, &w, &i);
    struct trial trial = trial_parse(text);
    trial_run(&trial, &options);
    fbd_stats stats = fbd_simulation_stats(trial.simulation);
    double off = fabs(get(&trial, "states.i") - i), bar = fbd_result_error(trial.result, "states.i");
    check_that(&checks, "stiff", stats.stiff_steps > 0 && stats.steps < 2000);
    check_that(&checks, "the bar is about as much", off < 2 * bar);
    check_that(&checks, "nor much more", bar < 1e-5);
    trial_close(&trial);
    checks_end(&checks);
}

/* omega = omega_s + (omega_s l2 exp(l1 t) - omega_s l1 exp(l2 t))/(l1 - l2), with l^2 + (R/L + b/J) l + (R b + k^2)/(L J) = 0 and
 * omega_s = k U/(R b + k^2): from rest, without a current. */
static void a_motor_spins_its_flywheel_up(void **unused)
{
    struct checks checks = {0};
    struct random_numbers numbers = {19};
    (void)unused;
    for (int i = 0; i < 20; i++) {
        const double R = 2, k = 0.3, J = 0.1, b = 0.02, t = 3;
        const double U = random_between(&numbers, 1, 24), L = random_between(&numbers, 0.05, 1);
        char voltage[40], inductance[40];
        snprintf(voltage, sizeof voltage, "U=%.17g V", U);
        snprintf(inductance, sizeof inductance, "L=%.17g H", L);
        struct trial trial = trial_open("control/dc_motor.yaml", SET(voltage, inductance));
        trial_run(&trial, NULL);
        const double p = (R / L + b / J) / 2, q = (R * b + k * k) / (L * J), end = k * U / (R * b + k * k);
        const complex double root = csqrt(p * p - q), l1 = -p + root, l2 = -p - root;
        const complex double omega = end * (1 + (l2 * cexp(l1 * t) - l1 * cexp(l2 * t)) / (l1 - l2));
        const complex double slope = end * l1 * l2 * (cexp(l1 * t) - cexp(l2 * t)) / (l1 - l2);
        check_close(&checks, "omega", get(&trial, "rotor.omega"), creal(omega), 1e-8 * end);
        check_close(&checks, "current", get(&trial, "states.current"), creal(J * slope + b * omega) / k,
                    1e-8 * U);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_motor_spins_up),
        cmocka_unit_test(all_methods_know_states),
        cmocka_unit_test(states_within_steps_are_as_good_as_at_their_ends),
        cmocka_unit_test(a_stiff_circuit_with_error_bars),
        cmocka_unit_test(a_motor_spins_its_flywheel_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
