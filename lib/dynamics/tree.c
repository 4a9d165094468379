/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The recursion as a whole, and the friction that goes with the forces in the joints.
 */
#include "dynamics/tree.h"

#include <string.h>

#include "dynamics/friction.h"

/* ---- memory */

size_t tree_work_size(const struct fbd_model *model)
{
    size_t links = (size_t)model->tree->count, pairs = (size_t)model->tree->pair_count;
    size_t link = sizeof(struct tree_state) + sizeof(struct tree_rhs) + sizeof(struct tree_variation);
    return links * link + (pairs * (pairs + 1) + 3 * (size_t)model->plan.n) * sizeof(double);
}

void tree_work_init(struct tree_work *work, const struct fbd_model *model, void *memory)
{
    size_t links = (size_t)model->tree->count, pairs = (size_t)model->tree->pair_count;
    work->links = memory;
    work->x = (struct tree_rhs *)(work->links + links);
    work->variation = (struct tree_variation *)(work->x + links);
    work->closure = (double *)(work->variation + links);
    work->unit = work->closure + pairs * (pairs + 1);
    work->a = work->unit + model->plan.n;
    work->a_along = work->a + model->plan.n;
    work->links[0].turn = work->links[0].e = (struct vec){1, 0};
}

/* ---- results */

/* The accelerations of the links and what the joints pass to them, added to those that are there. */
static void add_result(const struct tree *tree, struct tree_work *work)
{
    for (int i = 1; i < tree->count; i++) {
        struct tree_state *s = &work->links[i];
        const struct tree_rhs *x = &work->x[i];
        struct wrench F = inertia_wrench(&s->I, x->A, x->p);
        s->A.alpha += x->A.alpha;
        s->A.a = vec_add(s->A.a, x->A.a);
        s->F.moment += F.moment;
        s->F.force = vec_add(s->F.force, F.force);
    }
}

void tree_complete(const struct fbd_model *model, struct tree_work *work)
{
    if (work->complete) return;
    for (int i = 0; i < model->tree->count; i++) work->links[i].F = (struct wrench){0, {0, 0}};
    add_result(model->tree, work);
    work->complete = true;
}

void tree_slots(const struct fbd_model *model, const struct instant *at, double *slots)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int k = 0; k < tree->watched_count; k++) {
        int i = tree->watched[k];
        const struct tree_link *link = &tree->links[i];
        const struct tree_state *s = &work->links[i];
        if (link->normal_slot >= 0)
            slots[link->normal_slot] = -vec_dot(tree_normal(tree, work, i), s->F.force);
        if (link->pair < 0) continue;
        double F = link->kind == motion_pivot ? s->F.moment : vec_dot(s->e, s->F.force);
        slots[model->plan.frictions[link->pair].hold_slot] = slots[link->coordinate] - F;
    }
}

/* ---- modes */

/* Which joints stick, and how their surfaces accelerate. */
static void lock(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    for (int k = 0; k < tree->watched_count; k++) {
        const struct tree_link *link = &tree->links[tree->watched[k]];
        struct tree_state *s = &at->tree->links[tree->watched[k]];
        s->locked = link->pair >= 0 && at->slip[link->pair] == stick;
        if (s->locked) friction_surface_speed(&model->plan.frictions[link->pair], at, &s->held);
    }
}

/* The generalized forces in the joints; dry friction in bearings has a moment of its own. */
static void set_joint_forces(const struct fbd_model *model, const struct instant *at, const double *slots)
{
    const struct tree *tree = model->tree;
    const struct tree_state *links = at->tree->links;
    struct tree_rhs *x = at->tree->x;
    for (int i = 1; i < tree->count; i++) {
        const struct tree_link *link = &tree->links[i];
        const double *own = slots + link->coordinate;
        if (link->kind == motion_pivot || link->kind == motion_slide) {
            x[i].g = own[0];
        } else {
            x[i].gf = vec_turn(links[i].e, (struct vec){own[0], own[1]});
            x[i].g = link->kind == motion_planar ? own[2] : 0;
        }
    }
    for (int k = 0; k < tree->watched_count; k++) {
        const struct tree_link *link = &tree->links[tree->watched[k]];
        if (link->pair < 0 || link->kind != motion_pivot || at->slip[link->pair] == stick) continue;
        x[tree->watched[k]].g -=
            at->slip[link->pair] * formula_value(&model->plan.frictions[link->pair].mu_k, at);
    }
}

void tree_accelerations(const struct fbd_model *model, const struct instant *at, double *slots, double *a)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    if (tree->watched_count > 0) lock(model, at);
    tree_move(model, at);
    tree_bias(tree, at, model->plan.n);
    tree_load(tree, at);
    set_joint_forces(model, at, slots);
    tree_factor(tree, work);
    tree_outward(tree, work, a);
    work->complete = false;
    if (tree->watched_count == 0) return;
    int m = tree->pair_count;
    for (int k = 0; k < m; k++)
        work->closure[k * (m + 1) + m] =
            -tree_slip_share(model, at, tree->pairs[k]) * tree_normal_in(tree, work, tree->pairs[k]);
    tree_complete(model, work);
    if (tree_slips(tree, at)) {
        tree_add_frictions(model, at, a);
        add_result(tree, work);
    }
    for (int k = 0; k < tree->watched_count; k++) {
        const struct tree_state *s = &work->links[tree->watched[k]];
        if (s->locked) a[tree->links[tree->watched[k]].coordinate] = s->held;
    }
    tree_slots(model, at, slots);
}
