/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What must not matter: the direction of the axes, the units, the order of the bodies, who looks on, where
 * energy is counted from, how a body is put together.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_export.h"
#include "gallery.h"

#include <stdlib.h>
#include <string.h>

/* Two runs that differ in rounding alone: 1e-16 in a force, times the few hundred operations and steps
 * between, far from any instability. */
static const double rounding = 1e-12;

/* ---- the frame turned */

static void an_incline_is_a_flat_with_gravity_turned(void **unused)
{
    (void)unused;
    static const char turned[] = "fbd: 1\n"
                                 "gravity: [-9.81*sin(pi/6), -9.81*cos(pi/6)]\n"
                                 "bodies:\n"
                                 "  block:\n"
                                 "    mass: 2 kg\n"
                                 "    motion: {slide: {along: 0 deg}}\n"
                                 "    initial: {v: 3 m/s}\n"
                                 "    forces:\n"
                                 "      - gravity\n"
                                 "      - normal\n"
                                 "      - friction: 0.5\n"
                                 "      - applied: {name: push, value: 5 N}\n"
                                 "simulate: {until: 3 s}\n";
    static const double times[] = {0.1, 0.3, 0.45, 0.5, 3};
    struct checks checks = {0};
    struct trial one = trial_open("kinetics/incline.yaml", NULL), two = trial_parse(turned);
    trial_start(&one, NULL);
    trial_start(&two, NULL);
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        trial_to(&one, times[i]);
        trial_to(&two, times[i]);
        check_close(&checks, "x", trial_get(&two, "x"), trial_get(&one, "x"), rounding);
        check_close(&checks, "v", trial_get(&two, "v"), trial_get(&one, "v"), rounding);
        check_close(&checks, "friction", trial_term(&two, "x", "friction"), trial_term(&one, "x", "friction"),
                    10 * rounding);
    }
    check_close(&checks, "stops", trial_event(&two, FBD_EVENT_STICK, NULL, 0),
                trial_event(&one, FBD_EVENT_STICK, NULL, 0), rounding);
    trial_close(&one);
    trial_close(&two);
    checks_end(&checks);
}

/* A bar on two springs, everything given in axes turned by `turn`: vectors are written through R. */
static struct trial turned_bar(double turn)
{
    char text[2048];
    double c = cos(turn), s = sin(turn);
#define TURNED(x, y) c *(x)-s *(y), s *(x) + c *(y)
    snprintf(text, sizeof text,
             "fbd: 1\n"
             "gravity: [%.17g, %.17g]\n"
             "ground: {points: {P: [%.17g, %.17g], Q: [%.17g, %.17g]}}\n"
             "bodies:\n"
             "  bar:\n"
             "    shape: rod\n"
             "    mass: 4 kg\n"
             "    length: 1.2 m\n"
             "    motion: planar\n"
             "    initial: {x: %.17g, y: %.17g, theta: %.17g rad, vx: %.17g, vy: %.17g}\n"
             "    forces:\n"
             "      - gravity\n"
             "      - spring: {name: A, stiffness: 300 N/m, free_length: 0.5 m, at: left, to: P}\n"
             "      - spring: {name: B, stiffness: 500 N/m, free_length: 0.5 m, at: right, to: Q}\n"
             "      - drag: {quadratic: 0.3 N*s^2/m^2, at: right}\n"
             "      - applied: {name: pull, value: 3 N, angle: %.17g rad, at: right}\n"
             "      - applied: {name: jet, value: 2 N, angle: 90 deg, frame: body, at: left}\n"
             "simulate: {until: 2 s}\n",
             TURNED(0.0, -9.81), TURNED(-0.6, -0.4), TURNED(0.6, -0.4), TURNED(0.0, 0.1), turn + 0.1,
             TURNED(0.5, -0.2), turn + 0.7);
#undef TURNED
    return trial_parse(text);
}

static void a_planar_motion_turns_with_its_axes(void **unused)
{
    (void)unused;
    static const double turns[] = {0.4, 1.9, -2.7};
    struct checks checks = {0};
    for (size_t i = 0; i < 3; i++) {
        double c = cos(turns[i]), s = sin(turns[i]);
        struct trial one = turned_bar(0), two = turned_bar(turns[i]);
        trial_start(&one, NULL);
        trial_start(&two, NULL);
        for (int k = 1; k <= 4; k++) {
            trial_to(&one, 0.5 * k);
            trial_to(&two, 0.5 * k);
            double x = trial_get(&one, "x"), y = trial_get(&one, "y");
            /* The error control looks at x and y one by one, so the steps differ: each run has its own error
             * of some hundred steps at 1e-9, on an amplitude of 0.3 m. */
            const double accuracy = 3e-8;
            check_close(&checks, "x", trial_get(&two, "x"), c * x - s * y, accuracy);
            check_close(&checks, "y", trial_get(&two, "y"), s * x + c * y, accuracy);
            check_close(&checks, "theta", trial_get(&two, "theta"), trial_get(&one, "theta") + turns[i],
                        accuracy);
        }
        trial_close(&one);
        trial_close(&two);
    }
    checks_end(&checks);
}

