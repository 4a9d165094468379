/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random scenes in the plane, with stops, ropes, contacts and dry friction, against a time stepping that knows no events
 * (moreau.h): links of a chain, discs on a slope, weights on slides over ropes, slides on slides. FBD_PLANE=1000 tries
 * so many of each kind, FBD_PLANE_KIND=links of one, FBD_PLANE_SEED=17 one scene, with its model.
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

enum { room = 20000, most_bodies = 3 };
static const double g = 10;

/* ---- text of a model */

struct text {
    int length;
    char all[room];
};

__attribute__((format(printf, 2, 3))) static void add(struct text *text, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    text->length += vsnprintf(text->all + text->length, (size_t)(room - text->length), format, values);
    va_end(values);
    assert_true(text->length < room);
}

/* ---- what acts */

struct push { /* A sin(w t + phase) + B */
    double A, w, phase, B;
};

static bool chance(struct random_numbers *numbers, double share)
{
    return random_between(numbers, 0, 1) < share;
}

static struct push draw_push(struct random_numbers *numbers, double size)
{
    return (struct push){chance(numbers, 0.6) ? random_between(numbers, 0, size) : 0,
                         random_between(numbers, 0.5, 12), random_between(numbers, 0, 6),
                         chance(numbers, 0.5) ? random_between(numbers, -size / 2, size / 2) : 0};
}

static double push_at(const struct push *push, double t)
{
    return push->A * sin(push->w * t + push->phase) + push->B;
}

static void add_push(struct text *text, const struct push *push)
{
    add(text, "\"%.17g*sin(%.17g*t + %.17g) + %.17g\"", push->A, push->w, push->phase, push->B);
}

struct body { /* of all kinds; lengths in m, masses in kg */
    double m, r, I;
    double q[3], v[3]; /* start */
    struct push push[3];
    bool has_min, has_max;
    double min, max, e;
    double spring, neutral, damper;
    double rub, rub_speed; /* a bearing [N m, rad/s], or a coefficient and a speed of the surface */
    double through[2], along;
    int on;
    bool point; /* a particle */
};

struct rope {
    int body, other; /* -1: none */
    double at[2], length;
};

struct scene {
    int count, ropes, kind;
    struct body body[most_bodies];
    struct rope rope[4];
    double slope, mu, e, mu_pair, e_pair, wall[2];
    bool has_wall[2], pairs;
    double until;
};

static struct moreau_row *row_of(struct moreau_rows *rows, enum moreau_kind kind)
{
    struct moreau_row *row = &rows->row[rows->count++];
    *row = (struct moreau_row){.kind = kind, .normal = -1};
    return row;
}

/* Laws of restitution differ where an impact is not of one point alone, and without friction: `plastic` then. */
static void draw_stops(struct random_numbers *numbers, struct body *body, double size, bool plastic)
{
    double x = body->q[0], *v = &body->v[0];
    body->has_min = chance(numbers, 0.4);
    body->min = x - (chance(numbers, 0.25) ? 0 : random_between(numbers, 0.01, size));
    body->has_max = chance(numbers, 0.4);
    body->max = x + (body->min < x && chance(numbers, 0.25) ? 0 : random_between(numbers, 0.01, size));
    body->e = plastic ? 0 : random_between(numbers, 0, 0.9);
    if ((body->has_min && body->min == x && *v < 0) || (body->has_max && body->max == x && *v > 0)) *v = -*v;
}

static void add_stops(struct text *text, const struct body *body)
{
    if (body->has_min) add(text, ", min: %.17g", body->min);
    if (body->has_max) add(text, ", max: %.17g", body->max);
    if (body->has_min || body->has_max) add(text, ", restitution: %.17g", body->e);
}

/* ---- links: one pendulum, or one on another. q are the angles in the world. */

static double length_of(const struct body *link)
{
    return link->r;
}

