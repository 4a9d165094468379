/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The values of watchers and their rates along the motion.
 */
#include <assert.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/friction.h"
#include "dynamics/modes.h"
#include "dynamics/reactions.h"
#include "dynamics/rest_system.h"
#include "dynamics/tree_driven.h"
#include "dynamics/user_states.h"
#include "dynamics/world_refs.h"
#include "events/watchers.h"
#include "numeric/tolerances.h"

/* ---- values */

/* Instant and direction at which a set is evaluated. */
struct view {
    struct fbd_state *state;
    struct instant at;
    double rest; /* lower part of the time */
    struct direction flow;
    const double *slots, *slots_along; /* without friction */
    int friction;                      /* the pair of `now` and `along`, -1 for none */
    struct friction_values now, along;
    struct arena arena;
    bool shared, told; /* the forces of a load are redundant; a watcher has its margin already */
    struct rest_margin margin;
    double slack; /* at the zero of the last value a force or speed is so far past its limit */
};

static void look_at_friction(struct view *view, int pair)
{
    const struct fbd_model *model = view->state->model;
    if (view->friction == pair) return;
    view->friction = pair;
    view->now = friction_at(model, pair, &view->at, view->slots);
    view->along = friction_along(model, pair, &view->at, view->slots, &view->flow, view->slots_along);
}

static double user_value(const struct watch *watch, const struct view *view, double *rate)
{
    double left_rate, right_rate;
    double left = formula_along(&watch->left, &view->at, &view->flow, &left_rate);
    double right = formula_along(&watch->right, &view->at, &view->flow, &right_rate);
    *rate = left_rate - right_rate;
    return left - right;
}

/* Closed: the force. Open: the distance to closing; just after opening that is round-off, which must not
 * close it. */
static double one_sided_value(const struct watchers *watchers, const struct watcher *watcher,
                              struct view *view, double *rate)
{
    const struct fbd_model *model = view->state->model;
    int coupling = model->plan.modes[watcher->index].coupling;
    *rate = 0;
    if (mode_has_ended(view->state, watcher->index)) return HUGE_VAL;
    struct one_sided now = one_sided_at(model, &view->at, watcher->index);
    if (view->at.slip[watcher->index] != stick) {
        *rate = -now.rate;
        view->slack = now.rounding + watchers->quiet[watcher->index];
        return view->slack - now.excess;
    }
    view->slack = now.slack;
    double lambda_rate = view->state->tree->z[model->tree->couplings[coupling].first_row];
    *rate = model->plan.modes[watcher->index].kind == mode_rope ? -lambda_rate : lambda_rate;
    return now.force + now.slack;
}

/* The normal force while the contact is closed. */
static double lift_value(const struct watcher *watcher, struct view *view, double *rate)
{
    const struct fbd_model *model = view->state->model;
    const struct mode *mode = &model->plan.modes[watcher->index];
    *rate = 0;
    if (view->at.slip[watcher->index] != stick) return HUGE_VAL;
    int slot = model->tree->couplings[mode->coupling].normal_slot;
    assert(view->slots && view->slots_along);
    *rate = -view->slots_along[slot];
    view->slack = contact_slack(model, mode->coupling);
    return view->slack - view->slots[slot];
}

/* The gap. Just after opening it is round-off, which must not close it. */
static double gap_value(const struct watchers *watchers, const struct watcher *watcher,
                        const struct view *view, double *rate)
{
    const struct fbd_model *model = view->state->model;
    *rate = 0;
    if (watchers->asleep && watchers->asleep[watcher->index]) return HUGE_VAL;
    struct gap gap = meeting_probe(model, &view->at, watcher->index, watcher->part);
    *rate = gap.rate;
    double deep = watchers->deep ? watchers->deep[watcher->index] : 0;
    return gap.x + deep + meeting_rounding(model, view->state->tree, watcher->index);
}

/* Distance of the contact point to the end of the side; a point within `near` beyond the end is still on the
 * side. */
