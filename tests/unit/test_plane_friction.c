/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction on a horizontal plane: against closed forms.
 *
 * Closed forms, c = mu g:
 *
 *   a puck                stops after v/c and v^2/(2 c), where it is then
 *   a puck on a belt      of speed w, from rest: it has w after w/c, and has slipped w^2/(2 c)
 *   a coin on a turntable omega = alpha t: it slips at r sqrt(alpha^2 + omega^4) = mu_s g
 *   a puck under a pull   F t: it breaks away at F t = mu_s m g, in the direction of the pull
 *   a puck thrown up      against a force F > mu m g: it stops after v/(F/m + c) and returns with F/m - c
 *   a puck that hits      another one at rest, of equal mass, with w: they go on with (1 - e) w/2 and (1 + e) w/2
 *   a plank               on two points that spins about its centre on a turntable: it has its speed W after
 *                         I |w - W|/(mu m g a)
 *   a sled                on three points slides without turning, as a puck
 *   a plank               pushed across beyond its second point turns about the first one where the moment about it is
 *                         that of the limit of the second
 *   two pucks on a rod    pushed alike break away at the limit of both
 *   two pucks             that leave each other: each stops after its v^2/(2 c), and the works are the energies that they had
 *   a puck on a sled      on rails along its path: they have the common velocity v m/(m + M) after v/(c (1 + m/M))
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
#include "random_numbers.h"
#include "thorough.h"

static const double g = 9.81, accuracy = 1e-8;

static struct trial run_text(const char *text)
{
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    return trial;
}

/* ---- closed forms */

static void check_puck(struct checks *checks, struct random_numbers *numbers)
{
    const double mu = random_between(numbers, 0.05, 1), vx = random_between(numbers, -5, 5);
    const double vy = random_between(numbers, -5, 5), v = hypot(vx, vy), way = v / (2 * mu * g);
    char text[400];
    snprintf(
        text, sizeof text,
        "fbd: 1\nplane: horizontal\nbodies:\n  puck: {mass: 0.3, motion: particle, initial: {vx: %.17g, vy: "
        "%.17g}}\ncouplings: [plane_friction: {body: puck, kinetic: %.17g}]\nsimulate: {until: %.17g}\n",
        vx, vy, mu, 1.5 * v / (mu * g));
    struct trial trial = run_text(text);
    check_close(checks, "stops", trial_event(&trial, FBD_EVENT_STICK, NULL, 0), v / (mu * g), accuracy * v);
    check_close(checks, "x", trial_get(&trial, "puck.x"), vx * way, accuracy * v * way);
    check_close(checks, "y", trial_get(&trial, "puck.y"), vy * way, accuracy * v * way);
    check_that(checks, "is at rest", trial_get(&trial, "puck.vx") == 0 && trial_get(&trial, "puck.vy") == 0);
    trial_close(&trial);
}

static void check_belt(struct checks *checks, struct random_numbers *numbers)
{
    const double mu = random_between(numbers, 0.1, 1), w = random_between(numbers, -3, 3),
                 t = fabs(w) / (mu * g);
    char text[500];
    snprintf(text, sizeof text,
             "fbd: 1\nplane: horizontal\nbodies:\n  belt: {mass: 9, motion: {slide: {along: 90 deg, x: "
             "\"%.17g[m/s]*t\"}}}\n  box: {mass: 2, motion: particle}\ncouplings: [plane_friction: {body: "
             "box, on: "
             "belt, kinetic: %.17g}]\nsimulate: {until: %.17g}\n",
             w, mu, 2 * t);
    struct trial trial = run_text(text);
    check_close(checks, "has its speed", trial_event(&trial, FBD_EVENT_STICK, NULL, 0), t, accuracy * t);
    check_close(checks, "vy", trial_get(&trial, "box.vy"), w, accuracy * fabs(w));
    check_close(checks, "y", trial_get(&trial, "box.y"), w * t * 1.5, accuracy * fabs(w) * t);
    trial_close(&trial);
}

