/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where bodies and their points are, the coordinates of joints, and each condition as a function g of that.
 */
#include <string.h>

#include "absolute.h"

static const double turn = 6.283185307179586;

/* ---- bodies */

static struct series seeded(const struct absolute *absolute, int i, int seed)
{
    if (seed == seed_motion) return (struct series){absolute->x[i], absolute->v[i], 0};
    if (seed == seed_path) return (struct series){absolute->x[i], absolute->v[i], absolute->a[i]};
    return (struct series){absolute->x[i], i == seed, 0};
}

static void seed_body(struct absolute *absolute, int b, int seed)
{
    struct series x = seeded(absolute, 3 * b, seed), y = seeded(absolute, 3 * b + 1, seed);
    struct series angle = seeded(absolute, 3 * b + 2, seed);
    absolute->pose[b].x = x;
    absolute->pose[b].y = y;
    absolute->pose[b].angle = angle;
    absolute->pose[b].c = ser_cos(angle);
    absolute->pose[b].s = ser_sin(angle);
}

void absolute_seed(struct absolute *absolute, int seed)
{
    for (int b = 0; b < absolute->scene->body_count; b++) seed_body(absolute, b, seed);
}

/* A point p of a body is at G + R(angle) (p - G). */
struct place point_of(const struct absolute *absolute, int b, struct vec2 point)
{
    if (b < 0) return (struct place){ser(point.x), ser(point.y)};
    struct vec2 r = {point.x - absolute->mass[b].G.x, point.y - absolute->mass[b].G.y};
    struct series c = absolute->pose[b].c, s = absolute->pose[b].s;
    struct place arm = {ser_sub(ser_scale(r.x, c), ser_scale(r.y, s)),
                        ser_add(ser_scale(r.x, s), ser_scale(r.y, c))};
    return place_add((struct place){absolute->pose[b].x, absolute->pose[b].y}, arm);
}

struct place direction_of(const struct absolute *absolute, int b, double angle)
{
    double c = cos(angle), s = sin(angle);
    if (b < 0) return (struct place){ser(c), ser(s)};
    struct series C = absolute->pose[b].c, S = absolute->pose[b].s;
    return (struct place){ser_sub(ser_scale(c, C), ser_scale(s, S)),
                          ser_add(ser_scale(c, S), ser_scale(s, C))};
}

struct series angle_of(const struct absolute *absolute, int b)
{
    return b < 0 ? ser(0) : absolute->pose[b].angle;
}

/* ---- coordinates of joints */

static struct series turned(const struct absolute *absolute, int b)
{
    return ser_sub(angle_of(absolute, b), angle_of(absolute, absolute->scene->body[b].on));
}

/* From the place where it is joined to its own point there. */
static struct place off_joint(const struct absolute *absolute, int b)
{
    const struct body *body = &absolute->scene->body[b];
    struct vec2 at = body->on < 0 ? body->at.where : spot_of(&absolute->scene->body[body->on], &body->at);
    struct vec2 own = spot_of(body, &body->point);
    return place_sub(point_of(absolute, b, own), point_of(absolute, body->on, at));
}

/* The same in the frame that it moves on. */
static struct place on_its_base(const struct absolute *absolute, int b)
{
    struct place d = off_joint(absolute, b), e = direction_of(absolute, absolute->scene->body[b].on, 0);
    return (struct place){place_dot(e, d), place_dot(place_left(e), d)};
}

struct series coordinate_of(const struct absolute *absolute, int b, int index)
{
    const struct body *body = &absolute->scene->body[b];
    if (body->motion == track)
        return path_length(&body->path, path_foot(&body->path, on_its_base(absolute, b)));
    if (body->motion == pivot || index == 2) return turned(absolute, b);
    struct place d = off_joint(absolute, b);
    struct place e = direction_of(absolute, body->on, body->motion == slide ? body->along : 0);
    return place_dot(index == 0 ? e : place_left(e), d);
}