static void draw_links(struct random_numbers *numbers, struct scene *scene)
{
    scene->count = chance(numbers, 0.35) ? 1 : 2;
    bool plastic = scene->count == 2 || chance(numbers, 0.5);
    for (int i = 0; i < scene->count; i++) {
        struct body *link = &scene->body[i];
        link->m = exp(random_between(numbers, -1, 1));
        link->r = random_between(numbers, 0.3, 1);
        double size = link->m * g * link->r;
        link->q[0] = i ? random_between(numbers, -2, 2) : random_between(numbers, -3.1, 0.5);
        link->v[0] = chance(numbers, 0.2) ? 0 : random_between(numbers, -3, 3);
        draw_stops(numbers, link, 0.8, plastic);
        link->push[0] = draw_push(numbers, size);
        link->spring = chance(numbers, 0.3) ? random_between(numbers, 0, 3 * size) : 0;
        link->neutral = random_between(numbers, -1, 1);
        link->damper = chance(numbers, 0.3) ? random_between(numbers, 0, 0.3 * size) : 0;
        link->rub = chance(numbers, 0.6) ? random_between(numbers, 0.02, 0.6) * size : 0;
        link->rub_speed = chance(numbers, 0.2) ? random_between(numbers, -1, 1) : 0;
    }
    scene->ropes = chance(numbers, 0.3);
    if (scene->ropes) {
        struct rope *rope = &scene->rope[0];
        double x = 0, y = 0, angle = 0;
        for (int i = 0; i < scene->count; i++) {
            angle += scene->body[i].q[0];
            x += scene->body[i].r * cos(angle);
            y += scene->body[i].r * sin(angle);
        }
        rope->body = scene->count - 1;
        rope->at[0] = random_between(numbers, -2, 2);
        rope->at[1] = random_between(numbers, 0.5, 2);
        rope->length = hypot(x - rope->at[0], y - rope->at[1]) + random_between(numbers, 0.01, 0.4);
    }
}

static void write_links(const struct scene *scene, struct text *text)
{
    if (scene->ropes)
        add(text, "ground: {points: {A: [%.17g, %.17g]}}\n", scene->rope[0].at[0], scene->rope[0].at[1]);
    add(text, "bodies:\n");
    for (int i = 0; i < scene->count; i++) {
        const struct body *link = &scene->body[i];
        add(text, "  b%d:\n    shape: rod\n    mass: %.17g\n    from: [0, 0]\n    to: [%.17g, 0]\n", i,
            link->m, link->r);
        add(text, "    motion: {pivot: {%s", i ? "on: b0, at: right" : "at: [0, 0]");
        add_stops(text, link);
        add(text, "}}\n    initial: {theta: %.17g, omega: %.17g}\n    forces: [gravity]\n    moments:\n",
            link->q[0], link->v[0]);
        add(text, "      - applied: {name: push, value: ");
        add_push(text, &link->push[0]);
        add(text, "}\n");
        if (link->spring > 0)
            add(text, "      - spring: {stiffness: %.17g, neutral: %.17g}\n", link->spring, link->neutral);
        if (link->damper > 0) add(text, "      - damper: {coefficient: %.17g}\n", link->damper);
        if (link->rub > 0)
            add(text, "      - friction: {coefficient: %.17g, surface_speed: %.17g}\n", link->rub,
                link->rub_speed);
    }
    if (scene->ropes)
        add(text, "couplings:\n  - rope: {through: [ground.A, b%d.right], length: %.17g}\n", scene->count - 1,
            scene->rope[0].length);
}

static void forces_links(const void *context, double t, const double *q, const double *v, double *f)
{
    const struct scene *scene = context;
    const struct body *a = &scene->body[0], *b = &scene->body[1];
    bool two = scene->count == 2;
    f[0] = -(a->m / 2 + (two ? b->m : 0)) * g * a->r * cos(q[0]);
    if (two) {
        double c = b->m * length_of(a) * length_of(b) / 2 * sin(q[0] - q[1]);
        f[0] -= c * v[1] * v[1];
        f[1] = -b->m * g * b->r / 2 * cos(q[1]) + c * v[0] * v[0];
    }
    for (int i = 0; i < scene->count; i++) {
        const struct body *link = &scene->body[i];
        double angle = i ? q[1] - q[0] : q[0], rate = i ? v[1] - v[0] : v[0];
        double joint = -link->spring * (angle - link->neutral) - link->damper * rate;
        f[i] += push_at(&link->push[0], t) + joint;
        if (i) f[0] -= joint;
    }
}

static void solve_links(const void *context, const double *q, double *b)
{
    const struct scene *scene = context;
    const struct body *one = &scene->body[0], *two = &scene->body[1];
    double A = one->m * one->r * one->r / 3;
    if (scene->count == 1) {
        b[0] /= A;
        return;
    }
    A += two->m * one->r * one->r;
    double B = two->m * one->r * two->r / 2 * cos(q[0] - q[1]), C = two->m * two->r * two->r / 3,
           det = A * C - B * B, x = b[0];
    b[0] = (C * x - B * b[1]) / det;
    b[1] = (A * b[1] - B * x) / det;
}

