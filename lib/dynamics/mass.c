/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/mass.h"

struct inertia body_inertia(const struct model_body *body, const struct instant *at)
{
    struct inertia inertia = body->inertia;
    double share = body_share(body, at);
    inertia.mass = body_mass(body, at);
    inertia.I_G *= share;
    return inertia;
}

/* The rate of a variable of the mass, given by its slot (0 for the time), and its variation: of coordinates
 * their rates, of user states theirs. */
static double rate_of(const struct fbd_model *model, int slot, const struct instant *at)
{
    int n = model->plan.n;
    if (slot == 0) return 1;
    return slot <= n ? at->y[n + slot - 1] : formula_value(&model->plan.rates[slot - 1 - 2 * n], at);
}

static double rate_of_along(const struct fbd_model *model, int slot, const struct instant *at,
                            const struct direction *along)
{
    int n = model->plan.n;
    double variation;
    if (slot == 0) return 0;
    if (slot <= n) return along->dy[n + slot - 1];
    formula_along(&model->plan.rates[slot - 1 - 2 * n], at, along, &variation);
    return variation;
}

/* dm/dt = sum of m_a a' over the time and all other variables. */
double body_mass_rate(const struct fbd_model *model, const struct model_body *body, const struct instant *at)
{
    const struct formula *mass = &body->mass;
    const int *slots, *branch = formula_branches(mass, at);
    double sum = 0, slope;
    if (formula_is_constant(mass)) return 0;
    int count = (int)expr_variables(mass->expr, &slots);
    for (int i = expr_uses_time(mass->expr) ? -1 : 0; i < count; i++) {
        int a = i < 0 ? 0 : slots[i];
        expr_eval_slot(mass->expr, at->t, at->y, a, branch, &slope);
        if (slope != 0) sum += slope * rate_of(model, a, at);
    }
    return sum;
}

double body_mass_rate_along(const struct fbd_model *model, const struct model_body *body,
                            const struct instant *at, const struct direction *along)
{
    const struct formula *mass = &body->mass;
    const int *slots, *branch = formula_branches(mass, at);
    double sum = 0, slope_a, slope_b, both;
    if (formula_is_constant(mass)) return 0;
    int count = (int)expr_variables(mass->expr, &slots), first = expr_uses_time(mass->expr) ? -1 : 0;
    for (int i = first; i < count; i++) {
        int a = i < 0 ? 0 : slots[i];
        double rate = rate_of(model, a, at);
        expr_eval_slot(mass->expr, at->t, at->y, a, branch, &slope_a);
        if (slope_a != 0) sum += slope_a * rate_of_along(model, a, at, along);
        for (int j = first; j < count; j++) {
            int b = j < 0 ? 0 : slots[j];
            double step = b == 0 ? along->dt : along->dy[b - 1];
            if (step == 0) continue;
            expr_eval_second(mass->expr, at->t, at->y, a, b, branch, &slope_a, &slope_b, &both);
            sum += both * rate * step;
        }
    }
    return sum;
}

double body_carried_power(const struct fbd_model *model, const struct model_body *body,
                          const struct instant *at)
{
    struct pose pose = body_pose(body, at);
    struct vec v = point_motion(body, &pose, body->inertia.G).v;
    double square = body->inertia.I_G / body->inertia.mass;
    return body_mass_rate(model, body, at) * (vec_dot(v, v) + square * pose.omega * pose.omega) / 2;
}
