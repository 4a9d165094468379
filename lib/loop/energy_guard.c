/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/energy_guard.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "dynamics/energy.h"
#include "dynamics/load_rounding.h"
#include "dynamics/tree.h"
#include "loop/ensemble.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

double energy_explained(double tolerance, double steps, double in_motion, double terms)
{
    /* Runs of few steps are allowed a hundred; tolerances below their rounding are raised. Measured over the
     * gallery, by methods from 1e-4 to 1e-10: residuals are up to a half of this by msadams with a bouncing
     * ball, and up to an eighth elsewhere. */
    const double least_steps = 100, least_tolerance = negligible_part, tolerances = 4, roundings = 1e-11;
    return tolerances * (steps + least_steps) * fmax(tolerance, least_tolerance) * in_motion +
           roundings * terms;
}

void energy_guard_begin(struct run *run)
{
    run->energy.t = run->state->t;
    run->energy.jumps = run->energy.lowered = 0;
    memcpy(run->energy.y, run->state->y, plan_size(&run->model->plan) * sizeof *run->energy.y);
}

double energy_of_impacts(const struct run *run)
{
    double sum = 0;
    for (size_t i = 0; i < run->model->load_count; i++) sum += run->impact_work[i];
    return sum - run->energy.lowered;
}

double energy_of_place(const struct run *run)
{
    const struct instant at = state_instant(run->state);
    double sum = 0;
    for (size_t i = 0; i < run->model->load_count; i++)
        sum += potential_energy(run->model, &run->model->loads[i], &at, run->work.sample);
    return sum;
}

/* Kinetic energy, in the scratch of `during`, which is unused then. `branch`: of masses that vary. */
static double kinetic_at(struct run *run, double t, const double *y, const int *branch)
{
    const struct fbd_model *model = run->model;
    struct instant at = state_instant_at(run->during, t, y);
    double sum = 0;
    at.branch = branch;
    tree_move(model, &at);
    for (size_t b = 0; b < model->body_count; b++) sum += kinetic_energy(&model->bodies[b], &at);
    return sum;
}

void energy_guard_events(struct run *run, double before)
{
    size_t n = (size_t)run->model->plan.n;
    const double *y = run->state->y, *old = run->work.y, done = energy_of_impacts(run) - before;
    if (done == 0 && memcmp(y + n, old + n, n * sizeof *y) == 0) return;
    double after = kinetic_at(run, run->state->t, y, run->state->branch);
    run->energy.jumps += after - kinetic_at(run, run->state->t, old, run->during->branch) - done;
}

bool energy_has_potentials(const struct fbd_model *model)
{
    for (size_t i = 0; i < model->load_count; i++)
        if (model->loads[i].potential_kind == potential_none || model->loads[i].source->lifetime.number > 0)
            return false;
    return true;
}

/* An upper bound of the kinetic energy: that of the largest rates so far, at the final positions. */
static double in_motion(struct run *run)
{
    size_t n = (size_t)run->model->plan.n, size = plan_size(&run->model->plan);
    const double *most = run->recent.anchor + size;
    double *y = run->work.aside;
    memcpy(y, run->state->y, size * sizeof *y);
    for (size_t i = n; i < 2 * n; i++) y[i] = fmax(fabs(y[i]), most[i]);
    return kinetic_at(run, run->state->t, y, run->state->branch);
}

/* Potential energy, and the sum of its terms. */
static double potential_at(struct run *run, double t, const double *y, double *terms)
{
    struct instant at = state_instant_at(run->during, t, y);
    double sum = 0;
    at.branch = NULL; /* the same branches at both ends */
    tree_move(run->model, &at);
    for (size_t i = 0; i < run->model->load_count; i++) {
        double potential = potential_energy(run->model, &run->model->loads[i], &at, run->work.sample);
        sum += potential;
        *terms += fabs(potential);
    }
    return sum;
}

struct energy_balance run_energy_balance(struct run *run)
{
    const struct energy_guard *guard = &run->energy;
    const double steps = (double)switcher_counts(run->stepper).accepted;
    struct energy_balance balance = {guard->jumps, HUGE_VAL};
    double terms = 0, moving = in_motion(run);
    if (run->options.step > 0) return balance;
    if (energy_has_potentials(run->model)) {
        double end = kinetic_at(run, run->state->t, run->state->y, run->state->branch),
               start = kinetic_at(run, guard->t, guard->y, run->state->branch);
        moving = fmax(moving, fmax(start, end));
        balance.residual = end - start + potential_at(run, run->state->t, run->state->y, &terms) -
                           potential_at(run, guard->t, guard->y, &terms) -
                           (energy_of_impacts(run) + guard->lowered);
    }
    balance.explained = energy_explained(run->options.tolerance, steps, moving, moving + terms);
    if (!(fabs(balance.residual) > balance.explained)) return balance;
    run_evaluate(run);
    struct rounded rounded = rounded_at(run->state);
    double past = run->state->t - guard->t, nothing = round_off(rounded.ways, past * past) / fmax(steps, 1);
    balance.explained =
        energy_explained(run->options.tolerance, steps, moving, moving + terms + rounded.places) + nothing;
    return balance;
}

struct energy_balance ensemble_energy_balance(struct ensemble *ensemble)
{
    struct energy_balance worst = {0, HUGE_VAL};
    double beyond = -1;
    for (size_t g = 0; g < ensemble->count; g++) {
        struct energy_balance one = group_totals(&ensemble->groups[g]).energy;
        double ratio = fabs(one.residual) / one.explained; /* NAN without motion, or without a bound */
        if (!(ratio > beyond)) continue;
        beyond = ratio;
        worst = one;
    }
    return worst;
}
