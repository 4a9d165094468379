/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/moments.h"

#include <math.h>
#include <string.h>

#include "dynamics/kinematics.h"
#include "model/tree.h"

static const double length_tolerance = 1e-12; /* relative, of lengths that are equal but for rounding */

const char *component_by_symbol(struct arena *arena, const char *symbol, const char *axis)
{
    if (strchr(symbol, ' ')) return arena_printf(arena, "(%s)_%s", symbol, axis);
    return arena_printf(arena, strchr(symbol, '_') ? "%s%s" : "%s_%s", symbol, axis);
}

/* ---- lengths */

static bool is_length(double a, double b)
{
    return fabs(a - b) <= length_tolerance * fabs(b);
}

/* Is it what a force is called, or the arm that a law names? */
static bool is_taken(const struct formulas *formulas, const char *name)
{
    const struct fbd_model *model = formulas->state->model;
    static const char *const others[] = {"L", "g", "m", "c", "k"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcmp(name, others[i]) == 0) return true;
    for (size_t b = 0; b < model->body_count; b++)
        for (const struct force_symbol *s = formulas->symbols[b]; s->text; s++)
            if (strcmp(s->text, name) == 0) return true;
    return false;
}

/* The name of a length above zero: that of a parameter, "l/2", or its number. */
static const char *length_name(struct formulas *formulas, double length)
{
    const struct scene *scene = formulas->state->model->scene;
    for (int part = 1; part <= 2; part++)
        for (size_t i = 0; i < scene->parameter_count; i++) {
            const struct parameter *p = &scene->parameters[i];
            if (p->input || !dim_equal(p->dim, DIM_LENGTH) || !is_length(part * length, p->value)) continue;
            if (is_taken(formulas, p->name)) continue;
            return arena_printf(&formulas->arena, part == 1 ? "%s" : "%s/2", p->name);
        }
    return arena_printf(&formulas->arena, "%.9g", length);
}

/* ---- where a force acts */

/* The tie whose force on body b is called so, and its end there; NULL for none. */
static const struct tie *tie_of(const struct fbd_model *model, int b, const char *name, int *end)
{
    struct tie_place place;
    if (!tie_of_force(model, b, name, &place)) return NULL;
    *end = place.end;
    return &model->tree->ties[place.tie];
}

/* The body in whose joint the reaction acts: b, or one that it carries. */
static int joint_of(const struct fbd_model *model, int b, const char *name)
{
    for (size_t c = 0; c < model->body_count; c++) {
        const struct model_body *child = &model->bodies[c];
        if (child->parent == b && child->reaction_on_parent && strcmp(name, child->reaction_on_parent) == 0)
            return (int)c;
    }
    return b;
}

/* Does the force act at one point of the body at all times? */
static bool at_fixed_point(const struct fbd_model *model, int b, const struct arrow *arrow)
{
    int end;
    const struct tie *tie = tie_of(model, b, arrow->name, &end);
    if (tie)
        return tie->kind == constraint_pin || tie->kind == constraint_rod ||
               (tie->kind == constraint_rope && tie->end[end].radius == 0);
    if (arrow->load < 0) return model->bodies[joint_of(model, b, arrow->name)].kind == motion_pivot;
    const struct load *load = model->loads[arrow->load].source;
    switch (load->kind) {
    case load_applied:
    case load_spring:
    case load_damper:
    case load_drag: return !load_is_placed(load);
    default: return false;
    }
}

/* The radius of the disc at whose rim a tie acts on body b, else 0. */
static double rim_of(const struct fbd_model *model, int b, const char *name, const struct tie **tie)
{
    int end;
    *tie = tie_of(model, b, name, &end);
    if (!*tie) return 0;
    if ((*tie)->kind != constraint_contact) return fabs((*tie)->end[end].radius);
    if ((*tie)->meeting < 0) return 0;
    const struct meeting *meeting = &model->tree->meetings[(*tie)->meeting];
    for (int k = 0; k < 2; k++)
        if (meeting->shape[k].link == model->bodies[b].place.link && meeting->shape[k].kind == contact_disc)
            return meeting->shape[k].radius;
    return 0;
}

