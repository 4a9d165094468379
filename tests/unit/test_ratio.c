/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ratios of coordinates, sum c_i v_i = 0, against closed forms and an independent integration, with random numbers.
 *
 *   on the ground    several bodies, several ratios C, constant forces F: M a = F + C^T lambda with C a = 0 gives
 *                    constant accelerations and multipliers
 *   on each other    a slide on an arm on a cart with two ratios or one: q = q_0 + B u with C B = 0, and
 *                    B^T M(q) B u'' = B^T (F - h(q, v)) from velocities J v of the centres of mass
 *   as it begins     v' = v - M^-1 C^T (C M^-1 C^T)^-1 C v, and the kinetic energy that is lost
 *   at a stop        both bodies rebound with e
 *   with friction    the weight c m_2 g moves m_1 where c m_2 > mu m_1
 *   as it breaks     a force that grows with the time reaches the limit of its reaction
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
static const double accuracy = 1e-9; /* relative; the tolerance of a run is 1e-10 */

enum { most = 9 }; /* unknowns of a linear system */

/* Solve A x = b, n equations, by elimination with pivoting; b receives x. */
static void solve(int n, double A[most][most], double b[most])
{
    for (int j = 0; j < n; j++) {
        int p = j;
        for (int i = j + 1; i < n; i++)
            if (fabs(A[i][j]) > fabs(A[p][j])) p = i;
        for (int k = 0; k < n; k++) {
            const double other = A[p][k];
            A[p][k] = A[j][k];
            A[j][k] = other;
        }
        const double other = b[p];
        b[p] = b[j];
        b[j] = other;
        for (int i = 0; i < n; i++) {
            const double factor = i == j ? 0 : A[i][j] / A[j][j];
            for (int k = 0; k < n && factor != 0; k++) A[i][k] -= factor * A[j][k];
            b[i] -= factor * b[j];
        }
    }
    for (int j = 0; j < n; j++) b[j] /= A[j][j];
}

/* ---- on the ground */

/* Bodies of one coordinate, slides or pivots, with random factors of lengths. */
struct system {
    int n, rows;
    double m[most], F[most], q[most], v[most], C[most][most];
    bool turns[most], angular;
};

/* x = M^-1 (f + C^T lambda) with C x = 0. */
static void respond(const struct system *s, const double *f, double *x, double *lambda)
{
    double A[most][most] = {{0}}, b[most] = {0};
    for (int j = 0; j < s->rows; j++)
        for (int i = 0; i < s->n; i++) {
            for (int k = 0; k < s->rows; k++) A[j][k] += s->C[j][i] * s->C[k][i] / s->m[i];
            b[j] -= s->C[j][i] * f[i] / s->m[i];
        }
    solve(s->rows, A, b);
    for (int j = 0; j < s->rows; j++) lambda[j] = b[j];
    for (int i = 0; i < s->n; i++) {
        x[i] = f[i] / s->m[i];
        for (int j = 0; j < s->rows; j++) x[i] += s->C[j][i] * lambda[j] / s->m[i];
    }
}

static double draw_factor(struct random_numbers *numbers)
{
    const double size = pow(10, random_between(numbers, -1, 1));
    return random_chance(numbers, 0.5) ? size : -size;
}

static void draw_system(struct random_numbers *numbers, int least_rows, int most_rows, struct system *s)
{
    *s = (struct system){.angular = random_chance(numbers, 0.2)};
    s->rows = least_rows + (int)random_between(numbers, 0, most_rows - least_rows + 0.999);
    s->n = s->rows + 1 + (int)random_between(numbers, 0, 2.999);
    for (int i = 0; i < s->n; i++) {
        s->turns[i] = s->angular || random_chance(numbers, 0.4);
        s->m[i] = pow(10, random_between(numbers, -1, 1));
        s->F[i] = random_between(numbers, -5, 5);
        s->q[i] = random_between(numbers, -1, 1);
        s->v[i] = random_between(numbers, -1, 1);
    }
    for (int j = 0; j < s->rows; j++) {
        /* two coordinates or more, of which that with the number of the row is independent of the rows before */
        for (int i = 0; i < s->n; i++)
            if (i == j || i == s->n - 1 || (i > j && random_chance(numbers, 0.3)))
                s->C[j][i] = draw_factor(numbers);
    }
    double f[most] = {0}, lambda[most];
    for (int i = 0; i < s->n; i++) f[i] = s->m[i] * s->v[i];
    respond(s, f, s->v, lambda);
}

