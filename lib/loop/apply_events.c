/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Apply an event: branches change, friction sticks, breaks away or reverses, contacts are lost, user events
 * are logged.
 */
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/energy.h"
#include "dynamics/friction.h"
#include "dynamics/modes.h"
#include "dynamics/nonfinite.h"
#include "dynamics/project.h"
#include "dynamics/tree.h"
#include "loop/run.h"
#include "loop/switch_event.h"
#include "loop/zeno.h"
#include "numeric/tolerances.h"
#include "rest/start.h"

/* ---- events by kind */

/* The weight of a branch in a Filippov sliding mode has reached its limit: leave the mode, with all switches
 * on the same surface, to the branch on that side. */
static void leave_surface(struct run *run, const struct watcher *watcher)
{
    struct sliding *s = run->state->sliding;
    int branch = run->model->plan.kinks[watcher->index].formula.branch + watcher->part;
    if (s->slide_at[branch] == 0) return; /* already left with another switch */
    const struct slide first = s->slides[s->slide_at[branch] - 1];
    int side = (watcher->end == 0 ? -1 : 1) * first.sign;
    for (int j = s->count - 1; j >= 0; j--) {
        const struct slide slide = s->slides[j];
        if (slide.unit != first.unit) continue;
        run->state->branch[slide.branch] = side * slide.sign;
        run->decided.branches[slide.branch] = true;
        s->left[slide.branch] = true;
        run->zeno_switches.list[slide.branch].left = (struct leave){run->state->t, slide.slack};
        s->slide_at[slide.branch] = 0;
    }
    sliding_drop(s);
}

/* Set rates at round-off level, relative to their largest values, to zero. */
static void drop_rounding(struct run *run)
{
    size_t n = (size_t)run->model->plan.n;
    const double *most = run->recent.anchor + plan_size(&run->model->plan);
    for (size_t i = n; i < 2 * n; i++)
        if (fabs(run->state->y[i]) <= evaluation_rounding * most[i]) run->state->y[i] = 0;
}

/* Set the relative velocity to exactly zero, as the event implies; settling decides the modes. */
static void stop_slipping(struct run *run, int pair)
{
    const struct mode *mode = &run->model->plan.modes[pair];
    struct instant at = state_instant(run->state);
    double acceleration;
    if (mode->kind == mode_plane && plane_only_turns(run, pair)) return;
    if (mode->coupling >= 0) {
        run->state->slip[pair] = stick;
        if (mode->kind == mode_plane) plane_stop_with(run, pair);
        state_project_velocity(run->state, false);
        drop_rounding(run);
        if (mode->kind == mode_plane) plane_drop_rounding(run, pair);
        return;
    }
    run->state->y[run->model->plan.n + mode->coordinate] = friction_surface_speed(mode, &at, &acceleration);
}

/* Impulses in the strands of a rope around a drum are not modelled. */
static bool refuse_jerk(struct run *run, int pair)
{
    const struct tree *tree = run->model->tree;
    const struct coupling *coupling = &tree->couplings[run->model->plan.modes[pair].coupling];
    if (coupling->kind != constraint_capstan) return false;
    run_fail(run, FBD_BROKEN,
             "at t = %.9g the rope `%s` becomes taut round its drum: the friction in this impact cannot be "
             "computed. End the run earlier by an event",
             run_time(run), coupling->name);
    return true;
}

/* A point lands on its slot. A roller that hits an end of the slot is refused. */
static bool refuse_end_of_slot(struct run *run, int pair)
{
    const int index = run->model->plan.modes[pair].coupling;
    const struct coupling *coupling = &run->model->tree->couplings[index];
    if (!slot_is_open(coupling, run->state->slip)) return false;
    bool beyond = false;
    for (int end = 0; end < 2; end++) {
        const struct room room = coupling_room(run->model, run->state->tree, index, end);
        beyond |= room.left < -slot_rounding * room.size;
    }
    if (!beyond) return false;
    run_fail(run, FBD_BROKEN,
             "at t = %.9g the point of the slot `%s` hits the end of the slot, or returns behind it. Make it "
             "longer, or end the run earlier by an event",
             run_time(run), coupling->name);
    return true;
}

/* A constraint that opens is left to settling. A rope that becomes taut, or a contact that lands, stops the
 * velocity that would violate it: a plastic impact, with the impulses on all other constraints. */
