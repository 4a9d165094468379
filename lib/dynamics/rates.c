/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/rates.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/laws.h"
#include "dynamics/own.h"
#include "dynamics/tree.h"
#include "dynamics/tree_bare.h"
#include "dynamics/tree_loop.h"
#include "dynamics/tree_short.h"

struct row {
    rates_function *function;
    const struct rates *all;
    int q, v;       /* where the coordinate and its rate are in y; of a body's row, `q` is the body */
    double inverse; /* 1/m, 1/I_O or 1/I_G */
    double c0, kq, kv;
    double s, c;
    double square;
    double friction;     /* against +x, in the present mode */
    double rate, steady; /* held: dx/dt; steady: dv/dt */
    const struct formula_term *formulas;
    int formula_count;
    double x_and_y[2][3]; /* particle: c0, kq, kv along x and y, */
    bool sloped;          /* which are not all constant */
    const struct body_terms *terms;
    const struct link_term *springs; /* springs alone: those of a particle, */
    int spring_count, driven;        /* and along which axis the formula acts */
    double scale;                    /* of a single formula of one part */
    struct expr_part part;
    int u; /* its variable in y, -1 for t */
    bool one_part;
    struct tree_pole pole;
    const struct tree_link *links;
    const struct tree_bare *bare;
};

struct rates {
    struct fbd_state *state;
    enum rates_kind kind;
    int count;
    struct tree_loop loop;
    double along[3]; /* what acts along its links, where that is constant */
    struct row rows[];
};

/* ---- the functions of the rows */

static int steady_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t;
    dydt[row->q] = y[row->v];
    dydt[row->v] = row->steady;
    return 0;
}

static int held_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t, (void)y;
    dydt[row->q] = row->rate;
    dydt[row->v] = 0;
    return 0;
}

static int no_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t, (void)y;
    memset(dydt, 0, plan_size(&row->all->state->model->plan) * sizeof *dydt);
    return 0;
}

static inline double affine_sum(const struct row *row, double q, double v)
{
    return row->c0 - row->kq * q - row->kv * v;
}

static inline double with_square_and_friction(const struct row *row, double v, double sum)
{
    if (row->square != 0) sum -= row->square * fabs(v) * v;
    if (row->friction != 0) sum -= row->friction;
    return sum;
}

static inline double sine_sum(const struct row *row, double q)
{
    if (row->c == 0) return row->s * sin(q);
    if (row->s == 0) return row->c * cos(q);
    return row->s * sin(q) + row->c * cos(q);
}

static int affine_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    double q = y[row->q], v = y[row->v];
    (void)t;
    dydt[row->q] = v;
    dydt[row->v] = row->inverse * with_square_and_friction(row, v, affine_sum(row, q, v));
    return 0;
}

static int sine_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    double q = y[row->q], v = y[row->v];
    (void)t;
    dydt[row->q] = v;
    dydt[row->v] = row->inverse * with_square_and_friction(row, v, affine_sum(row, q, v) + sine_sum(row, q));
    return 0;
}

/* A pendulum, perhaps with a damper. */
static int swing_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    double q = y[row->q], v = y[row->v];
    (void)t;
    dydt[row->q] = v;
    dydt[row->v] = row->inverse * (row->s * sin(q) - row->kv * v);
    return 0;
}

static int part_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    double q = y[row->q], v = y[row->v], sum = affine_sum(row, q, v);
    if (row->square != 0) sum -= row->square * fabs(v) * v;
    sum += row->scale * part_value(&row->part, row->u < 0 ? t : y[row->u]);
    if (row->friction != 0) sum -= row->friction;
    dydt[row->q] = v;
    dydt[row->v] = row->inverse * sum;
    return 0;
}

static int formulas_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = {t, y, state->branch, state->slip, state->pull, state->tree, state->extended, NULL};
    double q = y[row->q], v = y[row->v], sum = affine_sum(row, q, v);
    if (row->s != 0 || row->c != 0) sum += sine_sum(row, q);
    if (row->square != 0) sum -= row->square * fabs(v) * v;
    for (int i = 0; i < row->formula_count; i++)
        sum += row->formulas[i].scale * formula_value(&row->formulas[i].value, &at);
    if (row->friction != 0) sum -= row->friction;
    dydt[row->q] = v;
    dydt[row->v] = row->inverse * sum;
    return 0;
}

/* Springs, dampers and drag on a particle at p: its frame does not turn, so the arm of a point stays as it
 * is. */