bool ground_line_of_force(const struct fbd_model *model, int b, const char *name, struct vec *e)
{
    int end;
    const struct tie *tie = tie_of(model, b, name, &end);
    if (!tie) return false;
    *e = tie->e;
    if (tie->kind == constraint_roll) return tie->end[1].link == 0;
    if (tie->kind != constraint_contact || tie->meeting < 0) return false;
    const struct meeting *meeting = &model->tree->meetings[tie->meeting];
    for (int k = 0; k < 2; k++) {
        const struct contact_shape *shape = &meeting->shape[k];
        *e = shape->e;
        if (shape->kind == contact_line && shape->link == 0) return true;
    }
    return false;
}

/* ---- the moment */

/* An arm with its components in axes that turn with the body, or in those of the world. */
struct arm {
    struct vec d;
    const char *angle; /* of those axes; NULL: those of the world */
};

static const char *arm_name(struct formulas *formulas, const struct model_body *body, double d)
{
    return is_length(fabs(d), body->L) ? "L" : length_name(formulas, fabs(d));
}

/* Is the angle of the body in the world its coordinate? */
static const char *angle_name(const struct fbd_model *model, const struct model_body *body,
                              const struct instant *at)
{
    if (body->kind != motion_pivot && body->kind != motion_planar) return "angle";
    for (int p = body->parent; p != ground_body; p = model->bodies[p].parent)
        if (model->bodies[p].kind != motion_slide && model->bodies[p].kind != motion_particle) return "angle";
    const int coordinate = body->first + body->count - 1;
    return at->y[coordinate] == body_angle(body, at) ? model->scene->coordinates[coordinate].name : "angle";
}

static bool can_turn(const struct fbd_model *model, const struct model_body *body)
{
    for (; body->kind == motion_slide || body->kind == motion_particle || body->kind == motion_weld;
         body = &model->bodies[body->parent])
        if (body->parent == ground_body) return false;
    return true;
}

static struct arm arm_of(const struct fbd_model *model, const struct model_body *body,
                         const struct instant *at, struct vec from, struct vec to)
{
    struct vec d = vec_sub(to, from);
    const double size = length_tolerance * (vec_norm(d) + vec_norm(to));
    struct arm arm = {.d = d};
    if (can_turn(model, body)) {
        const struct vec turn = body_pose(body, at).rotation;
        arm.d = (struct vec){vec_dot(turn, d), vec_cross(turn, d)};
        arm.angle = angle_name(model, body, at);
    }
    if (fabs(arm.d.x) <= size) arm.d.x = 0;
    if (fabs(arm.d.y) <= size) arm.d.y = 0;
    return arm;
}

/* u cos(theta) - v sin(theta), or u sin(theta) + v cos(theta): a component of the arm in the world, times a force. */
static const char *by_one_component(struct formulas *formulas, const struct model_body *body,
                                    const struct arm *arm, const char *symbol, double force, bool upright)
{
    struct arena *arena = &formulas->arena;
    const char *u = arm_name(formulas, body, arm->d.x), *v = arm_name(formulas, body, arm->d.y);
    if (!u || !v) return NULL;
    /* d_x F_y, or -d_y F_x */
    const double U = upright ? force * arm->d.x : -force * arm->d.x, V = -force * arm->d.y;
    const char *first = upright ? "cos" : "sin", *second = upright ? "sin" : "cos";
    if (!arm->angle) {
        const double d = upright ? U : V;
        if (d == 0) return "";
        return arena_printf(arena, "%s%s %s", d < 0 ? "-" : "", upright ? u : v, symbol);
    }
    if (V == 0) return arena_printf(arena, "%s%s %s %s(%s)", U < 0 ? "-" : "", u, symbol, first, arm->angle);
    if (U == 0) return arena_printf(arena, "%s%s %s %s(%s)", V < 0 ? "-" : "", v, symbol, second, arm->angle);
    return arena_printf(arena, "%s%s (%s %s(%s) %c %s %s(%s))", U < 0 ? "-" : "", symbol, u, first,
                        arm->angle, (U < 0) == (V < 0) ? '+' : '-', v, second, arm->angle);
}

