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

bool run_look(struct run *run, struct time_dd t, struct fbd_state *state)
{
    state_copy(state, run->during);
    state_set_moment(state, t);
    if (!run_coordinates(run, t, state->y)) return false;
    modes_hold(state);
    state_evaluate(state);
    return true;
}
