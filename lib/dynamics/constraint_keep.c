/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What couplings keep of their start, taken over by a motion that goes on: lengths that the file does not give, how
 * far ropes have wound, on which side of its line a body is. None of it can be seen from where the bodies are.
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

/* A group of bodies has the couplings of the whole that are its own, in their order; each stands at one place of the
 * file. */
void couplings_keep(struct fbd_state *state, const struct fbd_state *from)
{
    const struct tree *tree = state->model->tree, *whole = from->model->tree;
    int next = 0;
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
