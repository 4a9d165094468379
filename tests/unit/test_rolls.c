/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random wheels with their mass beside the axle and carts of two wheels, by `roll` or by contacts, under pushes and moments
 * that make them slip, lift off and land, with bearings that rub and ropes that jerk; against a time stepping that knows
 * no events (moreau.h), three coordinates a body. FBD_ROLLS=1000 tries so many, FBD_ROLLS_SEED=17 begins there,
 * FBD_ROLLS_SHOW=1 prints the models.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gallery.h"
#include "moreau.h"
#include "random_numbers.h"
#include "written.h"

enum { most_bodies = 3, most_values = 12 };

static const double g = 10;

struct push { /* A sin(w t + phase) + B */
    double A, w, phase, B;
};

/* q and v are those of its centre of mass and its angle, with the slope, against the x axis. */
struct body {
    double m, I, q[3], v[3];
    struct push push[3]; /* x, y, moment */
    double r, mu;        /* of a wheel */
    double at[2];        /* of a wheel: its axle on the chassis, or from its own centre of mass */
    double rub;          /* of its bearing [N m] */
};

struct vehicle {
    int bodies, first_wheel; /* one wheel, or a chassis and two of them */
    double slope, until;
    double anchor[2], rope; /* from the ground to an axle of a single wheel; infinite without */
    struct body body[most_bodies];
    struct written text;
};

static struct push draw_push(struct random_numbers *numbers, double size)
{
    struct push push = {random_perhaps(numbers, 0.6, 0, size), random_between(numbers, 0.5, 12),
                        random_between(numbers, 0, 6), 0};
    push.B = random_perhaps(numbers, 0.5, -size / 2, size / 2);
    return push;
}

static void add_push(struct vehicle *vehicle, const struct push *push)
{
    add(&vehicle->text, "\"%.17g*sin(%.17g*t + %.17g) + %.17g\"", push->A, push->w, push->phase, push->B);
}

static void add_loads(struct vehicle *vehicle, const struct body *body, bool moments_alone)
{
    add(&vehicle->text, "    forces:\n      - gravity\n");
    if (!moments_alone) {
        add(&vehicle->text, "      - applied: {name: push, fx: ");
        add_push(vehicle, &body->push[0]);
        add(&vehicle->text, ", fy: ");
        add_push(vehicle, &body->push[1]);
        add(&vehicle->text, "}\n");
    }
    add(&vehicle->text, "    moments:\n      - applied: {name: turn, value: ");
    add_push(vehicle, &body->push[2]);
    add(&vehicle->text, "}\n");
    if (body->rub > 0) add(&vehicle->text, "      - friction: {coefficient: %.17g}\n", body->rub);
}

/* ---- draws, with their models */

/* Its frame is at its axle. */
static void draw_wheel(struct random_numbers *numbers, struct vehicle *vehicle)
{
    struct body *wheel = &vehicle->body[0];
    const double s = vehicle->slope, r = random_between(numbers, 0.1, 0.4),
                 m = exp(random_between(numbers, -1, 1)), v = random_perhaps(numbers, 0.8, -2, 2),
                 far = random_perhaps(numbers, 0.3, 0, 0.5) * r, angle = random_between(numbers, -3, 3),
                 lift = random_between(numbers, 0.3, 1.6) * m * g;
    double omega = random_between(numbers, -8, 8), C[2] = {-r * sin(s), r * cos(s)},
           G[2] = {far * cos(angle), far * sin(angle)};
    if (random_chance(numbers, 0.5)) omega = -v / r;
    *wheel = (struct body){.m = m,
                           .I = m * r * r * random_between(numbers, 0.2, 0.9),
                           .q = {C[0] + G[0], C[1] + G[1], 0},
                           .v = {v * cos(s) - omega * G[1], v * sin(s) + omega * G[0], omega},
                           .r = r,
                           .mu = random_between(numbers, 0.03, 0.7),
                           .at = {-G[0], -G[1]}};
    wheel->push[0] = draw_push(numbers, m * g * 0.8);
    wheel->push[1] = (struct push){random_between(numbers, 0, lift), random_between(numbers, 0.5, 12),
                                   random_between(numbers, 0, 6), 0};
    wheel->push[2] = draw_push(numbers, m * g * r * 0.7);
    vehicle->bodies = 1;
    vehicle->anchor[0] = -1;
    vehicle->anchor[1] = 1.2;
    vehicle->rope =
        random_chance(numbers, 0.25)
            ? hypot(C[0] - vehicle->anchor[0], C[1] - vehicle->anchor[1]) + random_between(numbers, 0.01, 0.4)
            : HUGE_VAL;
    add(&vehicle->text,
        "ground: {points: {A: [-1, 1.2]}, lines: {floor: {along: %.17g}}}\nbodies:\n  b0:\n    mass: %.17g\n"
        "    inertia: %.17g\n    center: [%.17g, %.17g]\n    points: {C: [0, 0]}\n    motion: planar\n"
        "    initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g, omega: %.17g}\n",
        s, m, wheel->I, G[0], G[1], C[0], C[1], v * cos(s), v * sin(s), omega);
    add_loads(vehicle, wheel, false);
    add(&vehicle->text,
        "couplings:\n  - roll: {body: b0, on: floor, radius: %.17g, center: [0, 0], static: %.17g}\n", r,
        wheel->mu);
    if (vehicle->rope < HUGE_VAL)
        add(&vehicle->text, "  - rope: {through: [ground.A, b0.C], length: %.17g}\n", vehicle->rope);
}