static void check_coin(struct checks *checks, struct random_numbers *numbers)
{
    const double r = random_between(numbers, 0.05, 0.5), mu = random_between(numbers, 0.2, 0.8);
    const double alpha = mu * g / r * random_between(numbers, 0.02, 0.9),
                 phi = random_between(numbers, -3, 3);
    const double t = pow(mu * g / r * (mu * g / r) - alpha * alpha, 0.25) / alpha;
    char text[600];
    snprintf(text, sizeof text,
             "fbd: 1\nplane: horizontal\nbodies:\n  table: {shape: disc, radius: 1, mass: 3, motion: {pivot: "
             "{theta: "
             "\"%.17g[rad/s^2]*t^2\"}}}\n  coin: {mass: 0.01, motion: particle, initial: {x: %.17g, y: "
             "%.17g}}\ncouplings: [plane_friction: {body: coin, on: table, static: %.17g, kinetic: "
             "%.17g}]\nsimulate: {until: %.17g}\n",
             alpha / 2, r * cos(phi), r * sin(phi), mu, random_between(numbers, 0.5, 1) * mu, 1.01 * t);
    struct trial trial = run_text(text);
    check_close(checks, "coin slips", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), t, accuracy * t);
    trial_close(&trial);
}

static void check_pull(struct checks *checks, struct random_numbers *numbers)
{
    const double m = random_between(numbers, 0.1, 5), mu_s = random_between(numbers, 0.2, 0.8);
    const double mu_k = mu_s * random_between(numbers, 0.3, 1), phi = random_between(numbers, -3, 3);
    const double rate = m * random_between(numbers, 1, 20), t = mu_s * m * g / rate, T = 1.5 * t;
    char text[600];
    snprintf(
        text, sizeof text,
        "fbd: 1\nplane: horizontal\nbodies:\n  puck: {mass: %.17g, motion: particle, forces: [applied: "
        "{value: "
        "\"%.17g[N/s]*t\", angle: %.17g}]}\ncouplings: [plane_friction: {body: puck, static: %.17g, kinetic: "
        "%.17g}]\nsimulate: {until: %.17g}\n",
        m, rate, phi, mu_s, mu_k, T);
    struct trial trial = run_text(text);
    const double v = rate * (T * T - t * t) / (2 * m) - mu_k * g * (T - t);
    check_close(checks, "breaks away", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), t, accuracy * t);
    check_close(checks, "vx", trial_get(&trial, "puck.vx"), v * cos(phi), accuracy * rate * T * T / m);
    check_close(checks, "vy", trial_get(&trial, "puck.vy"), v * sin(phi), accuracy * rate * T * T / m);
    trial_close(&trial);
}

static void check_return(struct checks *checks, struct random_numbers *numbers)
{
    const double mu = random_between(numbers, 0.1, 0.5), a = mu * g * random_between(numbers, 1.05, 3);
    const double v = random_between(numbers, 1, 5), phi = random_between(numbers, -3, 3),
                 t = v / (a + mu * g);
    char text[600];
    snprintf(text, sizeof text,
             "fbd: 1\nplane: horizontal\nbodies:\n  puck: {mass: 1, motion: particle, initial: {vx: %.17g, "
             "vy: %.17g}, "
             "forces: [applied: {fx: %.17g, fy: %.17g}]}\ncouplings: [plane_friction: {body: puck, kinetic: "
             "%.17g}]\nsimulate: {until: %.17g}\n",
             v * cos(phi), v * sin(phi), -a * cos(phi), -a * sin(phi), mu, 2 * t);
    struct trial trial = run_text(text);
    const double back = -(a - mu * g) * t;
    check_close(checks, "vx back", trial_get(&trial, "puck.vx"), back * cos(phi), accuracy * v);
    check_close(checks, "vy back", trial_get(&trial, "puck.vy"), back * sin(phi), accuracy * v);
    trial_close(&trial);
}

