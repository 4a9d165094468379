/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/rest_system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/friction.h"
#include "dynamics/tree_system.h"
#include "numeric/lcp.h"
#include "numeric/least_distance.h"

/* ---- sizes: what zero is measured against */

/* The largest arm of a body's arrows about its centre of mass, then the largest load, couples over that. */
static bool find_sizes(struct rest_system *system)
{
    const struct fbd_model *model = system->state->model;
    const struct instant at = system->at;
    struct arrow *arrows = ARENA_ARRAY(system->arena, diagram_most_arrows(model), struct arrow);
    double couple = 0, heaviest = 0;
    for (size_t b = 0; arrows && b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct pose pose = body_pose(body, &at);
        struct vec G = point_motion(body, &pose, body->inertia.G).p;
        heaviest = fmax(heaviest, body->inertia.mass);
        size_t count = diagram_fill(model, (int)b, &at, system->accelerations, system->slots0, arrows);
        for (size_t i = 0; i < count; i++) {
            system->length = fmax(system->length, vec_norm(vec_sub(arrows[i].point, G)));
            if (arrow_is_reaction(model, &arrows[i])) continue;
            system->force = fmax(system->force, vec_norm(arrows[i].force));
            couple = fmax(couple, fabs(arrows[i].couple));
        }
    }
    if (system->length == 0) system->length = 1;
    system->force = fmax(system->force, couple / system->length);
    /* Where all loads vanish, as at the neutral place of a spring, a millionth of the weights is a size. */
    system->force = fmax(system->force, 1e-6 * heaviest * vec_norm(model->scene->gravity));
    return arrows != NULL;
}

/* ---- the affine maps of lambda */

static void read_reactions(const struct rest_system *system, const double *slots, double *r)
{
    const struct fbd_model *model = system->state->model;
    const struct instant at = system->at;
    for (int i = 1; model->tree && i < model->tree->count; i++) {
        const struct tree_link *link = &model->tree->links[i];
        const struct tree_state *s = &system->state->tree->links[i];
        const double *g = slots + link->coordinate;
        double *own = r + 3 * (size_t)(i - 1);
        own[0] = s->F.force.x;
        own[1] = s->F.force.y;
        own[2] = s->F.moment / system->length;
        if (link->kind == motion_pivot) own[2] -= g[0] / system->length;
        if (link->kind != motion_slide) continue;
        const struct model_body *body = &model->bodies[link->body];
        struct pose pose = body_pose(body, &at);
        struct vec arm = vec_sub(s->p, point_motion(body, &pose, body->inertia.G).p);
        own[0] = vec_dot(s->e, s->F.force) - g[0];
        own[1] = vec_cross(s->e, s->F.force);
        own[2] = (s->F.moment + vec_cross(arm, s->F.force)) / system->length;
    }
    for (size_t j = 0; j < system->m; j++)
        r[rest_entry_of_row(system, j)] = system->state->tree->rows[system->rows[j]].lambda;
}

/* Row number j, and the friction that goes with it where its body slips. */
static void add_to_row(struct rest_system *system, size_t j, double step)
{
    int row = system->rows[j];
    double share = tree_rubbing_share(system->state->model, &system->at, row);
    system->lambda[row] += step;
    if (share != 0) system->lambda[row + 1] += share * step;
}

static void set_columns(struct rest_system *system)
{
    const struct fbd_model *model = system->state->model;
    double *Q = system->Q, *r = system->r, *slots = system->forces;
    size_t bytes = (size_t)(model->tree ? model->tree->row_count : 0) * sizeof *system->lambda;
    for (size_t j = 0; j < system->m; j++) {
        memset(system->lambda, 0, bytes);
        add_to_row(system, j, 1);
        rest_forces(model, &system->at, system->lambda, false, slots, Q);
        read_reactions(system, slots, r);
        for (size_t k = 0; k < system->n; k++) system->E[k * system->m + j] = system->scale[k] * Q[k];
        for (size_t k = 0; k < system->slots; k++) system->columns[k * system->m + j] = slots[k];
        for (size_t k = 0; k < system->reactions; k++) system->R[k * system->m + j] = r[k];
    }
    memset(system->lambda, 0, bytes);
}

static void add_to_lambda(struct rest_system *system, const double *step)
{
    for (size_t j = 0; j < system->m; j++) add_to_row(system, j, step[j]);
}

