/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/impulse.h"

#include <string.h>

#include "dynamics/tree_system.h"

void impulse_look(struct fbd_state *state)
{
    struct instant at = state_instant(state);
    tree_move(state->model, &at);
    constraints_evaluate(state->model, &at, NULL);
}

/* The tree without loads and bias, factored for answers; prescribed joints give nothing. */
static void factor_tree(struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    struct tree_work *work = state->tree;
    for (int i = 1; i < tree->count; i++) {
        work->links[i].locked = model->bodies[tree->links[i].body].source->motion.prescribed.expr != NULL;
        work->links[i].held = 0;
    }
    impulse_look(state);
    memset(work->x, 0, (size_t)tree->count * sizeof *work->x);
    tree_factor(tree, work);
}

/* What holds on one side only holds nothing. */
static void let_go(const struct fbd_model *model, int *modes)
{
    for (size_t i = 0; i < model->plan.mode_count; i++) {
        const struct mode *mode = &model->plan.modes[i];
        bool rolls = mode->tie >= 0 && model->tree->ties[mode->tie].meeting < 0;
        bool one_sided = mode->kind == mode_rope || mode->kind == mode_contact;
        if (one_sided || (mode_is_friction(mode) && !rolls)) modes[i] = slip_plus;
    }
}

/* x for the impulse alone, and of all rows that hold what answers to it. */
static void answer(struct fbd_state *state, const struct instant *at, int row, double *velocities)
{
    const struct tree *tree = state->model->tree;
    struct tree_work *work = state->tree;
    memset(work->x, 0, (size_t)tree->count * sizeof *work->x);
    row_apply(&work->rows[row], 1, work->x);
    tree_inward(tree, work, 1, tree->count);
    tree_outward(tree, work, 1, tree->count, velocities);
    for (int k = 0; k < tree_unknowns(tree); k++)
        work->z[k] = k < tree->row_count && tree_takes_part(tree, at, k) ? -tree_row_answer(work, k) : 0;
}

void impulse_answers(struct fbd_state *state, const int *rows, int count, int *modes, double *W,
                     double *answers)
{
    const struct fbd_model *model = state->model;
    struct tree_work *work = state->tree;
    size_t n = (size_t)model->plan.n;
    const double exact = 1e-13; /* slopes that are left alone; see project.c */
    struct instant at = state_instant(state);
    factor_tree(state);
    memcpy(modes, state->slip, model->plan.mode_count * sizeof *modes);
    let_go(model, modes);
    at.slip = modes;
    work->projecting = true;
    work->damping = exact;
    tree_system_factor(model, &at);
    for (int j = 0; j < count; j++) {
        double *velocities = answers + (size_t)j * n;
        memset(velocities, 0, n * sizeof *velocities);
        answer(state, &at, rows[j], velocities);
        for (int i = 0; i < count; i++) W[i * count + j] = tree_row_answer(work, rows[i]);
        tree_system_solve(model, &at, work->z);
        tree_add_unit(model->tree, work, velocities);
        for (int i = 0; i < count; i++) W[i * count + j] += tree_row_answer(work, rows[i]);
    }
    work->projecting = false;
    for (int i = 1; i < model->tree->count; i++) work->links[i].locked = false;
}
