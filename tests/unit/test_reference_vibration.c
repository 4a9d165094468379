/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Springs and given forces against the reference numbers A08, D06 and D07, at the default tolerance.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

/* ---- A08 */

static double cubic_energy(const struct trial *trial, double k, double k3)
{
    double x = trial_get(trial, "x"), v = trial_get(trial, "v");
    return v * v / 2 + k * x * x / 2 + k3 * x * x * x * x / 4;
}

/* What the reference calls the numbers of a variant. */
struct cubic_names {
    const char *energy, *period, *vmax, *x_1, *v_1, *x_10, *v_10;
};

static void hold_cubic(struct checks *checks, const char *file, double k3, const struct cubic_names *names)
{
    struct trial trial = trial_open(file, NULL);
    trial_start(&trial, NULL);
    check_reference(checks, names->energy, cubic_energy(&trial, 100, k3));
    trial_to_event(&trial, FBD_EVENT_USER, "middle", 0);
    check_reference(checks, names->vmax, -trial_get(&trial, "v"));
    check_reference(checks, names->period, trial_to_event(&trial, FBD_EVENT_USER, "period", 0));
    hold_value(checks, &trial, names->x_1, "x");
    hold_value(checks, &trial, names->v_1, "v");
    trial_close(&trial);
    trial = trial_open(file, NULL);
    /* The period depends on the energy, so what the steps lose moves the phase ever faster. At 10 s, after up
     * to 22 periods, the default tolerance is just as far off as the 1e-7 that is allowed. */
    trial_start(&trial, &(fbd_options){.until = NAN, .tolerance = 1e-10});
    hold_value(checks, &trial, names->x_10, "x");
    hold_value(checks, &trial, names->v_10, "v");
    trial_close(&trial);
    trial = trial_open(file, NULL);
    trial_run(&trial, NULL);
    fbd_energy energy = fbd_result_energy(trial.result);
    check_reference(checks, names->energy, energy.initial_kinetic + energy.initial_potential);
    trial_close(&trial);
}

static void cubic_springs_swing_as_elliptic_functions_say(void **state)
{
    struct checks *checks = checks_of(state);
    const struct cubic_names a = {"A08.a_energy", "A08.a_period", "A08.a_vmax",  "A08.a_x_1.0",
                                  "A08.a_v_1.0",  "A08.a_x_10.0", "A08.a_v_10.0"};
    const struct cubic_names b = {"A08.b_energy", "A08.b_period", "A08.b_vmax",  "A08.b_x_1.0",
                                  "A08.b_v_1.0",  "A08.b_x_10.0", "A08.b_v_10.0"};
    hold_cubic(checks, "energy/cubic_spring_force.yaml", 500, &a);
    hold_cubic(checks, "energy/cubic_spring_potential.yaml", 500, &a);
    hold_cubic(checks, "energy/softening_spring.yaml", -150, &b);
    checks_end(checks);
}

static void the_attracting_centre_is_reached_in_time(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("energy/inverse_square.yaml", NULL);
    trial_start(&trial, NULL);
    check_reference(checks, "A08.c_t", trial_to_event(&trial, FBD_EVENT_USER, "near", 0));
    check_reference(checks, "A08.c_v", trial_get(&trial, "v"));
    trial_close(&trial);
    checks_end(checks);
}

/* ---- D06 */

struct scale {
    const char *mass, *c, *k, *x0;
    const char *x_1, *v_1, *f_1, *x_3, *v_3, *f_3;
};

static const struct scale scales[] = {
    {"mass=1 kg", "c=1 N*s/m", "k=100 N/m", "x0=1 m", "D06.U_x_1", "D06.U_v_1", "D06.U_spring_force_1",
     "D06.U_x_3", "D06.U_v_3", "D06.U_spring_force_3"},
    {"mass=1e-9 kg", "c=1e-9 N*s/m", "k=1e-7 N/m", "x0=1e-6 m", "D06.S_x_1", "D06.S_v_1",
     "D06.S_spring_force_1", "D06.S_x_3", "D06.S_v_3", "D06.S_spring_force_3"},
    {"mass=1e12 kg", "c=1e12 N*s/m", "k=1e14 N/m", "x0=1e3 m", "D06.L_x_1", "D06.L_v_1",
     "D06.L_spring_force_1", "D06.L_x_3", "D06.L_v_3", "D06.L_spring_force_3"},
};

static void the_oscillator_moves_alike_at_every_scale(void **state)
{
    struct checks *checks = checks_of(state);
    for (size_t i = 0; i < 3; i++) {
        const struct scale *s = &scales[i];
        struct trial trial = trial_open("vibration/damped_oscillator.yaml", SET(s->mass, s->c, s->k, s->x0));
        trial_start(&trial, NULL);
        hold_value(checks, &trial, s->x_1, "x");
        hold_value(checks, &trial, s->v_1, "v");
        hold_term(checks, &trial, s->f_1, "x", "spring");
        hold_value(checks, &trial, s->x_3, "x");
        hold_value(checks, &trial, s->v_3, "v");
        hold_term(checks, &trial, s->f_3, "x", "spring");
        trial_close(&trial);
    }
    checks_end(checks);
}