/* Add what was there before lambda. */
static void add_base(struct rest_system *system)
{
    const struct rest_base *base = &system->base;
    const struct tree *tree = system->state->model->tree;
    struct tree_work *work = system->at.tree;
    for (size_t k = 0; k < system->slots; k++) system->forces[k] += base->slots[k];
    for (int i = 0; i < tree->count; i++) {
        work->links[i].F.moment += base->F[i].moment;
        work->links[i].F.force = vec_add(work->links[i].F.force, base->F[i].force);
    }
    for (int j = 0; j < tree->row_count; j++) work->rows[j].lambda += base->lambda[j];
}

/* Everything at the present lambda. */
static void evaluate(struct rest_system *system)
{
    rest_forces(system->state->model, &system->at, system->lambda, !system->base.moves, system->forces,
                system->Q);
    if (system->base.moves) add_base(system);
    read_reactions(system, system->forces, system->r);
}

/* ---- limits */

size_t rest_limits(const struct rest_system *system)
{
    return system->state->model->plan.contact_count + system->state->model->plan.friction_count;
}

/* Of friction both sides are limits, of others one; unused ones are empty: 0 >= 0. `slots` and `lambda` may
 * be those of a column; without lambda those of the rows. */
static void limit_values(const struct rest_system *system, const double *slots, size_t stride,
                         const double *lambda, bool loads, double *values)
{
    const struct plan *plan = &system->state->model->plan;
    const struct instant at = system->at;
    double *next = values;
    for (size_t i = 0; i < plan->contact_count; i++)
        *next++ = -slots[(size_t)plan->contacts[i].slot * stride];
    for (size_t i = 0; i < plan->friction_count; i++, next += 2) {
        const struct friction *friction = &plan->frictions[i];
        next[0] = next[1] = 0;
        if (!rest_has_limit(friction) || at.slip[i] != stick) continue;
        if (friction->kind == mode_rope) {
            int row = system->state->model->tree->ties[friction->tie].first_row;
            next[0] = -(lambda ? lambda[row] : at.tree->rows[row].lambda);
            continue;
        }
        double acceleration = 0, press = loads;
        friction_surface_speed(friction, &at, &acceleration);
        double hold = -slots[(size_t)friction->hold_slot * stride];
        if (loads) hold += friction->inertia * acceleration;
        if (friction->normal_slot >= 0)
            press = -at.pull[i] * slots[(size_t)friction->normal_slot * stride];
        double limit = fmax(formula_value(&friction->mu_s, &at), formula_value(&friction->mu_k, &at)) * press;
        next[0] = limit - hold;
        next[1] = limit + hold;
    }
}

static size_t limit_value_count(const struct rest_system *system)
{
    return system->state->model->plan.contact_count + 2 * system->state->model->plan.friction_count;
}

/* Rounding, and the last digits of a coefficient in a file. */
static double limit_slack(const struct rest_system *system)
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
    const struct friction *friction = &plan->frictions[pair];
    struct rest_limit limit = {friction->kind == mode_rope ? limit_rope : limit_friction, pair, 0, 0};
    if (!rest_has_limit(friction) || system->state->slip[pair] != stick) return limit;
    const struct instant at = system->at;
    if (friction->kind == mode_rope) {
        limit.needed = -system->state->tree->rows[model->tree->ties[friction->tie].first_row].lambda;
        return limit;
    }
    struct friction_values values = friction_at(model, pair, &at, slots);
    limit.needed = fabs(values.hold);
    limit.may = fmax(values.limit_static, values.limit_kinetic);
    return limit;
}

/* ---- least reactions */

/* Columns of R times null vectors, and their own singular values: r changes by `basis` w at the rate |w|. */
static bool set_basis(struct rest_system *system, double *start)
{
    size_t m = system->m, d = m - system->svd.rank, count = system->reactions;
    double *RZ = ARENA_ARRAY(system->arena, count * d + 1, double);
    double *y = ARENA_ARRAY(system->arena, d + 1, double);
    system->basis = ARENA_ARRAY(system->arena, m * d + 1, double);
    system->basis_count = d;
    if (!RZ || !y || !system->basis) return false;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < d; k++)
            for (size_t j = 0; j < m; j++)
                RZ[i * d + k] += system->R[i * m + j] * svd_null(&system->svd, j, k);
    struct svd least;
    bool made = svd_decompose(&least, count, d, RZ);
    if (made) svd_add_solution(&least, system->r, y);
    for (size_t j = 0; made && j < m; j++) {
        for (size_t k = 0; k < d; k++) {
            start[j] -= svd_null(&system->svd, j, k) * y[k];
            for (size_t l = 0; l < least.rank; l++)
                system->basis[j * d + l] += svd_null(&system->svd, j, k) * least.V[l * d + k] / least.S[l];
        }
    }
    svd_free(&least);
    return made;
}

