/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The references of couplings from their start, copied to a continued motion: lengths that the file does not
 * give, winding of ropes, the side of its line on which a body is. They do not follow from the positions of
 * the bodies.
 */
#include "dynamics/constraint.h"
#include "dynamics/state.h"

static struct pos place_of(const struct fbd_model *model, int coupling)
{
    return model->scene->constraints[model->tree->couplings[coupling].constraint].at;
}

static bool is_of(const struct fbd_model *model, int coupling, struct pos at)
{
    struct pos place = place_of(model, coupling);
    return place.line == at.line && place.column == at.column;
}

/* An island has a subset of the couplings of the whole, in the same order, identified by their position in
 * the file. */
void couplings_keep(struct fbd_state *state, const struct fbd_state *from)
{
    const struct tree *tree = state->model->tree, *whole = from->model->tree;
    int next = 0;
    state_copy_lives(state, from);
    for (int i = 0; i < tree->coupling_count; i++) {
        struct pos at = place_of(state->model, i);
        while (next < whole->coupling_count && !is_of(from->model, next, at)) next++;
        if (next == whole->coupling_count) return;
        state->tree->couplings[i] = from->tree->couplings[next++];
        state->tree->couplings[i].feature = no_feature;
    }
    state->tree->kept = true;
    constraints_follow(state->model, state->tree);
}
