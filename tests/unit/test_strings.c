/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ropes that are wound on discs and ropes whose length varies, against solutions by hand and against integrations of
 * the equations of textbooks in other coordinates.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "joined_checks.h"

static const double g = 9.81, pi = 3.141592653589793;

/* ---- one coordinate: by hand */

static void a_yo_yo_falls_as_its_axle_says(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/yo_yo.yaml", NULL);
    const double m = 0.08, R = 0.04, r = 0.01, I = m * R * R / 2, a = g / (1 + I / (m * r * r));
    trial_start(&trial, NULL);
    trial_to(&trial, 0.7);
    check_close(&checks, "y", trial_get(&trial, "yo_yo.y"), -a * 0.7 * 0.7 / 2, 1e-12);
    check_close(&checks, "x", trial_get(&trial, "yo_yo.x"), 0, 1e-15);
    check_close(&checks, "omega", trial_get(&trial, "yo_yo.omega"), a * 0.7 / r, 1e-9);
    check_close(&checks, "tension", arrow_on(&trial, 0, "string").fy, m * g / (1 + m * r * r / I), 1e-12);
    check_close(&checks, "moment", arrow_on(&trial, 0, "string").moment, m * g / (1 + m * r * r / I) * r,
                1e-14);
    trial_close(&trial);
    checks_end(&checks);
}

/* Wound on the other side it turns the other way; a spool that falls with its string still wound on ends its run. */
static void an_unwound_string_ends_the_run(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "ground: {points: {hand: [-0.01, 1]}}\n"
                    "bodies:\n"
                    "  spool: {mass: 0.08, shape: disc, radius: 0.04, motion: planar, forces: [gravity]}\n"
                    "couplings:\n"
                    "  - rope: {name: s, through: [ground.hand, spool], wound: {on: spool, side: left, "
                    "radius: 0.01, length: 0.5}}\n"
                    "simulate: {until: 9}\n");
    trial_start(&trial, NULL);
    double end = to_its_end(&trial);
    check_that(&checks, "ends early", trial.outcome == FBD_BROKEN);
    const double a = g / 9, t = sqrt(2 * 0.5 / a);
    check_close(&checks, "when", end, t, 1e-9);
    check_close(&checks, "turned", trial_get(&trial, "spool.theta"), -0.5 / 0.01, 1e-8);
    check_that(&checks, "says so",
               strstr(fbd_simulation_reason(trial.simulation), "all unwound from `spool`") != NULL);
    trial_close(&trial);
    checks_end(&checks);
}

static void a_stepped_pulley_weighs_moments(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/stepped_pulley.yaml", NULL);
    const double alpha = (3 * 0.1 - 1 * 0.2) * g / (2 * 0.04 / 2 + 1 * 0.04 + 3 * 0.01); /* clockwise */
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    check_close(&checks, "theta", trial_get(&trial, "pulley.theta"), -alpha / 2, 1e-11);
    check_close(&checks, "light", trial_get(&trial, "light.x"), -0.2 * alpha / 2, 1e-12);
    check_close(&checks, "heavy", trial_get(&trial, "heavy.v"), 0.1 * alpha, 1e-12);
    check_close(&checks, "outer", arrow_on(&trial, 1, "outer").fy, 1 * (g + 0.2 * alpha), 1e-11);
    check_close(&checks, "inner", arrow_on(&trial, 2, "inner").fy, 3 * (g - 0.1 * alpha), 1e-11);
    check_close(&checks, "axle", arrow_on(&trial, 0, "pin").fy, 4 * g + 0.2 * alpha - 0.3 * alpha, 1e-11);
    trial_close(&trial);
    checks_end(&checks);
}

/* A spool on a rough floor is pulled by its cord, which is wound on the hub and comes off its underside at a height that
 * the winder's end has too: it winds itself up towards the pull, a = F (1 - r/R) / (m + I/R^2). */
