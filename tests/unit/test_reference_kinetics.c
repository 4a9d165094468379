/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Motions on a line against the reference numbers A01 to A04, at the default tolerance.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

/* ---- A01 */

static void a_dropped_object_reaches_the_platform(void **state)
{
    static const char *const files[] = {"kinetics/drop_us.yaml", "kinetics/drop_us_from_platform.yaml"};
    static const double ground[] = {0, 10}; /* what to add to x for the height above the ground */
    struct checks *checks = checks_of(state);
    for (size_t f = 0; f < 2; f++) {
        struct trial trial = trial_open(files[f], NULL);
        trial_start(&trial, NULL);
        trial_to(&trial, 0.5);
        check_reference(checks, "A01.y_at_0.5s", trial_get(&trial, "x") + ground[f]);
        check_reference(checks, "A01.t_impact", trial_to_event(&trial, FBD_EVENT_USER, "platform", 0));
        double v = trial_get(&trial, "v");
        check_reference(checks, "A01.velocity_y", v);
        check_reference(checks, "A01.speed", -v);
        check_reference(checks, "A01.v_squared", v * v);
        check_that(checks, "the platform ends the run", trial.outcome == FBD_STOPPED);
        trial_close(&trial);
    }
    checks_end(checks);
}

static void the_datum_shifts_the_potential_energy_and_nothing_else(void **state)
{
    static const struct {
        const char *setting, *start, *end;
    } datums[] = {{"zero_level=0 ft", "A01.V_start_datum_ground", "A01.V_end_datum_ground"},
                  {"zero_level=10 ft", "A01.V_start_datum_platform", "A01.V_end_datum_platform"},
                  {"zero_level=-7 ft", "A01.V_start_datum_7ft_below_ground",
                   "A01.V_end_datum_7ft_below_ground"}};
    struct checks *checks = checks_of(state);
    for (size_t i = 0; i < 3; i++) {
        struct trial trial = trial_open("kinetics/drop_us.yaml", SET(datums[i].setting));
        trial_run(&trial, NULL);
        fbd_energy energy = fbd_result_energy(trial.result);
        check_reference(checks, "A01.KE_at_platform", energy.kinetic);
        check_reference(checks, datums[i].start, energy.initial_potential);
        check_reference(checks, datums[i].end, energy.potential);
        check_reference(checks, "A01.KE_at_platform", fbd_result_work(trial.result, "object", "gravity"));
        trial_close(&trial);
    }
    checks_end(checks);
}

/* ---- A02 */

