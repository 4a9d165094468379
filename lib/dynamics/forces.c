/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/forces.h"

#include <string.h>

#include "dynamics/tree.h"

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

static void add_joint_forces(const struct plan *plan, const struct instant *at,
                             const struct link_loads *loads, double *slots)
{
    const double *q = at->y, *v = at->y + plan->n;
    const struct range affine = loads->of[list_affine], potentials = loads->of[list_potentials];
    for (int i = affine.first; i < range_end(affine); i++) {
        const struct affine_term *term = &plan->affine[i];
        if (!is_there(at->tree, term->lifetime)) continue;
        slots[term->coordinate] += term->c0 - term->kq * q[term->coordinate] - term->kv * v[term->coordinate];
    }
    for (int i = potentials.first; i < range_end(potentials); i++) {
        const struct potential_term *term = &plan->potentials[i];
        double slope;
        if (!is_there(at->tree, term->lifetime)) continue;
        expr_eval_slot(term->V.expr, at->t, at->y, 1 + term->coordinate, formula_branches(&term->V, at),
                       &slope);
        slots[term->coordinate] -= slope;
    }
}

void force_slots(const struct fbd_model *model, const struct instant *at, double *slots)
{
    memset(slots, 0, (size_t)model->plan.slots * sizeof *slots);
    add_joint_forces(&model->plan, at, &model->tree->loads, slots);
}

void force_slots_alone(const struct fbd_model *model, const struct instant *at, int link, double *slots)
{
    const struct model_body *body = &model->bodies[model->tree->links[link].body];
    for (int k = body->first; k < body->first + body->count; k++) slots[k] = 0;
    add_joint_forces(&model->plan, at, tree_alone_loads(model->tree, link), slots);
}

void force_slots_along(const struct fbd_model *model, const struct instant *at, const struct direction *along,
                       double *variation)
{
    const struct plan *plan = &model->plan;
    const double *dq = along->dy, *dv = along->dy + plan->n;
    memset(variation, 0, (size_t)plan->slots * sizeof *variation);
    for (size_t i = 0; i < plan->affine_count; i++) {
        const struct affine_term *term = &plan->affine[i];
        if (!is_there(at->tree, term->lifetime)) continue;
        variation[term->coordinate] -= term->kq * dq[term->coordinate] + term->kv * dv[term->coordinate];
    }
    for (size_t i = 0; i < plan->potential_count; i++)
        if (is_there(at->tree, plan->potentials[i].lifetime))
            variation[plan->potentials[i].coordinate] -= slope_variation(&plan->potentials[i], at, along);
}
