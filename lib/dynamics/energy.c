/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/energy.h"

#include "dynamics/mass.h"
#include "dynamics/tree.h"
#include "expr/pieces.h"
#include "numeric/quadrature.h"
#include "numeric/tolerances.h"

#include <string.h>

double kinetic_energy(const struct model_body *body, const struct instant *at)
{
    double m = body->inertia.mass;
    struct pose pose = body_pose(body, at);
    struct vec v_G = point_motion(body, &pose, body->inertia.G).v;
    return body_share(body, at) * (m * vec_dot(v_G, v_G) + body->inertia.I_G * pose.omega * pose.omega) / 2;
}

double total_kinetic_energy(struct fbd_state *state)
{
    struct instant at = state_instant(state);
    tree_move(state->model, &at);
    return standing_kinetic_energy(state);
}

double standing_kinetic_energy(struct fbd_state *state)
{
    struct instant at = state_instant(state);
    double sum = 0;
    for (size_t b = 0; b < state->model->body_count; b++)
        sum += kinetic_energy(&state->model->bodies[b], &at);
    return sum;
}

/* ---- V by quadrature */

struct integrand {
    const struct model_body *body;
    const struct model_load *load;
    struct instant at;
    double *y; /* scratch: a state whose coordinate is varied */
};

/* The pose of a body of one coordinate on the ground at that coordinate, also if jointed: the tree holds the
 * present pose only. */
static struct pose pose_at(const struct model_body *body, const struct instant *at)
{
    const double q = at->y[body->first], v = at->y[body->first_rate];
    if (body->joint->has_axis) return (struct pose){body->origin, vec_unit(q), {0, 0}, v};
    return (struct pose){vec_add(body->origin, vec_scale(q, body->e)), body->e, vec_scale(v, body->e), 0};
}

/* The generalized force of an applied force on such a body. */
static double share_of(const struct model_body *body, const struct model_load *load, const struct pose *pose,
                       const struct instant *at)
{
    const struct vec f = applied_force(load, pose, at);
    const struct vec arm = vec_sub(point_motion(body, pose, load->point).p, pose->origin);
    return body->joint->has_axis ? vec_cross(arm, f) : vec_dot(f, body->e);
}

/* The generalized force of a load that depends on one coordinate only. */
static double force_at(double q, void *context)
{
    struct integrand *integrand = context;
    const struct model_body *body = integrand->body;
    const struct model_load *load = integrand->load;
    const struct load *source = load->source;
    integrand->y[body->first] = q;
    if (source->kind == moment_applied) return formula_value(&load->value, &integrand->at);
    struct pose pose = pose_at(body, &integrand->at);
    return share_of(body, load, &pose, &integrand->at);
}

/* Integrate each piece of the formulas, so that no pulse is missed. NAN if the relative error is too large. */
static double integrate(struct integrand *integrand, double from, double to)
{
    enum { most_halves = 2000, most_pieces = 1000 };
    const struct model_load *load = integrand->load;
    const struct expr *formulas[4],
        *all[] = {load->value.expr, load->angle.expr, load->fx.expr, load->fy.expr};
    size_t count = 0;
    double ends[most_pieces + 1];
    if (!isfinite(to - from)) return (double)NAN;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i]) formulas[count++] = all[i];
    int pieces = pieces_cut(formulas, count, integrand->body->first + 1, from, to, most_pieces, ends);
    if (pieces == pieces_no_memory) return (double)NAN;
    if (pieces == pieces_too_many) ends[1] = to;
    gsl_function function = {force_at, integrand};
    struct quadrature sum = quadrature_over(&function, ends, pieces > 0 ? pieces : 1, most_halves);
    return sum.error <= undecided_part * sum.size ? sum.integral : (double)NAN;
}

static double by_quadrature(const struct fbd_model *model, const struct model_load *load,
                            const struct instant *at, double *scratch)
{
    const struct model_body *body = &model->bodies[load->body];
    double from = load->reference, to = at->y[body->first];
    struct integrand integrand = {body, load, *at, scratch};
    memset(scratch, 0, plan_size(&model->plan) * sizeof *scratch);
    integrand.at.y = scratch;
    integrand.at.branch = NULL; /* plain values: the integral crosses kinks */
    integrand.at.sliding = NULL;
    if (from == to) return 0;
    return from < to ? -integrate(&integrand, from, to) : integrate(&integrand, to, from);
}

/* ---- V of a load */

/* The place of the force of a guided actuator, as a point of the body at its other end. */
static struct motion_of_point guided_end(const struct fbd_model *model, const struct model_load *load,
                                         const struct instant *at)
{
    const struct model_body *body = &model->bodies[load->body];
    const struct pose pose = body_pose(body, at);
    const struct vec p = point_motion(body, &pose, load->point).p;
    if (load->partner < 0) return (struct motion_of_point){p, {0, 0}};
    const struct pose on = body_pose(&model->bodies[load->partner], at);
    return (struct motion_of_point){p, vec_add(on.velocity,
                                               vec_scale(on.omega, vec_perp(vec_sub(p, on.origin))))};
}

struct motion_of_point other_end(const struct fbd_model *model, const struct model_load *load,
                                 const struct instant *at)
{
    if (load->source->guided) return guided_end(model, load, at);
    if (load->partner < 0) return (struct motion_of_point){load->anchor, {0, 0}};
    const struct model_body *partner = &model->bodies[load->partner];
    struct pose pose = body_pose(partner, at);
    return point_motion(partner, &pose, load->anchor);
}

static double constant_force_potential(const struct model_body *body, const struct model_load *load,
                                       const struct pose *pose, const struct instant *at)
{
    struct vec f = applied_force(load, pose, at);
    return -vec_dot(f, point_motion(body, pose, load->point).p);
}

/* The constant generalized force of the load. */
static double linear_potential(const struct model_body *body, const struct model_load *load,
                               const struct pose *pose, const struct instant *at)
{
    if (load->source->kind == moment_applied) return -formula_value(&load->value, at) * body_angle(body, at);
    return -share_of(body, load, pose, at) * at->y[body->first];
}

double potential_energy(const struct fbd_model *model, const struct model_load *load,
                        const struct instant *at, double *scratch)
{
    const struct model_body *body = &model->bodies[load->body];
    const struct load *source = load->source;
    if (!is_there(at->tree, source->lifetime.number)) return 0;
    struct pose pose = body_pose(body, at);
    switch (load->potential_kind) {
    case potential_none:
    case potential_workless: return 0;
    case potential_gravity: {
        struct vec height = point_motion(body, &pose, body->inertia.G).p;
        height.y -= model->scene->datum;
        return -body->inertia.mass * vec_dot(model->scene->gravity, height);
    }
    case potential_spring: {
        double stretch = at->y[body->first + body->count - 1] - source->free_length;
        return source->stiffness * stretch * stretch / 2;
    }
    case potential_link: {
        struct vec reach = vec_sub(point_motion(body, &pose, load->point).p, other_end(model, load, at).p);
        double stretch = vec_norm(reach) - source->free_length;
        return source->stiffness * stretch * stretch / 2;
    }
    case potential_constant: return constant_force_potential(body, load, &pose, at);
    case potential_linear: return linear_potential(body, load, &pose, at);
    case potential_given: return formula_value(&load->potential, at);
    case potential_quadrature: return by_quadrature(model, load, at, scratch);
    }
    return 0;
}
