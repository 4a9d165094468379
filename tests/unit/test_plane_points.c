/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction on a horizontal plane: random scenes against an independent model, Moreau's time stepping in the coordinates of all
 * bodies, with impulses of friction in their discs by relaxation.
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

static const double g = 9.81;

/* ---- random scenes: a turntable, and bodies on it or on the ground */

enum { most_bodies = 3, most_points = 4 };

struct body {
    bool planar, on_table;
    int points;
    double m, I, mu_s, mu_k;
    double x[most_points], y[most_points], N[most_points]; /* its points, and the force on each */
    double fx, fy, M;                                      /* applied, times t */
};

struct system {
    int count;
    bool driven; /* omega = spin + alpha t */
    double J, spin, alpha;
    struct body bodies[most_bodies];
};

struct motion {
    double t, omega;
    double q[most_bodies][3], v[most_bodies][3];
    bool sticks[most_bodies][most_points];
    double p[most_bodies][most_points][2]; /* impulses of the last step */
};

struct vector {
    double x, y;
};

/* The velocity of a point relative to its plane, and its arms about both axes. */
static struct vector slip_of(const struct system *s, const struct motion *at, int b, int k,
                             struct vector *arm, struct vector *place)
{
    const struct body *body = &s->bodies[b];
    const double *q = at->q[b], *v = at->v[b];
    *arm = (struct vector){body->x[k] * cos(q[2]) - body->y[k] * sin(q[2]),
                           body->x[k] * sin(q[2]) + body->y[k] * cos(q[2])};
    *place = (struct vector){q[0] + arm->x, q[1] + arm->y};
    const double omega = body->on_table ? at->omega : 0;
    return (struct vector){v[0] - v[2] * arm->y + omega * place->y, v[1] + v[2] * arm->x - omega * place->x};
}

static void apply(const struct system *s, struct motion *at, int b, struct vector arm, struct vector place,
                  struct vector p)
{
    const struct body *body = &s->bodies[b];
    at->v[b][0] += p.x / body->m;
    at->v[b][1] += p.y / body->m;
    if (body->planar) at->v[b][2] += (arm.x * p.y - arm.y * p.x) / body->I;
    if (body->on_table && !s->driven) at->omega -= (place.x * p.y - place.y * p.x) / s->J;
}

/* The impulse p in its disc for which u + W (p - before) = -s p, s >= 0. */
static struct vector disc(const double W[3], struct vector b, double c)
{
    double low = 0, high = hypot(b.x, b.y) / c;
    for (int i = 0; i < 60; i++) {
        const double s = i == 0 ? 0 : (low + high) / 2, xx = W[0] + s, yy = W[2] + s,
                     d = xx * yy - W[1] * W[1];
        const struct vector p = {-(yy * b.x - W[1] * b.y) / d, -(xx * b.y - W[1] * b.x) / d};
        if (i == 0 && hypot(p.x, p.y) <= c) return p;
        *(hypot(p.x, p.y) > c ? &low : &high) = s;
        if (i == 59) return p;
    }
    return b;
}

/* One point; returns the change of its impulse. */
static double relax(const struct system *s, struct motion *at, int b, int k, double h)
{
    const struct body *body = &s->bodies[b];
    struct vector r, R;
    const struct vector u = slip_of(s, at, b, k, &r, &R);
    const double i = body->planar ? 1 / body->I : 0, j = body->on_table && !s->driven ? 1 / s->J : 0;
    const double W[3] = {1 / body->m + i * r.y * r.y + j * R.y * R.y, -i * r.x * r.y - j * R.x * R.y,
                         1 / body->m + i * r.x * r.x + j * R.x * R.x};
    double *p = at->p[b][k];
    const struct vector without = {u.x - W[0] * p[0] - W[1] * p[1], u.y - W[1] * p[0] - W[2] * p[1]};
    const double c = (at->sticks[b][k] ? body->mu_s : body->mu_k) * body->N[k] * h;
    const struct vector next = disc(W, without, c);
    const struct vector change = {next.x - p[0], next.y - p[1]};
    p[0] = next.x;
    p[1] = next.y;
    apply(s, at, b, r, R, change);
    return hypot(change.x, change.y) / c;
}

static void drift(const struct system *s, struct motion *at, double h)
{
    at->t += h;
    for (int b = 0; b < s->count; b++)
        for (int i = 0; i < 3; i++) at->q[b][i] += h * at->v[b][i];
}

