/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/rest_system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/disjoint_sets.h"
#include "dynamics/friction.h"
#include "dynamics/tree_system.h"
#include "dynamics/world_refs.h"
#include "numeric/least_distance.h"
#include "numeric/tolerances.h"

/* ---- scales with which zero is compared */

/* The largest arm of a force about the centre of mass of its body, then the largest load, couples divided by
 * that arm. */
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
        size_t count = diagram_fill(model, (int)b, &at, system->slots0, arrows);
        for (size_t i = 0; i < count; i++) {
            system->length = fmax(system->length, vec_norm(vec_sub(arrows[i].point, G)));
            if (arrow_is_reaction(model, &arrows[i])) continue;
            system->force = fmax(system->force, vec_norm(arrows[i].force));
            couple = fmax(couple, fabs(arrows[i].couple));
        }
    }
    if (system->length == 0) system->length = 1;
    system->force = fmax(system->force, couple / system->length);
    /* Where all loads vanish, as at the neutral position of a spring: a millionth of the weights. */
    system->force = fmax(system->force, distinct_part * heaviest * vec_norm(model->scene->gravity));
    system->force = fmax(system->force, rest_plane_limit(system));
    return arrows != NULL;
}

/* ---- the affine maps of lambda */

static void read_reaction(const struct rest_system *system, int i, const double *slots, double *r)
{
    const struct fbd_model *model = system->state->model;
    const struct tree_link *link = &model->tree->links[i];
    const struct tree_state *s = &system->state->tree->links[i];
    const double *g = slots + link->coordinate;
    double *own = r + 3 * (size_t)(i - 1);
    own[0] = s->F.force.x;
    own[1] = s->F.force.y;
    own[2] = s->F.moment / system->length;
    if (link_joint(link)->has_axis) own[2] -= g[0] / system->length;
    if (link_joint(link)->path == path_none) return;
    const struct model_body *body = &model->bodies[link->body];
    struct pose pose = body_pose(body, &system->at);
    struct vec arm = vec_sub(s->p, point_motion(body, &pose, body->inertia.G).p);
    own[0] = vec_dot(s->e, s->F.force) - g[0];
    own[1] = vec_cross(s->e, s->F.force);
    own[2] = (s->F.moment + vec_cross(arm, s->F.force)) / system->length;
}

static void read_reactions(const struct rest_system *system, const double *slots, double *r)
{
    for (int i = 1; i < system->state->model->tree->count; i++) read_reaction(system, i, slots, r);
    for (size_t j = 0; j < system->m; j++)
        r[rest_entry_of_row(system, j)] = system->state->tree->rows[system->rows[j]].lambda;
}

/* Add to the friction of coupling `index` that slips, for a normal force. */
static void add_rubbing(struct rest_system *system, int index, double normal)
{
    const struct fbd_model *model = system->state->model;
    const double share = index < 0 ? 0 : tree_rubbing_share(model, &system->at, index);
    if (share != 0) system->lambda[model->tree->couplings[index].along_row] += share * normal;
}

/* Add to row j, and to its friction if its body slips. */
static void add_to_row(struct rest_system *system, size_t j, double step)
{
    const struct tree *tree = system->state->model->tree;
    const int row = system->rows[j], index = tree->coupling_of_row[row];
    system->lambda[row] += step;
    if (row != tree->couplings[index].normal_row) return;
    add_rubbing(system, index, step);
    add_rubbing(system, tree->couplings[index].resistance, step);
}

/* The forces by a unit multiplier of row j: they reach few links. */
static void set_column(struct rest_system *system, const struct instant *at, size_t j)
{
    const struct tree *tree = system->state->model->tree;
    double *slots = system->columns + j * system->slots, *r = system->R + j * system->reactions;
    memset(slots, 0, system->slots * sizeof *slots);
    memset(r, 0, system->reactions * sizeof *r);
    add_to_row(system, j, 1);
    rest_forces_of_row(system->state->model, at, system->rows[j], system->lambda, system->reached, slots,
                       system->Q);
    add_to_row(system, j, -1);
    for (int i = 1; i < tree->count; i++) {
        if (!system->reached[i]) continue;
        read_reaction(system, i, slots, r);
        const size_t first = (size_t)tree->links[i].coordinate;
        const size_t end = first + (size_t)link_joint(&tree->links[i])->count;
        for (size_t k = first; k < end; k++) system->E[k * system->m + j] = system->scale[k] * system->Q[k];
    }
    r[rest_entry_of_row(system, j)] = 1;
}

