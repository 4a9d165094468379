/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces toward points, at places that do not turn with the body, drag in wind, and circles that roll about any
 * point: random scenes against closed forms and against equations that are written out here and integrated by
 * GSL. Each run keeps its energy: what the forces do, as velocity of the place times force, is all that comes in.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { text_room = 2000, trials = 25 };

static const double g = 9.81, pi = 3.14159265358979323846;

/* Two integrations at tolerances of 1e-12 and below: errors of some thousand steps of each. */
static const double same = 1e-9;

/* ---- runs */

static struct trial run_of(const char *text)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = 1e-12;
    struct trial trial = trial_parse(text);
    trial_run(&trial, &options);
    return trial;
}

static double get(const struct trial *trial, const char *name)
{
    double value = NAN;
    if (!fbd_state_get(trial->state, name, &value)) fail_msg("there is no %s", name);
    return value;
}

static void check_energy(struct checks *checks, struct trial *trial)
{
    fbd_energy energy = fbd_result_energy(trial->result);
    double size = 1 + fabs(energy.kinetic) + fabs(energy.potential) + fabs(energy.work);
    check_close(checks, "energy", energy.residual / size, 0, same);
}

static fbd_arrow arrow_of(struct trial *trial, size_t body, const char *name)
{
    fbd_arrow arrows[20];
    size_t count = fbd_diagram(trial->state, body, arrows, 20);
    for (size_t i = 0; i < count; i++)
        if (strcmp(arrows[i].name, name) == 0) return arrows[i];
    fail_msg("there is no force %s", name);
    return arrows[0];
}

typedef int rates(double t, const double *y, double *dydt, void *context);

/* By GSL's pair of order 8 from 0 to t. */
static void integrate(rates *function, void *context, size_t size, double t, double *y)
{
    gsl_odeiv2_system system = {function, NULL, size, context};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-13, 1e-13);
    double from = 0;
    assert_non_null(driver);
    assert_int_equal(gsl_odeiv2_driver_apply(driver, &from, t, y), GSL_SUCCESS);
    gsl_odeiv2_driver_free(driver);
}

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

/* ---- toward a point */

/* Two bodies that draw each other with k/d^2, on any ellipse: the relative place by Kepler's equation. */
static void two_bodies_go_round_each_other(void **unused)
{
    struct random_numbers numbers = {4};
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int i = 0; i < trials; i++) {
        double m1 = random_between(&numbers, 1, 5), m2 = random_between(&numbers, 0.5, 2),
               a = random_between(&numbers, 0.5, 2), e = random_between(&numbers, 0, 0.6),
               k = random_between(&numbers, 1, 9), mu = m1 * m2 / (m1 + m2), n = sqrt(k / (mu * a * a * a)),
               far = a * (1 + e), speed = n * a * sqrt((1 - e) / (1 + e)), t = 4;
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  one: {mass: %.17g, motion: particle}\n  two:\n    mass: %.17g\n    "
                 "motion: particle\n    "
                 "initial: {x: %.17g, vy: %.17g}\n    forces: [applied: {name: pull, value: "
                 "\"%.17g[N*m^2]/distance^2\", "
                 "toward: one}]\nsimulate: {until: %g}\n",
                 m1, m2, far, speed, k, t);
        struct trial trial = run_of(text);
        double M = pi + n * t, E = M;
        for (int step = 0; step < 60; step++) E -= (E - e * sin(E) - M) / (1 - e * cos(E));
        /* From the farthest point on the x axis: the ellipse of the usual form turned half round. */
        double x = -a * (cos(E) - e), y = -a * sqrt(1 - e * e) * sin(E), share = m2 / (m1 + m2);
        check_close(&checks, "x", get(&trial, "two.x") - get(&trial, "one.x"), x, 10 * same);
        check_close(&checks, "y", get(&trial, "two.y") - get(&trial, "one.y"), y, 10 * same);
        check_close(&checks, "momentum", m1 * get(&trial, "one.vy") + m2 * get(&trial, "two.vy"), m2 * speed,
                    same);
        check_close(&checks, "centre", get(&trial, "one.x") + share * x, share * far, same);
        fbd_arrow there = arrow_of(&trial, 1, "pull"), back = arrow_of(&trial, 0, "two.pull");
        check_close(&checks, "reaction", hypot(there.fx + back.fx, there.fy + back.fy), 0, 1e-13);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* On a line through its target a constant force turns round where the body passes: parabolas to and fro with the
 * period 4 sqrt(2 m x0/F); from a line beside it, at the distance b, m x'' = -F x/sqrt(x^2 + b^2). */
struct beside {
    double m, F, b;
};

