/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/world_refs.h"

#include <math.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/friction.h"
#include "dynamics/mass.h"

static double choose(enum absolute_kind kind, struct motion_of_point at, double angle, double omega)
{
    switch (kind) {
    case absolute_x: return at.p.x;
    case absolute_y: return at.p.y;
    case absolute_vx: return at.v.x;
    case absolute_vy: return at.v.y;
    case absolute_angle: return angle;
    case absolute_angle_dot: return omega;
    case absolute_acceleration: /* output/hand.c */
    case absolute_force:
    case absolute_ax:
    case absolute_ay:
    case absolute_alpha:
    case absolute_inertia:
    case absolute_section:
    case absolute_work:
    case absolute_impulse:
    case absolute_mass:
    case absolute_mass_rate:
    case absolute_reaction:
    case absolute_input:
    case absolute_slip: break;
    }
    return 0;
}

/* ---- accelerations of a prescribed motion
 *
 * q'' is the second derivative of its expression, exact. A point has a = q'' g - w^2 r: on a slide g = e and w = 0, and at r from
 * the axis of a pivot g = k x r. */

static bool is_acceleration(enum absolute_kind kind)
{
    return kind == absolute_acceleration || kind == absolute_ax || kind == absolute_ay;
}

/* The acceleration of a point, and its variation unless `along` is NULL. Arms and directions turn with the body. */
static struct vec point_acceleration(const struct fbd_model *model, const struct model_absolute *absolute,
                                     const struct instant *at, const struct direction *along, double q2,
                                     double dq2, struct vec *variation)
{
    const struct model_body *body = &model->bodies[absolute->body];
    const struct pose pose = body_pose(body, at);
    const struct vec r = point_arm(body, &pose, absolute->point);
    const bool slides = body->joint->path == path_line;
    const struct vec g = slides ? model->tree->links[body->place.link].e : vec_perp(r); /* on the ground */
    const double w = pose.omega;
    if (along) {
        const struct tree_variation *d = &at->tree->variation[body->place.link];
        const struct vec turned = vec_add(vec_scale(q2, vec_perp(g)), vec_scale(-w * w, vec_perp(r)));
        const struct vec slower = vec_sub(vec_scale(dq2, g), vec_scale(2 * w * d->omega, r));
        *variation = vec_add(vec_scale(d->angle, turned), slower);
    }
    return vec_sub(vec_scale(q2, g), vec_scale(w * w, r));
}

/* Also its variation along a direction, unless `along` is NULL. Of a body that is not driven 0: derivations set that. */
static double driven_acceleration(const struct fbd_model *model, const struct model_absolute *absolute,
                                  const struct instant *at, const struct direction *along, double *variation)
{
    const int pair = model->bodies[absolute->body].drive_pair;
    double q2 = 0;
    struct vec da = {0, 0};
    *variation = 0;
    if (pair < 0) return 0;
    const struct mode *mode = &model->plan.modes[pair];
    friction_surface_speed(mode, at, &q2);
    *variation = along ? friction_surface_jerk(mode, at) * along->dt : 0;
    if (absolute->kind == absolute_acceleration) return q2;
    const struct vec a = point_acceleration(model, absolute, at, along, q2, *variation, &da);
    const bool x = absolute->kind == absolute_ax;
    *variation = x ? da.x : da.y;
    return x ? a.x : a.y;
}

/* ---- the slip speed of a friction constraint
 *
 * slip = |v - s|, computed as sigma (v - s) in the mode sigma: smooth across the end of a mode, as required
 * for a step beyond it, with the slope d slip / d v = sigma. In sticking it is identically 0. */

static double relative_speed(const struct fbd_model *model, int pair, const struct instant *at)
{
    const struct mode *mode = &model->plan.modes[pair];
    if (mode->coupling >= 0) return at->slip[pair] * coupling_slip(model, at, mode->coupling, NULL).value;
    double v = at->y[model->plan.n + mode->coordinate];
    return at->slip[pair] * (v - formula_value(&mode->surface_speed, at));
}

