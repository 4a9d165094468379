/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The rows of a scene, what may hold or give, and the place where it starts.
 */
#include <string.h>

#include "absolute.h"

static struct row *add_row(struct absolute *absolute, enum row_kind kind, int owner, double zero)
{
    struct row *row = &absolute->row[absolute->row_count++];
    *row = (struct row){.kind = kind, .owner = owner, .zero = zero, .grip = -1};
    return row;
}

static struct grip *add_grip(struct absolute *absolute, enum grip_kind kind, int owner, int row,
                             int press_row)
{
    struct grip *grip = &absolute->grip[absolute->grip_count++];
    *grip =
        (struct grip){.kind = kind, .owner = owner, .load = -1, .row = row, .normal = press_row, .press = 1};
    return grip;
}

static const struct load *load_of(const struct body *body, enum load_kind kind, int *index)
{
    for (*index = 0; *index < body->load_count; ++*index)
        if (body->load[*index].kind == kind) return &body->load[*index];
    *index = -1;
    return NULL;
}

/* The friction of a load holds a row, the coordinate of the joint, at the speed of its surface. */
static void add_friction(struct absolute *absolute, enum grip_kind kind, int b, int load, int press_row)
{
    struct row *row = add_row(absolute, kind == grip_surface ? row_along : row_angle, b, 0);
    row->drive = &absolute->scene->body[b].load[load].surface;
    row->grip = absolute->grip_count;
    add_grip(absolute, kind, b, absolute->row_count - 1, press_row)->load = load;
}

static void add_slide(struct absolute *absolute, int b)
{
    const struct body *body = &absolute->scene->body[b];
    bool curved = body->motion == track;
    if (curved && !body->keeps_direction)
        add_row(absolute, row_tangent, b, 0);
    else
        add_row(absolute, row_angle, b, curved ? 0 : body->along);
    int across = absolute->row_count, i, press;
    add_row(absolute, curved ? row_track : row_across, b, 0);
    if (body->driven) add_row(absolute, row_along, b, 0)->drive = &body->drive;
    const struct load *surface = load_of(body, normal, &i);
    if (!surface) return;
    press = surface->side == left_side ? 1 : -1;
    struct grip *contact = add_grip(absolute, grip_contact, b, across, across);
    contact->load = i;
    contact->press = press;
    if (!load_of(body, friction, &i)) return;
    add_friction(absolute, grip_surface, b, i, across);
    absolute->grip[absolute->grip_count - 1].press = press;
}

static void add_joint(struct absolute *absolute, int b)
{
    const struct body *body = &absolute->scene->body[b];
    int i;
    switch (body->motion) {
    case slide:
    case track: add_slide(absolute, b); break;
    case pivot:
    case weld:
        add_row(absolute, row_pin_x, b, 0);
        add_row(absolute, row_pin_y, b, 0);
        if (body->motion == weld) add_row(absolute, row_angle, b, body->along);
        if (body->driven) add_row(absolute, row_angle, b, 0)->drive = &body->drive;
        if (body->motion == pivot && load_of(body, moment_friction, &i))
            add_friction(absolute, grip_bearing, b, i, -1);
        break;
    case particle: add_row(absolute, row_angle, b, 0); break;
    case planar: break;
    }
}

/* +1 when the way turns left at end k. */
static double turn_at(const struct absolute *absolute, const struct coupling *coupling, int k)
{
    struct place p[3];
    for (int i = 0; i < 3; i++) {
        const struct end *end = &coupling->end[k - 1 + i];
        struct vec2 where = end->at.where;
        if (end->body >= 0) where = spot_of(&absolute->scene->body[end->body], &end->at);
        if (end->pulley) circle_of(absolute->scene, coupling, k - 1 + i, &where);
        p[i] = point_of(absolute, end->body, where);
    }
    return place_cross(place_sub(p[1], p[0]), place_sub(p[2], p[1])).u > 0 ? 1 : -1;
}

/* The rope leaves the disc in the direction `way` of the other place, turned by an angle whose cosine is s R / d, for s =
 * +1 to the right of it: it is counter-clockwise round the disc, and the other way for a rope that arrives. */
double wound_turn(const struct absolute *absolute, const struct coupling *coupling, int k, double *margin)
{
    struct place p[2];
    double R = 0, far[2];
    for (int i = 0; i < 2; i++) {
        int at = i == 0 ? k : k == 0 ? 1 : k - 1;
        const struct end *end = &coupling->end[at];
        struct vec2 where = end->at.where;
        if (end->body >= 0) where = spot_of(&absolute->scene->body[end->body], &end->at);
        if (end->pulley) {
            double radius = circle_of(absolute->scene, coupling, at, &where);
            if (i == 0) R = radius;
        }
        p[i] = point_of(absolute, end->body, where);
    }
    double x = p[1].x.u - p[0].x.u, y = p[1].y.u - p[0].y.u, way = atan2(y, x), open = acos(R / hypot(x, y));
    enum wound_side side = coupling->end[k].side;
    for (int i = 0; i < 2; i++) {
        double touches = way + (i == 0 ? -open : open);
        far[i] = side == wound_left || side == wound_right ? cos(touches) : sin(touches);
        if (side == wound_left || side == wound_bottom) far[i] = -far[i];
    }
    *margin = fabs(far[0] - far[1]);
    return (far[0] > far[1]) == (k == 0) ? 1 : -1;
}

static double turn_of(const struct absolute *absolute, const struct coupling *coupling, int k)
{
    double unused;
    return coupling->end[k].wound ? wound_turn(absolute, coupling, k, &unused)
                                  : turn_at(absolute, coupling, k);
}

