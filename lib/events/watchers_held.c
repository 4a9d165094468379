/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Switches that a stick, or a stop, holds at zero.
 *
 * A law may say abs(v - s) with s the velocity of the surface. While the body sticks there this is zero
 * throughout and no function that passes zero: its sign is rounding. So is that of v at a stop. Whether it is so
 * is asked of the function itself: at states taken at random among those that stick as this one does, what is not
 * zero throughout is zero with probability nought (the test of identities by J. T. Schwartz, J. ACM 27 (1980) 701).
 */
#include <math.h>
#include <string.h>

#include "dynamics/world_refs.h"
#include "events/watchers.h"

/* Numbers between -1 and 1 that follow no rule of a scene: multiples of the golden section. */
static double next_number(unsigned *count)
{
    const double golden = 0.61803398874989484820;
    double whole;
    return 2 * modf(++*count * golden, &whole) - 1;
}

/* The coordinate that friction holds, or with `stops` a stop; -1 for none. What rolls has none of its own. */
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

/* Another number, however large this one is. */
static double other_than(double x, unsigned *count)
{
    return x + (1 + fabs(x)) * next_number(count);
}

/* Another time and another state, with what sticks on its surface, and what rests at a stop there. */
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

/* Add to `zeros` for each switch of the kink that is zero at (t, y). */
static void count_zeros(const struct watchers *watchers, const struct fbd_state *state,
                        const struct kink *kink, double t, const double *y, int *zeros)
{
    struct instant at = state_instant_at(state, t, y);
    if (state->model->names_places && !state->model->tree) at = instant_extend(state->model, &at);
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

/* Does it read the motion, and no more than its coordinates where the links of jointed bodies would have to
 * be moved for that? */
static bool can_be_asked(const struct fbd_model *model, const struct kink *kink)
{
    const int *slots;
    size_t count = expr_variables(kink->formula.expr, &slots);
    return count > 0 && (!model->tree || slots[count - 1] <= (int)plan_size(&model->plan));
}

static bool any_holds(const struct fbd_state *state)
{
    bool stops;
    for (size_t pair = 0; pair < state->model->plan.mode_count; pair++)
        if (held_by(state, pair, &stops) >= 0) return true;
    return false;
}

/* Couplings may hold more than is asked for here: what is zero without them is zero with them. */
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
