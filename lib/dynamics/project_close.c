/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Project the end of a step, with the misfits and energies before and after, which every step with couplings
 * requires. For a loop of three links they follow from the projection itself (tree_loop_return.c).
 */
#include "dynamics/energy.h"
#include "dynamics/project.h"
#include "dynamics/tree_system.h"

void state_return(struct fbd_state *state)
{
    struct instant at = state_instant(state);
    return_to_constraints(state->model, &at, state->y);
}

static struct closing close_any(struct fbd_state *state)
{
    const struct instant at = state_instant(state);
    struct closing closing;
    closing.off = state_misfit(state);
    closing.energy[0] = standing_kinetic_energy(state);
    closing.left = closing.off;
    closing.energy[1] = closing.energy[0];
    if (tree_rows_are_idle(state->model->tree, &at)) return closing;
    state_return(state);
    closing.left = state_misfit(state);
    closing.energy[1] = standing_kinetic_energy(state);
    return closing;
}

/* Of the two rows of the pin, along x and y. */
static struct misfit misfit_of(const struct tree_loop_sight *sight)
{
    const struct vec off = {fabs(sight->off.x), fabs(sight->off.y)};
    const struct misfit misfit = {fmax(off.x, off.y), fmax(fabs(sight->rate.x), fabs(sight->rate.y)),
                                  off.y > off.x};
    return misfit.position == 0 ? (struct misfit){0, misfit.velocity, -1} : misfit;
}

struct closing state_close(struct fbd_state *state)
{
    struct tree_loop_closing seen;
    if (!state->tree->loop || !tree_loop_close(state->tree->loop, state->y, &seen)) return close_any(state);
    const struct instant at = state_instant(state);
    tree_move_turned(state->model, &at, seen.turn);
    return (struct closing){misfit_of(&seen.before),
                            misfit_of(&seen.after),
                            {seen.before.energy, seen.after.energy}};
}