struct place tangent_of(const struct absolute *absolute, int b)
{
    const struct body *body = &absolute->scene->body[b];
    struct place e = direction_of(absolute, body->on, 0);
    struct series p = path_foot(&body->path, on_its_base(absolute, b));
    struct place d = path_place(&body->path, ser(p.u), 1);
    struct series speed = place_length(d);
    return place_scale(ser_inverse(speed), place_add(place_scale(d.x, e), place_scale(d.y, place_left(e))));
}

void absolute_coordinates(const struct absolute *absolute, double *q, double *v)
{
    int k = 0;
    struct absolute *own = (struct absolute *)absolute;
    absolute_seed(own, seed_motion);
    for (int b = 0; b < absolute->scene->body_count; b++)
        for (int i = 0; i < coordinate_count(absolute->scene->body[b].motion); i++, k++) {
            struct series coordinate = coordinate_of(absolute, b, i);
            q[k] = coordinate.u;
            v[k] = coordinate.u1;
        }
}

/* Forwards: from joint coordinates to the body, given the one that it moves on. */
static void place_body(struct absolute *absolute, int b, const struct series *q)
{
    const struct body *body = &absolute->scene->body[b];
    struct vec2 at = body->on < 0 ? body->at.where : spot_of(&absolute->scene->body[body->on], &body->at);
    struct vec2 own = spot_of(body, &body->point), G = absolute->mass[b].G;
    struct place p = point_of(absolute, body->on, at);
    struct series angle = angle_of(absolute, body->on);
    struct place e = direction_of(absolute, body->on, body->motion == slide ? body->along : 0);
    if (body->motion == slide || body->motion == weld) angle = ser_add(angle, ser(body->along));
    if (body->motion == slide) p = place_add(p, place_scale(q[0], e));
    if (body->motion == particle || body->motion == planar)
        p = place_add(p, place_add(place_scale(q[0], e), place_scale(q[1], place_left(e))));
    if (body->motion == track) {
        struct series at_p = path_parameter(&body->path, q[0]);
        struct place r = path_place(&body->path, at_p, 0), d = path_place(&body->path, at_p, 1);
        p = place_add(p, place_add(place_scale(r.x, e), place_scale(r.y, place_left(e))));
        if (!body->keeps_direction) angle = ser_add(angle, place_angle(d));
    }
    if (body->motion == pivot) angle = ser_add(angle, q[0]);
    if (body->motion == planar) angle = ser_add(angle, q[2]);
    struct series c = ser_cos(angle), s = ser_sin(angle);
    struct place arm = {ser_sub(ser_scale(G.x - own.x, c), ser_scale(G.y - own.y, s)),
                        ser_add(ser_scale(G.x - own.x, s), ser_scale(G.y - own.y, c))};
    struct series x[3] = {ser_add(p.x, arm.x), ser_add(p.y, arm.y), angle};
    for (int i = 0; i < 3; i++) {
        absolute->x[3 * b + i] = x[i].u;
        absolute->v[3 * b + i] = x[i].u1;
    }
    seed_body(absolute, b, seed_motion);
}

/* A body may stand before the one that it moves on. */
void absolute_place(struct absolute *absolute, double t, const double *q, const double *v)
{
    const struct scene *scene = absolute->scene;
    bool placed[most_bodies] = {false};
    absolute->t = t;
    for (int pass = 0; pass < scene->body_count; pass++)
        for (int b = 0, k = 0; b < scene->body_count; k += coordinate_count(scene->body[b].motion), b++) {
            int on = scene->body[b].on;
            if (placed[b] || (on >= 0 && !placed[on])) continue;
            struct series own[3] = {{0, 0, 0}};
            for (int i = 0; i < coordinate_count(scene->body[b].motion); i++)
                own[i] = (struct series){q[k + i], v[k + i], 0};
            if (scene->body[b].driven) own[0] = formula_series(absolute, &scene->body[b].drive, b, -1);
            place_body(absolute, b, own);
            placed[b] = true;
        }
}

/* ---- rows */

