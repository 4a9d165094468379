/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/modes.h"

#include <float.h>
#include <string.h>

#include "dynamics/absolute.h"
#include "dynamics/constraint.h"

double slip_velocity(const struct fbd_model *model, int pair, const struct instant *at)
{
    const struct friction *friction = &model->plan.frictions[pair];
    if (friction->tie >= 0) return tie_slip_velocity(model, at, friction->tie);
    double v = at->y[model->plan.n + friction->coordinate], acceleration;
    double s = friction_surface_speed(friction, at, &acceleration);
    return fabs(v - s) <= 4 * DBL_EPSILON * fabs(s) ? 0 : v - s;
}

void modes_drive(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    struct instant at = state_instant(state);
    double acceleration;
    for (int pair = 0; pair < (int)plan->friction_count; pair++) {
        const struct friction *friction = &plan->frictions[pair];
        if (!friction->driven) continue;
        state->y[friction->coordinate] = formula_value(&friction->position, &at);
        state->y[plan->n + friction->coordinate] = friction_surface_speed(friction, &at, &acceleration);
    }
}

void modes_hold(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    struct instant at = state_instant(state);
    double acceleration;
    for (int pair = 0; pair < (int)plan->friction_count; pair++) {
        const struct friction *friction = &plan->frictions[pair];
        if (friction->driven) state->y[friction->coordinate] = formula_value(&friction->position, &at);
        if (state->slip[pair] == stick && friction->tie < 0)
            state->y[plan->n + friction->coordinate] = friction_surface_speed(friction, &at, &acceleration);
    }
}

/* The direction in which the state goes on: (1, v, a). Stored in the last 2 n entries of the scratch. */
static struct direction flow_of(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    size_t n = (size_t)plan->n;
    double *dy = state->scratch + 2 * (size_t)plan->slots;
    memcpy(dy, state->y + n, n * sizeof *dy);
    memcpy(dy + n, state->a, n * sizeof *dy);
    struct direction flow = {1, dy};
    if (!state->extended) return flow;
    struct instant at = state_instant(state), extended = instant_extend(state->model, &at);
    return direction_extend(state->model, &extended, &flow);
}

static bool settle_branches(struct fbd_state *state, const struct decided *decided,
                            const struct direction *flow)
{
    const struct plan *plan = &state->model->plan;
    size_t size = (size_t)plan->branches * sizeof *state->branch;
    memcpy(state->branch_before, state->branch, size);
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct kink *kink = &plan->kinks[i];
        int first = kink->formula.branch;
        const bool *keep = decided ? decided->branches + first : NULL;
        expr_resolve(kink->formula.expr, state->t, state->y, flow->dt, flow->dy, keep, state->branch + first);
    }
    return memcmp(state->branch_before, state->branch, size) == 0;
}

static bool settle_slips(struct fbd_state *state, const struct decided *decided, const struct direction *flow)
{
    const struct fbd_model *model = state->model;
    const struct plan *plan = &model->plan;
    double *slots = state->scratch, *slots_along = slots + plan->slots;
    struct instant at = state_instant(state);
    bool same = true;
    force_balance(model, &at, slots);
    force_balance_along(model, &at, flow, slots, slots_along);
    for (int pair = 0; pair < (int)plan->friction_count; pair++) {
        if (plan->frictions[pair].two_sided && !(decided && decided->pulls[pair]))
            state->pull[pair] = slots[plan->frictions[pair].normal_slot] > 0 ? -1 : 1;
        if (plan->frictions[pair].driven || (decided && decided->slips[pair])) continue;
        if (plan->frictions[pair].surface) continue; /* closed by impacts; with the others that rest */
        if (plan->frictions[pair].rope) {
            struct rope_state rope = rope_at(model, &at, plan->frictions[pair].tie);
            if (rope.touches) continue; /* with the others that rest */
            enum slip next = rope.rate > 0 && rope.excess > -rope.near ? stick : slip_plus;
            if (state->slip[pair] == stick &&
                fabs(rope.excess) <= 1e-6 * state->tree->ties[plan->frictions[pair].tie].zero)
                next = stick; /* taut until its tension ends */
            same = same && state->slip[pair] == (int)next;
            state->slip[pair] = next;
            continue;
        }
        double v = slip_velocity(model, pair, &at);
        enum slip next = v > 0 ? slip_plus : slip_minus;
        if (v == 0 && plan->frictions[pair].jointed) continue; /* all of them together */
        if (v == 0) {
            struct friction_values now = friction_at(model, pair, &at, slots);
            struct friction_values rate = friction_along(model, pair, &at, slots, flow, slots_along);
            next = friction_decide(&now, &rate);
        }
        same = same && state->slip[pair] == (int)next;
        state->slip[pair] = next;
    }
    if (model->tree && plan->friction_count > 0) same = tree_settle_slips(state, decided) && same;
    return same;
}

bool modes_settle(struct fbd_state *state, const struct decided *decided)
{
    enum { most_passes = 12 };
    const struct plan *plan = &state->model->plan;
    bool first = true;
    state->settled = true;
    for (int pass = 0; pass < most_passes; pass++) {
        state_evaluate(state);
        if (plan->kink_count + plan->friction_count == 0) return true;
        struct direction flow = flow_of(state);
        bool same = settle_branches(state, decided, &flow);
        if (plan->friction_count > 0) same = settle_slips(state, decided, &flow) && same;
        if (same && !first) {
            modes_hold(state);
            state_evaluate(state);
            return true;
        }
        first = false;
    }
    return false;
}
