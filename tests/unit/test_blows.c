/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random discs, rods, boxes and polygons that strike two or three things at one instant, with friction: walls that make a
 * corner, a wedge or a valley, one floor with two corners, and discs that fly themselves; by all laws, together and one after
 * the other. The flights go backwards in closed form from the instant at which all touch; against impacts by sets
 * (impacts_by_sets.h), and by what holds whatever the law. FBD_BLOWS=1000 tries so many, FBD_BLOWS_SEED=17 begins there,
 * FBD_BLOWS_SHOW=1 prints the models and the impacts.
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
#include "impacts_by_sets.h"
#include "moreau.h"
#include "random_numbers.h"

enum { most_corners = 6, most_touches = 3, most_bodies = 1 + most_touches, text_room = 6000 };

static const double g = 10, instant = 1e-9; /* after the blow its outcome is looked at */

/* q and v are those of centres of mass and angles, at the blow. */
struct body {
    double m, I, radius, q[3], v[3];
};

/* Where the first body touches something: a corner of it, or its rim; and what, of which body, 0 for the ground. */
struct touch {
    int corner, other;
    double normal[2], radius; /* towards the first body; of the other one */
    double arm[2][2];         /* from the centres of mass of both bodies */
    double e, mu;
    enum law_by_steps law;
};

struct scene {
    int bodies, touches, corners;
    bool falls, in_turn, flat;
    int grazes; /* the first of its touches lasts already, without a press */
    double when, radius, corner[most_corners][2], turned[most_corners][2]; /* as it is at the blow */
    struct body body[most_bodies];
    struct touch touch[most_touches];
    const char *kind;
    int length;
    char text[text_room];
};

static void add(struct scene *scene, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    scene->length +=
        vsnprintf(scene->text + scene->length, (size_t)(text_room - scene->length), format, list);
    va_end(list);
    assert_true(scene->length < text_room);
}

/* ---- draws */

static void add_corner(struct scene *scene, double x, double y)
{
    scene->corner[scene->corners][0] = x;
    scene->corner[scene->corners++][1] = y;
}

static void draw_first(struct random_numbers *numbers, struct scene *scene)
{
    static const char *const kinds[] = {"disc", "rod", "prism", "polygon"};
    struct body *body = &scene->body[0];
    double a = random_between(numbers, 0.2, 1), b = random_between(numbers, 0.1, 1), m = body->m;
    int kind = (int)(random_bits(numbers) % 4);
    scene->kind = kinds[kind];
    add(scene, "  b:\n    mass: %.17g\n", m);
    if (kind == 0) {
        scene->radius = a / 2;
        body->I = m * a * a / 8;
        add(scene, "    shape: disc\n    radius: %.17g\n", a / 2);
    } else if (kind == 1) {
        body->I = m * a * a / 12;
        add_corner(scene, a / 2, 0);
        add_corner(scene, -a / 2, 0);
        add(scene, "    shape: rod\n    length: %.17g\n", a);
    } else if (kind == 2) {
        body->I = m * (a * a + b * b) / 12;
        for (int k = 0; k < 4; k++) add_corner(scene, (k % 3 ? a : -a) / 2, (k / 2 ? b : -b) / 2);
        add(scene, "    shape: prism\n    a: %.17g\n    b: %.17g\n", a, b);
    } else {
        int corners = 3 + (int)random_between(numbers, 0, 3.999);
        body->I = m * a * a / 4 * random_between(numbers, 0.2, 0.8);
        add(scene, "    inertia: %.17g\n    points: {", body->I);
        for (int k = 0; k < corners; k++) {
            double angle = (k + random_between(numbers, -0.3, 0.3)) * 2 * acos(-1) / corners;
            add_corner(scene, a / 2 * cos(angle), a / 2 * sin(angle));
            add(scene, "%sP%d: [%.17g, %.17g]", k > 0 ? ", " : "", k, scene->corner[k][0],
                scene->corner[k][1]);
        }
        add(scene, "}\n");
    }
}