static void set_columns(struct rest_system *system)
{
    const struct fbd_model *model = system->state->model;
    if (system->m == 0) return;
    const struct instant at = instant_extend(model, &system->at);
    memset(system->lambda, 0, (size_t)model->tree->row_count * sizeof *system->lambda);
    for (size_t j = 0; j < system->m; j++) set_column(system, &at, j);
}

static void add_to_lambda(struct rest_system *system, const double *step)
{
    for (size_t j = 0; j < system->m; j++) add_to_row(system, j, step[j]);
}

/* Add the forces before the change of lambda. */
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
    for (int i = 0; tree->plane_count > 0 && i < tree->coupling_count; i++) /* a magnitude is no sum */
        if (tree->couplings[i].kind == constraint_plane)
            tree_coupling_slots(system->state->model, &system->at, i, system->forces);
}

/* All forces at the present lambda. */
static void evaluate(struct rest_system *system)
{
    rest_forces(system->state->model, &system->at, system->lambda, !system->base.moves, system->forces,
                system->Q);
    if (system->base.moves) add_base(system);
    read_reactions(system, system->forces, system->r);
}

/* ---- within limits */

static bool limits_hold(const struct rest_system *system, double *values)
{
    size_t count = system->bound_count;
    rest_read_bounds(system, values);
    for (size_t i = 0; i < count; i++)
        if (!(values[i] >= -rest_limit_slack(system))) return false;
    return true;
}

bool rest_move(struct rest_system *system, const double *w, double size)
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

/* The scale of w: the limits may be exceeded by far more than the loads, as with the tension of a belt. */
static double size_of_way(const struct rest_system *system, const double *values)
{
    double size = system->force;
    for (size_t i = 0; i < system->bound_count; i++) size = fmax(size, fabs(values[i]));
    return size;
}

/* The least w of one part, divided by `size`, for which its limits hold within `slack`; unchanged if there is
 * none. */
static bool keep_part_limits(struct rest_system *system, const double *G, const double *values, int which,
                             double size, double slack, double *w)
{
    struct rest_part part;
    if (!rest_part(system, G, which, &part)) return false;
    double *h = ARENA_ARRAY(system->arena, part.limits + 1, double),
           *own = ARENA_ARRAY(system->arena, part.size + 1, double);
    if (!h || !own) return false;
    for (size_t i = 0; i < part.limits; i++) h[i] = -(values[part.limit[i]] + slack) / size;
    enum least_distance found = least_distance(part.limits, part.size, part.G, h, own);
    if (found == least_distance_no_memory) return false;
    for (size_t k = 0; found == least_distance_found && k < part.size; k++) w[part.column[k]] = own[k];
    return true;
}

/* Find the least reactions within the limits, from the present ones: a change w times `size`. */
static bool find_within(struct rest_system *system, double *w, double *size)
{
    struct arena *arena = system->arena;
    size_t count = system->bound_count, d = system->basis_count;
    double *values = ARENA_ARRAY(arena, count + 1, double), *after = ARENA_ARRAY(arena, count + 1, double);
    double *G = ARENA_ARRAY(arena, count * d + 1, double);
    if (!values || !after || !G) return false;
    memset(w, 0, d * sizeof *w);
    *size = 0;
    system->within_limits = limits_hold(system, values);
    if (system->within_limits || d == 0) return true;
    if (!rest_bound_slopes(system, G)) return false;
    *size = size_of_way(system, values);
    for (int pass = 0; pass < 2 && !system->within_limits; pass++) {
        double slack = pass == 0 ? 0 : rest_limit_slack(system) / 2;
        memset(w, 0, d * sizeof *w);
        for (int which = 0; which < system->parts; which++)
            if (!keep_part_limits(system, G, values, which, *size, slack, w)) return false;
        if (!rest_move(system, w, *size)) return false;
        system->within_limits = limits_hold(system, after);
        if (!system->within_limits && !rest_move(system, w, -*size)) return false;
    }
    return true;
}