/* d_x F_y - d_y F_x where F has the components Fx and Fy, and so with axes that turn. */
static const char *by_components(struct formulas *formulas, const struct model_body *body,
                                 const struct arm *arm, const char *symbol, double sign)
{
    struct arena *arena = &formulas->arena;
    const char *x = component_by_symbol(arena, symbol, "x"), *y = component_by_symbol(arena, symbol, "y");
    const char *u = arm_name(formulas, body, arm->d.x), *v = arm_name(formulas, body, arm->d.y);
    if (!x || !y || !u || !v) return NULL;
    const char *across = y, *along = x;
    if (arm->angle) {
        across = arena_printf(arena, "(%s cos(%s) - %s sin(%s))", y, arm->angle, x, arm->angle);
        along = arena_printf(arena, "(%s cos(%s) + %s sin(%s))", x, arm->angle, y, arm->angle);
    }
    const double dx = sign * arm->d.x, dy = -sign * arm->d.y;
    if (!across || !along) return NULL;
    if (dy == 0) return arena_printf(arena, "%s%s %s", dx < 0 ? "-" : "", u, across);
    if (dx == 0) return arena_printf(arena, "%s%s %s", dy < 0 ? "-" : "", v, along);
    return arena_printf(arena, "%s(%s %s %c %s %s)", dx < 0 ? "-" : "", u, across,
                        (dx < 0) == (dy < 0) ? '+' : '-', v, along);
}

/* At one state a force along an axis of the world is its symbol alone. */
static const char *by_arm(struct formulas *formulas, const struct model_body *body, const struct arm *arm,
                          const struct arrow *arrow, const char *symbol, double sign)
{
    const struct vec F = arrow->force;
    const double zero = length_tolerance * vec_norm(F);
    if (!formulas->general && fabs(F.x) <= zero)
        return by_one_component(formulas, body, arm, symbol, F.y, true);
    if (!formulas->general && fabs(F.y) <= zero)
        return by_one_component(formulas, body, arm, symbol, F.x, false);
    return strchr(symbol, ' ') ? "" : by_components(formulas, body, arm, symbol, sign);
}

const char *moment_by_arm(struct formulas *formulas, const struct equation *equation,
                          const struct arrow *arrow, const char *symbol, double sign)
{
    const struct fbd_model *model = formulas->state->model;
    const struct model_body *body = &model->bodies[equation->body];
    const struct instant at = state_instant(formulas->state);
    const struct pose pose = body_pose(body, &at);
    const bool about_axis = equation->public.inertia_name[2] == 'O';
    const struct vec about = about_axis ? pose.origin : point_motion(body, &pose, body->inertia.G).p;
    if (arrow->couple != 0 || strchr(symbol, '.')) return "";
    const struct tie *tie;
    const double r = rim_of(model, equation->body, arrow->name, &tie), moment = arrow_moment(arrow, about);
    const double size = r * vec_norm(arrow->force);
    const bool pulls = tie && (tie->kind == constraint_rope || tie->law->strands);
    const bool meets = tie && tie->kind == constraint_contact && r == 0 && !formulas->general;
    if (at_fixed_point(model, equation->body, arrow) || meets) {
        const struct arm arm = arm_of(model, body, &at, about, arrow->point);
        return arm.d.x == 0 && arm.d.y == 0 ? "" : by_arm(formulas, body, &arm, arrow, symbol, sign);
    }
    if (size == 0 || fabs(fabs(moment) - size) > 1e-9 * size || (formulas->general && !pulls)) return "";
    const char *name = length_name(formulas, r);
    return name ? arena_printf(&formulas->arena, "%s%s %s", moment < 0 ? "-" : "", name, symbol) : NULL;
}