static inline struct vec pulls(const struct plan *plan, const struct body_terms *terms, struct vec p,
                               struct vec v)
{
    struct vec f = {0, 0};
    const struct link_term *link = plan->links + terms->links.first, *end = link + terms->links.count;
    for (; link < end; link++) {
        struct link_law law = {link->anchor, link->stiffness, link->free_length, link->damping};
        f = vec_add(f, link_force(&law, (struct motion_of_point){vec_add(p, link->point), v}));
    }
    const struct drag_term *drag = plan->drags + terms->drags.first;
    for (int i = 0; i < terms->drags.count; i++, drag++)
        f = vec_add(f, drag_force(&(struct drag_law){drag->linear, drag->quadratic}, v));
    return f;
}

static void add_formulas(const struct row *row, double t, const double *y, double *x_sum, double *y_sum)
{
    const struct fbd_state *state = row->all->state;
    struct instant at = {t, y, state->branch, state->slip, state->pull, state->tree, state->extended, NULL};
    const struct formula_term *formula = row->formulas, *end = formula + row->formula_count;
    for (; formula < end; formula++)
        *(formula->slot == row->q ? x_sum : y_sum) += formula->scale * formula_value(&formula->value, &at);
}

/* The formula comes first: the processor works on its sine and on the square roots of the springs at a time.
 */
static int particle_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    double drive = row->one_part ? row->scale * part_value(&row->part, row->u < 0 ? t : y[row->u]) : 0;
    struct vec p = {y[row->q], y[row->q + 1]}, v = {y[row->v], y[row->v + 1]};
    double x_sum = row->x_and_y[0][0], y_sum = row->x_and_y[1][0];
    if (row->sloped) {
        x_sum = x_sum - row->x_and_y[0][1] * p.x - row->x_and_y[0][2] * v.x;
        y_sum = y_sum - row->x_and_y[1][1] * p.y - row->x_and_y[1][2] * v.y;
    }
    if (row->one_part && row->formulas->slot == row->q)
        x_sum += drive;
    else if (row->one_part)
        y_sum += drive;
    else if (row->formula_count > 0)
        add_formulas(row, t, y, &x_sum, &y_sum);
    struct vec f = pulls(&row->all->state->model->plan, row->terms, p, v);
    dydt[row->q] = v.x;
    dydt[row->q + 1] = v.y;
    dydt[row->v] = row->inverse * (x_sum + f.x);
    dydt[row->v + 1] = row->inverse * (y_sum + f.y);
    return 0;
}

/* A particle between springs without dampers on its own point, pushed along one axis or not at all: as particle_row,
 * which does it where the square of a length would not have all digits. */
static int springs_row(double t, const double y[], double dydt[], void *params)
{
    const double least = 1e-280, most = 1e280;
    const struct row *row = params;
    double drive = row->one_part ? row->scale * part_value(&row->part, row->u < 0 ? t : y[row->u]) : 0;
    double x_sum = row->x_and_y[0][0], y_sum = row->x_and_y[1][0];
    struct vec p = {y[row->q], y[row->q + 1]}, f = {0, 0};
    double shortest = 1, longest = 1; /* squares */
    for (const struct link_term *link = row->springs, *end = link + row->spring_count; link < end; link++) {
        struct vec d = vec_sub(p, link->anchor);
        double square = d.x * d.x + d.y * d.y, length = sqrt(square);
        shortest = square < shortest ? square : shortest;
        longest = square > longest ? square : longest;
        f = vec_add(f, vec_scale(-(link->stiffness * (length - link->free_length)) / length, d));
    }
    if (!(shortest > least && longest < most)) return particle_row(t, y, dydt, params);
    if (row->driven == 0)
        x_sum += drive;
    else
        y_sum += drive;
    dydt[row->q] = y[row->v];
    dydt[row->q + 1] = y[row->v + 1];
    dydt[row->v] = row->inverse * (x_sum + f.x);
    dydt[row->v + 1] = row->inverse * (y_sum + f.y);
    return 0;
}

static int body_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = {t, y, state->branch, state->slip, state->pull, state->tree, state->extended, NULL};
    body_rates(state->model, row->q, &at, state->slots, dydt);
    return 0;
}

static int whole_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = state_instant_at(state, t, y);
    if (at.tree) at.tree->rates_only = !at.sliding;
    state_rates(state->model, &at, state->slots, dydt);
    if (at.tree) at.tree->rates_only = false;
    return 0;
}

static int bare_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    (void)t;
    tree_bare_rates(state->model, state->tree, y, dydt);
    return 0;
}

