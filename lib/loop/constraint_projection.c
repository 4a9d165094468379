/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings that close loops: a start that violates them is refused, and every step ends on the constraints.
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "dynamics/modes.h"
#include "dynamics/project.h"
#include "dynamics/tree_driven.h"
#include "dynamics/tree_system.h"
#include "loop/run.h"
#include "numeric/tolerances.h"
#include "rest/balance.h"
#include "rest/fit.h"

/* The largest change from `from` to `to`, in tolerances relative to the largest value of each number so far. A body that
 * does not move along a coordinate has no such value: changes by the rounding of the mechanism are none. */
static double tolerances_apart(const struct run *run, const double *from, const double *to)
{
    const double roundings = round_off(64, 1), reach = run->drift.reach, speed = run->drift.speed;
    const struct coordinate *coordinates = run->model->scene->coordinates;
    size_t n = (size_t)run->model->plan.n;
    const double *most = run->recent.anchor + plan_size(&run->model->plan);
    double apart = 0;
    for (size_t i = 0; i < 2 * n; i++) {
        double moved = fabs(to[i] - from[i]), size = i < n ? reach : speed;
        if (moved * (coordinates[i % n].angle ? reach : 1) > roundings * size)
            apart = fmax(apart, moved / (run->options.tolerance * fmax(most[i], fabs(to[i]))));
    }
    return apart;
}

/* Project y at time t; returns the change, in tolerances. */
static double close_at(struct run *run, double t, double *y)
{
    struct instant at = state_instant(run->during);
    double *before = run->work.sample;
    memcpy(before, y, plan_size(&run->model->plan) * sizeof *y);
    at.t = t;
    return_to_constraints(run->model, &at, y);
    return tolerances_apart(run, before, y);
}

void project_within(struct run *run, double t, double *y)
{
    const double far = 100;
    if (!tree_has_couplings(run->model->tree) || run->flies) return; /* in flight no constraint acts */
    double moved = close_at(run, t, y);
    if (moved <= far) return;
    /* In a step past a singular position the dense output may be less accurate than the end of the step,
     * since it has no error estimate. Steps that end at t have one. */
    size_t size = plan_size(&run->model->plan);
    double *other = run->work.aside, *f = other + size;
    int code = switcher_walk(run->stepper, time_dd_at(t), other, f);
    if (code == GSL_ENOMEM) run_fail(run, FBD_OUT_OF_MEMORY, "out of memory");
    if (code == GSL_SUCCESS && close_at(run, t, other) < moved) memcpy(y, other, size * sizeof *y);
}

/* Effect of rounding in the last step: in a scene at rest accelerations are the residuals of cancelling
 * forces, 1e-12 of the acceleration by one of the forces alone (some thousand roundings); at the start of a
 * drive, velocities are differences of positions. */
struct rounding {
    double speed, way; /* caused by rounding in the step: [m/s], [m] */
    double energy;     /* kinetic energy of all bodies at that speed */
};

static struct rounding rounding_of_step(struct run *run)
{
    const struct tree *tree = run->model->tree;
    double mass = 0, most = 0, time = run->state->t - run->step.from;
    state_evaluate_unshared(run->state);
    for (int i = 1; i < tree->joined; i++) {
        mass += tree->links[i].mass;
        most = fmax(most, vec_norm(run->state->tree->links[i].F.force) / tree->links[i].mass);
        most = fmax(most, vec_norm(tree->links[i].force) / tree->links[i].mass);
    }
    for (int k = 0; k < tree->coupling_count; k++) { /* forces of couplings, which are not in F */
        const struct coupling *coupling = &tree->couplings[k];
        for (int j = 0; j < coupling->row_count * coupling->end_count; j++) {
            const struct tree_link *link = &tree->links[coupling->end[j / coupling->row_count].link];
            double force = run->state->tree->rows[coupling->first_row + j % coupling->row_count].lambda;
            if (link->mass > 0) most = fmax(most, fabs(force) / link->mass);
        }
    }
    double unseen = round_off(16, run->drift.reach); /* a displacement at round-off level of positions */
    double speed = negligible_sum * most * time + (time > 0 ? unseen / time : 0);
    return (struct rounding){speed, speed * time, mass * speed * speed / 2};
}

/* Has the projection moved the state by rounding only, of a scene at rest for example? */
static bool is_moved_by_rounding(struct run *run)
{
    const double roundings = round_off(64, 1);
    const struct coordinate *coordinates = run->model->scene->coordinates;
    size_t n = (size_t)run->model->plan.n;
    struct rounding rounding = rounding_of_step(run);
    double reach = run->drift.reach, speed = run->drift.speed;
    const double least[] = {rounding.way + roundings * reach, rounding.speed + roundings * speed};
    for (size_t i = 0; i < 2 * n; i++) {
        double moved = fabs(run->work.y[i] - run->state->y[i]) * (coordinates[i % n].angle ? reach : 1);
        if (!(moved <= least[i / n])) return false;
    }
    return true;
}

