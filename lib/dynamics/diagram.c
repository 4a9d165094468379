/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/diagram.h"

#include "dynamics/laws.h"
#include "dynamics/mass.h"
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
    return arrow->load < 0 || load_law(model->loads[arrow->load].source)->follows;
}

struct vec point_acceleration(const struct model_body *body, struct vec point, const struct instant *at)
{
    struct pose pose = body_pose(body, at);
    return tree_point_acceleration(body, point_motion(body, &pose, point).p, at);
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

/* The point of application of a load: `point`, the position of its point of the body, or beside it. */
static struct vec load_place(const struct model_load *load, struct vec point, const struct instant *at)
{
    if (!load_is_placed(load->source)) return point;
    return vec_add(point,
                   (struct vec){formula_value(&load->offset_x, at), formula_value(&load->offset_y, at)});
}

static struct vec drag_of_load(const struct model_load *load, struct vec v, const struct instant *at)
{
    const struct load *source = load->source;
    struct drag_law law = {source->linear, source->quadratic};
    struct vec f = load_drags_still_air(source) ? drag_force(&law, v) : (struct vec){0, 0};
    if (!load_has_wind(source)) return f;
    return vec_add(f, (struct vec){formula_value(&load->fx, at), formula_value(&load->fy, at)});
}

struct vec body_direction(const struct model_body *body, const struct instant *at)
{
    return body_link(body, at)->e;
}

/* Set the generalized force f of a joint of one coordinate: a couple about its axis, a force along its line, or along
 * its curve, where that acts at the curve. */
static void act_in_joint(const struct model_body *body, const struct tree_state *link, double f,
                         struct arrow *arrow)
{
    if (body->joint->has_axis)
        arrow->couple = f;
    else
        arrow->force = vec_scale(f, link->e);
    if (body->joint->path == path_curve) arrow->point = link->p;
}

static struct vec actuator_force(const struct fbd_model *model, const struct model_load *load,
                                 struct vec point, const struct instant *at)
{
    const double value = formula_value(&load->value, at);
    if (!load->source->guided) return pull_force(value, vec_sub(point, other_end(model, load, at).p));
    const struct vec ground = {1, 0};
    const struct vec turn =
        load->partner < 0 ? ground : body_pose(&model->bodies[load->partner], at).rotation;
    return guided_force(value, turn, vec_unit(load->source->along));
}

static void spring_arrow(const struct fbd_model *model, const struct model_load *load,
                         struct motion_of_point point, const struct instant *at, struct arrow *arrow)
{
    const struct load *source = load->source;
    const struct model_body *body = &model->bodies[load->body];
    if (load->linked) {
        struct motion_of_point end = other_end(model, load, at);
        struct link_law law = {{0, 0}, source->stiffness, source->free_length, source->coefficient};
        arrow->force =
            link_force(&law, (struct motion_of_point){vec_sub(point.p, end.p), vec_sub(point.v, end.v)});
        return;
    }
    double stretch = at->y[body->first] - source->free_length;
    act_in_joint(body, body_link(body, at),
                 -(source->stiffness * stretch + source->coefficient * at->y[body->first_rate]), arrow);
}

/* -dV/dq for each of the body's coordinates, in the directions of its joint; V is a function of the joint's
 * position. */
static void potential_arrow(const struct model_body *body, const struct model_load *load,
                            const struct instant *at, struct arrow *arrow)
{
    const struct tree_state *link = body_link(body, at);
    double f[most_coordinates_of_a_body] = {0};
    for (int k = 0; load->potential.expr && k < body->count; k++) {
        expr_eval_slot(load->potential.expr, at->t, at->y, 1 + body->first + k,
                       formula_branches(&load->potential, at), &f[k]);
        f[k] = -f[k];
    }
    if (body->count == 1) act_in_joint(body, link, f[0], arrow);
    if (body->count > 1) {
        arrow->force = vec_turn(link->e, (struct vec){f[0], f[1]});
        arrow->point = link->p;
        arrow->couple = f[2];
    }
}

/* Written in place: a copy would have to wait for the stores. */
static void pose_arrow(const struct fbd_model *model, int index, const struct pose *pose,
                       const struct instant *at, const double *slots, struct arrow *arrow)
{
    const struct model_load *load = &model->loads[index];
    const struct model_body *body = &model->bodies[load->body];
    const struct load *source = load->source;
    const struct tree_state *link = body_link(body, at);
    struct motion_of_point point = point_motion(body, pose, load->point);
    *arrow = (struct arrow){.name = source->name, .load = index, .point = load_place(load, point.p, at)};
    if (!is_there(at->tree, source->lifetime.number)) return;
    switch (source->kind) {
    case load_gravity: arrow->force = vec_scale(body_mass(body, at), model->scene->gravity); break;
    case load_drive:
        act_in_joint(body, link, -slots[model->plan.modes[body->drive_pair].hold_slot], arrow);
        break;
    case load_rope:
    case load_belt:
    case load_contact:
    case load_carried:
    case load_normal: break; /* a reaction: set from the sum of the others */
    case load_friction:
        act_in_joint(body, link, friction_at(model, body->friction, at, slots).force, arrow);
        break;
    case moment_friction: arrow->couple = friction_at(model, body->friction, at, slots).force; break;
    case load_applied: arrow->force = applied_force(load, pose, at); break;
    case load_spring:
    case load_damper: spring_arrow(model, load, point, at, arrow); break;
    case load_actuator: arrow->force = actuator_force(model, load, point.p, at); break;
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

struct arrow load_arrow(const struct fbd_model *model, int index, const struct instant *at,
                        const double *slots)
{
    struct pose pose = body_pose(&model->bodies[model->loads[index].body], at);
    struct arrow arrow;
    pose_arrow(model, index, &pose, at, slots, &arrow);
    return arrow;
}

/* ---- works */

static int account_of(const struct fbd_model *model, int b, const struct arrow *arrow)
{
    return arrow->load >= 0 ? arrow->load : rope_load(model, b, arrow);
}

int diagram_account(const struct fbd_model *model, int b, const struct arrow *arrows, size_t i)
{
    int load = account_of(model, b, &arrows[i]);
    for (size_t before = 0; load >= 0 && before < i; before++)
        if (account_of(model, b, &arrows[before]) == load) return -1;
    return load;
}

/* ---- generalized forces and reactions */

bool arrow_is_of_joint(const struct fbd_model *model, int b, const struct arrow *arrow)
{
    const struct model_body *body = &model->bodies[b];
    if (arrow->load < 0) return arrow->name == body->reaction;
    /* The normal force of a rolling body is not listed by it: no reaction of a joint, though its load is of
     * that kind. */
    bool listed = arrow->load >= body->first_load && arrow->load < body->first_load + body->load_count;
    return listed && model->loads[arrow->load].source->kind == load_normal;
}

/* The reaction of the joint is orthogonal to its coordinates. */
static void set_share(const struct fbd_model *model, int b, const struct instant *at, struct arrow *arrow)
{
    const struct model_body *body = &model->bodies[b];
    const struct tree_state *link = body_link(body, at);
    for (int k = 0; k < most_coordinates_of_a_body; k++) arrow->share[k] = 0;
    if (arrow_is_of_joint(model, b, arrow)) return;
    joint_shares(body->joint, link, (struct wrench){arrow_moment(arrow, link->p), arrow->force},
                 arrow->share);
}

/* By the velocity of the point and the angular velocity of the link. */
static double power_of(const struct model_body *body, const struct instant *at, const struct arrow *arrow)
{
    const struct tree_state *s = body_link(body, at);
    struct vec arm = vec_sub(arrow->point, s->p);
    struct vec v = vec_add(s->v, vec_scale(s->omega, vec_perp(arm)));
    return vec_dot(arrow->force, v) + arrow->couple * s->omega;
}

size_t diagram_list(const struct fbd_model *model, int index, const struct instant *at, const double *slots,
                    struct arrow *arrows)
{
    const struct model_body *body = &model->bodies[index];
    const struct pose pose = body_pose(body, at);
    size_t count = (size_t)body->load_count;
    for (size_t i = 0; i < count; i++)
        pose_arrow(model, body->first_load + (int)i, &pose, at, slots, &arrows[i]);
    return tree_diagram_add(model, index, at, slots, arrows);
}

bool load_is_of_motion(const struct fbd_model *model, int index)
{
    switch (model->loads[index].source->kind) {
    case load_drive:
    case load_rope:
    case load_belt:
    case load_contact:
    case load_normal:
    case load_friction:
    case moment_friction: return false;
    case load_carried:
    case load_gravity:
    case load_applied:
    case load_spring:
    case load_damper:
    case load_actuator:
    case load_drag:
    case load_potential:
    case moment_potential:
    case moment_applied:
    case moment_spring:
    case moment_damper: break;
    }
    return true;
}

double load_power(const struct fbd_model *model, int index, const struct instant *at, const double *slots)
{
    const struct model_load *load = &model->loads[index];
    const struct model_body *body = &model->bodies[load->body];
    struct arrow arrow = load_arrow(model, index, at, slots);
    double power = power_of(body, at, &arrow);
    if (load->in_joint && body->parent != ground_body)
        power -= power_of(&model->bodies[body->parent], at, &arrow);
    if (load->partner < 0) return power;
    arrow.point = other_end(model, load, at).p;
    return power - power_of(&model->bodies[load->partner], at, &arrow);
}

size_t diagram_fill(const struct fbd_model *model, int index, const struct instant *at, const double *slots,
                    struct arrow *arrows)
{
    const struct model_body *body = &model->bodies[index];
    size_t count = diagram_list(model, index, at, slots, arrows);
    for (size_t i = 0; i < count; i++) {
        set_share(model, index, at, &arrows[i]);
        arrows[i].power = power_of(body, at, &arrows[i]);
    }
    return count;
}

int diagram_work_column(const struct fbd_model *model, int b, const struct arrow *arrows, size_t i)
{
    int load = diagram_account(model, b, arrows, i);
    return load >= 0 && model->loads[load].body == b ? load : -1;
}
