/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "blow_scenes.h"
#include "random_numbers.h"

/* ---- draws */

static void add_corner(struct blow_scene *scene, double x, double y)
{
    scene->corner[scene->corners][0] = x;
    scene->corner[scene->corners++][1] = y;
}

static void draw_first(struct random_numbers *numbers, struct blow_scene *scene)
{
    static const char *const kinds[] = {"disc", "rod", "prism", "polygon"};
    struct blow_body *body = &scene->body[0];
    double a = random_between(numbers, 0.2, 1), b = random_between(numbers, 0.1, 1), m = body->m;
    int kind = (int)(random_bits(numbers) % 4);
    scene->kind = kinds[kind];
    add(&scene->text, "  b:\n    mass: %.17g\n", m);
    if (kind == 0) {
        scene->radius = a / 2;
        body->I = m * a * a / 8;
        add(&scene->text, "    shape: disc\n    radius: %.17g\n", a / 2);
    } else if (kind == 1) {
        body->I = m * a * a / 12;
        add_corner(scene, a / 2, 0);
        add_corner(scene, -a / 2, 0);
        add(&scene->text, "    shape: rod\n    length: %.17g\n", a);
    } else if (kind == 2) {
        body->I = m * (a * a + b * b) / 12;
        for (int k = 0; k < 4; k++) add_corner(scene, (k % 3 ? a : -a) / 2, (k / 2 ? b : -b) / 2);
        add(&scene->text, "    shape: prism\n    a: %.17g\n    b: %.17g\n", a, b);
    } else {
        int corners = 3 + (int)random_between(numbers, 0, 3.999);
        body->I = m * a * a / 4 * random_between(numbers, 0.2, 0.8);
        add(&scene->text, "    inertia: %.17g\n    points: {", body->I);
        for (int k = 0; k < corners; k++) {
            double angle = (k + random_between(numbers, -0.3, 0.3)) * 2 * acos(-1) / corners;
            add_corner(scene, a / 2 * cos(angle), a / 2 * sin(angle));
            add(&scene->text, "%sP%d: [%.17g, %.17g]", k > 0 ? ", " : "", k, scene->corner[k][0],
                scene->corner[k][1]);
        }
        add(&scene->text, "}\n");
    }
}

/* How far all other corners are above the line through corner k, or on one with it. */
static double room_above(const struct blow_scene *scene, int k, int but, const double *normal)
{
    double least = HUGE_VAL;
    for (int i = 0; i < scene->corners; i++) {
        const double *p = scene->turned[i], *o = scene->turned[k];
        if (i != k && i != but) least = fmin(least, normal[0] * (p[0] - o[0]) + normal[1] * (p[1] - o[1]));
    }
    return least;
}

/* A corner and a direction in which it is the lowest. */
static bool find_touch(struct random_numbers *numbers, const struct blow_scene *scene,
                       struct blow_touch *touch)
{
    const double clear = 0.02;
    double angle = random_between(numbers, -3.2, 3.2);
    touch->normal[0] = cos(angle);
    touch->normal[1] = sin(angle);
    touch->corner = scene->corners == 0 ? -1 : (int)(random_bits(numbers) % (unsigned)scene->corners);
    return scene->corners == 0 || room_above(scene, touch->corner, -1, touch->normal) > clear;
}

/* Two corners that lie flat on one floor: the second touch is that of the other one. */
static bool find_flat(struct random_numbers *numbers, const struct blow_scene *scene,
                      struct blow_touch touch[2])
{
    int k = (int)(random_bits(numbers) % (unsigned)scene->corners), next = (k + 1) % scene->corners;
    double x = scene->turned[next][0] - scene->turned[k][0], y = scene->turned[next][1] - scene->turned[k][1],
           side = scene->corners == 2 && random_chance(numbers, 0.5) ? -1 : 1, length = hypot(x, y);
    double normal[2] = {-side * y / length, side * x / length};
    for (int i = 0; i < 2; i++) {
        touch[i] = (struct blow_touch){.corner = i == 0 ? k : next};
        memcpy(touch[i].normal, normal, sizeof normal);
    }
    return scene->corners == 2 || room_above(scene, k, next, normal) > 0;
}

