/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/load_rounding.h"

#include <math.h>

#include "dynamics/kinematics.h"

double formula_rounding(const struct formula *formula, const struct instant *at)
{
    return formula->expr ? expr_rounding(formula->expr, at->t, at->y, formula_branches(formula, at)) : 0;
}

static bool has_formulas(const struct model_load *load)
{
    return load->value.expr || load->fx.expr || load->fy.expr;
}

/* Of an applied force: diagram.c, applied_force. */
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
    double speed = vec_norm(point_motion(body, &pose, load->point).v);
    return vec_norm(of.force) * speed + fabs(of.couple * pose.omega);
}