static void rods_of_all_sizes_swing(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("rotation/rod_pendulum.yaml", SET("length=1e-6 m", "rod_mass=1e-9 kg"));
    trial_start(&trial, NULL);
    check_reference(checks, "D06.P_period_1.0e-6", trial_to_event(&trial, FBD_EVENT_USER, "top", 0));
    trial_close(&trial);
    trial = trial_open("rotation/rod_pendulum.yaml", SET("length=1e6 m", "rod_mass=1e12 kg"));
    trial_start(&trial, NULL);
    check_reference(checks, "D06.P_period_1.0e+6", trial_to_event(&trial, FBD_EVENT_USER, "top", 0));
    trial_close(&trial);
    checks_end(checks);
}

/* ---- D07 */

static void a_square_wave_makes_parabolas(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("forcing/square_wave.yaml", NULL);
    trial_start(&trial, NULL);
    hold_value(checks, &trial, "D07.a_x_1", "x");
    hold_value(checks, &trial, "D07.a_v_1", "v");
    hold_value(checks, &trial, "D07.a_x_5", "x");
    hold_value(checks, &trial, "D07.a_v_5", "v");
    hold_value(checks, &trial, "D07.a_x_10", "x");
    hold_value(checks, &trial, "D07.a_v_10", "v");
    /* Jumps at 0.35, 0.7, ... 9.8 s; each is one event and none is missed. */
    check_that(checks, "28 jumps in 10 s", fbd_simulation_event_count(trial.simulation) == 28);
    trial_close(&trial);
    checks_end(checks);
}

static void pulses_start_and_stop_the_block(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("forcing/pulse_train.yaml", NULL);
    trial_start(&trial, NULL);
    hold_value(checks, &trial, "D07.b_x_5.2", "x");
    hold_value(checks, &trial, "D07.b_v_5.2", "v");
    hold_value(checks, &trial, "D07.b_x_10", "x");
    hold_value(checks, &trial, "D07.b_v_10", "v");
    trial_close(&trial);
    checks_end(checks);
}

static void a_square_wave_and_friction_reverse_the_block(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("forcing/square_wave_with_friction.yaml", NULL);
    trial_start(&trial, NULL);
    check_reference(checks, "D07.c_t_zero_1", trial_to_event(&trial, FBD_EVENT_REVERSAL, NULL, 0));
    check_reference(checks, "D07.c_t_zero_2", trial_to_event(&trial, FBD_EVENT_REVERSAL, NULL, 1));
    check_reference(checks, "D07.c_t_zero_3", trial_to_event(&trial, FBD_EVENT_REVERSAL, NULL, 2));
    hold_value(checks, &trial, "D07.c_x_10", "x");
    hold_value(checks, &trial, "D07.c_v_10", "v");
    check_that(checks, "it never sticks: 10 N is beyond the limit",
               isnan(trial_event(&trial, FBD_EVENT_STICK, NULL, 0)));
    trial_close(&trial);
    checks_end(checks);
}

/* ---- closed form: x = x0 exp(-zeta w t) (cos(wd t) + zeta/sqrt(1 - zeta^2) sin(wd t)) */

static void a_torsional_pendulum_decays_as_its_closed_form(void **state)
{
    struct checks *checks = checks_of(state);
    const double I_O = 0.01, k = 0.9, c = 0.006, theta0 = 20 * 3.14159265358979323846 / 180;
    const double w = sqrt(k / I_O), zeta = c / (2 * I_O * w), root = sqrt(1 - zeta * zeta);
    const double accuracy = 1e-7 * theta0; /* the default tolerance 1e-9 in each of a hundred steps */
    struct trial trial = trial_open("rotation/torsional_pendulum.yaml", NULL);
    trial_start(&trial, NULL);
    for (int i = 1; i <= 20; i++) {
        double t = 0.25 * i, phase = w * root * t;
        trial_to(&trial, t);
        check_close(checks, "theta", trial_get(&trial, "theta"),
                    theta0 * exp(-zeta * w * t) * (cos(phase) + zeta / root * sin(phase)), accuracy);
    }
    trial_close(&trial);
    checks_end(checks);
}

static void every_number_of_A08_D06_and_D07_was_held(void **state)
{
    struct checks *checks = checks_of(state);
    check_covered(checks, "A08.");
    check_covered(checks, "D06.");
    check_covered(checks, "D07.");
    checks_end(checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubic_springs_swing_as_elliptic_functions_say),
        cmocka_unit_test(the_attracting_centre_is_reached_in_time),
        cmocka_unit_test(the_oscillator_moves_alike_at_every_scale),
        cmocka_unit_test(rods_of_all_sizes_swing),
        cmocka_unit_test(a_square_wave_makes_parabolas),
        cmocka_unit_test(pulses_start_and_stop_the_block),
        cmocka_unit_test(a_square_wave_and_friction_reverse_the_block),
        cmocka_unit_test(a_torsional_pendulum_decays_as_its_closed_form),
        cmocka_unit_test(every_number_of_A08_D06_and_D07_was_held),
    };
    return cmocka_run_group_tests(tests, checks_begin, checks_free);
}
