/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/journals.h"

#include <math.h>

/* tree_normal is n for e = -k x n. */
double journal_aim(const struct tree *tree, struct tree_work *work, int i, struct vec F)
{
    const struct vec before = tree_normal(tree, work, i);
    const double size = vec_norm(F);
    const struct vec n = size > 0 ? vec_scale(1 / size, F) : (struct vec){0, 0};
    work->links[i].e = vec_scale(-1, vec_perp(n));
    return vec_norm(vec_sub(n, before));
}

static bool slips(const struct tree *tree, const struct instant *at, int i)
{
    return tree->links[i].journal && slip_side(at->slip[tree->links[i].pair]) != 0;
}

void journals_aim(const struct tree *tree, struct tree_work *work)
{
    for (int k = 0; k < tree->pair_count; k++) {
        const int i = tree->pairs[k];
        if (tree->links[i].journal) journal_aim(tree, work, i, work->links[i].F.force);
    }
}

bool journals_turn(const struct tree *tree, const struct instant *at)
{
    struct tree_work *work = at->tree;
    double change = 0;
    for (int k = 0; k < tree->pair_count; k++) {
        const int i = tree->pairs[k];
        if (!slips(tree, at, i)) continue;
        const struct vec F = vec_add(work->links[i].F.force, journal_force(work, i));
        change = fmax(change, journal_aim(tree, work, i, F));
    }
    return change > journal_negligible_turn;
}