/* At the present lambda. */
static void read_limits(const struct rest_system *system, double *values)
{
    limit_values(system, system->forces, 1, NULL, true, values);
}

static bool limits_hold(const struct rest_system *system, double *values)
{
    size_t count = limit_value_count(system);
    read_limits(system, values);
    for (size_t i = 0; i < count; i++)
        if (!(values[i] >= -limit_slack(system))) return false;
    return true;
}

/* How the limits change with the coordinates of the null space: G, limit_value_count x basis_count. */
static bool limit_slopes(struct rest_system *system, double *G)
{
    size_t count = limit_value_count(system), d = system->basis_count, m = system->m;
    size_t rows = (size_t)system->state->model->tree->row_count;
    double *one = ARENA_ARRAY(system->arena, count + 1, double);
    double *unit = ARENA_ARRAY(system->arena, rows + 1, double);
    if (!one || !unit) return false;
    for (size_t j = 0; j < m; j++) {
        unit[system->rows[j]] = 1;
        limit_values(system, system->columns + j, m, unit, false, one);
        unit[system->rows[j]] = 0;
        for (size_t i = 0; i < count; i++)
            for (size_t k = 0; k < d; k++) G[i * d + k] += one[i] * system->basis[j * d + k];
    }
    return true;
}

/* Go by w times `size` in the null space. */
static bool move(struct rest_system *system, const double *w, double size)
{
    double *step = ARENA_ARRAY(system->arena, system->m + 1, double);
    if (!step) return false;
    for (size_t j = 0; j < system->m; j++)
        for (size_t k = 0; k < system->basis_count; k++)
            step[j] += size * system->basis[j * system->basis_count + k] * w[k];
    add_to_lambda(system, step);
    evaluate(system);
    return true;
}

/* The limits hold at the least reactions, or at others that balance as well: then at the least of these. At
 * first to the digit; where there is next to no room between them, to the slack that they have. */
static bool keep_limits(struct rest_system *system)
{
    struct arena *arena = system->arena;
    size_t count = limit_value_count(system), d = system->basis_count;
    double *values = ARENA_ARRAY(arena, count + 1, double), *h = ARENA_ARRAY(arena, count + 1, double);
    double *G = ARENA_ARRAY(arena, count * d + 1, double), *w = ARENA_ARRAY(arena, d + 1, double);
    if (!values || !h || !G || !w) return false;
    system->within_limits = limits_hold(system, values);
    if (system->within_limits || d == 0) return true;
    if (!limit_slopes(system, G)) return false;
    for (int pass = 0; pass < 2 && !system->within_limits; pass++) {
        double slack = pass == 0 ? 0 : limit_slack(system) / 2;
        for (size_t i = 0; i < count; i++) h[i] = -(values[i] + slack) / system->force;
        enum least_distance found = least_distance(count, d, G, h, w);
        if (found == least_distance_no_memory) return false;
        if (found == least_distance_empty) continue;
        if (!move(system, w, system->force)) return false;
        double *after = ARENA_ARRAY(arena, count + 1, double);
        if (!after) return false;
        system->within_limits = limits_hold(system, after);
        if (!system->within_limits && !move(system, w, -system->force)) return false;
    }
    return true;
}

/* ---- the whole */