static int pole_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t;
    dydt[0] = y[2];
    dydt[1] = y[3];
    tree_pole(&row->pole, 0, 0, y, y + 2, dydt + 2);
    return 0;
}

static int two_pivots_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t;
    dydt[0] = y[2];
    dydt[1] = y[3];
    tree_two_pivots(row->links, row->bare, y, y + 2, dydt + 2);
    return 0;
}

static int three_pivots_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t;
    for (int i = 0; i < 3; i++) dydt[i] = y[3 + i];
    tree_three_pivots(row->links, row->bare, y, y + 3, dydt + 3);
    return 0;
}

/* As the tree would have it, to rounding, and by it near singular positions. */
static int loop_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    if (!tree_loop_rates(&row->all->loop, row->all->along, y, y + 3, dydt + 3))
        return whole_row(t, y, dydt, params);
    for (int i = 0; i < 3; i++) dydt[i] = y[3 + i];
    return 0;
}

static int driven_loop_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = {t, y, state->branch, state->slip, state->pull, state->tree, state->extended, NULL};
    double f[3];
    joint_forces(state->model, &at, state->slots, dydt + 3);
    tree_loop_forces(&row->all->loop, &at, state->slots, f);
    if (!tree_loop_rates(&row->all->loop, f, y, y + 3, dydt + 3)) return whole_row(t, y, dydt, params);
    for (int i = 0; i < 3; i++) dydt[i] = y[3 + i];
    return 0;
}

/* The states of the file's own. */
static int own_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = {t, y, state->branch, state->slip, state->pull, state->tree, state->extended, NULL};
    own_rates(state->model, &at, dydt + row->q);
    return 0;
}

static int all_rows(double t, const double y[], double dydt[], void *params)
{
    struct row *row = params;
    const struct row *end = row + row->all->count;
    for (; row < end; row++) row->function(t, y, dydt, row);
    return 0;
}

/* ---- making the rows */

/* Can every coordinate of the body be a row in the present modes? Its equations have to stand by themselves,
 * and its friction, if any, has to be a number. */
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

/* Kinetic friction of a pair that slips with constant normal force, as in forward.c. */
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

static struct row row_of(const struct rates *rates, int b, int coordinate)
{
    const struct fbd_state *state = rates->state;
    const struct plan *plan = &state->model->plan;
    const struct body_terms *terms = &plan->bodies[b];
    struct row row = {.all = rates,
                      .q = coordinate,
                      .v = plan->n + coordinate,
                      .inverse = plan->inverse_inertia[coordinate]};
    if (terms->friction >= 0 && state->slip[terms->friction] == stick) {
        row.function = held_row;
        row.rate = plan->modes[terms->friction].surface_speed.constant;
        return row;
    }
    take_terms(plan, terms, &row);
    if (terms->friction >= 0) row.friction = constant_friction(plan, terms, state);
    choose(&row);
    return row;
}

static bool is_pulled_particle(const struct model_body *body, const struct body_terms *terms)
{
    return body->kind == motion_particle && terms->forces.count == 0 && terms->potentials.count == 0;
}

/* Is there nothing but springs without dampers on its own point, and one part of a formula? */
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
        for (int k = 0; k < body->count; k++) *next++ = row_of(rates, b, body->first + k);
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

static struct row row_of_loop(struct rates *rates)
{
    struct fbd_state *state = rates->state;
    const struct fbd_model *model = state->model;
    const struct instant at = state_instant(state);
    double a[3];
    joint_forces(model, &at, state->slots, a);
    tree_loop_forces(&rates->loop, &at, state->slots, rates->along);
    return (struct row){.function = tree_loop_is_steady(model) ? loop_row : driven_loop_row,
                        .all = rates,
                        .links = &model->tree->links[1]};
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
    } else if (free && tree_loop_find(model, &rates->loop)) {
        rates->rows[rates->count++] = row_of_loop(rates);
    } else if (model->tree || model->absolute_count > 0 ||
               state_sliding(rates->state)) { /* one solution for all */
        rates->rows[rates->count++] = (struct row){.function = whole_row, .all = rates};
    } else {
        for (int b = 0; b < (int)rates->state->model->body_count; b++) bind_body(rates, b);
    }
    if (model->plan.own > 0)
        rates->rows[rates->count++] = (struct row){.function = own_row, .all = rates, .q = 2 * model->plan.n};
}

struct rates *rates_new(struct fbd_state *state, enum rates_kind kind)
{
    size_t most = (size_t)state->model->plan.n + 2; /* a body that is a row has a coordinate at least */
    struct rates *rates = calloc(1, sizeof *rates + most * sizeof *rates->rows);
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