static double edge_value(const struct watcher *watcher, struct view *view, double *rate)
{
    const struct fbd_model *model = view->state->model;
    int meeting = model->tree->couplings[watcher->index].meeting;
    struct gap gap = {HUGE_VAL, 0, no_feature};
    if (coupling_is_closed(model, &view->at, watcher->index))
        gap = feature_end(model, view->state->tree, meeting,
                          view->state->tree->couplings[watcher->index].feature, watcher->end);
    *rate = gap.rate;
    view->slack = 2 * meeting_near(model, view->state->tree, meeting);
    return gap.x < HUGE_VAL ? gap.x + view->slack : HUGE_VAL;
}

static double friction_value(const struct watchers *watchers, const struct watcher *watcher,
                             struct view *view, double *rate)
{
    const struct fbd_model *model = view->state->model;
    const struct mode *mode = &model->plan.modes[watcher->index];
    int slip = view->at.slip[watcher->index];
    *rate = 0;
    if (mode_is_off_surface(view->state, watcher->index)) return HUGE_VAL;
    if (watcher->kind == watch_slip_stop) {
        if (slip == stick || friction_is_idle(model, watcher->index, &view->at, &view->flow)) return HUGE_VAL;
        view->slack = watchers->quiet[watcher->index];
        if (mode->coupling >= 0) {
            *rate = slip * coupling_slip_acceleration(model, &view->at, mode->coupling);
            return slip * coupling_slip_velocity(model, &view->at, mode->coupling) +
                   watchers->quiet[watcher->index];
        }
        double acceleration, speed = friction_surface_speed(mode, &view->at, &acceleration);
        int index = model->plan.n + mode->coordinate;
        assert(view->flow.dy);
        *rate = slip * (view->flow.dy[index] - acceleration);
        return slip * (view->at.y[index] - speed) + watchers->quiet[watcher->index];
    }
    if (watcher->kind == watch_stick_limit && slip != stick) return HUGE_VAL;
    look_at_friction(view, watcher->index);
    const struct friction_values *now = &view->now, *d = &view->along;
    if (watcher->kind == watch_normal_turns) {
        *rate = view->at.pull[watcher->index] * d->N;
        if (mode->kind != mode_single) view->slack = press_slack(model, view->at.tree, mode->body);
        return view->at.pull[watcher->index] * now->N + view->slack;
    }
    int side = watcher->end == 0 ? 1 : -1;
    bool kinetic = now->limit_kinetic > now->limit_static; /* as in friction_decide */
    *rate = (kinetic ? d->limit_kinetic : d->limit_static) - side * d->hold;
    /* A force that barely touches its limit must not break away by a rounding. */
    view->slack = friction_rounding(now);
    if (mode->coupling >= 0 && model->tree->couplings[mode->coupling].meeting >= 0)
        view->slack += contact_slack(model, mode->coupling);
    return now->limit - side * now->hold + view->slack;
}

/* Does the watcher belong to a set of redundant forces? One watcher stands for all of them. */
static bool watches_share(const struct watcher *watcher, const struct view *view)
{
    if (!view->shared) return false;
    assert(view->margin.contacts && view->margin.of); /* of the redundant set */
    if (watcher->kind == watch_contact) return view->margin.contacts[watcher->index];
    bool limit = watcher->kind == watch_stick_limit || watcher->kind == watch_normal_turns ||
                 watcher->kind == watch_lift || watcher->kind == watch_one_sided;
    bool rubs = watcher->kind == watch_normal_turns; /* while it slips its normal force is limited */
    return limit && (view->at.slip[watcher->index] == stick || rubs) && view->margin.of[watcher->index];
}

static double shared_value(struct view *view, const struct watcher *watcher, double *rate)
{
    bool turns = watcher->kind == watch_normal_turns && view->at.slip[watcher->index] == stick;
    bool told = view->told || turns; /* where the normal force reverses, no friction acts */
    view->told |= !told;
    *rate = told ? 0 : view->margin.rate;
    view->slack = rest_margin_slack(&view->margin);
    return told ? HUGE_VAL : view->margin.value + view->slack;
}