static void a_push_below_the_static_limit_moves_nothing(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/flat_coulomb.yaml", SET("f1=20"));
    trial_start(&trial, NULL);
    hold_term(checks, &trial, "A02.a_friction", "x", "friction");
    check_reference(checks, "A02.a_normal", trial_normal(&trial, "x"));
    hold_value(checks, &trial, "A02.a_x", "x");
    check_that(checks, "at rest x is exactly 0", trial_get(&trial, "x") == 0);
    check_that(checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
    trial_close(&trial);
    checks_end(checks);
}

static void a_push_above_the_static_limit_moves_the_block(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/flat_coulomb.yaml", NULL);
    trial_start(&trial, NULL);
    hold_term(checks, &trial, "A02.b_friction", "x", "friction");
    hold_value(checks, &trial, "A02.b_v", "v");
    hold_value(checks, &trial, "A02.b_x", "x");
    trial_close(&trial);
    checks_end(checks);
}

static void a_block_brakes_stops_and_stays(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/flat_push_ends.yaml", NULL);
    trial_start(&trial, NULL);
    hold_value(checks, &trial, "A02.c_x", "x");
    check_reference(checks, "A02.c_t_stop", trial_to_event(&trial, FBD_EVENT_STICK, NULL, 0));
    hold_value(checks, &trial, "A02.c_x_final", "x");
    hold_value(checks, &trial, "A02.c_v", "v");
    check_that(checks, "at rest v is exactly 0", trial_get(&trial, "v") == 0);
    check_that(checks, "nothing pulls, so friction is 0", trial_term(&trial, "x", "friction") == 0);
    trial_close(&trial);
    checks_end(checks);
}

static void an_oblique_force_changes_the_normal_force(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/flat_coulomb.yaml", SET("angle=20 deg"));
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    check_reference(checks, "A02.d_normal", trial_normal(&trial, "x"));
    check_reference(checks, "A02.d_accel", trial_acceleration(&trial, "x"));
    hold_value(checks, &trial, "A02.d_x", "x");
    trial_close(&trial);
    trial = trial_open("kinetics/flat_coulomb.yaml", SET("angle=-20 deg"));
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    check_reference(checks, "A02.e_normal", trial_normal(&trial, "x"));
    check_reference(checks, "A02.e_friction", trial_term(&trial, "x", "friction"));
    hold_value(checks, &trial, "A02.e_x", "x");
    trial_close(&trial);
    checks_end(checks);
}

static void a_block_pushed_against_its_motion_turns_round(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/flat_coulomb.yaml", SET("v0=-3"));
    trial_start(&trial, NULL);
    check_reference(checks, "A02.f_t_turn", trial_to_event(&trial, FBD_EVENT_REVERSAL, NULL, 0));
    check_reference(checks, "A02.f_x_turn", trial_get(&trial, "x"));
    hold_value(checks, &trial, "A02.f_x", "x");
    hold_value(checks, &trial, "A02.f_v", "v");
    trial_close(&trial);
    checks_end(checks);
}

/* ---- A03 */

static void a_strong_push_carries_the_block_up_the_incline(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/incline.yaml", SET("f1=50"));
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    check_reference(checks, "A03.a_accel", trial_acceleration(&trial, "x"));
    check_reference(checks, "A03.a_normal", trial_normal(&trial, "x"));
    check_reference(checks, "A03.a_friction", trial_term(&trial, "x", "friction"));
    hold_value(checks, &trial, "A03.a_v", "v");
    hold_value(checks, &trial, "A03.a_x", "x");
    trial_finish(&trial);
    check_that(checks, "never at rest", fbd_simulation_event_count(trial.simulation) == 0);
    trial_close(&trial);
    checks_end(checks);
}

static void a_block_comes_to_rest_on_the_incline_for_good(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/incline.yaml", SET("f1=5"));
    trial_start(&trial, NULL);
    check_reference(checks, "A03.b_accel_initial", trial_acceleration(&trial, "x"));
    hold_term(checks, &trial, "A03.b_friction_moving", "x", "friction");
    check_reference(checks, "A03.b_t_stop", trial_to_event(&trial, FBD_EVENT_STICK, NULL, 0));
    check_reference(checks, "A03.b_x_stop", trial_get(&trial, "x"));
    hold_term(checks, &trial, "A03.b_friction_at_rest", "x", "friction");
    check_reference(checks, "A03.b_friction_limit", 0.5 * trial_normal(&trial, "x"));
    hold_value(checks, &trial, "A03.b_x", "x");
    hold_value(checks, &trial, "A03.b_v", "v");
    check_that(checks, "at rest v is exactly 0", trial_get(&trial, "v") == 0);
    check_that(checks, "it stops once", fbd_simulation_event_count(trial.simulation) == 1);
    trial_close(&trial);
    checks_end(checks);
}

static void a_block_stops_on_the_incline_and_slides_back(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/incline_slides_back.yaml", NULL);
    trial_start(&trial, NULL);
    hold_term(checks, &trial, "A03.c_friction_up", "x", "friction");
    check_reference(checks, "A03.c_t_turn", trial_to_event(&trial, FBD_EVENT_REVERSAL, NULL, 0));
    check_reference(checks, "A03.c_x_turn", trial_get(&trial, "x"));
    hold_term(checks, &trial, "A03.c_friction_down", "x", "friction");
    check_reference(checks, "A03.c_accel_down", trial_acceleration(&trial, "x"));
    hold_value(checks, &trial, "A03.c_x", "x");
    hold_value(checks, &trial, "A03.c_v", "v");
    double back = trial_to_event(&trial, FBD_EVENT_USER, "back", 0);
    check_reference(checks, "A03.c_t_back_at_0", back);
    check_reference(checks, "A03.c_v_back_at_0", trial_get(&trial, "v"));
    trial_close(&trial);
    trial = trial_open("kinetics/incline_slides_back.yaml", NULL);
    trial_run(&trial, &(fbd_options){.until = back});
    check_reference(checks, "A03.c_energy_lost", -fbd_result_work(trial.result, "block", "friction"));
    trial_close(&trial);
    checks_end(checks);
}

/* ---- A04 */

static void a_growing_force_breaks_the_block_away_once(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/ramp_breakaway.yaml", NULL);
    trial_start(&trial, NULL);
    hold_term(checks, &trial, "A04.friction_before", "x", "friction");
    hold_value(checks, &trial, "A04.x_before", "x");
    check_that(checks, "until then x is exactly 0", trial_get(&trial, "x") == 0);
    check_reference(checks, "A04.t_break", trial_to_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0));
    check_reference(checks, "A04.accel_just_after_break", trial_acceleration(&trial, "x"));
    hold_term(checks, &trial, "A04.friction_after", "x", "friction");
    hold_value(checks, &trial, "A04.v", "v");
    hold_value(checks, &trial, "A04.x", "x");
    check_that(checks, "exactly one event", fbd_simulation_event_count(trial.simulation) == 1);
    trial_close(&trial);
    checks_end(checks);
}