static double slip_at(const struct fbd_model *model, const struct model_absolute *slip,
                      const struct instant *at)
{
    if (slip->pair < 0 || at->slip[slip->pair] == stick) return 0;
    double speed = relative_speed(model, slip->pair, at);
    return slip->even ? fabs(speed) : speed;
}

static double slip_along(const struct fbd_model *model, const struct model_absolute *slip,
                         const struct instant *at, const struct direction *along)
{
    if (slip->pair < 0 || at->slip[slip->pair] == stick) return 0;
    const struct mode *mode = &model->plan.modes[slip->pair];
    int sign = at->slip[slip->pair];
    if (slip->even && relative_speed(model, slip->pair, at) < 0) sign = -sign;
    if (mode->coupling >= 0) return sign * coupling_slip(model, at, mode->coupling, along).variation;
    double d_speed, dv = along->dy[model->plan.n + mode->coordinate];
    formula_along(&mode->surface_speed, at, along, &d_speed);
    return sign * (dv - d_speed);
}

/* ---- inputs that are no constants
 *
 * A value that a state holds varies in directions of its own only. A callback u(t, y) has no exact derivatives; its variation is the central
 * difference
 *
 *   u' = (u(t + h dt, y + h dy) - u(t - h dt, y - h dy)) / (2 h),
 *
 * exact for quadratic u. h changes no component by more than the cube root of the round-off, relative to its size or 1:
 * there the truncation h^2 u_ttt/6 and the rounding eps u/h are of the same order. */

static double called(const struct fbd_model *model, int input, double t, const double *y)
{
    const struct input_call *call = &model->scene->parameters[input].call;
    double value = NAN;
    return call->function(call->context, t, y, &value) == 0 ? value : NAN;
}

static double input_at(const struct fbd_model *model, int input, const struct instant *at, const double *y)
{
    return model->scene->parameters[input].call.held ? at->held[input] : called(model, input, at->t, y);
}

static double called_step(const struct instant *at, const struct direction *along, size_t size)
{
    const double cube_root = 6.1e-6;
    double most = fabs(along->dt) / fmax(fabs(at->t), 1);
    for (size_t i = 0; i < size; i++) most = fmax(most, fabs(along->dy[i]) / fmax(fabs(at->y[i]), 1));
    return most > 0 ? cube_root / most : 0;
}

static double called_along(const struct fbd_model *model, int input, const struct instant *at,
                           const struct direction *along)
{
    double y[most_called_numbers], values[2];
    const size_t size = plan_size(&model->plan);
    const double h = called_step(at, along, size);
    if (h == 0) return 0;
    for (int k = 0; k < 2; k++) {
        const double step = k == 0 ? -h : h;
        for (size_t i = 0; i < size; i++) y[i] = at->y[i] + step * along->dy[i];
        values[k] = called(model, input, at->t + step * along->dt, y);
    }
    return (values[1] - values[0]) / (2 * h);
}

static double input_along(const struct fbd_model *model, int input, const struct instant *at,
                          const struct direction *along)
{
    if (!model->scene->parameters[input].call.held) return called_along(model, input, at, along);
    return along->held ? along->held[input] : 0;
}

/* ---- all of them */

/* Rates of masses depend on the rates of user states, which may contain any of the others. */
static void write_mass_rates(const struct fbd_model *model, const struct instant *at, double *y)
{
    double *places = y + plan_size(&model->plan) + hand_slots;
    struct instant written = *at;
    written.y = y;
    for (size_t k = 0; k < model->absolute_count; k++) {
        const struct model_absolute *absolute = &model->absolutes[k];
        if (absolute->kind == absolute_mass_rate)
            places[k] = body_mass_rate(model, &model->bodies[absolute->body], &written);
    }
}