static void one_sided_event(struct run *run, int pair)
{
    if (run->state->slip[pair] == stick) {
        run->state->slip[pair] = slip_plus;
        run->decided.slips[pair] = true;
        return;
    }
    if (refuse_end_of_slot(run, pair) || refuse_jerk(run, pair)) return;
    const struct mode *mode = &run->model->plan.modes[pair];
    const double before = total_kinetic_energy(run->state), taken = run->impact_work[mode->load];
    run->state->slip[pair] = stick;
    run_strike_closed(run);
    state_project_velocity(run->state, false); /* rounding only */
    drop_rounding(run);
    run->snap.pair = pair;
    run->snap.work = mode->kind == mode_rope ? total_kinetic_energy(run->state) - before
                                             : run->impact_work[mode->load] - taken;
}

/* Does the user event count in the present direction of crossing? */
static bool counts_now(const struct run *run, int watch)
{
    int direction = run->model->plan.watches[watch].source->direction;
    return direction == 0 || direction == -run->watchers.armed[watch];
}

static bool fired_now(const struct run *run, int watch)
{
    const double instant = round_off(64, fabs(run->state->t));
    return fabs(run->watchers.fired[watch] - run->state->t) <= instant;
}

/* `touched`: the function is exactly zero and may get either sign; otherwise it has changed its sign. */
static void user_event(struct run *run, int watch, bool touched)
{
    const struct user_event *source = run->model->plan.watches[watch].source;
    bool counts = counts_now(run, watch);
    run->watchers.armed[watch] = touched ? 0 : -run->watchers.armed[watch];
    run->watchers.fired[watch] = run->state->t;
    if (!counts) return;
    if (watch_of_lifetime(source)) {
        run_change_lifetime(run, watch);
        return;
    }
    log_event(run, FBD_EVENT_USER, -1, -1, watch);
    if (source->stop && run->end.outcome == FBD_GOING) run->end.outcome = FBD_STOPPED;
}

/* Is one of the user events that have crossed the end of the run, or the end or begin of a force or coupling? */
static bool stops(const struct run *run)
{
    const struct watcher_set *set = &run->watchers.moving;
    for (size_t i = 0; i < set->count; i++) {
        int index = set->watchers[i].index;
        if (!run->search.moving.crossed[i] || set->watchers[i].kind != watch_user) continue;
        const struct user_event *source = run->model->plan.watches[index].source;
        if ((source->stop || watch_of_lifetime(source)) && counts_now(run, index)) return true;
    }
    return false;
}

bool log_user_events(struct run *run, double t)
{
    const struct watcher_set *set = &run->watchers.moving;
    if (stops(run)) return false;
    for (size_t i = 0; i < set->count; i++) {
        if (!run->search.moving.crossed[i] || set->watchers[i].kind != watch_user) continue;
        int watch = set->watchers[i].index;
        struct run_event *event =
            counts_now(run, watch) ? log_event(run, FBD_EVENT_USER, -1, -1, watch) : NULL;
        if (event) event->t = t;
        watchers_turn(&run->watchers, watch);
        run->watchers.fired[watch] = t;
    }
    return true;
}

/* Does a point on a plane stop, or reach its limit? */
static bool any_on_plane(const struct run *run, const bool *crossed, enum watcher_kind kind)
{
    const struct watcher_set *set = &run->watchers.moving;
    bool any = false;
    for (size_t i = 0; crossed && i < set->count; i++)
        any |= crossed[i] && set->watchers[i].kind == kind &&
               mode_of(run->state, set->watchers[i].index)->kind == mode_plane;
    return any;
}

/* `crossing`: an expression changes its branch at the same instant, or a point on a plane stops. A force that reaches its
 * limit there may decrease again beyond it, so the forces after the event decide (in settling), not the crossing of the
 * limit, which may be a rounding error. */