static void rows_links(const void *context, double t, const double *q, struct moreau_rows *rows)
{
    const struct scene *scene = context;
    (void)t;
    for (int i = 0; i < scene->count; i++) {
        const struct body *link = &scene->body[i];
        double angle = i ? q[1] - q[0] : q[0];
        for (int side = 0; side < 3; side++) {
            if (side == 0 && link->rub == 0) continue;
            if (side == 1 && !(link->has_min && angle <= link->min)) continue;
            if (side == 2 && !(link->has_max && angle >= link->max)) continue;
            struct moreau_row *row = row_of(rows, side ? moreau_gap : moreau_rub);
            row->w[i] = side == 2 ? -1 : 1;
            if (i) row->w[0] = -row->w[1];
            row->e = link->e;
            row->most = link->rub;
            row->aim = link->rub_speed;
        }
    }
    if (scene->ropes == 0) return;
    const struct rope *rope = &scene->rope[0];
    double dx = -rope->at[0], dy = -rope->at[1];
    for (int i = 0; i < scene->count; i++) {
        dx += scene->body[i].r * cos(q[i]);
        dy += scene->body[i].r * sin(q[i]);
    }
    double now = hypot(dx, dy);
    if (now < rope->length) return;
    struct moreau_row *row = row_of(rows, moreau_gap);
    for (int i = 0; i < scene->count; i++)
        row->w[i] = (dx * sin(q[i]) - dy * cos(q[i])) * scene->body[i].r / now;
}

/* ---- discs and particles on a slope, between walls, on ropes */

static void draw_discs(struct random_numbers *numbers, struct scene *scene)
{
    bool plastic = chance(numbers, 0.5);
    double x = 0, s;
    scene->count = 1 + (int)random_between(numbers, 0, 2.5);
    scene->slope = s = chance(numbers, 0.5) ? 0 : random_between(numbers, -0.4, 0.4);
    scene->mu = chance(numbers, 0.8) ? random_between(numbers, 0.02, 0.7) : 0;
    scene->mu_pair = chance(numbers, 0.5) ? random_between(numbers, 0.02, 0.5) : 0;
    scene->e = plastic ? 0 : random_between(numbers, 0, 0.8);
    scene->e_pair = plastic ? 0 : random_between(numbers, 0, 0.8);
    scene->pairs = true;
    for (int i = 0; i < scene->count; i++) {
        struct body *disc = &scene->body[i];
        disc->point = scene->count == 1 && chance(numbers, 0.2);
        disc->m = exp(random_between(numbers, -1, 1));
        disc->r = disc->point ? 0 : random_between(numbers, 0.1, 0.3);
        disc->I = 0.4 * disc->m * disc->r * disc->r;
        x += (i ? scene->body[i - 1].r : 0) + disc->r + random_between(numbers, 0.05, 0.5) + 0.01;
        double high = disc->r + (chance(numbers, 0.6) ? 0 : random_between(numbers, 0.01, 0.3));
        double along = chance(numbers, 0.2) ? 0 : random_between(numbers, -2, 2);
        double up = high > disc->r && chance(numbers, 0.5) ? random_between(numbers, -1, 1) : 0;
        disc->q[0] = x * cos(s) - high * sin(s);
        disc->q[1] = x * sin(s) + high * cos(s);
        disc->v[0] = along * cos(s) - up * sin(s);
        disc->v[1] = along * sin(s) + up * cos(s);
        if (!disc->point) {
            disc->q[2] = 0;
            disc->v[2] = chance(numbers, 0.3)   ? 0
                         : chance(numbers, 0.3) ? -along / disc->r
                                                : random_between(numbers, -10, 10);
            disc->push[2] = draw_push(numbers, disc->m * g * disc->r / 2);
        }
        disc->push[0] = draw_push(numbers, disc->m * 4);
        disc->push[1] = draw_push(numbers, disc->m * 4);
        if (chance(numbers, 0.25)) {
            struct rope *rope = &scene->rope[scene->ropes++];
            double angle = random_between(numbers, 0.2, 2.9), far = random_between(numbers, 0.5, 2);
            rope->body = i;
            rope->at[0] = disc->q[0] + far * cos(angle + s);
            rope->at[1] = disc->q[1] + far * sin(angle + s);
            rope->length = far + (chance(numbers, 0.2) ? 0 : random_between(numbers, 0.01, 0.3));
        }
    }
    const struct body *first = &scene->body[0], *last = &scene->body[scene->count - 1];
    scene->has_wall[0] = chance(numbers, 0.3);
    scene->wall[0] = first->q[0] - first->r - random_between(numbers, 0.02, 0.5);
    scene->has_wall[1] = chance(numbers, 0.3);
    scene->wall[1] = last->q[0] + last->r + random_between(numbers, 0.02, 0.5);
}

static void write_contacts(const struct scene *scene, struct text *text)
{
    static const char *const lines[] = {"floor", "left", "right"};
    add(text, "contacts:\n");
    for (int i = 0; i < scene->count; i++)
        for (int j = 0; j < 3; j++) {
            if (j && !scene->has_wall[j - 1]) continue;
            add(text, "  - {between: [b%d, ground.%s], restitution: %.17g, law: moreau", i, lines[j],
                scene->e);
            if (scene->mu > 0) add(text, ", static: %.17g", scene->mu);
            add(text, "}\n");
        }
    for (int i = 0; i + 1 < scene->count; i++)
        for (int j = i + 1; j < scene->count; j++) {
            add(text, "  - {between: [b%d, b%d], restitution: %.17g, law: moreau", i, j, scene->e_pair);
            if (scene->mu_pair > 0) add(text, ", static: %.17g", scene->mu_pair);
            add(text, "}\n");
        }
}

