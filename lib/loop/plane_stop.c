/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The stop of a point that slips on a plane.
 */
#include "dynamics/plane_friction.h"
#include "dynamics/project.h"
#include "dynamics/tree.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

/* Is the velocity on a plane within the error of the velocities of which it is the difference? The links are in place. */
static bool is_slow(const struct run *run, int pair)
{
    const int index = run->model->plan.modes[pair].coupling;
    return plane_speed(run->model, run->state->tree, index).slip <= run->state->tree->couplings[index].slow;
}

/* Has the velocity on a plane turned by a right angle from the direction in which it is watched? That is renewed
 * then. A slow one is a stop. */
bool plane_only_turns(struct run *run, int pair)
{
    const struct instant at = state_instant(run->state);
    tree_move(run->model, &at);
    if (is_slow(run, pair)) return false;
    plane_aim(run->model, &at, run->model->plan.modes[pair].coupling);
    return true;
}

/* After the stop, set velocities of its body to zero that are at the round-off level of those that it had. */
void plane_drop_rounding(struct run *run, int pair)
{
    const struct model_body *body = &run->model->bodies[run->model->plan.modes[pair].body];
    const size_t n = (size_t)run->model->plan.n, first = (size_t)body->first, count = (size_t)body->count;
    const double *most = run->recent.anchor + plan_size(&run->model->plan) + n + first;
    const double gyration = sqrt(body->inertia.I_G / body->inertia.mass);
    double size = 0, *v = run->state->y + n + first;
    for (size_t k = 0; k < count; k++)
        size = fmax(size, most[k] * (coordinate_is_angle(body, (int)k) ? gyration : 1));
    for (size_t k = 0; k < count; k++)
        if (fabs(v[k]) * (coordinate_is_angle(body, (int)k) ? gyration : 1) <= evaluation_rounding * size)
            v[k] = 0;
}

/* The other points of its body on the same plane that are at rest within that error stop with it. */
void plane_stop_with(struct run *run, int pair)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        const int other = tree->couplings[i].pair;
        if (!planes_are_one(tree, i, run->model->plan.modes[pair].coupling)) continue;
        if (run->state->slip[other] != stick && is_slow(run, other)) run->state->slip[other] = stick;
    }
}

/* Does its speed decrease? After state_evaluate(). */
static bool slows_down(const struct fbd_state *state, int index)
{
    const struct row *rows = &state->tree->rows[state->model->tree->couplings[index].first_row];
    return rows[0].g.x1 * rows[0].g.x2 + rows[1].g.x1 * rows[1].g.x2 < 0;
}

/* Points that are at rest within the error of the run stop where another one reaches its limit: the direction of their force,
 * which is that of this error, does not decide on the limit. True if any stops. */
bool planes_stop_slow(struct run *run)
{
    struct fbd_state *state = run->state;
    const struct tree *tree = run->model->tree;
    bool any = false;
    state_evaluate(state);
    for (int i = 0; i < tree->coupling_count; i++) {
        const int pair = tree->couplings[i].pair;
        if (tree->couplings[i].kind != constraint_plane || state->slip[pair] == stick ||
            coupling_is_gone(state->tree, &tree->couplings[i]) || state->tree->couplings[i].gently)
            continue;
        if (!is_slow(run, pair) || !slows_down(state, i)) continue;
        state->slip[pair] = stick;
        any = true;
    }
    if (any) state_project_velocity(state, false);
    return any;
}
