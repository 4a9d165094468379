/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/rates.h"

#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "dynamics/rates_row.h"
#include "dynamics/tree.h"
#include "dynamics/tree_bare.h"

/* Does the body have scalar equations whose friction, if any, is constant in the present mode? */
static bool has_rows(const struct fbd_state *state, int b)
{
    const struct plan *plan = &state->model->plan;
    const int friction = state->model->bodies[b].friction;
    if (!plan->equations[state->model->bodies[b].first].known) return false;
    if (friction < 0) return true;
    const struct mode *mode = &plan->modes[friction];
    if (state->slip[friction] == stick) return formula_is_constant(&mode->surface_speed);
    return formula_is_constant(&mode->mu_k) &&
           (mode->normal_slot < 0 || plan->slot_constant[mode->normal_slot]);
}

/* Kinetic friction, by its mode, with a constant normal force, as in tree.c. */
static double constant_friction(const struct fbd_state *state, int friction)
{
    const struct plan *plan = &state->model->plan;
    const struct mode *mode = &plan->modes[friction];
    double press = 1;
    if (mode->normal_slot >= 0)
        press = fmax(0, -state->pull[friction] * plan->equations[mode->coordinate].across);
    return state->slip[friction] * mode->mu_k.constant * press;
}

/* One formula of one part: F sin(w t) or the like. */
static void take_part(struct row *row)
{
    if (row->formula_count != 1 || row->formulas[0].value.expr->part_count != 1) return;
    const struct expr *expr = row->formulas[0].value.expr;
    row->part = &expr->parts[0];
    row->scale = row->formulas[0].scale;
    row->u = row->part->variable < 0 ? -1 : expr->slots[row->part->variable] - 1;
}

/* Written in place: a row is large. */
static void set_row(const struct rates *rates, int b, int coordinate, struct row *row)
{
    const struct fbd_state *state = rates->state;
    const struct plan *plan = &state->model->plan;
    const struct scalar_equation *equation = &plan->equations[coordinate];
    const int friction = state->model->bodies[b].friction;
    *row = (struct row){.function = scalar_row,
                        .all = rates,
                        .q = coordinate,
                        .v = plan->n + coordinate,
                        .inverse = plan->inverse_inertia[coordinate],
                        .c0 = equation->c0,
                        .kq = equation->kq,
                        .kv = equation->kv,
                        .s = equation->s,
                        .c = equation->c,
                        .turns = equation->s != 0 || equation->c != 0,
                        .square = equation->square};
    if (friction >= 0 && state->slip[friction] == stick) {
        row->function = held_row;
        row->rate = plan->modes[friction].surface_speed.constant;
        return;
    }
    row->formulas = plan->formulas + equation->formulas.first;
    row->formula_count = equation->formulas.count;
    row->friction = friction < 0 ? 0 : constant_friction(state, friction);
    row->has_others = row->square != 0 || row->formula_count > 0;
    take_part(row);
}

static struct row row_of_link(const struct rates *rates, int link)
{
    const int first = rates->state->model->tree->links[link].coordinate;
    return (struct row){.function = alone_row, .all = rates, .q = first, .link = link};
}

static struct row row_of_loop(const struct rates *rates)
{
    struct fbd_state *state = rates->state;
    const struct fbd_model *model = state->model;
    const struct instant at = state_instant(state);
    struct row row = {.function = tree_loop_is_steady(model) ? loop_row : driven_loop_row,
                      .all = rates,
                      .loop = state->tree->loop};
    force_slots(model, &at, state->slots);
    tree_loop_forces(row.loop, &at, state->slots, row.along);
    return row;
}

/* A row for each coordinate of a link that stands alone, or one for the link. */
static void bind_alone(struct rates *rates, int link)
{
    const int b = rates->state->model->tree->links[link].body;
    const struct model_body *body = &rates->state->model->bodies[b];
    if (!has_rows(rates->state, b)) {
        rates->rows[rates->count++] = row_of_link(rates, link);
        return;
    }
    for (int k = body->first; k < body->first + body->count; k++)
        set_row(rates, b, k, &rates->rows[rates->count++]);
}

/* A row for each tree: false where one of them needs the recursion. */
static bool bind_rows(struct rates *rates)
{
    const struct fbd_state *state = rates->state;
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    if (rates->kind != rates_by_rows || state_sliding(state)) return false;
    if (state->tree->loop) {
        rates->rows[rates->count++] = row_of_loop(rates);
        return true;
    }
    if (state->tree->loops)
        rates->rows[rates->count++] = (struct row){.function = loops_row, .all = rates};
    else if (tree_is_bare(model))
        rates->rows[rates->count++] =
            (struct row){.function = bare_row, .all = rates, .bare = state->tree->bare};
    else if (tree_joins(tree) || model->names_places)
        return false;
    for (int i = tree->joined; i < tree->count; i++) bind_alone(rates, i);
    return true;
}

void rates_bind(struct rates *rates)
{
    const struct fbd_model *model = rates->state->model;
    rates->count = 0;
    if (rates->kind == rates_none) {
        rates->rows[rates->count++] = (struct row){.function = no_row, .all = rates};
        return;
    }
    if (!bind_rows(rates)) {
        rates->count = 0;
        rates->rows[rates->count++] = (struct row){.function = whole_row, .all = rates};
    }
    if (model->plan.own > 0)
        rates->rows[rates->count++] = (struct row){.function = own_row, .all = rates, .q = 2 * model->plan.n};
}

struct rates *rates_new(struct fbd_state *state, enum rates_kind kind)
{
    const struct plan *plan = &state->model->plan; /* each tree has at least one coordinate */
    size_t most = (size_t)(plan->n > 0 ? plan->n : 1) + (plan->own > 0);
    struct rates *rates = block_alloc(sizeof *rates + most * sizeof *rates->rows);
    if (!rates) return NULL;
    rates->state = state;
    rates->kind = kind;
    rates_bind(rates);
    return rates;
}

void rates_free(struct rates *rates)
{
    free(rates);
}

rates_function *rates_call(struct rates *rates, void **params)
{
    *params = rates->rows;
    return rates->count == 1 ? rates->rows[0].function : all_rows;
}

struct fbd_state *rates_state(void *params)
{
    const struct row *row = params;
    return row->all->state;
}

struct rates_census rates_census(const struct rates *rates)
{
    struct rates_census census = {0};
    for (int i = 0; i < rates->count; i++) {
        rates_function *function = rates->rows[i].function;
        int *count = function == own_row      ? &census.own
                     : function == scalar_row ? &census.scalar
                     : function == held_row   ? &census.held
                     : function == alone_row  ? &census.alone
                     : function == loops_row  ? &census.loops
                     : function == bare_row   ? &census.bare
                                              : &census.whole;
        (*count)++;
    }
    return census;
}
