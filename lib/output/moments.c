/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/moments.h"

#include <math.h>
#include <string.h>

#include "dynamics/kinematics.h"
#include "model/tree.h"
#include "output/words.h"

static const double length_tolerance = 1e-12; /* relative round-off level of equal lengths */

const char *component_by_symbol(struct arena *arena, const char *symbol, const char *axis)
{
    if (strchr(symbol, ' ')) return arena_printf(arena, "(%s)_%s", symbol, axis);
    return arena_printf(arena, strchr(symbol, '_') ? "%s%s" : "%s_%s", symbol, axis);
}

/* R1 for R_1, to be used as an index. */
static const char *without_index_line(struct arena *arena, const char *symbol)
{
    char *text = arena_printf(arena, "%s", symbol), *to = text;
    for (const char *from = text; from && *from; from++)
        if (*from != '_') *to++ = *from;
    if (to) *to = '\0';
    return text;
}

/* ---- lengths */

static bool is_length(double a, double b)
{
    return fabs(a - b) <= length_tolerance * fabs(b);
}

/* True if the name is already that of a force, or used in a law. */
static bool is_taken(const struct formulas *formulas, const char *name)
{
    const struct fbd_model *model = formulas->state->model;
    static const char *const others[] = {"L", "g", "m", "c", "k"};
    if (strncmp(name, "L_", 2) == 0 || strncmp(name, "m_", 2) == 0) return true;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strcmp(name, others[i]) == 0) return true;
    for (size_t b = 0; b < model->body_count; b++)
        for (const struct force_symbol *s = formulas->symbols[b]; s->text; s++)
            if (strcmp(s->text, name) == 0) return true;
    return false;
}

/* The name of a positive length: that of a parameter, "(l/2)", or its value. */
static const char *length_name(struct formulas *formulas, double length)
{
    const struct scene *scene = formulas->state->model->scene;
    for (int part = 1; part <= 2; part++)
        for (size_t i = 0; i < scene->parameter_count; i++) {
            const struct parameter *p = &scene->parameters[i];
            if (p->input || !dim_equal(p->dim, DIM_LENGTH) || !is_length(part * length, p->value)) continue;
            if (is_taken(formulas, p->name)) continue;
            return arena_printf(&formulas->arena, part == 1 ? "%s" : "(%s/2)", p->name);
        }
    return arena_printf(&formulas->arena, "%.9g[%s]", length, length_unit(formulas->state->model));
}

/* ---- where a force acts */

bool ground_line_of_force(const struct fbd_model *model, int b, const char *name, struct vec *e)
{
    struct coupling_place place;
    if (!coupling_of_force(model, b, name, &place)) return false;
    const struct coupling *coupling = &model->tree->couplings[place.coupling];
    if (coupling->kind == constraint_roll && coupling->end[1].link == 0) *e = coupling->e;
    if (coupling->kind == constraint_roll) return coupling->end[1].link == 0;
    if (coupling->kind != constraint_contact || coupling->meeting < 0) return false;
    const struct meeting *meeting = &model->tree->meetings[coupling->meeting];
    for (int k = 0; k < 2; k++) {
        const struct contact_shape *shape = &meeting->shape[k];
        if (shape->kind != contact_line || shape->link != 0) continue;
        *e = shape->e;
        return true;
    }
    return false;
}

/* ---- the moment */

/* An arm with its components in axes that turn with the body, or in those of the world. */
struct arm {
    struct vec d;
    const char *angle; /* of those axes; NULL: those of the world */
};

const char *arm_name(struct formulas *formulas, int b, double d)
{
    const struct model_body *body = &formulas->state->model->bodies[b];
    return body->joint->has_axis && is_length(fabs(d), body->L) ? symbol_of_body(formulas, "L", b)
                                                                : length_name(formulas, fabs(d));
}

const char *angle_name(const struct formulas *formulas, int b)
{
    const struct fbd_model *model = formulas->state->model;
    const struct model_body *body = &model->bodies[b];
    if (body->joint->angle < 0) return "angle";
    const int coordinate = body->first + body->joint->angle;
    for (int k = 0; k < formulas->samples.count; k++) {
        const struct instant at = state_instant(formulas->samples.states[k]);
        if (fabs(at.y[coordinate] - body_angle(body, &at)) > 1e-9) return "angle";
    }
    return model->scene->coordinates[coordinate].name;
}

static bool can_turn(const struct fbd_model *model, const struct model_body *body)
{
    for (; body->joint->angle < 0 && body->joint->path != path_curve; body = &model->bodies[body->parent])
        if (body->parent == ground_body) return false;
    return true;
}

/* u cos(theta) - v sin(theta), or u sin(theta) + v cos(theta): a component of the arm in the world, times a
 * force along an axis of the world whose symbol has the sign of `force`. */