/* ---- units */

#define INCLINE_IN(system)                                                                                   \
    "fbd: 1\nunits: " system "\ngravity: 9.81 m/s^2\nbodies:\n  block:\n    mass: 2 kg\n"                    \
    "    motion: {slide: {along: 30 deg}}\n    initial: {v: 3 m/s}\n    forces:\n      - gravity\n"          \
    "      - normal\n      - friction: {static: 0.3, kinetic: 0.2}\n"                                        \
    "      - drag: {quadratic: 0.3 N*s^2/m^2}\n      - applied: {name: push, value: \"4[N/s]*t\"}\n"         \
    "simulate: {until: 1.5 s}\n"

static void feet_and_slugs_move_as_metres_and_kilograms(void **unused)
{
    (void)unused;
    const double foot = 0.3048, pound = 4.4482216152605;
    struct checks checks = {0};
    struct trial si = trial_parse(INCLINE_IN("SI")), us = trial_parse(INCLINE_IN("US"));
    trial_start(&si, NULL);
    trial_start(&us, NULL);
    for (int i = 1; i <= 5; i++) {
        trial_to(&si, 0.3 * i);
        trial_to(&us, 0.3 * i);
        check_close(&checks, "x", foot * trial_get(&us, "x"), trial_get(&si, "x"), rounding);
        check_close(&checks, "v", foot * trial_get(&us, "v"), trial_get(&si, "v"), rounding);
        check_close(&checks, "friction", pound * trial_term(&us, "x", "friction"),
                    trial_term(&si, "x", "friction"), 10 * rounding);
    }
    size_t count = fbd_simulation_event_count(si.simulation);
    check_that(&checks, "something happens", count > 0);
    check_that(&checks, "the same happens", count == fbd_simulation_event_count(us.simulation));
    for (size_t i = 0; i < count; i++)
        check_close(&checks, "event", fbd_simulation_event(us.simulation, i).t,
                    fbd_simulation_event(si.simulation, i).t, rounding);
    trial_close(&si);
    trial_close(&us);
    checks_end(&checks);
}

/* ---- bodies in any order, and bodies that have nothing to do with each other */

#define HEAD "fbd: 1\nbodies:\n"
#define BLOCK                                                                                                \
    "  block:\n    mass: 2 kg\n    motion: {slide: {along: 0 deg}}\n    forces:\n      - gravity\n"          \
    "      - normal\n      - friction: 0.2\n      - applied: {value: \"8[N]*sin(pendulum.theta)\"}\n"
#define PENDULUM                                                                                             \
    "  pendulum:\n    mass: 1 kg\n    center: [0, -1 m]\n    motion: {pivot: {at: [0, 0]}}\n"                \
    "    initial: {theta: 60 deg}\n    forces: [gravity]\n"
#define BALL                                                                                                 \
    "  ball:\n    mass: 0.5 kg\n    motion: particle\n    initial: {vx: 3 m/s, vy: 20 m/s}\n"                \
    "    forces:\n      - gravity\n      - drag: {quadratic: 0.01 N*s^2/m^2}\n"
#define IDLE "  idle:\n    mass: 7 kg\n    motion: planar\n    inertia: 1 kg*m^2\n"
#define TAIL "simulate: {until: 4 s}\n"

static const char *const followed[] = {"block.x",        "block.v", "pendulum.theta",
                                       "pendulum.omega", "ball.x",  "ball.vy"};

/* Run two texts to the end: to the last bit the same, in as many steps and `more`. */
static void check_same_bits(struct checks *checks, const char *text, const char *other, unsigned long more)
{
    struct trial one = trial_parse(text), two = trial_parse(other);
    trial_start(&one, NULL);
    trial_start(&two, NULL);
    trial_finish(&one);
    trial_finish(&two);
    for (size_t i = 0; i < sizeof followed / sizeof *followed; i++)
        check_close(checks, followed[i], trial_get(&two, followed[i]), trial_get(&one, followed[i]), 0);
    check_that(checks, "as many steps",
               fbd_simulation_stats(one.simulation).steps + more ==
                   fbd_simulation_stats(two.simulation).steps);
    check_that(checks, "as many events",
               fbd_simulation_event_count(one.simulation) == fbd_simulation_event_count(two.simulation));
    trial_close(&one);
    trial_close(&two);
}

