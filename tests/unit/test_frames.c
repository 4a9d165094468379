/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces toward points and at places that do not turn with the body, and circles that roll about any point: random
 * scenes against closed forms and against equations that are written out here and integrated by GSL. Each run keeps
 * its energy: what the forces do, as velocity of the place times force, is all that comes in.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "random_numbers.h"
#include "run_checks.h"

static const double pi = 3.14159265358979323846;

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
    struct trial there = trial_parse("fbd: 1\nbodies:\n  b: {mass: 1, motion: particle, forces: [applied: "
                                     "{name: pull, value: 2, toward: [0, 0]}]}\n"
                                     "simulate: {until: 9}\n");
    trial_run(&there, NULL);
    check_that(&checks, "nor does it start there", there.outcome == FBD_FAILED);
    check_that(&checks, "and says why",
               strstr(fbd_simulation_reason(there.simulation), "which has no direction where it acts") !=
                   NULL);
    trial_close(&there);
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

/* When N comes to zero first: on a grid, and by halving the time; NAN where it does not until `end`. */
static double lifts_off(struct wheel *w, const double *start, double end)
{
    enum { steps = 100, halvings = 45 };
    double low = 0, high = end / steps;
    for (int i = 0; i < steps + halvings; i++) {
        bool found = i >= steps;
        double t = found ? (low + high) / 2 : high, y[2] = {start[0], start[1]};
        integrate(wheel_rates, w, 2, t, y);
        bool presses = wheel_presses(w, y) > 0;
        if (found) *(presses ? &low : &high) = t;
        if (!found && presses) low = high, high += end / steps;
        if (!found && !presses) i = steps;
    }
    return high > end ? NAN : low;
}

/* G below its hub at first, and fast: on its way to the top it may throw the wheel up. */
static void an_eccentric_wheel_leaves_its_floor(void **unused)
{
    struct random_numbers numbers = {8};
    struct checks checks = {0};
    int lifted = 0;
    (void)unused;
    for (int i = 0; i < 12; i++) {
        struct wheel w = {2, random_between(&numbers, 0.02, 0.1), 0.3, random_between(&numbers, 0.08, 0.15),
                          false};
        double start[2] = {-pi / 2, random_between(&numbers, 10, 22)}, end = 0.4, turn;
        struct trial trial = wheel_of(&w, &numbers, start, end, &turn);
        double want = lifts_off(&w, start, end), got = trial_event(&trial, FBD_EVENT_LIFT_OFF, NULL, 0);
        if (isnan(want))
            check_that(&checks, "it stays", isnan(got));
        else
            check_close(&checks, "lift-off", got, want, 1e-9);
        lifted += !isnan(want);
        trial_close(&trial);
    }
    assert_true(lifted > 3 && lifted < 12);
    checks_end(&checks);
}

/* Each text is short enough, but the force is needed in the moment as well, and the distance in it twice. */
static void texts_that_are_too_long_together(void **unused)
{
    static char text[20000];
    fbd_errors *errors = fbd_errors_new();
    (void)unused;
    int used = snprintf(text, sizeof text,
                        "fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: particle\n    forces:\n      - "
                        "applied: {toward: [1, 0], at: {offset: [0.1, 0]}, value: \"0[N]");
    for (int i = 0; i < 900; i++)
        used += snprintf(text + used, sizeof text - (size_t)used, " + 1[N]*sin(%d*t)", i);
    snprintf(text + used, sizeof text - (size_t)used, " + 1[N/m]*distance\"}\nsimulate: {until: 1}\n");
    assert_null(fbd_model_parse(text, strlen(text), "long.yaml", NULL, 0, errors));
    assert_int_equal(fbd_errors_count(errors), 1);
    assert_string_equal(fbd_errors_get(errors, 0).id, "expression-too-long");
    fbd_errors_free(errors);
}

/* The spools and seeds of the gallery, by the closed forms in their first lines. */
static void models_of_the_gallery_go_as_they_say(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (double alpha = 0; alpha <= 90; alpha += 15) {
        char setting[40];
        snprintf(setting, sizeof setting, "alpha=%g deg", alpha);
        struct trial trial = trial_open("couplings/spool_pulled.yaml", SET(setting));
        trial_run(&trial, NULL);
        double a = 4 * (cos(alpha * acos(-1) / 180) - 0.5) / 1.5;
        check_close(&checks, "x", get(&trial, "spool.x"), a * 2, 1e-10);
        check_close(&checks, "theta", get(&trial, "spool.theta"), -a * 2 / 0.1, 1e-9);
        trial_close(&trial);
    }
    for (double c = 0.01; c < 0.2; c += 0.03) {
        char setting[40];
        snprintf(setting, sizeof setting, "c=%g N*s/m", c);
        struct trial trial = trial_open("plane/drift_in_wind.yaml", SET(setting));
        trial_run(&trial, NULL);
        double T = 0.02 / c, way = 3 - T * (1 - exp(-3 / T));
        check_close(&checks, "drifts", get(&trial, "seed.x"), 3 * way, 1e-9);
        check_close(&checks, "falls", get(&trial, "seed.y"), -9.81 * T * way, 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_bodies_go_round_each_other),
        cmocka_unit_test(a_constant_pull_on_a_line),
        cmocka_unit_test(no_direction_at_the_point_itself),
        cmocka_unit_test(a_spool_goes_either_way),
        cmocka_unit_test(an_eccentric_wheel_rolls),
        cmocka_unit_test(an_eccentric_wheel_leaves_its_floor),
        cmocka_unit_test(texts_that_are_too_long_together),
        cmocka_unit_test(models_of_the_gallery_go_as_they_say),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
