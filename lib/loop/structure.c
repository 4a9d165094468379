/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/structure.h"

#include "integrate/linear.h"
#include "integrate/nystrom.h"
#include "integrate/parabola.h"

/* Methods for structures are not in the table of method.h, so that they cannot be selected: for a scene
 * without the structure they would give wrong results. */
static const struct method nystrom_method = {.name = "nystrom",
                                             .description =
                                                 "explicit Runge-Kutta-Nystrom, Dormand-El-Mikkawy-Prince "
                                                 "12(10), dense output of order 10",
                                             .type = &step_nystrom,
                                             .order = 12,
                                             .estimate_order = 11};

static const struct method parabola_method = {.name = "parabola",
                                              .description = "the exact motion under constant accelerations",
                                              .type = &step_parabola,
                                              .order = 8,
                                              .estimate_order = 8,
                                              .exact = true};

static const struct method linear_method = {.name = "linear",
                                            .description = "the exact motion of linear equations",
                                            .type = &step_linear,
                                            .order = 8,
                                            .estimate_order = 8,
                                            .exact = true};

const struct method *structure_method(const struct fbd_model *model, enum structure structure)
{
    switch (structure) {
    case structure_velocity_free: return &nystrom_method;
    case structure_linear: return &linear_method;
    case structure_fixed:
    case structure_constant: return &parabola_method;
    case structure_general:
    case structure_flights:
    case structure_kinds: break;
    }
    return model->plan.own > 0 ? method_find("dop853") : method_at(0);
}

/* ---- velocities */

/* Is a slot a velocity? Those above n are rates, above 2 n user states, then world positions and velocities. */
static bool is_rate(const struct fbd_model *model, int slot)
{
    int n = model->plan.n, size = (int)plan_size(&model->plan);
    if (slot <= size) return slot > n && slot <= 2 * n;
    if (slot_is_constant(model, slot)) return false;
    enum absolute_kind kind = model->absolutes[slot - 1 - size - hand_slots].kind;
    return kind != absolute_x && kind != absolute_y && kind != absolute_angle;
}

static bool reads_rate(const struct fbd_model *model, const struct value *value)
{
    const int *slots;
    size_t count = value->expr ? expr_variables(value->expr, &slots) : 0;
    for (size_t i = 0; i < count; i++)
        if (is_rate(model, slots[i])) return true;
    return false;
}

/* Slipping friction has the sign of its mode, and depends on the velocity through its coefficients only; in a journal
 * bearing also through the reaction. */
static bool depends_on_velocity(const struct fbd_model *model, const struct load *load)
{
    enum law_rate rate = load_law(load)->rate;
    if (rate != rate_by_formulas) return rate == rate_always;
    if (load->journal) return true;
    struct load copy = *load;
    struct value *formulas[most_formulas_of_a_load];
    load_formulas(&copy, formulas);
    for (size_t k = 0; k < most_formulas_of_a_load; k++)
        if (reads_rate(model, formulas[k])) return true;
    return false;
}

/* Does a body move on another one, or is there a coupling? Then there are Coriolis forces, and a mass matrix
 * that varies. */
static bool has_joints(const struct fbd_model *model)
{
    if (model->scene->constraint_count > 0) return true;
    for (size_t b = 0; b < model->body_count; b++)
        if (model->bodies[b].parent != ground_body) return true;
    return false;
}

/* On a track the normal force grows with v^2, and so does its friction, and the moment that turns the body
 * with the track. */
static bool is_pressed_by_speed(const struct model_body *body)
{
    return body->joint->path == path_curve && (body->friction >= 0 || body->inertia.I_G > 0 || body->L > 0);
}

static bool velocity_free(const struct fbd_model *model)
{
    if (has_joints(model)) return false;
    for (size_t b = 0; b < model->body_count; b++)
        if (body_is_off_center(&model->bodies[b]) || is_pressed_by_speed(&model->bodies[b])) return false;
    for (size_t i = 0; i < model->load_count; i++)
        if (depends_on_velocity(model, model->loads[i].source)) return false;
    return true;
}

/* ---- how the accelerations vary */

static enum expr_degree worse(enum expr_degree a, enum expr_degree b)
{
    return a > b ? a : b;
}

/* The degree of an expression. World positions are no coordinates, and need not be linear in them. */
static enum expr_degree degree_of(const struct fbd_model *model, const struct value *value)
{
    return value->expr ? expr_degree(value->expr, 2 * model->plan.n, model->constant_slots)
                       : expr_constant_between;
}

/* An applied force, by its components along the body's coordinates. Its moment about the frame's origin or
 * the axis varies with the rotation unless both the force and its point rotate with the body, or the point is
 * that origin. */
static enum expr_degree degree_of_applied(const struct fbd_model *model, const struct model_body *body,
                                          const struct model_load *load)
{
    const struct load *source = load->source;
    enum expr_degree size = worse(degree_of(model, &source->value),
                                  worse(degree_of(model, &source->fx), degree_of(model, &source->fy)));
    if (degree_of(model, &source->angle) != expr_constant_between) return expr_nonlinear;
    const struct joint_type *joint = body->joint;
    if (joint->angle >= 0) size = worse(size, degree_of(model, &source->couple));
    if (joint->count == 0 || joint->path == path_curve) return expr_nonlinear;
    /* Across the line, a force that varies changes the friction as well. */
    if (size != expr_constant_between && body->friction >= 0 && joint->path == path_line &&
        (source->angle.expr || source->fx.expr))
        return expr_nonlinear;
    if (joint->angle < 0) return size;
    if (joint->has_axis) return source->body_frame ? size : expr_nonlinear;
    bool at_origin = load->point.x == 0 && load->point.y == 0;
    return !source->body_frame && at_origin ? size : expr_nonlinear;
}

