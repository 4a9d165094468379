/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/user_states.h"

#include "dynamics/world_refs.h"

void user_state_rates(const struct fbd_model *model, const struct instant *given, double *rates)
{
    const struct plan *plan = &model->plan;
    struct instant extended;
    const struct instant *at = instant_with_places(model, given, &extended);
    for (int i = 0; i < plan->own; i++) rates[i] = formula_value(&plan->rates[i], at);
}

void user_state_rates_along(const struct fbd_model *model, const struct instant *given,
                            const struct direction *direction, double *rates_along)
{
    const struct plan *plan = &model->plan;
    const struct instant at = instant_extend(model, given);
    const struct direction along = direction_extend(model, &at, direction);
    for (int i = 0; i < plan->own; i++) formula_along(&plan->rates[i], &at, &along, &rates_along[i]);
}

double user_state_rate_size(const struct fbd_state *state, int own)
{
    const double least = 1e-3;
    const struct fbd_model *model = state->model;
    const struct formula *rate = &model->plan.rates[own];
    const int *slots;
    size_t n = (size_t)model->plan.n, count = rate->expr ? expr_variables(rate->expr, &slots) : 0;
    const struct instant now = state_instant(state), at = instant_extend(model, &now);
    double size = 0;
    for (size_t k = 0; k < count; k++) {
        size_t i = (size_t)slots[k] - 1;
        bool angle = i < n && model->scene->coordinates[i].angle;
        double slope;
        expr_eval_slot(rate->expr, at.t, at.y, slots[k], formula_branches(rate, &at), &slope);
        if (isfinite(slope)) size += fabs(slope) * fmax(fabs(at.y[i]), angle ? 1 : least);
    }
    return size;
}