static void a_spool_winds_itself_up_towards_the_pull(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "ground: {lines: {floor: {along: 0 deg}}}\n"
        "bodies:\n"
        "  spool: {mass: 2, shape: disc, radius: 0.2, motion: planar, initial: {y: 0.2}, forces: [gravity]}\n"
        "  hand:\n"
        "    mass: 0.5\n"
        "    motion: {slide: {through: [3, 0.1]}}\n"
        "    forces: [applied: {name: pull, value: 6 N}]\n"
        "couplings:\n"
        "  - roll: {name: tread, body: spool, on: floor}\n"
        "  - rope: {name: cord, through: [spool, hand], wound: {on: spool, side: bottom, radius: 0.1}}\n"
        "simulate: {until: 1}\n");
    /* v_hand = v - r/R v of the hub's underside: with k = 1 - r/R, F = m_h k a + T, T k = (m + I/R^2) a. */
    const double k = 0.5, a = 6 * k / (2 * 1.5 + 0.5 * k * k);
    trial_start(&trial, NULL);
    trial_to(&trial, 1);
    check_close(&checks, "x", trial_get(&trial, "spool.x"), a / 2, 1e-12);
    check_close(&checks, "hand", trial_get(&trial, "hand.x"), k * a / 2, 1e-12);
    check_close(&checks, "turned", trial_get(&trial, "spool.theta"), -a / 2 / 0.2, 1e-11);
    check_close(&checks, "tension", arrow_on(&trial, 0, "cord").fx, 3 * a / k, 1e-11);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- round a peg: energy, and time by quadrature */

static const double R_peg = 0.1, L = 1, m_bob = 0.5, v_0 = 2;

static double speed_at(double phi)
{
    double y = R_peg * cos(phi) - (L - R_peg * phi) * sin(phi);
    return sqrt(v_0 * v_0 + 2 * g * (R_peg - y));
}

/* The time in which phi is wound, by Simpson's rule. */
static double time_to(double phi)
{
    enum { parts = 2000 };
    double h = phi / parts, sum = 0;
    for (int i = 0; i <= parts; i++) {
        double at = i * h, weight = i == 0 || i == parts ? 1 : i % 2 ? 4 : 2;
        sum += weight * (L - R_peg * at) / speed_at(at);
    }
    return sum * h / 3;
}

static void check_bob(struct checks *checks, struct trial *trial)
{
    double x = trial_get(trial, "bob.x"), y = trial_get(trial, "bob.y");
    double ell = sqrt(x * x + y * y - R_peg * R_peg), phi = (L - ell) / R_peg, speed = speed_at(phi);
    check_close(checks, "x of the involute", x, R_peg * sin(phi) + ell * cos(phi), 1e-11);
    check_close(checks, "y of the involute", y, R_peg * cos(phi) - ell * sin(phi), 1e-11);
    check_close(checks, "speed", hypot(trial_get(trial, "bob.vx"), trial_get(trial, "bob.vy")), speed, 1e-9);
    check_close(checks, "time", trial_get(trial, "t"), time_to(phi), 1e-9);
    fbd_arrow string = arrow_on(trial, 0, "string");
    check_close(checks, "tension", hypot(string.fx, string.fy), m_bob * (speed * speed / ell + g * sin(phi)),
                1e-8);
}

