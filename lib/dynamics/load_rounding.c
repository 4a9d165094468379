/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/load_rounding.h"

#include <math.h>

#include "dynamics/kinematics.h"

double formula_rounding(const struct formula *formula, const struct instant *at)
{
    return formula->expr ? expr_rounding(formula->expr, at->t, at->y, formula_branches(formula, at)) : 0;
}

struct load_rounding load_rounding(const struct model_load *load, const struct instant *at)
{
    double value = formula_rounding(&load->value, at);
    double parts = formula_rounding(&load->fx, at) + formula_rounding(&load->fy, at);
    if (load->source->kind == moment_applied) return (struct load_rounding){parts, value};
    return (struct load_rounding){value + parts, 0};
}

double load_power_rounding(const struct fbd_model *model, size_t index, const struct instant *at)
{
    const struct model_load *load = &model->loads[index];
    struct load_rounding of = load_rounding(load, at);
    if (of.force == 0 && of.couple == 0) return 0;
    const struct model_body *body = &model->bodies[load->body];
    struct pose pose = body_pose(body, at);
    return of.force * vec_norm(point_motion(body, &pose, load->point).v) + of.couple * fabs(pose.omega);
}