static void the_order_of_the_bodies_changes_no_bit(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    check_same_bits(&checks, HEAD BLOCK PENDULUM BALL TAIL, HEAD BALL PENDULUM BLOCK TAIL, 0);
    check_same_bits(&checks, HEAD BLOCK PENDULUM BALL TAIL, HEAD PENDULUM BALL BLOCK TAIL, 0);
    checks_end(&checks);
}

static void a_body_at_rest_elsewhere_changes_no_bit(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial alone = trial_parse(HEAD IDLE TAIL);
    trial_start(&alone, NULL);
    trial_finish(&alone);
    check_same_bits(&checks, HEAD BLOCK PENDULUM BALL TAIL, HEAD IDLE BLOCK PENDULUM BALL TAIL,
                    fbd_simulation_stats(alone.simulation).steps);
    trial_close(&alone);
    checks_end(&checks);
}

/* ---- looking */

/* The ends of all steps of a run that is looked at `samples` times in equal intervals; returns their number.
 */
static size_t step_ends(const char *path, int samples, double *ends, size_t room)
{
    struct trial trial = trial_open(path, NULL);
    trial_start(&trial, NULL);
    size_t count = 0;
    const double until = 10;
    double from, to;
    int looked = 0;
    while (trial.outcome == FBD_GOING) {
        trial.outcome = fbd_simulation_advance(trial.simulation);
        fbd_simulation_interval(trial.simulation, &from, &to);
        if (count < room) ends[count] = to;
        count++;
        for (; looked < samples && looked * until <= to * samples; looked++) {
            assert_true(fbd_simulation_state(trial.simulation, looked * until / samples, trial.state));
            trial_acceleration(&trial, "theta");
        }
    }
    assert_int_equal(trial.outcome, FBD_DONE);
    trial_close(&trial);
    return count;
}

static void looking_changes_no_step(void **unused)
{
    (void)unused;
    enum { room = 4000 };
    static double alone[room], watched[room];
    static const char path[] = "rotation/compound_pendulum.yaml";
    size_t count = step_ends(path, 0, alone, room);
    assert_in_range(count, 20, room);
    static const int samples[] = {10, 10000};
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(step_ends(path, samples[i], watched, room), count);
        assert_memory_equal(watched, alone, count * sizeof *alone);
    }
}

static int discard(void *context, const char *text, size_t length)
{
    (void)text;
    *(size_t *)context += length;
    return 0;
}

static void recording_changes_no_bit(void **unused)
{
    (void)unused;
    struct trial bare = trial_open("forcing/square_wave_with_friction.yaml", NULL);
    trial_run(&bare, NULL);
    struct trial told = trial_open("forcing/square_wave_with_friction.yaml", NULL);
    trial_start(&told, NULL);
    size_t written = 0;
    const fbd_recording all = {.every = 1e-3, .ledger = true, .csv = discard, .csv_context = &written};
    told.result = fbd_simulation_run(told.simulation, &all);
    assert_non_null(told.result);
    assert_in_range(written, 100000, 100000000); /* 10 000 rows of some numbers were written */
    double x, y;
    assert_true(fbd_state_get(fbd_result_state(bare.result), "block.x", &x));
    assert_true(fbd_state_get(fbd_result_state(told.result), "block.x", &y));
    assert_memory_equal(&x, &y, sizeof x);
    fbd_stats one = fbd_simulation_stats(bare.simulation), two = fbd_simulation_stats(told.simulation);
    assert_int_equal(one.steps, two.steps);
    assert_int_equal(one.rejected, two.rejected);
    assert_int_equal(one.rhs, two.rhs);
    trial_close(&bare);
    trial_close(&told);
}

static void without_works_the_motion_has_the_same_bits(void **unused)
{
    (void)unused;
    struct trial whole = trial_open("forcing/square_wave_with_friction.yaml", NULL);
    trial_run(&whole, NULL);
    struct trial bare = trial_open("forcing/square_wave_with_friction.yaml", NULL);
    trial_start(&bare, NULL);
    const fbd_recording motion = {.motion_only = true};
    bare.result = fbd_simulation_run(bare.simulation, &motion);
    assert_non_null(bare.result);
    double x, y;
    assert_true(fbd_state_get(fbd_result_state(whole.result), "block.x", &x));
    assert_true(fbd_state_get(fbd_result_state(bare.result), "block.x", &y));
    assert_memory_equal(&x, &y, sizeof x);
    fbd_energy energy = fbd_result_energy(bare.result);
    assert_true(isnan(energy.work) && isnan(energy.residual));
    assert_true(energy.kinetic == fbd_result_energy(whole.result).kinetic);
    assert_true(isnan(fbd_result_work(bare.result, "block", "friction")));
    assert_true(!isnan(fbd_result_work(whole.result, "block", "friction")));
    char *report = fbd_result_report(bare.result, false);
    assert_non_null(report);
    assert_non_null(strstr(report, "work not integrated"));
    free(report);
    trial_close(&whole);
    trial_close(&bare);
}