void world_refs_write(const struct fbd_model *model, const struct instant *at, double *y)
{
    double *places = y + plan_size(&model->plan) + hand_slots;
    for (size_t k = 0; k < model->absolute_count; k++) {
        const struct model_absolute *absolute = &model->absolutes[k];
        const struct model_body *body = &model->bodies[absolute->body];
        if (absolute->kind == absolute_reaction) continue; /* reactions.h */
        if (absolute->kind == absolute_slip) {
            places[k] = slip_at(model, absolute, at);
            continue;
        }
        if (absolute->kind == absolute_input) {
            places[k] = input_at(model, absolute->coordinate, at, y);
            continue;
        }
        if (is_acceleration(absolute->kind)) {
            double variation;
            places[k] = driven_acceleration(model, absolute, at, NULL, &variation);
            continue;
        }
        if (absolute->kind == absolute_mass) places[k] = body_mass(body, at);
        if (absolute->kind == absolute_mass || absolute->kind == absolute_mass_rate) continue;
        struct pose pose = body_pose(body, at);
        places[k] = choose(absolute->kind, point_motion(body, &pose, absolute->point), body_angle(body, at),
                           pose.omega);
    }
    write_mass_rates(model, at, y);
}

struct instant instant_extend(const struct fbd_model *model, const struct instant *at)
{
    struct instant extended = *at;
    if (!model->names_places) return extended;
    if (at->y != at->extended) memcpy(at->extended, at->y, plan_size(&model->plan) * sizeof *at->extended);
    extended.y = at->extended;
    extended.moved = model->names_poses || tree_joins(model->tree); /* the slip of a row needs poses */
    if (extended.moved) tree_move(model, &extended);
    world_refs_write(model, &extended, at->extended);
    return extended;
}

/* The variation of a point. */
static struct motion_of_point point_along(const struct model_body *body, const struct instant *at,
                                          struct vec point)
{
    const struct tree_state *s = body_link(body, at);
    const struct tree_variation *d = &at->tree->variation[body->place.link];
    struct vec r = vec_turn(s->turn, placement_point(&body->place, point));
    struct vec dr = vec_scale(d->angle, vec_perp(r));
    struct vec dv = vec_add(vec_scale(d->omega, vec_perp(r)), vec_scale(s->omega, vec_perp(dr)));
    return (struct motion_of_point){vec_add(d->p, dr), vec_add(d->v, dv)};
}

static double varied(const struct fbd_model *model, const struct model_absolute *absolute,
                     const struct instant *at, const struct direction *along)
{
    const struct model_body *body = &model->bodies[absolute->body];
    if (absolute->kind == absolute_reaction) return 0;
    if (absolute->kind == absolute_slip) return slip_along(model, absolute, at, along);
    if (absolute->kind == absolute_input) return input_along(model, absolute->coordinate, at, along);
    if (absolute->kind == absolute_mass) {
        double variation;
        formula_along(&body->mass, at, along, &variation);
        return variation;
    }
    if (is_acceleration(absolute->kind)) {
        double variation;
        driven_acceleration(model, absolute, at, along, &variation);
        return variation;
    }
    if (absolute->kind == absolute_mass_rate) return body_mass_rate_along(model, body, at, along);
    const struct tree_variation *d = &at->tree->variation[body->place.link];
    return choose(absolute->kind, point_along(body, at, absolute->point), d->angle, d->omega);
}

struct direction direction_extend(const struct fbd_model *model, const struct instant *at,
                                  const struct direction *along)
{
    if (!model->names_places) return *along;
    size_t size = plan_size(&model->plan);
    double *dy = at->extended + extended_size(model);
    if (along->dy != dy) memcpy(dy, along->dy, size * sizeof *dy);
    tree_move_along(model, at, along);
    tree_move_alone_along(model, at, along);
    const struct direction extended = {along->dt, dy, along->held};
    for (int rates = 0; rates < 2; rates++) /* rates of masses depend on all others */
        for (size_t k = 0; k < model->absolute_count; k++)
            if ((model->absolutes[k].kind == absolute_mass_rate) == (rates == 1))
                dy[size + hand_slots + k] = varied(model, &model->absolutes[k], at, &extended);
    return extended;
}
