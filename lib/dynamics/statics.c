/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/statics.h"

#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/friction.h"
#include "dynamics/modes.h"
#include "dynamics/tree_system.h"
#include "dynamics/world_refs.h"

/* ---- rest */

/* -1 or +1 for a surface that moves under the body, 0 if it is at rest as well. */
static enum slip slip_at_rest(const struct mode *mode, const struct instant *at)
{
    if (friction_is_never(mode)) return slip_plus;
    if (mode->coupling >= 0 || mode->kind == mode_drive) return stick;
    double acceleration, speed = friction_surface_speed(mode, at, &acceleration);
    return speed > 0 ? slip_minus : speed < 0 ? slip_plus : stick;
}

static enum slip one_sided_at_rest(const struct fbd_state *state, int pair)
{
    const struct fbd_model *model = state->model;
    struct instant at = state_instant(state);
    const int index = model->plan.modes[pair].coupling;
    const struct coupling *coupling = &model->tree->couplings[index];
    const bool contact = coupling->kind == constraint_contact;
    /* Separated shapes have a row that is zero. */
    if (contact && at.tree->couplings[index].feature == no_feature) return slip_plus;
    struct one_sided now = one_sided_at(model, &at, pair);
    /* At the origin the size of the scene is the only scale of rounding. */
    bool near = contact && fabs(now.excess) <= meeting_near(model, at.tree, coupling->meeting);
    return now.touches || now.excess > 0 || near ? stick : slip_plus;
}

static void stop(struct fbd_state *state)
{
    size_t n = (size_t)state->model->plan.n;
    memset(state->y + n, 0, n * sizeof *state->y);
    memset(state->a, 0, n * sizeof *state->a);
}

bool rest_begin(struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    stop(state);
    if (!modes_settle(state, NULL)) return false;
    stop(state); /* bodies that stick to a moving surface had its velocity */
    state_evaluate(state);
    if (state->holds.found == holds_no_memory) return false;
    memset(state->a, 0, (size_t)model->plan.n * sizeof *state->a);
    struct instant at = state_instant(state);
    for (int pair = 0; pair < (int)model->plan.mode_count; pair++) {
        const struct mode *mode = &model->plan.modes[pair];
        state->slip[pair] =
            mode_is_one_sided(mode) ? (int)one_sided_at_rest(state, pair) : (int)slip_at_rest(mode, &at);
    }
    if (!model->tree) return true;
    for (int i = 0; i < model->tree->count; i++) {
        state->tree->links[i].locked = false;
        state->tree->links[i].A = (struct acceleration){0, {0, 0}};
    }
    tree_move(model, &at);
    constraints_evaluate(model, &at, NULL);
    return true;
}

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
        tree_load(tree, at);
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
    const double *g = slots + link->coordinate;
    double *own = Q + link->coordinate;
    if (link->kind == motion_pivot) {
        own[0] = g[0] - s->F.moment;
    } else if (joint_freedom(link->kind) == 1) {
        own[0] = g[0] - joint_share(link, s, s->F);
    } else {
        own[0] = g[0] - vec_dot(s->e, s->F.force);
        own[1] = g[1] - vec_cross(s->e, s->F.force);
        if (link->kind == motion_planar) own[2] = g[2] - s->F.moment;
    }
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
    if (model->tree) {
        transmit(model, &at, lambda, loads);
        for (int i = 1; i < model->tree->count; i++)
            leave_over(&model->tree->links[i], &at.tree->links[i], slots, Q);
        tree_slots(model, &at, slots);
        if (!loads) drop_preloads(model->tree, slots);
    }
    add_slipping(model, &at, slots, loads, Q);
    if (loads) stand_still(model, &at, slots);
}
