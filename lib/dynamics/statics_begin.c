/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A state brought to rest, with the modes that it has there.
 */
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/friction.h"
#include "dynamics/modes.h"
#include "dynamics/statics.h"
#include "dynamics/tree_system.h"

/* -1 or +1 for a surface that moves under the body, 0 if it is at rest as well. */
static enum slip slip_at_rest(const struct fbd_model *model, const struct mode *mode,
                              const struct instant *at)
{
    if (friction_is_never(mode)) return slip_plus;
    if (mode->kind == mode_tangent) {
        const double surface = at->tree->rows[model->tree->couplings[mode->coupling].along_row].surface;
        return surface > 0 ? slip_minus : surface < 0 ? slip_plus : stick;
    }
    if (mode->coupling >= 0 || mode->kind == mode_drive) return stick;
    double acceleration, speed = friction_surface_speed(mode, at, &acceleration);
    return speed > 0 ? slip_minus : speed < 0 ? slip_plus : stick;
}

static enum slip one_sided_at_rest(const struct fbd_state *state, int pair)
{
    const struct fbd_model *model = state->model;
    struct instant at = state_instant(state);
    const int index = model->plan.modes[pair].coupling;
    const struct coupling *coupling = &model->tree->couplings[index];
    const bool contact = coupling->kind == constraint_contact;
    /* Separated shapes have a row that is zero. */
    if (contact && at.tree->couplings[index].feature == no_feature) return slip_plus;
    struct one_sided now = one_sided_at(model, &at, pair);
    /* At the origin the size of the scene is the only scale of rounding. */
    bool near = contact && fabs(now.excess) <= meeting_near(model, at.tree, coupling->meeting);
    return now.touches || now.excess > 0 || near ? stick : slip_plus;
}

static void stop(struct fbd_state *state)
{
    size_t n = (size_t)state->model->plan.n;
    memset(state->y + n, 0, n * sizeof *state->y);
    memset(state->a, 0, n * sizeof *state->a);
}

bool rest_begin(struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    stop(state);
    if (!modes_settle(state, NULL)) return false;
    stop(state); /* bodies that stick to a moving surface had its velocity */
    state_evaluate(state);
    if (state->holds.found == holds_no_memory) return false;
    memset(state->a, 0, (size_t)model->plan.n * sizeof *state->a);
    struct instant at = state_instant(state);
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++) {
        const struct mode *mode = &model->plan.modes[pair];
        state->slip[pair] = mode_is_one_sided(mode) ? (int)one_sided_at_rest(state, pair)
                                                    : (int)slip_at_rest(model, mode, &at);
    }
    for (int i = 0; i < model->tree->count; i++) {
        state->tree->links[i].locked = false;
        state->tree->links[i].A = (struct acceleration){0, {0, 0}};
    }
    tree_move(model, &at);
    constraints_evaluate(model, &at, NULL);
    return true;
}