static bool allocate(struct rest_system *system)
{
    const struct fbd_model *model = system->state->model;
    const struct tree *tree = model->tree;
    struct arena *arena = system->arena;
    size_t rows = (size_t)(tree ? tree->row_count : 0);
    const struct instant at = system->at;
    system->rows = ARENA_ARRAY(arena, rows + 1, int);
    for (int j = 0; system->rows && j < (int)rows; j++)
        if (tree_takes_part(tree, &at, j)) system->rows[system->m++] = j;
    size_t n = system->n, m = system->m;
    system->reactions = m + 3 * (size_t)(tree ? tree->count - 1 : 0);
    system->held = ARENA_ARRAY(arena, n + 1, bool);
    system->scale = ARENA_ARRAY(arena, n + 1, double);
    system->lambda = ARENA_ARRAY(arena, rows + 1, double);
    system->Q = ARENA_ARRAY(arena, n + 1, double);
    system->E = ARENA_ARRAY(arena, n * m + 1, double);
    system->slots0 = ARENA_ARRAY(arena, system->slots + 1, double);
    system->columns = ARENA_ARRAY(arena, system->slots * m + 1, double);
    system->r = ARENA_ARRAY(arena, system->reactions + 1, double);
    system->R = ARENA_ARRAY(arena, system->reactions * m + 1, double);
    if (!system->forces) system->forces = ARENA_ARRAY(arena, system->slots + 1, double);
    return !arena->failed;
}

static void set_scales(struct rest_system *system)
{
    const struct coordinate *coordinates = system->state->model->scene->coordinates;
    for (size_t k = 0; k < system->n; k++) {
        system->held[k] = rest_holder(system->state->model, &system->at, (int)k) >= 0;
        system->scale[k] = system->held[k] ? 0 : coordinates[k].angle ? 1 / system->length : 1;
    }
}

/* Guides that press on either side: on the one where they do. True when that changes anything that slips, or
 * with `any` anything at all. What slips as the scene moves is not asked again. */
static bool choose_sides(struct rest_system *system, bool any)
{
    const struct plan *plan = &system->state->model->plan;
    bool changed = false;
    for (size_t pair = 0; pair < plan->friction_count; pair++) {
        const struct friction *friction = &plan->frictions[pair];
        bool sticks = system->at.slip[pair] == stick;
        if (!friction->two_sided || friction->normal_slot < 0 || (system->base.moves && !sticks)) continue;
        int side = system->forces[friction->normal_slot] > 0 ? -1 : 1;
        changed |= side != system->state->pull[pair] && (any || !sticks);
        system->state->pull[pair] = side;
    }
    return changed;
}

/* lambda that balances, with the least reactions. */
static bool balance(struct rest_system *system)
{
    size_t n = system->n, m = system->m;
    double *step = ARENA_ARRAY(system->arena, m + 1, double),
           *left = ARENA_ARRAY(system->arena, n + 1, double);
    if (!step || !left) return false;
    set_columns(system);
    svd_free(&system->svd);
    if (!svd_decompose(&system->svd, n, m, system->E)) return false;
    for (int pass = 0; pass < 2; pass++) { /* the second mends the rounding of the first */
        evaluate(system);
        for (size_t k = 0; k < n; k++) left[k] = -system->scale[k] * system->Q[k];
        memset(step, 0, m * sizeof *step);
        svd_add_solution(&system->svd, left, step);
        add_to_lambda(system, step);
    }
    evaluate(system);
    memset(step, 0, m * sizeof *step);
    if (!set_basis(system, step)) return false;
    add_to_lambda(system, step);
    evaluate(system);
    return true;
}

bool rest_solve(struct rest_system *system, struct fbd_state *state, struct arena *arena)
{
    enum { most_passes = 3 };
    const struct plan *plan = &state->model->plan;
    *system = (struct rest_system){.state = state,
                                   .at = state_instant(state),
                                   .accelerations = state->a,
                                   .forces = state->slots,
                                   .arena = arena,
                                   .n = (size_t)plan->n,
                                   .slots = (size_t)plan->slots};
    if (!allocate(system)) return false;
    rest_forces(state->model, &system->at, system->lambda, true, system->slots0, system->Q);
    if (!find_sizes(system)) return false;
    set_scales(system);
    for (int pass = 0; pass < most_passes; pass++) {
        if (!balance(system)) return false;
        if (!choose_sides(system, false)) break;
    }
    return keep_limits(system);
}

void rest_free(struct rest_system *system)
{
    svd_free(&system->svd);
}

/* ---- as the scene moves */

bool rest_is_open(const struct fbd_model *model, const struct instant *at)
{
    if (!model->tree) return false;
    for (int j = 0; j < model->tree->row_count; j++)
        if (at->tree->rows[j].weak && tree_takes_part(model->tree, at, j)) return true;
    return false;
}

