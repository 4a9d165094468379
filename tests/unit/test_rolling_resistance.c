/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rolling resistance against closed forms, with random numbers: I = k m R^2, c = b/R, N = m g cos(phi).
 *
 *   on an incline    a = -g (sin(phi) + c cos(phi)) / (1 + k) upwards; from where it stops it rolls back with
 *                    g (sin(phi) - c cos(phi)) / (1 + k), or stays where that is below zero
 *   by a moment      it rolls from T = b N on, with a = (T - b N) / (m R (1 + k))
 *   by a force       at the angle beta it rolls from F = b m g / (R cos(beta) + b sin(beta)) on
 *   on a cart M      relative to it a = -c m g / (mu + k m), mu = m M / (m + M)
 *   by an impact     of a mass M at its centre, with (1 + e) M v / (M + (1 + k) m) at first
 *   from a slide     without turning while mu R <= b; else it rolls from t = v / (g (mu + (mu - c) / k)) on
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

static const double g = 9.81;

struct wheel {
    double m, R, k, c, v; /* mass, radius, I / (m R^2), b / R, speed at the start */
};

static struct wheel draw_wheel(struct random_numbers *numbers)
{
    return (struct wheel){.m = random_between(numbers, 0.1, 20),
                          .R = pow(10, random_between(numbers, -2, 1)),
                          .k = random_between(numbers, 0.1, 1),
                          .c = pow(10, random_between(numbers, -3, -0.5)),
                          .v = random_between(numbers, 0.2, 5)};
}

/* A wheel on a line through the origin, at the angle phi, with further keys of the roll and of the body. */
static struct trial open_wheel(const struct wheel *w, double phi, double omega, const char *roll,
                               const char *body, double until)
{
    char text[1200];
    snprintf(
        text, sizeof text,
        "fbd: 1\nground: {lines: {floor: {along: %.17g rad}}}\nbodies:\n  wheel:\n    mass: %.17g\n"
        "    inertia: %.17g\n    motion: planar\n    initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g, "
        "omega: %.17g}\n    forces: [gravity%s\ncouplings:\n  - roll: {name: tread, body: wheel, on: "
        "floor, center: [0, 0], radius: %.17g,\n      rolling_resistance: %.17g%s}\nsimulate: {until: "
        "%.17g}\n",
        phi, w->m, w->k * w->m * w->R * w->R, -w->R * sin(phi), w->R * cos(phi), w->v * cos(phi),
        w->v * sin(phi), omega, body, w->R, w->c * w->R, roll, until);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    return trial;
}

static const double accuracy = 1e-8; /* relative; the tolerance of a run is 1e-10 */

static void check_incline(struct checks *checks, struct random_numbers *numbers)
{
    struct wheel w = draw_wheel(numbers);
    const double phi = random_between(numbers, 0, 2) * atan(w.c);
    const double up = g * (sin(phi) + w.c * cos(phi)) / (1 + w.k),
                 down = fmax(0, g * (sin(phi) - w.c * cos(phi)) / (1 + w.k));
    const double stop = w.v / up, until = 2 * stop, top = w.v * stop / 2;
    struct trial trial = open_wheel(&w, phi, -w.v / w.R, "", "]", until);
    const double s = top - down * (until - stop) * (until - stop) / 2;
    check_close(checks, "x on an incline", trial_get(&trial, "x"), -w.R * sin(phi) + s * cos(phi),
                accuracy * (top + w.R));
    check_close(checks, "omega on an incline", trial_get(&trial, "omega"), down * (until - stop) / w.R,
                accuracy * w.v / w.R);
    const fbd_event_kind kind = down > 0 ? FBD_EVENT_REVERSAL : FBD_EVENT_STICK;
    check_close(checks, "stop", trial_event(&trial, kind, NULL, 0), stop, accuracy * stop);
    trial_close(&trial);
}

static void check_moment(struct checks *checks, struct random_numbers *numbers)
{
    struct wheel w = draw_wheel(numbers);
    char body[200];
    const double begin = random_between(numbers, 0.5, 2), most = w.c * w.R * w.m * g, rate = most / begin;
    w.v = 0;
    snprintf(body, sizeof body, "]\n    moments: [applied: {name: drive, value: \"-%.17g[N*m/s]*t\"}]", rate);
    struct trial trial = open_wheel(&w, 0, 0, "", body, 2 * begin);
    const double v = rate * begin * begin / 2 / (w.m * w.R * (1 + w.k));
    check_close(checks, "begin", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), begin, accuracy * begin);
    check_close(checks, "v by a moment", trial_get(&trial, "vx"), v, accuracy * v);
    trial_close(&trial);
}

static void check_force(struct checks *checks, struct random_numbers *numbers)
{
    struct wheel w = draw_wheel(numbers);
    char body[200];
    const double beta = random_between(numbers, -1, 1), begin = random_between(numbers, 0.5, 2);
    const double F = w.c * w.m * g / (cos(beta) + w.c * sin(beta)), rate = F / begin;
    if (beta < -1.2 || F < 0) return;
    w.v = 0;
    snprintf(body, sizeof body, ", applied: {name: pull, value: \"%.17g[N/s]*t\", angle: %.17g rad}]", rate,
             beta);
    struct trial trial = open_wheel(&w, 0, 0, "", body, 1.5 * begin);
    /* m (1 + k) a = F cos(beta) - c (m g - F sin(beta)) */
    const double more = rate * (cos(beta) + w.c * sin(beta)) * begin * begin / 8;
    const double v = more / (w.m * (1 + w.k));
    check_close(checks, "begin", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), begin, accuracy * begin);
    check_close(checks, "v by a force", trial_get(&trial, "vx"), v, accuracy * v);
    trial_close(&trial);
}

