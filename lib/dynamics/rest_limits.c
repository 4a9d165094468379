/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The limits of redundant loads, and the distance to them.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/friction.h"
#include "dynamics/rest_memo.h"
#include "dynamics/rest_system.h"

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

/* Friction has two limits, other constraints one; unused ones are empty: 0 >= 0. `slots` and `lambda` may be
 * those of a column; without lambda those of the rows. */
static void limit_values(const struct rest_system *system, const double *slots, size_t stride,
                         const double *lambda, bool loads, double *values)
{
    const struct plan *plan = &system->state->model->plan;
    const struct instant at = system->at;
    double *next = values;
    for (size_t i = 0; i < plan->contact_count; i++)
        *next++ = -slots[(size_t)plan->contacts[i].slot * stride];
    for (size_t i = 0; i < plan->mode_count; i++, next += 2) {
        const struct mode *mode = &plan->modes[i];
        next[0] = next[1] = 0;
        if (keeps_side(system, i)) next[0] = -at.pull[i] * slots[(size_t)mode->normal_slot * stride];
        if (!rest_has_limit(mode) || at.slip[i] != stick) continue;
        if (mode->kind == mode_rope) {
            int row = system->state->model->tree->couplings[mode->coupling].first_row;
            next[0] = -(lambda ? lambda[row] : at.tree->rows[row].lambda);
            continue;
        }
        double acceleration = 0, press = loads;
        friction_surface_speed(mode, &at, &acceleration);
        double hold = -slots[(size_t)mode->hold_slot * stride];
        if (loads) hold += mode->inertia * acceleration;
        if (mode->normal_slot >= 0) press = -at.pull[i] * slots[(size_t)mode->normal_slot * stride];
        double resting = friction_coefficient(system->state->model, (int)i, &mode->mu_s, &at, NULL, NULL);
        double moving = friction_coefficient(system->state->model, (int)i, &mode->mu_k, &at, NULL, NULL);
        double limit = fmax(resting, moving) * press;
        next[0] = limit - hold;
        next[1] = limit + hold;
    }
}

size_t rest_limit_values(const struct rest_system *system)
{
    return system->state->model->plan.contact_count + 2 * system->state->model->plan.mode_count;
}

