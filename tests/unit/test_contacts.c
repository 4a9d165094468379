/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Contacts in whole scenes: bouncing to rest, impacts of bodies, sliding and rolling, lift-off.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

#include <stdio.h>
#include <string.h>

static const double g = 9.81;

/* The first event of a kind; it fails without one. */
static fbd_event event_of(struct trial *trial, fbd_event_kind kind)
{
    size_t count = fbd_simulation_event_count(trial->simulation);
    for (size_t i = 0; i < count; i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        if (event.kind == kind) return event;
    }
    fail_msg("no event of kind %s", fbd_event_kind_name(kind));
    return (fbd_event){0};
}

static size_t count_of(struct trial *trial, fbd_event_kind kind)
{
    size_t count = fbd_simulation_event_count(trial->simulation), found = 0;
    for (size_t i = 0; i < count; i++) found += fbd_simulation_event(trial->simulation, i).kind == kind;
    return found;
}

/* From 1 m: at rest from sqrt(2 h / g) (1 + e) / (1 - e) on, and then N = m g. */
static void a_ball_bounces_to_rest_at_the_end_of_the_series(void **unused)
{
    static const char *const settings[] = {"e=0.5", "e=0.7", "e=0.8", "e=0.9"};
    static const double e[] = {0.5, 0.7, 0.8, 0.9};
    (void)unused;
    struct checks checks = {0};
    for (int i = 0; i < 4; i++) {
        struct trial trial = trial_open("contact/bouncing_ball.yaml", SET(settings[i]));
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, "done", trial.outcome == FBD_DONE);
        fbd_event rest = event_of(&trial, FBD_EVENT_REST);
        check_close(&checks, settings[i], rest.t, sqrt(2 / g) * (1 + e[i]) / (1 - e[i]), 1e-9);
        check_that(&checks, "one rest", count_of(&trial, FBD_EVENT_REST) == 1);
        check_that(&checks, "some impacts", count_of(&trial, FBD_EVENT_IMPACT) > 10);
        check_close(&checks, "at the floor", trial_get(&trial, "ball.y"), 0.05, 1e-12);
        check_close(&checks, "at rest", trial_get(&trial, "ball.vy"), 0, 1e-12);
        check_close(&checks, "N = m g", trial_arrow(&trial, "floor.normal").fy, 0.2 * g, 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* e = 1: the energy stays, and the ball is at the top again after every 2 sqrt(2 h / g). */
static void a_perfect_ball_bounces_for_ever(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("contact/bouncing_ball.yaml", SET("e=1"));
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double t_1 = sqrt(2 / g), phase = fmod(10 + t_1, 2 * t_1) - t_1; /* from the last time at the top */
    check_close(&checks, "height", trial_get(&trial, "ball.y"), 1.05 - g * phase * phase / 2, 1e-9);
    check_that(&checks, "no rest", count_of(&trial, FBD_EVENT_REST) == 0);
    trial_close(&trial);
    checks_end(&checks);
}

/* The restitution falls with the speed: e = 0.9 - 0.05 s/m v. The first bounce from v = sqrt(2 g h). */
static void restitution_may_depend_on_the_speed_of_approach(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("contact/bouncing_ball.yaml", SET("e=0"));
    trial_close(&trial);
    trial =
        trial_parse("fbd: 1\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n  ball: {mass: 1 kg, motion: "
                    "particle, initial: {y: 1 m}, forces: [gravity]}\ncontacts:\n  - {between: [ball.G, "
                    "ground.floor], restitution: '0.9 - 0.05[s/m]*approach'}\nsimulate: {until: 0.6 s}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double v = sqrt(2 * g), e = 0.9 - 0.05 * v;
    check_close(&checks, "speed", trial_get(&trial, "ball.vy"), e * v - g * (0.6 - v / g), 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* A disc of mass m, radius r on a rough floor, thrown with v and no spin: it slips until v = 2/3 of it, at t
 * = v / (3 mu g), and then rolls. */
static void a_thrown_disc_slips_and_then_rolls(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n  disc: {shape: disc, radius: "
        "0.1 m, mass: 2 kg, motion: planar, initial: {y: 0.1 m, vx: 3 m/s}, forces: "
        "[gravity]}\ncontacts:\n  - {between: [disc, ground.floor], static: 0.2, kinetic: "
        "0.2}\nsimulate: {until: 1 s}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    check_close(&checks, "rolls", event_of(&trial, FBD_EVENT_STICK).t, 3 / (3 * 0.2 * g), 1e-9);
    check_close(&checks, "speed", trial_get(&trial, "disc.vx"), 2, 1e-9);
    check_close(&checks, "spin", trial_get(&trial, "disc.omega"), -20, 1e-8);
    trial_close(&trial);
    checks_end(&checks);
}

/* A force that grows, F = 4 N/s t, lifts a ball of 1 kg off when it is m g. */
static void a_growing_force_lifts_off_when_it_is_the_weight(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n  ball: {shape: sphere, radius: "
        "0.1 m, mass: 1 kg, motion: planar, initial: {y: 0.1 m}, forces: [gravity, applied: "
        "{value: '4[N/s]*t', angle: 90 deg}]}\ncontacts:\n  - {between: [ball, "
        "ground.floor]}\nsimulate: {until: 3 s}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double lift = g / 4, s = 3 - lift;
    check_close(&checks, "lift-off", event_of(&trial, FBD_EVENT_LIFT_OFF).t, lift, 1e-9);
    check_close(&checks, "height", trial_get(&trial, "ball.y"), 0.1 + 4 * s * s * s / 6, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* Two discs, e = 1, equal masses: on the line of centres they exchange their velocities. */
static void two_discs_exchange_velocities(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nbodies:\n  a: {shape: disc, radius: 0.1 m, mass: 1 kg, motion: planar, initial: {vx: 2 "
        "m/s}}\n  b: {shape: disc, radius: 0.1 m, mass: 1 kg, motion: planar, initial: {x: 1 m, y: 0.1 "
        "m}}\ncontacts:\n  - {between: [a, b], restitution: 1}\nsimulate: {until: 1 s}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double c2 = 0.75; /* the line of centres is at 30 degrees when they meet: cos^2 */
    check_close(&checks, "a", trial_get(&trial, "a.vx"), 2 - 2 * c2, 1e-12);
    check_close(&checks, "b", trial_get(&trial, "b.vx"), 2 * c2, 1e-12);
    check_close(&checks, "b, across", trial_get(&trial, "b.vy"), 2 * sqrt(c2 * (1 - c2)), 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

/* The end of a rod strikes the floor at 45 degrees: v_t as for the impact alone (test_impact). */
static void a_falling_rod_strikes_with_its_end(void **unused)
{
    static const char *const settings[] = {"mu=0", "mu=0.1", "mu=0.5", "mu=1"};
    static const double v_t[] = {-0.9, -0.797872340, -0.214285714, 0};
    (void)unused;
    struct checks checks = {0};
    for (int i = 0; i < 4; i++) {
        char text[600];
        snprintf(
            text, sizeof text,
            "fbd: 1\nparameters: {%.2s: %s}\nground: {lines: {floor: {through: [0, -1 m], along: 0 "
            "deg}}}\nbodies:\n  rod: {shape: rod, mass: 1 kg, length: 1 m, motion: planar, initial: {theta: "
            "45 "
            "deg, vy: -1 m/s}}\ncontacts:\n  - {between: [rod, ground.floor], restitution: 0.5, static: mu, "
            "kinetic: mu}\nsimulate: {until: 0.8 s}\n",
            settings[i], settings[i] + 3);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        double omega = trial_get(&trial, "rod.omega"), vx = trial_get(&trial, "rod.vx");
        double vy = trial_get(&trial, "rod.vy"), r = 0.5 * sqrt(0.5);
        /* right after the impact: G goes on as it does, and the end is at (-r, -r) from it */
        check_close(&checks, settings[i], fabs(vx + omega * r), fabs(v_t[i]), 1e-9);
        check_close(&checks, "v_n", vy - omega * r, 0.5, 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Both leave their surface where a formula says (in the models): with the angle at the located instant. */
static void a_ladder_and_a_disc_leave_where_the_force_ends(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("contact/ladder.yaml", NULL);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double t = event_of(&trial, FBD_EVENT_LIFT_OFF).t;
    trial_start(&trial, NULL);
    trial_to(&trial, t);
    check_close(&checks, "ladder", sin(trial_get(&trial, "ladder.theta")), 2.0 / 3 * sin(acos(0.5)), 1e-9);
    trial_close(&trial);
    trial = trial_open("contact/disc_leaves_drum.yaml", NULL);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    t = event_of(&trial, FBD_EVENT_LIFT_OFF).t;
    trial_start(&trial, NULL);
    trial_to(&trial, t);
    check_close(&checks, "disc", trial_get(&trial, "disc.y") / 1.1, 2.0 / 3 + 0.25 / (3 * g * 1.1), 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* A block of 0.4 x 1 m rocks: at each change of corner without slip its rate falls to 0.793103448276 of what
 * it was (test_impacts), and the corner that comes down with it. */
static void a_rocking_block_loses_its_share_at_each_corner(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nparameters: {th: 5 deg}\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n  block: "
        "{shape: "
        "prism, a: 0.4 m, b: 1 m, mass: 10 kg, motion: planar, initial: {theta: th, y: '0.2[m]*sin(th) + "
        "0.5[m]*cos(th)'}, forces: [gravity]}\ncontacts:\n  - {between: [block, ground.floor], static: 5, "
        "kinetic: "
        "5}\nsimulate: {until: 1.2 s}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    size_t count = fbd_simulation_event_count(trial.simulation), found = 0;
    double before = 0;
    for (size_t i = 0; i < count; i++) {
        fbd_event event = fbd_simulation_event(trial.simulation, i);
        double v;
        if (event.kind != FBD_EVENT_IMPACT) continue;
        assert_int_equal(sscanf(strstr(event.detail, "v_n "), "v_n %lf", &v), 1);
        if (found++ > 0) check_close(&checks, "share", v / before, 0.793103448276, 1e-5); /* six digits */
        before = v;
    }
    check_that(&checks, "impacts", found >= 5);
    trial_close(&trial);
    checks_end(&checks);
}

/* A block of 0.3 x 1 m let go at 0.05 rad: with p^2 = 3 g/(4 R), alpha = atan(0.3) a quarter takes T(th) = int dth/w, where
 * w^2 = 2 p^2 (cos(alpha - th) - cos(alpha - th_0)), and a change of corner keeps 0.876146789 of the rate (Housner 1963).
 * T(th_0) + 2 T(th_1) + 2 T(th_2) + ..., to the end, by Gauss's quadrature. */
static void a_rocking_block_comes_to_rest_in_time(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n  block: {shape: prism, a: 0.3, b: "
        "1, c: 1, mass: 2, motion: planar, initial: {theta: 0.05, y: "
        "'0.15[m]*sin(0.05) + 0.5[m]*cos(0.05)'}, forces: [gravity]}\ncontacts:\n  - {between: "
        "[block, ground.floor], static: 1}\nsimulate: {until: 3}\n");
    trial_run(&trial, NULL);
    check_close(&checks, "rest", trial_event(&trial, FBD_EVENT_REST, "contact", 0), 2.367619361242, 1e-7);
    trial_close(&trial);
    checks_end(&checks);
}

/* Three pendulums in a row that touch, e = 1, one after the other: the last one flies off with what the first
 * one brought, and comes back. */
static void a_cradle_hands_on_what_it_gets(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nground: {points: {A: [0, 1], B: [0.1, 1], C: [0.2, 1]}}\nbodies:\n  a: {shape: disc, "
        "radius: 0.05, "
        "mass: 1, motion: {pivot: {at: A, point: [0, 1]}}, initial: {theta: -30 deg}, forces: [gravity]}\n  "
        "b: "
        "{shape: disc, radius: 0.05, mass: 1, motion: {pivot: {at: B, point: [0, 1]}}, forces: [gravity]}\n  "
        "c: "
        "{shape: disc, radius: 0.05, mass: 1, motion: {pivot: {at: C, point: [0, 1]}}, forces: "
        "[gravity]}\ncontacts:\n  - {between: [a, b], restitution: 1}\n  - {between: [b, c], restitution: "
        "1}\nsimulate: {until: 1 s, impacts: propagate}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double inertia = 1 + 0.05 * 0.05 / 2, omega = trial_get(&trial, "c.omega"),
           theta = trial_get(&trial, "c.theta");
    check_close(&checks, "energy of the last", inertia * omega * omega / 2 + g * (1 - cos(theta)),
                g * (1 - cos(acos(-1) / 6)), 1e-9);
    check_close(&checks, "first at rest", trial_get(&trial, "a.omega"), 0, 1e-12);
    check_close(&checks, "second at rest", trial_get(&trial, "b.omega"), 0, 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

/* A block that a constant force pulls to a stop at x = 0, from x_0 at rest: the series of a ball, with F / m
 * for g. A pendulum that swings against a stop comes back with e times its speed. */
static void stops_are_surfaces_of_coordinates(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nbodies:\n  s: {mass: 2 kg, motion: {slide: {min: 0, max: 3 m, restitution: 0.5}}, "
        "initial: {x: 1 m}, forces: [applied: {value: -4 N}]}\n  p: {shape: rod, mass: 1 kg, length: 1 "
        "m, motion: {pivot: {point: left, max: -60 deg, restitution: 0.8}}, initial: {theta: -90 deg, "
        "omega: 4}, forces: [gravity]}\nsimulate: {until: 6 s}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    check_that(&checks, "done", trial.outcome == FBD_DONE);
    check_close(&checks, "rest", event_of(&trial, FBD_EVENT_REST).t, sqrt(2 * 1.0 / 2) * 1.5 / 0.5, 1e-9);
    check_close(&checks, "force of the stop", trial_arrow(&trial, "s_min.normal").fx, 4, 1e-9);
    size_t count = fbd_simulation_event_count(trial.simulation);
    double before = 0, after = 0, energy = 16.0 / 6 - g / 2 * (1 - cos(acos(-1) / 6));
    for (size_t i = 0; i < count && before == 0; i++) {
        fbd_event event = fbd_simulation_event(trial.simulation, i);
        if (event.kind != FBD_EVENT_IMPACT || strcmp(event.name, "p_max") != 0) continue;
        assert_int_equal(sscanf(strstr(event.detail, "v_n "), "v_n %lf to %lf", &before, &after), 2);
    }
    check_close(&checks, "speed at the stop", before, -sqrt(6 * energy), 1e-5); /* six digits are printed */
    check_close(&checks, "and after", after, -0.8 * before, 1e-5);
    trial_close(&trial);
    checks_end(&checks);
}

/* A smooth drum is alike all round: however fast it turns, the disc on it asks for no more looks. */
static void a_smooth_drum_may_turn_at_any_rate(void **unused)
{
    static const char *const rates[] = {"0", "1e9"}, *const methods[] = {NULL, "dop853", "rkf45"};
    (void)unused;
    struct checks checks = {0};
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        unsigned long samples[2];
        double x[2], vy[2];
        for (int i = 0; i < 2; i++) {
            char scene[800];
            snprintf(
                scene, sizeof scene,
                "fbd: 1\nground: {points: {O: [0, 0]}}\nbodies:\n  drum: {shape: disc, radius: 1, mass: 5, "
                "motion: "
                "{pivot: {at: O, theta: \"%s[1/s]*t\"}}}\n  disc: {shape: disc, radius: 0.1, mass: 1, "
                "motion: planar, "
                "initial: {y: 1.1, vx: 0.5}, forces: [gravity]}\ncontacts:\n  - {between: [disc, "
                "drum]}\nsimulate: "
                "{until: 1.2 s}\n",
                rates[i]);
            struct trial trial = trial_parse(scene);
            fbd_options options = FBD_OPTIONS_DEFAULT;
            options.method = methods[m];
            trial_start(&trial, &options);
            trial_finish(&trial);
            samples[i] = fbd_simulation_stats(trial.simulation).event_samples;
            x[i] = trial_get(&trial, "disc.x");
            vy[i] = trial_get(&trial, "disc.vy");
            trial_close(&trial);
        }
        check_close(&checks, "where the disc is", x[1], x[0], 1e-9);
        check_close(&checks, "how fast it falls", vy[1], vy[0], 1e-9);
        check_that(&checks, "how often it is looked at", samples[1] <= 10 * samples[0]);
    }
    checks_end(&checks);
}

/* The impacting stick of Siconos: with `newton` or `moreau` an impact that slips back may make energy, and says so;
 * the events of no other law do. */
static void an_impact_that_makes_energy_says_so(void **unused)
{
    static const char *const laws[] = {"stronge", "poisson", "newton", "moreau"};
    size_t made = 0;
    (void)unused;
    struct checks checks = {0};
    for (int i = 0; i < 4; i++) {
        char scene[800];
        snprintf(scene, sizeof scene,
                 "fbd: 1\ngravity: 10\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n  stick: {shape: "
                 "rod, mass: 1 "
                 "kg, length: 1 m, motion: planar, initial: {y: 0.3635533905932738, theta: -45 deg, vx: "
                 "-0.5, vy: 0.1, "
                 "omega: 0.1}, forces: [gravity]}\ncontacts:\n  - {between: [stick.right, ground.floor], "
                 "restitution: 1, static: 0.01, law: %s}\nsimulate: {until: 0.1 s}\n",
                 laws[i]);
        struct trial trial = trial_parse(scene);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        bool makes = strstr(event_of(&trial, FBD_EVENT_IMPACT).detail, "; makes ") != NULL;
        check_that(&checks, laws[i], i >= 2 || !makes);
        made += makes;
        trial_close(&trial);
    }
    check_that(&checks, "one of them makes energy", made > 0);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_bounces_to_rest_at_the_end_of_the_series),
        cmocka_unit_test(a_perfect_ball_bounces_for_ever),
        cmocka_unit_test(restitution_may_depend_on_the_speed_of_approach),
        cmocka_unit_test(a_thrown_disc_slips_and_then_rolls),
        cmocka_unit_test(a_growing_force_lifts_off_when_it_is_the_weight),
        cmocka_unit_test(two_discs_exchange_velocities),
        cmocka_unit_test(a_falling_rod_strikes_with_its_end),
        cmocka_unit_test(a_ladder_and_a_disc_leave_where_the_force_ends),
        cmocka_unit_test(a_rocking_block_loses_its_share_at_each_corner),
        cmocka_unit_test(a_rocking_block_comes_to_rest_in_time),
        cmocka_unit_test(a_cradle_hands_on_what_it_gets),
        cmocka_unit_test(stops_are_surfaces_of_coordinates),
        cmocka_unit_test(a_smooth_drum_may_turn_at_any_rate),
        cmocka_unit_test(an_impact_that_makes_energy_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
