/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dense output: states within the last step of a run.
 */
#include <gsl/gsl_errno.h>
#include <string.h>

#include "loop/run.h"

int run_panels(const struct run *run)
{
    enum { most = 100, nystrom = 2, general = 1 }; /* a step of the Nystrom method is longer */
    if (run->kind != structure_linear) return run->kind == structure_velocity_free ? nystrom : general;
    double rate = linear_pace_rate(&run->pace, run->step.from), span = run->state->t - run->step.from;
    return (int)fmin(fmax(1, ceil(2 * span * rate)), most);
}

bool run_coordinates(struct run *run, struct time_dd t, double *y)
{
    if (time_dd_equal(t, run_end(run))) {
        memcpy(y, run->state->y, plan_size(&run->model->plan) * sizeof *y);
        return true;
    }
    if (switcher_dense(run->stepper, t, y) != GSL_SUCCESS) return false;
    project_within(run, t.t, y);
    return true;
}

bool run_place(struct run *run, struct time_dd t, struct fbd_state *state)
{
    state_copy(state, run->during);
    state_set_moment(state, t);
    if (!run_coordinates(run, t, state->y)) return false;
    modes_hold(state);
    return true;
}

bool run_look(struct run *run, struct time_dd t, struct fbd_state *state)
{
    if (!run_place(run, t, state)) return false;
    state_evaluate(state);
    return true;
}

/* Are all velocities of a linear system constant in the present modes? Every step ends with the same accelerations. */
static bool moves_evenly(const struct run *run)
{
    size_t n = (size_t)run->model->plan.n;
    bool even = run->pace.now && run->pace.now->even;
    for (size_t i = n; even && i < 2 * n; i++) even = run->work.f[i] == 0;
    return even;
}

bool run_keeps_force(const struct run *run, size_t load)
{
    if (state_sliding(run->during)) return false; /* the weights of its branches vary */
    if (run->flies || run->kind == structure_constant) return true;
    if (run->kind != structure_linear) return false;
    if (moves_evenly(run)) return true;
    if (!run->keeps_force[load]) return false;
    int pair = run->model->bodies[run->model->loads[load].body].friction;
    return pair < 0 || run->during->slip[pair] != stick;
}

bool run_look_mean(struct run *run, struct time_dd from, struct time_dd to, bool forces,
                   struct fbd_state *state)
{
    double length = time_dd_since(to, from), *begin = run->work.sample;
    state_copy(state, run->during);
    state_set_moment(state, time_dd_after(from, length / 2));
    if (!run_coordinates(run, from, begin) || !run_coordinates(run, to, state->y)) return false;
    size_t n = (size_t)run->model->plan.n;
    for (size_t i = 0; i < n; i++) {
        double moved = state->y[i] - begin[i];
        state->y[i] = begin[i] + moved / 2;
        state->y[n + i] = moved / length;
    }
    if (forces) state_evaluate(state);
    return true;
}
