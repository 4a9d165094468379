/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/rates_row.h"

#include <string.h>

#include "base/sine.h"
#include "dynamics/closed_loops.h"
#include "dynamics/friction.h"
#include "dynamics/tree.h"
#include "dynamics/user_states.h"
#include "dynamics/world_refs.h"

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

static inline double sine_sum(const struct row *row, double q)
{
    if (row->c == 0) return row->s * sine(q);
    if (row->s == 0) return row->c * cos(q);
    return row->s * sin(q) + row->c * cos(q);
}

/* No switch is in a sliding mode where there are rows. */
static struct instant smooth_instant(const struct fbd_state *state, double t, const double *y)
{
    struct instant at = state_instant_at(state, t, y);
    at.sliding = NULL;
    return at;
}

/* Add drag and formulas; out of line, so that the others save no registers. */
static __attribute__((noinline)) double add_others(const struct row *row, double t, const double *y,
                                                   double sum)
{
    if (row->square != 0) sum -= row->square * fabs(y[row->v]) * y[row->v];
    if (row->part) return sum + row->scale * part_value(row->part, row->u < 0 ? t : y[row->u]);
    struct instant at = smooth_instant(row->all->state, t, y);
    for (int i = 0; i < row->formula_count; i++)
        sum += row->formulas[i].scale * formula_value(&row->formulas[i].value, &at);
    return sum;
}

int scalar_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    double q = y[row->q], v = y[row->v], sum = row->c0 - row->kq * q - row->kv * v;
    if (row->turns) sum += sine_sum(row, q);
    if (row->has_others) sum = add_others(row, t, y, sum);
    dydt[row->q] = v;
    dydt[row->v] = row->inverse * (sum - row->friction);
    return 0;
}

int alone_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    const struct fbd_model *model = state->model;
    const struct tree_link *link = &model->tree->links[row->link];
    const struct instant at = smooth_instant(state, t, y);
    const int n = model->plan.n, count = joint_freedom(link->kind);
    at.tree->rates_only = true;
    at.tree->complete = false;
    force_slots_alone(model, &at, row->link, state->slots);
    tree_accelerate_alone(model, &at, row->link, state->slots, dydt + n);
    at.tree->rates_only = false;
    for (int k = row->q; k < row->q + count; k++) dydt[k] = y[n + k];
    double acceleration;
    if (at.tree->links[row->link].locked)
        dydt[row->q] = friction_surface_speed(&model->plan.modes[link->pair], &at, &acceleration);
    return 0;
}

int whole_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = state_instant_at(state, t, y);
    at.tree->rates_only = !at.sliding;
    state_rates(state->model, &at, state->slots, dydt);
    at.tree->rates_only = false;
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
    struct instant at = smooth_instant(state, t, y);
    double f[3];
    force_slots(state->model, &at, state->slots);
    tree_loop_forces(row->loop, &at, state->slots, f);
    if (!tree_loop_rates(row->loop, f, y, y + 3, dydt + 3)) return whole_row(t, y, dydt, params);
    for (int i = 0; i < 3; i++) dydt[i] = y[3 + i];
    return 0;
}

int loops_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant plain = smooth_instant(state, t, y), room;
    const struct instant *at = instant_with_places(state->model, &plain, &room);
    force_slots(state->model, at, state->slots);
    if (!closed_loops_rates(state->tree->loops, at, state->model->plan.n, state->slots, dydt))
        return whole_row(t, y, dydt, params);
    return 0;
}

/* User states. */
int own_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_state *state = row->all->state;
    struct instant at = smooth_instant(state, t, y);
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
