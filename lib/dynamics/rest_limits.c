/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The limits of redundant loads, and the distance to them.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/friction.h"
#include "dynamics/rest_system.h"
#include "numeric/least_distance.h"
#include "numeric/tolerances.h"
#include "numeric/vector.h"

/* ---- limits */

size_t rest_limits(const struct rest_system *system)
{
    return system->state->model->plan.contact_count + system->state->model->plan.mode_count;
}

/* A two-sided guide with slipping friction keeps its loaded side as the scene moves. */
static bool keeps_side(const struct rest_system *system, size_t pair)
{
    const struct mode *mode = &system->state->model->plan.modes[pair];
    return system->base.moves && mode_is_friction(mode) && mode->two_sided && mode->normal_slot >= 0 &&
           system->at.slip[pair] != stick &&
           friction_coefficient(system->state->model, (int)pair, &mode->mu_k, &system->at, NULL, NULL) != 0;
}

static void add_bound(struct rest_system *system, struct rest_bound bound)
{
    system->bounds[system->bound_count++] = bound;
}

static void add_bounds_of_mode(struct rest_system *system, int pair)
{
    const struct fbd_model *model = system->state->model;
    const struct mode *mode = &model->plan.modes[pair];
    struct rest_bound bound = {.kind = bound_guide, .pair = pair, .unit = 1, .side = -1};
    if (keeps_side(system, (size_t)pair)) add_bound(system, bound);
    if (!rest_has_limit(mode) || system->at.slip[pair] != stick) return;
    bound.kind = mode->kind == mode_rope ? bound_rope : bound_friction;
    if (bound.kind == bound_friction) {
        double resting = friction_coefficient(model, pair, &mode->mu_s, &system->at, NULL, NULL);
        double moving = friction_coefficient(model, pair, &mode->mu_k, &system->at, NULL, NULL);
        bound.mu = fmax(resting, moving);
        if (mode->moment) bound.unit = system->length;
        add_bound(system, bound);
    }
    bound.side = 1;
    add_bound(system, bound);
}

bool rest_find_bounds(struct rest_system *system)
{
    const struct plan *plan = &system->state->model->plan;
    system->bounds =
        ARENA_ARRAY(system->arena, plan->contact_count + 2 * plan->mode_count + 1, struct rest_bound);
    if (!system->bounds) return false;
    for (size_t i = 0; i < plan->contact_count; i++) {
        int pair = plan->contacts[i].pair;
        bool open = pair >= 0 && mode_is_one_sided(&plan->modes[pair]) && system->at.slip[pair] != stick;
        if (!open) add_bound(system, (struct rest_bound){.pair = pair, .contact = (int)i, .unit = 1});
    }
    for (size_t pair = 0; pair < plan->mode_count; pair++) add_bounds_of_mode(system, (int)pair);
    return true;
}

/* `slots` and `lambda` may be those of a column; without lambda those of the rows. */
static double bound_value(const struct rest_system *system, const struct rest_bound *bound,
                          const double *slots, const double *lambda, bool loads)
{
    const struct fbd_model *model = system->state->model;
    const struct instant at = system->at;
    if (bound->kind == bound_normal) return -slots[model->plan.contacts[bound->contact].slot];
    const struct mode *mode = &model->plan.modes[bound->pair];
    if (bound->kind == bound_rope) {
        int row = model->tree->couplings[mode->coupling].first_row;
        return -(lambda ? lambda[row] : at.tree->rows[row].lambda);
    }
    double press = loads;
    if (mode->normal_slot >= 0) press = -at.pull[bound->pair] * slots[mode->normal_slot];
    if (bound->kind == bound_guide) return press;
    double acceleration = 0, hold = -slots[mode->hold_slot];
    if (loads) friction_surface_speed(mode, &at, &acceleration);
    hold += mode->inertia * acceleration;
    return bound->mu * press + bound->side * hold;
}

/* Rounding, and the last digits of a coefficient in a file. */
double rest_limit_slack(const struct rest_system *system)
{
    return undecided_part * system->force;
}