/* How the frame of a body on a curve is turned against the curve there. */
static struct series off_tangent(const struct absolute *absolute, int b)
{
    const struct path *path = &absolute->scene->body[b].path;
    struct place d = path_place(path, path_foot(path, on_its_base(absolute, b)), 1);
    struct series off = ser_sub(turned(absolute, b), place_angle(d));
    off.u = remainder(off.u, turn);
    return off;
}

struct place end_place(const struct absolute *absolute, const struct coupling *coupling, int k)
{
    const struct end *end = &coupling->end[k];
    if (end->body < 0) return point_of(absolute, -1, end->at.where);
    struct vec2 centre = spot_of(&absolute->scene->body[end->body], &end->at);
    bool pair = coupling->kind == gear || coupling->kind == belt;
    bool circle = end->pulley || pair || ((coupling->kind == rack || coupling->kind == roll) && k == 0);
    if (circle) circle_of(absolute->scene, coupling, k, &centre);
    return point_of(absolute, end->body, centre);
}

/* The circles roll on each other: arcs that have met are equal, r1 (theta1 - phi) = -r2 (theta2 - phi), phi
 * the angle of the line of centres; with r2 < 0 the first runs inside the second. */
static struct series gear_value(const struct absolute *absolute, const struct coupling *coupling)
{
    struct vec2 unused;
    double r1 = circle_of(absolute->scene, coupling, 0, &unused);
    double r2 = circle_of(absolute->scene, coupling, 1, &unused) * (coupling->inside ? -1 : 1);
    struct series phi =
        place_angle(place_sub(end_place(absolute, coupling, 1), end_place(absolute, coupling, 0)));
    struct series one = ser_sub(angle_of(absolute, coupling->end[0].body), phi);
    struct series two = ser_sub(angle_of(absolute, coupling->end[1].body), phi);
    return ser_add(ser_scale(r1, one), ser_scale(r2, two));
}

/* A circle on a line: its centre stays R off, and where it touches nothing slips. Rolling by an angle A to
 * the left of its line takes the centre along by -A R, and by +A R on the right. */
static struct series line_value(const struct absolute *absolute, const struct row *row)
{
    const struct coupling *coupling = &absolute->scene->coupling[row->owner];
    struct vec2 unused, through = {0, 0};
    double R = circle_of(absolute->scene, coupling, 0, &unused), along = 0;
    int base = coupling->end[1].body;
    if (coupling->kind == roll && coupling->line >= 0) {
        base = -1;
        through = absolute->scene->line[coupling->line].through;
        along = absolute->scene->line[coupling->line].along;
    }
    struct place e = direction_of(absolute, base, along);
    struct place d = place_sub(end_place(absolute, coupling, 0), point_of(absolute, base, through));
    if (row->kind == row_roll_normal)
        return ser_sub(ser_scale(row->side, place_dot(place_left(e), d)), ser(R));
    struct series rolled = ser_sub(angle_of(absolute, coupling->end[0].body), angle_of(absolute, base));
    return ser_add(place_dot(e, d), ser_scale(row->side * R, rolled));
}

static struct series slot_value(const struct absolute *absolute, const struct row *row)
{
    const struct coupling *coupling = &absolute->scene->coupling[row->owner];
    struct place e = direction_of(absolute, coupling->end[1].body, 0);
    struct place d = place_sub(end_place(absolute, coupling, 0), end_place(absolute, coupling, 1));
    struct place C = {place_dot(e, d), place_dot(place_left(e), d)};
    if (row->kind == row_slot_along) return path_length(&coupling->path, path_foot(&coupling->path, C));
    double off = coupling->side == left_side ? coupling->radius[0] : -coupling->radius[0];
    return ser_sub(path_distance(&coupling->path, C), ser(off));
}

