/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/impulse.h"

#include <string.h>

#include "dynamics/friction.h"
#include "dynamics/tree.h"
#include "dynamics/tree_system.h"
#include "numeric/tolerances.h"

void impulse_look(struct fbd_state *state)
{
    struct instant at = state_instant(state);
    tree_move(state->model, &at);
    constraints_evaluate(state->model, &at, NULL);
}

/* Factor the tree without loads and bias, at links that have been looked at; prescribed joints are locked. */
static void factor_tree(struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    struct tree_work *work = state->tree;
    for (int i = 1; i < tree->count; i++) {
        work->links[i].locked = model->bodies[tree->links[i].body].source->motion.prescribed.expr != NULL;
        work->links[i].held = 0;
    }
    memset(work->x, 0, (size_t)tree->count * sizeof *work->x);
    tree_factor(tree, work);
}

static bool is_asked_for(const struct impulse_lines *lines, int row)
{
    for (int i = 0; i < lines->row_count; i++)
        if (lines->rows[i] == row) return true;
    return false;
}

/* Deactivate one-sided constraints and friction. Rolling without a limit remains. */
static void let_go(const struct fbd_model *model, const struct impulse_lines *lines, int *modes)
{
    for (size_t i = 0; i < model->plan.mode_count; i++) {
        const struct mode *mode = &model->plan.modes[i];
        const struct coupling *coupling =
            mode->coupling >= 0 ? &model->tree->couplings[mode->coupling] : NULL;
        bool surface = coupling && mode->kind == mode_surface && coupling_takes_impulses(coupling);
        bool couples = coupling && coupling->kind == constraint_capstan;
        if (mode->kind == mode_rope || mode->kind == mode_contact || (mode_is_friction(mode) && !couples))
            modes[i] = slip_plus;
        else if (surface && modes[i] == stick)
            modes[i] =
                coupling->pair >= 0 || is_asked_for(lines, coupling->first_row + 1) ? slip_plus : loose;
    }
}

static int link_of(const struct fbd_model *model, int pair)
{
    return model->bodies[model->plan.modes[pair].body].place.link;
}

/* The row along which friction of a slot acts; NULL on a slide. */
static const struct row *row_of(const struct fbd_state *state, int pair)
{
    int coupling = state->model->plan.modes[pair].coupling;
    return coupling < 0 ? NULL : &state->tree->rows[state->model->tree->couplings[coupling].along_row];
}

/* Solve x for the impulse alone, and set the right-hand side of all active rows. */
static void answer(struct fbd_state *state, const struct instant *at, const struct impulse_lines *lines,
                   int j)
{
    const struct tree *tree = state->model->tree;
    struct tree_work *work = state->tree;
    memset(work->x, 0, (size_t)tree->count * sizeof *work->x);
    int slide = j < lines->row_count ? -1 : lines->slides[j - lines->row_count];
    const struct row *row = slide < 0 ? &work->rows[lines->rows[j]] : row_of(state, slide);
    if (row)
        row_apply(row, 1, work->x);
    else
        work->x[link_of(state->model, slide)].g = 1;
    tree_inward(tree, work, 1, tree->count);
    tree_outward(tree, work, 1, tree->count, work->unit);
    for (int k = 0; k < tree_unknowns(tree); k++)
        work->z[k] = k < tree->row_count && tree_takes_part(tree, at, k) ? -tree_row_answer(work, k) : 0;
    tree_want_massless(tree, work, work->unit, work->z);
}

/* Add the velocities in work->x and work->unit, and the solved multipliers, z or NULL, to column j. */
static void add_column(struct fbd_state *state, const struct impulse_lines *lines, int j, const double *z,
                       double *W, double *B, double *velocities)
{
    const struct fbd_model *model = state->model;
    int rows = lines->row_count, count = rows + lines->slide_count;
    tree_add_unit(model->tree, state->tree, velocities);
    for (int i = 0; i < rows; i++) W[i * count + j] += tree_row_answer(state->tree, lines->rows[i]);
    for (int i = 0; i < lines->slide_count; i++) {
        int pair = lines->slides[i];
        const struct row *row = row_of(state, pair);
        int along = row ? (int)(row - state->tree->rows) : -1;
        W[(rows + i) * count + j] +=
            row ? tree_row_answer(state->tree, along) : state->tree->unit[model->plan.modes[pair].coordinate];
        if (!row) B[i * count + j] += tree_normal_in(model->tree, state->tree, link_of(model, pair));
        if (row && z) B[i * count + j] += z[along - 1];
    }
}

void impulse_answers(struct fbd_state *state, const struct impulse_lines *lines, int *modes, double *W,
                     double *B, double *answers)
{
    const struct fbd_model *model = state->model;
    struct tree_work *work = state->tree;
    size_t n = (size_t)model->plan.n, count = (size_t)lines->row_count + (size_t)lines->slide_count;
    const double exact = negligible_part; /* slopes that are damped out; see project.c */
    struct instant at = state_instant(state);
    factor_tree(state);
    memcpy(modes, state->slip, model->plan.mode_count * sizeof *modes);
    let_go(model, lines, modes);
    at.slip = modes;
    work->projecting = true;
    work->damping = exact;
    tree_system_factor(model, &at);
    memset(W, 0, count * count * sizeof *W);
    memset(B, 0, (size_t)lines->slide_count * count * sizeof *B);
    memset(answers, 0, count * n * sizeof *answers);
    for (size_t j = 0; j < count; j++) {
        answer(state, &at, lines, (int)j);
        add_column(state, lines, (int)j, NULL, W, B, answers + j * n);
        double *own = &W[j * count + j], alone = *own;
        tree_system_solve(model, &at, work->z);
        add_column(state, lines, (int)j, work->z, W, B, answers + j * n);
        if ((int)j >= lines->row_count && *own <= negligible_sum * alone) *own = 0;
    }
    work->projecting = false;
    for (int i = 1; i < model->tree->count; i++) work->links[i].locked = false;
}

static bool is_loaded(const struct impulse_lines *lines, const double *W, const double *B, int i,
                      const int *loaded)
{
    const double rounding = negligible_sum; /* of a unit impulse */
    const int rows = lines->row_count, all = rows + lines->slide_count;
    if (W[(ptrdiff_t)(rows + i) * (all + 1)] <= 0) return false;
    for (int j = 0; j < all; j++)
        if ((j < rows || loaded[j - rows]) && fabs(B[(ptrdiff_t)i * all + j]) > rounding) return true;
    return false;
}

int impulse_loaded_slides(const struct impulse_lines *lines, const double *W, const double *B, int *loaded)
{
    int before = -1, found = 0;
    for (int i = 0; i < lines->slide_count; i++) loaded[i] = 0;
    while (found > before) {
        before = found;
        for (int i = 0; i < lines->slide_count; i++)
            if (!loaded[i] && is_loaded(lines, W, B, i, loaded)) loaded[i] = ++found;
    }
    return found;
}
