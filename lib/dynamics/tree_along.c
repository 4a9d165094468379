/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The exact variation of the accelerations along a direction.
 *
 * The equations of motion are the balance of the wrenches of all joints at the accelerations a of the joints:
 * R(t, q, v, a) = 0. Varied: M da = -dR at fixed a. So one outward sweep varies the wrench for the bias of
 * each link, and the inward and outward sweeps that computed a compute da with the same inertias.
 */
#include "dynamics/friction.h"
#include "dynamics/plane_friction.h"
#include "dynamics/tree_system.h"

/* The variation of the accelerations of the surfaces of sticking joints. */
static void vary_held(const struct fbd_model *model, const struct instant *at, const struct direction *along)
{
    const struct tree *tree = model->tree;
    for (int k = 0; k < tree->joined_watched; k++) {
        int i = tree->watched[k], pair = tree->links[i].pair;
        if (!at->tree->links[i].locked) continue;
        double jerk = friction_surface_jerk(&model->plan.modes[pair], at);
        at->tree->variation[i].held = jerk * along->dt;
    }
}

/* Does friction lock a joint, or hold a point on a plane? */
static bool holds(const struct tree *tree, const struct instant *at)
{
    for (int k = 0; k < tree->joined_watched; k++)
        if (at->tree->links[tree->watched[k]].locked) return true;
    return tree->plane_count > 0 && planes_stick(tree, at);
}

/* The wrench of a joint has a varying arm about the parent's O. */
static void vary_arms(const struct tree *tree, struct tree_work *work)
{
    for (int i = 1; i < tree->joined; i++)
        work->x[tree->links[i].parent].p.moment += vec_cross(work->variation[i].d, work->links[i].F.force);
}

/* The forces in the joints vary, and so do their directions. */
static void vary_joint_forces(const struct fbd_model *model, const struct instant *at,
                              const struct direction *along, const double *slots, const double *slots_along)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        const double *own = slots + link->coordinate, *d = slots_along + link->coordinate;
        if (link->kind == motion_pivot) {
            work->x[i].g = d[0];
        } else if (joint_freedom(link->kind) == 1) {
            work->x[i].g = d[0] - joint_share_along(link, &work->variation[i], work->links[i].F);
        } else {
            work->x[i].gf = vec_add(vec_turn(work->links[i].e, (struct vec){d[0], d[1]}),
                                    vec_turn(work->variation[i].e, (struct vec){own[0], own[1]}));
            work->x[i].g = link->kind == motion_planar ? d[2] : 0;
        }
    }
    for (int k = 0; k < tree->joined_watched; k++) {
        const struct tree_link *link = &tree->links[tree->watched[k]];
        double d_mu;
        if (link->pair < 0 || link->kind != motion_pivot || link->journal || at->slip[link->pair] == stick)
            continue;
        formula_along(&model->plan.modes[link->pair].mu_k, at, along, &d_mu);
        work->x[tree->watched[k]].g -= at->slip[link->pair] * d_mu;
    }
}

/* dN of the slide of link i for the last right-hand side: N = n . F. */
static double normal_along(const struct tree *tree, const struct tree_work *work, int i)
{
    return tree_normal_in(tree, work, i);
}

/* The part of dN due to the direction of the surface. */
static double normal_turned(const struct tree *tree, const struct tree_work *work, int i)
{
    struct vec dn = vec_scale(tree->links[i].side, vec_perp(work->variation[i].e));
    return vec_dot(dn, work->links[i].F.force);
}

/* The variation of the friction of slide i without the response of the normal forces to it. */
static double friction_along_base(const struct fbd_model *model, const struct instant *at,
                                  const struct direction *along, int i)
{
    const struct tree *tree = model->tree;
    int pair = tree->links[i].pair;
    if (at->slip[pair] == stick) return 0;
    double d_mu, mu = formula_along(&model->plan.modes[pair].mu_k, at, along, &d_mu);
    double N = vec_dot(tree_normal(tree, at->tree, i), at->tree->links[i].F.force);
    double dN = normal_along(tree, at->tree, i) + normal_turned(tree, at->tree, i);
    return -at->slip[pair] * at->pull[pair] * (mu * dN + d_mu * N);
}

/* Add the solution to the slots behind the n. `first`: also the parts that are independent of solutions. */
static void add_slots(const struct fbd_model *model, const struct instant *at, bool first,
                      double *slots_along)
{
    const struct tree *tree = model->tree;
    const struct tree_work *work = at->tree;
    for (int k = 0; k < tree->joined_watched; k++) {
        int i = tree->watched[k];
        const struct tree_link *link = &tree->links[i];
        const struct tree_state *s = &work->links[i];
        if (link->normal_slot >= 0)
            slots_along[link->normal_slot] -=
                normal_along(tree, work, i) + (first ? normal_turned(tree, work, i) : 0);
        if (link->pair < 0) continue;
        struct wrench dF = inertia_wrench(&s->I, work->x[i].A, work->x[i].p);
        double d = joint_share(link, s, dF);
        if (first) d += joint_share_along(link, &work->variation[i], s->F);
        slots_along[model->plan.modes[link->pair].hold_slot] +=
            (first ? slots_along[link->coordinate] : 0) - d;
    }
}