static void add_capstan(struct absolute *absolute, int c)
{
    double side = turn_at(absolute, &absolute->scene->coupling[c], 1);
    int length = absolute->row_count;
    for (int k = 0; k < 2; k++) {
        struct row *row = add_row(absolute, k == 0 ? row_capstan : row_capstan_slip, c, 0);
        row->to = 2;
        row->turn[0] = side;
        row->zero = row_value(absolute, row).u;
        row->grip = absolute->grip_count;
        add_grip(absolute, k == 0 ? grip_rope : grip_capstan, c, length + k, k == 0 ? -1 : length);
    }
    struct grip *rubbing = &absolute->grip[absolute->grip_count - 1];
    rubbing->press = -2;
    if (!absolute->scene->coupling[c].held) rubbing->mode = lets_go; /* until it is settled */
}

static void add_rope(struct absolute *absolute, int c)
{
    const struct coupling *coupling = &absolute->scene->coupling[c];
    if (coupling->rubs) {
        add_capstan(absolute, c);
        return;
    }
    for (int k = 1, from = 0; k < coupling->count; k++) {
        if (k + 1 < coupling->count && !coupling->end[k].pulley) continue;
        struct row *row = add_row(absolute, row_rope, c, 0);
        row->from = from;
        row->to = k;
        if (coupling->end[from].pulley) row->turn[0] = turn_of(absolute, coupling, from);
        if (coupling->end[k].pulley) row->turn[1] = turn_of(absolute, coupling, k);
        row->zero = row_value(absolute, row).u;
        if (coupling->reels && from == 0) {
            row->drive = &coupling->reel;
            row->zero -= formula_value(absolute, row->drive);
        }
        add_grip(absolute, grip_rope, c, absolute->row_count - 1, -1);
        row->grip = absolute->grip_count - 1;
        from = k;
    }
}

/* On which side of its line the circle is. */
static double side_of(const struct absolute *absolute, int c)
{
    struct row left = {.kind = row_roll_normal, .owner = c, .side = 1};
    struct vec2 unused;
    return row_value(absolute, &left).u +
                       circle_of(absolute->scene, &absolute->scene->coupling[c], 0, &unused) <
                   0
               ? -1
               : 1;
}

static void add_roll(struct absolute *absolute, int c)
{
    double side = side_of(absolute, c);
    int across = absolute->row_count;
    add_row(absolute, row_roll_normal, c, 0)->side = side;
    struct row *row = add_row(absolute, row_roll_along, c, 0);
    row->side = side;
    row->zero = row_value(absolute, row).u;
    add_grip(absolute, grip_contact, c, across, across);
    if (!absolute->scene->coupling[c].has_friction) return;
    row->grip = absolute->grip_count;
    add_grip(absolute, grip_tread, c, across + 1, across);
}

static void add_slot(struct absolute *absolute, int c)
{
    const struct coupling *coupling = &absolute->scene->coupling[c];
    double press = coupling->one_sided && coupling->side == right_side ? -1 : 1;
    int across = absolute->row_count;
    add_row(absolute, row_slot, c, 0);
    if (!coupling->one_sided && !coupling->has_friction) return;
    add_grip(absolute, grip_contact, c, across, across)->press = press;
    if (!coupling->has_friction) return;
    struct row *row = add_row(absolute, row_slot_along, c, 0);
    row->zero = row_value(absolute, row).u;
    row->grip = absolute->grip_count;
    struct grip *rubbing = add_grip(absolute, grip_tread, c, across + 1, across);
    rubbing->press = press;
    if (!coupling->held) rubbing->mode = lets_go; /* until it is settled */
}

static void add_coupling(struct absolute *absolute, int c)
{
    const struct coupling *coupling = &absolute->scene->coupling[c];
    struct row *row;
    switch (coupling->kind) {
    case pin:
        add_row(absolute, row_link_pin_x, c, 0);
        add_row(absolute, row_link_pin_y, c, 0);
        break;
    case rod:
    case gear:
    case rack:
        row = add_row(absolute,
                      coupling->kind == rod    ? row_rod
                      : coupling->kind == gear ? row_gear
                                               : row_rack,
                      c, 0);
        if (coupling->kind == rack) row->side = side_of(absolute, c);
        row->zero = coupling->length > 0 ? coupling->length : row_value(absolute, row).u;
        break;
    case rope: add_rope(absolute, c); break;
    case belt:
        for (int k = 0; k < (coupling->tension > 0 ? 1 : 2); k++) {
            row = add_row(absolute, k == 0 ? row_belt_turn : row_belt_length, c, 0);
            row->zero = row_value(absolute, row).u;
        }
        break;
    case roll: add_roll(absolute, c); break;
    case slot: add_slot(absolute, c); break;
    case spring_of_two:
    case damper_of_two: break;
    }
}

void absolute_start(struct absolute *absolute, const struct scene *scene)
{
    double q[3 * most_bodies], v[3 * most_bodies];
    int k = 0;
    memset(absolute, 0, sizeof *absolute);
    absolute->scene = scene;
    absolute->n = 3 * scene->body_count;
    absolute->unpushed_from = absolute->unpushed_to = INFINITY;
    for (int b = 0; b < scene->body_count; b++) {
        absolute->first_mass[b] = absolute->mass[b] = mass_of(&scene->body[b]);
        for (int i = 0; i < coordinate_count(scene->body[b].motion); i++, k++) {
            q[k] = scene->body[b].q[i];
            v[k] = scene->body[b].v[i];
        }
    }
    for (int i = 0; i < scene->state_count; i++) absolute->z[i] = scene->state[i].initial;
    absolute_place(absolute, 0, q, v);
    absolute_seed(absolute, seed_motion);
    absolute_masses(absolute);
    for (int b = 0; b < scene->body_count; b++) add_joint(absolute, b);
    for (int c = 0; c < scene->coupling_count; c++) add_coupling(absolute, c);
}