static int beside_rates(double t, const double *y, double *dydt, void *context)
{
    const struct beside *p = context;
    (void)t;
    dydt[0] = y[1];
    dydt[1] = -p->F / p->m * y[0] / hypot(y[0], p->b);
    return GSL_SUCCESS;
}

static void a_constant_pull_on_a_line(void **unused)
{
    struct random_numbers numbers = {5};
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int i = 0; i < trials; i++) {
        struct beside p = {random_between(&numbers, 0.5, 3), random_between(&numbers, 1, 5),
                           random_between(&numbers, 0.2, 2)};
        double x0 = random_between(&numbers, 0.5, 2), along = random_between(&numbers, -3, 3),
               px = random_between(&numbers, -5, 5), py = random_between(&numbers, -5, 5),
               period = 4 * sqrt(2 * p.m * x0 / p.F), c = cos(along), s = sin(along);
        snprintf(
            text, sizeof text,
            "fbd: 1\nground: {points: {A: [%.17g, %.17g], B: [%.17g, %.17g]}}\nbodies:\n  on: &body\n    "
            "mass: %.17g\n    "
            "motion: {slide: {along: %.17g, through: A}}\n    initial: {x: %.17g}\n    forces: [applied: "
            "{value: %.17g, "
            "toward: ground.A}]\n  off:\n    mass: %.17g\n    motion: {slide: {along: %.17g, through: A}}\n  "
            "  initial: "
            "{x: %.17g}\n    forces: [applied: {value: %.17g, toward: ground.B}]\nsimulate: {until: %.17g}\n",
            px, py, px - p.b * s, py + p.b * c, p.m, along, x0, p.F, p.m, along, x0, p.F, period);
        struct trial trial = run_of(text);
        double y[2] = {x0, 0};
        integrate(beside_rates, &p, 2, period, y);
        check_close(&checks, "on.x", get(&trial, "on.x"), x0, same);
        check_close(&checks, "on.v", get(&trial, "on.v"), 0, same);
        check_close(&checks, "off.x", get(&trial, "off.x"), y[0], 10 * same);
        check_close(&checks, "off.v", get(&trial, "off.v"), y[1], 10 * same);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* In the plane the direction ends at the point: by name, at the start and on the way. */
static void no_direction_at_the_point_itself(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse("fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: particle\n    initial: "
                                     "{x: 3, y: 4}\n    forces: [applied: {name: "
                                     "pull, value: 2, toward: [0, 0]}]\nsimulate: {until: 9}\n");
    trial_run(&trial, NULL);
    check_that(&checks, "the run ends", trial.outcome == FBD_FAILED);
    check_that(&checks, "it says why",
               strstr(fbd_simulation_reason(trial.simulation), "`pull` of `b` acts at the very point") !=
                   NULL);
    check_close(&checks, "when", get(&trial, "t"), sqrt(5), 1e-9); /* 5 m at 2 m/s^2 */
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- beside the body */

/* A spool whose thread leaves it at a place that does not turn: (m + I/R^2) a = P (cos(alpha) - r/R), which goes
 * either way. */
static void a_spool_goes_either_way(void **unused)
{
    struct random_numbers numbers = {6};
    struct checks checks = {0};
    char text[text_room];
    int forth = 0, back = 0;
    (void)unused;
    for (int i = 0; i < trials; i++) {
        double m = random_between(&numbers, 1, 3), I = random_between(&numbers, 0.002, 0.02), R = 0.1,
               r = random_between(&numbers, 0.02, 0.09), P = random_between(&numbers, 1, 6),
               alpha = random_between(&numbers, 0, 1.5), t = 2;
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n  s:\n    mass: %.17g\n    "
                 "inertia: %.17g\n    "
                 "motion: planar\n    initial: {y: %.17g, theta: %.17g}\n    forces: [gravity, applied: "
                 "{name: thread, value: "
                 "%.17g, angle: %.17g, at: {offset: [%.17g, %.17g]}}]\ncouplings: [roll: {body: s, on: "
                 "floor, radius: %.17g}]\n"
                 "simulate: {until: %g}\n",
                 m, I, R, random_between(&numbers, -3, 3), P, alpha, r * sin(alpha), -r * cos(alpha), R, t);
        struct trial trial = run_of(text);
        double a = P * (cos(alpha) - r / R) / (m + I / (R * R));
        a > 0 ? forth++ : back++;
        check_close(&checks, "x", get(&trial, "s.x"), a * t * t / 2, same * (1 + fabs(a)));
        /* The thread is drawn out by r for each radian that the spool turns against it. */
        check_close(&checks, "work", fbd_result_work(trial.result, "s", "thread"),
                    P * (cos(alpha) - r / R) * a * t * t / 2, same * (1 + a * a));
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    assert_true(forth > 3 && back > 3);
    checks_end(&checks);
}

/* ---- circles about any point */

/* An eccentric wheel, G at e from the centre of its circle in the direction theta. Rolling:
 * (I + m (R^2 + e^2 + 2 R e sin)) theta'' = -m R e cos theta'^2 - m g e cos; sliding without friction:
 * (I + m e^2 cos^2) theta'' = m e^2 sin cos theta'^2 - m g e cos; N = m g + m e (cos theta'' - sin theta'^2). */
struct wheel {
    double m, I, R, e;
    bool rolls;
};

static int wheel_rates(double t, const double *y, double *dydt, void *context)
{
    const struct wheel *w = context;
    double c = cos(y[0]), s = sin(y[0]), weight = w->m * g * w->e * c;
    (void)t;
    dydt[0] = y[1];
    dydt[1] = w->rolls
                  ? (-w->m * w->R * w->e * c * y[1] * y[1] - weight) /
                        (w->I + w->m * (w->R * w->R + w->e * w->e + 2 * w->R * w->e * s))
                  : (w->m * w->e * w->e * s * c * y[1] * y[1] - weight) / (w->I + w->m * w->e * w->e * c * c);
    return GSL_SUCCESS;
}

static double wheel_presses(const struct wheel *w, const double *y)
{
    double dydt[2];
    wheel_rates(0, y, dydt, (void *)w);
    return w->m * g + w->m * w->e * (cos(y[0]) * dydt[1] - sin(y[0]) * y[1] * y[1]);
}

/* A wheel whose frame is anywhere: its hub at `hub`, G beyond in the direction `turned`. */
static struct trial wheel_of(const struct wheel *w, struct random_numbers *numbers, const double *y,
                             double until, double *turn)
{
    char text[text_room];
    double hx = random_between(numbers, -0.3, 0.3), hy = random_between(numbers, -0.3, 0.3),
           turned = random_between(numbers, -3, 3), theta = y[0] - turned, c = cos(theta), s = sin(theta),
           x = -(c * hx - s * hy), h = w->R - (s * hx + c * hy);
    *turn = turned;
    double slide = w->rolls ? -w->R * y[1] : 0; /* of the hub; vx, vy are of the frame's origin */
    snprintf(text, sizeof text,
             "fbd: 1\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n  w:\n    mass: %.17g\n    inertia: "
             "%.17g\n    "
             "center: [%.17g, %.17g]\n    points: {hub: [%.17g, %.17g]}\n    motion: planar\n    initial: "
             "{x: %.17g, y: "
             "%.17g, theta: %.17g, vx: %.17g, vy: %.17g, omega: %.17g}\n    forces: [gravity]\ncouplings: "
             "[roll: {name: "
             "tread, body: w, on: floor, radius: %.17g, center: hub%s}]\nsimulate: {until: %.17g}\n",
             w->m, w->I, hx + w->e * cos(turned), hy + w->e * sin(turned), hx, hy, x, h, theta,
             slide - (h - w->R) * y[1], x * y[1], y[1], w->R, w->rolls ? "" : ", static: 0", until);
    return run_of(text);
}

static void an_eccentric_wheel_rolls(void **unused)
{
    struct random_numbers numbers = {7};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < trials; i++) {
        struct wheel w = {random_between(&numbers, 1, 3), random_between(&numbers, 0.02, 0.1), 0.3,
                          random_between(&numbers, 0, 0.15), i % 2 == 0};
        double y[2] = {random_between(&numbers, -3, 3), random_between(&numbers, -4, 4)}, t = 2, turned;
        struct trial trial = wheel_of(&w, &numbers, y, t, &turned);
        integrate(wheel_rates, &w, 2, t, y);
        check_close(&checks, "theta", get(&trial, "w.theta") + turned, y[0], 10 * same);
        check_close(&checks, "omega", get(&trial, "w.omega"), y[1], 10 * same);
        check_close(&checks, "N", arrow_of(&trial, 0, "tread.normal").fy, wheel_presses(&w, y), 100 * same);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_drag_approaches_the_wind),
        cmocka_unit_test(quadratic_drag_goes_with_the_air),
        cmocka_unit_test(a_pendulum_in_gusts),
        cmocka_unit_test(what_rests_in_the_wind),
        cmocka_unit_test(two_bodies_go_round_each_other),
        cmocka_unit_test(a_constant_pull_on_a_line),
        cmocka_unit_test(no_direction_at_the_point_itself),
        cmocka_unit_test(a_spool_goes_either_way),
        cmocka_unit_test(an_eccentric_wheel_rolls),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