/* Gravity acts at G, which moves about the axis of a pivot or the origin of a frame. */
static enum expr_degree degree_of_gravity(const struct model_body *body)
{
    bool turns = body->joint->angle >= 0;
    return turns && (body->arm.x != 0 || body->arm.y != 0) ? expr_nonlinear : expr_constant_between;
}

/* Friction in a mode is a constant force if its normal force is constant, which the degrees of the loads
 * across the line ensure, and so are its coefficients. */
static enum expr_degree degree_of_friction(const struct fbd_model *model, const struct load *load)
{
    const struct expr *speed = load->surface_speed.expr;
    bool constant = degree_of(model, &load->mu_s) == expr_constant_between &&
                    degree_of(model, &load->mu_k) == expr_constant_between &&
                    (!speed || expr_is_constant(speed));
    return constant && !load->journal ? expr_constant_between : expr_nonlinear;
}

/* A spring or damper along the body's coordinate; between two points only the spring without free length on a
 * particle, f = -k (p - A), is linear. */
static enum expr_degree degree_of_link(const struct model_body *body, const struct model_load *load)
{
    if (!load->linked) return expr_affine;
    bool linear = load->source->kind == load_spring && load->source->free_length == 0 &&
                  load->partner == ground_body && body->count == 2;
    return linear ? expr_affine : expr_nonlinear;
}

/* Linear drag on a body of one coordinate (the point keeps its distance from the axis), or that cannot turn,
 * or at the origin of its frame. */
static enum expr_degree degree_of_drag(const struct fbd_model *model, const struct model_body *body,
                                       const struct model_load *load)
{
    bool at_origin = load->point.x == 0 && load->point.y == 0;
    bool keeps_distance = body->joint->has_axis || body->joint->angle < 0 || at_origin;
    bool linear = load->source->quadratic == 0 && keeps_distance;
    enum expr_degree still = linear ? expr_affine : expr_nonlinear;
    return load_has_wind(load->source) ? worse(still, degree_of_applied(model, body, load)) : still;
}

/* The degree of a load's contribution to the accelerations of its body between events. Normal forces vary as
 * the loads that they balance: see accelerations_vary. */
static enum expr_degree degree_of_load(const struct fbd_model *model, const struct model_body *body,
                                       const struct model_load *load)
{
    const struct load *source = load->source;
    switch (source->kind) {
    case load_gravity: return degree_of_gravity(body);
    case load_normal: return expr_constant_between;
    case load_friction:
    case moment_friction: return degree_of_friction(model, source);
    case load_applied: return degree_of_applied(model, body, load);
    case moment_applied: return degree_of(model, &source->value);
    case load_spring:
    case load_damper: return degree_of_link(body, load);
    case load_drag: return degree_of_drag(model, body, load);
    case moment_spring:
    case moment_damper: return expr_affine;
    case load_actuator:
    case load_rope:
    case load_belt:
    case load_carried:
    case load_contact:
    case load_drive:
    case load_potential:
    case moment_potential: break;
    }
    return expr_nonlinear;
}

bool structure_keeps_force(const struct fbd_model *model, const struct model_load *load)
{
    return degree_of_load(model, &model->bodies[load->body], load) == expr_constant_between;
}

/* With all contacts open, if `open`. */
static enum expr_degree accelerations_vary(const struct fbd_model *model, bool open)
{
    enum expr_degree worst = expr_constant_between;
    if (!open && has_joints(model)) return expr_nonlinear;
    for (size_t b = 0; b < model->body_count; b++)
        if (body_is_off_center(&model->bodies[b]) || model->bodies[b].joint->path == path_curve)
            return expr_nonlinear;
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (open && load->source->kind == load_contact) continue;
        worst = worse(worst, degree_of_load(model, &model->bodies[load->body], load));
    }
    return worst;
}

/* In a Filippov sliding mode the accelerations keep the motion on the surface: they are linear if the
 * switching function is. */
static enum expr_degree slides_vary(const struct fbd_model *model)
{
    enum expr_degree worst = expr_constant_between;
    for (size_t i = 0; i < model->plan.kink_count; i++) {
        const struct kink *kink = &model->plan.kinks[i];
        const struct expr *expr = kink->formula.expr;
        for (size_t part = 0; kink->slides && part < kink->count; part++) {
            /* On a switch that depends on positions the accelerations vary as the forces do. */
            if (!expr_switch_jumps(expr, part) || kink_watches_places(kink, (int)part)) continue;
            worst = worse(worst, worse(expr_affine, expr_switch_degree(expr, part, 2 * model->plan.n,
                                                                       model->constant_slots)));
        }
    }
    return worst;
}

/* Is every coupling a contact between bodies that are not jointed? */
static bool has_contacts_only(const struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    for (int i = 0; i < tree->coupling_count; i++)
        if (tree->couplings[i].kind != constraint_contact) return false;
    for (int i = 1; i < tree->count; i++)
        if (tree->links[i].parent != 0) return false;
    return tree->coupling_count > 0;
}

enum structure structure_of(const struct fbd_model *model)
{
    if (model->plan.own > 0) return structure_general; /* exact methods have no user states */
    enum expr_degree slides = slides_vary(model), degree = worse(accelerations_vary(model, false), slides);
    if (degree == expr_constant_between) return structure_constant;
    if (degree == expr_affine && model->plan.n <= linear_most_pairs) return structure_linear;
    if (velocity_free(model)) return structure_velocity_free;
    const bool flights =
        has_contacts_only(model) && worse(accelerations_vary(model, true), slides) == expr_constant_between;
    return flights ? structure_flights : structure_general;
}
