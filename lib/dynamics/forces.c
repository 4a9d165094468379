/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/forces.h"

#include <string.h>

#include "dynamics/laws.h"

/* ---- terms of one coordinate */

static void simple_terms(const struct plan *plan, const struct instant *at, double *slots)
{
    const double *q = at->y, *v = at->y + plan->n;
    for (size_t i = 0; i < plan->affine_count; i++) {
        const struct affine_term *term = &plan->affine[i];
        slots[term->slot] += term->c0 - term->kq * q[term->coordinate] - term->kv * v[term->coordinate];
    }
    for (size_t i = 0; i < plan->sine_count; i++) {
        const struct sine_term *term = &plan->sine[i];
        double angle = q[term->coordinate];
        slots[term->slot] += term->s * sin(angle) + term->c * cos(angle);
    }
    for (size_t i = 0; i < plan->square_count; i++) {
        const struct square_term *term = &plan->square[i];
        slots[term->slot] -= term->k * fabs(v[term->coordinate]) * v[term->coordinate];
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

static void formula_terms(const struct plan *plan, const struct instant *at, double *slots)
{
    for (size_t i = 0; i < plan->formula_count; i++) {
        const struct formula_term *term = &plan->formulas[i];
        slots[term->slot] += term->scale * formula_value(&term->value, at);
    }
    for (size_t i = 0; i < plan->potential_count; i++) {
        const struct potential_term *term = &plan->potentials[i];
        double slope;
        expr_eval_slot(term->V.expr, at->t, at->y, 1 + term->coordinate, formula_branches(&term->V, at),
                       &slope);
        slots[term->slot] -= slope;
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
    case motion_weld: return;
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

/* The variation of what add_to_slots adds: df at the point, and f on an arm that varies by the motion of the
 * point about the origin. */
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

static void point_terms(const struct fbd_model *model, const struct instant *at, double *slots)
{
    const struct plan *plan = &model->plan;
    for (size_t i = 0; i < plan->link_count; i++) {
        const struct model_body *body = &model->bodies[plan->links[i].body];
        struct pose pose = body_pose(body, at);
        struct motion_of_point point = point_motion(body, &pose, plan->links[i].point);
        struct link_law law = law_of_link(&plan->links[i]);
        add_to_slots(body, &pose, point, link_force(&law, point), slots);
    }
    for (size_t i = 0; i < plan->drag_count; i++) {
        const struct model_body *body = &model->bodies[plan->drags[i].body];
        struct pose pose = body_pose(body, at);
        struct motion_of_point point = point_motion(body, &pose, plan->drags[i].point);
        struct drag_law law = {plan->drags[i].linear, plan->drags[i].quadratic};
        add_to_slots(body, &pose, point, drag_force(&law, point.v), slots);
    }
    for (size_t i = 0; i < plan->force_count; i++) {
        const struct force_term *term = &plan->forces[i];
        const struct model_body *body = &model->bodies[term->body];
        struct pose pose = body_pose(body, at);
        struct vec d = vec_unit(formula_value(&term->angle, at));
        if (term->body_frame) d = vec_turn(pose.rotation, d);
        struct vec f = vec_scale(formula_value(&term->value, at), d);
        add_to_slots(body, &pose, point_motion(body, &pose, term->point), f, slots);
    }
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

/* ---- all of them; lists that a scene does not fill cost a comparison */

void force_slots(const struct fbd_model *model, const struct instant *at, double *slots)
{
    const struct plan *plan = &model->plan;
    memset(slots, 0, (size_t)plan->slots * sizeof *slots);
    simple_terms(plan, at, slots);
    if (plan->formula_count + plan->potential_count > 0) formula_terms(plan, at, slots);
    if (plan->link_count + plan->drag_count + plan->force_count > 0) point_terms(model, at, slots);
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
