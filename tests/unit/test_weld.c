/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Welds that begin during a run, against closed forms with random numbers.
 *
 *   two free bodies   momentum and angular momentum are kept, the kinetic energy is that of one rigid body after, and
 *                     its loss is the work of the weld; both turn and move as one body from then on
 *   on a pivot        a plate flies into a pendulum: (I_O + I + m r^2) omega = L about the axis
 *   of a particle     the same without its moment of inertia
 *   one after another bodies join a cluster, each at its time: momentum and angular momentum of all that are in it
 *   on an arm         a plate sticks to the second link of an arm: the velocities after are the projection of those
 *                     before onto the constraints, in the coordinates x, y, theta of all three bodies,
 *                     v' = v - W J^T (J W J^T)^-1 J v with W the inverse masses, solved by elimination here
 *   that breaks       a cantilever under a growing load, at the time at which its couple is m g L/2 + k t L
 *   the models        of the gallery, by the formulas in their heads
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

static const double accuracy = 1e-9; /* relative; the tolerance of a run is 1e-10 */

struct free_body {
    double m, I, x, y, vx, vy, omega;
};

static struct free_body draw_body(struct random_numbers *numbers)
{
    return (struct free_body){.m = pow(10, random_between(numbers, -1, 1)),
                              .I = pow(10, random_between(numbers, -2, 1)),
                              .x = random_between(numbers, -1, 1),
                              .y = random_between(numbers, -1, 1),
                              .vx = random_between(numbers, -2, 2),
                              .vy = random_between(numbers, -2, 2),
                              .omega = random_between(numbers, -2, 2)};
}

static int write_body(const struct free_body *b, const char *name, char *text, size_t room)
{
    return snprintf(
        text, room,
        "  %s: {mass: %.17g, inertia: %.17g, motion: planar, initial: {x: %.17g, y: %.17g, vx: %.17g, vy: "
        "%.17g, omega: %.17g}}\n",
        name, b->m, b->I, b->x, b->y, b->vx, b->vy, b->omega);
}

static double energy_of(const struct free_body *b)
{
    return (b->m * (b->vx * b->vx + b->vy * b->vy) + b->I * b->omega * b->omega) / 2;
}

/* The rigid body of both, at rest in the plane: its centre of mass, inertia and velocities. */
static struct free_body joined(const struct free_body *a, const struct free_body *b)
{
    struct free_body all = {.m = a->m + b->m, .I = a->I + b->I};
    const struct free_body *both[] = {a, b};
    for (int i = 0; i < 2; i++) {
        all.x += both[i]->m * both[i]->x / all.m, all.y += both[i]->m * both[i]->y / all.m;
        all.vx += both[i]->m * both[i]->vx / all.m, all.vy += both[i]->m * both[i]->vy / all.m;
    }
    double L = 0;
    for (int i = 0; i < 2; i++) {
        const double x = both[i]->x - all.x, y = both[i]->y - all.y;
        all.I += both[i]->m * (x * x + y * y);
        L += both[i]->I * both[i]->omega + both[i]->m * (x * both[i]->vy - y * both[i]->vx);
    }
    all.omega = L / all.I;
    return all;
}

static void check_free(struct checks *checks, struct random_numbers *numbers)
{
    struct free_body a = draw_body(numbers), b = draw_body(numbers);
    const double begin = random_between(numbers, 0.2, 1), after = random_between(numbers, 0.5, 2);
    char text[2000];
    int used = snprintf(text, sizeof text, "fbd: 1\nbodies:\n");
    used += write_body(&a, "a", text + used, sizeof text - (size_t)used);
    used += write_body(&b, "b", text + used, sizeof text - (size_t)used);
    snprintf(text + used, sizeof text - (size_t)used,
             "couplings:\n  - weld: {between: [a, b], from: \"t > %.17g[s]\"}\nsimulate: {until: %.17g}\n",
             begin, begin + after);
    const double before = energy_of(&a) + energy_of(&b);
    a.x += a.vx * begin, a.y += a.vy * begin, b.x += b.vx * begin, b.y += b.vy * begin;
    const struct free_body all = joined(&a, &b);
    const double turn = all.omega * after, x = a.x - all.x, y = a.y - all.y;
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    const fbd_energy energy = fbd_result_energy(trial.result);
    check_close(checks, "kinetic energy", energy.kinetic, energy_of(&all), accuracy * before);
    check_close(checks, "work", energy.work, energy_of(&all) - before, accuracy * before);
    check_close(checks, "omega", trial_get(&trial, "a.omega"), all.omega, accuracy * (1 + fabs(all.omega)));
    check_close(checks, "omega of the other", trial_get(&trial, "b.omega"), all.omega,
                accuracy * (1 + fabs(all.omega)));
    check_close(checks, "angle", trial_get(&trial, "b.theta"), b.omega * begin + turn,
                accuracy * (1 + fabs(turn)));
    check_close(checks, "x", trial_get(&trial, "a.x"), all.x + all.vx * after + x * cos(turn) - y * sin(turn),
                10 * accuracy);
    check_close(checks, "y", trial_get(&trial, "a.y"), all.y + all.vy * after + x * sin(turn) + y * cos(turn),
                10 * accuracy);
    trial_close(&trial);
}

