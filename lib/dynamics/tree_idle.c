/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction that is zero in all of its modes: its mode is not decided.
 */
#include <math.h>
#include <string.h>

#include "dynamics/tree_driven.h"
#include "dynamics/tree_gather.h"
#include "dynamics/tree_shared.h"
#include "numeric/tolerances.h"

/* Set it to slip to the side of its motion; at rest to the side before. */
static void leave_idle(struct fbd_state *state, const struct decided *decided, int *forced, int pair)
{
    int side = hold_slips_already(state, decided, forced, pair);
    if (side == 0) side = state->slip_before[pair];
    state->slip_idle[pair] = forced[pair] = state->slip[pair] = side < 0 ? slip_minus : slip_plus;
}

void tree_find_frictionless(struct fbd_state *state, const struct decided *decided, int *forced)
{
    const struct fbd_model *model = state->model;
    struct instant at = state_instant(state);
    const struct direction flow = {.dt = 1, .dy = state_scratch(state).dy};
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++) {
        const struct mode *hold = mode_of(state, pair);
        state->slip_idle[pair] = forced[pair] = 0;
        if (!mode_is_friction(hold) || !hold_in_question(state, decided, forced, pair)) continue;
        if (!friction_is_idle(model, pair, &at, &flow)) continue;
        leave_idle(state, decided, forced, pair);
    }
}

void tree_find_unpressed(struct gathered *all, const struct decided *decided, int *forced)
{
    const double little = negligible_sum, little_rate = solved_rounding;
    struct fbd_state *state = all->state;
    const double *slots_along = state_scratch(state).slots_along;
    size_t count = all->problem.count;
    double fastest = -1;
    for (size_t g = 0; g < all->problem.guide_count; g++) {
        int pair = all->guide[g];
        const struct mode *hold = mode_of(state, pair);
        double answer = 0, N = all->problem.guides[g].free;
        for (size_t j = 0; j < count; j++) answer = fmax(answer, fabs(all->problem.B[g * count + j]));
        if (hold->coupling >= 0 || answer > little ||
            fabs(N) > press_slack(state->model, state->tree, hold->body))
            continue;
        if (fastest < 0) tree_evaluate(state);
        for (int k = 0; k < state->model->plan.slots; k++) fastest = fmax(fastest, fabs(slots_along[k]));
        if (fabs(slots_along[hold->normal_slot]) > little_rate * fastest) continue;
        leave_idle(state, decided, forced, pair);
        all->problem.holds[all->hold[pair]].slip = forced[pair];
    }
}