/* Add the solution to the variations of the forces of joints, by accelerations in the world. */
static void add_joint_forces(const struct tree *tree, struct tree_work *work, bool first)
{
    for (int i = 1; i < tree->joined; i++) {
        const struct wrench dF = inertia_wrench(&work->links[i].I, work->x[i].A, work->x[i].p);
        struct vec *F = &work->variation[i].F;
        *F = first ? dF.force : vec_add(*F, dF.force);
    }
}

/* The variation of the size of a force with the components lambda of two rows. */
static double size_along(const struct row *rows, const double *z)
{
    const double size = hypot(rows[0].lambda, rows[1].lambda);
    return size > 0 ? (rows[0].lambda * z[0] + rows[1].lambda * z[1]) / size : hypot(z[0], z[1]);
}

/* Those of couplings. */
static void set_coupling_slots(const struct tree *tree, const struct plan *plan, const struct row *rows,
                               const double *z, double *slots_along)
{
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->strands > 0) {
            double both = coupling->row_count > 1 ? z[coupling->first_row + 1] : 0,
                   half = z[coupling->first_row] / 2;
            slots_along[coupling->slack_slot[0]] = both + half;
            slots_along[coupling->slack_slot[1]] = both - half;
        }
        if (coupling_has_normal(coupling)) slots_along[coupling->normal_slot] = -z[coupling->first_row];
        if (coupling->kind == constraint_plane)
            slots_along[plan->modes[coupling->pair].hold_slot] =
                -size_along(&rows[coupling->first_row], &z[coupling->first_row]);
        else if (coupling_rubs(coupling))
            slots_along[plan->modes[coupling->pair].hold_slot] = -z[coupling->along_row];
    }
}

static void vary_joined(const struct fbd_model *model, const struct instant *at,
                        const struct direction *along, const double *slots, const double *a,
                        double *slots_along, double *a_along)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    vary_held(model, at, along);
    tree_move_along(model, at, along);
    tree_bias_along(tree, at, along, model->plan.n, a);
    tree_load_along(tree, at, along, &tree->joined_loads);
    if (tree->bulk_count > 0) tree_bulk_along(tree, at, along);
    vary_arms(tree, work);
    vary_joint_forces(model, at, along, slots, slots_along);
    if (tree->coupling_count > 0) {
        constraints_evaluate(model, at, along);
        tree_apply_variations(model, at, along);
    }
    tree_inward(tree, work, 1, tree->joined);
    tree_outward(tree, work, 1, tree->joined, a_along);
    if (tree->joined_watched > 0) add_slots(model, at, true, slots_along);
    if (tree->reacts) add_joint_forces(tree, work, true);
}

/* By constraints and by friction that depends on forces in the joints. */
static void vary_answers(const struct fbd_model *model, const struct instant *at,
                         const struct direction *along, double *slots_along, double *a_along)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int j = 0; j < tree->row_count; j++) work->z[j] = -(work->rows[j].g.d2 + tree_row_answer(work, j));
    for (int k = 0; k < tree->pair_count; k++)
        work->z[tree->row_count + k] = friction_along_base(model, at, along, tree->pairs[k]);
    tree_want_massless(tree, work, a_along, work->z);
    tree_system_solve(model, at, work->z);
    tree_add_unit(tree, work, a_along);
    if (holds(tree, at)) tree_rest(model, at, true, a_along);
    add_slots(model, at, false, slots_along);
    if (tree->reacts) add_joint_forces(tree, work, false);
    if (tree->plane_count > 0) planes_take_variations(model, at, along);
    set_coupling_slots(tree, &model->plan, work->rows, work->z, slots_along);
}

void tree_accelerations_along(const struct fbd_model *model, const struct instant *at,
                              const struct direction *along, const double *slots, const double *a,
                              double *slots_along, double *a_along)
{
    const struct tree *tree = model->tree;
    tree_complete(model, at->tree);
    for (int i = tree->joined; i < tree->count; i++)
        tree_vary_alone(model, at, along, i, slots, slots_along, a_along);
    if (tree_joins(tree)) vary_joined(model, at, along, slots, a, slots_along, a_along);
    if (tree->coupling_count > 0 || tree_slips(tree, at) || tree_lacks_inertia(tree, at->tree))
        vary_answers(model, at, along, slots_along, a_along);
}