static void set_arms(struct random_numbers *numbers, struct blow_scene *scene, struct blow_touch *touch)
{
    const double *n = touch->normal;
    for (int k = 0; k < 2; k++)
        touch->arm[0][k] = touch->corner < 0 ? -scene->radius * n[k] : scene->turned[touch->corner][k];
    bool first = touch - scene->touch < (scene->flat ? 2 : 1);
    if (random_chance(numbers, 0.65) || (first && (scene->flat || scene->grazes > 0))) return; /* a wall */
    touch->other = scene->bodies;
    touch->radius = random_between(numbers, 0.1, 0.5);
    struct blow_body *other = &scene->body[scene->bodies++];
    double m = exp(random_between(numbers, -1.5, 1.5));
    *other = (struct blow_body){.m = m, .radius = touch->radius, .I = m * touch->radius * touch->radius / 2};
    for (int k = 0; k < 2; k++) {
        other->q[k] = scene->body[0].q[k] + touch->arm[0][k] - touch->radius * n[k];
        touch->arm[1][k] = touch->radius * n[k];
        other->v[k] = random_between(numbers, -1, 1);
    }
    other->v[2] = random_perhaps(numbers, 0.7, -5, 5);
}

void blow_row(const struct blow_touch *touch, int row, int body, double J[3])
{
    const double *n = touch->normal, along[2] = {row == 0 ? n[0] : n[1], row == 0 ? n[1] : -n[0]};
    bool other = body > 0 && body == touch->other;
    const double *arm = touch->arm[other ? 1 : 0];
    double sign = body == 0 ? 1 : other ? -1 : 0;
    J[0] = sign * along[0];
    J[1] = sign * along[1];
    J[2] = sign * (arm[0] * along[1] - arm[1] * along[0]);
}

double blow_speed(const struct blow_scene *scene, int touch, int row)
{
    double speed = 0;
    for (int b = 0; b < scene->bodies; b++) {
        double J[3];
        blow_row(&scene->touch[touch], row, b, J);
        for (int k = 0; k < 3; k++) speed += J[k] * scene->body[b].v[k];
    }
    return speed;
}

static void fly(const struct blow_scene *scene, double time, struct blow_body *bodies)
{
    for (int b = 0; b < scene->bodies; b++) {
        double *q = bodies[b].q, *v = bodies[b].v;
        for (int k = 0; k < 3; k++) q[k] += time * v[k];
        if (!scene->falls) continue;
        q[1] -= blow_gravity * time * time / 2;
        v[1] -= blow_gravity * time;
    }
}