/* The Filippov sliding mode on the switch of a watcher; NULL when there is none. */
static const struct slide *slide_of(const struct fbd_state *state, const struct watcher *watcher)
{
    if (!state_sliding(state)) return NULL;
    int branch = state->model->plan.kinks[watcher->index].formula.branch + watcher->part;
    int slide = state->sliding->slide_at[branch];
    return slide > 0 ? &state->sliding->slides[slide - 1] : NULL;
}

static double share_value(const struct fbd_state *state, const struct watcher *watcher, double *rate)
{
    const struct slide *slide = slide_of(state, watcher);
    *rate = 0;
    if (!slide) return HUGE_VAL;
    *rate = watcher->end == 0 ? slide->along : -slide->along;
    return (watcher->end == 0 ? slide->share : 1 - slide->share) + slide->slack;
}

static void kink_margins(const struct watchers *watchers, const struct kink *kink, const struct view *view)
{
    double *margins = watchers->scratch, *rates = margins + 2 * kink->count;
    struct time_dd t = {view->at.t, view->rest};
    expr_margins(kink->formula.expr, t, view->at.y, view->flow.dt, view->flow.dy,
                 formula_branches(&kink->formula, &view->at), margins, rates, rates + 2 * kink->count);
}

/* Functions depend in the present modes on positions and velocities; on their derivatives as well; on forces as well. */
enum needs { needs_motion, needs_flow, needs_forces };

static enum needs needs_of(const struct watcher *watcher, const struct fbd_state *state)
{
    switch (watcher->kind) {
    case watch_gap:
    case watch_edge: return needs_motion;
    case watch_kink: return state->model->plan.kinks[watcher->index].reacts ? needs_forces : needs_flow;
    case watch_user: return state->model->plan.watches[watcher->index].reacts ? needs_forces : needs_flow;
    case watch_share: return needs_flow;
    case watch_lift: return state->slip[watcher->index] == stick ? needs_forces : needs_motion;
    case watch_slip_stop:
    case watch_stick_limit:
    case watch_normal_turns:
        if (mode_is_off_surface(state, watcher->index)) return needs_motion;
        if (watcher->kind == watch_slip_stop) return needs_flow;
        if (watcher->kind == watch_stick_limit && state->slip[watcher->index] != stick) return needs_flow;
        break;
    case watch_contact:
    case watch_one_sided: break;
    }
    return needs_forces;
}

static enum needs needs_of_set(const struct watcher_set *set, const struct fbd_state *state,
                               const bool *asked)
{
    enum needs most = state->model->names_places ? needs_flow : needs_motion;
    for (size_t i = 0; i < set->count && most < needs_forces; i++) {
        if (asked && !asked[i]) continue;
        const enum needs own = needs_of(&set->watchers[i], state);
        if (own > most) most = own;
    }
    return most;
}

/* Behind the extended vectors of the instant and of the flow. */
static void set_reactions(struct view *view)
{
    struct fbd_state *state = view->state;
    double *dy = state->extended + extended_size(state->model);
    reactions_write(state->model, &view->at, view->slots, state->extended);
    reactions_write_along(state->model, &view->at, &view->flow, view->slots, view->slots_along, dy);
}

/* Compute that at (t, y) in the present modes: forces are those without friction, with their variations. */
static void set_flow(struct view *view, enum needs needs)
{
    struct fbd_state *state = view->state;
    if (needs == needs_motion) {
        tree_move(state->model, &view->at);
        return;
    }
    const struct plan *plan = &state->model->plan;
    struct scratch scratch = state_scratch(state);
    double *slots = scratch.slots, *slots_along = scratch.slots_along, *dy = scratch.dy;
    state_rates(state->model, &view->at, slots, dy);
    if (plan->own > 0) user_state_rates(state->model, &view->at, dy + plan_own_place(plan));
    view->flow = (struct direction){.dt = 1, .dy = dy};
    if (state->model->names_places) {
        view->at = instant_extend(state->model, &view->at);
        view->flow = direction_extend(state->model, &view->at, &view->flow);
    }
    if (view->at.sliding) sliding_solve_along(state->model, &view->at, &view->flow);
    if (needs == needs_flow) return;
    force_balance(state->model, &view->at, slots);
    force_balance_along(state->model, &view->at, &view->flow, slots, slots_along);
    view->slots = slots;
    view->slots_along = slots_along;
    if (state->model->names_reactions) set_reactions(view);
    if (!tree_joins(state->model->tree)) return;
    view->arena = state_lend(state);
    view->shared = tree_find_margin(state, &view->at, rest_all, &view->flow, slots, slots_along, &view->arena,
                                    &view->margin);
}