static int write_body(const struct system *s, int i, char *text, size_t room)
{
    if (s->turns[i])
        return snprintf(
            text, room,
            "  b%d: {mass: 1, inertia: %.17g, motion: pivot, initial: {theta: %.17g rad, omega: %.17g}, "
            "moments: [applied: %.17g]}\n",
            i, s->m[i], s->q[i], s->v[i], s->F[i]);
    return snprintf(
        text, room,
        "  b%d: {mass: %.17g, motion: {slide: {along: %d deg}}, initial: {x: %.17g, v: %.17g}, forces: "
        "[applied: {value: %.17g, angle: %d deg}]}\n",
        i, s->m[i], 20 * i, s->q[i], s->v[i], s->F[i], 20 * i);
}

static int write_bodies(const struct system *s, char *text, size_t room)
{
    int used = snprintf(text, room, "fbd: 1\nbodies:\n");
    for (int i = 0; i < s->n; i++) used += write_body(s, i, text + used, room - (size_t)used);
    return used;
}

/* `behind`: further keys of each ratio. */
static int write_ratios(const struct system *s, const char *behind, char *text, size_t room)
{
    int used = snprintf(text, room, "couplings:\n");
    for (int j = 0; j < s->rows; j++) {
        used += snprintf(text + used, room - (size_t)used, "  - ratio: {name: r%d%s", j, behind);
        for (int i = 0; i < s->n; i++)
            if (s->C[j][i] != 0)
                used +=
                    snprintf(text + used, room - (size_t)used, ", b%d.%s: %.17g%s", i,
                             s->turns[i] ? "theta" : "x", s->C[j][i], s->turns[i] && !s->angular ? " m" : "");
        used += snprintf(text + used, room - (size_t)used, "}\n");
    }
    return used;
}

enum { text_size = 4000 };

static struct trial open_system(const struct system *s, const char *behind, double until)
{
    char text[text_size];
    int used = write_bodies(s, text, sizeof text);
    used += write_ratios(s, behind, text + used, sizeof text - (size_t)used);
    snprintf(text + used, sizeof text - (size_t)used, "simulate: {until: %.17g}\n", until);
    return trial_parse(text);
}

static const char *coordinate_of(const struct system *s, int i, bool rate)
{
    static char name[20];
    snprintf(name, sizeof name, "b%d.%s", i, s->turns[i] ? (rate ? "omega" : "theta") : (rate ? "v" : "x"));
    return name;
}

static void check_constant(struct checks *checks, struct random_numbers *numbers)
{
    struct system s;
    double a[most], lambda[most], size = 0, force = 0;
    const double until = random_between(numbers, 0.5, 2);
    draw_system(numbers, 1, 3, &s);
    respond(&s, s.F, a, lambda);
    struct trial trial = open_system(&s, "", until);
    for (int i = 0; i < s.n; i++) force = fmax(force, fabs(s.F[i]));
    for (int i = 0; i < s.n; i++)
        for (int j = 0; j < s.rows; j++) force = fmax(force, fabs(s.C[j][i] * lambda[j]));
    for (int i = 0; i < s.n; i++)
        for (int j = 0; j < s.rows; j++) {
            char name[8];
            snprintf(name, sizeof name, "r%d", j);
            if (s.C[j][i] != 0)
                check_close(checks, "force", trial_term(&trial, coordinate_of(&s, i, false), name),
                            s.C[j][i] * lambda[j], accuracy * force);
        }
    trial_start(&trial, NULL);
    trial_finish(&trial);
    for (int i = 0; i < s.n; i++)
        size = fmax(size, fabs(s.q[i]) + fabs(s.v[i]) * until + fabs(a[i]) * until * until);
    for (int i = 0; i < s.n; i++) {
        check_close(checks, "position", trial_get(&trial, coordinate_of(&s, i, false)),
                    s.q[i] + s.v[i] * until + a[i] * until * until / 2, accuracy * size);
        check_close(checks, "rate", trial_get(&trial, coordinate_of(&s, i, true)), s.v[i] + a[i] * until,
                    accuracy * size / until);
    }
    trial_close(&trial);
}

/* ---- as it begins */