/* How far all other corners are above the line through corner k, or on one with it. */
static double room_above(const struct scene *scene, int k, int but, const double *normal)
{
    double least = HUGE_VAL;
    for (int i = 0; i < scene->corners; i++) {
        const double *p = scene->turned[i], *o = scene->turned[k];
        if (i != k && i != but) least = fmin(least, normal[0] * (p[0] - o[0]) + normal[1] * (p[1] - o[1]));
    }
    return least;
}

/* A corner and a direction in which it is the lowest. */
static bool find_touch(struct random_numbers *numbers, const struct scene *scene, struct touch *touch)
{
    const double clear = 0.02;
    double angle = random_between(numbers, -3.2, 3.2);
    touch->normal[0] = cos(angle);
    touch->normal[1] = sin(angle);
    touch->corner = scene->corners == 0 ? -1 : (int)(random_bits(numbers) % (unsigned)scene->corners);
    return scene->corners == 0 || room_above(scene, touch->corner, -1, touch->normal) > clear;
}

/* Two corners that lie flat on one floor: the second touch is that of the other one. */
static bool find_flat(struct random_numbers *numbers, const struct scene *scene, struct touch touch[2])
{
    int k = (int)(random_bits(numbers) % (unsigned)scene->corners), next = (k + 1) % scene->corners;
    double x = scene->turned[next][0] - scene->turned[k][0], y = scene->turned[next][1] - scene->turned[k][1],
           side = scene->corners == 2 && random_chance(numbers, 0.5) ? -1 : 1, length = hypot(x, y);
    double normal[2] = {-side * y / length, side * x / length};
    for (int i = 0; i < 2; i++) {
        touch[i] = (struct touch){.corner = i == 0 ? k : next};
        memcpy(touch[i].normal, normal, sizeof normal);
    }
    return scene->corners == 2 || room_above(scene, k, next, normal) > 0;
}

static void set_arms(struct random_numbers *numbers, struct scene *scene, struct touch *touch)
{
    const double *n = touch->normal;
    for (int k = 0; k < 2; k++)
        touch->arm[0][k] = touch->corner < 0 ? -scene->radius * n[k] : scene->turned[touch->corner][k];
    bool first = touch - scene->touch < (scene->flat ? 2 : 1);
    if (random_chance(numbers, 0.65) || (first && (scene->flat || scene->grazes > 0))) return; /* a wall */
    touch->other = scene->bodies;
    touch->radius = random_between(numbers, 0.1, 0.5);
    struct body *other = &scene->body[scene->bodies++];
    double m = exp(random_between(numbers, -1.5, 1.5));
    *other = (struct body){.m = m, .radius = touch->radius, .I = m * touch->radius * touch->radius / 2};
    for (int k = 0; k < 2; k++) {
        other->q[k] = scene->body[0].q[k] + touch->arm[0][k] - touch->radius * n[k];
        touch->arm[1][k] = touch->radius * n[k];
        other->v[k] = random_between(numbers, -1, 1);
    }
    other->v[2] = random_perhaps(numbers, 0.7, -5, 5);
}

/* Of row 0, the normal, or 1, the tangent of a touch: what it is of the velocities of a body. */
static void row_of(const struct touch *touch, int row, int body, double J[3])
{
    const double *n = touch->normal, along[2] = {row == 0 ? n[0] : n[1], row == 0 ? n[1] : -n[0]};
    bool other = body > 0 && body == touch->other;
    const double *arm = touch->arm[other ? 1 : 0];
    double sign = body == 0 ? 1 : other ? -1 : 0;
    J[0] = sign * along[0];
    J[1] = sign * along[1];
    J[2] = sign * (arm[0] * along[1] - arm[1] * along[0]);
}

static double speed_of(const struct scene *scene, int touch, int row)
{
    double speed = 0;
    for (int b = 0; b < scene->bodies; b++) {
        double J[3];
        row_of(&scene->touch[touch], row, b, J);
        for (int k = 0; k < 3; k++) speed += J[k] * scene->body[b].v[k];
    }
    return speed;
}