/* Keep the least reactions if they are within the limits, else find the least ones that are, first exactly,
 * then, if the feasible set is nearly empty, within half of the tolerance; with limits of points on planes as needed. */
static bool keep_limits(struct rest_system *system)
{
    enum { most_cuts = 60 };
    double *w = ARENA_ARRAY(system->arena, system->basis_count + 1, double), size;
    const bool planes = system->state->model->tree->plane_count > 0;
    if (!w) return false;
    for (int cut = 0;; cut++) {
        if (!find_within(system, w, &size)) return false;
        if (!planes || !system->within_limits || cut == most_cuts ||
            !rest_cut_points(system, rest_limit_slack(system)))
            return !system->arena->failed;
        if (!rest_move(system, w, -size)) return false;
    }
}

/* ---- solution */

/* Relative tolerance for dependent columns of E. */
static const double dependent = solved_rounding;

/* The set of the bodies of row j; 0 if it acts on none that moves. */
static int set_of_row(const struct rest_system *system, int j)
{
    const struct row *row = &system->at.tree->rows[j];
    const struct tree_link *links = system->state->model->tree->links;
    for (int i = 0; i < row->port_count; i++)
        if (row->ports[i].link != 0) return sets_first(system->set, links[row->ports[i].link].root);
    return 0;
}

static void join_ports(struct rest_system *system, const struct row *row)
{
    const struct tree_link *links = system->state->model->tree->links;
    int first = 0;
    for (int i = 0; i < row->port_count; i++) {
        int link = row->ports[i].link;
        if (link == 0) continue;
        if (first > 0) sets_join(system->set, first, links[link].root);
        first = links[link].root;
    }
}

/* Which of the sets of bodies that active rows connect has rows that may be dependent? By the root of each
 * set; no row of another set shares forces with them. */
static const int *weak_sets(struct rest_system *system)
{
    const struct tree *tree = system->state->model->tree;
    int *weak = ARENA_ARRAY(system->arena, (size_t)tree->count, int);
    system->set = ARENA_ARRAY(system->arena, (size_t)tree->count, int);
    if (!weak || !system->set) return NULL;
    for (int i = 0; i < tree->count; i++) system->set[i] = i;
    for (int j = 0; j < tree->row_count; j++)
        if (tree_takes_part(tree, &system->at, j)) join_ports(system, &system->at.tree->rows[j]);
    for (int j = 0; j < tree->row_count; j++)
        if (tree_takes_part(tree, &system->at, j) && system->at.tree->rows[j].weak)
            weak[set_of_row(system, j)] = 1;
    return weak;
}

/* With the active rows, or `among_weak` with those alone that may share their forces with dependent ones. */
static bool allocate(struct rest_system *system, bool among_weak)
{
    const struct fbd_model *model = system->state->model;
    const struct tree *tree = model->tree;
    struct arena *arena = system->arena;
    size_t rows = (size_t)tree->row_count;
    const struct instant at = system->at;
    system->rows = ARENA_ARRAY(arena, rows + 1, int);
    const int *weak = among_weak ? weak_sets(system) : NULL;
    for (int j = 0; system->rows && j < (int)rows; j++)
        if (tree_takes_part(tree, &at, j) && (!weak || weak[set_of_row(system, j)]))
            system->rows[system->m++] = j;
    size_t n = system->n, m = system->m;
    system->reactions = m + 3 * (size_t)(tree->count - 1);
    system->held = ARENA_ARRAY(arena, n + 1, bool);
    system->scale = ARENA_ARRAY(arena, n + 1, double);
    system->reached = ARENA_ARRAY(arena, (size_t)tree->count + 1, bool);
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
    const struct plan *plan = &system->state->model->plan;
    memset(system->held, false, system->n * sizeof *system->held);
    for (size_t pair = 0; pair < plan->mode_count; pair++)
        if (plan->modes[pair].coupling < 0 && system->at.slip[pair] == stick)
            system->held[plan->modes[pair].coordinate] = true;
    for (size_t k = 0; k < system->n; k++)
        system->scale[k] = system->held[k] ? 0 : coordinates[k].angle ? 1 / system->length : 1;
}