static void happen(struct run *run, const struct watcher *watcher, bool crossing)
{
    int index = watcher->index;
    switch (watcher->kind) {
    case watch_kink: switch_cross(run, watcher); break;
    case watch_stick_limit:
        if (crossing || tree_give_shared(run->state, index, &run->decided)) break;
        run->state->slip[index] =
            watcher->end == 0 && mode_of(run->state, index)->kind != mode_plane ? slip_minus : slip_plus;
        run->decided.slips[index] = true;
        break;
    case watch_slip_stop: stop_slipping(run, index); break;
    case watch_normal_turns:
        if (run->state->slip[index] != stick && tree_give_shared(run->state, index, &run->decided)) break;
        run_turn_normal(run, index);
        break;
    case watch_one_sided:
        if (run->state->slip[index] == stick && tree_give_shared(run->state, index, &run->decided)) break;
        one_sided_event(run, index);
        break;
    case watch_lift:
        if (tree_give_shared(run->state, index, &run->decided)) break;
        run->state->slip[index] = slip_plus;
        run->decided.slips[index] = true;
        break;
    case watch_gap:
    case watch_edge: run->contacts.due = true; break;
    case watch_share: leave_surface(run, watcher); break;
    case watch_contact: break; /* run_check_contacts */
    case watch_user:
        if (!fired_now(run, index)) user_event(run, index, false);
        break;
    }
}

/* ---- after the modes have settled */

/* Has the event of the loss of a contact occurred, while its normal force is still zero to the rounding of
 * the time? */
static bool is_just_lost(struct run *run, const bool *moving, int contact, double N, double slack)
{
    const struct watcher_set *set = &run->watchers.moving;
    const double instant = round_off(64, fabs(run->state->t));
    double *values = run->work.values, *rates = values + set->count;
    for (size_t i = 0; moving && i < set->count; i++) {
        if (!moving[i] || set->watchers[i].kind != watch_contact || set->watchers[i].index != contact)
            continue;
        watchers_evaluate(&run->watchers, set, run->state, state_moment(run->state), run->state->y, NULL,
                          values, rates);
        return rates[i] < 0 && N <= slack - rates[i] * instant;
    }
    return false;
}

void run_check_contacts(struct run *run, const bool *moving)
{
    const struct fbd_model *model = run->model;
    for (size_t i = 0; i < model->plan.contact_count; i++) {
        const struct contact *contact = &model->plan.contacts[i];
        if (contact->pair >= 0) continue;
        double N = -run->state->slots[contact->slot],
               slack = watchers_contact_slack(model, run->state->tree, contact);
        if (N >= -slack && !is_just_lost(run, moving, (int)i, N, slack)) continue;
        struct run_event *event = log_event(run, FBD_EVENT_CONTACT_LOST, contact->body, contact->load, -1);
        if (event) event->force = fmin(N, 0), event->limit = slack;
        struct text words = {0};
        if (!isfinite(N)) {
            run_fail(run, FBD_FAILED, "the normal force of `%s` is not finite at t = %.9g: %s",
                     model->bodies[contact->body].name, run->state->t, nonfinite_reason(N));
            continue;
        }
        start_contact_words(model, contact, run->state->t, fmin(N, 0), &words);
        run_fail(run, words.failed ? FBD_OUT_OF_MEMORY : FBD_BROKEN, "%s",
                 words.failed ? "out of memory" : words.data);
        text_free(&words);
    }
}

void run_apply_touched(struct run *run, bool at_event)
{
    const struct plan *plan = &run->model->plan;
    struct instant at = state_instant(run->state);
    for (size_t i = 0; i < plan->watch_count; i++) {
        int armed = run->watchers.armed[i];
        bool fired = fired_now(run, (int)i);
        double value =
            formula_value(&plan->watches[i].left, &at) - formula_value(&plan->watches[i].right, &at);
        double band = at_event && value == 0 ? 0 : run->watchers.band[i];
        if (fired && value == 0) run->watchers.armed[i] = 0; /* it may leave to either side */
        if (armed != 0 && !fired && armed * value + band <= 0) user_event(run, (int)i, value == 0);
    }
}

static bool any_switch(const struct watcher_set *set, const bool *crossed)
{
    bool any = false;
    for (size_t i = 0; crossed && i < set->count; i++)
        any |= crossed[i] && set->watchers[i].kind == watch_kink;
    return any;
}

/* Fail at a switch that was just crossed and whose new branch leads back across it, by more than rounding
 * within a step: the forces on both sides point to the switch. The motion would be a Filippov sliding mode,
 * which no branch describes. */
