/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "events/enclosure.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/contact.h"
#include "dynamics/modes.h"
#include "dynamics/tree.h"
#include "dynamics/world_refs.h"

/* ---- the functions that a plan requires */

static void add(struct watcher_set *set, struct watcher watcher)
{
    if (set->watchers) set->watchers[set->count] = watcher;
    set->count++;
}

static void add_kinks(struct watchers *watchers, const struct plan *plan)
{
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct kink *kink = &plan->kinks[i];
        for (size_t part = 0; part < kink->count; part++) {
            bool timed = expr_switch_is_time(kink->formula.expr, part);
            if (timed) watchers->timed_affine &= expr_switch_is_affine_in_time(kink->formula.expr, part);
            for (int end = 0; end < 2; end++)
                add(timed ? &watchers->timed : &watchers->moving,
                    (struct watcher){watch_kink, (int)i, (int)part, end});
        }
    }
}

/* For every switch on which sliding is possible; the modes decide later. */
static void add_shares(struct watchers *watchers, const struct plan *plan)
{
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct kink *kink = &plan->kinks[i];
        for (size_t part = 0; kink->slides && part < kink->count; part++)
            for (int end = 0; end < 2; end++)
                add(&watchers->moving, (struct watcher){watch_share, (int)i, (int)part, end});
    }
}

static bool always_the_same(const struct plan *plan, const struct mode *mode)
{
    return mode->coupling < 0 && plan->slot_constant[mode->coordinate] && !mode->surface_speed.expr &&
           !mode_friction_varies(mode) && (mode->normal_slot < 0 || plan->slot_constant[mode->normal_slot]);
}

/* ---- the watchers of each kind of mode */

static void add_rubbing(struct watchers *watchers, const struct plan *plan, int pair)
{
    const struct mode *mode = &plan->modes[pair];
    if (friction_is_never(mode)) return;
    add(&watchers->moving, (struct watcher){watch_slip_stop, pair, 0, 0});
    if (!always_the_same(plan, mode))
        for (int end = 0; end < 2; end++)
            add(&watchers->moving, (struct watcher){watch_stick_limit, pair, 0, end});
    if (mode->two_sided && !plan->slot_constant[mode->normal_slot])
        add(&watchers->moving, (struct watcher){watch_normal_turns, pair, 0, 0});
}

/* Of the size of the force. */
static void add_plane(struct watchers *watchers, const struct plan *plan, int pair)
{
    if (friction_is_never(&plan->modes[pair])) return;
    add(&watchers->moving, (struct watcher){watch_slip_stop, pair, 0, 0});
    add(&watchers->moving, (struct watcher){watch_stick_limit, pair, 0, 0});
}

static void add_one_sided(struct watchers *watchers, const struct plan *plan, int pair)
{
    (void)plan;
    add(&watchers->moving, (struct watcher){watch_one_sided, pair, 0, 0});
}

static void add_lift(struct watchers *watchers, const struct plan *plan, int pair)
{
    (void)plan;
    add(&watchers->moving, (struct watcher){watch_lift, pair, 0, 0});
}

/* Drives have no watchers. */
static void (*const add_mode[mode_kinds])(struct watchers *watchers, const struct plan *plan, int pair) = {
    [mode_single] = add_rubbing, [mode_joint] = add_rubbing,  [mode_tangent] = add_rubbing,
    [mode_plane] = add_plane,    [mode_rope] = add_one_sided, [mode_surface] = add_one_sided,
    [mode_contact] = add_lift};

static void add_modes(struct watchers *watchers, const struct plan *plan)
{
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        enum mode_kind kind = plan->modes[pair].kind;
        if (add_mode[kind]) add_mode[kind](watchers, plan, pair);
    }
}

static void add_contacts(struct watchers *watchers, const struct tree *tree)
{
    for (int i = 0; i < tree->meeting_count; i++) {
        const struct meeting *meeting = &tree->meetings[i];
        for (int probe = 0; probe < meeting->probes; probe++)
            add(&watchers->moving, (struct watcher){watch_gap, i, probe, 0});
        if (meeting->shape[0].kind != contact_corners && meeting->shape[1].kind != contact_corners) continue;
        if (meeting->shape[1].kind == contact_line) continue;
        for (int k = 0; k < 2 * meeting->coupling_count; k++)
            add(&watchers->moving, (struct watcher){watch_edge, meeting->first_coupling + k / 2, 0, k % 2});
    }
}