static void fly(const struct scene *scene, double time, struct body *bodies)
{
    for (int b = 0; b < scene->bodies; b++) {
        double *q = bodies[b].q, *v = bodies[b].v;
        for (int k = 0; k < 3; k++) q[k] += time * v[k];
        if (!scene->falls) continue;
        q[1] -= g * time * time / 2;
        v[1] -= g * time;
    }
}

/* From a point to the side from corner k to the next one, as they are with the first body. */
static double apart_from_side(const struct scene *scene, const struct body *first, int k, const double *o)
{
    const double c = cos(first->q[2]), s = sin(first->q[2]), dx = o[0] - first->q[0], dy = o[1] - first->q[1],
                 x = c * dx + s * dy, y = c * dy - s * dx;
    const double *a = scene->corner[k], *b = scene->corner[(k + 1) % scene->corners],
                 side[2] = {b[0] - a[0], b[1] - a[1]};
    double share = ((x - a[0]) * side[0] + (y - a[1]) * side[1]) / (side[0] * side[0] + side[1] * side[1]);
    share = fmax(0, fmin(1, share));
    return hypot(x - a[0] - share * side[0], y - a[1] - share * side[1]);
}

/* The least gap of a corner, a side or the rim over what it touches at the blow, as things are. */
static double gap_of(const struct scene *scene, const struct touch *touch, const struct body *bodies)
{
    const struct body *first = &bodies[0], *blow = &scene->body[0];
    const double *n = touch->normal, c = cos(first->q[2]), s = sin(first->q[2]);
    double least = HUGE_VAL;
    for (int k = 0; k < scene->corners || k == 0; k++) {
        const double *corner = scene->corner[k];
        double p[2] = {first->q[0], first->q[1]}, gap;
        if (scene->corners > 0) {
            p[0] += c * corner[0] - s * corner[1];
            p[1] += s * corner[0] + c * corner[1];
        }
        if (touch->other > 0) {
            const double *o = bodies[touch->other].q;
            gap = scene->corners > 0 ? apart_from_side(scene, first, k, o) : hypot(p[0] - o[0], p[1] - o[1]);
            gap -= touch->radius + scene->radius;
        } else {
            gap = n[0] * (p[0] - blow->q[0] - touch->arm[0][0]) +
                  n[1] * (p[1] - blow->q[1] - touch->arm[0][1]) - scene->radius;
        }
        least = fmin(least, gap);
    }
    return least;
}

/* All close, and none has touched on the way. */
static bool comes_from_afar(const struct scene *scene)
{
    enum { looks = 100 };
    const double least = 0.05;
    for (int i = scene->grazes; i < scene->touches; i++)
        if (speed_of(scene, i, 0) > -least) return false;
    for (int look = 1; look <= looks; look++) {
        struct body bodies[most_bodies];
        memcpy(bodies, scene->body, sizeof bodies);
        fly(scene, -scene->when * look / looks, bodies);
        for (int i = scene->grazes; i < scene->touches; i++)
            if (gap_of(scene, &scene->touch[i], bodies) <= 0) return false;
    }
    return true;
}

static void draw_laws(struct random_numbers *numbers, struct scene *scene)
{
    bool same = random_chance(numbers, 0.5);
    for (int i = 0; i < scene->touches; i++) {
        struct touch *touch = &scene->touch[i];
        double kind = random_between(numbers, 0, 1), e = random_between(numbers, 0.05, 0.95);
        touch->e = kind < 0.2 ? 0 : kind > 0.9 ? 1 : e;
        touch->mu = random_perhaps(numbers, 0.8, 0, 1);
        touch->law = (enum law_by_steps)(random_bits(numbers) % 4);
        bool other_corner = scene->flat && i == 1;
        if (i > 0 && (same || other_corner)) touch->law = scene->touch[0].law;
        if (!other_corner) continue;
        touch->e = scene->touch[0].e;
        touch->mu = scene->touch[0].mu;
    }
}