/* A multistep method continues from its history, which the projection does not change. If the projection was
 * large the method restarts: near a singular position violations grow. */
bool projection_has_failed(struct run *run)
{
    const double far = 10;
    if (!run->projected || !run->options.method->multistep) return false;
    return tolerances_apart(run, run->work.y, run->state->y) > far && !is_moved_by_rounding(run);
}

/* Update the size and the speed of the mechanism, including the ends of couplings; returns its present size. */
static double measure(struct run *run)
{
    const struct tree *tree = run->model->tree;
    double reach = 0, speed = 0;
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_state *s = &run->state->tree->links[i];
        reach = larger(reach, vec_norm(s->p));
        speed = larger(speed, vec_norm(s->v));
    }
    for (int k = 0; k < tree->coupling_count; k++)
        for (int j = 0; j < tree->couplings[k].end_count; j++) {
            const struct coupling_end *end = &tree->couplings[k].end[j];
            const struct tree_state *s = &run->state->tree->links[end->link];
            double arm = end->radius + vec_norm(end->point);
            reach = larger(reach, vec_norm(s->p) + arm);
            speed = larger(speed, vec_norm(s->v) + fabs(s->omega) * arm);
        }
    /* Shapes have a size wherever they are. A stop of an angle has one also where no body has a length, as of
     * a wheel about its centre. */
    for (int i = 0; i < tree->meeting_count; i++)
        reach = larger(reach, tree->meetings[i].stop != 0 ? tree->meetings[i].reach : tree->meetings[i].size);
    run->drift.reach = fmax(run->drift.reach, reach);
    run->drift.speed = fmax(run->drift.speed, speed);
    return reach;
}

/* Of a step: an error below the least one is round-off. */
static double tolerance_of(const struct run *run)
{
    return fmax(run->options.tolerance, least_part_tolerance);
}

/* Accepted violation at the end of a step before projection, relative to the size of the mechanism: from the
 * tolerance, or larger for a fixed step without error control. */
static double explained(const struct run *run)
{
    const double many = 1e4, unknown = 0.1;
    return run->options.step > 0 ? unknown : fmin(many * tolerance_of(run), unknown);
}

/* Fail if a slack rope exceeds its length without having become taut: the event was missed. To close it now
 * would cause a large velocity jump. */
static bool overlong_rope(struct run *run, double most)
{
    const struct plan *plan = &run->model->plan;
    struct instant at = state_instant(run->state);
    for (size_t i = 0; i < plan->mode_count; i++) {
        if (plan->modes[i].kind != mode_rope || run->state->slip[i] == stick) continue;
        if (mode_has_ended(run->state, (int)i)) continue;
        int coupling = plan->modes[i].coupling;
        double excess = one_sided_at(run->model, &at, (int)i).excess;
        if (excess <= most) continue;
        const char *name = run->model->tree->couplings[coupling].name;
        if (isnan(excess))
            run_fail(run, FBD_FAILED,
                     "at t = %.9g the slack rope `%s` has no path: one of its ends is within a circle that "
                     "it runs over. End the run earlier by an event",
                     run_time(run), name);
        else
            run_fail(
                run, FBD_FAILED,
                "at t = %.9g the rope `%s` is longer than it is by %.3g: the instant at which it became taut "
                "was missed. Try a smaller tolerance or step",
                run_time(run), name, excess);
        return true;
    }
    return false;
}

/* Project the end of the step, and record the residuals. */
static struct closing bring_back(struct run *run)
{
    struct drift *drift = &run->drift;
    struct closing closing = state_close(run->state);
    const struct misfit *off = &closing.off, *left = &closing.left;
    if (off->row >= 0 && (!drift->worst || off->position > drift->position))
        drift->worst = coupling_row_name(run->model->tree, off->row);
    drift->position = fmax(drift->position, off->position);
    drift->velocity = fmax(drift->velocity, off->velocity);
    drift->left_position = fmax(drift->left_position, left->position);
    drift->left_velocity = fmax(drift->left_velocity, left->velocity);
    return closing;
}

/* For a structure at rest the error estimate is only rounding, and steps grow without limit. A violation by
 * rounding is accepted; the next step is shorter, so that it stays small. */
static bool is_rounding(struct run *run, const struct misfit *misfit)
{
    if (!(misfit->position <= rounding_of_step(run).way)) return false;
    run->step.h = fmin(run->step.h, (run->state->t - run->step.from) / 2);
    return true;
}

/* Do the prescribed motions lead to positions where the couplings cannot be closed? Tested some steps ahead,
 * where a singular position that is only passed lies behind; not less than 1e-3 of the first step, since
 * steps near such a position are short. `during` is free. */
static bool ends_reach(struct run *run)
{
    struct fbd_state *later = run->during;
    double after = fmax(10 * (run->state->t - run->step.from), 1e-3 * run->step.first);
    if (!model_is_driven(run->model)) return false;
    for (int looks = 0; looks < 3; looks++) {
        state_copy(later, run->state);
        later->t = run->state->t + after;
        after *= 10;
        later->rest = 0;
        modes_hold(later);
        if (state_project(later, false)) return false;
    }
    return true;
}

