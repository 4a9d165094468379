/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/tree_shared.h"

#include <string.h>

#include "dynamics/plane_friction.h"
#include "dynamics/tree_gather.h"
#include "dynamics/user_states.h"
#include "numeric/tolerances.h"

struct direction tree_evaluate(struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    struct scratch scratch = state_scratch(state);
    struct instant at = state_instant(state);
    accelerations(model, &at, scratch.slots, state->a);
    if (model->plan.own > 0) user_state_rates(model, &at, state->a + model->plan.n);
    struct direction flow = state_flow(state, scratch.dy);
    force_balance_along(model, &at, &flow, scratch.slots, scratch.slots_along);
    return flow;
}

static bool has_two_sided_guides(const struct plan *plan)
{
    bool any = false;
    for (size_t pair = 0; pair < plan->mode_count; pair++)
        any |= plan->modes[pair].two_sided && plan->modes[pair].normal_slot >= 0;
    return any;
}

bool tree_choose_sides(struct fbd_state *state, const double *slots)
{
    if (!has_two_sided_guides(&state->model->plan)) return false;
    struct arena arena = state_lend(state);
    struct rest_system system;
    struct instant at = state_instant(state);
    bool open = rest_open(&system, state, &at, slots, &arena);
    bool changed = open && rest_choose_sides(&system);
    if (open) rest_restore(&system);
    rest_free(&system);
    state_take_back(state, &arena);
    return changed;
}

bool tree_find_margin(struct fbd_state *state, const struct instant *at, enum rest_scope scope,
                      const struct direction *flow, const double *slots, const double *slots_along,
                      struct arena *arena, struct rest_margin *margin)
{
    struct rest_system system;
    bool found = rest_open(&system, state, at, slots, arena) &&
                 rest_find_margin(&system, scope, slots_along, at->tree->z, flow, margin);
    if (system.base.F) rest_restore(&system);
    rest_free(&system);
    if (arena->failed) state->holds.found = holds_no_memory;
    return found && margin->value < HUGE_VAL;
}

/* Change the modes of all constraints at their limit; a guide with slipping friction changes its loaded side. */
static void give(struct fbd_state *state, const struct rest_margin *margin, int *forced)
{
    for (size_t pair = 0; pair < state->model->plan.mode_count; pair++) {
        if (margin->gives[pair] == 0) continue;
        if (mode_is_friction(&state->model->plan.modes[pair]) && state->slip[pair] != stick)
            state->pull[pair] = -state->pull[pair];
        else
            forced[pair] = state->slip[pair] = margin->gives[pair];
        if (state->model->plan.modes[pair].kind == mode_plane)
            plane_set_out(state, (int)pair, margin->aims[pair], true);
    }
}

enum agreement tree_judge(struct fbd_state *state, const struct rest_margin *margin, int *forced)
{
    if (margin->value >= -rest_margin_slack(margin) / 2) return agrees;
    if (margin->value < -undecided_part * margin->size) return differs;
    give(state, margin, forced);
    return at_limit;
}

bool tree_give_shared(struct fbd_state *state, int pair, struct decided *decided)
{
    struct rest_margin margin;
    if (!tree_joins(state->model->tree)) return false; /* bodies that stand alone have no redundant loads */
    struct arena arena = state_lend(state);
    struct scratch scratch = state_scratch(state);
    struct direction flow = tree_evaluate(state);
    struct instant at = state_instant(state);
    bool gives =
        tree_find_margin(state, &at, rest_all, &flow, scratch.slots, scratch.slots_along, &arena, &margin) &&
        margin.of[pair];
    for (size_t i = 0; gives && i < state->model->plan.mode_count; i++) {
        bool turns = mode_is_friction(&state->model->plan.modes[i]) && state->slip[i] != stick;
        (turns ? decided->pulls : decided->slips)[i] |= margin.gives[i] != 0;
        decided->aims[i] |= margin.gives[i] != 0;
    }
    if (gives) {
        give(state, &margin, state->slip_forced);
        gathered_set_out(state, margin.gives);
    }
    state_take_back(state, &arena);
    return gives;
}