static bool draw_touches(struct random_numbers *numbers, struct scene *scene)
{
    struct body *body = &scene->body[0];
    scene->flat = scene->corners > 1 && random_chance(numbers, 0.25);
    bool lasts = (scene->flat || scene->corners == 0) && !scene->falls && random_chance(numbers, 0.4);
    scene->grazes = !lasts ? 0 : scene->flat ? 2 : 1;
    scene->touches = random_chance(numbers, 0.8) && !(lasts && scene->flat) ? 2 : 3;
    body->q[0] = random_between(numbers, -1, 1);
    body->q[1] = random_between(numbers, -1, 1);
    body->q[2] = random_between(numbers, -3, 3);
    double c = cos(body->q[2]), s = sin(body->q[2]);
    for (int k = 0; k < scene->corners; k++) {
        scene->turned[k][0] = c * scene->corner[k][0] - s * scene->corner[k][1];
        scene->turned[k][1] = s * scene->corner[k][0] + c * scene->corner[k][1];
    }
    for (int k = 0; k < 2; k++) body->v[k] = random_between(numbers, -3, 3);
    body->v[2] = random_perhaps(numbers, lasts && scene->flat ? 0 : 0.7, -6, 6);
    if (scene->flat && !find_flat(numbers, scene, scene->touch)) return false;
    for (int i = 0; i < scene->touches; i++) {
        struct touch *touch = &scene->touch[i];
        if (!(scene->flat && i < 2) && !find_touch(numbers, scene, touch)) return false;
        set_arms(numbers, scene, touch);
    }
    const double *n = scene->touch[0].normal, closing = n[0] * body->v[0] + n[1] * body->v[1];
    for (int k = 0; k < 2 && lasts; k++) body->v[k] -= closing * n[k];
    return comes_from_afar(scene);
}

/* ---- the model */

static void write_start(struct scene *scene, const struct body *body)
{
    add(scene,
        "    motion: planar\n    initial: {x: %.17g, y: %.17g, theta: %.17g, vx: %.17g, vy: %.17g, omega: "
        "%.17g}\n    forces: [%s]\n",
        body->q[0], body->q[1], body->q[2], body->v[0], body->v[1], body->v[2],
        scene->falls ? "gravity" : "applied: {value: 0, angle: 0}");
}

static void write_ground(struct scene *scene)
{
    bool any = false;
    for (int i = 0; i < scene->touches; i++) {
        const struct touch *touch = &scene->touch[i];
        if (touch->other > 0 || (scene->flat && i == 1)) continue;
        const double *q = scene->body[0].q;
        add(scene, "%s    wall_%d: {through: [%.17g, %.17g], along: %.17g}\n",
            any ? "" : "ground:\n  lines:\n", i, q[0] + touch->arm[0][0], q[1] + touch->arm[0][1],
            atan2(-touch->normal[0], touch->normal[1]));
        any = true;
    }
}

static void write_contacts(struct scene *scene)
{
    static const char *const laws[] = {"stronge", "poisson", "newton", "moreau"};
    add(scene, "contacts:\n");
    for (int i = 0; i < scene->touches; i++) {
        const struct touch *touch = &scene->touch[i];
        bool named = strcmp(scene->kind, "polygon") == 0;
        char point[16] = "", other[24];
        if (scene->flat && i == 1 && !named) continue;
        if (named) snprintf(point, sizeof point, ".P%d", touch->corner);
        if (touch->other > 0)
            snprintf(other, sizeof other, "d%d", touch->other);
        else
            snprintf(other, sizeof other, "ground.wall_%d", scene->flat && i == 1 ? 0 : i);
        /* A rod that lies on a wall is on neither side of it by itself. */
        add(scene, "  - {between: [b%s, %s], restitution: %.17g, static: %.17g, law: %s%s}\n", point, other,
            touch->e, touch->mu, laws[touch->law], touch->other > 0 ? "" : ", side: left");
    }
}