static void a_force_beyond_the_limit_at_rest_turns_the_block_round(void **state)
{
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/ramp_up_and_down.yaml", NULL);
    trial_start(&trial, NULL);
    check_reference(checks, "A04.t_break", trial_to_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0));
    check_reference(checks, "A04.b_t_stop", trial_to_event(&trial, FBD_EVENT_REVERSAL, NULL, 0));
    check_reference(checks, "A04.b_x_stop", trial_get(&trial, "x"));
    check_reference(checks, "A04.b_f1_at_stop", trial_term(&trial, "x", "pull"));
    hold_value(checks, &trial, "A04.b_v", "v");
    hold_value(checks, &trial, "A04.b_x", "x");
    check_that(checks, "it never sticks again", isnan(trial_event(&trial, FBD_EVENT_STICK, NULL, 0)));
    trial_close(&trial);
    checks_end(checks);
}

/* ---- closed form: v^2 = v_t^2 (1 - exp(-2 g h / v_t^2)), t = (v_t/g) acosh(exp(g h / v_t^2)) */

static void a_fall_with_drag_ends_below_its_terminal_speed(void **state)
{
    const double g = 9.81, h = 100, vt2 = 0.4 * g / 0.01, vt = sqrt(vt2);
    const double accuracy = 1e-8; /* of the default tolerance 1e-9, summed over about ten steps */
    struct checks *checks = checks_of(state);
    struct trial trial = trial_open("kinetics/falling_with_drag.yaml", NULL);
    trial_start(&trial, NULL);
    for (int i = 1; i <= 6; i++) {
        trial_to(&trial, i);
        check_close(checks, "v", trial_get(&trial, "v"), -vt * tanh(g * i / vt), accuracy * vt);
        check_close(checks, "x", trial_get(&trial, "x"), h - vt2 / g * log(cosh(g * i / vt)), accuracy * h);
    }
    double t = trial_to_event(&trial, FBD_EVENT_USER, "ground", 0);
    check_close(checks, "t", t, vt / g * acosh(exp(g * h / vt2)), accuracy * t);
    check_close(checks, "v", trial_get(&trial, "v"), -vt * sqrt(1 - exp(-2 * g * h / vt2)), accuracy * vt);
    trial_close(&trial);
    checks_end(checks);
}

static void every_number_of_A01_to_A04_was_held(void **state)
{
    struct checks *checks = checks_of(state);
    check_covered(checks, "A01.");
    check_covered(checks, "A02.");
    check_covered(checks, "A03.");
    check_covered(checks, "A04.");
    checks_end(checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_dropped_object_reaches_the_platform),
        cmocka_unit_test(the_datum_shifts_the_potential_energy_and_nothing_else),
        cmocka_unit_test(a_push_below_the_static_limit_moves_nothing),
        cmocka_unit_test(a_push_above_the_static_limit_moves_the_block),
        cmocka_unit_test(a_block_brakes_stops_and_stays),
        cmocka_unit_test(an_oblique_force_changes_the_normal_force),
        cmocka_unit_test(a_block_pushed_against_its_motion_turns_round),
        cmocka_unit_test(a_strong_push_carries_the_block_up_the_incline),
        cmocka_unit_test(a_block_comes_to_rest_on_the_incline_for_good),
        cmocka_unit_test(a_block_stops_on_the_incline_and_slides_back),
        cmocka_unit_test(a_growing_force_breaks_the_block_away_once),
        cmocka_unit_test(a_force_beyond_the_limit_at_rest_turns_the_block_round),
        cmocka_unit_test(a_fall_with_drag_ends_below_its_terminal_speed),
        cmocka_unit_test(every_number_of_A01_to_A04_was_held),
    };
    return cmocka_run_group_tests(tests, checks_begin, checks_free);
}
