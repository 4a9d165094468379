/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "variants.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "absolute.h"

const char *variant_name(enum variant variant)
{
    static const char *const names[] = {"mirrored",       "turned with its gravity", "moved by 1e6 m",
                                        "in other units", "in another order",        "split and welded",
                                        "taken up later"};
    return names[variant];
}

/* ---- what varies in all formulas alike: variables replaced by others */

struct replacing {
    const struct scene *scene;
    enum variant variant;
    double angle, later, length;
    struct vec2 shift;
    const double *base; /* by body: how the frame that its coordinates count from has turned */
    const double *own;  /* what is said in its own frame has been turned by this, and the frame has not */
};

static bool is_angle(const struct scene *scene, const struct variable *v)
{
    return v->kind == var_angle || v->kind == var_angle_rate ||
           ((v->kind == var_coordinate || v->kind == var_rate) &&
            (scene->body[v->body].motion == pivot || v->index == 2));
}

/* x or y of a pair in one frame: its partner's number, or -1 for what is along a slide. */
static bool is_of_pair(const struct scene *scene, const struct variable *v)
{
    if (v->kind >= var_place_x && v->kind <= var_place_vy) return true;
    if (v->kind != var_coordinate && v->kind != var_rate) return false;
    return coordinate_count(scene->body[v->body].motion) > 1 && v->index < 2;
}

static bool is_second(const struct variable *v)
{
    return v->kind == var_place_y || v->kind == var_place_vy ||
           ((v->kind == var_coordinate || v->kind == var_rate) && v->index == 1);
}

static struct variable partner(const struct variable *v)
{
    struct variable other = *v;
    if (v->kind == var_coordinate || v->kind == var_rate)
        other.index = 1 - v->index;
    else
        other.kind = is_second(v) ? v->kind - 1 : v->kind + 1;
    return other;
}

/* x = c x' + s y', y = c y' - s x'. */
static void turn_variable(const struct replacing *r, struct summand *s, int i)
{
    struct variable *v = &s->variable[i];
    bool coordinate = v->kind == var_coordinate || v->kind == var_rate;
    if (is_angle(r->scene, v)) {
        double angle = coordinate ? r->base[v->body] : r->angle - r->own[v->body];
        if (v->kind == var_coordinate || v->kind == var_angle) s->shift -= v->coefficient * angle;
        return;
    }
    if (!is_of_pair(r->scene, v)) return;
    double angle = coordinate ? r->base[v->body] : r->angle, k = v->coefficient;
    struct variable other = partner(v);
    other.coefficient = (is_second(v) ? -1 : 1) * k * sin(angle);
    v->coefficient = k * cos(angle);
    s->variable[s->count++] = other;
}

static void move_variable(const struct replacing *r, struct summand *s, const struct variable *v)
{
    bool place = v->kind == var_place_x || v->kind == var_place_y;
    bool free = v->kind == var_coordinate && is_of_pair(r->scene, v) && r->scene->body[v->body].on < 0;
    if (place || free) s->shift -= v->coefficient * (is_second(v) ? r->shift.y : r->shift.x);
}

static void replace(const struct replacing *r, struct summand *s, int i)
{
    struct variable *v = &s->variable[i];
    bool length = v->kind != var_time && v->kind != var_state && !is_angle(r->scene, v);
    switch (r->variant) {
    case variant_mirrored:
        if (is_angle(r->scene, v) || (is_of_pair(r->scene, v) && is_second(v))) v->coefficient *= -1;
        break;
    case variant_turned: turn_variable(r, s, i); break;
    case variant_moved: move_variable(r, s, v); break;
    case variant_units:
        if (length) v->coefficient /= r->length;
        break;
    case variant_later:
        if (v->kind == var_time) s->shift += v->coefficient * r->later;
        break;
    default: break;
    }
}

static void replace_all(const struct replacing *r, struct formula *formula)
{
    for (int k = 0; k < formula->count; k++) {
        struct summand *s = &formula->summand[k];
        for (int i = 0, count = s->count; i < count; i++) replace(r, s, i);
    }
}