static void step(const struct system *s, struct motion *at, double h)
{
    drift(s, at, h / 2);
    if (s->driven) at->omega = s->spin + s->alpha * (at->t + h / 2);
    for (int b = 0; b < s->count; b++) {
        const struct body *body = &s->bodies[b];
        at->v[b][0] += h * body->fx * at->t / body->m;
        at->v[b][1] += h * body->fy * at->t / body->m;
        if (body->planar) at->v[b][2] += h * body->M * at->t / body->I;
    }
    struct motion start = *at; /* impulses of the last step as a first guess */
    for (int b = 0; b < s->count; b++)
        for (int k = 0; k < s->bodies[b].points; k++) {
            struct vector r, R;
            slip_of(s, &start, b, k, &r, &R);
            apply(s, at, b, r, R, (struct vector){at->p[b][k][0], at->p[b][k][1]});
        }
    double change = 1;
    for (int sweep = 0; sweep < 300 && change > 1e-11; sweep++) {
        change = 0;
        for (int b = 0; b < s->count; b++)
            for (int k = 0; k < s->bodies[b].points; k++) change = fmax(change, relax(s, at, b, k, h));
    }
    for (int b = 0; b < s->count; b++)
        for (int k = 0; k < s->bodies[b].points; k++) {
            const struct body *body = &s->bodies[b];
            const double c = (at->sticks[b][k] ? body->mu_s : body->mu_k) * body->N[k] * h;
            at->sticks[b][k] = hypot(at->p[b][k][0], at->p[b][k][1]) < (1 - 1e-9) * c;
        }
    drift(s, at, h / 2);
}

/* Anywhere, or on the x axis; the weight in random parts. */
static void draw_points(struct random_numbers *numbers, struct body *body, double reach)
{
    const bool plank = random_chance(numbers, 0.4);
    double all = 0;
    for (int k = 0; k < body->points; k++) {
        body->x[k] = random_between(numbers, -reach, reach);
        body->y[k] = plank ? 0 : random_between(numbers, -reach, reach);
        all += body->N[k] = random_between(numbers, 0.1, 1);
    }
    for (int k = 0; k < body->points; k++) body->N[k] *= body->m * g / all;
}

static struct system draw_system(struct random_numbers *numbers, struct motion *at)
{
    struct system s = {.count = 1 + (int)random_between(numbers, 0, 2.999)};
    s.driven = random_chance(numbers, 0.5);
    s.J = random_between(numbers, 0.2, 2);
    s.spin = random_perhaps(numbers, 0.7, -4, 4);
    s.alpha = s.driven ? random_perhaps(numbers, 0.5, -4, 4) : 0;
    *at = (struct motion){.omega = s.spin};
    for (int b = 0; b < s.count; b++) {
        struct body *body = &s.bodies[b];
        body->planar = random_chance(numbers, 0.6);
        body->on_table = random_chance(numbers, 0.7);
        body->points = body->planar ? 1 + (int)random_between(numbers, 0, 3.999) : 1;
        body->m = random_between(numbers, 0.3, 3);
        const double reach = body->planar ? random_between(numbers, 0.1, 0.5) : 0;
        draw_points(numbers, body, reach);
        body->I = body->planar ? body->m * reach * reach * random_between(numbers, 0.3, 1.5) : 1;
        body->mu_s = random_between(numbers, 0.1, 0.6);
        const double part = random_chance(numbers, 0.5) ? 1 : random_between(numbers, 0.5, 0.9);
        body->mu_k =
            s.driven && body->points == 1 ? body->mu_s * part : body->mu_s; /* else refused (plane_check.c) */
        const double most = 2 * body->mu_s * body->m * g;
        body->fx = random_perhaps(numbers, 0.4, -most, most);
        body->fy = random_perhaps(numbers, 0.4, -most, most);
        body->M = body->planar ? random_perhaps(numbers, 0.3, -most * reach, most * reach) : 0;
        const bool rests = random_chance(numbers, 0.4);
        for (int i = 0; i < 2; i++) at->q[b][i] = random_between(numbers, -0.5, 0.5);
        at->q[b][2] = body->planar ? random_between(numbers, -3, 3) : 0;
        for (int i = 0; i < 2; i++) at->v[b][i] = rests ? 0 : random_between(numbers, -1.5, 1.5);
        at->v[b][2] = body->planar && !rests ? random_perhaps(numbers, 0.7, -4, 4) : 0;
        if (rests && body->on_table) { /* relative to the table */
            at->v[b][0] = -s.spin * at->q[b][1];
            at->v[b][1] = s.spin * at->q[b][0];
            if (body->planar) at->v[b][2] = s.spin;
        }
        for (int k = 0; k < body->points; k++) at->sticks[b][k] = rests;
    }
    return s;
}

static int write_table(const struct system *s, char *text, size_t size)
{
    if (s->driven)
        return snprintf(
            text, size,
            "fbd: 1\nplane: horizontal\nbodies:\n  table: {mass: 1, inertia: %.17g, motion: {pivot: {theta: "
            "\"%.17g[rad/s]*t + %.17g[rad/s^2]*t^2\"}}}\n",
            s->J, s->spin, s->alpha / 2);
    return snprintf(
        text, size,
        "fbd: 1\nplane: horizontal\nbodies:\n  table: {mass: 1, inertia: %.17g, motion: pivot, initial: "
        "{omega: %.17g}}\n",
        s->J, s->spin);
}