static void check_cart(struct checks *checks, struct random_numbers *numbers)
{
    struct wheel w = draw_wheel(numbers);
    const double M = random_between(numbers, 0.5, 20), mu = w.m * M / (w.m + M);
    const double stop = w.v * (mu + w.k * w.m) / (w.c * w.m * g);
    char text[1000];
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n  cart: {mass: %.17g, motion: slide}\n  wheel:\n    mass: %.17g\n    inertia: "
             "%.17g\n    motion: planar\n    initial: {y: %.17g, vx: %.17g, omega: %.17g}\n    forces: "
             "[gravity]\ncouplings:\n  - roll: {body: wheel, on: cart, center: [0, 0], radius: %.17g, "
             "rolling_resistance: %.17g}\nsimulate: {until: %.17g}\n",
             M, w.m, w.k * w.m * w.R * w.R, w.R, w.v, -w.v / w.R, w.R, w.c * w.R, 1.5 * stop);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    const double v = w.m * w.v / (w.m + M);
    check_close(checks, "stop on a cart", trial_event(&trial, FBD_EVENT_STICK, NULL, 0), stop,
                accuracy * stop);
    check_close(checks, "cart", trial_get(&trial, "cart.v"), v, accuracy * w.v);
    check_close(checks, "wheel", trial_get(&trial, "wheel.vx"), v, accuracy * w.v);
    trial_close(&trial);
}

static void check_slide(struct checks *checks, struct random_numbers *numbers)
{
    struct wheel w = draw_wheel(numbers);
    const double mu = w.c * random_between(numbers, 0.2, 4);
    char roll[80];
    snprintf(roll, sizeof roll, ", static: %.17g, kinetic: %.17g", mu, mu);
    const bool turns = mu > w.c;
    const double rolls = turns ? w.v / (g * (mu + (mu - w.c) / w.k)) : w.v / (mu * g);
    const double v = turns ? w.v - mu * g * rolls : 0, more = v * (1 + w.k) / (g * w.c);
    struct trial trial = open_wheel(&w, 0, 0, roll, "]", 1.2 * (rolls + more));
    const double x = (w.v + v) / 2 * rolls + v / 2 * more;
    check_close(checks, "rolls, or stops", trial_event(&trial, FBD_EVENT_STICK, NULL, 0), rolls,
                accuracy * rolls);
    check_close(checks, "x from a slide", trial_get(&trial, "x"), x, accuracy * x);
    check_close(checks, "at rest", trial_get(&trial, "vx"), 0, accuracy * w.v);
    trial_close(&trial);
}

/* A ball of mass M hits the centre of a wheel at rest, which then rolls with the inertia (1 + k) m. */
static void check_hit(struct checks *checks, struct random_numbers *numbers)
{
    struct wheel w = draw_wheel(numbers);
    const double M = random_between(numbers, 0.5, 5), e = random_between(numbers, 0, 1), r = w.R / 2;
    const double I = (1 + w.k) * w.m, after = (1 + e) * M * w.v / (M + I);
    const double stop = after * (1 + w.k) / (g * w.c), hit = 1, until = hit + 1.5 * stop;
    char text[1000];
    if (M > e * I) return; /* the ball follows, and hits the wheel again */
    snprintf(text, sizeof text,
             "fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n  wheel: {mass: %.17g, inertia: %.17g, "
             "motion: planar, initial: {y: %.17g}, forces: [gravity]}\n  ball: {mass: %.17g, shape: disc, "
             "radius: %.17g, motion: {slide: {along: 0, through: [0, %.17g]}}, initial: {x: %.17g, v: "
             "%.17g}}\ncouplings:\n  - roll: {body: wheel, on: floor, center: [0, 0], radius: %.17g, "
             "rolling_resistance: %.17g}\ncontacts:\n  - {between: [ball, wheel.G], restitution: "
             "%.17g}\nsimulate: {until: %.17g}\n",
             w.m, w.k * w.m * w.R * w.R, w.R, M, r, w.R, -r - w.v * hit, w.v, w.R, w.c * w.R, e, until);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_to(&trial, hit + stop / 2);
    check_close(checks, "v after a hit", trial_get(&trial, "wheel.vx"), after / 2, accuracy * after);
    trial_close(&trial);
}

static void rolling_resistance_has_closed_forms(void **unused)
{
    (void)unused;
    static void (*const kinds[])(struct checks * checks,
                                 struct random_numbers * numbers) = {check_incline, check_moment, check_force,
                                                                     check_cart,    check_slide,  check_hit};
    const int draws = draws_of(100);
    struct random_numbers numbers = {2051};
    struct checks checks = {0};
    for (int i = 0; i < draws; i++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) kinds[k](&checks, &numbers);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rolling_resistance_has_closed_forms)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