static bool keep_base(struct rest_system *system, const double *slots)
{
    const struct tree *tree = system->state->model->tree;
    const struct tree_work *work = system->at.tree;
    struct rest_base *base = &system->base;
    *base = (struct rest_base){.moves = true,
                               .slots = ARENA_ARRAY(system->arena, system->slots + 1, double),
                               .lambda = ARENA_ARRAY(system->arena, (size_t)tree->row_count + 1, double),
                               .F = ARENA_ARRAY(system->arena, (size_t)tree->count, struct wrench)};
    if (!base->slots || !base->lambda || !base->F) return false;
    memcpy(base->slots, slots, system->slots * sizeof *slots);
    memcpy(system->slots0, slots, system->slots * sizeof *slots);
    for (int j = 0; j < tree->row_count; j++) base->lambda[j] = work->rows[j].lambda;
    for (int i = 0; i < tree->count; i++) base->F[i] = work->links[i].F;
    return true;
}

bool rest_open(struct rest_system *system, struct fbd_state *state, const struct instant *at,
               const double *slots, const double *accelerations, struct arena *arena)
{
    const struct plan *plan = &state->model->plan;
    *system = (struct rest_system){.state = state,
                                   .at = *at,
                                   .accelerations = accelerations,
                                   .arena = arena,
                                   .n = (size_t)plan->n,
                                   .slots = (size_t)plan->slots};
    if (!rest_is_open(state->model, at)) return false;
    if (!allocate(system) || !keep_base(system, slots) || !find_sizes(system)) return false;
    set_scales(system);
    set_columns(system);
    double *least = ARENA_ARRAY(arena, system->m + 1, double);
    bool made = least && svd_decompose(&system->svd, system->n, system->m, system->E);
    evaluate(system);
    made = made && set_basis(system, least);
    system->least = least;
    if (!made) arena->failed = true;
    return made && system->basis_count > 0;
}

void rest_restore(struct rest_system *system)
{
    memset(system->lambda, 0, (size_t)system->state->model->tree->row_count * sizeof *system->lambda);
    evaluate(system);
}

bool rest_choose_sides(struct rest_system *system)
{
    rest_restore(system);
    add_to_lambda(system, system->least);
    evaluate(system);
    return choose_sides(system, true);
}

void rest_share(struct rest_system *system, double *slots)
{
    rest_restore(system);
    add_to_lambda(system, system->least);
    evaluate(system);
    if (!keep_limits(system)) system->arena->failed = true;
    memcpy(slots, system->forces, system->slots * sizeof *slots);
}

/* ---- what is left to the limits */

/* Value i moves by G[i] with the null space: does it, and is it one? */
static double slope_size(const double *G, size_t d, size_t i)
{
    double most = 0;
    for (size_t k = 0; k < d; k++) most = fmax(most, fabs(G[i * d + k]));
    return most;
}

/* The pair that limit i belongs to, -1 for the normal force of a slide. */
static int pair_of_limit(const struct plan *plan, size_t i)
{
    return i < plan->contact_count ? plan->contacts[i].pair : (int)((i - plan->contact_count) / 2);
}

/* What a margin of one unit is for limit i: a force, or a moment on the length of the scene. */
static double unit_of_limit(const struct rest_system *system, size_t i)
{
    const struct plan *plan = &system->state->model->plan;
    int pair = pair_of_limit(plan, i);
    if (i < plan->contact_count || plan->frictions[pair].kind != mode_friction) return 1;
    return plan->frictions[pair].normal_slot < 0 ? system->length : 1;
}

static double limit_along(const struct rest_system *system, const double *slots_along,
                          const double *lambda_along, size_t i, const struct direction *flow)
{
    const struct fbd_model *model = system->state->model;
    const struct plan *plan = &model->plan;
    if (i < plan->contact_count) return -slots_along[plan->contacts[i].slot];
    int pair = pair_of_limit(plan, i);
    const struct friction *friction = &plan->frictions[pair];
    if (friction->kind == mode_rope) return -lambda_along[model->tree->ties[friction->tie].first_row];
    struct friction_values now = friction_at(model, pair, &system->at, system->forces);
    struct friction_values rate =
        friction_along(model, pair, &system->at, system->forces, flow, slots_along);
    double limit = now.limit_kinetic > now.limit_static ? rate.limit_kinetic : rate.limit_static;
    return (i - plan->contact_count) % 2 == 0 ? limit - rate.hold : limit + rate.hold;
}