static void check_sled(struct checks *checks, struct random_numbers *numbers)
{
    const double m = random_between(numbers, 0.1, 2), M = random_between(numbers, 0.1, 9);
    const double mu = random_between(numbers, 0.1, 0.8), v = random_between(numbers, 0.5, 5);
    const double phi = random_between(numbers, -3, 3), t = v / (mu * g * (1 + m / M)), w = v * m / (m + M);
    char text[700];
    snprintf(
        text, sizeof text,
        "fbd: 1\nplane: horizontal\nbodies:\n  sled: {mass: %.17g, motion: {slide: {along: %.17g}}}\n  puck: "
        "{mass: %.17g, "
        "motion: particle, initial: {x: 0.1, y: -0.2, vx: %.17g, vy: %.17g}}\ncouplings: [plane_friction: "
        "{body: "
        "puck, on: sled, kinetic: %.17g}]\nsimulate: {until: %.17g}\n",
        M, phi, m, v * cos(phi), v * sin(phi), mu, 1.5 * t);
    struct trial trial = run_text(text);
    check_close(checks, "one velocity", trial_event(&trial, FBD_EVENT_STICK, NULL, 0), t, accuracy * t);
    check_close(checks, "sled.v", trial_get(&trial, "sled.v"), w, accuracy * v);
    check_close(checks, "puck.vy", trial_get(&trial, "puck.vy"), w * sin(phi), accuracy * v);
    trial_close(&trial);
}

/* On a turntable at constant speed, or on the ground. */
static void check_spin(struct checks *checks, struct random_numbers *numbers)
{
    const double m = random_between(numbers, 0.1, 9), a = random_between(numbers, 0.1, 0.5);
    const double I = m * a * a * random_between(numbers, 0.2, 2), mu = random_between(numbers, 0.1, 0.8);
    const double omega = random_between(numbers, -9, 9), phi = random_between(numbers, -3, 3);
    const double spin = random_perhaps(numbers, 0.5, -9, 9), t = I * fabs(omega - spin) / (mu * m * g * a);
    char text[900];
    snprintf(
        text, sizeof text,
        "fbd: 1\nplane: horizontal\nbodies:\n  table: {mass: 1, inertia: 1, motion: {pivot: {theta: "
        "\"%.17g[rad/s]*t\"}}}\n  "
        "plank: {mass: %.17g, inertia: %.17g, motion: planar, initial: {theta: %.17g, omega: %.17g}}\n"
        "couplings: [plane_friction: {name: feet, body: plank, on: table, points: [[%.17g, 0], [%.17g, 0]], "
        "kinetic: %.17g}]\nsimulate: {until: %.17g}\n",
        spin, m, I, phi, omega, -a, a, mu, 1.5 * t);
    struct trial trial = run_text(text);
    const double theta = phi + spin * 1.5 * t + (omega - spin) * t / 2;
    check_close(checks, "stops", trial_event(&trial, FBD_EVENT_STICK, "feet_1", 0), t, accuracy * t);
    check_close(checks, "at once", trial_event(&trial, FBD_EVENT_STICK, "feet_2", 0), t, accuracy * t);
    check_close(checks, "theta", trial_get(&trial, "plank.theta"), theta, accuracy * (1 + fabs(theta)));
    check_close(checks, "omega", trial_get(&trial, "plank.omega"), spin, accuracy * 9);
    trial_close(&trial);
}