static void write_discs(const struct scene *scene, struct text *text)
{
    add(text, "ground:\n  lines:\n    floor: {along: %.17g}\n", scene->slope);
    for (int j = 0; j < 2; j++)
        if (scene->has_wall[j])
            add(text, "    %s: {through: [%.17g, 0], along: 90 deg}\n", j ? "right" : "left", scene->wall[j]);
    if (scene->ropes) add(text, "  points:\n");
    for (int j = 0; j < scene->ropes; j++)
        add(text, "    P%d: [%.17g, %.17g]\n", j, scene->rope[j].at[0], scene->rope[j].at[1]);
    add(text, "bodies:\n");
    for (int i = 0; i < scene->count; i++) {
        const struct body *disc = &scene->body[i];
        add(text, "  b%d:\n    mass: %.17g\n", i, disc->m);
        if (!disc->point) add(text, "    shape: sphere\n    radius: %.17g\n", disc->r);
        add(text, "    motion: %s\n    initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g",
            disc->point ? "particle" : "planar", disc->q[0], disc->q[1], disc->v[0], disc->v[1]);
        if (!disc->point) add(text, ", omega: %.17g", disc->v[2]);
        add(text, "}\n    forces:\n      - gravity\n      - applied: {name: push, value: [");
        add_push(text, &disc->push[0]);
        add(text, ", ");
        add_push(text, &disc->push[1]);
        add(text, "]}\n");
        if (disc->point) continue;
        add(text, "    moments:\n      - applied: {name: turn, value: ");
        add_push(text, &disc->push[2]);
        add(text, "}\n");
    }
    if (scene->ropes) add(text, "couplings:\n");
    for (int j = 0; j < scene->ropes; j++)
        add(text, "  - rope: {through: [ground.P%d, b%d.G], length: %.17g}\n", j, scene->rope[j].body,
            scene->rope[j].length);
    write_contacts(scene, text);
}

static void forces_discs(const void *context, double t, const double *q, const double *v, double *f)
{
    const struct scene *scene = context;
    (void)q, (void)v;
    for (int i = 0; i < scene->count; i++) {
        for (int k = 0; k < 3; k++) f[3 * i + k] = push_at(&scene->body[i].push[k], t);
        f[3 * i + 1] -= scene->body[i].m * g;
    }
}

static void solve_discs(const void *context, const double *q, double *b)
{
    const struct scene *scene = context;
    (void)q;
    for (int i = 0; i < scene->count; i++) {
        const struct body *disc = &scene->body[i];
        b[3 * i] /= disc->m;
        b[3 * i + 1] /= disc->m;
        b[3 * i + 2] = disc->point ? 0 : b[3 * i + 2] / disc->I;
    }
}

/* Of body j at a normal towards it, against body i (or -1, the ground): a gap, and what rubs. */
static void touch(const struct scene *scene, int i, int j, double nx, double ny, struct moreau_rows *rows)
{
    struct moreau_row *gap = row_of(rows, moreau_gap), *rub;
    double mu = i < 0 ? scene->mu : scene->mu_pair;
    gap->w[3 * j] = nx;
    gap->w[3 * j + 1] = ny;
    if (i >= 0) gap->w[3 * i] = -nx, gap->w[3 * i + 1] = -ny;
    gap->e = i < 0 ? scene->e : scene->e_pair;
    if (mu == 0) return;
    rub = row_of(rows, moreau_rub);
    rub->mu = mu;
    rub->normal = rows->count - 2;
    rub->w[3 * j] = -ny;
    rub->w[3 * j + 1] = nx;
    rub->w[3 * j + 2] = -scene->body[j].r;
    if (i >= 0) rub->w[3 * i] = ny, rub->w[3 * i + 1] = -nx, rub->w[3 * i + 2] = -scene->body[i].r;
}

static void rope_rows(const struct scene *scene, const double *q, struct moreau_rows *rows)
{
    for (int j = 0; j < scene->ropes; j++) {
        const struct rope *rope = &scene->rope[j];
        double w[moreau_most] = {0}, now = 0;
        for (int end = 0; end < 2; end++) {
            int b = end ? rope->other : rope->body;
            if (b < 0) continue;
            double dx = q[3 * b] - rope->at[0], dy = q[3 * b + 1] - rope->at[1], d = hypot(dx, dy);
            w[3 * b] = -dx / d;
            w[3 * b + 1] = -dy / d;
            now += d;
        }
        if (now >= rope->length) memcpy(row_of(rows, moreau_gap)->w, w, sizeof w);
    }
}

