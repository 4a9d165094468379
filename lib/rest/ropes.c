/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/ropes.h"

#include "dynamics/constraint.h"

/* Is the pair a rope that is taut, or slack? */
static bool is_rope(const struct fbd_state *state, int pair, bool taut)
{
    return state->model->plan.modes[pair].kind == mode_rope && (state->slip[pair] == stick) == taut;
}

bool ropes_are_slack(const struct fbd_state *state)
{
    int count = (int)state->model->plan.mode_count, pair = 0;
    while (pair < count && !is_rope(state, pair, false)) pair++;
    return pair < count;
}

static bool is_too_long(const struct fbd_state *state, int pair)
{
    const struct instant at = state_instant(state);
    if (!is_rope(state, pair, false)) return false;
    const struct one_sided now = one_sided_at(state->model, &at, pair);
    return now.excess > now.near;
}

static bool would_push(const struct fbd_state *state, int pair)
{
    const struct instant at = state_instant(state);
    if (!is_rope(state, pair, true)) return false;
    const struct one_sided now = one_sided_at(state->model, &at, pair);
    return now.force < -now.slack;
}

bool ropes_are_too_long(const struct fbd_state *state)
{
    int count = (int)state->model->plan.mode_count, pair = 0;
    while (pair < count && !is_too_long(state, pair)) pair++;
    return pair < count;
}

bool ropes_take_up(struct fbd_state *state)
{
    bool any = false;
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++) {
        if (!is_too_long(state, pair)) continue;
        state->slip[pair] = stick;
        any = true;
    }
    return any;
}

bool ropes_let_go(struct fbd_state *state)
{
    bool any = false;
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++) {
        if (!would_push(state, pair)) continue;
        state->slip[pair] = slip_plus;
        any = true;
    }
    return any;
}
