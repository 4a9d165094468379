/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/forces.h"

#include <string.h>

#include "base/sine.h"
#include "dynamics/laws.h"

/* ---- terms of one coordinate */

/* s sin(q) + c cos(q); `turn` has both, or the term needs only one. */
static double sine_value(const struct sine_term *term, const double *q, bool turns, struct vec turn)
{
    if (turns) return term->s * turn.y + term->c * turn.x;
    return term->c == 0 ? term->s * sine(q[term->coordinate]) : term->c * cos(q[term->coordinate]);
}

static void simple_terms(const struct plan *plan, const struct body_terms *terms, const struct instant *at,
                         struct vec turn, double *slots)
{
    const double *q = at->y, *v = at->y + plan->n;
    const struct affine_term *affine = plan->affine + terms->affine.first;
    for (int i = 0; i < terms->affine.count; i++, affine++)
        slots[affine->slot] +=
            affine->c0 - affine->kq * q[affine->coordinate] - affine->kv * v[affine->coordinate];
    const struct sine_term *sine = plan->sine + terms->sine.first;
    for (int i = 0; i < terms->sine.count; i++, sine++)
        slots[sine->slot] += sine_value(sine, q, terms->turns, turn);
    const struct square_term *square = plan->square + terms->square.first;
    for (int i = 0; i < terms->square.count; i++, square++)
        slots[square->slot] -= square->k * fabs(v[square->coordinate]) * v[square->coordinate];
    if (terms->across.count > 0) {
        affine = plan->affine + terms->across.first;
        slots[affine->slot] += affine->c0;
    }
}

static void simple_variations(const struct plan *plan, const struct instant *at,
                              const struct direction *along, double *slots)
{
    const double *q = at->y, *v = at->y + plan->n, *dq = along->dy, *dv = along->dy + plan->n;
    for (size_t i = 0; i < plan->affine_count; i++) {
        const struct affine_term *term = &plan->affine[i];
        slots[term->slot] -= term->kq * dq[term->coordinate] + term->kv * dv[term->coordinate];
    }
    for (size_t i = 0; i < plan->sine_count; i++) {
        const struct sine_term *term = &plan->sine[i];
        double angle = q[term->coordinate];
        slots[term->slot] += (term->s * cos(angle) - term->c * sin(angle)) * dq[term->coordinate];
    }
    for (size_t i = 0; i < plan->square_count; i++) {
        const struct square_term *term = &plan->square[i];
        slots[term->slot] -= 2 * term->k * fabs(v[term->coordinate]) * dv[term->coordinate];
    }
}

/* ---- formulas in a fixed direction, potentials */

static void formula_terms(const struct plan *plan, const struct body_terms *terms, const struct instant *at,
                          double *slots)
{
    const struct formula_term *term = plan->formulas + terms->formulas.first;
    for (int i = 0; i < terms->formulas.count; i++, term++)
        slots[term->slot] += term->scale * formula_value(&term->value, at);
    const struct potential_term *potential = plan->potentials + terms->potentials.first;
    for (int i = 0; i < terms->potentials.count; i++, potential++) {
        double slope;
        expr_eval_slot(potential->V.expr, at->t, at->y, 1 + potential->coordinate,
                       formula_branches(&potential->V, at), &slope);
        slots[potential->slot] -= slope;
    }
}

/* d(dV/dq_i) = sum_j V_ij dq_j over all that V depends on, by hyper-dual numbers. */
static double slope_variation(const struct potential_term *term, const struct instant *at,
                              const struct direction *along)
{
    const int *branch = formula_branches(&term->V, at), *slots;
    size_t count = expr_variables(term->V.expr, &slots);
    double sum = 0, d_a, d_b, d_ab;
    for (size_t k = 0; k < count; k++) {
        double step = along->dy[slots[k] - 1];
        if (step == 0) continue;
        expr_eval_second(term->V.expr, at->t, at->y, 1 + term->coordinate, slots[k], branch, &d_a, &d_b,
                         &d_ab);
        sum += d_ab * step;
    }
    if (along->dt != 0 && expr_uses_time(term->V.expr)) {
        expr_eval_second(term->V.expr, at->t, at->y, 1 + term->coordinate, 0, branch, &d_a, &d_b, &d_ab);
        sum += d_ab * along->dt;
    }
    return sum;
}

