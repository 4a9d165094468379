/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/rates.h"

#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "dynamics/rates_row.h"
#include "dynamics/tree.h"
#include "dynamics/tree_bare.h"

/* Can every coordinate of the body be a row in the present modes? Its equations must be independent, and its
 * friction, if any, constant. */
static bool stands_by_itself(const struct plan *plan, const struct model_body *body,
                             const struct body_terms *terms, const struct fbd_state *state)
{
    if (terms->at_points || terms->offset >= 0 || terms->potentials.count > 0) return false;
    if (terms->sine.count > 1 || (terms->sine.count == 1 && body->kind != motion_pivot)) return false;
    if (terms->friction < 0) return true;
    const struct mode *mode = &plan->modes[terms->friction];
    if (state->slip[terms->friction] == stick) return formula_is_constant(&mode->surface_speed);
    return formula_is_constant(&mode->mu_k) &&
           (mode->normal_slot < 0 || plan->slot_constant[mode->normal_slot]);
}

/* Kinetic friction that slips with constant normal force, as in forward.c. */
static double constant_friction(const struct plan *plan, const struct body_terms *terms,
                                const struct fbd_state *state)
{
    const struct mode *mode = &plan->modes[terms->friction];
    double across = terms->across.count > 0 ? plan->affine[terms->across.first].c0 : 0, press = 1;
    if (mode->normal_slot >= 0) press = fmax(0, -state->pull[terms->friction] * across);
    return state->slip[terms->friction] * mode->mu_k.constant * press;
}

static void take_terms(const struct plan *plan, const struct body_terms *terms, struct row *row)
{
    for (int i = terms->affine.first; i < terms->affine.first + terms->affine.count; i++) {
        const struct affine_term *term = &plan->affine[i];
        if (term->slot != row->q) continue;
        row->c0 = term->c0;
        row->kq = term->kq;
        row->kv = term->kv;
    }
    if (terms->sine.count > 0) {
        row->s = plan->sine[terms->sine.first].s;
        row->c = plan->sine[terms->sine.first].c;
    }
    for (int i = terms->square.first; i < terms->square.first + terms->square.count; i++)
        if (plan->square[i].slot == row->q) row->square = plan->square[i].k;
    for (int i = terms->formulas.first; i < terms->formulas.first + terms->formulas.count; i++) {
        if (plan->formulas[i].slot != row->q) continue;
        if (row->formula_count++ == 0) row->formulas = &plan->formulas[i];
    }
}

/* One formula of one part: F sin(w t) or the like. */
static void take_part(struct row *row)
{
    row->one_part = row->formula_count == 1 && row->formulas[0].value.expr->part_count == 1;
    if (!row->one_part) return;
    row->scale = row->formulas[0].scale;
    const struct expr *expr = row->formulas[0].value.expr;
    row->part = expr->parts[0];
    row->u = row->part.variable < 0 ? -1 : expr->slots[row->part.variable] - 1;
}

static void choose(struct row *row)
{
    take_part(row);
    if (row->formula_count > 0)
        row->function = row->one_part && row->s == 0 && row->c == 0 ? part_row : formulas_row;
    else if (row->c == 0 && row->s != 0 && row->c0 == 0 && row->kq == 0 && row->square == 0 &&
             row->friction == 0)
        row->function = swing_row;
    else if (row->s != 0 || row->c != 0)
        row->function = sine_row;
    else if (row->kq != 0 || row->kv != 0 || row->square != 0)
        row->function = affine_row;
    else
        row->function = steady_row;
    row->steady = row->inverse * (row->c0 - row->friction);
}

/* Written in place: a row is large. */
static void set_row(const struct rates *rates, int b, int coordinate, struct row *row)
{
    const struct fbd_state *state = rates->state;
    const struct plan *plan = &state->model->plan;
    const struct body_terms *terms = &plan->bodies[b];
    *row = (struct row){.all = rates,
                        .q = coordinate,
                        .v = plan->n + coordinate,
                        .inverse = plan->inverse_inertia[coordinate]};
    if (terms->friction >= 0 && state->slip[terms->friction] == stick) {
        row->function = held_row;
        row->rate = plan->modes[terms->friction].surface_speed.constant;
        return;
    }
    take_terms(plan, terms, row);
    if (terms->friction >= 0) row->friction = constant_friction(plan, terms, state);
    choose(row);
}

static bool is_pulled_particle(const struct model_body *body, const struct body_terms *terms)
{
    return body->kind == motion_particle && terms->forces.count == 0 && terms->potentials.count == 0;
}

/* Are there only springs without dampers at the particle, and one part of a formula? */
static bool has_springs_alone(const struct plan *plan, const struct row *row)
{
    const struct link_term *link = plan->links + row->terms->links.first,
                           *end = link + row->terms->links.count;
    if (row->sloped || row->terms->drags.count > 0 || (row->formula_count > 0 && !row->one_part))
        return false;
    for (; link < end; link++)
        if (link->damping != 0 || link->point.x != 0 || link->point.y != 0) return false;
    return true;
}