static void add_all(struct watchers *watchers, const struct fbd_model *model)
{
    const struct plan *plan = &model->plan;
    add_kinks(watchers, plan);
    add_shares(watchers, plan);
    add_modes(watchers, plan);
    add_contacts(watchers, model->tree);
    for (size_t i = 0; i < plan->contact_count; i++)
        if (plan->contacts[i].pair < 0 && !plan->slot_constant[plan->contacts[i].slot])
            add(&watchers->moving, (struct watcher){watch_contact, (int)i, 0, 0});
    for (size_t i = 0; i < plan->watch_count; i++)
        add(&watchers->moving, (struct watcher){watch_user, (int)i, 0, 0});
}

/* Group neighbours of the same kind and index. */
static bool group_watchers(struct arena *memory, const struct fbd_model *model, struct watcher_set *set)
{
    set->groups = ARENA_ARRAY(memory, set->count + 1, struct root_group);
    if (!set->groups) return false;
    struct root_group *group = set->groups - 1;
    for (size_t i = 0; i < set->count; i++) {
        const struct watcher *watcher = &set->watchers[i];
        bool same = i > 0 && watcher->kind == watcher[-1].kind && watcher->index == watcher[-1].index;
        if (!same)
            *++group = (struct root_group){.first = i,
                                           .proved = watchers_can_enclose(model, watcher),
                                           .aside = watcher->kind == watch_user,
                                           .clear = (double)NAN};
        group->count++;
    }
    set->group_count = (size_t)(group + 1 - set->groups);
    return true;
}

bool watchers_init(struct watchers *watchers, const struct fbd_model *model, double tolerance, bool multistep,
                   struct arena *memory)
{
    /* The errors of a multistep method are correlated over many steps: near a terminal speed msadams was off
     * by 160 tolerances inside its steps, one-step methods by 5. */
    const double tolerances = 10, together = 30;
    const struct plan *plan = &model->plan;
    size_t margins = 0;
    for (size_t i = 0; i < plan->kink_count; i++)
        if (plan->kinks[i].count > margins) margins = plan->kinks[i].count;
    *watchers = (struct watchers){.timed_affine = true};
    add_all(watchers, model); /* once to count, once to fill */
    size_t timed = watchers->timed.count, moving = watchers->moving.count;
    watchers->timed = (struct watcher_set){.watchers = ARENA_ARRAY(memory, timed + 1, struct watcher)};
    watchers->moving = (struct watcher_set){.watchers = ARENA_ARRAY(memory, moving + 1, struct watcher)};
    watchers->affine = ARENA_ARRAY(memory, moving + 1, struct affine);
    watchers->slacks = ARENA_ARRAY(memory, moving + 1, double);
    watchers->scratch = ARENA_ARRAY(memory, 6 * margins + 1, double);
    watchers->held = ARENA_ARRAY(memory, (size_t)plan->branches + 1, bool);
    watchers->zeros = ARENA_ARRAY(memory, (size_t)plan->branches + 1, int);
    watchers->place = ARENA_ARRAY(memory, 2 * extended_size(model) + 1, double);
    watchers->margins = ARENA_ARRAY(memory, 2 * margins + 1, struct enclosure);
    watchers->armed = ARENA_ARRAY(memory, plan->watch_count + 1, int);
    watchers->fired = ARENA_ARRAY(memory, plan->watch_count + 1, double);
    watchers->most = ARENA_ARRAY(memory, 2 * plan->watch_count + 1, double);
    watchers->fast = ARENA_ARRAY(memory, 2 * plan->mode_count + 1, double);
    watchers->stops = ARENA_ARRAY(memory, plan->mode_count + 1, int);
    if (memory->failed) return false;
    for (size_t i = 0; i < plan->watch_count; i++) watchers->fired[i] = (double)NAN;
    watchers->width = tolerances * (multistep ? together : 1) * tolerance;
    watchers->band = watchers->most + plan->watch_count;
    watchers->quiet = watchers->fast + plan->mode_count;
    add_all(watchers, model);
    return group_watchers(memory, model, &watchers->timed) &&
           group_watchers(memory, model, &watchers->moving);
}

/* ---- round-off levels, and the choice of enclosures */

double watchers_contact_slack(const struct fbd_model *model, const struct tree_work *tree,
                              const struct contact *contact)
{
    return press_slack(model, tree, contact->body);
}