static void rows_discs(const void *context, double t, const double *q, struct moreau_rows *rows)
{
    const struct scene *scene = context;
    double nx = -sin(scene->slope), ny = cos(scene->slope);
    (void)t;
    for (int i = 0; i < scene->count; i++) {
        double x = q[3 * i], y = q[3 * i + 1], r = scene->body[i].r;
        if (nx * x + ny * y <= r) touch(scene, -1, i, nx, ny, rows);
        if (scene->has_wall[0] && x - scene->wall[0] <= r) touch(scene, -1, i, 1, 0, rows);
        if (scene->has_wall[1] && scene->wall[1] - x <= r) touch(scene, -1, i, -1, 0, rows);
        for (int j = i + 1; j < scene->count; j++) {
            double dx = q[3 * j] - x, dy = q[3 * j + 1] - y, d = hypot(dx, dy);
            if (d <= r + scene->body[j].r) touch(scene, i, j, dx / d, dy / d, rows);
        }
    }
    rope_rows(scene, q, rows);
}

/* ---- points on slides: of the ground, joined by ropes, or one on the other. q are places in the world. */

static void draw_slide(struct random_numbers *numbers, struct body *slide)
{
    slide->m = exp(random_between(numbers, -1, 1));
    slide->q[0] = random_between(numbers, -0.3, 0.3);
    slide->v[0] = chance(numbers, 0.2) ? 0 : random_between(numbers, -2, 2);
    draw_stops(numbers, slide, 0.5, true);
    slide->push[0] = draw_push(numbers, slide->m * 8);
    slide->spring = chance(numbers, 0.3) ? slide->m * random_between(numbers, 1, 50) : 0;
    slide->neutral = random_between(numbers, -0.3, 0.3);
    slide->damper = chance(numbers, 0.2) ? slide->m * random_between(numbers, 0, 2) : 0;
    slide->rub = chance(numbers, 0.7) ? random_between(numbers, 0.02, 0.5) : 0;
    slide->rub_speed = slide->rub > 0 && chance(numbers, 0.2) ? random_between(numbers, -1, 1) : 0;
}

static void draw_weights(struct random_numbers *numbers, struct scene *scene)
{
    scene->count = 2 + chance(numbers, 0.4);
    for (int i = 0; i < scene->count; i++) {
        struct body *slide = &scene->body[i];
        draw_slide(numbers, slide);
        slide->rub /= 2; /* ropes across rough slides lock themselves, and move as well */
        slide->on = -1;
        slide->along = chance(numbers, 0.4) ? acos(0) : random_between(numbers, -0.8, 0.8);
        slide->through[0] = 2.0 * i;
    }
    for (int i = 0; i + 1 < scene->count; i++) {
        struct rope *rope = &scene->rope[scene->ropes++];
        double now = 0;
        *rope = (struct rope){i,
                              i + 1,
                              {2 * i + 1 + random_between(numbers, -1, 1), random_between(numbers, 1, 2)},
                              0};
        for (int end = i; end < i + 2; end++) {
            const struct body *slide = &scene->body[end];
            now += hypot(slide->through[0] + slide->q[0] * cos(slide->along) - rope->at[0],
                         slide->q[0] * sin(slide->along) - rope->at[1]);
        }
        rope->length = now + random_between(numbers, 0.01, 0.3);
    }
}

static void draw_stack(struct random_numbers *numbers, struct scene *scene)
{
    scene->count = 2 + chance(numbers, 0.4);
    for (int i = 0; i < scene->count; i++) {
        struct body *slide = &scene->body[i];
        draw_slide(numbers, slide);
        slide->on = i == 2 && chance(numbers, 0.5) ? 0 : i - 1;
        slide->along = chance(numbers, 0.4) ? 0 : random_between(numbers, -0.6, 0.6);
    }
}

static double angle_of(const struct scene *scene, int i)
{
    const struct body *slide = &scene->body[i];
    return slide->along + (slide->on < 0 ? 0 : angle_of(scene, slide->on));
}