/* The programme: most s' with unit_i s' - G_i (y' - y'') <= b_i and s' <= cap, s', y', y'' >= 0, as the
 * complementarity of its optimality conditions. */
struct programme {
    size_t d, limits, unknowns; /* of y; of inequalities with the last, s' <= cap; 1 + 2 d */
    size_t *limit;              /* limits - 1: their indices */
    double *M, *q, *z, *w;
};

static bool programme_new(struct programme *of, struct arena *arena, const double *G, size_t count, size_t d)
{
    const double negligible = 1e-9;
    double most = 0;
    *of = (struct programme){.d = d, .unknowns = 1 + 2 * d};
    of->limit = ARENA_ARRAY(arena, count + 1, size_t);
    if (!of->limit) return false;
    for (size_t i = 0; i < count; i++) most = fmax(most, slope_size(G, d, i));
    for (size_t i = 0; i < count; i++)
        if (slope_size(G, d, i) > negligible * most) of->limit[of->limits++] = i;
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

/* The largest margin over `size`; the multipliers are left in z. */
static double solve_programme(struct programme *of, const struct rest_system *system, const double *G,
                              const double *values, double size)
{
    double least = HUGE_VAL;
    for (size_t k = 0; k + 1 < of->limits; k++)
        least = fmin(least, values[of->limit[k]] / (unit_of_limit(system, of->limit[k]) * size));
    for (size_t k = 0; k < of->limits; k++) {
        bool cap = k + 1 == of->limits;
        size_t i = of->limit[k];
        double unit = cap ? 1 : unit_of_limit(system, i);
        set_inequality(of, k, 0, 1);
        for (size_t j = 0; j < of->d && !cap; j++) {
            set_inequality(of, k, 1 + j, -G[i * of->d + j] / unit);
            set_inequality(of, k, 1 + of->d + j, G[i * of->d + j] / unit);
        }
        of->q[of->unknowns + k] = cap ? 1 + fmax(0, -least) : values[i] / (unit * size) - least;
    }
    of->q[0] = -1;
    enum lcp found = lcp_solve(of->unknowns + of->limits, of->M, of->q, of->z, of->w);
    return found == lcp_solved ? least + of->z[0] : least;
}

bool rest_find_margin(struct rest_system *system, const double *slots_along, const double *lambda_along,
                      const struct direction *flow, struct rest_margin *margin)
{
    const double share = 1e-9;
    const struct plan *plan = &system->state->model->plan;
    struct arena *arena = system->arena;
    size_t count = limit_value_count(system), d = system->basis_count;
    double *values = ARENA_ARRAY(arena, count + 1, double), *G = ARENA_ARRAY(arena, count * d + 1, double);
    struct programme of;
    *margin = (struct rest_margin){.size = system->force, .value = HUGE_VAL};
    margin->of = ARENA_ARRAY(arena, plan->friction_count + 1, bool);
    margin->contacts = ARENA_ARRAY(arena, plan->contact_count + 1, bool);
    margin->gives = ARENA_ARRAY(arena, plan->friction_count + 1, int);
    rest_restore(system);
    if (!values || !G || !margin->of || !margin->contacts || !margin->gives || !limit_slopes(system, G)) return false;
    if (!programme_new(&of, arena, G, count, d)) return false;
    if (of.limits == 1) return true;
    read_limits(system, values);
    double sum = 0;
    margin->value = solve_programme(&of, system, G, values, system->force) * system->force;
    for (size_t k = 0; k + 1 < of.limits; k++) {
        size_t i = of.limit[k];
        int pair = pair_of_limit(plan, i);
        double u = of.z[of.unknowns + k];
        sum += u;
        if (pair >= 0) margin->of[pair] = true;
        if (i < plan->contact_count) margin->contacts[i] = true;
        if (u <= share) continue;
        margin->rate += u / unit_of_limit(system, i) * limit_along(system, slots_along, lambda_along, i, flow);
        if (pair < 0) continue;
        bool back = plan->frictions[pair].kind == mode_friction && (i - plan->contact_count) % 2 == 0;
        margin->gives[pair] = back ? slip_minus : slip_plus;
    }
    sum += of.z[of.unknowns + of.limits - 1]; /* of the cap, which does not vary */
    if (sum > 0) margin->rate /= sum;
    return true;
}