static struct row row_of_particle(const struct rates *rates, int b)
{
    const struct fbd_model *model = rates->state->model;
    const struct plan *plan = &model->plan;
    const struct body_terms *terms = &plan->bodies[b];
    int first = model->bodies[b].first;
    struct row row = {.function = particle_row,
                      .all = rates,
                      .q = first,
                      .v = plan->n + first,
                      .inverse = plan->inverse_inertia[first],
                      .terms = terms,
                      .formulas = plan->formulas + terms->formulas.first,
                      .formula_count = terms->formulas.count};
    for (int i = terms->affine.first; i < terms->affine.first + terms->affine.count; i++) {
        double *affine = row.x_and_y[plan->affine[i].slot - first];
        affine[0] = plan->affine[i].c0;
        affine[1] = plan->affine[i].kq;
        affine[2] = plan->affine[i].kv;
        row.sloped |= affine[1] != 0 || affine[2] != 0;
    }
    take_part(&row);
    if (has_springs_alone(plan, &row)) {
        row.function = springs_row;
        row.springs = plan->links + terms->links.first;
        row.spring_count = terms->links.count;
        row.driven = row.one_part ? row.formulas->slot - first : 0;
    }
    return row;
}

static void bind_body(struct rates *rates, int b)
{
    const struct fbd_state *state = rates->state;
    const struct model_body *body = &state->model->bodies[b];
    const struct body_terms *terms = &state->model->plan.bodies[b];
    struct row *next = &rates->rows[rates->count];
    if (rates->kind == rates_by_rows && stands_by_itself(&state->model->plan, body, terms, state)) {
        for (int k = 0; k < body->count; k++) set_row(rates, b, body->first + k, next++);
    } else if (rates->kind == rates_by_rows && is_pulled_particle(body, terms)) {
        *next++ = row_of_particle(rates, b);
    } else {
        *next++ = (struct row){.function = body_row, .all = rates, .q = b};
    }
    rates->count = (int)(next - rates->rows);
}

static struct row row_of_bare_tree(const struct rates *rates)
{
    const struct fbd_model *model = rates->state->model;
    const struct tree_link *links = &model->tree->links[1];
    struct row row = {.function = bare_row,
                      .all = rates,
                      .links = links,
                      .bare = &rates->state->tree->bare[1]};
    switch (tree_bare_form(model)) {
    case tree_form_pole:
        row.function = pole_row;
        row.pole = tree_pole_of(links);
        break;
    case tree_form_two_pivots: row.function = two_pivots_row; break;
    case tree_form_three_pivots: row.function = three_pivots_row; break;
    case tree_form_none: break;
    }
    return row;
}

static struct row row_of_loop(const struct rates *rates)
{
    struct fbd_state *state = rates->state;
    const struct fbd_model *model = state->model;
    const struct instant at = state_instant(state);
    struct row row = {.function = tree_loop_is_steady(model) ? loop_row : driven_loop_row,
                      .all = rates,
                      .links = &model->tree->links[1],
                      .loop = &state->tree->loop};
    double a[3];
    joint_forces(model, &at, state->slots, a);
    tree_loop_forces(row.loop, &at, state->slots, row.along);
    return row;
}

void rates_bind(struct rates *rates)
{
    const struct fbd_model *model = rates->state->model;
    rates->count = 0;
    if (rates->kind == rates_none) {
        rates->rows[rates->count++] = (struct row){.function = no_row, .all = rates};
        return;
    }
    bool free = rates->kind == rates_by_rows && !state_sliding(rates->state);
    if (free && tree_is_bare(model)) {
        rates->rows[rates->count++] = row_of_bare_tree(rates);
    } else if (free && model->tree && rates->state->tree->is_loop) {
        rates->rows[rates->count++] = row_of_loop(rates);
    } else if (model->tree || model->names_places ||
               state_sliding(rates->state)) { /* one row for all bodies */
        rates->rows[rates->count++] = (struct row){.function = whole_row, .all = rates};
    } else {
        for (int b = 0; b < (int)rates->state->model->body_count; b++) bind_body(rates, b);
    }
    if (model->plan.own > 0)
        rates->rows[rates->count++] = (struct row){.function = own_row, .all = rates, .q = 2 * model->plan.n};
}

struct rates *rates_new(struct fbd_state *state, enum rates_kind kind)
{
    const struct plan *plan = &state->model->plan; /* a body with a row has at least one coordinate */
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
        int *count = function == own_row                                   ? &census.own
                     : function == steady_row                              ? &census.steady
                     : function == held_row                                ? &census.held
                     : function == affine_row                              ? &census.affine
                     : function == sine_row || function == swing_row       ? &census.sine
                     : function == part_row                                ? &census.parts
                     : function == formulas_row                            ? &census.formulas
                     : function == particle_row || function == springs_row ? &census.particles
                     : rates->rows[i].links                                ? &census.bare
                                                                           : &census.bodies;
        (*count)++;
    }
    return census;
}
