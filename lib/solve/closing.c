/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings that close loops: a start that does not fit is refused, and every step ends on the constraints.
 */
#include <gsl/gsl_errno.h>
#include <string.h>

#include "dynamics/energy.h"
#include "dynamics/project.h"
#include "dynamics/tree_system.h"
#include "solve/fit.h"
#include "solve/run.h"

static bool has_ties(const struct run *run)
{
    return run->model->tree && run->model->tree->tie_count > 0;
}

static double kinetic(struct fbd_state *state)
{
    struct instant at = state_instant(state);
    double sum = 0;
    tree_move(state->model, &at);
    for (size_t b = 0; b < state->model->body_count; b++)
        if (state->model->bodies[b].place.link > 0) sum += kinetic_energy(&state->model->bodies[b], &at);
    return sum;
}

static const char *tie_name(const struct run *run, int row)
{
    const struct tree *tree = run->model->tree;
    return tree->ties[tree->tie_of_row[row]].name;
}

void run_close_start(struct run *run)
{
    struct text lack = {0};
    if (!has_ties(run)) return;
    if (fit_lack(run->state, run->during, &lack))
        run_fail(run, FBD_FAILED, "the start does not fit: %s", lack.failed ? "" : lack.data);
    else
        state_project(run->state, false);
    text_free(&lack);
}

/* The largest change from `from` to `to`, in tolerances of the largest size that each number has had. */
static double tolerances_apart(const struct run *run, const double *from, const double *to)
{
    size_t n = (size_t)run->model->plan.n;
    const double *most = run->anchor + 2 * n;
    double apart = 0;
    for (size_t i = 0; i < 2 * n; i++) {
        double moved = fabs(to[i] - from[i]);
        if (moved > 0) apart = fmax(apart, moved / (run->options.tolerance * fmax(most[i], fabs(to[i]))));
    }
    return apart;
}

/* y[2n] at time t, brought back; by how much. */
static double close_at(struct run *run, double t, double *y)
{
    struct instant at = state_instant(run->during);
    double *before = run->sample;
    memcpy(before, y, 2 * (size_t)run->model->plan.n * sizeof *y);
    at.t = t;
    return_to_constraints(run->model, &at, y);
    return tolerances_apart(run, before, y);
}

void run_close_within(struct run *run, double t, double *y)
{
    const double far = 100;
    if (!has_ties(run)) return;
    double moved = close_at(run, t, y);
    if (moved <= far) return;
    /* The curve through a step that passes a singular position may be off by more than the step's end is: no
     * error estimate covers what it is made of. Steps that end at t have one. */
    size_t n = (size_t)run->model->plan.n;
    double *other = run->aside, *f = other + 2 * n;
    if (switcher_walk(run->stepper, t, other, f) == GSL_SUCCESS && close_at(run, t, other) < moved)
        memcpy(y, other, 2 * n * sizeof *y);
}

/* A multistep method goes on from what it remembers, which a return to the constraints does not change. When
 * that has gone far it starts anew: near a singular position being off grows. */
bool run_has_gone_astray(const struct run *run)
{
    const double far = 10;
    if (!run->projected || !run->options.method->multistep) return false;
    return tolerances_apart(run, run->y, run->state->y) > far;
}

void run_close_step(struct run *run)
{
    if (!has_ties(run)) return;
    struct misfit misfit = state_misfit(run->state);
    run->drift = fmax(run->drift, misfit.position);
    run->projected = true;
    double before = kinetic(run->state);
    state_return(run->state);
    double after = kinetic(run->state);
    run->liveliest = fmax(run->liveliest, fmax(before, after));
    struct misfit left = state_misfit(run->state);
    double reach = 0;
    for (int i = 1; i < run->model->tree->count; i++)
        reach = fmax(reach, vec_norm(run->state->tree->links[i].p));
    run->left = fmax(run->left, left.position);
    /* Where a mechanism can fold over to another branch (all bars in one line) a step may start to, and going
     * back takes the energy with it: that is no rounding any more. */
    if (!(fabs(after - before) <= 1e4 * fmax(run->options.tolerance, 1e-12) * run->liveliest)) {
        run_fail(run, FBD_FAILED,
                 "at t = %.9g the couplings pass a singular position, where the mechanism could go on in two "
                 "ways, and "
                 "the step cannot tell which: try another tolerance or --method dop853",
                 run->state->t);
        return;
    }
    if (left.position <= 1e3 * fmax(run->options.tolerance, 1e-12) * reach) return;
    run_fail(run, FBD_FAILED,
             "at t = %.9g the coupling `%s` cannot be closed any more (it is off by %.3g): the mechanism is "
             "at the end "
             "of its reach, or the tolerance is too large",
             run->state->t, tie_name(run, misfit.row >= 0 ? misfit.row : 0), misfit.position);
}