static void draw_scene(uint64_t seed, struct scene *scene)
{
    enum { most_draws = 10000 };
    struct random_numbers numbers = {seed};
    for (int draw = 0; draw < most_draws; draw++) {
        *scene = (struct scene){.bodies = 1, .when = random_between(&numbers, 0.02, 0.1)};
        scene->body[0].m = exp(random_between(&numbers, -1, 1));
        scene->falls = random_chance(&numbers, 0.5);
        scene->in_turn = random_chance(&numbers, 0.5);
        struct random_numbers first = numbers;
        draw_first(&numbers, scene);
        if (!draw_touches(&numbers, scene)) continue;
        draw_laws(&numbers, scene);
        struct body start[most_bodies];
        memcpy(start, scene->body, sizeof start);
        fly(scene, -scene->when, start);
        scene->length = scene->corners = 0;
        add(scene, "fbd: 1\ngravity: %g\n", g);
        write_ground(scene);
        add(scene, "bodies:\n");
        draw_first(&first, scene);
        for (int b = 0; b < scene->bodies; b++) {
            if (b > 0)
                add(scene, "  d%d:\n    shape: disc\n    radius: %.17g\n    mass: %.17g\n", b,
                    scene->body[b].radius, scene->body[b].m);
            write_start(scene, &start[b]);
        }
        write_contacts(scene);
        return;
    }
    fail_msg("no scene from seed %llu", (unsigned long long)seed);
}

/* ---- the same by sets */

static struct points_by_sets points_of(const struct scene *scene, double *u)
{
    const double none = 1e-13;
    struct points_by_sets points = {.count = scene->touches, .in_turn = scene->in_turn};
    for (int i = 0; i < 2 * scene->touches; i++) {
        const struct touch *touch = &scene->touch[i / 2];
        u[i] = speed_of(scene, i / 2, i % 2);
        if (fabs(u[i]) < none) u[i] = 0;
        points.e[i / 2] = touch->e;
        points.mu[i / 2] = touch->mu;
        points.law[i / 2] = touch->law;
        for (int j = 0; j < 2 * scene->touches; j++)
            for (int b = 0; b < scene->bodies; b++) {
                double a[3], c[3];
                row_of(touch, i % 2, b, a);
                row_of(&scene->touch[j / 2], j % 2, b, c);
                points.W[i][j] +=
                    (a[0] * c[0] + a[1] * c[1]) / scene->body[b].m + a[2] * c[2] / scene->body[b].I;
            }
    }
    return points;
}

static void push(struct scene *scene, const double *P)
{
    for (int i = 0; i < 2 * scene->touches; i++)
        for (int b = 0; b < scene->bodies; b++) {
            struct body *body = &scene->body[b];
            double J[3];
            row_of(&scene->touch[i / 2], i % 2, b, J);
            for (int k = 0; k < 3; k++) body->v[k] += P[i] * J[k] / (k < 2 ? body->m : body->I);
        }
}

/* ---- both */

/* Kinetic energy, and momentum in x, y and about the origin. */
static void sums_of(const struct scene *scene, double sums[4])
{
    memset(sums, 0, 4 * sizeof *sums);
    for (int b = 0; b < scene->bodies; b++) {
        const struct body *body = &scene->body[b];
        const double *q = body->q, *v = body->v;
        sums[0] += body->m * (v[0] * v[0] + v[1] * v[1]) / 2 + body->I * v[2] * v[2] / 2;
        sums[1] += body->m * v[0];
        sums[2] += body->m * v[1];
        sums[3] += body->m * (q[0] * v[1] - q[1] * v[0]) + body->I * v[2];
    }
}