static void formula_variations(const struct plan *plan, const struct instant *at,
                               const struct direction *along, double *slots)
{
    for (size_t i = 0; i < plan->formula_count; i++) {
        const struct formula_term *term = &plan->formulas[i];
        double variation;
        formula_along(&term->value, at, along, &variation);
        slots[term->slot] += term->scale * variation;
    }
    for (size_t i = 0; i < plan->potential_count; i++)
        slots[plan->potentials[i].slot] -= slope_variation(&plan->potentials[i], at, along);
}

/* ---- forces at points */

void add_force(const struct model_body *body, const struct pose *pose, struct motion_of_point point,
               struct vec f, double *own)
{
    switch (body->kind) {
    case motion_slide: own[0] += vec_dot(f, body->e); return;
    case motion_pivot: own[0] += vec_cross(vec_sub(point.p, pose->origin), f); return;
    case motion_planar: own[2] += vec_cross(vec_sub(point.p, pose->origin), f); break;
    case motion_particle: break;
    case motion_weld:
    case motion_track: return; /* jointed */
    }
    own[0] += f.x;
    own[1] += f.y;
}

static void add_to_slots(const struct model_body *body, const struct pose *pose, struct motion_of_point point,
                         struct vec f, double *slots)
{
    add_force(body, pose, point, f, slots + body->first);
    if (body->normal_slot >= 0) slots[body->normal_slot] += vec_dot(f, body->n);
}

/* The variation of the terms of add_to_slots: df at the point, and f with a varying arm about the origin. */
static void add_variation(const struct model_body *body, const struct pose *pose,
                          struct motion_of_point point, struct vec f, struct vec df,
                          const struct direction *along, struct motion_of_point d, double *slots)
{
    add_to_slots(body, pose, point, df, slots);
    if (body->kind == motion_pivot) slots[body->first] += vec_cross(d.p, f);
    if (body->kind == motion_planar) {
        const double *dq = along->dy + body->first;
        slots[body->first + 2] += vec_cross(vec_sub(d.p, (struct vec){dq[0], dq[1]}), f);
    }
}

static struct link_law law_of_link(const struct link_term *term)
{
    return (struct link_law){term->anchor, term->stiffness, term->free_length, term->damping};
}

/* The forces at points of one body: their sum and their moment about the frame's origin, or about the axis. */
struct resultant {
    struct vec f;
    double moment;
};

static void add_to_resultant(struct resultant *sum, const struct pose *pose, struct motion_of_point point,
                             struct vec f)
{
    sum->f = vec_add(sum->f, f);
    sum->moment += vec_cross(vec_sub(point.p, pose->origin), f);
}

static struct resultant sum_at_points(const struct fbd_model *model, int b, const struct instant *at,
                                      const struct pose *pose)
{
    const struct plan *plan = &model->plan;
    const struct body_terms *terms = &plan->bodies[b];
    const struct model_body *body = &model->bodies[b];
    struct resultant sum = {{0, 0}, 0};
    const struct link_term *link = plan->links + terms->links.first;
    for (int i = 0; i < terms->links.count; i++, link++) {
        struct motion_of_point point = point_motion(body, pose, link->point);
        struct link_law law = law_of_link(link);
        add_to_resultant(&sum, pose, point, link_force(&law, point));
    }
    const struct drag_term *drag = plan->drags + terms->drags.first;
    for (int i = 0; i < terms->drags.count; i++, drag++) {
        struct motion_of_point point = point_motion(body, pose, drag->point);
        struct drag_law law = {drag->linear, drag->quadratic};
        add_to_resultant(&sum, pose, point, drag_force(&law, point.v));
    }
    const struct force_term *force = plan->forces + terms->forces.first;
    for (int i = 0; i < terms->forces.count; i++, force++) {
        struct vec d = vec_unit(formula_value(&force->angle, at));
        if (force->body_frame) d = vec_turn(pose->rotation, d);
        struct vec f = vec_scale(formula_value(&force->value, at), d);
        add_to_resultant(&sum, pose, point_motion(body, pose, force->point), f);
    }
    return sum;
}