static void replace_in_scene(const struct replacing *r, struct scene *scene)
{
    for (int c = 0; c < scene->coupling_count; c++) replace_all(r, &scene->coupling[c].reel);
    for (int i = 0; i < scene->state_count; i++) replace_all(r, &scene->state[i].rate);
    for (int b = 0; b < scene->body_count; b++) {
        replace_all(r, &scene->body[b].drive);
        replace_all(r, &scene->body[b].mass);
        for (int i = 0; i < scene->body[b].load_count; i++) {
            replace_all(r, &scene->body[b].load[i].value);
            replace_all(r, &scene->body[b].load[i].second);
            replace_all(r, &scene->body[b].load[i].surface);
            for (int k = 0; k < 2; k++) {
                replace_all(r, &scene->body[b].load[i].offset[k]);
                replace_all(r, &scene->body[b].load[i].wind[k]);
            }
        }
    }
}

static void add_constant(struct formula *formula, double value)
{
    formula->summand[formula->count++] =
        (struct summand){.factor = value, .parameter = -1, .function = f_one};
}

/* ---- mirrored: y, angles and moments change their sign, and left is right */

static bool is_directed(const struct load *load)
{
    return load->kind == applied || load->kind == distributed || load->kind == thrust;
}

/* In the x axis of the frame that it is given in. */
static void mirror_path(struct path *path)
{
    path->along *= -1;
    *(path->form == path_wave ? &path->a : &path->b) *= -1;
}

static void mirror_load(struct load *load)
{
    load->to.y *= -1;
    load->at.where.y *= -1;
    load->side = load->side == left_side ? right_side : left_side;
    load->end.where.y *= load->kind == distributed ? -1 : 1;
    if (is_directed(load)) scale_formula(&load->second, -1);
    scale_formula(&load->offset[1], -1);
    scale_formula(&load->wind[1], -1);
    if (load->kind == moment_applied) scale_formula(&load->value, -1);
    if (load->kind == moment_friction) scale_formula(&load->surface, -1);
    if (load->kind == moment_spring) load->neutral *= -1;
}

static void mirror_body(struct body *body)
{
    body->along *= -1;
    mirror_path(&body->path);
    body->at.where.y *= -1;
    body->point.where.y *= -1;
    for (int i = 0; i < body->piece_count; i++) {
        body->piece[i].center.y *= -1;
        body->piece[i].angle *= -1;
        if (body->piece[i].shape == given_inertia) body->piece[i].size[2] *= -1;
    }
    for (int i = 0; i < body->point_count; i++) body->points[i].y *= -1;
    for (int i = body->motion == pivot ? 0 : 1; i < 3; i++) {
        body->q[i] *= -1;
        body->v[i] *= -1;
    }
    if (body->motion == pivot) scale_formula(&body->drive, -1);
    for (int i = 0; i < body->load_count; i++) mirror_load(&body->load[i]);
}

/* Top and bottom change places, left and right do not. */
static void mirror_end(struct end *end)
{
    end->at.where.y *= -1;
    if (end->side == wound_top || end->side == wound_bottom)
        end->side = end->side == wound_top ? wound_bottom : wound_top;
}

static void mirror(struct scene *scene)
{
    scene->gravity.y *= -1;
    for (int i = 0; i < scene->line_count; i++) {
        scene->line[i].through.y *= -1;
        scene->line[i].along *= -1;
    }
    for (int b = 0; b < scene->body_count; b++) mirror_body(&scene->body[b]);
    for (int c = 0; c < scene->coupling_count; c++) {
        struct coupling *coupling = &scene->coupling[c];
        for (int k = 0; k < coupling->count; k++) mirror_end(&coupling->end[k]);
        if (coupling->kind != slot) continue;
        mirror_path(&coupling->path);
        coupling->side = coupling->side == left_side ? right_side : left_side;
    }
}

/* ---- turned: what is said in the world, in order of what moves on what */

