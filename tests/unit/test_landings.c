/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What rolls, in impacts: it lands and rubs as it does, what jerks lifts it, and what strikes in turn comes to rest.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gallery.h"

static const double m = 2, r = 0.2, tiny = 1e-9;

/* A disc thrown up from its floor by 1 m/s, with `omega`; `rub` has the coefficients. It is back with 1 m/s. */
static struct trial land(double omega, const char *rub)
{
    char text[700];
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: 10\nground: {lines: {floor: {along: 0}}}\nbodies:\n  wheel:\n    shape: disc\n"
             "    radius: %g\n    mass: %g\n    motion: planar\n    initial: {y: %g, vy: 1, omega: %g}\n"
             "    forces: [gravity]\ncouplings:\n  - roll: {name: tread, body: wheel, on: floor%s}\n"
             "simulate: {until: 0.3, tolerance: 1e-12}\n",
             r, m, r, omega, rub);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    return trial;
}

/* With the impulse 2 N*s across it 0.6 N*s are the most along, which slow down 30 rad/s and stop 2 rad/s; without
 * a limit it rolls. v_t = v + omega r, and the mass along is 1/(1/m + r^2/I) = m/3. */
static void a_landing_rubs(void **unused)
{
    static const struct {
        double omega, tau;
        const char *rub;
    } cases[] = {{30, -0.6, ", static: 0.3"},
                 {2, -0.4 * 2 / 3, ", static: 0.3"},
                 {30, -4, ""},
                 {30, 0, ", static: 0"}};
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct trial trial = land(cases[i].omega, cases[i].rub);
        const double tau = cases[i].tau, before = cases[i].omega * r, after = before + 3 * tau / m;
        check_close(&checks, "t", trial_to_event(&trial, FBD_EVENT_LANDING, NULL, 0), 0.2, tiny);
        check_close(&checks, "vx", trial_get(&trial, "vx"), tau / m, tiny);
        check_close(&checks, "x", trial_get(&trial, "x"), 0, tiny);
        check_close(&checks, "vy", trial_get(&trial, "vy"), 0, tiny);
        check_close(&checks, "omega", trial_get(&trial, "omega"), cases[i].omega + 2 * tau / (m * r), 1e-7);
        for (size_t k = 0; k < fbd_simulation_event_count(trial.simulation); k++) {
            fbd_event event = fbd_simulation_event(trial.simulation, k);
            if (event.kind != FBD_EVENT_LANDING) continue;
            char takes[60];
            snprintf(takes, sizeof takes, "takes %.6g J", m / 2 - tau * (before + after) / 2);
            check_that(&checks, takes, strstr(event.detail, takes));
        }
        trial_to(&trial, 0.25);
        check_that(&checks, "it goes on from there", fabs(trial_get(&trial, "x")) < 0.3);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A rope to a point above jerks: its floor does not hold it down, v' = v - (v . u) u. */
static void a_jerk_lifts_a_wheel(void **unused)
{
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\ngravity: 10\nground: {lines: {floor: {along: 0}}, points: {A: [0, 1]}}\nbodies:\n  wheel:\n"
        "    shape: disc\n    radius: 0.2\n    mass: 2\n    motion: planar\n    initial: {y: 0.2, vx: 1, "
        "omega: -5}\n"
        "    forces: [gravity]\ncouplings:\n  - roll: {body: wheel, on: floor, static: 0.3}\n"
        "  - rope: {through: [ground.A, wheel.G], length: 1}\nsimulate: {until: 1, tolerance: 1e-12}\n");
    (void)unused;
    trial_start(&trial, NULL);
    check_close(&checks, "t", trial_to_event(&trial, FBD_EVENT_ROPE_TAUT, NULL, 0), 0.6, tiny);
    check_close(&checks, "vx", trial_get(&trial, "vx"), 1 - 0.6 * 0.6, tiny);
    check_close(&checks, "vy", trial_get(&trial, "vy"), 0.6 * 0.8, tiny);
    check_close(&checks, "omega", trial_get(&trial, "omega"), -5, tiny);
    check_that(&checks, "it lifts off", trial_event(&trial, FBD_EVENT_LIFT_OFF, NULL, 0) > 0);
    trial_close(&trial);
    checks_end(&checks);
}

/* A follower at rest on its cam is pulled away by a rope: the cam does not hold it. */
static void a_jerk_lifts_a_follower(void **unused)
{
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\ngravity: 10\nground: {points: {P: [0, 0]}}\nbodies:\n"
        "  follower: {mass: 1, motion: particle, forces: [gravity]}\n"
        "  kite: {mass: 3, motion: {slide: {along: 90 deg}}, initial: {x: 1, v: 2}}\ncouplings:\n"
        "  - slot: {name: cam, between: [follower, ground.P], side: left}\n"
        "  - rope: {through: [follower, kite], length: 2}\nsimulate: {until: 0.6, tolerance: 1e-12}\n");
    (void)unused;
    trial_start(&trial, NULL);
    check_close(&checks, "t", trial_to_event(&trial, FBD_EVENT_ROPE_TAUT, NULL, 0), 0.5, tiny);
    check_close(&checks, "vy", trial_get(&trial, "follower.vy"), 1.5, tiny);
    check_close(&checks, "v", trial_get(&trial, "kite.v"), 1.5, tiny);
    trial_close(&trial);
    checks_end(&checks);
}

/* It lifts off while it rolls, turns in the air, and lands sticking: it is still where it was (what sticks was put back to
 * where it would be, had it rolled all the way, which is some 2 m off here). */
static void it_rolls_on_from_where_it_lands(void **unused)
{
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\ngravity: 10\nground: {lines: {floor: {along: 0}}}\nbodies:\n  wheel:\n    shape: disc\n"
        "    radius: 0.2\n    mass: 2\n    motion: planar\n    initial: {y: 0.2}\n    forces:\n      - "
        "gravity\n"
        "      - applied: {name: up, value: \"40[N]*pulse(t, 0.1[s], 0.2[s])\", angle: 90 deg}\n"
        "    moments: [applied: {name: turn, value: \"2[N*m]*(pulse(t, 0.2[s], 0.2[s]) - pulse(t, 0.4[s], "
        "0.2[s]))\"}]\n"
        "couplings:\n  - roll: {body: wheel, on: floor, static: 0.3}\nsimulate: {until: 2}\n");
    (void)unused;
    trial_start(&trial, NULL);
    trial_to(&trial, 0.65);
    check_close(&checks, "it is in the air", trial_get(&trial, "theta"), 2, 1e-8);
    trial_finish(&trial);
    check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
    check_close(&checks, "x", trial_get(&trial, "x"), 0, 1e-8);
    check_close(&checks, "theta", trial_get(&trial, "theta"), 2, 1e-8);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_landing_rubs),
        cmocka_unit_test(it_rolls_on_from_where_it_lands),
        cmocka_unit_test(a_jerk_lifts_a_wheel),
        cmocka_unit_test(a_jerk_lifts_a_follower),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