static void check_begin(struct checks *checks, struct random_numbers *numbers)
{
    struct system s;
    double f[most] = {0}, after[most], lambda[most], lost = 0, size = 0;
    const double begin = random_between(numbers, 0.2, 1);
    char behind[60];
    draw_system(numbers, 1, 1, &s);
    for (int i = 0; i < s.n; i++) s.F[i] = 0, s.v[i] = random_between(numbers, -2, 2);
    for (int i = 0; i < s.n; i++) f[i] = s.m[i] * s.v[i];
    respond(&s, f, after, lambda);
    snprintf(behind, sizeof behind, ", from: \"t > %.17g[s]\"", begin);
    struct trial trial = open_system(&s, behind, 2 * begin);
    trial_run(&trial, NULL);
    for (int i = 0; i < s.n; i++) {
        lost += s.m[i] * (s.v[i] * s.v[i] - after[i] * after[i]) / 2;
        size = fmax(size, fabs(s.v[i]));
    }
    for (int i = 0; i < s.n; i++)
        check_close(checks, "rate after its begin", trial_get(&trial, coordinate_of(&s, i, true)), after[i],
                    accuracy * size);
    const fbd_energy energy = fbd_result_energy(trial.result);
    check_close(checks, "energy lost", energy.initial_kinetic - energy.kinetic, lost,
                accuracy * energy.initial_kinetic);
    check_close(checks, "its work", energy.work, -lost, accuracy * energy.initial_kinetic);
    trial_close(&trial);
}

/* ---- at a stop, with friction, and as it breaks */

static void check_stop(struct checks *checks, struct random_numbers *numbers)
{
    const double c = draw_factor(numbers), m_1 = random_between(numbers, 0.5, 5),
                 m_2 = random_between(numbers, 0.5, 5);
    const double v = random_between(numbers, 0.5, 3), e = random_between(numbers, 0, 1), hit = 1;
    char text[text_size];
    snprintf(
        text, sizeof text,
        "fbd: 1\nbodies:\n  a: {mass: %.17g, motion: {slide: {max: %.17g, restitution: %.17g}}, initial: "
        "{v: "
        "%.17g}}\n  b: {mass: %.17g, motion: {slide: {along: 50 deg}}, initial: {v: %.17g}}\ncouplings:\n"
        "  - ratio: {a.x: %.17g, b.x: -1}\nsimulate: {until: 2}\n",
        m_1, v * hit, e, v, m_2, c * v, c);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    check_close(checks, "stop", trial_event(&trial, FBD_EVENT_IMPACT, NULL, 0), hit, accuracy * hit);
    check_close(checks, "a rebounds", trial_get(&trial, "a.v"), -e * v, accuracy * v);
    check_close(checks, "b rebounds", trial_get(&trial, "b.v"), -e * c * v, accuracy * fabs(c * v));
    trial_close(&trial);
}

/* b falls by c times the way of a, whose friction has the limit mu m_1 g. */
static void check_friction(struct checks *checks, struct random_numbers *numbers)
{
    const double c = random_between(numbers, 0.2, 3), m_1 = random_between(numbers, 0.5, 5),
                 m_2 = random_between(numbers, 0.5, 5), mu = random_between(numbers, 0.1, 1.5);
    const double drive = c * m_2 * g - mu * m_1 * g, a = fmax(0, drive) / (m_1 + c * c * m_2);
    char text[text_size];
    snprintf(
        text, sizeof text,
        "fbd: 1\nbodies:\n  a: {mass: %.17g, motion: slide, forces: [gravity, normal, friction: %.17g]}\n  "
        "b: "
        "{mass: %.17g, motion: {slide: {along: -90 deg}}, forces: [gravity]}\ncouplings:\n  - ratio: {name: "
        "link, a.x: %.17g, b.x: -1}\nsimulate: {until: 1}\n",
        m_1, mu, m_2, c);
    struct trial trial = trial_parse(text);
    check_close(checks, "force with friction", trial_term(&trial, "b.x", "link"), -m_2 * (g - c * a),
                accuracy * m_2 * g);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    check_close(checks, "v with friction", trial_get(&trial, "a.v"), a, accuracy * g);
    trial_close(&trial);
}