/* Set two-sided guides to the side of their normal force. True when that changes a slipping one, or with
 * `any` any of them. Guides that slip as the scene moves are not changed. */
static bool choose_sides(struct rest_system *system, bool any)
{
    const struct plan *plan = &system->state->model->plan;
    bool changed = false;
    for (size_t pair = 0; pair < plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        bool sticks = system->at.slip[pair] == stick;
        if (!mode->two_sided || mode->normal_slot < 0 || (system->base.moves && !sticks)) continue;
        int side = system->forces[mode->normal_slot] > 0 ? -1 : 1;
        changed |= side != system->state->pull[pair] && (any || !sticks);
        system->state->pull[pair] = side;
    }
    return changed;
}

/* Solve for the lambda that balances, with the least reactions. */
static bool balance(struct rest_system *system)
{
    size_t n = system->n, m = system->m;
    double *step = ARENA_ARRAY(system->arena, m + 1, double),
           *left = ARENA_ARRAY(system->arena, n + 1, double);
    if (!step || !left) return false;
    set_columns(system);
    qr_free(&system->qr);
    if (!qr_decompose(&system->qr, n, m, system->E, dependent)) return false;
    for (int pass = 0; pass < 2; pass++) { /* the second corrects rounding of the first */
        evaluate(system);
        for (size_t k = 0; k < n; k++) left[k] = -system->scale[k] * system->Q[k];
        memset(step, 0, m * sizeof *step);
        qr_add_solution(&system->qr, left, step);
        add_to_lambda(system, step);
    }
    evaluate(system);
    memset(step, 0, m * sizeof *step);
    if (!rest_set_basis(system, step)) return false;
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
                                   .forces = state->slots,
                                   .arena = arena,
                                   .n = (size_t)plan->n,
                                   .slots = (size_t)plan->slots};
    if (!allocate(system, false)) return false;
    rest_forces(state->model, &system->at, system->lambda, true, system->slots0, system->Q);
    if (!find_sizes(system)) return false;
    if (!rest_find_bounds(system)) return false;
    set_scales(system);
    for (int pass = 0; pass < most_passes; pass++) {
        if (!balance(system)) return false;
        if (!choose_sides(system, false)) break;
    }
    return keep_limits(system);
}

void rest_free(struct rest_system *system)
{
    qr_free(&system->qr);
}

/* ---- as the scene moves */

bool rest_is_open(const struct fbd_model *model, const struct instant *at)
{
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
               const double *slots, struct arena *arena)
{
    const struct plan *plan = &state->model->plan;
    *system = (struct rest_system){
        .state = state, .at = *at, .arena = arena, .n = (size_t)plan->n, .slots = (size_t)plan->slots};
    if (!rest_is_open(state->model, at)) return false;
    if (!allocate(system, true) || !keep_base(system, slots) || !find_sizes(system)) return false;
    for (size_t j = 0; system->force == 0 && j < system->m; j++) /* for rotations without a load */
        system->force = fabs(system->base.lambda[system->rows[j]]);
    if (system->force == 0 || !rest_find_bounds(system)) return false; /* all forces are zero */
    set_scales(system);
    set_columns(system);
    double *least = ARENA_ARRAY(arena, system->m + 1, double);
    bool made = least && qr_decompose(&system->qr, system->n, system->m, system->E, dependent_row);
    evaluate(system);
    made = made && rest_set_basis(system, least);
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
    struct tree_work *work = system->at.tree;
    rest_restore(system);
    work->shared_size = 0;
    for (int i = 0; i < system->state->model->tree->count; i++)
        work->shared_size = fmax(work->shared_size, vec_norm(work->links[i].F.force));
    for (size_t j = 0; j < system->m; j++)
        work->shared_size = fmax(work->shared_size, fabs(work->rows[system->rows[j]].lambda));
    add_to_lambda(system, system->least);
    evaluate(system);
    if (!keep_limits(system)) system->arena->failed = true;
    memcpy(slots, system->forces, system->slots * sizeof *slots);
}