static void refuse_sliding(struct run *run, const bool *moving)
{
    const double roundings = 1e3; /* at a turning point the rate may have either sign */
    const struct watcher_set *set = &run->watchers.moving;
    size_t modes = run->model->plan.mode_count * sizeof *run->state->slip;
    if (!moving || run->end.outcome != FBD_GOING || !any_switch(set, moving)) return;
    if (memcmp(run->state->slip, run->during->slip, modes) != 0) return; /* other forces act now */
    double *values = run->work.values, *rate = values + set->count;
    watchers_evaluate(&run->watchers, set, run->state, state_moment(run->state), run->state->y, NULL, values,
                      rate);
    for (size_t i = 0; i < set->count; i++) {
        const struct watcher *watcher = &set->watchers[i];
        if (!moving[i] || watcher->kind != watch_kink) continue;
        const struct formula *formula = &run->model->plan.kinks[watcher->index].formula;
        const struct expr *expr = formula->expr;
        int branch = formula->branch + watcher->part;
        if (run->state->branch[branch] == run->during->branch[branch])
            continue; /* another switch has reversed it */
        if (expr_switch_remembers(expr, (size_t)watcher->part))
            continue; /* with hysteresis the other threshold is elsewhere */
        if (!expr_switch_jumps(expr, (size_t)watcher->part)) continue; /* rates are the same on both sides */
        /* The reverse crossing of the same switch. */
        for (size_t k = 0; k < set->count; k++) {
            const struct watcher *back = &set->watchers[k];
            bool same =
                back->kind == watch_kink && back->index == watcher->index && back->part == watcher->part;
            if (!same || back->end == watcher->end || !(rate[k] < 0)) continue;
            const struct kink *kink = &run->model->plan.kinks[watcher->index];
            double rounding = sliding_rounding(run->state, kink, watcher->part);
            if (-rate[k] * run->step.longest <= roundings * rounding) continue;
            const char *name = run_kink_name(run, kink);
            run_fail_chatter_of(run, kink->load, kink->own >= 0, name ? name : "an event");
        }
    }
}

/* Fail after too many events at one instant: an undeclared sliding mode, or an infinite sequence. At the
 * start, before any step, the instant is relative to the first proposed step. */
static void count_crowd(struct run *run)
{
    enum { most_at_once = 200 };
    run->step.longest = fmax(run->step.longest, run->state->t - run->step.from);
    bool crowded = run->state->t - run->recent.time <= run_instant(run) ||
                   fabs(run->state->t) <= negligible_sum * run->step.first;
    run->recent.crowd = crowded ? run->recent.crowd + 1 : 0;
    if (!crowded) run->recent.turns = 0;
    run->recent.time = run->state->t;
    if (run->recent.crowd < most_at_once || run->end.outcome != FBD_GOING) return;
    run_fail_chatter(run);
}

/* Fail where a motion crosses a switch ever slower and ever more often, as a body attracted to a point by a
 * force of constant magnitude, with a damper: more than 100000 events while coordinates stay within a part in
 * a million, and speeds in a thousand, of their earlier sizes. */
static void count_around(struct run *run)
{
    enum { most_around = 100000 };
    const double place = distinct_part, speed = 1e-3;
    size_t n = (size_t)run->model->plan.n, size = plan_size(&run->model->plan);
    double *anchor = run->recent.anchor;
    const double *most = anchor + size;
    bool away = false;
    for (size_t i = 0; i < size; i++) {
        double y = run->state->y[i];
        bool rate = i >= n && i < 2 * n;
        away |= rate ? fabs(y) > speed * most[i] : fabs(y - anchor[i]) > place * most[i];
    }
    if (away) memcpy(anchor, run->state->y, size * sizeof *anchor);
    run->recent.around = away ? 0 : run->recent.around + 1;
    if (run->recent.around > most_around && run->end.outcome == FBD_GOING) run_fail_chatter(run);
}

void run_fail_unsettled(struct run *run)
{
    const struct sliding *s = run->state->sliding;
    int kink = s && s->why ? s->blamed : -1, load = kink >= 0 ? run->model->plan.kinks[kink].load : -1;
    if (load >= 0) {
        run_fail(run, FBD_FAILED, "at t = %.9g `%s` is at its switch, and %s", run_time(run),
                 run->model->loads[load].source->name, s->why);
        return;
    }
    struct text when = {0}, words = {0};
    bool memory = run->state->holds.found != holds_no_memory;
    text_add(&when, "at t = ");
    text_number(&when, run_time(run), 9);
    if (memory && !when.failed) unsettled_words(run->state, when.data, &words);
    memory = memory && !when.failed && !words.failed;
    run_fail(run, memory ? FBD_FAILED : FBD_OUT_OF_MEMORY, "%s", memory ? words.data : "out of memory");
    text_free(&when);
    text_free(&words);
}