static void draw_cart_wheel(struct random_numbers *numbers, struct vehicle *vehicle, int b, double v)
{
    struct body *wheel = &vehicle->body[b];
    const struct body *chassis = &vehicle->body[0];
    const double c = cos(vehicle->slope), s = sin(vehicle->slope), size = 3 * g * wheel->r, *at = wheel->at;
    double omega = random_between(numbers, -8, 8);
    if (random_chance(numbers, 0.6)) omega = -v / wheel->r;
    wheel->m = exp(random_between(numbers, -1, 0));
    wheel->I = wheel->m * wheel->r * wheel->r / 2;
    for (int k = 0; k < 3; k++) wheel->q[k] = chassis->q[k], wheel->v[k] = chassis->v[k];
    wheel->q[0] += c * at[0] - s * at[1];
    wheel->q[1] += s * at[0] + c * at[1];
    wheel->v[2] = omega;
    wheel->push[2] = draw_push(numbers, size / 2);
    wheel->rub = random_perhaps(numbers, 0.5, 0.01, 0.7) * size;
    add(&vehicle->text,
        "  b%d:\n    shape: disc\n    radius: %.17g\n    mass: %.17g\n    motion: {pivot: {on: b0, at: "
        "P%d}}\n"
        "    initial: {omega: %.17g}\n",
        b, wheel->r, wheel->m, b, omega);
    add_loads(vehicle, wheel, true);
}

static void draw_cart(struct random_numbers *numbers, struct vehicle *vehicle)
{
    struct body *chassis = &vehicle->body[0], *wheels = chassis + 1;
    const double c = cos(vehicle->slope), s = sin(vehicle->slope), high = random_between(numbers, 0.3, 0.8),
                 v = random_perhaps(numbers, 0.8, -2, 2), m = exp(random_between(numbers, -1, 1));
    *chassis = (struct body){.m = m,
                             .I = m * random_between(numbers, 0.05, 0.2),
                             .q = {-s * high, c * high, vehicle->slope},
                             .v = {v * c, v * s, 0}};
    chassis->push[0] = draw_push(numbers, (m + 1) * g * 0.5);
    chassis->push[1] = (struct push){random_perhaps(numbers, 0.6, 0, 1) * (m + 1) * g,
                                     random_between(numbers, 0.5, 12), random_between(numbers, 0, 6), 0};
    chassis->push[2] = draw_push(numbers, (m + 1) * g * 0.15);
    vehicle->bodies = 3;
    vehicle->first_wheel = 1;
    vehicle->rope = HUGE_VAL;
    for (int k = 0; k < 2; k++)
        wheels[k] = (struct body){.r = random_between(numbers, 0.1, 0.25),
                                  .mu = random_perhaps(numbers, 0.8, 0.03, 0.8)};
    for (int k = 0; k < 2; k++) {
        wheels[k].at[0] = (k ? 1 : -1) * random_between(numbers, 0.3, 0.8);
        wheels[k].at[1] = wheels[k].r - high;
    }
    add(&vehicle->text,
        "ground: {lines: {floor: {along: %.17g}}}\nbodies:\n  b0:\n    mass: %.17g\n    inertia: %.17g\n    "
        "motion: "
        "planar\n    points: {P1: [%.17g, %.17g], P2: [%.17g, %.17g]}\n    initial: {x: %.17g, y: %.17g, "
        "theta: "
        "%.17g, vx: %.17g, vy: %.17g}\n",
        vehicle->slope, m, chassis->I, wheels[0].at[0], wheels[0].at[1], wheels[1].at[0], wheels[1].at[1],
        chassis->q[0], chassis->q[1], vehicle->slope, v * c, v * s);
    add_loads(vehicle, chassis, false);
    for (int b = 1; b < 3; b++) draw_cart_wheel(numbers, vehicle, b, v);
    bool contacts = random_chance(numbers, 0.3);
    add(&vehicle->text, contacts ? "contacts:\n" : "couplings:\n");
    for (int b = 1; b < 3; b++)
        add(&vehicle->text,
            contacts ? "  - {between: [b%d, ground.floor], static: %.17g}\n"
                     : "  - roll: {body: b%d, on: floor, static: %.17g}\n",
            b, vehicle->body[b].mu);
}

