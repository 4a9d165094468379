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

/* Set F of a link and pass it on to the link that it moves on. */
static void pass_on(const struct tree *tree, struct tree_work *work, int i)
{
    struct tree_state *s = &work->links[i];
    s->F = work->x[i].p;
    wrench_add(&work->x[tree->links[i].parent].p, s->F, s->d);
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
    for (int i = tree->count - 1; i > 0; i--) pass_on(tree, work, i);
    work->complete = true;
}

/* Set Q of the link's coordinates. */
static void leave_over(const struct tree_link *link, const struct tree_state *s, const double *slots,
                       double *Q)
{
    double share[most_coordinates_of_a_body] = {0};
    joint_shares(link_joint(link), s, s->F, share);
    for (int k = 0; k < link_joint(link)->count; k++)
        Q[link->coordinate + k] = slots[link->coordinate + k] - share[k];
}

/* Subtract the friction of a moving surface; a moving bearing has a given moment. */
static void add_slipping(const struct fbd_model *model, const struct instant *at, int pair,
                         const double *slots, bool loads, double *Q)
{
    const struct mode *mode = &model->plan.modes[pair];
    int side = slip_side(at->slip[pair]);
    if (mode->coupling >= 0 || side == 0) return;
    double press = mode->normal_slot >= 0 ? -at->pull[pair] * slots[mode->normal_slot] : loads;
    Q[mode->coordinate] -= side * formula_value(&mode->mu_k, at) * press;
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
static void drop_preload(const struct coupling *coupling, double *slots)
{
    for (int k = 0; k < coupling->strands; k++) slots[coupling->slack_slot[k]] += coupling->source->tension;
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
    for (int i = 0; !loads && i < model->tree->coupling_count; i++)
        drop_preload(&model->tree->couplings[i], slots);
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++)
        add_slipping(model, &at, pair, slots, loads, Q);
    if (loads) stand_still(model, &at, slots);
}

/* ---- the forces of a single row */

/* Flag the links from the ports of a row to the ground; returns the outermost of them. */
static int reach(const struct tree *tree, const struct row *row, bool *reached)
{
    int outer = 0;
    for (int k = 0; k < row->port_count; k++)
        for (int i = row->ports[k].link; i > 0 && !reached[i]; i = tree->links[i].parent) {
            reached[i] = true;
            if (i > outer) outer = i;
        }
    return outer;
}

/* Apply the multipliers of a coupling. */
static void push(const struct tree *tree, struct tree_work *work, int index, const double *lambda)
{
    const struct coupling *coupling = &tree->couplings[index];
    for (int j = coupling->first_row; j < coupling->first_row + coupling->row_count; j++) {
        work->rows[j].lambda = lambda[j];
        if (lambda[j] != 0) row_apply(&work->rows[j], lambda[j], work->x);
    }
}

void rest_forces_of_row(const struct fbd_model *model, const struct instant *at, int row,
                        const double *lambda, bool *reached, double *slots, double *Q)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    const int index = tree->coupling_of_row[row], resistance = tree->couplings[index].resistance;
    memset(reached, 0, (size_t)tree->count * sizeof *reached);
    int outer = reach(tree, &work->rows[row], reached);
    for (int i = outer; i > 0; i--)
        if (reached[i]) work->x[i].p = (struct wrench){0, {0, 0}};
    push(tree, work, index, lambda);
    if (resistance >= 0) push(tree, work, resistance, lambda);
    for (int i = outer; i > 0; i--)
        if (reached[i]) pass_on(tree, work, i);
    for (int i = outer; i > 0; i--) {
        if (!reached[i]) continue;
        leave_over(&tree->links[i], &work->links[i], slots, Q);
        tree_link_slots(model, at, i, slots);
        if (tree->links[i].pair >= 0) add_slipping(model, at, tree->links[i].pair, slots, false, Q);
    }
    tree_coupling_slots(model, at, index, slots);
    if (resistance >= 0) tree_coupling_slots(model, at, resistance, slots);
    drop_preload(&tree->couplings[index], slots);
}