static void write_slides(const struct scene *scene, struct text *text)
{
    if (scene->ropes) add(text, "ground:\n  points:\n");
    for (int j = 0; j < scene->ropes; j++)
        add(text, "    P%d: [%.17g, %.17g]\n", j, scene->rope[j].at[0], scene->rope[j].at[1]);
    add(text, "bodies:\n");
    for (int i = 0; i < scene->count; i++) {
        const struct body *slide = &scene->body[i];
        add(text, "  b%d:\n    mass: %.17g\n    motion: {slide: {along: %.17g", i, slide->m, slide->along);
        if (slide->on >= 0) add(text, ", on: b%d", slide->on);
        if (slide->on < 0) add(text, ", through: [%.17g, 0]", slide->through[0]);
        add_stops(text, slide);
        add(text, "}}\n    initial: {x: %.17g, v: %.17g}\n    forces:\n      - gravity\n", slide->q[0],
            slide->v[0]);
        add(text, "      - normal: {two_sided: true}\n      - applied: {name: push, angle: %.17g, value: ",
            angle_of(scene, i));
        add_push(text, &slide->push[0]);
        add(text, "}\n");
        if (slide->spring > 0)
            add(text, "      - spring: {stiffness: %.17g, neutral: %.17g}\n", slide->spring, slide->neutral);
        if (slide->damper > 0) add(text, "      - damper: {coefficient: %.17g}\n", slide->damper);
        if (slide->rub > 0)
            add(text, "      - friction: {coefficient: %.17g, surface_speed: %.17g}\n", slide->rub,
                slide->rub_speed);
    }
    if (scene->ropes) add(text, "couplings:\n");
    for (int j = 0; j < scene->ropes; j++)
        add(text, "  - rope: {through: [b%d, ground.P%d, b%d], length: %.17g}\n", scene->rope[j].body, j,
            scene->rope[j].other, scene->rope[j].length);
}

/* Along the slide of body i, against what it is on. */
static double along_slide(const struct scene *scene, int i, const double *q)
{
    const struct body *slide = &scene->body[i];
    double c = cos(angle_of(scene, i)), s = sin(angle_of(scene, i)), on[2] = {0, 0};
    if (slide->on >= 0) memcpy(on, q + 3 * slide->on, sizeof on);
    return c * (q[3 * i] - on[0]) + s * (q[3 * i + 1] - on[1]);
}

static void forces_slides(const void *context, double t, const double *q, const double *v, double *f)
{
    const struct scene *scene = context;
    for (int i = 0; i < 3 * scene->count; i++) f[i] = 0;
    for (int i = 0; i < scene->count; i++) {
        const struct body *slide = &scene->body[i];
        double c = cos(angle_of(scene, i)), s = sin(angle_of(scene, i)), P = push_at(&slide->push[0], t),
               x = along_slide(scene, i, q) - (slide->on < 0 ? c * slide->through[0] : 0),
               pair = -slide->spring * (x - slide->neutral) - slide->damper * along_slide(scene, i, v);
        f[3 * i] += c * (pair + P);
        f[3 * i + 1] += s * (pair + P) - slide->m * g;
        if (slide->on >= 0) f[3 * slide->on] -= c * pair, f[3 * slide->on + 1] -= s * pair;
    }
}

static void solve_slides(const void *context, const double *q, double *b)
{
    const struct scene *scene = context;
    (void)q;
    for (int i = 0; i < scene->count; i++)
        for (int k = 0; k < 3; k++) b[3 * i + k] = k < 2 ? b[3 * i + k] / scene->body[i].m : 0;
}

static void along_row(const struct scene *scene, int i, double c, double s, struct moreau_row *row)
{
    int on = scene->body[i].on;
    row->w[3 * i] = c;
    row->w[3 * i + 1] = s;
    if (on >= 0) row->w[3 * on] = -c, row->w[3 * on + 1] = -s;
}

static void rows_slides(const void *context, double t, const double *q, struct moreau_rows *rows)
{
    const struct scene *scene = context;
    (void)t;
    for (int i = 0; i < scene->count; i++) {
        const struct body *slide = &scene->body[i];
        double c = cos(angle_of(scene, i)), s = sin(angle_of(scene, i)),
               x = along_slide(scene, i, q) - (slide->on < 0 ? c * slide->through[0] : 0);
        along_row(scene, i, -s, c, row_of(rows, moreau_equal));
        for (int side = 0; side < 3; side++) {
            if (side == 0 && slide->rub == 0) continue;
            if (side == 1 && !(slide->has_min && x <= slide->min)) continue;
            if (side == 2 && !(slide->has_max && x >= slide->max)) continue;
            struct moreau_row *row = row_of(rows, side ? moreau_gap : moreau_rub);
            along_row(scene, i, side == 2 ? -c : c, side == 2 ? -s : s, row);
            row->e = slide->e;
            row->mu = slide->rub;
            row->aim = slide->rub_speed;
            if (side == 0) row->normal = rows->count - 2;
        }
    }
    rope_rows(scene, q, rows);
}

/* ---- both */

struct kind {
    const char *name;
    void (*draw)(struct random_numbers *numbers, struct scene *scene);
    void (*write)(const struct scene *scene, struct text *text);
    void (*forces)(const void *scene, double t, const double *q, const double *v, double *f);
    void (*solve)(const void *scene, const double *q, double *b);
    void (*rows)(const void *scene, double t, const double *q, struct moreau_rows *rows);
};

