/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Find the friction modes whose slip velocity a law names.
 *
 * A step extends a little beyond the time at which a mode comes to rest, before that event is located. There
 * the law is continued to negative slip, so that a step crosses no kink. A law with a root, (slip/v_s)^0.5,
 * has no value there; it has a kink at rest in any case, and is continued with the magnitude.
 */
#include <math.h>
#include <stdlib.h>

#include "model/builder.h"

/* True if the law is finite at `slip`, with all other variables at the start. */
static bool finite_at(const struct formula *law, double *y, size_t component, double slip)
{
    y[component] = slip;
    bool finite = isfinite(expr_eval(law->expr, 0, y, NULL));
    y[component] = 0;
    return finite;
}

/* True if at one of these slips the law is finite, but not at its negative. */
static bool ends_at_rest(const struct formula *law, double *y, size_t component)
{
    const int lowest = -9, highest = 3; /* decades of m/s (rad/s) */
    for (int decade = lowest; law->expr && decade <= highest; decade++) {
        double slip = pow(10, decade);
        if (finite_at(law, y, component, slip) && !finite_at(law, y, component, -slip)) return true;
    }
    return false;
}

static int pair_of(const struct fbd_model *model, const struct absolute *slip)
{
    if (slip->roll == 0) return model->bodies[slip->body].friction;
    for (int i = 0; i < model->tree->coupling_count; i++)
        if (model->tree->couplings[i].constraint == slip->roll - 1) return model->tree->couplings[i].pair;
    return -1;
}

bool slips_find(struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    size_t n = (size_t)model->plan.n;
    if (model->absolute_count == 0) return true;
    double *y = calloc(plan_size(&model->plan) + hand_slots + model->absolute_count, sizeof *y);
    if (!y) return false;
    for (size_t i = 0; i < n; i++) {
        y[i] = scene->coordinates[i].initial;
        y[n + i] = scene->coordinates[i].initial_rate;
    }
    for (size_t i = 0; i < scene->own_count; i++) y[2 * n + i] = scene->own[i].initial;
    for (size_t k = 0; k < model->absolute_count; k++) {
        struct model_absolute *absolute = &model->absolutes[k];
        if (absolute->kind != absolute_slip) continue;
        absolute->pair = pair_of(model, &scene->absolutes[k]);
        if (absolute->pair < 0) continue;
        const struct formula *law = &model->plan.modes[absolute->pair].mu_k;
        absolute->even = ends_at_rest(law, y, plan_size(&model->plan) + hand_slots + k);
    }
    free(y);
    return true;
}
