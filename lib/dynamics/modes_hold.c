/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Coordinates and rates that modes determine: of drives, and of sticking friction.
 */
#include "dynamics/modes.h"

/* Resolve the branches of a function of time; the rates of the state do not matter. */
static void resolve_drive(struct fbd_state *state, const struct formula *law)
{
    if (!formula_is_constant(law))
        expr_resolve(law->expr, state_moment(state), state->y, 1, state->y, NULL,
                     state->branch + law->branch);
}

void modes_drive(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    struct instant at = state_instant(state);
    double acceleration;
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        if (mode->kind != mode_drive) continue;
        resolve_drive(state, &mode->position);
        state->y[mode->coordinate] = formula_value(&mode->position, &at);
        state->y[plan->n + mode->coordinate] = friction_surface_speed(mode, &at, &acceleration);
    }
    const struct tree *tree = state->model->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        if (tree->couplings[i].reels) resolve_drive(state, &tree->couplings[i].reel);
        if (tree->couplings[i].surface_speed.expr) resolve_drive(state, &tree->couplings[i].surface_speed);
    }
}

/* Set a number; returns whether it changes. */
static bool put(double *place, double x)
{
    bool other = *place != x;
    *place = x;
    return other;
}

/* Returns whether coordinates or their rates have changed. `settling`: see sliding_project. */
static bool hold(struct fbd_state *state, bool settling)
{
    const struct plan *plan = &state->model->plan;
    struct instant at = state_instant(state);
    bool moved = false;
    double acceleration;
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        if (mode->kind == mode_drive)
            moved |= put(&state->y[mode->coordinate], formula_value(&mode->position, &at));
        if (state->slip[pair] == stick && mode->coupling < 0)
            moved |=
                put(&state->y[plan->n + mode->coordinate], friction_surface_speed(mode, &at, &acceleration));
    }
    if (state_sliding(state)) sliding_project(state, settling);
    return moved;
}

void modes_hold(struct fbd_state *state)
{
    hold(state, false);
}

bool modes_hold_settling(struct fbd_state *state)
{
    return hold(state, true);
}