/* Round-off level of a function; below zero if unknown. */
static double rounding_of(const struct watcher *watcher, const struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    const struct instant at = state_instant(state);
    if (watcher->kind == watch_gap) return meeting_rounding(model, state->tree, watcher->index);
    if (watcher->kind == watch_edge)
        return meeting_rounding(model, state->tree, tree->couplings[watcher->index].meeting);
    bool of_contact =
        watcher->kind == watch_lift || watcher->kind == watch_stick_limit || watcher->kind == watch_slip_stop;
    int coupling = of_contact ? model->plan.modes[watcher->index].coupling : -1;
    if (coupling < 0 || tree->couplings[coupling].meeting < 0) return -1;
    if (watcher->kind == watch_slip_stop) return coupling_slip_rounding(model, &at, coupling);
    return contact_slack(model, coupling);
}

void watchers_set_rounding(const struct watcher_set *set, const struct fbd_state *state, double *rounding,
                           double *jump)
{
    for (size_t i = 0; i < set->count; i++) {
        const struct watcher *watcher = &set->watchers[i];
        double all = rounding_of(watcher, state);
        if (all >= 0) rounding[i] = all / 2;
        jump[i] = watcher->kind == watch_gap ? meeting_jump(state->model, state->tree, watcher->index) : 0;
    }
}

/* `known`: no switch is in a sliding mode, or the weights of all sliding modes have enclosures. */
static bool is_enclosed(const struct fbd_state *state, const struct watcher *watcher, bool known)
{
    switch (watcher->kind) {
    case watch_share: {
        const struct kink *kink = &state->model->plan.kinks[watcher->index];
        for (size_t part = 0; !known && part < kink->count; part++)
            if (state->sliding->slide_at[(size_t)kink->formula.branch + part] > 0) return false;
        return true;
    }
    case watch_contact:
    case watch_stick_limit:
    case watch_normal_turns: return known && watchers_can_enclose(state->model, watcher);
    default: return watchers_can_enclose(state->model, watcher);
    }
}

/* Can the event not happen in the present modes? A slipping pair has no breakaway, and a sticking pair no end of
 * slip; a contact that is open has no friction, and one that is closed no gap. */
static bool is_idle(const struct fbd_state *state, const struct watcher *watcher)
{
    const struct instant at = state_instant(state);
    switch (watcher->kind) {
    case watch_slip_stop:
        return state->slip[watcher->index] == stick || mode_is_off_surface(state, watcher->index);
    case watch_stick_limit:
        return state->slip[watcher->index] != stick || mode_is_off_surface(state, watcher->index);
    case watch_lift: return state->slip[watcher->index] != stick;
    case watch_gap: return meeting_is_closed(state->model, &at, watcher->index);
    case watch_edge: return !coupling_is_closed(state->model, &at, watcher->index);
    default: return false;
    }
}

static void follow_affine(struct watchers *watchers, const struct fbd_state *state)
{
    const struct watcher_set *set = &watchers->moving;
    watchers->any_affine = false;
    watchers->all_affine = true;
    for (size_t g = 0; g < set->group_count; g++) {
        const struct root_group *group = &set->groups[g];
        for (size_t i = group->first; !group->idle && i < group->first + group->count; i++) {
            affine_find(watchers, state, &set->watchers[i], &watchers->affine[i]);
            watchers->any_affine |= watchers->affine[i].known;
            watchers->all_affine &= watchers->affine[i].known;
        }
    }
}

bool watchers_evaluate_affine(const struct watchers *watchers, const double *y, const double *dy,
                              double *values, double *rates)
{
    const struct watcher_set *set = &watchers->moving;
    for (size_t g = 0; watchers->all_affine && g < set->group_count; g++) {
        const struct root_group *group = &set->groups[g];
        for (size_t i = group->first; i < group->first + group->count; i++) {
            values[i] = HUGE_VAL;
            rates[i] = 0;
            if (!group->idle) values[i] = affine_value(&watchers->affine[i], y, dy, &rates[i]);
        }
    }
    return watchers->all_affine;
}

void watchers_follow(struct watchers *watchers, const struct fbd_state *state)
{
    struct watcher_set *set = &watchers->moving;
    watchers_hold(watchers, state);
    for (size_t g = 0; g < set->group_count; g++)
        set->groups[g].idle = is_idle(state, &set->watchers[set->groups[g].first]);
    follow_affine(watchers, state);
    if (!state->sliding) return;
    bool known = !state_sliding(state) || enclosure_has_weights(state);
    for (size_t g = 0; g < set->group_count; g++)
        set->groups[g].proved = is_enclosed(state, &set->watchers[set->groups[g].first], known);
}
