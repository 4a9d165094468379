/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The velocities and tolerances by which modes are decided.
 */

#include "dynamics/constraint.h"
#include "dynamics/modes.h"
#include "numeric/tolerances.h"

bool mode_has_ended(const struct fbd_state *state, int pair)
{
    const int coupling = state->model->plan.modes[pair].coupling;
    return coupling >= 0 && coupling_is_gone(state->tree, &state->model->tree->couplings[coupling]);
}

bool mode_is_off_surface(const struct fbd_state *state, int pair)
{
    const int coupling = state->model->plan.modes[pair].coupling;
    if (coupling < 0) return false;
    if (mode_has_ended(state, pair)) return true;
    int surface = state->model->tree->couplings[coupling].surface;
    return surface >= 0 && state->slip[surface] != stick;
}

double slip_velocity(const struct fbd_model *model, int pair, const struct instant *at)
{
    const struct mode *mode = &model->plan.modes[pair];
    if (mode->coupling >= 0) return coupling_slip_velocity(model, at, mode->coupling);
    double v = at->y[model->plan.n + mode->coordinate], acceleration;
    double s = friction_surface_speed(mode, at, &acceleration);
    return fabs(v - s) <= round_off(4, fabs(s)) ? 0 : v - s;
}

double settling_velocity(const struct fbd_state *state, const struct decided *decided, int pair)
{
    struct instant at = state_instant(state);
    if (decided && (state->slip[pair] == stick || state->slip_rests[pair]) &&
        state->model->plan.modes[pair].kind != mode_single)
        return 0;
    return slip_velocity(state->model, pair, &at);
}

double settling_slack(const struct fbd_state *state, const struct decided *decided, int pair,
                      const struct friction_values *now, const struct friction_values *rate)
{
    double slack = friction_rounding_of_time(now, rate, state->t);
    bool comes_back = decided && (mode_of(state, pair)->coupling >= 0 || !state->slip_rests[pair]);
    return comes_back ? fmax(slack, friction_return(now)) : slack;
}

double press_slack(const struct fbd_model *model, const struct tree_work *tree, int b)
{
    const struct model_body *body = &model->bodies[b];
    double size = body->inertia.mass * vec_norm(model->scene->gravity);
    for (int i = 1; !body->alone && i < model->tree->joined; i++) {
        size = fmax(size, vec_norm(tree->links[i].F.force));
        size = fmax(size, vec_norm(model->tree->links[i].force));
    }
    return negligible_part * size;
}
