/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Stick or slip of several pairs whose forces depend on each other.
 *
 * At rest on its surface a pair sticks with |H| <= mu_s N, or slips with a relative acceleration along its
 * slip: a complementarity problem. All that may stick stick at first; the one that is farthest beyond its
 * limit gives way, and the forces are found anew; one that slips and would turn back at once sticks again.
 * With one pair this is the textbook's comparison; with the coefficients of friction that occur it ends after
 * about as many rounds as there are pairs.
 */
#include <float.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/modes.h"

static bool is_open(const struct fbd_state *state, const struct decided *decided, int pair)
{
    struct instant at = state_instant(state);
    if (!state->model->plan.frictions[pair].jointed || (decided && decided->slips[pair])) return false;
    const struct friction *friction = &state->model->plan.frictions[pair];
    if (friction->driven) return false;
    if (friction->rope) return rope_at(state->model, &at, friction->tie).touches;
    if (friction->surface) return state->tree->ties[friction->tie].feature != no_feature;
    return slip_velocity(state->model, pair, &at) == 0;
}

/* Forces and their rates of change in the modes of the trial. */
static void evaluate(struct fbd_state *state, double *slots, double *slots_along)
{
    const struct fbd_model *model = state->model;
    size_t n = (size_t)model->plan.n;
    double *dy = state->scratch + 2 * (size_t)model->plan.slots;
    struct instant at = state_instant(state);
    accelerations(model, &at, slots, state->a);
    memcpy(dy, state->y + n, n * sizeof *dy);
    memcpy(dy + n, state->a, n * sizeof *dy);
    struct direction flow = {1, dy};
    force_balance(model, &at, slots);
    force_balance_along(model, &at, &flow, slots, slots_along);
}

static const struct row *surface_row(const struct fbd_state *state, int pair)
{
    return &state->tree->rows[state->model->tree->ties[state->model->plan.frictions[pair].tie].first_row];
}

static double largest_acceleration(const struct fbd_state *state)
{
    double most = 0;
    for (int i = 1; i < state->model->tree->count; i++) {
        const struct tree_state *s = &state->tree->links[i];
        most = fmax(most, vec_norm(s->A.a));
        most = fmax(most, vec_norm(state->model->tree->links[i].force) / state->model->tree->links[i].mass);
    }
    return most;
}

/* Does a slipping pair turn back at once? */
static bool turns_back(const struct fbd_state *state, int pair)
{
    const struct friction *friction = &state->model->plan.frictions[pair];
    struct instant at = state_instant(state);
    double surface;
    if (friction->rope) return rope_at(state->model, &at, friction->tie).acceleration > 0;
    if (friction->surface) return surface_row(state, pair)->g.x2 < -1e-12 * largest_acceleration(state);
    if (friction->tie >= 0)
        return state->slip[pair] * tie_slip_acceleration(state->model, &at, friction->tie) < 0;
    friction_surface_speed(friction, &at, &surface);
    double a = state->a[friction->coordinate];
    return state->slip[pair] * (a - surface) < -8 * DBL_EPSILON * (fabs(a) + fabs(surface));
}

/* The size that tensions have: what zero is measured against. */
static double largest_tension(const struct fbd_state *state)
{
    double most = 0;
    for (int j = 0; j < state->model->tree->row_count; j++)
        most = fmax(most, fabs(state->tree->rows[j].lambda));
    return most;
}

/* One round: change the mode of one pair; false when none has to be changed. */
static bool change_one(struct fbd_state *state, const struct decided *decided, const double *slots,
                       const double *slots_along)
{
    const struct fbd_model *model = state->model;
    double *dy = state->scratch + 2 * (size_t)model->plan.slots, worst = -1;
    struct instant at = state_instant(state);
    struct direction flow = {1, dy};
    int which = -1;
    enum slip next = stick;
    for (int pair = 0; pair < (int)model->plan.friction_count; pair++) {
        if (!is_open(state, decided, pair)) continue;
        if (state->slip[pair] != stick) {
            if (!turns_back(state, pair)) continue;
            state->slip[pair] = stick;
            return true;
        }
        if (model->plan.frictions[pair].rope) {
            double tension = rope_at(model, &at, model->plan.frictions[pair].tie).tension;
            if (tension >= -1e-12 * largest_tension(state) || (which >= 0 && -tension <= worst)) continue;
            which = pair;
            next = slip_plus;
            worst = -tension;
            continue;
        }
        if (model->plan.frictions[pair].surface) {
            double N = surface_row(state, pair)->lambda;
            if (N >= -1e-12 * largest_tension(state) || (which >= 0 && -N <= worst)) continue;
            which = pair;
            next = slip_plus;
            worst = -N;
            continue;
        }
        struct friction_values now = friction_at(model, pair, &at, slots);
        struct friction_values rate = friction_along(model, pair, &at, slots, &flow, slots_along);
        enum slip choice = friction_decide(&now, &rate);
        double excess = fabs(now.hold) - now.limit_static;
        if (choice == stick || (which >= 0 && excess <= worst)) continue;
        which = pair;
        next = choice;
        worst = excess;
    }
    if (which >= 0) state->slip[which] = next;
    return which >= 0;
}

bool tree_settle_slips(struct fbd_state *state, const struct decided *decided)
{
    const struct plan *plan = &state->model->plan;
    int *before = state->slip_before, count = (int)plan->friction_count;
    double *slots = state->scratch, *slots_along = slots + plan->slots;
    memcpy(before, state->slip, (size_t)count * sizeof *before);
    for (int pair = 0; pair < count; pair++)
        if (is_open(state, decided, pair)) state->slip[pair] = stick;
    for (int round = 0; round < 4 * count + 4; round++) {
        evaluate(state, slots, slots_along);
        if (!change_one(state, decided, slots, slots_along)) break;
    }
    return memcmp(before, state->slip, (size_t)count * sizeof *before) == 0;
}