/* Three points in any triangle: with the forces of equilibrium it does not turn. */
static void check_sledge(struct checks *checks, struct random_numbers *numbers)
{
    const double mu = random_between(numbers, 0.1, 0.8), v = random_between(numbers, 0.5, 5);
    const double phi = random_between(numbers, -3, 3), way = v * v / (2 * mu * g);
    const double x = random_between(numbers, 0.1, 0.5), y = random_between(numbers, 0.1, 0.5);
    const double s = random_between(numbers, -0.9, 0.9); /* G is within the triangle */
    char text[900];
    snprintf(
        text, sizeof text,
        "fbd: 1\nplane: horizontal\nbodies:\n  sled: {mass: 2, inertia: 0.3, motion: planar, initial: {vx: "
        "%.17g, vy: %.17g}}\ncouplings: [plane_friction: {body: sled, points: [[%.17g, %.17g], [%.17g, "
        "%.17g], "
        "[%.17g, %.17g]], kinetic: %.17g}]\nsimulate: {until: %.17g}\n",
        v * cos(phi), v * sin(phi), x, s * y, -x, y, -x, -y, mu, 1.5 * v / (mu * g));
    struct trial trial = run_text(text);
    check_close(checks, "stops", trial_event(&trial, FBD_EVENT_STICK, NULL, 0), v / (mu * g), accuracy * v);
    check_close(checks, "x", trial_get(&trial, "sled.x"), way * cos(phi), accuracy * way);
    check_close(checks, "theta", trial_get(&trial, "sled.theta"), 0, accuracy);
    trial_close(&trial);
}

/* A push across a plank beyond its second point turns it about the first one. */
static void check_pivot(struct checks *checks, struct random_numbers *numbers)
{
    const double m = random_between(numbers, 0.1, 9), a = random_between(numbers, 0.1, 0.3),
                 b = random_between(numbers, 0.1, 0.3);
    const double at = b + random_between(numbers, 0.01, 0.2), mu = random_between(numbers, 0.1, 0.8);
    const double first = mu * m * g * b / (a + b), second = mu * m * g * a / (a + b);
    const double F = second * (a + b) / (at + a), rate = m * random_between(numbers, 1, 9), t = F / rate;
    char text[900];
    if (second - F > 0.9 * first) return; /* it does not pivot */
    snprintf(
        text, sizeof text,
        "fbd: 1\nplane: horizontal\nbodies:\n  plank: {mass: %.17g, inertia: %.17g, motion: planar, forces: "
        "[applied: {fy: \"%.17g[N/s]*t\", at: [%.17g, 0]}]}\ncouplings: [plane_friction: {name: feet, body: "
        "plank, points: [[%.17g, 0], [%.17g, 0]], kinetic: %.17g}]\nsimulate: {until: %.17g}\n",
        m, 0.3 * m * (a + b) * (a + b), rate, at, -a, b, mu, 1.001 * t);
    struct trial trial = run_text(text);
    const double theta = trial_get(&trial, "plank.theta");
    check_close(checks, "pivots", trial_event(&trial, FBD_EVENT_BREAKAWAY, "feet_2", 0), t, accuracy * t);
    check_that(checks, "the other one sticks", isnan(trial_event(&trial, FBD_EVENT_BREAKAWAY, "feet_1", 0)));
    check_that(checks, "turns", theta > 0);
    check_close(checks, "about it", trial_get(&trial, "plank.x") - a * cos(theta), -a, accuracy * a);
    trial_close(&trial);
}

/* A push at G, from zero, on a plank whose points a and b are on one side of G turns it about the stronger one, a: at
 * F a = c_b |b - a|. The bodies have loads from another point on, or only a couple beside: F a - M. */
