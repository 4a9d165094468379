/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Switches that sticking, or a stop, keeps at zero.
 *
 * A law may contain abs(v - s) with s the velocity of the surface. While the body sticks there, the argument
 * is zero throughout and its sign is round-off; the same holds for v at a stop. Such arguments are found by
 * evaluation: at random states that satisfy the same sticking conditions, a function that is not identically
 * zero is zero with probability 0 (the test of identities by J. T. Schwartz, J. ACM 27 (1980) 701).
 */
#include <math.h>
#include <string.h>

#include "dynamics/world_refs.h"
#include "events/watchers.h"

/* Numbers between -1 and 1 unrelated to those of a scene: multiples of the golden section. */
static double next_number(unsigned *count)
{
    const double golden = 0.61803398874989484820;
    double whole;
    return 2 * modf(++*count * golden, &whole) - 1;
}

/* The coordinate that friction, or with `stops` a stop, keeps constant; -1 for none. A rolling body has none. */
static int held_by(const struct fbd_state *state, size_t pair, bool *stops)
{
    const struct mode *mode = &state->model->plan.modes[pair];
    *stops = false;
    if (state->slip[pair] != stick) return -1;
    if (mode_is_joint_friction(mode)) return mode->coordinate;
    const struct tree *tree = state->model->tree;
    if (mode->kind != mode_contact || tree->couplings[mode->coupling].meeting < 0) return -1;
    const struct meeting *meeting = &tree->meetings[tree->couplings[mode->coupling].meeting];
    *stops = meeting->stop != 0;
    return *stops ? tree->links[meeting->shape[0].link].coordinate : -1;
}

/* A different number of the same order or of order 1. */
static double other_than(double x, unsigned *count)
{
    return x + (1 + fabs(x)) * next_number(count);
}

/* A random time and state in which sticking bodies have the velocity of their surfaces, and bodies at a stop
 * rest there. */
static double move_away(const struct fbd_state *state, unsigned *count, double *y)
{
    const struct plan *plan = &state->model->plan;
    size_t n = (size_t)plan->n;
    double t = other_than(state->t, count), acceleration;
    for (size_t i = 0; i < plan_size(plan); i++) y[i] = other_than(state->y[i], count);
    struct instant at = state_instant_at(state, t, y);
    for (size_t pair = 0; pair < plan->mode_count; pair++) {
        bool stops;
        int k = held_by(state, pair, &stops);
        if (k < 0) continue;
        if (stops) y[k] = state->y[k];
        y[n + (size_t)k] = stops ? 0 : friction_surface_speed(&plan->modes[pair], &at, &acceleration);
    }
    return t;
}

/* Add 1 to `zeros` for each switch of the kink that is zero at (t, y). */
static void count_zeros(const struct watchers *watchers, const struct fbd_state *state,
                        const struct kink *kink, double t, const double *y, int *zeros)
{
    struct instant at = state_instant_at(state, t, y);
    if (state->model->names_places && !tree_joins(state->model->tree)) at = instant_extend(state->model, &at);
    double *margins = watchers->scratch, *roundings = margins + 4 * kink->count;
    const double *still = watchers->place + extended_size(state->model);
    expr_margins(kink->formula.expr, time_dd_at(t), at.y, 0, still, state->branch + kink->formula.branch,
                 margins, margins + 2 * kink->count, roundings);
    for (size_t part = 0; part < kink->count; part++)
        for (size_t end = 2 * part; end < 2 * part + 2; end++)
            if (fabs(margins[end]) <= 4 * roundings[end]) {
                zeros[part]++;
                break;
            }
}

/* Does the kink read the motion, and in a model with joints no positions of links, which would have to be
 * updated? */
static bool can_be_asked(const struct fbd_model *model, const struct kink *kink)
{
    const int *slots;
    size_t count = expr_variables(kink->formula.expr, &slots);
    return count > 0 && (!tree_joins(model->tree) || slots[count - 1] <= (int)plan_size(&model->plan));
}

static bool any_holds(const struct fbd_state *state)
{
    bool stops;
    for (size_t pair = 0; pair < state->model->plan.mode_count; pair++)
        if (held_by(state, pair, &stops) >= 0) return true;
    return false;
}

/* Couplings, which may keep more switches at zero, are not considered: a switch that is zero without them is
 * zero with them. */
void watchers_hold(struct watchers *watchers, const struct fbd_state *state)
{
    enum { places = 3 };
    const struct fbd_model *model = state->model;
    const struct plan *plan = &model->plan;
    bool asked = plan->kink_count > 0 && any_holds(state);
    memset(watchers->zeros, 0, (size_t)plan->branches * sizeof *watchers->zeros);
    unsigned count = 0;
    for (int place = 0; asked && place < places; place++) {
        double t = place == 0 ? state->t : move_away(state, &count, watchers->place);
        if (place == 0) memcpy(watchers->place, state->y, plan_size(plan) * sizeof *watchers->place);
        for (size_t i = 0; i < plan->kink_count; i++)
            if (can_be_asked(model, &plan->kinks[i]))
                count_zeros(watchers, state, &plan->kinks[i], t, watchers->place,
                            watchers->zeros + plan->kinks[i].formula.branch);
    }
    for (int i = 0; i < plan->branches; i++) watchers->held[i] = asked && watchers->zeros[i] == places;
}
