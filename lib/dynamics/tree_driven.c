/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A drive that starts from rest, and a mechanism in a dead centre, have neither velocity nor acceleration
 * there, and further rates may be zero. So the drives are followed for increasing times, from 1e-12 s on,
 * until a velocity exceeds rounding.
 */
#include "dynamics/tree_driven.h"

#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/friction.h"
#include "dynamics/project.h"
#include "dynamics/tree_system.h"
#include "numeric/tolerances.h"

double tree_hold_acceleration(const struct fbd_state *state, const struct instant *at, int pair)
{
    const struct mode *hold = mode_of(state, pair);
    double surface;
    if (hold->coupling >= 0) return hold_sign(hold) * hold_row(state, hold)->g.x2;
    friction_surface_speed(hold, at, &surface);
    return state->a[hold->coordinate] - surface;
}

/* Do the velocities roughly satisfy the active rows? If not, accelerations along rows are due to that. At
 * rest they have the rounding of accelerations [m/s^2] of this size over the time. */
static bool velocities_fit(const struct fbd_state *state, double size)
{
    const double large = 0.01, rounding = undecided_part;
    const struct tree *tree = state->model->tree;
    const struct instant at = state_instant(state);
    double fastest = 0, off = 0;
    for (int i = 1; i < tree->count; i++) fastest = fmax(fastest, vec_norm(state->tree->links[i].v));
    for (int j = 0; j < tree->row_count; j++)
        if (tree_takes_part(tree, &at, j)) off = fmax(off, fabs(state->tree->rows[j].g.x1));
    return off <= large * fastest || off <= rounding * size * fabs(state->t);
}

bool tree_seen_acceleration(const struct fbd_state *state, double a)
{
    double size = vec_norm(state->model->scene->gravity);
    for (int i = 1; i < state->model->tree->count; i++)
        size = fmax(size, vec_norm(state->tree->links[i].A.a));
    return fabs(a) > undecided_part * size && velocities_fit(state, size);
}

double tree_coupled_acceleration(const struct fbd_state *state)
{
    const struct instant at = state_instant(state);
    double most = 0;
    for (int j = 0; j < state->model->tree->row_count; j++)
        if (tree_takes_part(state->model->tree, &at, j))
            most = fmax(most, fabs(state->tree->rows[j].lambda * state->tree->diagonal[j]));
    return most;
}

static double reach_of(const struct fbd_state *state)
{
    double reach = 0;
    for (int i = 1; i < state->model->tree->count; i++)
        reach = fmax(reach, vec_norm(state->tree->links[i].p));
    return reach;
}

double tree_unseen_speed(const struct fbd_state *state, double time)
{
    const double share = negligible_sum, roundings = round_off(64, 1);
    double fastest = 0;
    for (int i = 1; i < state->model->tree->count; i++)
        fastest = fmax(fastest, vec_norm(state->tree->links[i].v));
    return fmax(share * fastest, time > 0 ? roundings * reach_of(state) / time : 0);
}

/* The velocity along a constraint, 0 within rounding. */
static double velocity_along(const struct fbd_state *state, int pair, double dt)
{
    const struct mode *hold = mode_of(state, pair);
    struct instant at = state_instant(state);
    bool angle = hold->coupling < 0 && state->model->scene->coordinates[hold->coordinate].angle;
    double reach = reach_of(state), arm = angle && reach > 0 ? reach : 1;
    double v = mode_is_friction(hold) ? slip_velocity(state->model, pair, &at)
                                      : hold_sign(hold) * hold_row(state, hold)->g.x1;
    return fabs(v) * arm > tree_unseen_speed(state, dt) ? v : 0;
}

