/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random slots: the point is put onto the curve, or its roller beside it.
 */
#include "generate_parts.h"

static const double pi = 3.141592653589793;

static struct vec2 beside(const struct coupling *coupling, double p)
{
    struct place at = path_place(&coupling->path, ser(p), 0), d = path_place(&coupling->path, ser(p), 1);
    double off = coupling->side == left_side ? coupling->radius[0] : -coupling->radius[0];
    double speed = hypot(d.x.u, d.y.u);
    return (struct vec2){at.x.u - off * d.y.u / speed, at.y.u + off * d.x.u / speed};
}

/* A pin in its slot, that may rub; a roller does not. */
static void rub(struct random *random, struct coupling *coupling, const struct taste *taste)
{
    if (coupling->radius[0] > 0) return;
    add_friction(random, coupling, taste);
    coupling->held = coupling->has_friction && random_chance(random, 0.3);
}

void add_slot(struct random *random, struct scene *scene, const struct taste *taste)
{
    struct absolute absolute;
    int b = random_below(random, scene->body_count), base = other_than(random, scene, b);
    struct body *body = &scene->body[b];
    if (body->point_count == most_points) return;
    struct coupling *coupling = add_coupling(scene, slot);
    coupling->end[0] = (struct end){.body = b, .at = {.point = body->point_count}};
    coupling->end[1] = (struct end){.body = base, .at = {.point = at_origin}};
    if (base < 0)
        coupling->end[1].at =
            (struct spot){at_pair, {random_between(random, -1, 1), random_between(random, -1, 1)}};
    else if (random_chance(random, 0.5))
        coupling->end[1].at.point = random_point(random, &scene->body[base]);
    bool closed = random_chance(random, 0.5);
    coupling->path = random_path(random, closed);
    if (random_chance(random, 0.4))
        coupling->path =
            (struct path){.form = path_line, .along = random_between(random, -pi, pi), .from = -6, .to = 6};
    if (coupling->path.form == path_oval && !closed) coupling->path = random_path(random, true);
    coupling->one_sided = random_chance(random, 0.5);
    coupling->side = random_chance(random, 0.5) ? left_side : right_side;
    if (coupling->one_sided && random_chance(random, 0.5))
        coupling->radius[0] = random_between(random, 0.05, 0.25);
    rub(random, coupling, taste);
    start(&absolute, scene);
    double p =
        coupling->path.form == path_oval ? random_between(random, 0.3, 6) : random_between(random, -1, 1);
    struct vec2 r = beside(coupling, p);
    struct place e = direction_of(&absolute, base, 0);
    struct vec2 O = end_world(&absolute, &coupling->end[1]);
    struct vec2 P = {O.x + e.x.u * r.x - e.y.u * r.y, O.y + e.y.u * r.x + e.x.u * r.y};
    body->points[body->point_count++] = local_of(&absolute, b, P);
}