/* The components of a vector. */
static void turn_pair(struct formula *x, struct formula *y, double angle)
{
    struct formula old_x = *x, old_y = *y;
    x->count = y->count = 0;
    for (int part = 0; part < 2; part++) {
        const struct formula *from = part == 0 ? &old_x : &old_y;
        for (int k = 0; k < from->count; k++) {
            struct summand to_x = from->summand[k], to_y = from->summand[k];
            to_x.factor *= part == 0 ? cos(angle) : -sin(angle);
            to_y.factor *= part == 0 ? sin(angle) : cos(angle);
            x->summand[x->count++] = to_x;
            y->summand[y->count++] = to_y;
        }
    }
}

static void turn_load(struct load *load, enum motion motion, double world, double base, double own)
{
    load->to = turned(load->to, world);
    load->at.where = turned(load->at.where, own);
    bool turns = motion == pivot || motion == planar;
    if (load->kind == moment_spring && turns) load->neutral += base;
    double angle = load->follows ? own : world;
    turn_pair(&load->offset[0], &load->offset[1], world);
    turn_pair(&load->wind[0], &load->wind[1], world);
    if (load->kind == distributed) load->end.where = turned(load->end.where, own);
    if (!is_directed(load) || load->form == along_slide || load->form == toward_point) return;
    if (load->form == along_angle)
        add_constant(&load->second, angle);
    else
        turn_pair(&load->value, &load->second, angle);
}

static void turn_body(struct body *body, double world, double base, double own)
{
    int angle = body->motion == pivot ? 0 : 2;
    if (body->motion == slide || body->motion == weld) body->along += base;
    body->path.along += base;
    body->at.where = turned(body->at.where, base);
    body->point.where = turned(body->point.where, own);
    if (body->motion == particle || body->motion == planar) {
        struct vec2 q = turned((struct vec2){body->q[0], body->q[1]}, base);
        struct vec2 v = turned((struct vec2){body->v[0], body->v[1]}, base);
        body->q[0] = q.x;
        body->q[1] = q.y;
        body->v[0] = v.x;
        body->v[1] = v.y;
    }
    if (body->motion == pivot || body->motion == planar) body->q[angle] += base;
    if (body->motion == pivot && body->driven) add_constant(&body->drive, base);
    for (int i = 0; i < body->piece_count; i++) {
        struct piece *piece = &body->piece[i];
        piece->center = turned(piece->center, own);
        struct vec2 about = turned((struct vec2){piece->size[1], piece->size[2]}, own);
        if (piece->shape == given_inertia) piece->size[1] = about.x, piece->size[2] = about.y;
        bool has_axis =
            piece->shape != given_inertia && piece->shape != point_shape && piece->shape != sphere_shape;
        if (has_axis) piece->angle += own;
    }
    for (int i = 0; i < body->point_count; i++) body->points[i] = turned(body->points[i], own);
    for (int i = 0; i < body->load_count; i++) turn_load(&body->load[i], body->motion, world, base, own);
}

static bool keeps_axes(const struct body *body)
{
    return body->motion == particle || (body->motion == track && body->keeps_direction);
}

/* A particle keeps its axes, as the ground does: what is said in them is turned. All others turn as a whole.
 */
static void turn(struct replacing *r, struct scene *scene, double *base, double *own)
{
    bool known[most_bodies] = {false};
    for (int pass = 0; pass < scene->body_count; pass++)
        for (int b = 0; b < scene->body_count; b++) {
            int on = scene->body[b].on;
            if (known[b] || (on >= 0 && !known[on])) continue;
            base[b] = on < 0 ? r->angle : own[on];
            own[b] = keeps_axes(&scene->body[b]) ? base[b] : 0;
            known[b] = true;
        }
    replace_in_scene(r, scene);
    scene->gravity = turned(scene->gravity, r->angle);
    for (int i = 0; i < scene->line_count; i++) {
        scene->line[i].through = turned(scene->line[i].through, r->angle);
        scene->line[i].along += r->angle;
    }
    for (int b = 0; b < scene->body_count; b++) turn_body(&scene->body[b], r->angle, base[b], own[b]);
    for (int c = 0; c < scene->coupling_count; c++) {
        int on = scene->coupling[c].end[1].body;
        scene->coupling[c].path.along += on < 0 ? r->angle : own[on];
    }
    for (int c = 0; c < scene->coupling_count; c++)
        for (int k = 0; k < scene->coupling[c].count; k++)
            if (scene->coupling[c].end[k].body < 0)
                scene->coupling[c].end[k].at.where = turned(scene->coupling[c].end[k].at.where, r->angle);
}

