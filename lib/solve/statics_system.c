/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/friction.h"
#include "dynamics/tree_system.h"
#include "numeric/least_distance.h"
#include "solve/statics.h"

/* ---- sizes: what zero is measured against */

/* The largest arm of a body's arrows about its centre of mass, then the largest load, couples over that. */
static bool find_sizes(struct rest_system *system)
{
    const struct fbd_model *model = system->state->model;
    struct instant at = state_instant(system->state);
    struct arrow *arrows = ARENA_ARRAY(system->arena, diagram_most_arrows(model), struct arrow);
    double couple = 0, heaviest = 0;
    for (size_t b = 0; arrows && b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct pose pose = body_pose(body, &at);
        struct vec G = point_motion(body, &pose, body->inertia.G).p;
        heaviest = fmax(heaviest, body->inertia.mass);
        size_t count = diagram_fill(model, (int)b, &at, system->state->a, system->slots0, arrows);
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
    struct instant at = state_instant(system->state);
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

static void set_columns(struct rest_system *system)
{
    double *Q = system->Q, *r = system->r, *slots = system->state->slots;
    for (size_t j = 0; j < system->m; j++) {
        system->lambda[system->rows[j]] = 1;
        rest_forces(system->state, system->lambda, false, slots, Q);
        system->lambda[system->rows[j]] = 0;
        read_reactions(system, slots, r);
        for (size_t k = 0; k < system->n; k++) system->E[k * system->m + j] = system->scale[k] * Q[k];
        for (size_t k = 0; k < system->slots; k++) system->columns[k * system->m + j] = slots[k];
        for (size_t k = 0; k < system->reactions; k++) system->R[k * system->m + j] = r[k];
    }
}

static void add_to_lambda(struct rest_system *system, const double *step)
{
    for (size_t j = 0; j < system->m; j++) system->lambda[system->rows[j]] += step[j];
}

/* Everything at the present lambda. */
static void evaluate(struct rest_system *system)
{
    rest_forces(system->state, system->lambda, true, system->state->slots, system->Q);
    read_reactions(system, system->state->slots, system->r);
}

/* ---- limits */

size_t rest_limits(const struct rest_system *system)
{
    return system->state->model->plan.contact_count + system->state->model->plan.friction_count;
}

/* Of friction both sides are limits, of others one; unused ones are empty: 0 >= 0. `slots` and `lambda` may
 * be those of a column. */
static void limit_values(const struct rest_system *system, const double *slots, size_t stride,
                         const double *lambda, bool loads, double *values)
{
    const struct plan *plan = &system->state->model->plan;
    struct instant at = state_instant(system->state);
    double *next = values;
    for (size_t i = 0; i < plan->contact_count; i++)
        *next++ = -slots[(size_t)plan->contacts[i].slot * stride];
    for (size_t i = 0; i < plan->friction_count; i++, next += 2) {
        const struct friction *friction = &plan->frictions[i];
        next[0] = next[1] = 0;
        if (!rest_has_limit(friction) || system->state->slip[i] != stick) continue;
        if (friction->kind == mode_rope) {
            next[0] = -lambda[system->state->model->tree->ties[friction->tie].first_row];
            continue;
        }
        double acceleration = 0, press = loads;
        friction_surface_speed(friction, &at, &acceleration);
        double hold = -slots[(size_t)friction->hold_slot * stride];
        if (loads) hold += friction->inertia * acceleration;
        if (friction->normal_slot >= 0)
            press = -system->state->pull[i] * slots[(size_t)friction->normal_slot * stride];
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
    const double *slots = system->state->slots;
    if (index < plan->contact_count)
        return (struct rest_limit){limit_normal, (int)index, -slots[plan->contacts[index].slot], 0};
    int pair = (int)(index - plan->contact_count);
    const struct friction *friction = &plan->frictions[pair];
    struct rest_limit limit = {friction->kind == mode_rope ? limit_rope : limit_friction, pair, 0, 0};
    if (!rest_has_limit(friction) || system->state->slip[pair] != stick) return limit;
    struct instant at = state_instant(system->state);
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

static bool limits_hold(const struct rest_system *system, double *values)
{
    size_t count = limit_value_count(system);
    limit_values(system, system->state->slots, 1, system->lambda, true, values);
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
    struct instant at = state_instant(system->state);
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
    return !arena->failed;
}

static void set_scales(struct rest_system *system)
{
    const struct coordinate *coordinates = system->state->model->scene->coordinates;
    for (size_t k = 0; k < system->n; k++) {
        system->held[k] = rest_holder(system->state, (int)k) >= 0;
        system->scale[k] = system->held[k] ? 0 : coordinates[k].angle ? 1 / system->length : 1;
    }
}

/* Guides that press on either side: on the one where they do. True when that changes anything that slips. */
static bool choose_sides(struct rest_system *system)
{
    const struct plan *plan = &system->state->model->plan;
    bool changed = false;
    for (size_t pair = 0; pair < plan->friction_count; pair++) {
        const struct friction *friction = &plan->frictions[pair];
        if (!friction->two_sided || friction->normal_slot < 0) continue;
        int side = system->state->slots[friction->normal_slot] > 0 ? -1 : 1;
        changed |= side != system->state->pull[pair] && system->state->slip[pair] != stick;
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
    memset(system->lambda, 0,
           sizeof *system->lambda * (m > 0 ? (size_t)system->state->model->tree->row_count : 0));
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
                                   .arena = arena,
                                   .n = (size_t)plan->n,
                                   .slots = (size_t)plan->slots};
    if (!allocate(system)) return false;
    rest_forces(state, system->lambda, true, system->slots0, system->Q);
    if (!find_sizes(system)) return false;
    set_scales(system);
    for (int pass = 0; pass < most_passes; pass++) {
        if (!balance(system)) return false;
        if (!choose_sides(system)) break;
    }
    return keep_limits(system);
}

void rest_free(struct rest_system *system)
{
    svd_free(&system->svd);
}