static void check_ramp(struct checks *checks, struct random_numbers *numbers)
{
    const double a = random_between(numbers, 0.1, 0.4), b = random_between(numbers, -0.4, 0.4);
    const double mu = random_between(numbers, 0.1, 0.8), N = random_between(numbers, 10, 90);
    const double weak = N * random_between(numbers, 0.05, 0.2), way = random_between(numbers, -3, 3);
    const double rate = random_between(numbers, 1, 9), couple = rate * a * random_between(numbers, 0, 0.5);
    const double t = mu * weak * fabs(b - a) / (rate * a + couple);
    char text[900];
    snprintf(
        text, sizeof text,
        "fbd: 1\nplane: horizontal\nbodies:\n  plank: {mass: 2, inertia: 0.3, motion: planar, initial: "
        "{theta: "
        "%.17g}, forces: [applied: {fy: \"%.17g[N/s]*t\", frame: body}], moments: [applied: {value: "
        "\"%.17g[N*m/s]*t\"}]}\ncouplings:\n"
        "  - plane_friction: {name: strong, body: plank, at: [%.17g, 0], kinetic: %.17g, normal: %.17g}\n"
        "  - plane_friction: {name: weak, body: plank, at: [%.17g, 0], kinetic: %.17g, normal: %.17g}\n"
        "simulate: {until: %.17g}\n",
        way, rate, -couple, a, mu, N, b, mu, weak, 1.001 * t);
    struct trial trial = run_text(text);
    check_close(checks, "turns", trial_event(&trial, FBD_EVENT_BREAKAWAY, "weak", 0), t, accuracy * t);
    check_that(checks, "the other one sticks", isnan(trial_event(&trial, FBD_EVENT_BREAKAWAY, "strong", 0)));
    check_that(checks, "to the right", trial_get(&trial, "plank.omega") < 0);
    trial_close(&trial);
}

/* Two pucks on a rod break away together, whatever the direction of the push: they translate at F = 2 mu m g where it passes
 * their middle. */
static void check_pair(struct checks *checks, struct random_numbers *numbers)
{
    const double mu = random_between(numbers, 0.1, 0.8), phi = random_between(numbers, -3, 3);
    const double psi = random_between(numbers, -3, 3), rate = random_between(numbers, 1, 9),
                 t = 2 * mu * g / rate;
    char text[900];
    snprintf(text, sizeof text,
             "fbd: 1\nplane: horizontal\nbodies:\n  a: {mass: 1, motion: particle, forces: [applied: {value: "
             "\"%.17g[N/s]*t\", angle: %.17g}]}\n  b: {mass: 1, motion: particle, initial: {x: %.17g, y: "
             "%.17g}, forces: "
             "[applied: {value: \"%.17g[N/s]*t\", angle: %.17g}]}\ncouplings:\n  - rod: {between: [a, b]}\n  "
             "- plane_friction: "
             "{name: under_a, body: a, kinetic: %.17g}\n  - plane_friction: {name: under_b, body: b, "
             "kinetic: %.17g}\n"
             "simulate: {until: %.17g}\n",
             rate / 2, phi, cos(psi), sin(psi), rate / 2, phi, mu, mu, 1.5 * t);
    struct trial trial = run_text(text);
    const double v = (rate * (1.25 * t * t) / 2 - 2 * mu * g * t / 2) / 2;
    check_close(checks, "breaks away", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), t, accuracy * t);
    check_close(checks, "vx", trial_get(&trial, "b.vx"), v * cos(phi), accuracy * (1 + v));
    trial_close(&trial);
}

/* Discs of equal mass. Their friction has no impulse, and none acts between them along the line of centres. */
static void check_hit(struct checks *checks, struct random_numbers *numbers)
{
    const double mu = random_between(numbers, 0.05, 0.4), d = random_between(numbers, 0.2, 1);
    const double v = sqrt(2 * mu * g * d) * random_between(numbers, 1.1, 3),
                 e = random_between(numbers, 0, 1);
    const double hit = sqrt(v * v - 2 * mu * g * d), w = hit * (1 + e) / 2, T = 2 * v / (mu * g);
    char text[700];
    snprintf(text, sizeof text,
             "fbd: 1\nplane: horizontal\nbodies:\n  a: {shape: disc, radius: 0.05, mass: 0.2, motion: "
             "planar, initial: "
             "{vx: %.17g}}\n  b: {shape: disc, radius: 0.05, mass: 0.2, motion: planar, initial: {x: "
             "%.17g}}\ncouplings:\n  - plane_friction: {name: under_a, body: a, kinetic: %.17g}\n  - "
             "plane_friction: "
             "{name: under_b, body: b, kinetic: %.17g}\ncontacts: [{between: [a, b], restitution: "
             "%.17g}]\nsimulate: {until: %.17g}\n",
             v, d + 0.1, mu, mu, e, T);
    struct trial trial = run_text(text);
    const double rest = hit - w;
    check_close(checks, "a.x", trial_get(&trial, "a.x"), d + rest * rest / (2 * mu * g), accuracy * d);
    check_close(checks, "b.x", trial_get(&trial, "b.x"), d + 0.1 + w * w / (2 * mu * g), accuracy * d);
    trial_close(&trial);
}