struct rest_limit rest_limit_at(const struct rest_system *system, size_t index)
{
    const struct fbd_model *model = system->state->model;
    const struct plan *plan = &model->plan;
    const double *slots = system->forces;
    if (index < plan->contact_count)
        return (struct rest_limit){limit_normal, (int)index, -slots[plan->contacts[index].slot], 0};
    int pair = (int)(index - plan->contact_count);
    const struct mode *mode = &plan->modes[pair];
    struct rest_limit limit = {mode->kind == mode_rope ? limit_rope : limit_friction, pair, 0, 0};
    if (!rest_has_limit(mode) || system->state->slip[pair] != stick) return limit;
    const struct instant at = system->at;
    if (mode->kind == mode_rope) {
        limit.needed = -system->state->tree->rows[model->tree->couplings[mode->coupling].first_row].lambda;
        return limit;
    }
    struct friction_values values = friction_at(model, pair, &at, slots);
    limit.needed = fabs(values.hold);
    limit.may = values.limit;
    return limit;
}

void rest_read_bounds(const struct rest_system *system, double *values)
{
    for (size_t i = 0; i < system->bound_count; i++)
        values[i] = bound_value(system, &system->bounds[i], system->forces, NULL, true);
}

bool rest_bound_slopes(struct rest_system *system, double *G)
{
    size_t d = system->basis_count, m = system->m;
    double *unit = ARENA_ARRAY(system->arena, (size_t)system->state->model->tree->row_count + 1, double);
    if (!unit) return false;
    for (size_t j = 0; j < m; j++) {
        unit[system->rows[j]] = 1;
        for (size_t i = 0; i < system->bound_count; i++) {
            double one =
                bound_value(system, &system->bounds[i], system->columns + j * system->slots, unit, false);
            if (one != 0) vector_add_multiple(G + i * d, system->basis + j * d, one, d);
        }
        unit[system->rows[j]] = 0;
    }
    return true;
}

/* ---- the distance to the limits */

static double bound_along(const struct rest_system *system, const double *slots_along,
                          const double *lambda_along, const struct rest_bound *bound,
                          const struct direction *flow)
{
    const struct fbd_model *model = system->state->model;
    if (bound->kind == bound_normal) return -slots_along[model->plan.contacts[bound->contact].slot];
    const struct mode *mode = &model->plan.modes[bound->pair];
    if (bound->kind == bound_rope) return -lambda_along[model->tree->couplings[mode->coupling].first_row];
    struct friction_values now = friction_at(model, bound->pair, &system->at, system->forces);
    struct friction_values rate =
        friction_along(model, bound->pair, &system->at, system->forces, flow, slots_along);
    if (bound->kind == bound_guide) return system->at.pull[bound->pair] * rate.N;
    double limit = now.limit_kinetic > now.limit_static ? rate.limit_kinetic : rate.limit_static;
    return limit + bound->side * rate.hold;
}

/* The programme of a part: max s with h_i + G_i y >= unit_i s, for the bounds that change in it. */
struct programme {
    size_t size, count;
    size_t *bound;     /* count: its number */
    double *G, *h, *u; /* count x size, scaled; count; multipliers */
};

static double largest(const double *row, size_t n)
{
    double most = 0;
    for (size_t k = 0; k < n; k++) most = fmax(most, fabs(row[k]));
    return most;
}

static bool programme_new(struct programme *of, const struct rest_system *system,
                          const struct rest_part *part, bool guides, const double *values)
{
    const double negligible = undecided_part; /* of a unit of the reactions */
    struct arena *arena = system->arena;
    *of = (struct programme){.size = part->size, .bound = part->limit, .G = part->G};
    of->h = ARENA_ARRAY(arena, 2 * part->limits + 1, double);
    if (!of->h) return false;
    of->u = of->h + part->limits;
    for (size_t k = 0; k < part->limits; k++) {
        const struct rest_bound *bound = &system->bounds[part->limit[k]];
        const double *row = part->G + k * part->size;
        if ((!guides && bound->pair < 0) || largest(row, part->size) <= negligible * bound->unit) continue;
        for (size_t j = 0; j < part->size; j++) of->G[of->count * part->size + j] = row[j] / bound->unit;
        of->h[of->count] = -values[part->limit[k]] / (bound->unit * system->force);
        of->bound[of->count++] = part->limit[k];
    }
    return true;
}

