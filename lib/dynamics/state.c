/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/state.h"

#include "dynamics/reactions.h"
#include "dynamics/rest_system.h"
#include "dynamics/tree_system.h"
#include "dynamics/user_states.h"
#include "dynamics/world_refs.h"

/* Choose the indeterminate reactions. */
static void share_out(struct fbd_state *state, double *slots)
{
    struct rest_system system;
    struct instant at = state_instant(state);
    state->tree->shared = true;
    state->tree->shared_size = 0;
    if (!rest_is_open(state->model, &at)) return;
    struct arena arena = state_lend(state);
    if (rest_open(&system, state, &at, slots, &arena)) rest_share(&system, slots);
    rest_free(&system);
    state_take_back(state, &arena);
}

void state_evaluate_unshared(struct fbd_state *state)
{
    struct instant at = state_instant(state);
    accelerations(state->model, &at, state->slots, state->a);
    tree_complete(state->model, state->tree);
    if (state->extended) world_refs_write(state->model, &at, state->y);
    if (state->model->names_reactions) reactions_write(state->model, &at, state->slots, state->y);
    if (state->model->plan.own > 0) user_state_rates(state->model, &at, state->a + state->model->plan.n);
}

void state_evaluate(struct fbd_state *state)
{
    state_evaluate_unshared(state);
    share_out(state, state->slots);
}

void state_balance_of(struct fbd_state *state, int b, double *slots)
{
    struct instant at = state_instant(state);
    force_balance_of(state->model, b, &at, slots);
    if (!state->model->bodies[b].alone) share_out(state, slots);
}