/* Rounding, and the last digits of a coefficient in a file. */
double rest_limit_slack(const struct rest_system *system)
{
    return 1e-9 * system->force;
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

/* At the present lambda. */
void rest_read_limits(const struct rest_system *system, double *values)
{
    limit_values(system, system->forces, 1, NULL, true, values);
}

/* The slopes of the limits with respect to the coordinates of the null space: G, rest_limit_values x
 * basis_count. */
bool rest_limit_slopes(struct rest_system *system, double *G)
{
    size_t count = rest_limit_values(system), d = system->basis_count, m = system->m;
    size_t rows = (size_t)system->state->model->tree->row_count;
    double *one = ARENA_ARRAY(system->arena, count + 1, double);
    double *unit = ARENA_ARRAY(system->arena, rows + 1, double);
    if (!one || !unit) return false;
    for (size_t j = 0; j < m; j++) {
        unit[system->rows[j]] = 1;
        limit_values(system, system->columns + j, m, unit, false, one);
        unit[system->rows[j]] = 0;
        for (size_t i = 0; i < count; i++)
            for (size_t k = 0; one[i] != 0 && k < d; k++) G[i * d + k] += one[i] * system->basis[j * d + k];
    }
    return true;
}

/* ---- the distance to the limits */

/* The largest slope of value i in the null space; 0 if the value is constant. */
static double slope_size(const double *G, size_t d, size_t i)
{
    double most = 0;
    for (size_t k = 0; k < d; k++) most = fmax(most, fabs(G[i * d + k]));
    return most;
}

/* The mode of limit i, -1 for the normal force of a slide. */
static int pair_of_limit(const struct plan *plan, size_t i)
{
    return i < plan->contact_count ? plan->contacts[i].pair : (int)((i - plan->contact_count) / 2);
}

/* The change of limit i for a unit margin: a force, or a moment at the length of the scene. */
static double unit_of_limit(const struct rest_system *system, size_t i)
{
    const struct plan *plan = &system->state->model->plan;
    int pair = pair_of_limit(plan, i);
    if (i < plan->contact_count || !mode_is_friction(&plan->modes[pair])) return 1;
    return plan->modes[pair].normal_slot < 0 ? system->length : 1;
}

static double limit_along(const struct rest_system *system, const double *slots_along,
                          const double *lambda_along, size_t i, const struct direction *flow)
{
    const struct fbd_model *model = system->state->model;
    const struct plan *plan = &model->plan;
    if (i < plan->contact_count) return -slots_along[plan->contacts[i].slot];
    int pair = pair_of_limit(plan, i);
    const struct mode *mode = &plan->modes[pair];
    if (mode->kind == mode_rope) return -lambda_along[model->tree->couplings[mode->coupling].first_row];
    struct friction_values now = friction_at(model, pair, &system->at, system->forces);
    struct friction_values rate = friction_along(model, pair, &system->at, system->forces, flow, slots_along);
    if (keeps_side(system, (size_t)pair)) return system->at.pull[pair] * rate.N;
    double limit = now.limit_kinetic > now.limit_static ? rate.limit_kinetic : rate.limit_static;
    return (i - plan->contact_count) % 2 == 0 ? limit - rate.hold : limit + rate.hold;
}

/* The programme of a part: max s' with unit_i s' - G_i (y' - y'') <= b_i and s' <= cap, s', y', y'' >= 0, as
 * the complementarity of its optimality conditions. */
struct programme {
    const struct rest_part *part;
    size_t limits, unknowns; /* inequalities including s' <= cap; 1 + 2 size of the part */
    size_t *row, *limit;     /* limits - 1: rows of the part, and indices of the limits */
    double *M, *q, *z, *w;
};

static bool programme_new(struct programme *of, const struct rest_system *system,
                          const struct rest_part *part, bool guides)
{
    const struct plan *plan = &system->state->model->plan;
    struct arena *arena = system->arena;
    const double negligible = 1e-9; /* of a unit of the reactions */
    *of = (struct programme){.part = part, .unknowns = 1 + 2 * part->size};
    of->row = ARENA_ARRAY(arena, part->limits + 1, size_t);
    of->limit = ARENA_ARRAY(arena, part->limits + 1, size_t);
    if (!of->row || !of->limit) return false;
    for (size_t k = 0; k < part->limits; k++) {
        size_t i = part->limit[k];
        bool counts = guides || pair_of_limit(plan, i) >= 0;
        if (!counts || slope_size(part->G, part->size, k) <= negligible * unit_of_limit(system, i)) continue;
        of->row[of->limits] = k;
        of->limit[of->limits++] = i;
    }
    of->limits++;
    size_t n = of->unknowns + of->limits;
    of->M = ARENA_ARRAY(arena, n * n, double);
    of->q = ARENA_ARRAY(arena, 3 * n, double);
    of->z = of->q + n;
    of->w = of->z + n;
    return of->M && of->q;
}

static void set_inequality(struct programme *of, size_t row, size_t column, double a)
{
    size_t n = of->unknowns + of->limits, i = of->unknowns + row;
    of->M[column * n + i] = a;
    of->M[i * n + column] = -a;
}

/* The largest margin divided by `size`; leaves the multipliers in z. */
static double solve_programme(struct programme *of, const struct rest_system *system, int which,
                              const double *values, double size)
{
    size_t d = of->part->size;
    double least = HUGE_VAL;
    for (size_t k = 0; k + 1 < of->limits; k++)
        least = fmin(least, values[of->limit[k]] / (unit_of_limit(system, of->limit[k]) * size));
    for (size_t k = 0; k < of->limits; k++) {
        bool cap = k + 1 == of->limits;
        size_t i = of->limit[k];
        double unit = cap ? 1 : unit_of_limit(system, i);
        const double *G = cap ? NULL : of->part->G + of->row[k] * d;
        set_inequality(of, k, 0, 1);
        for (size_t j = 0; j < d && !cap; j++) {
            set_inequality(of, k, 1 + j, -G[j] / unit);
            set_inequality(of, k, 1 + d + j, G[j] / unit);
        }
        of->q[of->unknowns + k] = cap ? 1 + fmax(0, -least) : values[i] / (unit * size) - least;
    }
    of->q[0] = -1;
    enum lcp found = rest_memo_lcp(&system->state->tree->memo, which, of->unknowns + of->limits, of->M, of->q,
                                   of->z, of->w);
    if (found == lcp_no_memory) system->arena->failed = true;
    return found == lcp_solved ? least + of->z[0] : least;
}

/* The rate of the margin of a part, and the modes after it is exhausted: those of the limits with
 * multipliers. */
static double rate_of_margin(const struct rest_system *system, const struct programme *of,
                             const double *slots_along, const double *lambda_along,
                             const struct direction *flow, int *gives)
{
    const double share = 1e-9;
    const struct plan *plan = &system->state->model->plan;
    double sum = of->z[of->unknowns + of->limits - 1]; /* of the cap, which is constant */
    double rate = 0;
    for (size_t k = 0; k + 1 < of->limits; k++) {
        size_t i = of->limit[k];
        int pair = pair_of_limit(plan, i);
        double u = of->z[of->unknowns + k];
        sum += u;
        if (u <= share) continue;
        rate += u / unit_of_limit(system, i) * limit_along(system, slots_along, lambda_along, i, flow);
        if (pair < 0) continue;
        bool back = mode_is_friction(&plan->modes[pair]) && (i - plan->contact_count) % 2 == 0;
        gives[pair] = back ? slip_minus : slip_plus;
    }
    return sum > 0 ? rate / sum : rate;
}

static void mark_limits(const struct rest_system *system, const struct programme *of,
                        struct rest_margin *margin)
{
    const struct plan *plan = &system->state->model->plan;
    for (size_t k = 0; k + 1 < of->limits; k++) {
        int pair = pair_of_limit(plan, of->limit[k]);
        if (pair >= 0) margin->of[pair] = true;
        if (of->limit[k] < plan->contact_count) margin->contacts[of->limit[k]] = true;
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
    size_t count = rest_limit_values(system), d = system->basis_count, pairs = plan->mode_count;
    double *values = ARENA_ARRAY(arena, count + 1, double), *G = ARENA_ARRAY(arena, count * d + 1, double);
    int *gives = ARENA_ARRAY(arena, pairs + 1, int);
    *margin = (struct rest_margin){.size = system->force, .value = HUGE_VAL};
    margin->of = ARENA_ARRAY(arena, pairs + 1, bool);
    margin->contacts = ARENA_ARRAY(arena, plan->contact_count + 1, bool);
    margin->gives = ARENA_ARRAY(arena, pairs + 1, int);
    rest_restore(system);
    if (!values || !G || !gives || !margin->of || !margin->contacts || !margin->gives) return false;
    if (!rest_limit_slopes(system, G)) return false;
    rest_read_limits(system, values);
    for (int which = 0; which < system->parts; which++) {
        struct rest_part part;
        struct programme of;
        if (!rest_part(system, G, which, &part) || !programme_new(&of, system, &part, guides)) return false;
        if (of.limits == 1) continue;
        double value = solve_programme(&of, system, which, values, system->force) * system->force;
        if (arena->failed) return false;
        mark_limits(system, &of, margin);
        memset(gives, 0, pairs * sizeof *gives);
        double rate = rate_of_margin(system, &of, slots_along, lambda_along, flow, gives);
        take_part(margin, value, rate, gives, pairs);
    }
    return true;
}