/* From a point to the side from corner k to the next one, as they are with the first body. */
static double apart_from_side(const struct blow_scene *scene, const struct blow_body *first, int k,
                              const double *o)
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
static double gap_of(const struct blow_scene *scene, const struct blow_touch *touch,
                     const struct blow_body *bodies)
{
    const struct blow_body *first = &bodies[0], *blow = &scene->body[0];
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
static bool comes_from_afar(const struct blow_scene *scene)
{
    enum { looks = 100 };
    const double least = 0.05;
    for (int i = scene->grazes; i < scene->touches; i++)
        if (blow_speed(scene, i, 0) > -least) return false;
    for (int look = 1; look <= looks; look++) {
        struct blow_body bodies[most_bodies];
        memcpy(bodies, scene->body, sizeof bodies);
        fly(scene, -scene->when * look / looks, bodies);
        for (int i = scene->grazes; i < scene->touches; i++)
            if (gap_of(scene, &scene->touch[i], bodies) <= 0) return false;
    }
    return true;
}

static void draw_laws(struct random_numbers *numbers, struct blow_scene *scene)
{
    bool same = random_chance(numbers, 0.5);
    for (int i = 0; i < scene->touches; i++) {
        struct blow_touch *touch = &scene->touch[i];
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

static bool draw_touches(struct random_numbers *numbers, struct blow_scene *scene)
{
    struct blow_body *body = &scene->body[0];
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
        struct blow_touch *touch = &scene->touch[i];
        if (!(scene->flat && i < 2) && !find_touch(numbers, scene, touch)) return false;
        set_arms(numbers, scene, touch);
    }
    const double *n = scene->touch[0].normal, closing = n[0] * body->v[0] + n[1] * body->v[1];
    for (int k = 0; k < 2 && lasts; k++) body->v[k] -= closing * n[k];
    return comes_from_afar(scene);
}

/* ---- the model */

static void write_start(struct blow_scene *scene, const struct blow_body *body)
{
    add(&scene->text,
        "    motion: planar\n    initial: {x: %.17g, y: %.17g, theta: %.17g, vx: %.17g, vy: %.17g, omega: "
        "%.17g}\n    forces: [%s]\n",
        body->q[0], body->q[1], body->q[2], body->v[0], body->v[1], body->v[2],
        scene->falls ? "gravity" : "applied: {value: 0, angle: 0}");
}

static void write_ground(struct blow_scene *scene)
{
    bool any = false;
    for (int i = 0; i < scene->touches; i++) {
        const struct blow_touch *touch = &scene->touch[i];
        if (touch->other > 0 || (scene->flat && i == 1)) continue;
        const double *q = scene->body[0].q;
        add(&scene->text, "%s    wall_%d: {through: [%.17g, %.17g], along: %.17g}\n",
            any ? "" : "ground:\n  lines:\n", i, q[0] + touch->arm[0][0], q[1] + touch->arm[0][1],
            atan2(-touch->normal[0], touch->normal[1]));
        any = true;
    }
}

static void write_contacts(struct blow_scene *scene)
{
    static const char *const laws[] = {"stronge", "poisson", "newton", "moreau"};
    add(&scene->text, "contacts:\n");
    for (int i = 0; i < scene->touches; i++) {
        const struct blow_touch *touch = &scene->touch[i];
        bool named = strcmp(scene->kind, "polygon") == 0;
        char point[16] = "", other[24];
        if (scene->flat && i == 1 && !named) continue;
        if (named) snprintf(point, sizeof point, ".P%d", touch->corner);
        if (touch->other > 0)
            snprintf(other, sizeof other, "d%d", touch->other);
        else
            snprintf(other, sizeof other, "ground.wall_%d", scene->flat && i == 1 ? 0 : i);
        /* A rod that lies on a wall is on neither side of it by itself. */
        add(&scene->text, "  - {between: [b%s, %s], restitution: %.17g, static: %.17g, law: %s%s}\n", point,
            other, touch->e, touch->mu, laws[touch->law], touch->other > 0 ? "" : ", side: left");
    }
}

void blow_draw(uint64_t seed, struct blow_scene *scene)
{
    enum { most_draws = 10000 };
    struct random_numbers numbers = {seed};
    for (int draw = 0; draw < most_draws; draw++) {
        *scene = (struct blow_scene){.bodies = 1, .when = random_between(&numbers, 0.02, 0.1)};
        scene->body[0].m = exp(random_between(&numbers, -1, 1));
        scene->falls = random_chance(&numbers, 0.5);
        scene->in_turn = random_chance(&numbers, 0.5);
        struct random_numbers first = numbers;
        draw_first(&numbers, scene);
        if (!draw_touches(&numbers, scene)) continue;
        draw_laws(&numbers, scene);
        struct blow_body start[most_bodies];
        memcpy(start, scene->body, sizeof start);
        fly(scene, -scene->when, start);
        scene->text.length = scene->corners = 0;
        add(&scene->text, "fbd: 1\ngravity: %g\n", blow_gravity);
        write_ground(scene);
        add(&scene->text, "bodies:\n");
        draw_first(&first, scene);
        for (int b = 0; b < scene->bodies; b++) {
            if (b > 0)
                add(&scene->text, "  d%d:\n    shape: disc\n    radius: %.17g\n    mass: %.17g\n", b,
                    scene->body[b].radius, scene->body[b].m);
            write_start(scene, &start[b]);
        }
        write_contacts(scene);
        return;
    }
    fail_msg("no scene from seed %llu", (unsigned long long)seed);
}
