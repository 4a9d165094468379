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
    if (!rest_has_limit(mode) || system->at.slip[pair] != stick || mode->kind == mode_plane) return;
    bound.kind = mode->kind == mode_rope ? bound_rope : bound_friction;
    if (bound.kind == bound_friction) {
        const struct friction_coefficients mu = friction_coefficients_at(model, pair, &system->at, NULL);
        bound.mu = fmax(mu.resting, mu.slipping);
        if (mode->moment) bound.unit = system->length;
        add_bound(system, bound);
    }
    bound.side = 1;
    add_bound(system, bound);
}

bool rest_find_bounds(struct rest_system *system)
{
    const struct plan *plan = &system->state->model->plan;
    system->bound_room = plan->contact_count + 2 * plan->mode_count + 1;
    system->bounds = ARENA_ARRAY(system->arena, system->bound_room, struct rest_bound);
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
    if (bound->kind == bound_plane) return rest_cut_value(system, &bound->cut, lambda, loads);
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
    if (bound->kind == bound_plane) return rest_cut_along(system, &bound->cut, lambda_along, flow);
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
    size_t *bound, *column; /* count: its number; size: of the basis */
    double *G, *h, *u, *y;  /* count x size, scaled; count; multipliers; size */
    double margin;
};

/* The margin while it is sought. */
struct search {
    struct rest_system *system;
    enum rest_scope scope;
    const double *slots_along, *lambda_along;
    const struct direction *flow;
    struct rest_margin *margin;
    double *values, *y;   /* of the bounds; of the basis */
    struct programme *of; /* parts */
    bool *varies;         /* bound_count: it is in a programme */
    int *gives;
};

static double largest(const double *row, size_t n)
{
    double most = 0;
    for (size_t k = 0; k < n; k++) most = fmax(most, fabs(row[k]));
    return most;
}

static bool is_in_scope(const struct search *search, const struct rest_bound *bound)
{
    return search->scope != rest_without_guides || bound->pair >= 0 || bound->kind == bound_plane;
}

static bool programme_new(struct programme *of, const struct search *search, const struct rest_part *part)
{
    const double negligible = undecided_part; /* of a unit of the reactions */
    const struct rest_system *system = search->system;
    struct arena *arena = system->arena;
    *of = (struct programme){.size = part->size, .bound = part->limit, .column = part->column, .G = part->G};
    of->h = ARENA_ARRAY(arena, 2 * part->limits + part->size + 1, double);
    if (!of->h) return false;
    of->u = of->h + part->limits;
    of->y = of->u + part->limits;
    for (size_t k = 0; k < part->limits; k++) {
        const struct rest_bound *bound = &system->bounds[part->limit[k]];
        const double *row = part->G + k * part->size;
        if (!is_in_scope(search, bound) || largest(row, part->size) <= negligible * bound->unit) continue;
        for (size_t j = 0; j < part->size; j++) of->G[of->count * part->size + j] = row[j] / bound->unit;
        of->h[of->count] = -search->values[part->limit[k]] / (bound->unit * system->force);
        search->varies[part->limit[k]] = true;
        of->bound[of->count++] = part->limit[k];
    }
    return true;
}

/* The largest margin, not above one load beyond that of the least reactions. */
static bool solve_programme(struct programme *of, const struct search *search)
{
    const struct rest_system *system = search->system;
    double least = HUGE_VAL;
    for (size_t k = 0; k < of->count; k++) least = fmin(least, -of->h[k]);
    if (!least_distance_rise(of->count, of->size, of->G, of->h, fmax(1, 1 + least), &of->margin, of->u,
                             of->y)) {
        system->arena->failed = true;
        return false;
    }
    of->margin *= system->force;
    for (size_t k = 0; k < of->size; k++) search->y[of->column[k]] = system->force * of->y[k];
    return true;
}

/* Add a bound with multiplier u to the rate of its margin, and to the modes after it is exhausted. */
static double add_rate(const struct search *search, const struct rest_bound *bound, double u)
{
    if (u <= undecided_part) return 0;
    if (bound->pair >= 0) search->gives[bound->pair] = bound->side < 0 ? slip_minus : slip_plus;
    if (bound->kind == bound_plane)
        rest_cut_gives(search->system, &bound->cut, u, search->gives, search->margin->aims);
    return u / bound->unit *
           bound_along(search->system, search->slots_along, search->lambda_along, bound, search->flow);
}

static void mark_limit(const struct search *search, const struct rest_bound *bound)
{
    const struct rest_margin *margin = search->margin;
    if (bound->pair >= 0) margin->of[bound->pair] = true;
    if (bound->kind == bound_normal) margin->contacts[bound->contact] = true;
    if (bound->kind == bound_plane) rest_cut_mark(search->system, &bound->cut, margin->of);
}