static struct trial open_system(const struct system *s, const struct motion *at, double until)
{
    char text[8000], *end = text + write_table(s, text, sizeof text);
    for (int b = 0; b < s->count; b++) {
        const struct body *body = &s->bodies[b];
        const double *q = at->q[b], *v = at->v[b];
        end += snprintf(
            end, 1000,
            "  body%d:\n    mass: %.17g\n    motion: %s\n    initial: {x: %.17g, y: %.17g, vx: %.17g, vy: "
            "%.17g",
            b, body->m, body->planar ? "planar" : "particle", q[0], q[1], v[0], v[1]);
        if (body->planar)
            end += snprintf(end, 1000,
                            ", theta: %.17g, omega: %.17g}\n    inertia: %.17g\n    moments: [applied: "
                            "{value: \"%.17g[N*m/s]*t\"}]\n",
                            q[2], v[2], body->I, body->M);
        else
            end += snprintf(end, 1000, "}\n");
        end += snprintf(end, 1000, "    forces: [applied: {fx: \"%.17g[N/s]*t\", fy: \"%.17g[N/s]*t\"}]\n",
                        body->fx, body->fy);
    }
    end += snprintf(end, 1000, "couplings:\n");
    for (int b = 0; b < s->count; b++)
        for (int k = 0; k < s->bodies[b].points; k++)
            end += snprintf(
                end, 1000,
                "  - plane_friction: {name: f%d%d, body: body%d, at: [%.17g, %.17g], on: %s, static: %.17g, "
                "kinetic: %.17g, normal: %.17g}\n",
                b, k, b, s->bodies[b].x[k], s->bodies[b].y[k], s->bodies[b].on_table ? "table" : "ground",
                s->bodies[b].mu_s, s->bodies[b].mu_k, s->bodies[b].N[k]);
    snprintf(end, 1000, "simulate: {until: %.17g}\n", until);
    return trial_parse(text);
}

static void check_body(struct checks *checks, const struct trial *trial, const struct motion *fine,
                       const struct motion *coarse, int b, bool planar)
{
    static const char *const names[] = {"vx", "vy", "omega"};
    double change = 0;
    for (int i = 0; i < 3; i++) change = fmax(change, fabs(fine->v[b][i] - coarse->v[b][i]));
    for (int i = 0; i < 2 + planar; i++) {
        char name[20];
        snprintf(name, sizeof name, "body%d.%s", b, names[i]);
        check_close(checks, name, trial_get(trial, name), fine->v[b][i], 3 * change + 1e-3);
    }
}

/* The error of the independent motion is about its change by half the step. */
static void compare(struct checks *checks, const struct trial *trial, const struct system *s,
                    struct motion at, int steps, double until)
{
    struct motion fine = at, coarse = at;
    for (int i = 0; i < steps; i++) step(s, &fine, until / steps);
    for (int i = 0; i < steps / 2; i++) step(s, &coarse, 2 * until / steps);
    for (int b = 0; b < s->count; b++) check_body(checks, trial, &fine, &coarse, b, s->bodies[b].planar);
    check_close(checks, "table", trial_get(trial, "table.omega"), fine.omega,
                3 * fabs(fine.omega - coarse.omega) + 1e-3);
}

/* Where a point passes near zero velocity, of 3e-6 m/s for example, both of these motions may stick for a step though the true
 * one slips: then shorter ones decide. */
static void check_system(struct checks *checks, struct random_numbers *numbers)
{
    const double until = 1;
    const uint64_t seed = numbers->state;
    struct motion at;
    const struct system s = draw_system(numbers, &at);
    struct trial trial = open_system(&s, &at, until);
    static const int steps[] = {4000, 64000, 2048000};
    struct checks seen = {.failed = 1};
    trial_start(&trial, NULL);
    trial_finish(&trial);
    for (int i = 0; i < 3 && seen.failed > 0; i++) {
        if (i > 0) print_message("# seed %llu: again with shorter steps\n", (unsigned long long)seed);
        seen = (struct checks){0};
        compare(&seen, &trial, &s, at, steps[i], until);
    }
    checks->failed += seen.failed;
    trial_close(&trial);
}

static void scenes_agree_with_time_stepping(void **unused)
{
    (void)unused;
    const int draws = number_of("FBD_PLANES", draws_of(24));
    struct random_numbers numbers = {(uint64_t)number_of("FBD_SEED", 7202)};
    struct checks checks = {0};
    for (int i = 0; i < draws; i++) check_system(&checks, &numbers);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(scenes_agree_with_time_stepping)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