/* A plate, or a particle, with the horizontal speed u at the height -r below the axis of a bar that hangs. */
static void check_pendulum(struct checks *checks, struct random_numbers *numbers)
{
    const bool particle = random_chance(numbers, 0.3);
    const double I_O = random_between(numbers, 0.1, 3), m = random_between(numbers, 0.01, 2),
                 I = random_between(numbers, 0.001, 0.5), r = random_between(numbers, 0.2, 2),
                 u = random_between(numbers, 1, 100), w = particle ? 0 : random_between(numbers, -5, 5);
    char motion[120], text[1500];
    snprintf(motion, sizeof motion, particle ? "motion: particle" : "inertia: %.17g, motion: planar", I);
    snprintf(
        text, sizeof text,
        "fbd: 1\nbodies:\n  bar: {mass: 2, inertia: %.17g, motion: pivot}\n  plate: {mass: %.17g, %s, "
        "initial: "
        "{x: -1, y: %.17g, vx: %.17g%s%.17g}}\ncouplings:\n  - weld: {between: [plate, bar], from: plate.x > "
        "0}\nsimulate: {until: %.17g}\n",
        I_O, m, motion, -r, u, particle ? ", vy: " : ", omega: ", w, 1.5 / u);
    const double J = I_O + m * r * r + (particle ? 0 : I), L = m * r * u + (particle ? 0 : I * w),
                 omega = L / J;
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    check_close(checks, "begin", trial_event(&trial, FBD_EVENT_COUPLING_BEGINS, NULL, 0), 1 / u,
                accuracy / u);
    check_close(checks, "omega of the bar", trial_get(&trial, "bar.omega"), omega, accuracy * u / r);
    const fbd_energy energy = fbd_result_energy(trial.result);
    check_close(checks, "energy", energy.kinetic, J * omega * omega / 2, accuracy * m * u * u);
    trial_close(&trial);
}

/* ---- one after another */

enum { cluster = 5 };

/* Move a free body on. */
static void drift(struct free_body *b, double time)
{
    b->x += b->vx * time, b->y += b->vy * time;
}

/* Move a body of a cluster on by its rigid motion. */
static void turn_with(struct free_body *b, const struct free_body *all, double time)
{
    const double c = cos(all->omega * time), s = sin(all->omega * time), x = b->x - all->x, y = b->y - all->y;
    b->x = all->x + all->vx * time + c * x - s * y;
    b->y = all->y + all->vy * time + s * x + c * y;
}

static void join_in_turn(struct free_body *bodies, struct free_body *all, const double *begin, double end)
{
    double now = 0;
    *all = bodies[0];
    for (int i = 1; i <= cluster; i++) {
        const double next = i < cluster ? begin[i] : end;
        for (int k = 0; k < i; k++) turn_with(&bodies[k], all, next - now);
        for (int k = i; k < cluster; k++) drift(&bodies[k], next - now);
        drift(all, next - now);
        if (i < cluster) *all = joined(all, &bodies[i]);
        now = next;
    }
}