void log_several(struct run *run)
{
    const struct holds_trouble *holds = &run->state->holds;
    if (holds->found != holds_several || holds->pair < 0) return;
    const struct mode *mode = &run->model->plan.modes[holds->pair];
    struct run_event *event = log_event(run, FBD_EVENT_SEVERAL, mode->body, mode->load, -1);
    if (event) event->force = holds->answer;
}

/* After a jam the slips have changed, so other contacts may jam. */
static bool settle(struct run *run)
{
    enum { most_jams = 8 };
    for (int jam = 0;; jam++) {
        if (modes_settle(run->state, &run->decided)) {
            log_several(run);
            return true;
        }
        bool no_forces = run->state->holds.found == holds_none || run->state->holds.found == holds_lost;
        bool jams = no_forces && run->end.outcome == FBD_GOING && jam < most_jams;
        if (!jams || !run_jam(run)) return false;
    }
}

/* Project constraints that have closed at rest within the touching tolerance onto their surfaces; sticking
 * ones may move by as much. Steps do not move sticking coordinates, and would violate the other closed
 * constraints. */
static void close_up(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    const struct instant at = state_instant(run->state);
    bool apart = false;
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        enum mode_kind kind = plan->modes[pair].kind;
        if (kind != mode_rope && kind != mode_surface) continue;
        if (run->state->slip[pair] != stick || run->during->slip[pair] == stick) continue;
        const int coupling = plan->modes[pair].coupling;
        struct one_sided now = one_sided_at(run->model, &at, pair);
        apart |= fabs(now.excess) > now.rounding;
        /* A wheel that rotated in the air rolls on from its present angle. */
        if (run->model->tree->couplings[coupling].row_count > 1 && kind == mode_surface)
            coupling_rezero(run->model, run->state->tree, coupling);
    }
    if (!apart) return;
    state_project_position(run->state);
    state_evaluate(run->state);
}

static void apply_once(struct run *run, const bool *timed, const bool *moving)
{
    const struct plan *plan = &run->model->plan;
    const struct watcher_set *sets[] = {&run->watchers.timed, &run->watchers.moving};
    const bool *crossed[] = {timed, moving};
    const bool crossing = any_switch(&run->watchers.timed, timed) ||
                          any_switch(&run->watchers.moving, moving) ||
                          any_on_plane(run, moving, watch_slip_stop) ||
                          (any_on_plane(run, moving, watch_stick_limit) && planes_stop_slow(run));
    memset(run->decided.branches, 0, ((size_t)plan->branches + 3 * plan->mode_count) * sizeof(bool));
    contacts_begin_events(run);
    rest_held(run);
    size_t first = run->log.count;
    for (int s = 0; s < 2; s++)
        for (size_t i = 0; crossed[s] && i < sets[s]->count; i++)
            if (crossed[s][i]) happen(run, &sets[s]->watchers[i], crossing);
    zeno_switch_end(run);
    run->ended = false; /* settling follows */
    if (run->contacts.due) run_contacts(run);
    run->contacts.due = false;
    if (!settle(run) && run->end.outcome == FBD_GOING) run_fail_unsettled(run);
    if (moving) watchers_count_stops(&run->watchers, moving, run->during, run->state);
    run_check_drives(run);
    run_check_counts(run);
    log_mode_changes(run, first, moving);
    if (run->end.outcome == FBD_GOING) close_up(run); /* sticking starts at these positions */
    run_release_contacts(run);
    refuse_sliding(run, moving);
    run_apply_touched(run, true);
    run_check_contacts(run, moving);
    run_check_pulleys(run);
    run_check_ends(run);
    run->step.restart = true;
    run->recent.interval[1] = run->recent.interval[0];
    run->recent.interval[0] = time_dd_since(run_end(run), run->recent.moment);
    run->recent.moment = run_end(run);
    if (run->end.outcome == FBD_GOING) count_crowd(run);
    if (moving) count_around(run);
}

void run_apply(struct run *run, const bool *timed, const bool *moving)
{
    apply_once(run, timed, moving);
    run_apply_endings(run);
}

void run_apply_endings(struct run *run)
{
    if (!run->kept_modes) return;
    state_copy(run->kept_modes, run->during);
    while (run_change_lifetimes(run)) { /* each begins and ends once */
        state_copy(run->during, run->state);
        apply_once(run, NULL, NULL);
    }
    state_copy(run->during, run->kept_modes);
}
