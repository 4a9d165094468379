/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/rates_row.h"

#include <string.h>

#include "base/sine.h"
#include "dynamics/laws.h"
#include "dynamics/tree.h"
#include "dynamics/user_states.h"

int steady_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t;
    dydt[row->q] = y[row->v];
    dydt[row->v] = row->steady;
    return 0;
}

int held_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t, (void)y;
    dydt[row->q] = row->rate;
    dydt[row->v] = 0;
    return 0;
}

int no_row(double t, const double y[], double dydt[], void *params)
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
    if (row->c == 0) return row->s * sine(q);
    if (row->s == 0) return row->c * cos(q);
    return row->s * sin(q) + row->c * cos(q);
}

int affine_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    double q = y[row->q], v = y[row->v];
    (void)t;
    dydt[row->q] = v;
    dydt[row->v] = row->inverse * with_square_and_friction(row, v, affine_sum(row, q, v));
    return 0;
}

int sine_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    double q = y[row->q], v = y[row->v];
    (void)t;
    dydt[row->q] = v;
    dydt[row->v] = row->inverse * with_square_and_friction(row, v, affine_sum(row, q, v) + sine_sum(row, q));
    return 0;
}

/* A pendulum, with or without a damper. */
int swing_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    double q = y[row->q], v = y[row->v];
    (void)t;
    dydt[row->q] = v;
    dydt[row->v] = row->inverse * (row->s * sine(q) - row->kv * v);
    return 0;
}

int part_row(double t, const double y[], double dydt[], void *params)
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

int formulas_row(double t, const double y[], double dydt[], void *params)
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

/* Springs, dampers and drag on a particle at p: its frame does not turn, so the arm of a point is constant. */
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

/* The formula comes first: so the processor computes its sine and the square roots of the springs in
 * parallel. */
int particle_row(double t, const double y[], double dydt[], void *params)
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

/* A particle with springs without dampers at its own point, and a formula along one axis or none: as
 * particle_row, which is called if the square of a length would lose digits. */
int springs_row(double t, const double y[], double dydt[], void *params)
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

int body_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = {t, y, state->branch, state->slip, state->pull, state->tree, state->extended, NULL};
    body_rates(state->model, row->q, &at, state->slots, dydt);
    return 0;
}

int whole_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = state_instant_at(state, t, y);
    if (at.tree) at.tree->rates_only = !at.sliding;
    state_rates(state->model, &at, state->slots, dydt);
    if (at.tree) at.tree->rates_only = false;
    return 0;
}

int bare_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    (void)t;
    tree_bare_rates(state->model, state->tree, y, dydt);
    return 0;
}

int pole_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t;
    dydt[0] = y[2];
    dydt[1] = y[3];
    tree_pole(&row->pole, 0, 0, y, y + 2, dydt + 2);
    return 0;
}

int two_pivots_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t;
    dydt[0] = y[2];
    dydt[1] = y[3];
    tree_two_pivots(row->links, row->bare, y, y + 2, dydt + 2);
    return 0;
}

int three_pivots_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    (void)t;
    for (int i = 0; i < 3; i++) dydt[i] = y[3 + i];
    tree_three_pivots(row->links, row->bare, y, y + 3, dydt + 3);
    return 0;
}

/* Equal to the tree's result within rounding; near singular positions by the tree. */
int loop_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    if (!tree_loop_rates(row->loop, row->along, y, y + 3, dydt + 3)) return whole_row(t, y, dydt, params);
    for (int i = 0; i < 3; i++) dydt[i] = y[3 + i];
    return 0;
}

int driven_loop_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = {t, y, state->branch, state->slip, state->pull, state->tree, state->extended, NULL};
    double f[3];
    joint_forces(state->model, &at, state->slots, dydt + 3);
    tree_loop_forces(row->loop, &at, state->slots, f);
    if (!tree_loop_rates(row->loop, f, y, y + 3, dydt + 3)) return whole_row(t, y, dydt, params);
    for (int i = 0; i < 3; i++) dydt[i] = y[3 + i];
    return 0;
}

/* User states. */
int own_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = {t, y, state->branch, state->slip, state->pull, state->tree, state->extended, NULL};
    user_state_rates(state->model, &at, dydt + row->q);
    return 0;
}

int all_rows(double t, const double y[], double dydt[], void *params)
{
    struct row *row = params;
    const struct row *end = row + row->all->count;
    for (; row < end; row++) row->function(t, y, dydt, row);
    return 0;
}