/* Rounding of forces displaces the lightest bodies: report that where the mass ratio is large. */
static bool fail_by_masses(struct run *run, const struct misfit *misfit)
{
    const double ratio = run->model->tree->mass_ratio;
    if (ratio <= masses_far_apart) return false;
    run_fail(
        run, FBD_FAILED,
        "at t = %.9g the coupling `%s` cannot be closed (its error is %.3g): the heaviest of the "
        "jointed bodies has %.2g times the mass of the lightest, and up to about 1e12 can be solved. Give "
        "the lightest one more mass",
        run_time(run), coupling_row_name(run->model->tree, misfit->row >= 0 ? misfit->row : 0),
        misfit->position, ratio);
    return true;
}

static void fail_singular(struct run *run, const struct misfit *misfit)
{
    if (ends_reach(run))
        run_fail(run, FBD_BROKEN,
                 "at t = %.9g the mechanism is at the end of its reach: the prescribed motion leads to "
                 "positions where the coupling `%s` cannot be closed",
                 run_time(run), coupling_row_name(run->model->tree, misfit->row >= 0 ? misfit->row : 0));
    else if (!fail_by_masses(run, misfit))
        run_fail(run, FBD_FAILED,
                 "at t = %.9g the couplings pass a singular position, where two motions are possible, and "
                 "the step does not determine which: try another tolerance or --method dop853",
                 run_time(run));
}

void projection_begin(struct run *run)
{
    measure(run);
}

void project_step(struct run *run)
{
    if (!tree_has_couplings(run->model->tree)) return;
    run->projected = true;
    const struct closing closing = bring_back(run);
    const struct misfit misfit = closing.off, left = closing.left;
    const double before = closing.energy[0], after = closing.energy[1];
    constraints_follow(run->model, run->state->tree);
    run->liveliest = fmax(run->liveliest, fmax(before, after));
    double reach = measure(run);
    if (!run_is_exact(run)) coupled_scales_set_floors(&run->mechanisms, run->state, run->stepper);
    if (overlong_rope(run, explained(run) * reach)) return;
    /* Positions near the origin have no size there: a stop at zero. */
    bool nothing = misfit.position <= round_off(16, run->drift.reach);
    bool explains = nothing || misfit.position <= explained(run) * reach;
    nothing |= !explains && is_rounding(run, &misfit);
    if (!explains && !nothing) {
        run_fail(
            run, FBD_FAILED,
            "at t = %.9g the coupling `%s` is off by %.3g, far more than the error of a step: the mechanism "
            "moves too fast there for the tolerance or the step",
            run_time(run), coupling_row_name(run->model->tree, misfit.row >= 0 ? misfit.row : 0),
            misfit.position);
        return;
    }
    /* Where a mechanism can change to another branch (all bars in one line) a step may begin to do so, and
     * the projection back changes the energy by more than rounding. */
    if (!(fabs(after - before) <= 1e4 * tolerance_of(run) * run->liveliest) &&
        !(fabs(after - before) <= rounding_of_step(run).energy)) {
        fail_singular(run, &misfit);
        return;
    }
    if (nothing || left.position <= 1e3 * tolerance_of(run) * reach) return;
    if (!fail_by_masses(run, &misfit))
        run_fail(run, FBD_FAILED,
                 "at t = %.9g the coupling `%s` cannot be closed (its error is %.3g): the mechanism is at "
                 "the end of its reach, or the tolerance is too large",
                 run_time(run), coupling_row_name(run->model->tree, misfit.row >= 0 ? misfit.row : 0),
                 misfit.position);
}

/* A slip velocity at round-off level has an arbitrary sign. It is removed if its acceleration is so small
 * that the longest step would not make it significant. */
void rest_held(struct run *run)
{
    const double rounding = evaluation_rounding, little = negligible_sum;
    const struct plan *plan = &run->model->plan;
    const double *most = run->recent.anchor + plan_size(plan) + plan->n;
    const struct instant at = state_instant(run->state);
    bool evaluated = false;
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        if (!mode_is_joint_friction(mode) || mode->coupling >= 0 || run->state->slip[pair] == stick) continue;
        double v = slip_velocity(run->model, pair, &at), fastest = most[mode->coordinate];
        if (v == 0 || fabs(v) > rounding * fastest) continue;
        if (!evaluated) state_evaluate_unshared(run->state);
        evaluated = true;
        double a = tree_hold_acceleration(run->state, &at, pair);
        if (fabs(a) * run->step.longest <= little * fastest) run->state->y[plan->n + mode->coordinate] -= v;
    }
}

void run_check_balance(struct run *run)
{
    struct text lack = {0};
    run_evaluate(run);
    if (run->end.outcome == FBD_GOING && balance_lack(run->state, &lack))
        run_fail(run, lack.failed ? FBD_OUT_OF_MEMORY : FBD_FAILED, "%s",
                 lack.failed ? "out of memory" : lack.data);
    text_free(&lack);
}