/* A force p t on b needs the force p t m_1 / (c^2 m_2 + m_1) c of the ratio on a. */
static void check_breaking(struct checks *checks, struct random_numbers *numbers)
{
    const double c = draw_factor(numbers), m_1 = random_between(numbers, 0.5, 5),
                 m_2 = random_between(numbers, 0.5, 5);
    const double at = random_between(numbers, 0.3, 1), p = random_between(numbers, 1, 20);
    const double limit = fabs(c) * p * at * m_1 / (c * c * m_2 + m_1);
    const bool turns = random_chance(numbers, 0.5);
    char inertia[60], text[text_size];
    snprintf(inertia, sizeof inertia, "inertia: %.17g, motion: pivot", m_1);
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n  a: {mass: %.17g, %s}\n  b: {mass: %.17g, motion: slide, forces: [applied: "
             "{value: \"%.17g[N/s]*t\"}]}\ncouplings:\n  - ratio: {a.%s: %.17g%s, b.x: -1, until: \"%s > "
             "%.17g[%s]\"}\n"
             "simulate: {until: %.17g}\n",
             m_1, turns ? inertia : "motion: {slide: {along: 50 deg}}", m_2, p, turns ? "theta" : "x", c,
             turns ? " m" : "", turns ? "moment" : "force", limit, turns ? "N*m" : "N", 1.5 * at);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    check_close(checks, "break", trial_event(&trial, FBD_EVENT_COUPLING_ENDS, NULL, 0), at, accuracy * at);
    trial_close(&trial);
}

/* ---- a slide on an arm on a cart */

/* Cart x, arm theta about an axis of the cart at the height 0 with its centre of mass at the distance l, and a slide at
 * s on the line through the axis at the angle beta to the arm. */
struct carried {
    double m[3], I[2], l, beta; /* masses; moments of inertia of arm and slide about their centres of mass */
    int rows, free;
    double C[2][3], B[3][2];
    double q[3], v[3];
};

/* The mass matrix and M^-1 the forces: m J^T J, and f = -m J^T (J' v - gravity). */
static void assemble(const struct carried *s, const double *q, const double *v, double M[3][3], double *f)
{
    const double a = q[1] + s->beta, c = cos(q[1]), n = sin(q[1]), C = cos(a), N = sin(a), w = v[1];
    const double J[3][2][3] = {{{1, 0, 0}, {0, 0, 0}},
                               {{1, -s->l * n, 0}, {0, s->l * c, 0}},
                               {{1, -q[2] * N, C}, {0, q[2] * C, N}}};
    const double bias[3][2] = {{0, 0},
                               {-s->l * c * w * w, -s->l * n * w * w},
                               {-q[2] * C * w * w - 2 * N * w * v[2], -q[2] * N * w * w + 2 * C * w * v[2]}};
    memset(M, 0, 9 * sizeof M[0][0]);
    memset(f, 0, 3 * sizeof *f);
    for (int b = 0; b < 3; b++)
        for (int axis = 0; axis < 2; axis++)
            for (int i = 0; i < 3; i++) {
                f[i] -= s->m[b] * J[b][axis][i] * (bias[b][axis] + (axis == 1 ? g : 0));
                for (int k = 0; k < 3; k++) M[i][k] += s->m[b] * J[b][axis][i] * J[b][axis][k];
            }
    M[1][1] += s->I[0] + s->I[1];
}

/* y = u, u'; q = q_0 + B u. */
static void rates(const struct carried *s, const double *y, double *rate)
{
    double q[3], v[3], M[3][3], f[3], A[most][most] = {{0}}, b[most] = {0};
    for (int i = 0; i < 3; i++) {
        q[i] = s->q[i];
        v[i] = 0;
        for (int k = 0; k < s->free; k++) q[i] += s->B[i][k] * y[k], v[i] += s->B[i][k] * y[s->free + k];
    }
    assemble(s, q, v, M, f);
    for (int j = 0; j < s->free; j++)
        for (int i = 0; i < 3; i++) {
            b[j] += s->B[i][j] * f[i];
            for (int k = 0; k < s->free; k++)
                for (int h = 0; h < 3; h++) A[j][k] += s->B[i][j] * M[i][h] * s->B[h][k];
        }
    solve(s->free, A, b);
    for (int k = 0; k < s->free; k++) rate[k] = y[s->free + k], rate[s->free + k] = b[k];
}

/* Runge-Kutta of order 4 with steps h. */
static void integrate(const struct carried *s, double *y, double until, int steps)
{
    const double h = until / steps, nodes[4] = {0, 0.5, 0.5, 1}, weights[4] = {1, 2, 2, 1};
    const int size = 2 * s->free;
    for (int step = 0; step < steps; step++) {
        double k[4] = {0}, sum[4] = {0}, place[4];
        for (int stage = 0; stage < 4; stage++) {
            for (int i = 0; i < size; i++) place[i] = y[i] + h * nodes[stage] * k[i];
            rates(s, place, k);
            for (int i = 0; i < size; i++) sum[i] += weights[stage] * k[i] / 6;
        }
        for (int i = 0; i < size; i++) y[i] += h * sum[i];
    }
}

static void draw_carried(struct random_numbers *numbers, struct carried *s)
{
    *s = (struct carried){.rows = random_chance(numbers, 0.5) ? 2 : 1};
    for (int b = 0; b < 3; b++) s->m[b] = random_between(numbers, 0.5, 3);
    for (int b = 0; b < 2; b++) s->I[b] = random_between(numbers, 0.1, 1);
    for (int i = 0; i < 3; i++) s->q[i] = random_between(numbers, -1, 1);
    s->l = random_between(numbers, 0.2, 1);
    s->beta = random_between(numbers, -3, 3);
    s->free = 3 - s->rows;
    /* the last coordinates by the first ones: q_i = q_i0 + r u */
    for (int j = 0; j < s->rows; j++) {
        const int i = 3 - s->rows + j;
        s->C[j][i] = draw_factor(numbers);
        for (int k = 0; k < s->free; k++) {
            s->C[j][k] =
                -s->C[j][i] * random_between(numbers, 0.3, 2) * (random_chance(numbers, 0.5) ? 1 : -1);
            s->B[i][k] = -s->C[j][k] / s->C[j][i];
        }
    }
    for (int k = 0; k < s->free; k++) s->B[k][k] = 1;
}

static struct trial open_carried(const struct carried *s, const double *u, double until)
{
    char text[text_size];
    int used = snprintf(
        text, sizeof text,
        "fbd: 1\nbodies:\n  cart: {mass: %.17g, motion: slide, initial: {x: %.17g, v: %.17g}}\n  arm: "
        "{parts: {p: {mass: %.17g, inertia: %.17g, center: [%.17g, 0]}}, motion: {pivot: {on: cart, "
        "at: [0, 0], point: [0, 0]}}, initial: {theta: %.17g rad, omega: %.17g}, forces: [gravity]}\n"
        "  ring: {mass: %.17g, inertia: %.17g, motion: {slide: {on: arm, along: %.17g rad}}, initial: "
        "{x: %.17g, v: %.17g}, forces: [gravity]}\ncouplings:\n",
        s->m[0], s->q[0], u[0], s->m[1], s->I[0], s->l, s->q[1], u[1], s->m[2], s->I[1], s->beta, s->q[2],
        u[2]);
    for (int j = 0; j < s->rows; j++) {
        static const char *const names[] = {"cart.x", "arm.theta", "ring.x"};
        used += snprintf(text + used, sizeof text - (size_t)used, "  - ratio: {name: r%d", j);
        for (int i = 0; i < 3; i++)
            if (s->C[j][i] != 0)
                used += snprintf(text + used, sizeof text - (size_t)used, ", %s: %.17g%s", names[i],
                                 s->C[j][i], i == 1 ? " m" : "");
        used += snprintf(text + used, sizeof text - (size_t)used, "}\n");
    }
    snprintf(text + used, sizeof text - (size_t)used, "simulate: {until: %.17g}\n", until);
    return trial_parse(text);
}

static void check_carried(struct checks *checks, struct random_numbers *numbers)
{
    struct carried s;
    double y[4] = {0}, v[3] = {0}, rate[4];
    const double until = random_between(numbers, 0.2, 0.6);
    draw_carried(numbers, &s);
    for (int k = 0; k < s.free; k++) y[s.free + k] = random_between(numbers, -1, 1);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < s.free; k++) v[i] += s.B[i][k] * y[s.free + k];
    struct trial trial = open_carried(&s, v, until);
    rates(&s, y, rate);
    check_close(checks, "acceleration", trial_acceleration(&trial, "cart.x"), rate[s.free],
                1e-9 * (1 + fabs(rate[s.free]) + fabs(rate[2 * s.free - 1])));
    trial_start(&trial, NULL);
    trial_finish(&trial);
    integrate(&s, y, until, 400);
    static const char *const names[] = {"cart.x", "arm.theta", "ring.x"};
    for (int i = 0; i < 3; i++) {
        double q = s.q[i], size = 1 + fabs(s.q[i]);
        for (int k = 0; k < s.free; k++) q += s.B[i][k] * y[k], size += fabs(s.B[i][k] * y[s.free + k]);
        check_close(checks, names[i], trial_get(&trial, names[i]), q, 1e-7 * size);
    }
    trial_close(&trial);
}

static void ratios_have_closed_forms(void **unused)
{
    (void)unused;
    static void (*const kinds[])(struct checks *, struct random_numbers *) = {check_constant, check_begin,
                                                                              check_stop,     check_friction,
                                                                              check_breaking, check_carried};
    const int draws = draws_of(300);
    struct random_numbers numbers = {2052};
    struct checks checks = {0};
    for (int i = 0; i < draws; i++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) kinds[k](&checks, &numbers);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ratios_have_closed_forms)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