static const struct kind kinds[] = {
    {"links", draw_links, write_links, forces_links, solve_links, rows_links},
    {"discs", draw_discs, write_discs, forces_discs, solve_discs, rows_discs},
    {"weights", draw_weights, write_slides, forces_slides, solve_slides, rows_slides},
    {"stack", draw_stack, write_slides, forces_slides, solve_slides, rows_slides},
};

/* Coordinates and rates of the model, and of the stepping those of the scene: from the one to the other. */
enum { most_named = 20 };
struct named {
    int count;
    char name[most_named][24];
    double value[most_named];
    bool rate[most_named];
};

static void name_value(struct named *named, int body, const char *what, double value, bool rate)
{
    int i = named->count++;
    snprintf(named->name[i], sizeof named->name[i], "b%d.%s", body, what);
    named->value[i] = value;
    named->rate[i] = rate;
}

static struct named named_of(const struct scene *scene, const double *q, const double *v)
{
    struct named named = {0};
    for (int i = 0; i < scene->count; i++) {
        const struct body *body = &scene->body[i];
        const double *x = q + 3 * i, *u = v + 3 * i;
        if (scene->kind == 0) {
            name_value(&named, i, "theta", i ? q[1] - q[0] : q[0], false);
            name_value(&named, i, "omega", i ? v[1] - v[0] : v[0], true);
        } else if (scene->kind == 1) {
            name_value(&named, i, "x", x[0], false);
            name_value(&named, i, "y", x[1], false);
            name_value(&named, i, "vx", u[0], true);
            name_value(&named, i, "vy", u[1], true);
            if (body->point) continue;
            name_value(&named, i, "theta", x[2], false);
            name_value(&named, i, "omega", u[2], true);
        } else {
            double c = cos(angle_of(scene, i));
            name_value(&named, i, "x", along_slide(scene, i, q) - (body->on < 0 ? c * body->through[0] : 0),
                       false);
            name_value(&named, i, "v", along_slide(scene, i, v), true);
        }
    }
    return named;
}

static int size_of(const struct scene *scene)
{
    return scene->kind == 0 ? scene->count : 3 * scene->count;
}

static void start_of(const struct scene *scene, double *q, double *v)
{
    for (int i = 0; i < scene->count; i++) {
        const struct body *body = &scene->body[i];
        if (scene->kind == 0) {
            q[i] = body->q[0] + (i ? q[0] : 0);
            v[i] = body->v[0] + (i ? v[0] : 0);
        } else if (scene->kind == 1) {
            memcpy(q + 3 * i, body->q, sizeof body->q);
            memcpy(v + 3 * i, body->v, sizeof body->v);
        } else {
            double c = cos(angle_of(scene, i)), s = sin(angle_of(scene, i));
            int on = body->on;
            q[3 * i] = c * body->q[0] + (on < 0 ? body->through[0] : q[3 * on]);
            q[3 * i + 1] = s * body->q[0] + (on < 0 ? 0 : q[3 * on + 1]);
            v[3 * i] = c * body->v[0] + (on < 0 ? 0 : v[3 * on]);
            v[3 * i + 1] = s * body->v[0] + (on < 0 ? 0 : v[3 * on + 1]);
            q[3 * i + 2] = v[3 * i + 2] = 0;
        }
    }
}

static struct named step(const struct scene *scene, int steps)
{
    const struct kind *kind = &kinds[scene->kind];
    const struct moreau_system system = {size_of(scene), scene, kind->forces, kind->solve, kind->rows};
    double q[moreau_most] = {0}, v[moreau_most] = {0};
    start_of(scene, q, v);
    moreau_run(&system, scene->until, steps, q, v);
    return named_of(scene, q, v);
}

static double apart(const struct named *a, const struct named *b)
{
    double most = 0;
    for (int i = 0; i < a->count; i++)
        most = fmax(most, (a->rate[i] ? 0.1 : 1) * fabs(a->value[i] - b->value[i]));
    return most;
}

struct census {
    int tried, skipped, agree, ended, differ;
};

static void draw_scene(int kind, uint64_t seed, struct scene *scene, struct text *text)
{
    struct random_numbers numbers = {1000003u * seed + (uint64_t)kind};
    *scene = (struct scene){.kind = kind, .until = random_between(&numbers, 0.4, 1.5)};
    for (int j = 0; j < 4; j++) scene->rope[j].other = -1;
    kinds[kind].draw(&numbers, scene);
    text->length = 0;
    add(text, "fbd: 1\ngravity: 10\n");
    kinds[kind].write(scene, text);
    add(text, "simulate: {until: %.17g}\n", scene->until);
}

/* What two runs of the stepping and one of the library say. */
struct answers {
    struct named rough, fine, ours;
};

static double doubt(const struct answers *answers)
{
    return apart(&answers->rough, &answers->fine);
}