static void check_cluster(struct checks *checks, struct random_numbers *numbers)
{
    struct free_body bodies[cluster], all;
    double begin[cluster] = {0}, before = 0;
    char text[4000], name[8];
    int used = snprintf(text, sizeof text, "fbd: 1\nbodies:\n");
    for (int i = 0; i < cluster; i++) {
        bodies[i] = draw_body(numbers);
        before += energy_of(&bodies[i]);
        snprintf(name, sizeof name, "b%d", i);
        used += write_body(&bodies[i], name, text + used, sizeof text - (size_t)used);
    }
    used += snprintf(text + used, sizeof text - (size_t)used, "couplings:\n");
    for (int i = 1; i < cluster; i++) {
        begin[i] = begin[i - 1] + random_between(numbers, 0.1, 0.4);
        const int other = (int)(random_between(numbers, 0, 1) * i);
        used += snprintf(text + used, sizeof text - (size_t)used,
                         "  - weld: {name: w%d, between: [b%d, b%d], from: \"t > %.17g[s]\"}\n", i, i, other,
                         begin[i]);
    }
    const double end = begin[cluster - 1] + 0.5;
    snprintf(text + used, sizeof text - (size_t)used, "simulate: {until: %.17g}\n", end);
    join_in_turn(bodies, &all, begin, end);
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    const fbd_energy energy = fbd_result_energy(trial.result);
    check_close(checks, "kinetic energy of all", energy.kinetic, energy_of(&all), 10 * accuracy * before);
    check_close(checks, "work of all welds", energy.work, energy_of(&all) - before, 10 * accuracy * before);
    for (int i = 0; i < cluster; i++) {
        snprintf(name, sizeof name, "b%d.x", i);
        check_close(checks, name, trial_get(&trial, name), bodies[i].x, 100 * accuracy);
        name[3] = 'y';
        check_close(checks, name, trial_get(&trial, name), bodies[i].y, 100 * accuracy);
    }
    trial_close(&trial);
}

/* ---- on an arm */

enum { velocities = 9, rows = 7 };

/* Add the row (d_A - d_B) = 0 of the points of two bodies at p, along x or y; a body below zero is the ground. */
static void add_row(const struct free_body *bodies, int a, int b, const double *p, int along, double *row)
{
    const int both[2] = {a, b};
    for (int k = 0; k < 2; k++) {
        const double sign = k == 0 ? 1 : -1;
        if (both[k] < 0) continue;
        const struct free_body *body = &bodies[both[k]];
        row[3 * both[k] + along] = sign;
        row[3 * both[k] + 2] = along == 0 ? -sign * (p[1] - body->y) : sign * (p[0] - body->x);
    }
}

