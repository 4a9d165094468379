/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/forward.h"
#include "dynamics/friction.h"
#include "dynamics/journals.h"
#include "dynamics/rest_system.h"
#include "dynamics/state.h"
#include "dynamics/tree_system.h"

static struct tree_work *begin_unit(const struct fbd_model *model, struct fbd_state *state, int i)
{
    struct tree_work *work = state->tree;
    memset(work->x, 0, (size_t)model->tree->count * sizeof *work->x);
    work->x[i].g = 1;
    tree_inward(model->tree, work, 1, model->tree->count);
    tree_outward(model->tree, work, 1, model->tree->count, work->unit);
    return work;
}

static void keep_forces(const struct tree *tree, struct tree_work *work, bool first)
{
    for (int i = 1; i < tree->joined; i++) {
        struct vec *F = &work->links[i].F.force;
        *F = first ? journal_force(work, i) : vec_add(*F, journal_force(work, i));
    }
}

/* Set the forces in the joints to those by a unit moment in joint i, with all couplings. */
static void answer_unit(struct fbd_state *state, const struct instant *at, int i)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    struct tree_work *work = begin_unit(model, state, i);
    keep_forces(tree, work, true);
    if (tree->coupling_count == 0 && !tree_lacks_inertia(tree, work)) return;
    for (int j = 0; j < tree_unknowns(tree); j++)
        work->z[j] = j < tree->row_count ? -tree_row_answer(work, j) : 0;
    tree_want_massless(tree, work, work->unit, work->z);
    tree_system_solve(model, at, work->z);
    keep_forces(tree, work, false);
}

static double *gain_of(const struct fbd_state *state, int i)
{
    return &state->scratch[mode_of(state, state->model->tree->links[i].pair)->normal_slot];
}

static void add_gains(struct fbd_state *state, const struct instant *at)
{
    const struct tree *tree = state->model->tree;
    for (int k = 0; k < tree->pair_count; k++)
        if (tree->links[tree->pairs[k]].journal) *gain_of(state, tree->pairs[k]) = 0;
    for (int k = 0; k < tree->pair_count; k++) {
        if (!tree->links[tree->pairs[k]].journal) continue;
        answer_unit(state, at, tree->pairs[k]);
        for (int j = 0; j < tree->pair_count; j++)
            if (tree->links[tree->pairs[j]].journal)
                *gain_of(state, tree->pairs[j]) += vec_norm(state->tree->links[tree->pairs[j]].F.force);
    }
}

/* Is the gain of a journal, or its reaction, too large? Record it. */
static bool is_lost(struct fbd_state *state, const struct instant *at, int i, bool open)
{
    const int pair = state->model->tree->links[i].pair;
    const struct formula *k = &mode_of(state, pair)->mu_k;
    const double radius = friction_coefficient(state->model, pair, k, at, NULL, NULL);
    const double gain = open ? 0 : radius * *gain_of(state, i);
    if (radius == 0 || (!open && gain < 1)) return false;
    state->holds = (struct holds_trouble){holds_none, pair, gain, -1};
    return true;
}

bool journals_determined(struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    if (tree->journal_count == 0) return true;
    struct instant at = state_instant(state);
    const bool open = rest_is_open(model, &at);
    bool lost = false;
    memcpy(state->slip_before, state->slip, model->plan.mode_count * sizeof *state->slip);
    for (int k = 0; k < tree->pair_count; k++)
        if (tree->links[tree->pairs[k]].journal) state->slip_before[tree->links[tree->pairs[k]].pair] = loose;
    at.slip = state->slip_before;
    accelerations(model, &at, state->scratch, state->a);
    add_gains(state, &at);
    for (int k = 0; k < tree->pair_count && !lost; k++)
        if (tree->links[tree->pairs[k]].journal) lost = is_lost(state, &at, tree->pairs[k], open);
    state_evaluate(state);
    return !lost;
}
