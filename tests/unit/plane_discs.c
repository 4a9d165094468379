/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Discs and particles on a slope, between walls, on ropes.
 */
#include "plane.h"

/* To somewhere above. */
static void draw_rope(struct random_numbers *numbers, struct scene *scene, int i)
{
    const struct body *disc = &scene->body[i];
    const double s = scene->slope;
    struct rope *rope = &scene->rope[scene->ropes++];
    double angle = random_between(numbers, 0.2, 2.9), far = random_between(numbers, 0.5, 2);
    rope->body = i;
    rope->at[0] = disc->q[0] + far * cos(angle + s);
    rope->at[1] = disc->q[1] + far * sin(angle + s);
    rope->length = far + (chance(numbers, 0.2) ? 0 : random_between(numbers, 0.01, 0.3));
}

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
            disc->push[2] = draw_push(numbers, disc->m * plane_g * disc->r / 2);
        }
        disc->push[0] = draw_push(numbers, disc->m * 4);
        disc->push[1] = draw_push(numbers, disc->m * 4);
        if (chance(numbers, 0.25)) draw_rope(numbers, scene, i);
    }
    const struct body *first = &scene->body[0], *last = &scene->body[scene->count - 1];
    scene->has_wall[0] = chance(numbers, 0.3);
    scene->wall[0] = first->q[0] - first->r - random_between(numbers, 0.02, 0.5);
    scene->has_wall[1] = chance(numbers, 0.3);
    scene->wall[1] = last->q[0] + last->r + random_between(numbers, 0.02, 0.5);
}

static void write_contacts(const struct scene *scene, struct written *text)
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

static void write_discs(const struct scene *scene, struct written *text)
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
        f[3 * i + 1] -= scene->body[i].m * plane_g;
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

static void start(const struct scene *scene, double *q, double *v)
{
    for (int i = 0; i < scene->count; i++) {
        memcpy(q + 3 * i, scene->body[i].q, sizeof scene->body[i].q);
        memcpy(v + 3 * i, scene->body[i].v, sizeof scene->body[i].v);
    }
}

static void name_values(const struct scene *scene, const double *q, const double *v,
                        struct stepped_values *named)
{
    static const char *const names[] = {"x", "y", "theta", "vx", "vy", "omega"};
    for (int i = 0; i < scene->count; i++)
        for (int k = 0; k < (scene->body[i].point ? 2 : 3); k++) {
            stepped_name(named, "b", i, names[k], q[3 * i + k], 1);
            stepped_name(named, "b", i, names[3 + k], v[3 * i + k], 0.1);
        }
}

const struct kind plane_discs = {"discs",    draw_discs, write_discs, forces_discs, solve_discs,
                                 rows_discs, 3,          start,       name_values};