static bool agree(const struct answers *answers)
{
    return apart(&answers->ours, &answers->fine) <= fmax(10 * doubt(answers), 3e-4);
}

/* More than one motion agrees with the forces, or two different things are struck within a step of the stepping, which
 * takes that for one impact. */
static bool is_open(struct trial *trial, double step)
{
    fbd_event last = {.t = -1, .name = ""};
    for (size_t i = 0; i < fbd_simulation_event_count(trial->simulation); i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        if (event.kind == FBD_EVENT_SEVERAL) return true;
        if (event.kind != FBD_EVENT_IMPACT && event.kind != FBD_EVENT_ROPE_TAUT) continue;
        if (event.t != last.t && event.t - last.t < 2 * step && strcmp(event.name, last.name) != 0)
            return true;
        last = event;
    }
    return false;
}

static void tell(const char *name, unsigned long seed, const struct answers *answers, const struct text *text)
{
    print_message("# %s %lu: %.3g apart (half the steps: %.2g):", name, seed,
                  apart(&answers->ours, &answers->fine), doubt(answers));
    for (int i = 0; i < answers->ours.count; i++)
        print_message(" %s %.6g for %.6g", answers->ours.name[i], answers->ours.value[i],
                      answers->fine.value[i]);
    print_message("\n");
    for (const char *line = text->all; *line; line += strcspn(line, "\n") + 1)
        print_message("# %.*s\n", (int)strcspn(line, "\n"), line);
}

static void compare(struct checks *checks, const struct scene *scene, const struct text *text,
                    const char *name, unsigned long seed, int steps, struct census *census)
{
    const double sensitive = 2e-3;
    struct answers answers = {step(scene, steps / 2), step(scene, steps), {0}};
    census->tried++;
    if (doubt(&answers) > sensitive) {
        census->skipped++;
        return;
    }
    struct trial trial = trial_parse(text->all);
    trial_run(&trial, NULL);
    answers.ours = answers.fine;
    if (trial.outcome == FBD_DONE)
        for (int i = 0; i < answers.ours.count; i++)
            answers.ours.value[i] = trial_get(&trial, answers.ours.name[i]);
    if (trial.outcome != FBD_DONE) {
        census->ended++;
        check_that(checks, "the run comes to its end", false);
        print_message("# %s\n", fbd_simulation_reason(trial.simulation));
        tell(name, seed, &answers, text);
    } else if (agree(&answers)) {
        census->agree++;
    } else {
        const int finer = 8;
        answers.rough = step(scene, steps * finer / 2);
        answers.fine = step(scene, steps * finer);
        if (doubt(&answers) > sensitive || is_open(&trial, scene->until / (steps * finer))) {
            census->skipped++;
        } else if (agree(&answers)) {
            census->agree++;
        } else {
            census->differ++;
            check_that(checks, "time stepping says the same", false);
            tell(name, seed, &answers, text);
        }
    }
    trial_close(&trial);
}

static long number_of(const char *name, long otherwise)
{
    const char *given = getenv(name);
    return given ? strtol(given, NULL, 10) : otherwise;
}

static void time_stepping_says_the_same(void **unused)
{
    struct checks checks = {0};
    const char *only = getenv("FBD_PLANE_KIND");
    long count = number_of("FBD_PLANE", 40), first = number_of("FBD_PLANE_FIRST", 0),
         seed = number_of("FBD_PLANE_SEED", -1);
    int steps = (int)number_of("FBD_PLANE_STEPS", 10000);
    (void)unused;
    for (int k = 0; k < 4; k++) {
        struct census census = {0};
        if (only && strcmp(only, kinds[k].name) != 0) continue;
        for (long i = seed < 0 ? first : seed; i < (seed < 0 ? first + count : seed + 1); i++) {
            struct scene scene;
            struct text text;
            draw_scene(k, (uint64_t)i, &scene, &text);
            if (seed >= 0) puts(text.all), fflush(stdout);
            compare(&checks, &scene, &text, kinds[k].name, (unsigned long)i, steps, &census);
        }
        print_message("# %s: %d tried, %d agree, %d differ, %d end, %d too sensitive\n", kinds[k].name,
                      census.tried, census.agree, census.differ, census.ended, census.skipped);
    }
    checks_end(&checks);
}

/* Of the last digit of its place it is below the floor. */
static void a_particle_on_a_slope_stays_above_it(void **unused)
{
    enum { discs = 1, seed = 194 };
    struct checks checks = {0};
    struct census census = {0};
    struct scene scene;
    struct text text;
    (void)unused;
    draw_scene(discs, seed, &scene, &text);
    compare(&checks, &scene, &text, kinds[discs].name, seed, 10000, &census);
    check_that(&checks, "it is compared", census.agree == 1);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_particle_on_a_slope_stays_above_it),
        cmocka_unit_test(time_stepping_says_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
