/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Drag in wind: random scenes against closed forms and against equations that are written out here and integrated
 * by GSL. Each run keeps its energy.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_study.h"
#include "random_numbers.h"
#include "run_checks.h"

/* ---- drag in wind */

/* m v' = F - c (v - w): v - w - F/c dies out as exp(-c t/m), along each axis. On a line the wind across it presses
 * on its surface, with c w_n. */
static void linear_drag_approaches_the_wind(void **unused)
{
    struct random_numbers numbers = {1};
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int i = 0; i < trials; i++) {
        double m = random_between(&numbers, 0.5, 3), c = random_between(&numbers, 0.1, 2),
               wx = random_between(&numbers, -5, 5), wy = random_between(&numbers, -2, 2),
               v = random_between(&numbers, -5, 5), along = random_between(&numbers, -0.5, 0.5), t = 2;
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  free:\n    mass: %.17g\n    motion: particle\n    initial: {vx: "
                 "%.17g}\n    forces: "
                 "[gravity, drag: &air {linear: %.17g, wind: [%.17g, %.17g]}]\n  sled:\n    mass: %.17g\n    "
                 "motion: "
                 "{slide: {along: %.17g}}\n    initial: {v: %.17g}\n    forces: [gravity, normal, drag: "
                 "*air]\nsimulate: "
                 "{until: %g}\n",
                 m, v, c, wx, wy, m, along, v, t);
        struct trial trial = run_of(text);
        double T = m / c, left = exp(-t / T), along_wind = wx * cos(along) + wy * sin(along),
               across_wind = wy * cos(along) - wx * sin(along), end_x = wx, end_y = wy - g * T,
               end = along_wind - g * sin(along) * T;
        check_close(&checks, "free.vx", get(&trial, "free.vx"), end_x + (v - end_x) * left, 1e-11);
        check_close(&checks, "free.x", get(&trial, "free.x"), end_x * t + (v - end_x) * T * (1 - left),
                    1e-10);
        check_close(&checks, "free.y", get(&trial, "free.y"), end_y * t - end_y * T * (1 - left), 1e-10);
        check_close(&checks, "sled.v", get(&trial, "sled.v"), end + (v - end) * left, 1e-11);
        fbd_arrow normal = arrow_of(&trial, 1, "normal");
        check_close(&checks, "N", normal.fy / cos(along), m * g * cos(along) - c * across_wind, 1e-10);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* m u' = -k |u| u, u = v - w: u = u0/(1 + k |u0| t/m). Under gravity, with a wind up or down, from rest in the air:
 * u = -U tanh(g t/U), U = sqrt(m g/k). */
static void quadratic_drag_goes_with_the_air(void **unused)
{
    struct random_numbers numbers = {2};
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int i = 0; i < trials; i++) {
        double m = random_between(&numbers, 0.5, 3), k = random_between(&numbers, 0.1, 2),
               w = random_between(&numbers, -5, 5), v = random_between(&numbers, -5, 5), t = 3;
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  puck:\n    mass: %.17g\n    motion: slide\n    initial: {v: %.17g}\n    "
                 "forces: [drag: "
                 "{quadratic: %.17g, wind: [%.17g, 0]}]\n  drop:\n    mass: %.17g\n    motion: particle\n    "
                 "initial: {vy: "
                 "%.17g}\n    forces: [gravity, drag: {quadratic: %.17g, wind: [0, %.17g]}]\nsimulate: "
                 "{until: %g}\n",
                 m, v, k, w, m, w, k, w, t);
        struct trial trial = run_of(text);
        double u0 = v - w, slowed = 1 + k * fabs(u0) * t / m, U = sqrt(m * g / k);
        check_close(&checks, "puck.v", get(&trial, "puck.v"), w + u0 / slowed, same);
        check_close(&checks, "puck.x", get(&trial, "puck.x"), w * t + copysign(m / k * log(slowed), u0),
                    same);
        check_close(&checks, "drop.vy", get(&trial, "drop.vy"), w - U * tanh(g * t / U), same);
        check_close(&checks, "drop.y", get(&trial, "drop.y"), w * t - U * U / g * log(cosh(g * t / U)), same);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A pendulum with drag on its bob in a wind that goes with height and time: theta from the downward vertical,
 * I theta'' = -m g L sin(theta) + r x f, f = -(c + k |u|) u, u = v - w at the bob. */
struct blown {
    double m, L, c, k, w, shear, gust, f;
};

static int blown_rates(double t, const double *y, double *dydt, void *context)
{
    const struct blown *b = context;
    double x = b->L * sin(y[0]), h = -b->L * cos(y[0]), vx = -h * y[1], vy = x * y[1];
    double ux = vx - (b->w + b->shear * h), uy = vy - b->gust * sin(b->f * t);
    double size = b->c + b->k * hypot(ux, uy);
    dydt[0] = y[1];
    dydt[1] = (-b->m * g * x - size * (x * uy - h * ux)) / (b->m * b->L * b->L);
    return GSL_SUCCESS;
}

static void a_pendulum_in_gusts(void **unused)
{
    struct random_numbers numbers = {3};
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int i = 0; i < trials; i++) {
        struct blown b = {random_between(&numbers, 0.5, 3), random_between(&numbers, 0.3, 2),
                          random_between(&numbers, 0, 1),   i % 3 ? random_between(&numbers, 0.05, 1) : 0,
                          random_between(&numbers, -8, 8),  random_between(&numbers, -2, 2),
                          random_between(&numbers, -3, 3),  random_between(&numbers, 1, 8)};
        double y[2] = {random_between(&numbers, -2, 2), random_between(&numbers, -2, 2)}, t = 2;
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  p:\n    mass: %.17g\n    center: [0, %.17g]\n    motion: pivot\n    "
                 "initial: {theta: "
                 "%.17g, omega: %.17g}\n    forces:\n      - gravity\n      - drag: {linear: %.17g, "
                 "quadratic: %.17g, wind: "
                 "[\"%.17g[m/s] + (%.17g[1/s])*p.G.y\", \"(%.17g[m/s])*sin(%.17g[rad/s]*t)\"]}\nsimulate: "
                 "{until: %g}\n",
                 b.m, -b.L, y[0], y[1], b.c, b.k, b.w, b.shear, b.gust, b.f, t);
        struct trial trial = run_of(text);
        integrate(blown_rates, &b, 2, t, y);
        check_close(&checks, "theta", get(&trial, "p.theta"), y[0], 10 * same);
        check_close(&checks, "omega", get(&trial, "p.omega"), y[1], 10 * same);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* At rest: what hangs in the wind leans by tan(theta) = F/(m g), and a block is held against c w, pressed by
 * m g - c w_n; it gives way where that is beyond mu N. */
static void what_rests_in_the_wind(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial hung =
        trial_parse("fbd: 1\nbodies:\n  p:\n    mass: 2\n    center: [0, -1]\n    motion: pivot\n    forces: "
                    "[gravity, drag: {quadratic: 0.3, wind: [4, 0]}]\nsimulate: {until: 1}\n");
    assert_true(fbd_find_equilibrium(hung.state, NULL));
    check_close(&checks, "leaning", get(&hung, "p.theta"), atan(0.3 * 16 / (2 * g)), 1e-12);
    trial_close(&hung);
    struct trial held = trial_parse("fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: slide\n    forces: "
                                    "[gravity, normal, friction: 0.5, drag: "
                                    "{linear: 0.5, wind: [\"2[m/s^2]*t\", 3]}]\nsimulate: {until: 20}\n");
    trial_run(&held, NULL);
    double N = 2 * g - 0.5 * 3;
    check_close(&checks, "breakaway", trial_event(&held, FBD_EVENT_BREAKAWAY, NULL, 0), 0.5 * N / (0.5 * 2),
                1e-9);
    trial_close(&held);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_drag_approaches_the_wind),
        cmocka_unit_test(quadratic_drag_goes_with_the_air),
        cmocka_unit_test(a_pendulum_in_gusts),
        cmocka_unit_test(what_rests_in_the_wind),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