/* The margins of its kink are evaluated with those of the watcher before, if that is of the same one. */
static double kink_value(const struct watchers *watchers, const struct watcher *watcher,
                         const struct view *view, int *last_kink, double *rate)
{
    /* A quantity at rest at its switch, as an integral at its limit, may be short of it by the error of the
     * step that reached it. */
    const double short_of = stop_shortfall / round_off(1, 1);
    const struct kink *kink = &view->state->model->plan.kinks[watcher->index];
    if (watcher->index != *last_kink) kink_margins(watchers, kink, view);
    *last_kink = watcher->index;
    const size_t entry = 2 * (size_t)watcher->part + (size_t)watcher->end;
    const double value = watchers->scratch[entry], rounding = watchers->scratch[4 * kink->count + entry];
    const bool held = watchers->held[kink->formula.branch + watcher->part];
    *rate = 0;
    if (held || slide_of(view->state, watcher)) return HUGE_VAL;
    *rate = watchers->scratch[2 * kink->count + entry];
    return *rate == 0 && value < 0 && value >= -short_of * rounding ? 0 : value;
}

/* As watchers_evaluate; with `slacks`, or NULL. */
static void evaluate(const struct watchers *watchers, const struct watcher_set *set, struct fbd_state *state,
                     struct time_dd t, const double *y, const bool *asked, double *values, double *rates,
                     double *slacks)
{
    const struct plan *plan = &state->model->plan;
    struct view view = {.state = state,
                        .at = state_instant_at(state, t.t, y),
                        .rest = t.rest,
                        .flow = {1, NULL, NULL},
                        .friction = -1};
    if (set != &watchers->timed) set_flow(&view, needs_of_set(set, state, asked));
    int last_kink = -1;
    for (size_t i = 0; i < set->count; i++) {
        const struct watcher *watcher = &set->watchers[i];
        view.slack = 0;
        if (watches_share(watcher, &view)) {
            values[i] = shared_value(&view, watcher, &rates[i]);
            if (slacks) slacks[i] = view.slack;
            continue;
        }
        if (asked && !asked[i]) {
            values[i] = HUGE_VAL;
            rates[i] = 0;
            continue;
        }
        assert(view.slots || set == &watchers->timed || needs_of(watcher, state) < needs_forces);
        switch (watcher->kind) {
        case watch_kink: values[i] = kink_value(watchers, watcher, &view, &last_kink, &rates[i]); break;
        case watch_contact:
            assert(view.slots && view.slots_along);
            view.slack = watchers_contact_slack(state->model, view.at.tree, &plan->contacts[watcher->index]);
            values[i] = view.slack - view.slots[plan->contacts[watcher->index].slot];
            rates[i] = -view.slots_along[plan->contacts[watcher->index].slot];
            break;
        case watch_user: {
            int armed = watchers->armed[watcher->index];
            double value = user_value(&plan->watches[watcher->index], &view, &rates[i]);
            values[i] = armed == 0 ? HUGE_VAL : armed * value + watchers->band[watcher->index];
            rates[i] *= armed;
            break;
        }
        case watch_one_sided: values[i] = one_sided_value(watchers, watcher, &view, &rates[i]); break;
        case watch_share: values[i] = share_value(state, watcher, &rates[i]); break;
        case watch_lift: values[i] = lift_value(watcher, &view, &rates[i]); break;
        case watch_gap: values[i] = gap_value(watchers, watcher, &view, &rates[i]); break;
        case watch_edge: values[i] = edge_value(watcher, &view, &rates[i]); break;
        case watch_slip_stop:
        case watch_stick_limit:
        case watch_normal_turns: values[i] = friction_value(watchers, watcher, &view, &rates[i]); break;
        }
        if (slacks) slacks[i] = view.slack;
    }
    state_take_back(state, &view.arena);
}