static void draw_vehicle(uint64_t seed, struct vehicle *vehicle)
{
    struct random_numbers numbers = {seed};
    *vehicle = (struct vehicle){.until = random_between(&numbers, 0.4, 1.5)};
    vehicle->slope = random_perhaps(&numbers, 0.5, -0.3, 0.3);
    add(&vehicle->text, "fbd: 1\ngravity: %g\n", g);
    (seed % 2 ? draw_wheel : draw_cart)(&numbers, vehicle);
    add(&vehicle->text, "simulate: {until: %.17g}\n", vehicle->until);
}

/* ---- the same for the time stepping */

static void forces(const void *scene, double t, const double *q, const double *v, double *f)
{
    const struct vehicle *vehicle = scene;
    (void)q, (void)v;
    for (int i = 0; i < 3 * vehicle->bodies; i++) {
        const struct push *push = &vehicle->body[i / 3].push[i % 3];
        f[i] = push->A * sin(push->w * t + push->phase) + push->B -
               (i % 3 == 1 ? vehicle->body[i / 3].m * g : 0);
    }
}

static void solve(const void *scene, const double *q, double *b)
{
    const struct vehicle *vehicle = scene;
    (void)q;
    for (int i = 0; i < 3 * vehicle->bodies; i++)
        b[i] /= i % 3 == 2 ? vehicle->body[i / 3].I : vehicle->body[i / 3].m;
}

static struct moreau_row *new_row(struct moreau_rows *rows, enum moreau_kind kind)
{
    struct moreau_row *row = &rows->row[rows->count++];
    *row = (struct moreau_row){.kind = kind, .normal = -1};
    return row;
}

/* A force along (x, y) on body b at `arm` from its centre of mass. */
static void act(struct moreau_row *row, int b, const double *arm, double x, double y)
{
    row->w[3 * b] += x;
    row->w[3 * b + 1] += y;
    row->w[3 * b + 2] += arm[0] * y - arm[1] * x;
}

static void turned(const double *p, double angle, double *to)
{
    to[0] = cos(angle) * p[0] - sin(angle) * p[1];
    to[1] = sin(angle) * p[0] + cos(angle) * p[1];
}

static void wheel_rows(const struct vehicle *vehicle, int b, const double *q, struct moreau_rows *rows)
{
    const struct body *wheel = &vehicle->body[b];
    const double s = sin(vehicle->slope), c = cos(vehicle->slope), none[2] = {0, 0};
    double axle[2] = {0, 0}, on_chassis[2];
    if (vehicle->first_wheel == 0) turned(wheel->at, q[3 * b + 2], axle);
    for (int k = 0; k < 2 && vehicle->first_wheel > 0; k++) {
        struct moreau_row *pin = new_row(rows, moreau_equal);
        turned(wheel->at, q[2], on_chassis);
        act(pin, b, none, !k, k);
        act(pin, 0, on_chassis, -!k, -k);
    }
    if (wheel->rub > 0) {
        struct moreau_row *bearing = new_row(rows, moreau_rub);
        bearing->most = wheel->rub;
        bearing->w[3 * b + 2] = 1;
        bearing->w[2] = -1;
    }
    if (-s * (q[3 * b] + axle[0]) + c * (q[3 * b + 1] + axle[1]) > wheel->r) return;
    double foot[2] = {axle[0] + s * wheel->r, axle[1] - c * wheel->r};
    act(new_row(rows, moreau_gap), b, foot, -s, c);
    struct moreau_row *tread = new_row(rows, moreau_rub);
    act(tread, b, foot, c, s);
    tread->normal = rows->count - 2;
    tread->mu = wheel->mu;
}