static void read_rates(const struct scene *scene, const struct trial *trial, struct body *bodies)
{
    static const char *const names[] = {"vx", "vy", "omega"};
    for (int b = 0; b < scene->bodies; b++)
        for (int k = 0; k < 3; k++) {
            char name[20];
            if (b == 0)
                snprintf(name, sizeof name, "b.%s", names[k]);
            else
                snprintf(name, sizeof name, "d%d.%s", b, names[k]);
            bodies[b].v[k] = trial_get(trial, name);
        }
}

static bool complain(bool fact, const char *what, double value)
{
    if (!fact) printf("# %s: %.9g\n", what, value);
    return fact;
}

/* What holds of any law, between before and after. */
static bool keeps_laws(const struct scene *before, const struct scene *after, double size)
{
    const double rounding = 1e-8; /* as what gravity does in the instant */
    double was[4], is[4];
    bool holds = true, loses = true, free = true;
    sums_of(before, was);
    sums_of(after, is);
    for (int i = 0; i < before->touches; i++) {
        double u = speed_of(after, i, 0);
        loses &= before->touch[i].law <= steps_poisson;
        free &= before->touch[i].other > 0;
        holds &= complain(u >= -10 * rounding * size, "goes on into what it touches", u);
    }
    if (loses) holds &= complain(is[0] <= was[0] * (1 + 10 * rounding), "makes energy", is[0] - was[0]);
    for (int k = 1; free && k < 4; k++)
        holds &= complain(fabs(is[k] - was[k]) <= rounding * sqrt(was[0]) * 10, "changes momentum",
                          is[k] - was[k]);
    return holds;
}

static double size_of(const struct scene *scene)
{
    double size = 0;
    for (int i = 0; i < 2 * scene->touches; i++) size = fmax(size, fabs(speed_of(scene, i / 2, i % 2)));
    return size;
}

/* Bounces that nobody sees end at once. */
static bool has_low_bounce(const struct scene *scene)
{
    const double low = 1e-3, none = 1e-9;
    for (int i = 0; i < scene->touches; i++) {
        double u = speed_of(scene, i, 0);
        if (u > none && u < low) return true;
    }
    return false;
}

static bool compare(const struct scene *expected, const struct scene *found, double size)
{
    const double near = 1e-7;
    double worst = 0;
    for (int b = 0; b < expected->bodies; b++)
        for (int k = 0; k < 3; k++) {
            double off = fabs(expected->body[b].v[k] - found->body[b].v[k]);
            if (!(off <= worst)) worst = off;
        }
    double fallen = expected->falls ? 100 * g * instant : 0;
    bool same = complain(worst <= near * size + fallen, "off impacts by sets by", worst);
    for (int b = 0; b < expected->bodies && !same; b++)
        for (int k = 0; k < 3; k++)
            printf("# body %d: %.9g, by sets %.9g\n", b, found->body[b].v[k], expected->body[b].v[k]);
    return same;
}

static void show(const struct scene *scene, struct trial *trial)
{
    if (!getenv("FBD_BLOWS_SHOW")) return;
    puts(scene->text);
    printf("# at the blow, %.12g:\n", scene->when);
    for (int i = 0; i < scene->touches; i++)
        printf("# touch %d closes at %.9g, slips at %.9g\n", i, speed_of(scene, i, 0), speed_of(scene, i, 1));
    for (size_t k = 0; k < fbd_simulation_event_count(trial->simulation); k++) {
        fbd_event event = fbd_simulation_event(trial->simulation, k);
        printf("# run: t = %.12g: %s\n", event.t, event.detail);
    }
}

/* On until the state there is known. */
static bool go_to(struct trial *trial, double t)
{
    double from, to = -HUGE_VAL;
    while (to < t && trial->outcome == FBD_GOING) {
        trial->outcome = fbd_simulation_advance(trial->simulation);
        fbd_simulation_interval(trial->simulation, &from, &to);
    }
    return fbd_simulation_state(trial->simulation, t, trial->state);
}

