/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/project.h"

#include <float.h>
#include <string.h>

#include "dynamics/tree_system.h"

/* The rows where the state is, with the tree factored for answers: no loads, no bias. */
static void prepare(struct fbd_state *state, bool assemble)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    struct tree_work *work = state->tree;
    struct instant at = state_instant(state);
    for (int i = 1; i < tree->count; i++) {
        const struct body *body = model->bodies[tree->links[i].body].source;
        work->links[i].locked = assemble && !body->assemble;
        work->links[i].held = 0;
    }
    tree_move(model, &at);
    memset(work->x, 0, (size_t)tree->count * sizeof *work->x);
    tree_factor(tree, work);
    constraints_evaluate(model, work, false);
}

static void release(struct fbd_state *state)
{
    for (int i = 1; i < state->model->tree->count; i++) state->tree->links[i].locked = false;
}

static struct misfit misfit_of(const struct fbd_state *state)
{
    struct misfit misfit = {.row = -1, .velocity_row = -1};
    struct instant at = state_instant(state);
    for (int j = 0; j < state->model->tree->row_count; j++) {
        const struct row *row = &state->tree->rows[j];
        if (!tree_takes_part(state->model->tree, &at, j)) continue;
        if (!(fabs(row->g.x) <= misfit.position)) {
            misfit.position = fabs(row->g.x);
            misfit.row = j;
        }
        if (!(fabs(row->g.x1) <= misfit.velocity)) {
            misfit.velocity = fabs(row->g.x1);
            misfit.velocity_row = j;
        }
    }
    return misfit;
}

struct misfit state_misfit(struct fbd_state *state)
{
    if (!state->tree || state->model->tree->tie_count == 0) return (struct misfit){0, 0, -1, -1};
    prepare(state, false);
    return misfit_of(state);
}

void state_start_constraints(struct fbd_state *state)
{
    if (!state->tree || state->model->tree->tie_count == 0) return;
    struct instant at = state_instant(state);
    tree_move(state->model, &at);
    constraints_start(state->model, &at);
}

/* Rounding of the positions that a row is made of. */
static double rounding(const struct fbd_state *state)
{
    double reach = 0;
    for (int i = 1; i < state->model->tree->count; i++) {
        const struct tree_state *s = &state->tree->links[i];
        reach = fmax(reach, fmax(vec_norm(s->p), vec_norm(s->d)));
    }
    return 16 * DBL_EPSILON * reach;
}

/* One Newton step: y[first ..] += share * (the answer to -value of each row). */
static void step(struct fbd_state *state, bool velocity, double share, double *target)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    struct tree_work *work = state->tree;
    struct instant at = state_instant(state);
    work->projecting = true;
    for (int j = 0; j < tree_unknowns(tree); j++)
        work->z[j] = j >= tree->row_count ? 0 : velocity ? -work->rows[j].g.x1 : -work->rows[j].g.x;
    tree_system_factor(model, &at);
    tree_system_solve(model, &at, work->z);
    work->projecting = false;
    for (int i = 1; i < tree->count; i++) {
        int first = tree->links[i].coordinate, count = joint_freedom(tree->links[i].kind);
        for (int k = first; k < first + count && !work->links[i].locked; k++)
            target[k] += share * work->unit[k];
    }
}

bool state_project_velocity(struct fbd_state *state, bool assemble)
{
    if (!state->tree || state->model->tree->tie_count == 0) return true;
    /* Linear: the second step mends the rounding of the first. */
    for (int pass = 0; pass < 2; pass++) {
        prepare(state, assemble);
        struct misfit before = misfit_of(state);
        if (before.velocity == 0) break;
        step(state, true, 1, state->y + state->model->plan.n);
    }
    prepare(state, assemble);
    double speed = 0;
    for (int i = 1; i < state->model->tree->count; i++)
        speed = fmax(speed, vec_norm(state->tree->links[i].v) + fabs(state->tree->links[i].omega));
    bool there = misfit_of(state).velocity <= 1e-9 * (1 + speed);
    release(state);
    return there;
}

static bool project_position(struct fbd_state *state, bool assemble, int most_steps)
{
    size_t bytes = (size_t)state->model->plan.n * sizeof *state->y;
    double *before = state->scratch, share = 1;
    prepare(state, assemble);
    struct misfit misfit = misfit_of(state);
    for (int k = 0; k < most_steps && misfit.position > rounding(state); k++) {
        memcpy(before, state->y, bytes);
        step(state, false, share, state->y);
        prepare(state, assemble);
        struct misfit after = misfit_of(state);
        if (after.position < misfit.position) {
            misfit = after;
            share = fmin(1, 2 * share);
            continue;
        }
        memcpy(state->y, before, bytes); /* too far: a shorter step, until there is none */
        prepare(state, assemble);
        if (misfit.position <= 64 * rounding(state) || share < 1e-4) break;
        share /= 4;
    }
    return misfit.position <= 1e3 * rounding(state);
}

bool state_project(struct fbd_state *state, bool assemble)
{
    if (!state->tree || state->model->tree->tie_count == 0) return true;
    enum { most_steps = 60 };
    state->tree->damping = 1e-6;
    bool there = project_position(state, assemble, most_steps);
    return state_project_velocity(state, assemble) && there;
}

void state_return(struct fbd_state *state)
{
    if (!state->tree || state->model->tree->tie_count == 0) return;
    state->tree->damping = 1e-3;
    project_position(state, false, 2);
    state_project_velocity(state, false);
    state->tree->damping = 1e-6;
}