double tree_driven(struct fbd_state *state, const int *slip, int pair)
{
    enum { decades = 15 };
    const double soonest = 1e-12, next = 10; /* [s]; ratio */
    size_t n = (size_t)state->model->plan.n, pairs = state->model->plan.mode_count;
    if (!model_has_speeds_given(state->model)) return 0;
    double v = mode_is_friction(mode_of(state, pair)) ? velocity_along(state, pair, 0) : 0;
    struct fbd_state *then = v == 0 ? state_new(state->model) : NULL;
    if (v == 0 && !then) state->holds.found = holds_no_memory;
    double dt = soonest;
    for (int k = 0; then && v == 0 && k <= decades; k++) {
        state_copy(then, state);
        memcpy(then->slip, slip, pairs * sizeof *slip);
        state_set_moment(then, time_dd_at(state->t + dt));
        for (size_t i = 0; i < n; i++) then->y[i] += dt * then->y[n + i];
        modes_hold(then);
        if (!state_project(then, false)) break;
        v = velocity_along(then, pair, dt);
        dt *= next;
    }
    state_free(then);
    return v;
}

bool tree_rests(const struct fbd_state *state)
{
    int n = state->model->plan.n;
    double fastest = 0;
    for (int i = 0; i < n; i++) fastest = fmax(fastest, fabs(state->y[n + i]));
    return fastest == 0 || (state->t > 0 && fastest <= round_off(64, fmin(1, reach_of(state))) / state->t);
}

/* With q' = a T the rows have the residual q'.H q', whose sign is that of the motion, for any T. */
double tree_sets_out(struct fbd_state *state, const int *slip, int pair)
{
    const double T = 1e3;
    size_t n = (size_t)state->model->plan.n, pairs = state->model->plan.mode_count;
    if (!tree_rests(state)) return 0;
    struct fbd_state *then = state_new(state->model);
    double along = 0;
    if (!then) {
        state->holds.found = holds_no_memory;
        return 0;
    }
    state_copy(then, state);
    memcpy(then->slip, slip, pairs * sizeof *slip);
    for (size_t i = 0; i < n; i++) then->y[n + i] = T * state->a[i];
    state_evaluate_unshared(then);
    const struct instant at = state_instant(then);
    along = tree_hold_acceleration(then, &at, pair);
    if (!tree_seen_acceleration(then, along)) along = 0;
    state_free(then);
    return along;
}

/* Does friction of a joint or coupling stick? Contacts do not count. */
static bool any_sticks(const struct fbd_state *state)
{
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++) {
        const struct mode *mode = mode_of(state, pair);
        bool touches = mode->coupling >= 0 && state->model->tree->couplings[mode->coupling].meeting >= 0;
        if (mode_is_friction(mode) && !touches && state->slip[pair] == stick) return true;
    }
    return false;
}

bool tree_is_locked(struct fbd_state *state)
{
    if (!tree_rests(state) || !any_sticks(state)) return false;
    struct fbd_state *other = state_new(state->model);
    if (!other) state->holds.found = holds_no_memory;
    bool locked = other && state_locked_row(state, other) >= 0;
    state_free(other);
    return locked;
}

/* ---- other modes may be consistent as well */

/* Has a surface with friction a negative response to its normal force (Painleve)? */
static bool answers_wrongly(const struct fbd_state *state)
{
    const struct tree *tree = state->model->tree;
    const struct instant at = state_instant(state);
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (!coupling_rubs(coupling) || tree_rubbing_share(state->model, &at, i) == 0) continue;
        if (state->tree->diagonal[coupling->normal_row] < 0) return true;
    }
    return false;
}

/* Is there a switch in a sliding mode whose branches have no effect beyond rounding, due to closed
 * constraints? */
static bool shares_fail(const struct fbd_state *state)
{
    const double most = 1e9;
    const struct sliding *s = state_sliding(state);
    bool fail = s && s->failed;
    for (int j = 0; s && j < s->count; j++) fail |= !(fabs(s->slides[j].share) <= most);
    return fail;
}

bool tree_is_doubtful(const struct fbd_state *state)
{
    return answers_wrongly(state) || shares_fail(state);
}