static void a_pendulum_winds_itself_round_a_peg(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/winding_pendulum.yaml", NULL);
    trial_start(&trial, NULL);
    for (int i = 1; i <= 8; i++) {
        trial_to(&trial, 0.1 * i);
        check_bob(&checks, &trial);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* A puck on a table keeps its speed v, and ell ell_dot = -R v: the string is used up at t = L^2 / (2 R v). */
static void a_puck_ends_at_the_peg(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "ground: {points: {peg: [0, 0]}}\n"
                    "bodies:\n"
                    "  puck: {mass: 0.5, motion: particle, initial: {x: 1, y: -0.1, vy: 1}}\n"
                    "couplings:\n"
                    "  - rope: {name: s, through: [ground.peg, puck], wound: {on: ground.peg, side: bottom, "
                    "radius: 0.1}}\n"
                    "simulate: {until: 9}\n");
    trial_start(&trial, NULL);
    trial_to(&trial, 3.2);
    double x = trial_get(&trial, "puck.x"), y = trial_get(&trial, "puck.y");
    check_close(&checks, "free length", x * x + y * y - 0.01, 1 - 2 * 0.1 * 3.2, 1e-9);
    double end = to_its_end(&trial);
    check_that(&checks, "ends early", trial.outcome == FBD_BROKEN);
    check_close(&checks, "when", end, 5, 1e-9);
    check_that(&checks, "says so",
               strstr(fbd_simulation_reason(trial.simulation), "has no length left") != NULL);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- lengths that vary */

/* ell theta_ddot = -g sin(theta) - 2 ell_dot theta_dot */
static void swing(double t, const double *s, double *ds)
{
    const double length = 5, h = 3, T = 8, w = 2 * pi / T;
    double ell = length - h * (t / T - sin(w * t) / (2 * pi)), ell_dot = -h / T * (1 - cos(w * t));
    ds[0] = s[1];
    ds[1] = (-g * sin(s[0]) - 2 * ell_dot * s[1]) / ell;
}

static void runge_kutta(double *s, double t, double h)
{
    double k1[2], k2[2], k3[2], k4[2], y[2];
    swing(t, s, k1);
    for (int i = 0; i < 2; i++) y[i] = s[i] + h / 2 * k1[i];
    swing(t + h / 2, y, k2);
    for (int i = 0; i < 2; i++) y[i] = s[i] + h / 2 * k2[i];
    swing(t + h / 2, y, k3);
    for (int i = 0; i < 2; i++) y[i] = s[i] + h * k3[i];
    swing(t + h, y, k4);
    for (int i = 0; i < 2; i++) s[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
}

static void a_winch_lifts_what_swings(void **unused)
{
    (void)unused;
    enum { steps = 40000 };
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/winch.yaml", NULL);
    double s[2] = {5 * pi / 180, 0}, h = 8.0 / steps;
    for (int i = 0; i < steps; i++) runge_kutta(s, i * h, h);
    trial_run(&trial, NULL);
    double ell = 5 - 3.0, x = trial_get(&trial, "crate.x"), y = trial_get(&trial, "crate.y");
    check_close(&checks, "length", hypot(x, y), ell, 1e-12);
    check_close(&checks, "angle", atan2(x, -y), s[0], 1e-9);
    check_close(&checks, "vx", trial_get(&trial, "crate.vx"), ell * s[1] * cos(s[0]), 1e-8);
    fbd_arrow cable = arrow_on(&trial, 0, "cable");
    check_close(&checks, "tension", hypot(cable.fx, cable.fy), 50 * (g * cos(s[0]) + ell * s[1] * s[1]),
                1e-6);
    /* The winch pays for height and motion. */
    fbd_energy energy = fbd_result_energy(trial.result);
    double lifted = 50 * g * (y + 5 * cos(5 * pi / 180)), moves = 25 * ell * ell * s[1] * s[1];
    check_close(&checks, "work", energy.work, lifted + moves, 1e-6);
    trial_close(&trial);
    checks_end(&checks);
}

/* Paid out at L'' > g the cable goes slack, and snaps taut where the load falls past it; the impact is that of the
 * relative speed, and the ledger knows what the winch had to do with it. */
static void a_load_falls_into_its_cable(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "ground: {points: {top: [0, 0]}}\n"
                    "bodies:\n"
                    "  load: {mass: 5, motion: {slide: {along: 90 deg, through: [0, -2]}}, initial: {v: 1}, "
                    "forces: [gravity]}\n"
                    "couplings:\n"
                    "  - rope: {name: cable, through: [ground.top, load], length: \"2.3 - 0.4[m/s]*t\"}\n"
                    "simulate: {until: 1}\n");
    trial_run(&trial, NULL);
    /* 2.3 - 0.4 t = 2 - t + g t^2/2 */
    double t = (0.6 + sqrt(0.36 + 2 * g * 0.3)) / g, v = 1 - g * t;
    check_close(&checks, "taut", trial_event(&trial, FBD_EVENT_ROPE_TAUT, NULL, 0), t, 1e-10);
    check_close(&checks, "v", trial_get(&trial, "load.v"), 0.4, 1e-12);
    check_close(&checks, "x", trial_get(&trial, "load.x"), -0.3 + 0.4, 1e-12);
    fbd_energy energy = fbd_result_energy(trial.result);
    check_close(&checks, "work", energy.work, 5 * g * 0.4 * (1 - t) + 2.5 * (0.16 - v * v), 1e-9);
    check_close(&checks, "residual", energy.residual, 0, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* A length that starts at once has no rate there. */
static void a_winch_that_jerks_ends_the_run(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "ground: {points: {top: [0, 0]}}\n"
        "bodies: {load: {mass: 5, motion: {slide: {along: 90 deg, through: [0, -2]}}, forces: [gravity]}}\n"
        "couplings:\n"
        "  - rope: {name: cable, through: [ground.top, load], length: \"2 - 0.4[m/s]*max(0, t - 0.5)\"}\n"
        "simulate: {until: 1}\n");
    trial_start(&trial, NULL);
    double end = to_its_end(&trial);
    check_that(&checks, "ends early", trial.outcome == FBD_BROKEN);
    check_close(&checks, "when", end, 0.5, 1e-12);
    check_that(&checks, "says so",
               strstr(fbd_simulation_reason(trial.simulation), "rate of the length") != NULL);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- from drum to drum: all methods, energy */

static const char from_drum_to_drum[] =
    "fbd: 1\n"
    "ground: {points: {B: [2, 0.3]}}\n"
    "bodies:\n"
    "  cart: {mass: 3, motion: {slide: {along: 10 deg}}, forces: [gravity, spring: {stiffness: 30}]}\n"
    "  arm: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: cart, point: left}}, initial: {theta: 20 "
    "deg},\n"
    "        forces: [gravity]}\n"
    "  drum: {shape: disc, mass: 2, radius: 0.2, motion: {pivot: {on: arm, at: right}},\n"
    "         initial: {theta: 1.3 rad, omega: -1, assemble: true}}\n"
    "  sheave: {shape: disc, mass: 1, radius: 0.15, motion: {pivot: {at: B}}, initial: {assemble: true}}\n"
    "  bob: {mass: 1.5, shape: disc, radius: 0.1, motion: planar,\n"
    "        initial: {x: 2.4, y: -1.5, omega: 2, vx: 0.3, assemble: true}, forces: [gravity]}\n"
    "couplings:\n"
    "  - rope: {name: r, through: [drum, sheave, bob],\n"
    "           wound: [{on: drum, side: top}, {on: bob, side: left, radius: 0.05}]}\n"
    "simulate: {until: 1}\n";

static void methods_agree_on_a_rope_from_drum_to_drum(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const char *const names[] = {"drum.theta", "bob.x", "bob.theta", "cart.v"};
    double first[4];
    for (int method = 0; method < 2; method++) {
        struct trial trial = trial_parse(from_drum_to_drum);
        fbd_options options = FBD_OPTIONS_DEFAULT;
        options.method = method == 0 ? "dop853" : "rodas5p"; /* with exact Jacobians */
        trial_run(&trial, &options);
        check_close(&checks, "residual", fbd_result_energy(trial.result).residual, 0, 1e-8);
        for (int i = 0; i < 4; i++) {
            double value = trial_get(&trial, names[i]);
            if (method == 0) first[i] = value;
            check_close(&checks, names[i], value, first[i], 1e-8);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Atwood's machine whose lighter weight is drawn up past its pulley, on a line that touches the rim. At the height y over
 * the axle the rope on its side is L = pi R - y below it (y < 0), and R (pi - 2 arctan(y/R)) + y above, the rope being straight
 * from the rim to the weight. By the energy, with J = I/R^2, v^2 (m2 + (m1 + J) L'^2)/2 = m1 g (L(y0) - L(y)) - m2 g (y - y0); at
 * y = R the rope is across its way, L' = 0, and the pulley turns back, with all momentum in m2. */
static double rope_beside(double R, double y, double *slope)
{
    *slope = y < 0 ? -1 : 1 - 2 / (1 + y * y / (R * R));
    return y < 0 ? pi * R - y : R * (pi - 2 * atan(y / R)) + y;
}

static double speed_beside(double m1, double y)
{
    const double m2 = 2, R = 0.1, J = 2, from = -4;
    double slope, L0 = rope_beside(R, from, &slope), way = rope_beside(R, y, &slope);
    return sqrt(2 * g * (m1 * (L0 - way) - m2 * (y - from)) / (m2 + (m1 + J) * slope * slope));
}

static void a_weight_is_drawn_past_its_pulley(void **unused)
{
    (void)unused;
    enum { parts = 2000 };
    const double m2 = 2, R = 0.1, J = 2;
    struct checks checks = {0};
    for (double m1 = 2.5; m1 < 9; m1 += 0.5) {
        char setting[40];
        snprintf(setting, sizeof setting, "m_1=%g kg", m1);
        struct trial trial = trial_open("couplings/atwood.yaml", SET(setting));
        double h = R / parts, t = sqrt(8 * (m1 + m2 + J) / ((m1 - m2) * g));
        for (int i = 0; i < parts; i++)
            t += h / 6 *
                 (1 / speed_beside(m1, i * h) + 4 / speed_beside(m1, (i + 0.5) * h) +
                  1 / speed_beside(m1, (i + 1) * h));
        fbd_options options = FBD_OPTIONS_DEFAULT;
        options.until = t;
        trial_run(&trial, &options);
        check_that(&checks, "done", trial.outcome == FBD_DONE);
        check_close(&checks, "it has gone up", -trial_get(&trial, "m2.x"), 4 + R, 1e-8);
        check_close(&checks, "v", -trial_get(&trial, "m2.v"), speed_beside(m1, R), 1e-7);
        check_close(&checks, "v of m1", trial_get(&trial, "m1.v"), 0, 1e-6);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A load on a cable whose length switches: it is assembled on the branch of the start, and goes on with it. */
static void a_winch_starts_on_its_branch(void **unused)
{
    static const struct {
        const char *law;
        double length, rate; /* at t = 0 */
    } cases[] = {{"2 + 0.1*abs(t - 0.3)", 2.03, -0.1},
                 {"2 + 0.1*abs(t + 0.3)", 2.03, 0.1},
                 {"if(t < 0.5, 2.5 - 0.2*t, 3)", 2.5, -0.2},
                 {"min(2 + 0.1*t, 1.5 - 0.2*t)", 1.5, -0.2},
                 {"max(2 + 0.1*t, 1.5 - 0.2*t)", 2, 0.1}};
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double until = 0.2, h = 3 - cases[i].length, v = -cases[i].rate;
        char text[600];
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {P: [0, 3]}}\nbodies: {load: {mass: 1, motion: {slide: {along: 90 "
                 "deg}}, initial: {assemble: "
                 "true}, forces: [gravity]}}\ncouplings: [rope: {through: [ground.P, load], length: "
                 "\"%s\"}]\nsimulate: {until: %g}\n",
                 cases[i].law, until);
        struct trial trial = trial_parse(text);
        check_close(&checks, cases[i].law, trial_get(&trial, "load.x"), h, 1e-12);
        check_close(&checks, "v", trial_get(&trial, "load.v"), v, 1e-12);
        trial_run(&trial, NULL);
        check_close(&checks, "x", trial_get(&trial, "load.x"), h + v * until, 1e-11);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_yo_yo_falls_as_its_axle_says),
        cmocka_unit_test(an_unwound_string_ends_the_run),
        cmocka_unit_test(a_stepped_pulley_weighs_moments),
        cmocka_unit_test(a_spool_winds_itself_up_towards_the_pull),
        cmocka_unit_test(a_pendulum_winds_itself_round_a_peg),
        cmocka_unit_test(a_puck_ends_at_the_peg),
        cmocka_unit_test(a_winch_lifts_what_swings),
        cmocka_unit_test(a_load_falls_into_its_cable),
        cmocka_unit_test(a_winch_that_jerks_ends_the_run),
        cmocka_unit_test(methods_agree_on_a_rope_from_drum_to_drum),
        cmocka_unit_test(a_weight_is_drawn_past_its_pulley),
        cmocka_unit_test(a_winch_starts_on_its_branch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