/* Two discs leave each other. One stops within a long step of the other, and the works up to there are those of that step. */
static void check_apart(struct checks *checks, struct random_numbers *numbers)
{
    const double mu[] = {random_between(numbers, 0.05, 0.5), random_between(numbers, 0.05, 0.5)};
    const double vx[] = {random_between(numbers, -3, -0.5), random_between(numbers, 0.5, 3)};
    const double vy[] = {random_between(numbers, -1, 1), random_between(numbers, -1, 1)};
    const double v[] = {hypot(vx[0], vy[0]), hypot(vx[1], vy[1])};
    char text[600];
    snprintf(
        text, sizeof text,
        "fbd: 1\nplane: horizontal\nbodies:\n  a: {shape: disc, radius: 0.1, mass: 2, motion: planar, "
        "initial: "
        "{vx: %.17g, vy: %.17g}}\n  b: {shape: disc, radius: 0.1, mass: 2, motion: planar, initial: {x: 0.4, "
        "vx: "
        "%.17g, vy: %.17g}}\ncouplings:\n  - plane_friction: {body: a, kinetic: %.17g}\n  - plane_friction: "
        "{body: b, kinetic: %.17g}\ncontacts: [{between: [a, b], restitution: 0.5}]\nsimulate: {until: "
        "%.17g}\n",
        vx[0], vy[0], vx[1], vy[1], mu[0], mu[1], 1.2 * fmax(v[0] / mu[0], v[1] / mu[1]) / g);
    const double kinetic = v[0] * v[0] + v[1] * v[1];
    struct trial recorded = trial_parse(text);
    trial_run(&recorded, NULL);
    check_close(checks, "energy", fbd_result_energy(recorded.result).residual, 0, 1e-12 * kinetic);
    trial_close(&recorded);
    struct trial trial = run_text(text);
    for (int i = 0; i < 2; i++) {
        const double way = v[i] / (2 * mu[i] * g);
        check_close(checks, "x", trial_get(&trial, i ? "b.x" : "a.x"), (i ? 0.4 : 0) + vx[i] * way,
                    accuracy * v[i] * way);
        check_close(checks, "y", trial_get(&trial, i ? "b.y" : "a.y"), vy[i] * way, accuracy * v[i] * way);
    }
    trial_close(&trial);
}

static void motions_have_closed_forms(void **unused)
{
    (void)unused;
    static void (*const kinds[])(struct checks * checks, struct random_numbers * numbers) = {
        check_puck, check_belt,   check_coin,  check_pull, check_return, check_sled, check_hit,
        check_spin, check_sledge, check_pivot, check_ramp, check_pair,   check_apart};
    const int draws = draws_of(40);
    struct random_numbers numbers = {7201};
    struct checks checks = {0};
    for (int i = 0; i < draws; i++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) kinds[k](&checks, &numbers);
    checks_end(&checks);
}

/* Two coins of equal limit on a free turntable under a moment M, alpha = M/(J + m r^2): both slip where
 * r sqrt(alpha^2 + omega^4) = mu g, and neither sticks again at once. */