/* The x axis of a particle, or of what keeps its direction on a track, cannot be turned with it for what rolls there. */
static bool has_axis_that_stays(const struct scene *scene)
{
    for (int c = 0; c < scene->coupling_count; c++) {
        const struct coupling *coupling = &scene->coupling[c];
        if (coupling->kind != roll || coupling->line >= 0) continue;
        if (keeps_axes(&scene->body[coupling->end[1].body])) return true;
    }
    return false;
}

/* ---- moved */

static void add(struct vec2 *p, struct vec2 d)
{
    p->x += d.x;
    p->y += d.y;
}

static void move(struct scene *scene, struct vec2 d)
{
    for (int i = 0; i < scene->line_count; i++) add(&scene->line[i].through, d);
    for (int b = 0; b < scene->body_count; b++) {
        struct body *body = &scene->body[b];
        for (int i = 0; i < body->load_count; i++) add(&body->load[i].to, d);
        if (body->on >= 0) continue;
        if (body->motion == slide || body->motion == pivot || body->motion == track) {
            body->at.point = at_pair;
            add(&body->at.where, d);
        } else {
            body->q[0] += d.x;
            body->q[1] += d.y;
        }
    }
    for (int c = 0; c < scene->coupling_count; c++)
        for (int k = 0; k < scene->coupling[c].count; k++)
            if (scene->coupling[c].end[k].body < 0) add(&scene->coupling[c].end[k].at.where, d);
}

/* ---- all of them */

/* Where a rope leaves its disc is said as it is seen at the start, and how long it is without what lies there. */
static bool has_wound_rope(const struct scene *scene)
{
    for (int c = 0; c < scene->coupling_count; c++) {
        const struct coupling *coupling = &scene->coupling[c];
        if (coupling->end[0].wound || coupling->end[coupling->count - 1].wound) return true;
    }
    return false;
}

bool scene_vary(const struct scene *scene, enum variant variant, struct random *random, double later,
                struct scene *other, struct view *view)
{
    double base[most_bodies] = {0}, own[most_bodies] = {0};
    struct replacing r = {.scene = scene, .variant = variant, .later = later, .base = base, .own = own};
    *view = (struct view){.mirror = 1, .length = 1, .force = 1, .changed = -1};
    *other = *scene;
    bool seen = variant == variant_turned || variant == variant_split || variant == variant_later;
    if (seen && has_wound_rope(scene)) return false;
    switch (variant) {
    case variant_mirrored:
        view->mirror = -1;
        replace_in_scene(&r, other);
        mirror(other);
        return true;
    case variant_turned:
        if (has_axis_that_stays(scene)) return false;
        r.angle = view->angle = random_between(random, -3, 3);
        turn(&r, other, base, own);
        return true;
    case variant_moved:
        r.shift = view->shift = (struct vec2){1e6, -1e6};
        replace_in_scene(&r, other);
        move(other, view->shift);
        return true;
    case variant_units:
        view->length = r.length = scene->us ? 0.3048 : 1 / 0.3048;
        view->force = scene->us ? 4.4482216152605 : 1 / 4.4482216152605;
        replace_in_scene(&r, other);
        vary_units(other, view->length, view->force);
        return true;
    case variant_order: vary_order(scene, random, other); return scene->body_count > 1;
    case variant_split: return vary_split(other, random, view);
    case variant_later: replace_in_scene(&r, other); return true;
    case variant_count: break;
    }
    return false;
}
