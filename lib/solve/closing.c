/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings that close loops: a start that does not fit is refused, and every step ends on the constraints.
 */
#include <string.h>

#include "base/text.h"
#include "dynamics/energy.h"
#include "dynamics/project.h"
#include "dynamics/tree_system.h"
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

/* "rod.theta = -0.7, ...": what has to change. */
static void list_changes(struct text *text, const struct fbd_state *from, const struct fbd_state *to)
{
    enum { most_listed = 6 };
    const struct fbd_model *model = from->model;
    int n = model->plan.n, listed = 0;
    for (int i = 0; i < 2 * n; i++) {
        double size = fmax(1, fabs(from->y[i]));
        if (fabs(to->y[i] - from->y[i]) <= 1e-9 * size) continue;
        if (listed++ >= most_listed) continue;
        const struct label *label = &model->labels[i % n];
        text_printf(text, "%s%s = ", listed > 1 ? ", " : "", i < n ? label->name : label->rate_name);
        text_number(text, to->y[i], 9);
    }
    if (listed > most_listed) text_add(text, ", ...");
}

static void refuse(struct run *run, const struct misfit *misfit, bool by_velocity)
{
    struct text text = {0};
    state_copy(run->during, run->state);
    bool closed = state_project(run->during, false);
    list_changes(&text, run->state, run->during);
    int row = by_velocity ? misfit->velocity_row : misfit->row;
    run_fail(run, FBD_FAILED, "the start does not fit: `%s` is off by %.3g%s. %s%s%s", tie_name(run, row),
             by_velocity ? misfit->velocity : misfit->position, by_velocity ? " in velocity" : "",
             closed ? "Nearest is " : "No state near it fits", closed && !text.failed ? text.data : "",
             closed ? "; or let bodies find their place, `initial: {assemble: true}`" : "");
    text_free(&text);
}

void run_close_start(struct run *run)
{
    if (!has_ties(run)) return;
    struct misfit misfit = state_misfit(run->state);
    double reach = 0, speed = 0;
    for (int i = 1; i < run->model->tree->count; i++) {
        const struct tree_state *s = &run->state->tree->links[i];
        reach = fmax(reach, fmax(vec_norm(s->p), vec_norm(s->d)));
        speed = fmax(speed, fmax(vec_norm(s->v), fabs(s->omega)));
    }
    /* Six digits in a file are meant to fit. */
    const double digits = 2e-6;
    bool position = !(misfit.position <= digits * reach), velocity = !(misfit.velocity <= digits * speed);
    if (position || velocity)
        refuse(run, &misfit, !position);
    else
        state_project(run->state, false);
}

/* A kinetic energy that is nothing but rounding: in a scene at rest accelerations are what is left of forces
 * that cancel, and speeds what these make in a step. 1e-12 of what one of the forces alone would do is some
 * thousand roundings. */
static double still(struct run *run)
{
    const double rounding = 1e-12;
    const struct tree *tree = run->model->tree;
    double mass = 0, most = 0;
    state_evaluate(run->state);
    for (int i = 1; i < tree->count; i++) {
        mass += tree->links[i].mass;
        most = fmax(most, vec_norm(run->state->tree->links[i].F.force) / tree->links[i].mass);
        most = fmax(most, vec_norm(tree->links[i].force) / tree->links[i].mass);
    }
    double speed = rounding * most * (run->state->t - run->from);
    return mass * speed * speed / 2;
}

/* How large the mechanism is and how fast. */
static void measure(struct run *run)
{
    struct drift *drift = &run->drift;
    for (int i = 1; i < run->model->tree->count; i++) {
        const struct tree_state *s = &run->state->tree->links[i];
        drift->reach = fmax(drift->reach, vec_norm(s->p));
        drift->speed = fmax(drift->speed, vec_norm(s->v));
    }
}

/* Bring the end of the step back, and note what that took; returns what is still left. */
static struct misfit bring_back(struct run *run, struct misfit *misfit)
{
    struct drift *drift = &run->drift;
    *misfit = state_misfit(run->state);
    if (misfit->row >= 0 && (!drift->worst || misfit->position > drift->position))
        drift->worst = tie_row_name(run->model->tree, misfit->row);
    drift->position = fmax(drift->position, misfit->position);
    drift->velocity = fmax(drift->velocity, misfit->velocity);
    state_return(run->state);
    struct misfit left = state_misfit(run->state);
    drift->left_position = fmax(drift->left_position, left.position);
    drift->left_velocity = fmax(drift->left_velocity, left.velocity);
    measure(run);
    return left;
}

void run_close_step(struct run *run)
{
    if (!has_ties(run)) return;
    struct misfit misfit;
    run->projected = true;
    double before = kinetic(run->state);
    struct misfit left = bring_back(run, &misfit);
    double after = kinetic(run->state);
    run->liveliest = fmax(run->liveliest, fmax(before, after));
    double reach = 0;
    for (int i = 1; i < run->model->tree->count; i++)
        reach = fmax(reach, vec_norm(run->state->tree->links[i].p));
    /* Where a mechanism can fold over to another branch (all bars in one line) a step may start to, and going
     * back takes the energy with it: that is no rounding any more. */
    if (!(fabs(after - before) <= 1e4 * fmax(run->options.tolerance, 1e-12) * run->liveliest) &&
        !(fabs(after - before) <= still(run))) {
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
