/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The entries of the log of events.
 */
#include "dynamics/friction.h"
#include "loop/run.h"

#include <stdlib.h>

struct run_event *log_event(struct run *run, fbd_event_kind kind, int body, int load, int watch)
{
    if (run->log.count == run->log.room) {
        size_t room = run->log.room ? 2 * run->log.room : 16;
        struct run_event *events = realloc(run->log.events, room * sizeof *events);
        if (!events) {
            run_fail(run, FBD_OUT_OF_MEMORY, "out of memory");
            return NULL;
        }
        run->log.events = events;
        run->log.room = room;
    }
    struct run_event *event = &run->log.events[run->log.count++];
    *event = (struct run_event){.t = run_time(run),
                                .delay = run->delay,
                                .kind = kind,
                                .body = body,
                                .load = load,
                                .watch = watch,
                                .own = -1};
    return event;
}

void log_friction(struct run *run, fbd_event_kind kind, int pair)
{
    const struct mode *mode = &run->model->plan.modes[pair];
    struct run_event *event = log_event(run, kind, mode->body, mode->load, -1);
    if (!event) return;
    struct instant at = state_instant(run->state);
    const double *slots = run->state->slots;
    if (!run->model->bodies[mode->body].alone) {
        slots = run->during->scratch;
        state_balance_of(run->state, mode->body, run->during->scratch); /* includes indeterminate forces */
    }
    struct friction_values values = friction_at(run->model, pair, &at, slots);
    event->force = values.force;
    event->limit = values.limit;
}

void log_set_filippov(const struct run *run, const struct kink *kink, fbd_event_kind kind,
                      struct run_event *event)
{
    const struct formula *value = &run->model->loads[kink->load].value;
    const struct instant at = state_instant(run->state);
    if (!event) return;
    event->kind = kind;
    event->limit = value->expr && value->branch == kink->formula.branch;
    if (event->limit > 0) event->force = formula_value(value, &at);
}

void log_filippov(struct run *run, const struct kink *kink, fbd_event_kind kind)
{
    log_set_filippov(run, kink, kind, log_event(run, kind, kink->body, kink->load, -1));
}