void watchers_evaluate(const struct watchers *watchers, const struct watcher_set *set,
                       struct fbd_state *state, struct time_dd t, const double *y, const bool *asked,
                       double *values, double *rates)
{
    evaluate(watchers, set, state, t, y, asked, values, rates, NULL);
}

double watchers_delay(const struct watchers *watchers, struct fbd_state *state, struct time_dd t,
                      const double *y, const bool *crossed, double *values)
{
    const struct watcher_set *set = &watchers->moving;
    double *rates = values + set->count, *slacks = watchers->slacks, delay = 0;
    memset(slacks, 0, set->count * sizeof *slacks);
    evaluate(watchers, set, state, t, y, crossed, values, rates, slacks);
    for (size_t i = 0; i < set->count; i++)
        if (crossed[i] && rates[i] < 0 && values[i] <= slacks[i] / 2)
            delay = fmax(delay, (slacks[i] + fmin(fabs(values[i]), slacks[i])) / -rates[i]);
    return delay;
}

void watchers_evaluate_timed(const struct watchers *watchers, struct fbd_state *state, struct time_dd t,
                             double *values, double *rates, double *roundings)
{
    const struct watcher_set *set = &watchers->timed;
    struct view view = {.state = state, .at = state_instant(state), .rest = t.rest, .flow = {1, NULL, NULL}};
    view.at.t = t.t;
    int last_kink = -1;
    for (size_t i = 0; i < set->count; i++) {
        const struct watcher *watcher = &set->watchers[i];
        const struct kink *kink = &state->model->plan.kinks[watcher->index];
        if (watcher->index != last_kink) kink_margins(watchers, kink, &view);
        last_kink = watcher->index;
        size_t entry = 2 * (size_t)watcher->part + (size_t)watcher->end;
        values[i] = watchers->scratch[entry];
        rates[i] = watchers->scratch[2 * kink->count + entry];
        roundings[i] = watchers->scratch[4 * kink->count + entry];
    }
}

double watch_rate(const struct watch *watch, struct fbd_state *state)
{
    struct view view = {.state = state, .at = state_instant(state)};
    double rate;
    set_flow(&view, watch->reacts ? needs_forces : needs_flow);
    user_value(watch, &view, &rate);
    state_take_back(state, &view.arena);
    return rate;
}

/* Does the force or coupling that begins or ends there wait for the other one, or has it begun or ended? */
static bool watch_is_over(const struct fbd_state *state, const struct watch *watch)
{
    const int lifetime = watch->source->lifetime;
    return lifetime > 0 &&
           state->tree->life[lifetime - 1] != (watch->source->begins ? life_waits : life_there);
}

void watchers_arm(struct watchers *watchers, struct fbd_state *state, double step)
{
    const struct plan *plan = &state->model->plan;
    if (tree_joins(state->model->tree)) watchers_calm(watchers, state, step);
    if (plan->watch_count == 0) return;
    const struct instant now = state_instant(state), at = instant_extend(state->model, &now);
    if (state->model->names_reactions) reactions_copy(state->model, state->y, state->extended);
    for (size_t i = 0; i < plan->watch_count; i++) {
        const struct watch *watch = &plan->watches[i];
        if (watch_is_over(state, watch)) {
            watchers->armed[i] = 0;
            continue;
        }
        double value = formula_value(&watch->left, &at) - formula_value(&watch->right, &at),
               size = fabs(value);
        if (size > watchers->most[i] && size < HUGE_VAL) watchers->most[i] = size;
        double width = watchers->width * watchers->most[i];
        watchers->band[i] = size <= width ? width : 0;
        if (watchers->armed[i] != 0) continue;
        double side = value != 0 ? value : watch_rate(watch, state);
        watchers->armed[i] = side > 0 ? 1 : side < 0 ? -1 : 0;
    }
}

/* The difference is zero, thus in its band. */
void watchers_turn(struct watchers *watchers, int watch)
{
    watchers->armed[watch] = -watchers->armed[watch];
    watchers->band[watch] = watchers->width * watchers->most[watch];
}
