/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/diagram.h"

#include "dynamics/laws.h"
#include "dynamics/tree.h"

size_t diagram_arrows(const struct fbd_model *model, int body)
{
    return (size_t)model->bodies[body].arrow_count;
}

size_t diagram_most_arrows(const struct fbd_model *model)
{
    size_t most = 1;
    for (size_t b = 0; b < model->body_count; b++)
        if (diagram_arrows(model, (int)b) > most) most = diagram_arrows(model, (int)b);
    return most;
}

double arrow_moment(const struct arrow *arrow, struct vec about)
{
    return arrow->couple + vec_cross(vec_sub(arrow->point, about), arrow->force);
}

bool arrow_is_reaction(const struct fbd_model *model, const struct arrow *arrow)
{
    if (arrow->load < 0) return true;
    switch (model->loads[arrow->load].source->kind) {
    case load_normal:
    case load_friction:
    case moment_friction:
    case load_drive:
    case load_rope:
    case load_belt:
    case load_contact: return true;
    default: return false;
    }
}

struct vec mass_center_acceleration(const struct model_body *body, const struct instant *at, const double *a)
{
    const double *own = a + body->first;
    if (body->place.link > 0) return tree_mass_center_acceleration(body, at);
    if (body->kind == motion_slide) return vec_scale(own[0], body->e);
    if (body->kind == motion_particle) return (struct vec){own[0], own[1]};
    /* a_G = a_O + alpha k x r - omega^2 r */
    struct pose pose = body_pose(body, at);
    struct vec r = vec_turn(pose.rotation, body->arm);
    double alpha = own[body->count - 1];
    struct vec turning = vec_sub(vec_scale(alpha, vec_perp(r)), vec_scale(pose.omega * pose.omega, r));
    return body->kind == motion_pivot ? turning : vec_add((struct vec){own[0], own[1]}, turning);
}

/* ---- forces by kind */

struct vec applied_force(const struct model_load *load, const struct pose *pose, const struct instant *at)
{
    const struct load *source = load->source;
    struct vec f;
    if (source->fx.expr || source->fy.expr)
        f = (struct vec){formula_value(&load->fx, at), formula_value(&load->fy, at)};
    else if (!source->angle.expr)
        return vec_scale(formula_value(&load->value, at), pose->rotation); /* e is the body's x axis */
    else
        f = vec_scale(formula_value(&load->value, at), vec_unit(formula_value(&load->angle, at)));
    return source->body_frame ? vec_turn(pose->rotation, f) : f;
}

struct vec load_place(const struct model_load *load, struct vec point, const struct instant *at)
{
    if (!load_is_placed(load->source)) return point;
    return vec_add(point,
                   (struct vec){formula_value(&load->offset_x, at), formula_value(&load->offset_y, at)});
}

struct vec drag_of_load(const struct model_load *load, struct vec v, const struct instant *at)
{
    const struct load *source = load->source;
    struct drag_law law = {source->linear, source->quadratic};
    struct vec f = load_drags_still_air(source) ? drag_force(&law, v) : (struct vec){0, 0};
    if (!load_has_wind(source)) return f;
    return vec_add(f, (struct vec){formula_value(&load->fx, at), formula_value(&load->fy, at)});
}

static struct vec link_or_line_force(const struct model_body *body, const struct model_load *load,
                                     struct motion_of_point point, const struct instant *at)
{
    const struct load *source = load->source;
    if (load->linked) {
        struct link_law law = {load->anchor, source->stiffness, source->free_length, source->coefficient};
        return link_force(&law, point);
    }
    double stretch = at->y[body->first] - source->free_length;
    return vec_scale(-(source->stiffness * stretch + source->coefficient * at->y[body->first_rate]), body->e);
}

/* -dV/dq of each of the body's coordinates: a force in the plane, a force along the slide, a moment about the
 * axis. */
static void potential_arrow(const struct model_body *body, const struct model_load *load,
                            const struct instant *at, struct arrow *arrow)
{
    double f[most_coordinates_of_a_body] = {0};
    if (load->potential.expr)
        for (int k = 0; k < body->count; k++) {
            expr_eval_slot(load->potential.expr, at->t, at->y, 1 + body->first + k,
                           formula_branches(&load->potential, at), &f[k]);
            f[k] = -f[k];
        }
    if (body->kind == motion_slide) arrow->force = vec_scale(f[0], body->e);
    if (body->kind == motion_pivot) arrow->couple = f[0];
    if (body->count > 1) arrow->force = (struct vec){f[0], f[1]};
    if (body->kind == motion_planar) { /* V is a function of the frame's origin */
        arrow->point = (struct vec){at->y[body->first], at->y[body->first + 1]};
        arrow->couple = f[2];
    }
}

