/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/statics.h"

#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/friction.h"
#include "dynamics/journals.h"
#include "dynamics/tree_system.h"
#include "dynamics/world_refs.h"

int rest_holder(const struct fbd_model *model, const struct instant *at, int coordinate)
{
    const struct plan *plan = &model->plan;
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        bool holds = mode->coupling < 0 && mode->coordinate == coordinate;
        if (holds && at->slip[pair] == stick) return pair;
    }
    return -1;
}

/* ---- wrenches of the joints */

static void add_ports(struct tree_work *work, int row_count, const double *lambda)
{
    for (int j = 0; j < row_count; j++) {
        struct row *row = &work->rows[j];
        row->lambda = lambda[j];
        if (lambda[j] != 0) row_apply(row, lambda[j], work->x);
    }
}

static void transmit(const struct fbd_model *model, const struct instant *at, const double *lambda,
                     bool loads)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    for (int i = 0; i < tree->count; i++) work->x[i].p = (struct wrench){0, {0, 0}};
    if (loads) {
        tree_bias(tree, at, model->plan.n); /* at rest these are the constant forces only */
        for (int i = tree->joined; i < tree->count; i++)
            work->x[i].p = tree_alone_weight(&tree->links[i], &work->links[i]);
        tree_load(tree, at, &tree->loads);
        if (tree->bulk_count > 0) tree_weights(tree, at);
    }
    add_ports(work, tree->row_count, lambda);
    for (int i = tree->count - 1; i > 0; i--) {
        struct tree_state *s = &work->links[i];
        s->F = work->x[i].p;
        wrench_add(&work->x[tree->links[i].parent].p, s->F, s->d);
    }
    work->complete = true;
}

/* Set Q of the link's coordinates. */
static void leave_over(const struct tree_link *link, const struct tree_state *s, const double *slots,
                       double *Q)
{
    double share[most_coordinates_of_a_body];
    joint_shares(link_joint(link), s, s->F, share);
    for (int k = 0; k < link_joint(link)->count; k++)
        Q[link->coordinate + k] = slots[link->coordinate + k] - share[k];
}

/* Subtract the friction of moving surfaces; a moving bearing has a given moment. */
static void add_slipping(const struct fbd_model *model, const struct instant *at, const double *slots,
                         bool loads, double *Q)
{
    const struct plan *plan = &model->plan;
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        int side = slip_side(at->slip[pair]);
        if (mode->coupling >= 0 || side == 0) continue;
        double press = mode->normal_slot >= 0 ? -at->pull[pair] * slots[mode->normal_slot] : loads;
        Q[mode->coordinate] -= side * formula_value(&mode->mu_k, at) * press;
    }
}

/* Bodies without joints to others: friction_at expects the friction force on a surface whose velocity
 * changes. */
static void stand_still(const struct fbd_model *model, const struct instant *at, double *slots)
{
    const struct plan *plan = &model->plan;
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        double acceleration;
        if (mode->kind != mode_single || at->slip[pair] != stick) continue;
        friction_surface_speed(mode, at, &acceleration);
        slots[mode->hold_slot] += mode->inertia * acceleration;
    }
}

/* The preload of a belt belongs to the loads. */
static void drop_preloads(const struct tree *tree, double *slots)
{
    for (int i = 0; i < tree->coupling_count; i++)
        for (int k = 0; k < tree->couplings[i].strands; k++)
            slots[tree->couplings[i].slack_slot[k]] += tree->couplings[i].source->tension;
}

void rest_forces(const struct fbd_model *model, const struct instant *given, const double *lambda, bool loads,
                 double *slots, double *Q)
{
    const struct instant at = instant_extend(model, given);
    memset(slots, 0, (size_t)model->plan.slots * sizeof *slots);
    if (loads) force_slots(model, &at, slots);
    memcpy(Q, slots, (size_t)model->plan.n * sizeof *Q);
    transmit(model, &at, lambda, loads);
    for (int i = 1; i < model->tree->count; i++)
        leave_over(&model->tree->links[i], &at.tree->links[i], slots, Q);
    if (loads && model->tree->journal_count > 0)
        journals_aim(model->tree, at.tree); /* they keep it in columns */
    tree_slots(model, &at, slots);
    for (int i = model->tree->joined; i < model->tree->count; i++) tree_alone_slots(model, &at, i, slots);
    if (!loads) drop_preloads(model->tree, slots);
    add_slipping(model, &at, slots, loads, Q);
    if (loads) stand_still(model, &at, slots);
}
