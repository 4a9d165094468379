/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/load_rounding.h"

#include <math.h>

#include "dynamics/kinematics.h"
#include "dynamics/mass.h"
#include "model/tree.h"

double formula_rounding(const struct formula *formula, const struct instant *at)
{
    return formula->expr ? expr_rounding(formula->expr, at->t, at->y, formula_branches(formula, at)) : 0;
}

static bool has_formulas(const struct model_load *load)
{
    return load->value.expr || load->fx.expr || load->fy.expr;
}

/* Of an applied force: see applied_force in diagram.c. */
static struct vec force_rounding(const struct model_load *load, struct vec rotation, const struct instant *at)
{
    double value = formula_rounding(&load->value, at);
    struct vec f = {formula_rounding(&load->fx, at), formula_rounding(&load->fy, at)};
    if (!load->source->angle.expr) return vec_add(f, vec_scale(value, rotation));
    f = vec_add(f, vec_scale(value, vec_unit(formula_value(&load->angle, at))));
    return load->source->body_frame ? vec_turn(rotation, f) : f;
}

struct load_rounding load_rounding(const struct fbd_model *model, size_t index, const struct instant *at)
{
    const struct model_load *load = &model->loads[index];
    struct load_rounding of = {{0, 0}, 0};
    if (!has_formulas(load)) return of;
    if (load->source->kind == moment_applied)
        of.couple = formula_rounding(&load->value, at);
    else
        of.force = force_rounding(load, body_pose(&model->bodies[load->body], at).rotation, at);
    return of;
}

double load_power_rounding(const struct fbd_model *model, size_t index, const struct instant *at)
{
    const struct model_load *load = &model->loads[index];
    if (!has_formulas(load)) return 0;
    const struct load_rounding of = load_rounding(model, index, at);
    const struct model_body *body = &model->bodies[load->body];
    struct pose pose = body_pose(body, at);
    double speed = vec_norm(point_motion(body, &pose, load->point).v), omega = fabs(pose.omega);
    if (load->partner >= 0) {
        const struct model_body *partner = &model->bodies[load->partner];
        const struct pose other = body_pose(partner, at);
        speed += vec_norm(point_motion(partner, &other, load->anchor).v);
        omega += fabs(other.omega);
    }
    return vec_norm(of.force) * speed + fabs(of.couple) * omega;
}

/* The size of couplings: they determine the position of a body relative to that, not to the origin. */
static double reach_of_couplings(const struct tree *tree)
{
    double reach = 0;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        reach = fmax(reach, fabs(coupling->length));
        for (int end = 0; end < coupling->end_count; end++)
            reach = fmax(reach, vec_norm(coupling->end[end].point) + coupling->end[end].radius);
    }
    return reach;
}

struct rounded rounded_at(const struct fbd_state *state)
{
    struct arrow *arrows = state->arrows;
    const struct fbd_model *model = state->model; /* of an island, or the whole */
    struct instant at = state_instant(state);
    struct rounded sum = {0, 0};
    double reach = reach_of_couplings(model->tree);
    for (size_t b = 0; b < model->body_count; b++) {
        size_t count = diagram_fill(model, (int)b, &at, state->slots, arrows);
        double forces = 0, mass = body_mass(&model->bodies[b], &at);
        for (size_t i = 0; i < count; i++) {
            const struct arrow *arrow = &arrows[i];
            double force = vec_norm(arrow->force);
            sum.places += force * fmax(vec_norm(arrow->point), reach) + fabs(arrow->couple);
            forces += force;
        }
        if (mass > 0) sum.ways += forces * forces / mass;
    }
    return sum;
}