/* Combine parts: the margin is the smallest; of equal ones the fastest decreasing, and the modes of all of
 * them change. */
static void take_part(const struct search *search, double value, double rate)
{
    struct rest_margin *margin = search->margin;
    const size_t pairs = search->system->state->model->plan.mode_count;
    double slack = rest_margin_slack(margin);
    if (value > margin->value + slack) return;
    bool less = value < margin->value - slack;
    for (size_t i = 0; i < pairs; i++)
        if (less || search->gives[i] != 0) margin->gives[i] = search->gives[i];
    margin->rate = less ? rate : fmin(rate, margin->rate);
    margin->value = less ? value : fmin(value, margin->value);
}

/* The rate of the margin of a part: of the limits with multipliers. */
static void take_programme(const struct search *search, const struct programme *of)
{
    const struct rest_system *system = search->system;
    double rate = 0;
    memset(search->gives, 0, system->state->model->plan.mode_count * sizeof *search->gives);
    for (size_t k = 0; k < of->count; k++) {
        mark_limit(search, &system->bounds[of->bound[k]]);
        rate += add_rate(search, &system->bounds[of->bound[k]], of->u[k]);
    }
    take_part(search, of->margin, rate);
}

/* A limit of friction on a plane which no change of the reactions changes: that of a body with several points. */
static void take_constant(const struct search *search, size_t i)
{
    const struct rest_bound *bound = &search->system->bounds[i];
    if (bound->kind != bound_plane || search->varies[i]) return;
    memset(search->gives, 0, search->system->state->model->plan.mode_count * sizeof *search->gives);
    mark_limit(search, bound);
    take_part(search, search->values[i], add_rate(search, bound, 1));
}

static bool search_new(struct search *search)
{
    struct rest_system *system = search->system;
    const struct plan *plan = &system->state->model->plan;
    struct arena *arena = system->arena;
    const size_t pairs = plan->mode_count;
    struct rest_margin *margin = search->margin;
    *margin = (struct rest_margin){.size = system->force, .value = HUGE_VAL};
    margin->of = ARENA_ARRAY(arena, pairs + 1, bool);
    margin->contacts = ARENA_ARRAY(arena, plan->contact_count + 1, bool);
    margin->gives = ARENA_ARRAY(arena, pairs + 1, int);
    margin->aims = ARENA_ARRAY(arena, pairs + 1, struct vec);
    search->values = ARENA_ARRAY(arena, system->bound_count + 1, double);
    search->y = ARENA_ARRAY(arena, system->basis_count + 1, double);
    search->of = ARENA_ARRAY(arena, (size_t)system->parts + 1, struct programme);
    search->varies = ARENA_ARRAY(arena, system->bound_count + 1, bool);
    search->gives = ARENA_ARRAY(arena, pairs + 1, int);
    return !arena->failed;
}

/* With the present limits; leaves the reactions with that margin. */
static bool find_once(struct search *search)
{
    struct rest_system *system = search->system;
    const size_t count = system->bound_count, d = system->basis_count;
    double *G = ARENA_ARRAY(system->arena, count * d + 1, double);
    rest_restore(system);
    if (!G || !search_new(search) || !rest_bound_slopes(system, G)) return false;
    rest_read_bounds(system, search->values);
    for (int which = 0; which < system->parts; which++) {
        struct rest_part part;
        struct programme *of = &search->of[which];
        if (!rest_part(system, G, which, &part) || !programme_new(of, search, &part)) return false;
        if (of->count > 0 && !solve_programme(of, search)) return false;
    }
    if (search->scope == rest_all && system->state->model->tree->plane_count > 0 &&
        !rest_move(system, search->y, 1))
        return false;
    for (int which = 0; which < system->parts; which++)
        if (search->of[which].count > 0) take_programme(search, &search->of[which]);
    for (size_t i = 0; i < count; i++) take_constant(search, i);
    return true;
}

bool rest_find_margin(struct rest_system *system, enum rest_scope scope, const double *slots_along,
                      const double *lambda_along, const struct direction *flow, struct rest_margin *margin)
{
    enum { most_cuts = 200 };
    struct search search = {.system = system,
                            .scope = scope,
                            .slots_along = slots_along,
                            .lambda_along = lambda_along,
                            .flow = flow,
                            .margin = margin};
    const bool planes = scope == rest_all && system->state->model->tree->plane_count > 0;
    rest_restore(system);
    if (planes) rest_cut_planes(system, lambda_along, HUGE_VAL);
    bool found = find_once(&search);
    for (int cut = 0; planes && found && cut < most_cuts; cut++) {
        if (!rest_cut_planes(system, lambda_along, margin->value - rest_margin_slack(margin) / 4)) break;
        found = find_once(&search);
    }
    return found && !system->arena->failed;
}