static void check_two_coins(struct checks *checks, struct random_numbers *numbers, const fbd_options *options)
{
    const double r = random_between(numbers, 0.1, 0.4), mu = random_between(numbers, 0.2, 0.6);
    const double m[] = {random_between(numbers, 0.05, 1), random_between(numbers, 0.05, 1)};
    const double phi[] = {random_between(numbers, -3, 3), random_between(numbers, -3, 3)};
    const double J = random_between(numbers, 0.02, 0.4), M = random_between(numbers, 0.05, 1);
    const double alpha = M / (J + (m[0] + m[1]) * r * r), most = mu * g / r;
    char text[900];
    if (alpha > 0.9 * most) return; /* they slip at once */
    const double t = pow(most * most - alpha * alpha, 0.25) / alpha;
    snprintf(
        text, sizeof text,
        "fbd: 1\nplane: horizontal\nbodies:\n  table: {mass: 1, inertia: %.17g, motion: pivot, moments: "
        "[applied: {value: %.17g}]}\n  a: {mass: %.17g, motion: particle, initial: {x: %.17g, y: %.17g}}\n "
        " b: {mass: %.17g, motion: particle, initial: {x: %.17g, y: %.17g}}\ncouplings:\n  - "
        "plane_friction: {name: under_a, body: a, on: table, kinetic: %.17g}\n  - plane_friction: {name: "
        "under_b, body: b, on: table, kinetic: %.17g}\nsimulate: {until: %.17g}\n",
        J, M, m[0], r * cos(phi[0]), r * sin(phi[0]), m[1], r * cos(phi[1]), r * sin(phi[1]), mu, mu,
        1.1 * t);
    struct trial trial = trial_parse(text);
    trial_start(&trial, options);
    trial_finish(&trial);
    const double error = fmax(accuracy, 100 * options->tolerance) * t;
    check_close(checks, "a slips", trial_event(&trial, FBD_EVENT_BREAKAWAY, "under_a", 0), t, error);
    check_close(checks, "b slips", trial_event(&trial, FBD_EVENT_BREAKAWAY, "under_b", 0), t, error);
    check_that(checks, "two events", fbd_simulation_event_count(trial.simulation) == 2);
    trial_close(&trial);
}

static void coins_on_a_turntable_slip_once(void **unused)
{
    (void)unused;
    fbd_options options[] = {FBD_OPTIONS_DEFAULT, FBD_OPTIONS_DEFAULT};
    struct random_numbers numbers = {7203};
    struct checks checks = {0};
    options[1].method = "msbdf";
    options[1].tolerance = 1e-7;
    for (int i = 0; i < draws_of(20); i++)
        for (size_t k = 0; k < 2; k++) check_two_coins(&checks, &numbers, &options[k]);
    checks_end(&checks);
}

/* A disc slides towards one that is at rest, and would stop beyond it: the steps may end anywhere, also at that stop. */
static void a_disc_that_would_stop_beyond_another_strikes_it(void **unused)
{
    (void)unused;
    const double v = 2.5, mu = 0.3, way = 0.52, t = (v - sqrt(v * v - 2 * mu * g * way)) / (mu * g);
    struct checks checks = {0};
    for (int i = 0; i < 150; i++) {
        char text[600];
        snprintf(
            text, sizeof text,
            "fbd: 1\nplane: horizontal\nbodies:\n  a: {shape: disc, radius: 0.05, mass: 0.2, motion: planar, "
            "initial: {vx: %.17g}}\n  b: {shape: disc, radius: 0.05, mass: 90, motion: planar, initial: {x: "
            "%.17g}}\ncouplings: [plane_friction: {body: a, kinetic: %.17g}]\ncontacts: [{between: [a, b], "
            "restitution: 0.5}]\nsimulate: {until: %.17g}\n",
            v, way + 0.1, mu, 0.3 + 0.03 * i);
        struct trial trial = run_text(text);
        check_close(&checks, "strikes", trial_event(&trial, FBD_EVENT_IMPACT, NULL, 0), t, accuracy * t);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(motions_have_closed_forms),
                                       cmocka_unit_test(coins_on_a_turntable_slip_once),
                                       cmocka_unit_test(a_disc_that_would_stop_beyond_another_strikes_it)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