/* Solve A x = b by elimination with pivots, x in place of b. */
static void solve(double a[rows][rows], double *b)
{
    for (int k = 0; k < rows; k++) {
        int best = k;
        for (int i = k + 1; i < rows; i++)
            if (fabs(a[i][k]) > fabs(a[best][k])) best = i;
        for (int j = 0; j < rows; j++) {
            const double kept = a[k][j];
            a[k][j] = a[best][j], a[best][j] = kept;
        }
        const double kept = b[k];
        b[k] = b[best], b[best] = kept;
        for (int i = k + 1; i < rows; i++) {
            const double factor = a[i][k] / a[k][k];
            for (int j = k; j < rows; j++) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (int k = rows; k-- > 0;) {
        for (int j = k + 1; j < rows; j++) b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
}

static void project(const struct free_body *bodies, double J[rows][velocities], double *v)
{
    double inverse[velocities], a[rows][rows], b[rows];
    for (int i = 0; i < velocities; i++) inverse[i] = 1 / (i % 3 == 2 ? bodies[i / 3].I : bodies[i / 3].m);
    for (int i = 0; i < rows; i++) {
        b[i] = 0;
        for (int j = 0; j < velocities; j++) b[i] += J[i][j] * v[j];
        for (int k = 0; k < rows; k++) {
            a[i][k] = 0;
            for (int j = 0; j < velocities; j++) a[i][k] += J[i][j] * inverse[j] * J[k][j];
        }
    }
    solve(a, b);
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < velocities; j++) v[j] -= inverse[j] * J[i][j] * b[i];
}

struct arm {
    double theta[2], omega[2], length; /* angles in the world; the length of the first link */
    struct free_body bodies[3];        /* both links, with G in the middle of the first, and the plate */
};

static struct arm draw_arm(struct random_numbers *numbers)
{
    struct arm arm = {.length = random_between(numbers, 0.5, 1.5)};
    for (int i = 0; i < 3; i++) arm.bodies[i] = draw_body(numbers);
    for (int i = 0; i < 2; i++) {
        arm.theta[i] = random_between(numbers, -3, 3);
        arm.omega[i] = arm.bodies[i].omega;
    }
    return arm;
}

/* The places and velocities of the centres of mass of the links; that of the second is 0.4 m from its pin. */
static void place_links(struct arm *arm, double *elbow)
{
    double at[2] = {0, 0}, v[2] = {0, 0};
    const double out[2] = {0.5 * arm->length, 0.4};
    for (int i = 0; i < 2; i++) {
        struct free_body *b = &arm->bodies[i];
        const double c = cos(arm->theta[i]), s = sin(arm->theta[i]), w = arm->omega[i];
        b->x = at[0] + out[i] * c, b->y = at[1] + out[i] * s;
        b->vx = v[0] - out[i] * s * w, b->vy = v[1] + out[i] * c * w;
        if (i > 0) continue;
        at[0] = elbow[0] = arm->length * c, at[1] = elbow[1] = arm->length * s;
        v[0] = -at[1] * w, v[1] = at[0] * w;
    }
}

static void write_arm(const struct arm *arm, char *text, size_t room)
{
    const struct free_body *b = arm->bodies;
    int used = snprintf(text, room,
                        "fbd: 1\nbodies:\n  upper: {mass: %.17g, inertia: %.17g, motion: {pivot: {point: "
                        "[%.17g, 0]}}, initial: "
                        "{theta: %.17g, omega: %.17g}}\n  lower: {mass: %.17g, inertia: %.17g, motion: "
                        "{pivot: {on: upper, at: "
                        "[%.17g, 0], point: [-0.4, 0]}}, initial: {theta: %.17g, omega: %.17g}}\n",
                        b[0].m, b[0].I, -0.5 * arm->length, arm->theta[0], arm->omega[0], b[1].m, b[1].I,
                        0.5 * arm->length, arm->theta[1] - arm->theta[0], arm->omega[1] - arm->omega[0]);
    used += write_body(&b[2], "plate", text + used, room - (size_t)used);
    snprintf(text + used, room - (size_t)used,
             "couplings:\n  - weld: {name: w, between: [%s], from: t > 1e-13}\nsimulate: {until: 1e-12}\n",
             arm->length < 1 ? "plate, lower" : "lower, plate");
}

static void check_arm(struct checks *checks, struct random_numbers *numbers)
{
    struct arm arm = draw_arm(numbers);
    const struct free_body *b = arm.bodies;
    double elbow[2], J[rows][velocities] = {{0}}, v[velocities], before = 0, after = 0;
    const double origin[2] = {0, 0};
    char text[2000];
    place_links(&arm, elbow);
    for (int along = 0; along < 2; along++) {
        add_row(b, 0, -1, origin, along, J[along]);
        add_row(b, 1, 0, elbow, along, J[2 + along]);
        add_row(b, 2, 1, (const double[]){b[2].x, b[2].y}, along, J[4 + along]);
    }
    J[6][8] = 1, J[6][5] = -1;
    for (int i = 0; i < 3; i++) v[3 * i] = b[i].vx, v[3 * i + 1] = b[i].vy, v[3 * i + 2] = b[i].omega;
    for (int i = 0; i < velocities; i++) before += (i % 3 == 2 ? b[i / 3].I : b[i / 3].m) * v[i] * v[i] / 2;
    project(b, J, v);
    for (int i = 0; i < velocities; i++) after += (i % 3 == 2 ? b[i / 3].I : b[i / 3].m) * v[i] * v[i] / 2;
    write_arm(&arm, text, sizeof text);
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    const fbd_energy energy = fbd_result_energy(trial.result);
    check_close(checks, "energy of the arm", energy.kinetic, after, accuracy * before);
    check_close(checks, "work of its weld", energy.work, after - before, accuracy * before);
    check_close(checks, "upper", trial_get(&trial, "upper.omega"), v[2], accuracy * (1 + fabs(v[2])));
    check_close(checks, "lower", trial_get(&trial, "lower.omega"), v[5] - v[2],
                accuracy * (1 + fabs(v[2]) + fabs(v[5])));
    check_close(checks, "plate", trial_get(&trial, "plate.vx"), v[6], accuracy * (1 + fabs(v[6])));
    trial_close(&trial);
}

/* ---- that breaks */

static void check_cantilever(struct checks *checks, struct random_numbers *numbers)
{
    const double m = random_between(numbers, 0.5, 10), L = random_between(numbers, 0.5, 3),
                 k = random_between(numbers, 5, 100), t = random_between(numbers, 0.2, 2),
                 most = 9.81 * m * L / 2 + k * t * L;
    const bool wall_first = random_chance(numbers, 0.5);
    char text[1000];
    snprintf(
        text, sizeof text,
        "fbd: 1\nground: {points: {W: [1, 2]}}\nbodies:\n  beam: {mass: %.17g, shape: rod, length: %.17g, "
        "motion: planar, initial: {x: %.17g, y: 2}, forces: [gravity, applied: {name: load, value: "
        "\"%.17g[N/s]*t\", angle: -90 deg, at: right}]}\ncouplings:\n  - weld: {name: wall, between: [%s], "
        "until: \"moment > %.17g[N*m]\"}\nsimulate: {until: %.17g}\n",
        m, L, 1 + L / 2, k, wall_first ? "ground.W, beam" : "beam.left, ground.W", most, 1.1 * t);
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    check_close(checks, "break", trial_event(&trial, FBD_EVENT_COUPLING_ENDS, NULL, 0), t,
                accuracy * (1 + t));
    const double vy = -(9.81 * 0.1 * t + k / m * (1.21 - 1) * t * t / 2);
    check_close(checks, "vy", trial_get(&trial, "beam.vy"), vy, 10 * accuracy * (1 + fabs(vy)));
    trial_close(&trial);
}

/* ---- the models */

static void check_sticky_plate(struct checks *checks)
{
    const double m_b = 2, L = 1, m = 0.5, s = 0.2, r = 0.8, u = 6, g = 9.81,
                 J = m_b * L * L / 3 + m * (s * s * (1 / 6.0 + 0.25) + r * r), omega = m * u * r / J;
    double low = 0.1, high = acos(-1);
    while (high - low > 1e-15) {
        const double phi = (low + high) / 2,
                     rest = (m_b * L / 2 + m * r) * (1 - cos(phi)) - m * s / 2 * sin(phi);
        *(rest > J * omega * omega / (2 * g) ? &high : &low) = phi;
    }
    struct trial trial = trial_open("couplings/sticky_plate.yaml", NULL);
    trial_start(&trial, NULL);
    check_close(checks, "meets", trial_to_event(&trial, FBD_EVENT_COUPLING_BEGINS, NULL, 0), 0.1, accuracy);
    check_close(checks, "omega of both", trial_get(&trial, "bar.omega"), omega, accuracy);
    trial_to_event(&trial, FBD_EVENT_USER, "top", 0);
    check_close(checks, "top", trial_get(&trial, "bar.theta"), low - acos(0), accuracy);
    trial_close(&trial);
}

static void check_breaking_weld(struct checks *checks)
{
    struct trial trial = trial_open("couplings/breaking_weld.yaml", NULL);
    trial_run(&trial, NULL);
    check_close(checks, "model breaks", trial_event(&trial, FBD_EVENT_COUPLING_ENDS, NULL, 0),
                (160 - 6 * 9.81) / 80, accuracy);
    trial_close(&trial);
}

static void models_of_welds(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    check_sticky_plate(&checks);
    check_breaking_weld(&checks);
    checks_end(&checks);
}

static void welds_have_closed_forms(void **unused)
{
    (void)unused;
    const int draws = draws_of(200);
    struct random_numbers numbers = {2053};
    struct checks checks = {0};
    for (int i = 0; i < draws; i++) {
        check_free(&checks, &numbers);
        check_pendulum(&checks, &numbers);
        check_cluster(&checks, &numbers);
        check_arm(&checks, &numbers);
        check_cantilever(&checks, &numbers);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(welds_have_closed_forms),
                                       cmocka_unit_test(models_of_welds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