static void find_rows(const void *scene, double t, const double *q, struct moreau_rows *rows)
{
    const struct vehicle *vehicle = scene;
    (void)t;
    for (int b = vehicle->first_wheel; b < vehicle->bodies; b++) wheel_rows(vehicle, b, q, rows);
    if (!(vehicle->rope < HUGE_VAL)) return;
    double axle[2];
    turned(vehicle->body[0].at, q[2], axle);
    double x = vehicle->anchor[0] - q[0] - axle[0], y = vehicle->anchor[1] - q[1] - axle[1],
           far = hypot(x, y);
    if (far >= vehicle->rope) act(new_row(rows, moreau_gap), 0, axle, x / far, y / far);
}

/* By the names of the model: of a single wheel the axle, of a cart's wheels the angle against its chassis. Rates are a
 * tenth. */
static int name_values(const struct vehicle *vehicle, const double *q, const double *v, char (*names)[20],
                       double *values)
{
    static const char *const all[] = {"x", "vx", "y", "vy", "theta", "omega"};
    double axle[2] = {0, 0};
    int count = 6;
    if (vehicle->first_wheel == 0) turned(vehicle->body[0].at, q[2], axle);
    values[0] = q[0] + axle[0];
    values[1] = (v[0] - axle[1] * v[2]) / 10;
    values[2] = q[1] + axle[1];
    values[3] = (v[1] + axle[0] * v[2]) / 10;
    values[4] = q[2];
    values[5] = v[2] / 10;
    for (int i = 0; i < 6; i++) snprintf(names[i], sizeof names[i], "b0.%s", all[i]);
    for (int b = 1; b < vehicle->bodies; b++) {
        snprintf(names[count], sizeof names[count], "b%d.theta", b);
        values[count++] = q[3 * b + 2] - q[2];
        snprintf(names[count], sizeof names[count], "b%d.omega", b);
        values[count++] = (v[3 * b + 2] - v[2]) / 10;
    }
    return count;
}

static int step_through(const struct vehicle *vehicle, int steps, char (*names)[20], double *end)
{
    const struct moreau_system system = {3 * vehicle->bodies, vehicle, forces, solve, find_rows, NULL};
    double q[moreau_most] = {0}, v[moreau_most] = {0};
    for (int i = 0; i < 3 * vehicle->bodies; i++)
        q[i] = vehicle->body[i / 3].q[i % 3], v[i] = vehicle->body[i / 3].v[i % 3];
    moreau_run(&system, vehicle->until, steps, q, v);
    return name_values(vehicle, q, v, names, end);
}

static double apart(int count, const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < count; i++)
        if (!(fabs(a[i] - b[i]) <= most)) most = fabs(a[i] - b[i]);
    return most;
}

/* ---- both */

static bool run_vehicle(const struct vehicle *vehicle, int count, char (*names)[20], double *end)
{
    struct trial trial = trial_parse(vehicle->text.all);
    trial_run(&trial, NULL);
    bool done = trial.outcome == FBD_DONE;
    if (!done) printf("# %s\n", fbd_simulation_reason(trial.simulation));
    for (int i = 0; i < count; i++) end[i] = trial_get(&trial, names[i]) / (i % 2 ? 10 : 1);
    trial_close(&trial);
    return done;
}

/* Does the run end where small steps do? Steps and half steps may agree by chance: then smaller ones are asked. */
static bool agrees(uint64_t seed, bool *sensitive)
{
    enum { first_steps = 8000, most_steps = 128000 };
    const double most = 3e-3, least = 3e-4;
    static struct vehicle vehicle;
    char names[most_values][20];
    double end[most_values], fine[most_values], coarse[most_values], off = 0, difference = 0;
    draw_vehicle(seed, &vehicle);
    if (getenv("FBD_ROLLS_SHOW")) puts(vehicle.text.all);
    int count = step_through(&vehicle, first_steps / 2, names, coarse);
    bool done = run_vehicle(&vehicle, count, names, end);
    for (int steps = first_steps; steps <= most_steps; steps *= 2) {
        step_through(&vehicle, steps, names, fine);
        off = apart(count, fine, coarse);
        difference = apart(count, end, fine);
        *sensitive = !(off <= most);
        if ((*sensitive && steps > 2 * first_steps) || (done && difference <= fmax(10 * off, least)))
            return true;
        memcpy(coarse, fine, sizeof fine);
    }
    printf("# seed %llu: %g apart, where the steps are off by %g\n%s\n", (unsigned long long)seed, difference,
           off, vehicle.text.all);
    for (int i = 0; i < count; i++) printf("# %s: %.10g, by steps %.10g\n", names[i], end[i], fine[i]);
    return false;
}

static void time_stepping_says_the_same(void **unused)
{
    (void)unused;
    moreau_compare("FBD_ROLLS", 12, 4, agrees);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(time_stepping_says_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
