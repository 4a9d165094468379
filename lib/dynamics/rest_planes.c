/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Limits of the friction of bodies that stick to a plane at several points, or at one point that shares forces with others.
 *
 * The forces and moments that the points of a body can bear together are a convex set (numeric/limit_surface.h), and the margin
 * of a redundant load (rest_system.h) a linear programme: so the set is replaced by half-spaces, for velocities u_i at which
 * the present forces are nearest to its border, until no other one is nearer (J. E. Kelley, J. SIAM 8, 1960, 703). The forces
 * of a single body need one half-space. At a zero margin the points begin to slip with the velocities of the half-spaces, in
 * proportion to their multipliers.
 */
#include <string.h>

#include "dynamics/friction.h"
#include "dynamics/plane_friction.h"
#include "dynamics/rest_system.h"
#include "numeric/limit_surface.h"
#include "numeric/tolerances.h"

static const struct coupling *coupling_at(const struct rest_system *system, int index)
{
    return &system->state->model->tree->couplings[index];
}

/* ---- the value of a limit */

/* c = mu N, and its rate of change along `flow`, or NULL. */
static double limit_of(const struct rest_system *system, int index, const struct direction *flow,
                       double *rate)
{
    const struct fbd_model *model = system->state->model;
    const int pair = coupling_at(system, index)->pair;
    const struct friction_coefficients mu = friction_coefficients_at(model, pair, &system->at, flow);
    *rate = mu.slipping > mu.resting ? mu.d_slipping : mu.d_resting;
    return fmax(0, fmax(mu.resting, mu.slipping));
}

static struct vec force_at(const struct rest_system *system, int index, const double *lambda)
{
    const int row = coupling_at(system, index)->first_row;
    const struct row *rows = system->at.tree->rows;
    if (lambda) return (struct vec){lambda[row], lambda[row + 1]};
    return (struct vec){rows[row].lambda, rows[row + 1].lambda};
}

double rest_cut_value(const struct rest_system *system, const struct rest_cut *cut, const double *lambda,
                      bool loads)
{
    double value = 0, rate;
    for (int i = 0; i < cut->count; i++) {
        value -= vec_dot(force_at(system, cut->coupling[i], lambda), cut->u[i]);
        if (loads) value += limit_of(system, cut->coupling[i], NULL, &rate) * vec_norm(cut->u[i]);
    }
    return value;
}

/* The velocities turn with the body, their arms. */
double rest_cut_along(const struct rest_system *system, const struct rest_cut *cut,
                      const double *lambda_along, const struct direction *flow)
{
    double rate = 0, d_limit;
    for (int i = 0; i < cut->count; i++) {
        const struct coupling *coupling = coupling_at(system, cut->coupling[i]);
        const struct vec u = cut->u[i], f = force_at(system, cut->coupling[i], NULL);
        const double omega = system->at.tree->links[coupling->end[0].link].omega * flow->dt;
        rate -=
            vec_dot(force_at(system, cut->coupling[i], lambda_along), u) + omega * vec_dot(f, vec_perp(u));
        limit_of(system, cut->coupling[i], flow, &d_limit);
        rate += d_limit * vec_norm(u);
    }
    return rate;
}

void rest_cut_gives(const struct rest_system *system, const struct rest_cut *cut, double multiplier,
                    int *gives, struct vec *aims)
{
    for (int i = 0; i < cut->count; i++) {
        const int pair = coupling_at(system, cut->coupling[i])->pair;
        if (vec_norm(cut->u[i]) <= nine_digits) continue;
        gives[pair] = slip_plus;
        aims[pair] = vec_sub(aims[pair], vec_scale(multiplier, cut->u[i]));
    }
}

void rest_cut_mark(const struct rest_system *system, const struct rest_cut *cut, bool *of)
{
    for (int i = 0; i < cut->count; i++) of[coupling_at(system, cut->coupling[i])->pair] = true;
}

/* ---- more limits */

static struct rest_bound *new_bound(struct rest_system *system, int count)
{
    if (system->bound_count == system->bound_room) {
        const size_t room = 2 * system->bound_room + 8;
        struct rest_bound *bounds = ARENA_ARRAY(system->arena, room, struct rest_bound);
        if (!bounds) return NULL;
        memcpy(bounds, system->bounds, system->bound_count * sizeof *bounds);
        system->bounds = bounds;
        system->bound_room = room;
    }
    struct rest_bound *bound = &system->bounds[system->bound_count];
    *bound = (struct rest_bound){.kind = bound_plane, .pair = -1, .unit = 1};
    bound->cut.coupling = ARENA_ARRAY(system->arena, (size_t)count, int);
    bound->cut.u = ARENA_ARRAY(system->arena, (size_t)count, struct vec);
    if (!bound->cut.coupling || !bound->cut.u) return NULL;
    system->bound_count++;
    return bound;
}

static bool sticks(const struct rest_system *system, int index)
{
    const struct coupling *coupling = coupling_at(system, index);
    return coupling->kind == constraint_plane && system->at.slip[coupling->pair] == stick &&
           !coupling_is_gone(system->at.tree, coupling);
}

