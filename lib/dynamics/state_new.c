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

static void set_initial(struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    size_t n = (size_t)model->plan.n;
    for (size_t i = 0; i < n; i++) {
        state->y[i] = model->scene->coordinates[i].initial;
        state->y[n + i] = model->scene->coordinates[i].initial_rate;
    }
    for (int i = 0; i < model->plan.own; i++) state->y[2 * n + (size_t)i] = model->scene->own[i].initial;
}

static void set_start(struct fbd_state *state, const struct state_start *start)
{
    const struct plan *plan = &state->model->plan;
    state->t = start->t;
    memcpy(state->y, start->y, plan_size(plan) * sizeof *state->y);
    if (state->held)
        memcpy(state->held, start->couplings->held,
               state->model->scene->parameter_count * sizeof *state->held);
    if (start->branch) memcpy(state->branch, start->branch, (size_t)plan->branches * sizeof *state->branch);
}

struct fbd_state *state_make(const struct fbd_model *model, const struct state_start *start,
                             struct arena *memory)
{
    struct fbd_state *state = state_allocate(model, memory);
    if (!state) return NULL;
    if (start)
        set_start(state, start);
    else
        set_initial(state);
    modes_drive(state);
    if (!start) let_slots_slip(state);
    state_start_constraints(state);
    if (start)
        couplings_keep(state, start->couplings);
    else if (model->assembles)
        state_project(state, true);
    contacts_start(state);
    return state;
}
