/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction of slides between jointed bodies while they slip: f = -c N along the slide, c = slip mu_k. It
 * depends on the normal force, and the normal forces of all slides of the tree depend on it: see
 * tree_system.h.
 */
#include "dynamics/friction.h"
#include "dynamics/tree.h"

bool tree_slips(const struct tree *tree, const struct instant *at)
{
    for (int k = 0; k < tree->pair_count; k++)
        if (at->slip[tree->links[tree->pairs[k]].pair] != stick) return true;
    return false;
}

double tree_slip_share(const struct fbd_model *model, const struct instant *at, int i)
{
    int pair = model->tree->links[i].pair;
    int side = slip_side(at->slip[pair]);
    return side == 0 ? 0 : side * at->pull[pair] * formula_value(&model->plan.modes[pair].mu_k, at);
}

double tree_normal_in(const struct tree *tree, const struct tree_work *work, int i)
{
    struct wrench F = inertia_wrench(&work->links[i].I, work->x[i].A, work->x[i].p);
    return vec_dot(tree_normal(tree, work, i), F.force);
}