static const char *by_one_component(struct formulas *formulas, int b, const struct arm *arm,
                                    const char *symbol, double force, bool upright)
{
    struct arena *arena = &formulas->arena;
    const char *u = arm_name(formulas, b, arm->d.x), *v = arm_name(formulas, b, arm->d.y);
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

/* d_x F_y - d_y F_x where F has the components Fx and Fy; the same in axes that turn. */
static const char *by_components(struct formulas *formulas, int b, const struct arm *arm,
                                 const struct letter *letter)
{
    struct arena *arena = &formulas->arena;
    const double sign = letter->minus[0] ? -1 : 1;
    const char *x = component_by_symbol(arena, letter->vector, "x"),
               *y = component_by_symbol(arena, letter->vector, "y");
    const char *u = arm_name(formulas, b, arm->d.x), *v = arm_name(formulas, b, arm->d.y);
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

/* A force along an axis of the world is represented by its size, or its only component. */
static const char *by_arm(struct formulas *formulas, int b, const struct arm *arm, const struct acts *acts,
                          const struct letter *letter)
{
    const bool no_x = acts_never_along(acts, (struct vec){1, 0}),
               no_y = acts_never_along(acts, (struct vec){0, 1});
    if (!no_x && !no_y) return by_components(formulas, b, arm, letter);
    struct vec d;
    if (acts_along_line(acts, &d))
        return by_one_component(formulas, b, arm, letter->size, letter->sign * (no_x ? d.y : d.x), no_x);
    const char *component = component_by_symbol(&formulas->arena, letter->vector, no_x ? "y" : "x");
    return component ? by_one_component(formulas, b, arm, component, letter->minus[0] ? -1 : 1, no_x) : NULL;
}

/* At a point that moves in the body: by the coordinates of that point relative to the reference point. */
static const char *by_place(struct formulas *formulas, const struct acts *acts, const struct letter *letter)
{
    struct arena *arena = &formulas->arena;
    const bool no_x = acts_never_along(acts, (struct vec){1, 0}),
               no_y = acts_never_along(acts, (struct vec){0, 1});
    const char *x = component_by_symbol(arena, letter->vector, "x"),
               *y = component_by_symbol(arena, letter->vector, "y");
    const char *at = without_index_line(arena, letter->vector);
    struct vec d;
    double sign = letter->minus[0] ? -1 : 1;
    if (!x || !y || !at) return NULL;
    if (!no_x && !no_y) return arena_printf(arena, "%s(x_%s %s - y_%s %s)", letter->minus, at, y, at, x);
    if (acts_along_line(acts, &d)) {
        sign = letter->sign * (no_x ? d.y : d.x);
        x = y = letter->size;
    }
    if (no_y) sign = -sign;
    return arena_printf(arena, "%s%s_%s %s", sign < 0 ? "-" : "", no_x ? "x" : "y", at, no_x ? y : x);
}

static const char *of_force(struct formulas *formulas, const struct equation *equation,
                            const struct acts *acts, const struct letter *letter)
{
    const int b = equation->body;
    double lever;
    struct arm arm = {.angle = NULL};
    if (acts_never_about(acts)) return "";
    if (acts_on_lever(acts, &lever)) {
        const char *name = arm_name(formulas, b, lever), *minus = lever * letter->sign < 0 ? "-" : "";
        return name ? arena_printf(&formulas->arena, "%s%s %s", minus, name, letter->size) : NULL;
    }
    const bool turns = can_turn(formulas->state->model, &formulas->state->model->bodies[b]);
    if (turns && acts_at_place(acts, true, &arm.d)) arm.angle = angle_name(formulas, b);
    if (arm.angle || acts_at_place(acts, false, &arm.d)) return by_arm(formulas, b, &arm, acts, letter);
    return by_place(formulas, acts, letter);
}

const char *moment_by_arm(struct formulas *formulas, const struct equation *equation, const struct acts *acts,
                          bool moment, const struct letter *letter)
{
    struct arena *arena = &formulas->arena;
    double lever;
    if (moment && acts_on_lever(acts, &lever))
        return arena_printf(arena, "%s%s", lever * letter->sign < 0 ? "-" : "", letter->size);
    if (moment) return arena_printf(arena, "%s%s", letter->minus, letter->vector);
    if (strchr(letter->vector, '.'))
        return arena_printf(arena, "%sM_%c(%s)", letter->minus, equation->public.inertia_name[2],
                            letter->vector);
    if (!acts_as_couple(acts)) return of_force(formulas, equation, acts, letter);
    struct acts forces = *acts;
    for (int k = 0; k < forces.count; k++) forces.list[k].couple = 0;
    const char *force = of_force(formulas, equation, &forces, letter);
    const char *couple = arena_printf(arena, "%sM(%s)", letter->minus, letter->vector);
    if (!force || !couple || !force[0]) return force ? couple : NULL;
    const bool minus = force[0] == '-';
    return arena_printf(arena, "%s %s %s", couple, minus ? "-" : "+", force + minus);
}