struct series row_value(const struct absolute *absolute, const struct row *row)
{
    const struct scene *scene = absolute->scene;
    const struct coupling *coupling = row->kind < row_link_pin_x ? NULL : &scene->coupling[row->owner];
    struct series g = ser(0);
    switch (row->kind) {
    case row_angle: g = turned(absolute, row->owner); break;
    case row_along: g = coordinate_of(absolute, row->owner, 0); break;
    case row_track:
        g = path_distance(&scene->body[row->owner].path, on_its_base(absolute, row->owner));
        break;
    case row_tangent: g = off_tangent(absolute, row->owner); break;
    case row_slot:
    case row_slot_along: g = slot_value(absolute, row); break;
    case row_across: g = coordinate_of(absolute, row->owner, 1); break;
    case row_pin_x: g = off_joint(absolute, row->owner).x; break;
    case row_pin_y: g = off_joint(absolute, row->owner).y; break;
    case row_rope: return rope_value(absolute, row);
    case row_capstan:
    case row_capstan_slip: return capstan_value(absolute, row);
    case row_belt_turn:
    case row_belt_length: return belt_value(absolute, row);
    case row_gear: g = gear_value(absolute, coupling); break;
    case row_rack:
    case row_roll_normal:
    case row_roll_along: g = line_value(absolute, row); break;
    default: {
        struct place d = place_sub(end_place(absolute, coupling, 0), end_place(absolute, coupling, 1));
        g = row->kind == row_rod ? place_length(d) : row->kind == row_link_pin_x ? d.x : d.y;
    }
    }
    g = ser_sub(g, ser(row->zero));
    if (row->kind == row_gear) {
        struct vec2 unused;
        double r1 = circle_of(scene, coupling, 0, &unused), r2 = circle_of(scene, coupling, 1, &unused);
        g.u = remainder(g.u, turn * (coupling->inside ? r2 - r1 : r1 + r2)); /* phi: but for whole turns */
    }
    return g;
}

size_t row_bodies(const struct absolute *absolute, const struct row *row, int *bodies)
{
    size_t count = 0;
    if (row->kind < row_link_pin_x) {
        bodies[count++] = row->owner;
        if (absolute->scene->body[row->owner].on >= 0) bodies[count++] = absolute->scene->body[row->owner].on;
        return count;
    }
    const struct coupling *coupling = &absolute->scene->coupling[row->owner];
    bool roped = row->kind == row_rope || row->kind == row_capstan || row->kind == row_capstan_slip;
    int from = roped ? row->from : 0, to = roped ? row->to : 1;
    for (int k = from; k <= to; k++) {
        bool seen = coupling->end[k].body < 0;
        for (size_t i = 0; i < count; i++) seen |= bodies[i] == coupling->end[k].body;
        if (!seen) bodies[count++] = coupling->end[k].body;
    }
    return count;
}

/* J by one coordinate at a time; gamma from g'' with a = 0. A driven row has g(x) = f(t): gamma gains f''. */
void absolute_rows(struct absolute *absolute)
{
    absolute_seed(absolute, seed_motion);
    for (int j = 0; j < absolute->row_count; j++) {
        struct row *row = &absolute->row[j];
        absolute->gamma[j] = -row_value(absolute, row).u2;
        if (!row->drive) continue;
        struct series f = formula_series(absolute, row->drive, row->owner, -1);
        absolute->gamma[j] +=
            row->grip >= 0 && row->kind != row_rope ? f.u1 : f.u2; /* or a surface's speed */
    }
    for (int j = 0; j < absolute->row_count; j++) {
        int bodies[most_ends + 2];
        size_t count = row_bodies(absolute, &absolute->row[j], bodies);
        memset(absolute->J[j], 0, sizeof absolute->J[j]);
        for (size_t i = 0; i < count; i++) seed_body(absolute, bodies[i], 3 * most_bodies);
        for (size_t i = 0; i < count; i++) {
            for (int k = 0; k < 3; k++) {
                seed_body(absolute, bodies[i], 3 * bodies[i] + k);
                absolute->J[j][3 * bodies[i] + k] = row_value(absolute, &absolute->row[j]).u1;
            }
            seed_body(absolute, bodies[i], 3 * most_bodies);
        }
        for (size_t i = 0; i < count; i++) seed_body(absolute, bodies[i], seed_motion);
    }
}