static void point_terms(const struct fbd_model *model, int b, const struct instant *at, struct vec turn,
                        double *slots)
{
    const struct model_body *body = &model->bodies[b];
    struct pose pose = body_pose_turned(body, at, turn);
    struct resultant sum = sum_at_points(model, b, at, &pose);
    double *own = slots + body->first;
    switch (body->kind) {
    case motion_slide:
        own[0] += vec_dot(sum.f, body->e);
        if (body->normal_slot >= 0) slots[body->normal_slot] += vec_dot(sum.f, body->n);
        return;
    case motion_pivot: own[0] += sum.moment; return;
    case motion_planar: own[2] += sum.moment; break;
    case motion_particle: break;
    case motion_weld:
    case motion_track: return; /* jointed */
    }
    own[0] += sum.f.x;
    own[1] += sum.f.y;
}

static void force_term_variation(const struct fbd_model *model, const struct force_term *term,
                                 const struct instant *at, const struct direction *along, double *slots)
{
    const struct model_body *body = &model->bodies[term->body];
    struct pose pose = body_pose(body, at);
    double d_angle, d_value;
    struct vec d = vec_unit(formula_along(&term->angle, at, along, &d_angle));
    double value = formula_along(&term->value, at, along, &d_value);
    if (term->body_frame) {
        int turn = body_angle_coordinate(body);
        d = vec_turn(pose.rotation, d);
        if (turn >= 0) d_angle += along->dy[turn];
    }
    struct vec f = vec_scale(value, d);
    struct vec df = vec_add(vec_scale(d_value, d), vec_scale(d_angle, vec_perp(f)));
    add_variation(body, &pose, point_motion(body, &pose, term->point), f, df, along,
                  point_variation(body, &pose, term->point, along), slots);
}

static void point_variations(const struct fbd_model *model, const struct instant *at,
                             const struct direction *along, double *slots)
{
    const struct plan *plan = &model->plan;
    for (size_t i = 0; i < plan->link_count; i++) {
        const struct model_body *body = &model->bodies[plan->links[i].body];
        struct pose pose = body_pose(body, at);
        struct motion_of_point point = point_motion(body, &pose, plan->links[i].point);
        struct motion_of_point d = point_variation(body, &pose, plan->links[i].point, along);
        struct link_law law = law_of_link(&plan->links[i]);
        add_variation(body, &pose, point, link_force(&law, point), link_variation(&law, point, d), along, d,
                      slots);
    }
    for (size_t i = 0; i < plan->drag_count; i++) {
        const struct model_body *body = &model->bodies[plan->drags[i].body];
        struct pose pose = body_pose(body, at);
        struct motion_of_point point = point_motion(body, &pose, plan->drags[i].point);
        struct motion_of_point d = point_variation(body, &pose, plan->drags[i].point, along);
        struct drag_law law = {plan->drags[i].linear, plan->drags[i].quadratic};
        add_variation(body, &pose, point, drag_force(&law, point.v), drag_variation(&law, point.v, d.v),
                      along, d, slots);
    }
    for (size_t i = 0; i < plan->force_count; i++)
        force_term_variation(model, &plan->forces[i], at, along, slots);
}

/* ---- all terms; an empty list costs a comparison */

void body_forces(const struct fbd_model *model, int b, const struct instant *at, struct vec turn,
                 double *slots)
{
    const struct body_terms *terms = &model->plan.bodies[b];
    const struct model_body *body = &model->bodies[b];
    for (int k = 0; k < body->count; k++) slots[body->first + k] = 0;
    if (body->normal_slot >= 0) slots[body->normal_slot] = 0;
    simple_terms(&model->plan, terms, at, turn, slots);
    if (terms->formulas.count + terms->potentials.count > 0) formula_terms(&model->plan, terms, at, slots);
    if (terms->at_points) point_terms(model, b, at, turn, slots);
}

void force_slots(const struct fbd_model *model, const struct instant *at, double *slots)
{
    memset(slots, 0, (size_t)model->plan.slots * sizeof *slots); /* jointed bodies have slots of their own */
    for (int b = 0; b < (int)model->body_count; b++)
        body_forces(model, b, at, body_turn(model, b, at), slots);
}

void force_slots_along(const struct fbd_model *model, const struct instant *at, const struct direction *along,
                       double *variation)
{
    const struct plan *plan = &model->plan;
    memset(variation, 0, (size_t)plan->slots * sizeof *variation);
    simple_variations(plan, at, along, variation);
    if (plan->formula_count + plan->potential_count > 0) formula_variations(plan, at, along, variation);
    if (plan->link_count + plan->drag_count + plan->force_count > 0)
        point_variations(model, at, along, variation);
}