/* The largest margin, not above one load beyond that of the least reactions. */
static bool solve_programme(struct programme *of, const struct rest_system *system, double *margin)
{
    double least = HUGE_VAL;
    for (size_t k = 0; k < of->count; k++) least = fmin(least, -of->h[k]);
    if (!least_distance_rise(of->count, of->size, of->G, of->h, fmax(1, 1 + least), margin, of->u)) {
        system->arena->failed = true;
        return false;
    }
    *margin *= system->force;
    return true;
}

/* The rate of the margin of a part, and the modes after it is exhausted: those of the limits with
 * multipliers. */
static double rate_of_margin(const struct rest_system *system, const struct programme *of,
                             const double *slots_along, const double *lambda_along,
                             const struct direction *flow, int *gives)
{
    double rate = 0;
    for (size_t k = 0; k < of->count; k++) {
        const struct rest_bound *bound = &system->bounds[of->bound[k]];
        if (of->u[k] <= undecided_part) continue;
        rate += of->u[k] / bound->unit * bound_along(system, slots_along, lambda_along, bound, flow);
        if (bound->pair >= 0) gives[bound->pair] = bound->side < 0 ? slip_minus : slip_plus;
    }
    return rate;
}

static void mark_limits(const struct rest_system *system, const struct programme *of,
                        struct rest_margin *margin)
{
    for (size_t k = 0; k < of->count; k++) {
        const struct rest_bound *bound = &system->bounds[of->bound[k]];
        if (bound->pair >= 0) margin->of[bound->pair] = true;
        if (bound->kind == bound_normal) margin->contacts[bound->contact] = true;
    }
}

/* Combine parts: the margin is the smallest; of equal ones the fastest decreasing, and the modes of all of
 * them change. */
static void take_part(struct rest_margin *margin, double value, double rate, const int *gives, size_t pairs)
{
    double slack = rest_margin_slack(margin);
    if (value > margin->value + slack) return;
    bool less = value < margin->value - slack;
    for (size_t i = 0; i < pairs; i++)
        if (less || gives[i] != 0) margin->gives[i] = gives[i];
    margin->rate = less ? rate : fmin(rate, margin->rate);
    margin->value = less ? value : fmin(value, margin->value);
}

bool rest_find_margin(struct rest_system *system, bool guides, const double *slots_along,
                      const double *lambda_along, const struct direction *flow, struct rest_margin *margin)
{
    const struct plan *plan = &system->state->model->plan;
    struct arena *arena = system->arena;
    size_t count = system->bound_count, d = system->basis_count, pairs = plan->mode_count;
    double *values = ARENA_ARRAY(arena, count + 1, double), *G = ARENA_ARRAY(arena, count * d + 1, double);
    int *gives = ARENA_ARRAY(arena, pairs + 1, int);
    *margin = (struct rest_margin){.size = system->force, .value = HUGE_VAL};
    margin->of = ARENA_ARRAY(arena, pairs + 1, bool);
    margin->contacts = ARENA_ARRAY(arena, plan->contact_count + 1, bool);
    margin->gives = ARENA_ARRAY(arena, pairs + 1, int);
    rest_restore(system);
    if (!values || !G || !gives || !margin->of || !margin->contacts || !margin->gives) return false;
    if (!rest_bound_slopes(system, G)) return false;
    rest_read_bounds(system, values);
    for (int which = 0; which < system->parts; which++) {
        struct rest_part part;
        struct programme of;
        double value;
        if (!rest_part(system, G, which, &part) || !programme_new(&of, system, &part, guides, values))
            return false;
        if (of.count == 0) continue;
        if (!solve_programme(&of, system, &value)) return false;
        mark_limits(system, &of, margin);
        memset(gives, 0, pairs * sizeof *gives);
        double rate = rate_of_margin(system, &of, slots_along, lambda_along, flow, gives);
        take_part(margin, value, rate, gives, pairs);
    }
    return true;
}