static void set_arrow(const struct fbd_model *model, const struct model_body *body,
                      const struct model_load *load, const struct pose *pose, const struct instant *at,
                      const double *slots, struct arrow *arrow)
{
    const struct load *source = load->source;
    struct motion_of_point point = point_motion(body, pose, load->point);
    arrow->point = load_place(load, point.p, at);
    switch (source->kind) {
    case load_gravity: arrow->force = vec_scale(body->inertia.mass, model->scene->gravity); break;
    case load_drive:
    case load_rope:
    case load_belt:
    case load_contact:
    case load_normal: break; /* a reaction: set from the sum of the others */
    case load_friction:
        arrow->force = vec_scale(friction_at(model, body->friction, at, slots).force, body->e);
        break;
    case moment_friction: arrow->couple = friction_at(model, body->friction, at, slots).force; break;
    case load_applied: arrow->force = applied_force(load, pose, at); break;
    case load_spring:
    case load_damper: arrow->force = link_or_line_force(body, load, point, at); break;
    case load_drag: arrow->force = drag_of_load(load, point.v, at); break;
    case load_potential:
    case moment_potential: potential_arrow(body, load, at, arrow); break;
    case moment_applied: arrow->couple = formula_value(&load->value, at); break;
    case moment_spring:
        arrow->couple = -source->stiffness * (at->y[body->first + body->count - 1] - source->free_length);
        break;
    case moment_damper:
        arrow->couple = -source->coefficient * at->y[body->first_rate + body->count - 1];
        break;
    }
}

/* ---- shares and reactions */

static void set_share(const struct model_body *body, const struct pose *pose, struct arrow *arrow)
{
    struct motion_of_point point = {.p = arrow->point};
    add_force(body, pose, point, arrow->force, arrow->share);
    if (body->kind == motion_pivot || body->kind == motion_planar)
        arrow->share[body->count - 1] += arrow->couple;
}

static double share_power(const struct model_body *body, const struct instant *at, const struct arrow *arrow)
{
    double power = 0;
    for (int k = 0; k < body->count; k++) power += arrow->share[k] * at->y[body->first_rate + k];
    return power;
}

/* The force that keeps the body on its axis or line: m a_G minus all that is listed; on a line, across it
 * only. */
static struct vec guiding_force(const struct model_body *body, const struct instant *at, const double *a,
                                struct vec listed)
{
    struct vec needed = vec_scale(body->inertia.mass, mass_center_acceleration(body, at, a));
    struct vec reaction = vec_sub(needed, listed);
    return body->kind == motion_pivot ? reaction : vec_scale(vec_dot(reaction, body->n), body->n);
}

size_t diagram_fill(const struct fbd_model *model, int index, const struct instant *at, const double *a,
                    const double *slots, struct arrow *arrows)
{
    const struct model_body *body = &model->bodies[index];
    if (body->place.link > 0) return tree_diagram_fill(model, index, at, slots, arrows);
    struct pose pose = body_pose(body, at);
    struct vec listed = {0, 0};
    int normal = -1;
    for (int i = 0; i < body->load_count; i++) {
        const struct model_load *load = &model->loads[body->first_load + i];
        arrows[i] = (struct arrow){.name = load->source->name, .load = body->first_load + i};
        if (load->source->kind == load_normal) normal = i;
        set_arrow(model, body, load, &pose, at, slots, &arrows[i]);
        listed = vec_add(listed, arrows[i].force);
        set_share(body, &pose, &arrows[i]);
        arrows[i].power = share_power(body, at, &arrows[i]);
    }
    size_t count = (size_t)body->load_count;
    bool guided = body->kind == motion_slide || body->kind == motion_pivot;
    if (!guided) return count;
    struct vec reaction = guiding_force(body, at, a, listed);
    if (normal >= 0) {
        arrows[normal].force = reaction;
        return count;
    }
    struct vec where =
        body->kind == motion_pivot ? body->origin : point_motion(body, &pose, body->inertia.G).p;
    arrows[count] = (struct arrow){.name = body->kind == motion_pivot ? "pin" : "guide",
                                   .load = -1,
                                   .force = reaction,
                                   .point = where};
    return count + 1;
}