double rest_plane_limit(const struct rest_system *system)
{
    double most = 0, rate;
    for (int i = 0; i < system->state->model->tree->coupling_count; i++)
        if (sticks(system, i)) most = fmax(most, limit_of(system, i, NULL, &rate));
    return most;
}

/* The points at which the body of point `first` sticks to the same plane; 0 if it is not the first of them. */
static int find_group(const struct rest_system *system, int first, int *group)
{
    int count = 0;
    for (int i = 0; i < system->state->model->tree->coupling_count; i++) {
        if (!sticks(system, i) || !planes_are_one(system->state->model->tree, i, first)) continue;
        if (i < first) return 0;
        group[count++] = i;
    }
    return count;
}

/* Does equilibrium not determine the forces of the group? */
static bool is_open(const struct rest_system *system, const int *group, int count)
{
    double most = 0;
    for (size_t j = 0; j < system->m; j++)
        for (int i = 0; i < count; i++) {
            const int row = system->rows[j] - coupling_at(system, group[i])->first_row;
            for (size_t k = 0; (row == 0 || row == 1) && k < system->basis_count; k++)
                most = fmax(most, fabs(system->basis[j * system->basis_count + k]));
        }
    return most > nine_digits;
}

/* Of the point in the world, from the origin of the body. */
static struct vec arm_of(const struct rest_system *system, const struct coupling *coupling)
{
    const struct tree_state *link = &system->at.tree->links[coupling->end[0].link];
    return vec_turn(link->turn, coupling->end[0].point);
}

/* The sum of the forces at the points of a limit, and their moment about r = 0; as force_at. */
struct load_on_points {
    struct vec F;
    double M;
};

static struct load_on_points load_of(const struct rest_system *system, const struct rest_cut *cut,
                                     const struct limit_point *points, const double *lambda)
{
    struct load_on_points load = {{0, 0}, 0};
    for (int i = 0; i < cut->count; i++) {
        const struct vec f = vec_turn(system->at.tree->couplings[cut->coupling[i]].e,
                                      force_at(system, cut->coupling[i], lambda));
        load.F = vec_add(load.F, f);
        if (cut->count > 1) load.M += vec_cross(points[i].r, f);
    }
    return load;
}

/* Is the load round-off of the limits? Then its direction is that of its rate of change. */
static bool is_none(const struct load_on_points *load, const struct limit_point *points, int count)
{
    double limit = 0, moment = 0;
    for (int i = 0; i < count; i++) {
        limit += points[i].c;
        moment += points[i].c * vec_norm(points[i].r);
    }
    return vec_norm(load->F) <= round_off(64, limit) && fabs(load->M) <= round_off(64, moment);
}

/* Set the velocities of a limit to those by which it is the nearest to the present forces. */
static bool aim(const struct rest_system *system, struct rest_cut *cut, const double *lambda_along)
{
    struct limit_point *points = ARENA_ARRAY(system->arena, (size_t)cut->count, struct limit_point);
    struct vec center = {0, 0};
    double rate;
    if (!points) return false;
    for (int i = 0; i < cut->count; i++)
        center = vec_add(center,
                         vec_scale(1. / cut->count, arm_of(system, coupling_at(system, cut->coupling[i]))));
    for (int i = 0; i < cut->count; i++) {
        points[i].r = vec_sub(arm_of(system, coupling_at(system, cut->coupling[i])), center);
        points[i].c = limit_of(system, cut->coupling[i], NULL, &rate);
    }
    struct load_on_points load = load_of(system, cut, points, NULL);
    if (lambda_along && is_none(&load, points, cut->count)) load = load_of(system, cut, points, lambda_along);
    limit_surface_normal(points, (size_t)cut->count, load.F, load.M);
    for (int i = 0; i < cut->count; i++) {
        const struct vec e = system->at.tree->couplings[cut->coupling[i]].e;
        cut->u[i] = (struct vec){vec_dot(e, points[i].u), vec_cross(e, points[i].u)};
    }
    return true;
}

/* Add the nearest limit of some points if it is below `level`. */
static bool add_cut(struct rest_system *system, const int *group, int count, const double *lambda_along,
                    double level)
{
    struct rest_bound *bound = new_bound(system, count);
    if (!bound) return false;
    bound->cut.count = count;
    memcpy(bound->cut.coupling, group, (size_t)count * sizeof *group);
    const bool below =
        aim(system, &bound->cut, lambda_along) && rest_cut_value(system, &bound->cut, NULL, true) < level;
    if (!below) system->bound_count--;
    return below;
}

bool rest_cut_planes(struct rest_system *system, const double *lambda_along, double level)
{
    const struct tree *tree = system->state->model->tree;
    int *group = ARENA_ARRAY(system->arena, (size_t)tree->coupling_count + 1, int);
    bool any = false;
    for (int i = 0; group && i < tree->coupling_count; i++) {
        const int count = sticks(system, i) ? find_group(system, i, group) : 0;
        if (count > 0 && is_open(system, group, count))
            any |= add_cut(system, group, count, lambda_along, level);
    }
    return any;
}

bool rest_cut_points(struct rest_system *system, double slack)
{
    bool any = false;
    for (int i = 0; i < system->state->model->tree->coupling_count; i++)
        if (sticks(system, i)) any |= add_cut(system, &i, 1, NULL, -slack);
    return any;
}
