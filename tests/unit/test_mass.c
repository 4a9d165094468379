/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Masses that vary: closed forms (Tsiolkovsky, a chain out of a heap, a cart in the rain, a stage that drops off), and
 * bodies that turn, swing and hang on each other against their equations, written out anew, by GSL.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "random_numbers.h"
#include "run_checks.h"

static void a_rocket(void **unused)
{
    struct random_numbers numbers = {7};
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int i = 0; i < trials; i++) {
        double m0 = random_between(&numbers, 50, 200), m1 = m0 * random_between(&numbers, 0.1, 0.6),
               b = random_between(&numbers, 0.5, 5), c = random_between(&numbers, 500, 4000);
        double T = (m0 - m1) / b, rest = random_between(&numbers, 1, 20);
        double v1 = c * log(m0 / m1) - g * T, x1 = c * T - c * m1 / b * log(m0 / m1) - g * T * T / 2;
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  r:\n    mass: 'max(%.17g[kg] - %.17g[kg/s]*t, %.17g[kg])'\n"
                 "    motion: {slide: {along: 90 deg}}\n    forces: [gravity, thrust: {exhaust: %.17g}]\n"
                 "simulate: {until: %.17g}\n",
                 m0, b, m1, c, T + rest);
        struct trial trial = run_of(text);
        double size = c + g * (T + rest);
        check_close(&checks, "v", get(&trial, "r.v"), v1 - g * rest, same * size);
        check_close(&checks, "x", get(&trial, "r.x"), x1 + v1 * rest - g * rest * rest / 2,
                    same * size * (T + rest));
        check_close(&checks, "m at the end", get(&trial, "r.m"), m1, 4e-16 * m1);
        check_close(&checks, "burn-out", trial_event(&trial, FBD_EVENT_SWITCH, "mass", 0), T, same * T);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void a_chain_out_of_a_heap(void **unused)
{
    struct checks checks = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    (void)unused;
    options.tolerance = 1e-12;
    struct trial trial = trial_open("kinetics/falling_chain.yaml", NULL);
    trial_run(&trial, &options);
    double x = get(&trial, "chain.x"), x0 = 0.1, none;
    check_close(&checks, "lambda x", get(&trial, "chain.m"), 2 * x, 1e-15 * x);
    check_that(&checks, "no other", !fbd_state_get(trial.state, "chai.m", &none));
    check_that(&checks, "of no body", !fbd_state_get(trial.state, "m", &none));
    check_close(&checks, "v", get(&trial, "chain.v"), sqrt(2 * g / 3 * (x - x0 * x0 * x0 / x / x)), same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* A chain that runs out of a heap down a gutter: as a slide and as a straight track. */
static void a_chain_on_a_track(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial =
        run_of("fbd: 1\nbodies:\n"
               "  line: {mass: '2[kg/m]*x', motion: {slide: {along: -90 deg}}, initial: {x: 0.1},\n"
               "    forces: [gravity, thrust: {velocity: 0}]}\n"
               "  curve: {mass: '2[kg/m]*s', initial: {s: 0.1},\n"
               "    motion: {track: {x: '0*p', y: -p, from: 0 m, to: 9 m}},\n"
               "    forces: [gravity, thrust: {velocity: 0}]}\n"
               "simulate: {until: 1}\n");
    check_close(&checks, "s", get(&trial, "curve.s"), get(&trial, "line.x"), same);
    check_close(&checks, "v", get(&trial, "curve.v"), get(&trial, "line.v"), same);
    trial_close(&trial);
    checks_end(&checks);
}

static void a_cart_in_the_rain(void **unused)
{
    const double m = 20 + 0.5 * 20;
    struct checks checks = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    (void)unused;
    options.tolerance = 1e-12;
    struct trial trial = trial_open("kinetics/cart_in_rain.yaml", NULL);
    trial_run(&trial, &options);
    check_close(&checks, "m v", get(&trial, "cart.v") * m, 60, 60 * same);
    check_close(&checks, "x", get(&trial, "cart.x"), 60 / 0.5 * log(m / 20), 100 * same);
    check_close(&checks, "N", arrow_of(&trial, 0, "normal").fy, m * g + 0.5 * 8, 300 * same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* Atwood's machine whose one mass goes with the time: v is an integral of the time alone. */
static void a_bucket_that_leaks(void **unused)
{
    const double b = 0.5, rest = 2 + 0.5, T = 4; /* of the block and the pulley; when it is empty */
    struct checks checks = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    (void)unused;
    options.tolerance = 1e-12;
    struct trial trial = trial_open("couplings/leaking_bucket.yaml", NULL);
    trial_run(&trial, &options);
    /* (m1 - m2)/(m1 + rest) = 1 - (m2 + rest)/(m1 + rest) */
    double v = g * (T - (2 + rest) / b * log((3 + rest) / (1 + rest))) - g * 1 / (1 + rest) * 1;
    check_close(&checks, "v", get(&trial, "bucket.v"), v, 10 * same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* What drops off goes on with the velocity of the rocket: the rest has the same, and gains anew. */
static void a_stage_that_drops(void **unused)
{
    const double v1 = 2000 * log(100.0 / 40), v2 = v1 + 3000 * log(20.0 / 10) - g * 16;
    struct checks checks = {0};
    (void)unused;
    struct trial trial =
        run_of("fbd: 1\n"
               "bodies:\n"
               "  r:\n"
               "    mass: '100[kg] - 6[kg/s]*min(t, 10[s]) - 20[kg]*step(t - 11[s]) - "
               "2[kg/s]*clamp(t - 11[s], 0, 5[s])'\n"
               "    motion: {slide: {along: 90 deg}}\n"
               "    forces: [gravity, thrust: {exhaust: 'if(t < 11[s], 2[km/s], 3[km/s])'}]\n"
               "simulate: {until: 16}\n");
    check_close(&checks, "v", get(&trial, "r.v"), v2, 5000 * same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* A rod on a pivot in a damper: I_O goes with m, theta'' = -(3 g / 2 l) sin theta - c omega 3/(m l^2). The bearing rubs. */
static int swings(double t, const double *y, double *dydt, void *unused)
{
    const double l = 1.2, m = 2 * exp(-t / 3), I = m * l * l / 3;
    (void)unused;
    dydt[0] = y[1];
    dydt[1] = (-m * g * l / 2 * cos(y[0]) - 0.2 * y[1]) / I;
    return GSL_SUCCESS;
}

static void a_rod_that_loses_mass(void **unused)
{
    struct checks checks = {0};
    double y[2] = {0.3, 0};
    (void)unused;
    struct trial trial = run_of("fbd: 1\n"
                                "bodies:\n"
                                "  rod:\n"
                                "    mass: 2[kg]*exp(-t/3[s])\n"
                                "    shape: rod\n"
                                "    length: 1.2 m\n"
                                "    motion: {pivot: {point: left}}\n"
                                "    initial: {theta: 0.3}\n"
                                "    forces: [gravity]\n"
                                "    moments: [damper: 0.2 N*m*s]\n"
                                "    hand: 'I_O*omega_dot = -m*g*L*cos(theta) - 0.2[N*m*s]*omega'\n"
                                "simulate: {until: 4}\n");
    integrate(swings, NULL, 2, 4, y);
    check_close(&checks, "theta", get(&trial, "rod.theta"), y[0], same);
    check_close(&checks, "omega", get(&trial, "rod.omega"), y[1], same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* Two rods of varying masses on each other: m1 by the time, m2 by a state that the first one's angle fills. In absolute
 * angles, M a = f with the masses of the instant. y = [q1, q2, w1, w2, m2] */
static int two_rods(double t, const double *y, double *dydt, void *unused)
{
    const double l1 = 1, l2 = 0.7, m1 = 3 - 0.4 * t, m2 = y[4];
    double c = cos(y[1] - y[0]), s = sin(y[1] - y[0]);
    double A = m1 * l1 * l1 / 3 + m2 * l1 * l1, B = m2 * l1 * l2 / 2 * c, C = m2 * l2 * l2 / 3;
    double f1 = m2 * l1 * l2 / 2 * s * y[3] * y[3] - (m1 / 2 + m2) * g * l1 * cos(y[0]),
           f2 = -m2 * l1 * l2 / 2 * s * y[2] * y[2] - m2 * g * l2 / 2 * cos(y[1]);
    double det = A * C - B * B;
    (void)unused;
    dydt[0] = y[2];
    dydt[1] = y[3];
    dydt[2] = (C * f1 - B * f2) / det;
    dydt[3] = (A * f2 - B * f1) / det;
    dydt[4] = 0.3 * (1 + sin(y[0]) * sin(y[0]));
    return GSL_SUCCESS;
}

static const char rods[] = "fbd: 1\n"
                           "states:\n"
                           "  filled: {rate: '0.3[kg/s]*(1 + sin(first.theta)^2)', initial: 0.5 kg}\n"
                           "bodies:\n"
                           "  first:\n"
                           "    mass: 3[kg] - 0.4[kg/s]*t\n"
                           "    shape: rod\n"
                           "    length: 1 m\n"
                           "    motion: {pivot: {point: left}}\n"
                           "    initial: {theta: -0.4}\n"
                           "    forces: [gravity]\n"
                           "  second:\n"
                           "    mass: states.filled\n"
                           "    shape: rod\n"
                           "    length: 0.7 m\n"
                           "    motion: {pivot: {on: first, at: right, point: left}}\n"
                           "    initial: {theta: 0.9}\n"
                           "    forces: [gravity]\n"
                           "simulate: {until: 3}\n";

static void two_rods_that_leak_and_fill(void **unused)
{
    struct checks checks = {0};
    const char *const methods[] = {"dop853", "rodas5p", "auto"};
    double y[5] = {-0.4, 0.5, 0, 0, 0.5};
    (void)unused;
    integrate(two_rods, NULL, 5, 3, y);
    for (int i = 0; i < 3; i++) {
        const double loose = i == 1 ? 100 * same : same; /* many steps of an order of five */
        fbd_options options = FBD_OPTIONS_DEFAULT;
        options.tolerance = 1e-12;
        options.method = methods[i];
        struct trial trial = trial_parse(rods);
        trial_run(&trial, &options);
        check_close(&checks, "theta", get(&trial, "first.theta"), y[0], loose);
        check_close(&checks, "angle", get(&trial, "first.theta") + get(&trial, "second.theta"), y[1], loose);
        check_close(&checks, "omega", get(&trial, "first.omega"), y[2], 10 * loose);
        check_close(&checks, "mass", get(&trial, "states.filled"), y[4], loose);
        if (i != 1) check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A hull in the plane with a tank welded on it aside of its centre, which burns: m a_O, about the origin O of the hull
 * with the mass M = mh + mt, its moment mt r and J = Ih + mt (k^2 + r^2):
 *
 *     M a + (alpha k x - omega^2) mt R r = F,   J alpha + mt R r x a = moment of F about O.
 *
 * y = [x, y, q, vx, vy, w] */
static int burns(double t, const double *y, double *dydt, void *unused)
{
    const double mh = 40, mt = 60 - 2 * t, r[2] = {-1, 0.2}, at[2] = {-1.5, 0.1}, tilt = 0.03, c = 1500;
    double Ih = mh * 16 / 12, J = Ih + mt * (0.4 * 0.4 / 2 + r[0] * r[0] + r[1] * r[1]), M = mh + mt;
    double cq = cos(y[2]), sq = sin(y[2]);
    double mx = mt * (cq * r[0] - sq * r[1]), my = mt * (sq * r[0] + cq * r[1]);
    double px = cq * at[0] - sq * at[1], py = sq * at[0] + cq * at[1];
    double fx = 2 * c * cos(y[2] + tilt), fy = 2 * c * sin(y[2] + tilt);
    double Fx = fx + y[5] * y[5] * mx, Fy = fy - M * g + y[5] * y[5] * my;
    double moment = px * fy - py * fx - mx * g;
    /* a = (F - alpha k x m)/M in the last equation */
    double alpha = (moment - (mx * Fy - my * Fx) / M) / (J - (mx * mx + my * my) / M);
    (void)unused;
    dydt[0] = y[3];
    dydt[1] = y[4];
    dydt[2] = y[5];
    dydt[3] = (Fx + alpha * my) / M;
    dydt[4] = (Fy - alpha * mx) / M;
    dydt[5] = alpha;
    return GSL_SUCCESS;
}

static void a_hull_with_a_tank(void **unused)
{
    struct checks checks = {0};
    double y[6] = {0, 0, 1.4, 0, 0, 0};
    (void)unused;
    struct trial trial = run_of("fbd: 1\n"
                                "bodies:\n"
                                "  hull: {mass: 40, shape: rod, length: 4, motion: planar, initial: {theta: "
                                "1.4}, forces: [gravity]}\n"
                                "  tank:\n"
                                "    mass: 60[kg] - 2[kg/s]*t\n"
                                "    shape: disc\n"
                                "    radius: 0.4\n"
                                "    motion: {weld: {on: hull, at: [-1, 0.2], angle: 0.5}}\n"
                                "    forces:\n"
                                "      - gravity\n"
                                "      - thrust: {exhaust: 1500, angle: 0.03 - 0.5, frame: body, at: "
                                "[-0.48673383480560667, 0.15195451311306424]}\n"
                                "simulate: {until: 3}\n");
    integrate(burns, NULL, 6, 3, y);
    check_close(&checks, "x", get(&trial, "hull.x"), y[0], 100 * same);
    check_close(&checks, "y", get(&trial, "hull.y"), y[1], 100 * same);
    check_close(&checks, "theta", get(&trial, "hull.theta"), y[2], 10 * same);
    check_close(&checks, "vy", get(&trial, "hull.vy"), y[4], 100 * same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* Sand falls on a sled that slips on a rough way, is tied to a spring and stops: m v' = -k x - mu (m g + m' w) - m' v. */
static int slips(double t, const double *y, double *dydt, void *unused)
{
    const double rate = 0.7, m = 2 + rate * t, w = 4, mu = 0.2;
    (void)unused;
    dydt[0] = y[1];
    dydt[1] = (-30 * y[0] - mu * (m * g + rate * w) - rate * y[1]) / m;
    return GSL_SUCCESS;
}

static void sand_on_a_sled(void **unused)
{
    struct checks checks = {0};
    double y[2] = {0, 3};
    (void)unused;
    struct trial trial =
        run_of("fbd: 1\n"
               "bodies:\n"
               "  sled:\n"
               "    mass: 2[kg] + 0.7[kg/s]*t\n"
               "    motion: slide\n"
               "    initial: {v: 3}\n"
               "    forces: [gravity, normal, friction: 0.2, spring: 30 N/m, thrust: {velocity: "
               "[0, -4 m/s]}]\n"
               "simulate: {until: 0.3}\n");
    integrate(slips, NULL, 2, 0.3, y);
    check_close(&checks, "x", get(&trial, "sled.x"), y[0], same);
    check_close(&checks, "v", get(&trial, "sled.v"), y[1], same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* A mass by a table, m = 2 kg - t and then 1 kg, under 1 N: v = ln(2/m) up to 1 s, and t - 1 + ln 2 behind; x(1) = 1 - ln 2. */
static void a_mass_by_a_table(void **unused)
{
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "tables: {m_of: {points: [[0, 2 kg], [1 s, 1 kg]]}}\n"
                    "bodies: {cart: {mass: m_of(t), motion: slide, forces: [applied: 1 N]}}\n"
                    "simulate: {until: 2}\n");
    (void)unused;
    trial_start(&trial, NULL);
    trial_to(&trial, 2);
    check_close(&checks, "v", get(&trial, "cart.v"), 1 + log(2), 1e-9); /* two steps and more at 1e-10 */
    check_close(&checks, "x", get(&trial, "cart.x"), 1.5, 1e-9);        /* 1 - ln 2 + ln 2 + 1/2 */
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rocket),
        cmocka_unit_test(a_chain_out_of_a_heap),
        cmocka_unit_test(a_chain_on_a_track),
        cmocka_unit_test(a_cart_in_the_rain),
        cmocka_unit_test(a_bucket_that_leaks),
        cmocka_unit_test(a_stage_that_drops),
        cmocka_unit_test(a_rod_that_loses_mass),
        cmocka_unit_test(two_rods_that_leak_and_fill),
        cmocka_unit_test(a_hull_with_a_tank),
        cmocka_unit_test(sand_on_a_sled),
        cmocka_unit_test(a_mass_by_a_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