/* Two corners that close as fast, one after the other: either may be the first. */
static bool is_tie(const struct scene *scene)
{
    return scene->flat && scene->in_turn && fabs(speed_of(scene, 0, 0) - speed_of(scene, 1, 0)) < 1e-9;
}

/* The same by the law that always has a solution. */
static void write_by_stronge(const struct scene *scene, struct scene *other)
{
    static const char *const laws[] = {"newton", "moreau"};
    *other = *scene;
    other->length = 0;
    for (const char *at = scene->text; *at;) {
        bool law = strncmp(at, laws[0], 6) == 0 || strncmp(at, laws[1], 6) == 0;
        add(other, law ? "%.0sstronge" : "%.1s", at);
        at += law ? 6 : 1;
    }
}

enum end { done, unsolvable, lost, endless, failed };

static enum end end_of(const struct trial *trial)
{
    const char *reason = fbd_simulation_reason(trial->simulation);
    if (trial->outcome == FBD_DONE) return done;
    if (strstr(reason, "have no solution by their law")) return unsolvable;
    if (strstr(reason, "rounding takes what")) return lost;
    if (strstr(reason, "without end: try `simulate: {impacts: simultaneous}`")) return endless;
    printf("# %s\n", reason);
    return failed;
}

/* The velocities right after the blow, and how the run ends. */
static enum end run_scene(const struct scene *scene, struct scene *found, bool *struck)
{
    struct trial trial = trial_parse(scene->text);
    trial_start(&trial, NULL);
    *struck = go_to(&trial, scene->when + instant);
    if (*struck) read_rates(scene, &trial, found->body);
    while (trial.outcome == FBD_GOING) trial.outcome = fbd_simulation_advance(trial.simulation);
    show(scene, &trial);
    enum end end = end_of(&trial);
    trial_close(&trial);
    return end;
}

/* Laws of velocities may contradict each other, and impacts one after the other go on for ever, where there is no one answer
 * by sets; impulses that are hundreds of times as large as what would stop a point are refused where there is one. */
static bool may_end(const struct scene *scene, enum end end, bool struck, bool known)
{
    bool by_velocity = false;
    for (int i = 0; i < scene->touches; i++) by_velocity |= scene->touch[i].law > steps_poisson;
    if (end == unsolvable) return by_velocity && (struck || !known);
    if (end == endless) return scene->in_turn && (struck || !known);
    return end == done || end == lost;
}

static bool agrees(uint64_t seed, bool *unknown)
{
    const double on = 0.3;
    static struct scene scene, after, found;
    double u[sets_rows] = {0}, P[sets_rows] = {0};
    draw_scene(seed, &scene);
    add(&scene, "simulate: {until: %.17g, tolerance: 1e-11, impacts: %s}\n", scene.when + on,
        scene.in_turn ? "propagate" : "simultaneous");
    after = found = scene;
    struct points_by_sets points = points_of(&scene, u);
    double size = size_of(&scene);
    bool known = impacts_by_sets(&points, u, P) && !is_tie(&scene), struck;
    if (known) push(&after, P);
    size = fmax(size, size_of(&after));
    enum end end = run_scene(&scene, &found, &struck);
    bool right = complain(may_end(&scene, end, struck, known), "ends by", end);
    if (struck) right &= keeps_laws(&scene, &found, size);
    if (struck && known && !(scene.falls && has_low_bounce(&after))) right &= compare(&after, &found, size);
    *unknown = !known || !struck;
    if (end == unsolvable && !struck) { /* as it says */
        write_by_stronge(&scene, &after);
        end = run_scene(&after, &found, &struck);
        right &= complain(struck, "by stronge ends by", end) && keeps_laws(&scene, &found, size_of(&scene));
    }
    if (!right)
        printf("# seed %llu%s\n%s\n", (unsigned long long)seed, known ? "" : ", no one answer", scene.text);
    return right;
}

static void impacts_by_sets_say_the_same(void **unused)
{
    (void)unused;
    moreau_compare("FBD_BLOWS", 600, 5, agrees);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(impacts_by_sets_say_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
