/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What couplings keep of their start, taken over by a motion that goes on: lengths that the file does not give, how
 * far ropes have wound, on which side of its line a body is. None of it can be seen from where the bodies are.
 */
#include "dynamics/constraint.h"
#include "dynamics/state.h"

static struct pos place_of(const struct fbd_model *model, int tie)
{
    return model->scene->constraints[model->tree->ties[tie].constraint].at;
}

static bool is_of(const struct fbd_model *model, int tie, struct pos at)
{
    struct pos place = place_of(model, tie);
    return place.line == at.line && place.column == at.column;
}

/* A group of bodies has the couplings of the whole that are its own, in their order; each stands at one place of the
 * file. */
void ties_keep(struct fbd_state *state, const struct fbd_state *from)
{
    const struct tree *tree = state->model->tree, *whole = from->model->tree;
    int next = 0;
    for (int i = 0; i < tree->tie_count; i++) {
        struct pos at = place_of(state->model, i);
        while (next < whole->tie_count && !is_of(from->model, next, at)) next++;
        if (next == whole->tie_count) return;
        state->tree->ties[i] = from->tree->ties[next++];
        state->tree->ties[i].feature = no_feature;
    }
    state->tree->kept = true;
    constraints_follow(state->model, state->tree);
}
