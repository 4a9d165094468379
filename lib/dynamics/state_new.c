/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * States at the start of a run.
 */
#include "dynamics/state.h"

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/modes.h"
#include "dynamics/project.h"

#include <string.h>

/* Allow sliding along slots while positions are found; rolling without slip remains. */
static void let_slots_slip(struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    for (int i = 0; i < tree->coupling_count; i++)
        if (tree->couplings[i].kind == constraint_groove) state->slip[tree->couplings[i].pair] = slip_plus;
}

struct fbd_state *state_new(const struct fbd_model *model)
{
    size_t n = (size_t)model->plan.n;
    struct fbd_state *state = state_allocate(model);
    if (!state) return NULL;
    for (size_t i = 0; i < n; i++) {
        state->y[i] = model->scene->coordinates[i].initial;
        state->y[n + i] = model->scene->coordinates[i].initial_rate;
    }
    for (int i = 0; i < model->plan.own; i++) state->y[2 * n + (size_t)i] = model->scene->own[i].initial;
    modes_drive(state);
    let_slots_slip(state);
    state_start_constraints(state);
    if (model->assembles) state_project(state, true);
    contacts_start(state);
    return state;
}

struct fbd_state *state_new_from(const struct fbd_model *model, const struct state_start *start)
{
    struct fbd_state *state = state_allocate(model);
    if (!state) return NULL;
    state->t = start->t;
    memcpy(state->y, start->y, plan_size(&model->plan) * sizeof *state->y);
    if (start->branch)
        memcpy(state->branch, start->branch, (size_t)model->plan.branches * sizeof *state->branch);
    modes_drive(state);
    state_start_constraints(state);
    couplings_keep(state, start->couplings);
    contacts_start(state);
    return state;
}
