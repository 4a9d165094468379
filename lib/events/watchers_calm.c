/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Slip speeds that are round-off, and do not reverse.
 */
#include "dynamics/friction.h"
#include "dynamics/modes.h"
#include "dynamics/tree.h"
#include "dynamics/tree_driven.h"
#include "events/watchers.h"
#include "numeric/tolerances.h"

/* The acceleration of its body by the friction limit of a pair alone. */
static double acceleration_at_limit(const struct fbd_state *state, int pair)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[model->plan.modes[pair].body];
    const struct instant at = state_instant(state);
    double limit = friction_at(model, pair, &at, state->slots).limit, inertia = coordinate_inertia(body, 0);
    return inertia > 0 ? limit / inertia : 0;
}

/* The speed that the body of a pair that has never moved would have reached by its friction limit alone. */
static double speed_to_come(const struct fbd_state *state, int pair)
{
    return acceleration_at_limit(state, pair) * fabs(state->t);
}

/* A band for the speed of a pair whose stops change nothing: other constraints keep it where it is, at its limit, and its
 * velocity is that left by the shift of dependent rows. It ends with a larger speed. */
static double blocked_band(struct watchers *watchers, const struct fbd_state *state, size_t pair, double v)
{
    enum { some = 3 };
    if (watchers->stops[pair] == 0) return 0;
    const double band = dependent_row * speed_to_come(state, (int)pair);
    if (v > band) watchers->stops[pair] = 0;
    return watchers->stops[pair] >= some ? band : 0;
}

/* Twice the speed with which a slipping pair still moves against its slip direction although it accelerates
 * in that direction: a residue of projecting velocities onto other couplings. 0 if it moves in the slip
 * direction, or too fast for such a residue. `v`: its velocity in the slip direction. */
static double short_of_side(const struct fbd_state *state, int pair, double v)
{
    const double rounding = undecided_part;
    const struct instant at = state_instant(state);
    double fastest = 0;
    if (v >= 0) return 0;
    for (int i = 1; i < state->model->tree->joined; i++)
        fastest = fmax(fastest, vec_norm(state->tree->links[i].v));
    double to_its_side = slip_side(state->slip[pair]) * tree_hold_acceleration(state, &at, pair);
    return -v <= rounding * fastest && to_its_side > 0 ? -2 * v : 0;
}

/* A pair that breaks away at its limit first has an acceleration of round-off, which may have the wrong sign.
 * The band applies to the first, very short steps only: a body that others block does not move, and sticks
 * again after them. */
static void calm_beginning(struct watchers *watchers, const struct fbd_state *state, size_t pair, double step)
{
    const double band = slip_band, least = least_slip_band, instant = slip_beginning;
    const struct mode *mode = &state->model->plan.modes[pair];
    const struct instant at = state_instant(state);
    if (state->slip[pair] == stick || !mode_is_friction(mode)) return;
    double along = slip_velocity(state->model, (int)pair, &at), v = fabs(along),
           *fast = &watchers->fast[pair];
    watchers->quiet[pair] = fmax(short_of_side(state, (int)pair, slip_side(state->slip[pair]) * along),
                                 blocked_band(watchers, state, pair, v));
    *fast = fmax(*fast, v);
    if (mode->kind == mode_plane)
        watchers->quiet[pair] = soft_return * state->tree->couplings[mode->coupling].nu;
    if (mode->kind == mode_plane) return;
    if (v == 0) *fast = fmax(*fast, speed_to_come(state, (int)pair));
    if (v > 0 && (step > instant * fabs(state->t) || v > least * *fast)) return;
    watchers->quiet[pair] = fmax(watchers->quiet[pair], band * *fast);
}

/* A pair whose driven slip passes smoothly through zero has a speed of round-off for some time. */
void watchers_calm(struct watchers *watchers, const struct fbd_state *state, double step)
{
    const double near = 10;
    for (size_t i = 0; i < state->model->plan.mode_count; i++) {
        if (mode_is_one_sided(&state->model->plan.modes[i])) continue;
        watchers->quiet[i] = 0;
        if (state->slip_driven[i] == 0) {
            calm_beginning(watchers, state, i, step);
            continue;
        }
        struct instant at = state_instant(state);
        int side = slip_side(state->slip[i]);
        double v = side * slip_velocity(state->model, (int)i, &at);
        bool rests = v == 0 && !(side * tree_hold_acceleration(state, &at, (int)i) > 0);
        watchers->fast[i] = fmax(watchers->fast[i], v);
        double band =
            rests ? HUGE_VAL : fmax(watchers->width * watchers->fast[i], tree_unseen_speed(state, step));
        if (fabs(v) <= near * band) watchers->quiet[i] = band;
    }
}

void watchers_count_stops(struct watchers *watchers, const bool *moving, const struct fbd_state *before,
                          const struct fbd_state *after)
{
    const struct watcher_set *set = &watchers->moving;
    for (size_t i = 0; i < set->count; i++) {
        if (!moving[i] || set->watchers[i].kind != watch_slip_stop) continue;
        const int pair = set->watchers[i].index, side = after->slip[pair];
        watchers->stops[pair] = side != stick && side == before->slip[pair] ? watchers->stops[pair] + 1 : 0;
    }
}
