/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Links: one pendulum, or one on another. q are the angles in the world.
 */
#include "plane.h"

static void draw_links(struct random_numbers *numbers, struct scene *scene)
{
    scene->count = chance(numbers, 0.35) ? 1 : 2;
    bool plastic = scene->count == 2 || chance(numbers, 0.5);
    for (int i = 0; i < scene->count; i++) {
        struct body *link = &scene->body[i];
        link->m = exp(random_between(numbers, -1, 1));
        link->r = random_between(numbers, 0.3, 1);
        double size = link->m * plane_g * link->r;
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

static void write_links(const struct scene *scene, struct written *text)
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
        if (link->rub > 0 || link->lists_zero)
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
    f[0] = -(a->m / 2 + (two ? b->m : 0)) * plane_g * a->r * cos(q[0]);
    if (two) {
        double c = b->m * a->r * b->r / 2 * sin(q[0] - q[1]);
        f[0] -= c * v[1] * v[1];
        f[1] = -b->m * plane_g * b->r / 2 * cos(q[1]) + c * v[0] * v[0];
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
            row->aim = side ? 0 : link->rub_speed;
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

static void start(const struct scene *scene, double *q, double *v)
{
    for (int i = 0; i < scene->count; i++) {
        q[i] = scene->body[i].q[0] + (i ? q[0] : 0);
        v[i] = scene->body[i].v[0] + (i ? v[0] : 0);
    }
}

static void name_values(const struct scene *scene, const double *q, const double *v,
                        struct stepped_values *named)
{
    for (int i = 0; i < scene->count; i++) {
        stepped_name(named, "b", i, "theta", i ? q[1] - q[0] : q[0], 1);
        stepped_name(named, "b", i, "omega", i ? v[1] - v[0] : v[0], 0.1);
    }
}

const struct kind plane_links = {"links",    draw_links, write_links, forces_links, solve_links,
                                 rows_links, 1,          start,       name_values};