/* ---- the datum */

static void the_datum_moves_v_and_no_bit_of_the_motion(void **unused)
{
    (void)unused;
    static const char *const settings[] = {"zero_level=0 ft", "zero_level=-7 ft", "zero_level=1e6 ft"};
    static const double levels[] = {0, -7, 1e6};
    const double weight = 64.4;
    fbd_energy energy[3];
    double x[3], v[3];
    struct checks checks = {0};
    for (size_t i = 0; i < 3; i++) {
        struct trial trial = trial_open("kinetics/drop_us.yaml", SET(settings[i]));
        trial_run(&trial, NULL);
        energy[i] = fbd_result_energy(trial.result);
        assert_true(fbd_state_get(fbd_result_state(trial.result), "object.x", &x[i]));
        assert_true(fbd_state_get(fbd_result_state(trial.result), "object.v", &v[i]));
        trial_close(&trial);
    }
    for (size_t i = 1; i < 3; i++) {
        check_close(&checks, "x", x[i], x[0], 0);
        check_close(&checks, "v", v[i], v[0], 0);
        check_close(&checks, "KE", energy[i].kinetic, energy[0].kinetic, 0);
        double shift = -weight * levels[i];
        check_close(&checks, "V at the start", energy[i].initial_potential,
                    energy[0].initial_potential + shift, rounding * fabs(shift));
        check_close(&checks, "V at the end", energy[i].potential, energy[0].potential + shift,
                    rounding * fabs(shift));
        /* The residual is a difference of potentials of the size m g 1e6 ft: their rounding. */
        check_close(&checks, "residual", energy[i].residual, energy[0].residual, 1e-15 * fabs(shift));
    }
    checks_end(&checks);
}

/* ---- a body cut in two and welded together */

#define HANGING(body)                                                                                        \
    "fbd: 1\nbodies:\n  bar:\n" body "    motion: {pivot: {at: [0, 0]}}\n    initial: {theta: 100 deg}\n"    \
    "    forces:\n      - gravity\n      - applied: {fx: 2 N, at: [0, -1 m]}\nsimulate: {until: 5 s}\n"

static void a_bar_welded_of_two_swings_as_one(void **unused)
{
    (void)unused;
    static const char whole[] =
        HANGING("    shape: rod\n    mass: 3 kg\n    from: [0, 0]\n    to: [0, -1 m]\n");
    static const char welded[] =
        HANGING("    parts:\n"
                "      top: {shape: rod, mass: 0.9 kg, from: [0, 0], to: [0, -0.3 m]}\n"
                "      low: {shape: rod, mass: 2.1 kg, from: [0, -1 m], to: [0, -0.3 m]}\n");
    struct checks checks = {0};
    struct trial one = trial_parse(whole), two = trial_parse(welded);
    trial_start(&one, NULL);
    trial_start(&two, NULL);
    for (int i = 1; i <= 5; i++) {
        trial_to(&one, i);
        trial_to(&two, i);
        check_close(&checks, "theta", trial_get(&two, "theta"), trial_get(&one, "theta"), rounding);
        check_close(&checks, "omega", trial_get(&two, "omega"), trial_get(&one, "omega"), 10 * rounding);
        check_close(&checks, "pin", trial_arrow(&two, "pin").fy, trial_arrow(&one, "pin").fy, 100 * rounding);
    }
    trial_close(&one);
    trial_close(&two);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_incline_is_a_flat_with_gravity_turned),
        cmocka_unit_test(a_planar_motion_turns_with_its_axes),
        cmocka_unit_test(feet_and_slugs_move_as_metres_and_kilograms),
        cmocka_unit_test(the_order_of_the_bodies_changes_no_bit),
        cmocka_unit_test(a_body_at_rest_elsewhere_changes_no_bit),
        cmocka_unit_test(looking_changes_no_step),
        cmocka_unit_test(recording_changes_no_bit),
        cmocka_unit_test(without_works_the_motion_has_the_same_bits),
        cmocka_unit_test(the_datum_moves_v_and_no_bit_of_the_motion),
        cmocka_unit_test(a_bar_welded_of_two_swings_as_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
