/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Log of events by comparison of the modes before and after.
 */
#include "dynamics/constraint.h"
#include "loop/run.h"

/* ---- friction and one-sided constraints */

/* Modes of a pair before and after. */
struct change {
    int pair, before, after;
    const bool *moving; /* the functions that have crossed, or NULL */
};

/* The excess of an open constraint that is at round-off level, so that rounding at another position does not
 * close it; else 0. */
static double left_beyond(const struct run *run, int pair)
{
    const struct instant at = state_instant(run->state);
    if (run->state->slip[pair] == stick) return 0;
    const struct one_sided now = one_sided_at(run->model, &at, pair);
    return now.excess > 0 && now.excess <= now.near ? now.excess : 0;
}

static void note_one_sided(struct run *run, const struct change *change)
{
    const struct mode *mode = &run->model->plan.modes[change->pair];
    /* The begin and the end of a coupling have events of their own. */
    if (mode_has_ended(run->state, change->pair) || mode_has_ended(run->during, change->pair)) return;
    run->watchers.quiet[change->pair] = left_beyond(run, change->pair);
    bool rope = run->model->tree->couplings[mode->coupling].law->way;
    if (change->before == stick && change->after != stick)
        log_event(run, rope ? FBD_EVENT_ROPE_SLACK : FBD_EVENT_LIFT_OFF, mode->body, mode->load, -1);
    bool snapped = run->snap.pair == change->pair;
    if (snapped) run->snap.pair = -1;
    if (!snapped && (change->before == stick || change->after != stick)) return;
    if (!snapped && run->end.outcome == FBD_BROKEN)
        return; /* an impact at which the run ends is not listed */
    if (snapped && !isfinite(run->snap.work)) {
        run_fail(run, FBD_FAILED, "at t = %.9g the work of the impact in which `%s` becomes taut overflows",
                 run_time(run), run->model->tree->couplings[mode->coupling].name);
        return;
    }
    struct run_event *event =
        log_event(run, rope ? FBD_EVENT_ROPE_TAUT : FBD_EVENT_LANDING, mode->body, mode->load, -1);
    if (!event) return;
    event->force = snapped ? -run->snap.work : 0;
    event->impact = run->contacts.of_couplings[mode->coupling];
}

void log_lifts_at_start(struct run *run)
{
    const struct instant at = state_instant(run->state);
    for (int pair = 0; pair < (int)run->model->plan.mode_count; pair++) {
        const struct mode *mode = &run->model->plan.modes[pair];
        if (mode->kind != mode_surface || run->model->tree->couplings[mode->coupling].meeting >= 0) continue;
        if (run->state->slip[pair] != stick && one_sided_at(run->model, &at, pair).touches)
            log_event(run, FBD_EVENT_LIFT_OFF, mode->body, mode->load, -1);
    }
}

/* Was the surface of the friction closed before and after? Otherwise friction has no event of its own. */
static bool rubbed_throughout(const struct run *run, const struct mode *mode)
{
    const struct coupling *coupling =
        mode->coupling < 0 ? NULL : &run->model->tree->couplings[mode->coupling];
    if (!coupling || coupling->meeting < 0) return true;
    return run->during->slip[coupling->surface] == stick && run->state->slip[coupling->surface] == stick;
}

/* Has its velocity become zero? */
static bool has_stopped(const struct run *run, const struct change *change)
{
    const struct watcher_set *set = &run->watchers.moving;
    for (size_t i = 0; change->moving && i < set->count; i++)
        if (change->moving[i] && set->watchers[i].kind == watch_slip_stop &&
            set->watchers[i].index == change->pair)
            return true;
    return false;
}

static void note_rubbing(struct run *run, const struct change *change)
{
    const struct mode *mode = &run->model->plan.modes[change->pair];
    int pair = change->pair, before = change->before, after = change->after;
    if (mode_has_ended(run->state, pair)) return;
    if (!rubbed_throughout(run, mode)) return;
    if (before == stick && after != stick) {
        zeno_switch_log_stick(run, pair);
        log_friction(run, FBD_EVENT_BREAKAWAY, pair);
    }
    if (before != stick && after == stick) {
        if (mode->coupling >= 0) coupling_rezero(run->model, run->state->tree, mode->coupling);
        if (run->zeno_switches.now)
            run->zeno_switches.sticks[pair] = true; /* logged at the limit of the series */
        else
            log_friction(run, FBD_EVENT_STICK, pair);
    }
    if (after != stick && after != before && has_stopped(run, change))
        log_friction(run, FBD_EVENT_REVERSAL, pair);
}

/* By kind; a drive has no events, and those of a contact are logged by run_release_contacts. */
static void (*const note[mode_kinds])(struct run *run, const struct change *change) = {
    [mode_single] = note_rubbing, [mode_joint] = note_rubbing,  [mode_tangent] = note_rubbing,
    [mode_plane] = note_rubbing,  [mode_rope] = note_one_sided, [mode_surface] = note_one_sided};

/* Log the changes of each pair by its modes before and after, whichever event was the cause. */
static void note_frictions(struct run *run, const bool *moving)
{
    for (int pair = 0; pair < (int)run->model->plan.mode_count; pair++) {
        const struct change change = {pair, run->during->slip[pair], run->state->slip[pair], moving};
        enum mode_kind kind = run->model->plan.modes[pair].kind;
        if (note[kind]) note[kind](run, &change);
    }
}

/* ---- switches */

/* Remove events of switches that were reached but whose branch is unchanged. */
static void drop_touched(struct run *run, size_t first)
{
    size_t kept = first;
    for (size_t i = first; i < run->log.count; i++) {
        const struct run_event *event = &run->log.events[i];
        bool same = event->kind == FBD_EVENT_SWITCH &&
                    run->state->branch[event->branch] == run->during->branch[event->branch];
        bool slid_on = same && run->state->sliding && run->state->sliding->slide_at[event->branch] > 0;
        if (!same || slid_on) run->log.events[kept++] = *event;
    }
    run->log.count = kept;
}

/* Log sliding modes by comparison of the modes before and after, too. A switch event of the same instant
 * (from index `first`) is replaced by the begin of a sliding mode. */
static void note_slides(struct run *run, size_t first)
{
    const struct plan *plan = &run->model->plan;
    for (size_t k = 0; run->state->sliding && k < plan->kink_count; k++) {
        const struct kink *kink = &plan->kinks[k];
        for (size_t part = 0; part < kink->count; part++) {
            size_t branch = (size_t)kink->formula.branch + part;
            bool before = run->during->sliding->slide_at[branch] > 0,
                 after = run->state->sliding->slide_at[branch] > 0;
            if (before == after) continue;
            if (after) zeno_switch_blunt(run, (int)branch);
            bool *waits = &run->zeno_switches.list[branch].slides; /* for the limit of the series */
            if ((run->zeno_switches.now && after) || *waits) {
                *waits = after;
                continue;
            }
            struct run_event *event = NULL;
            for (size_t i = first; after && i < run->log.count; i++)
                if (run->log.events[i].kind == FBD_EVENT_SWITCH && run->log.events[i].load == kink->load)
                    event = &run->log.events[i];
            fbd_event_kind kind = after ? FBD_EVENT_SLIDING : FBD_EVENT_SLIDING_ENDS;
            if (event)
                log_set_filippov(run, kink, kind, event);
            else
                log_filippov(run, kink, kind);
        }
    }
}

void log_mode_changes(struct run *run, size_t first, const bool *moving)
{
    drop_touched(run, first);
    note_slides(run, first);
    note_frictions(run, moving);
}
