/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/event_states.h"

#include <stdlib.h>

struct event_state {
    size_t group, order; /* of the event in the log of its group */
    double *y;
};

/* The entry for the state at one more event; NULL when memory is out. */
static struct event_state *next_place(struct event_states *kept, const struct ensemble *ensemble,
                                      size_t group)
{
    size_t of_group = 0, last = 0;
    for (size_t i = 0; i < kept->count; i++) {
        if (kept->states[i].group != group) continue;
        of_group++;
        last = i;
    }
    if (of_group > most_event_states) return &kept->states[last];
    if (kept->count == kept->room) {
        size_t room = kept->room ? 2 * kept->room : 16;
        struct event_state *states = realloc(kept->states, room * sizeof *states);
        if (!states) return NULL;
        kept->states = states;
        kept->room = room;
    }
    double *y = calloc(plan_size(&ensemble->model->plan), sizeof *y);
    if (!y) return NULL;
    kept->states[kept->count] = (struct event_state){.y = y};
    return &kept->states[kept->count++];
}

bool event_states_note(struct event_states *kept, struct ensemble *ensemble, size_t group)
{
    const struct event_log *log = &ensemble->groups[group].run->log;
    if (!kept->seen) kept->seen = calloc(ensemble->count, sizeof *kept->seen);
    if (!kept->seen) return false;
    for (; kept->seen[group] < log->count; kept->seen[group]++) {
        const struct run_event *event = &log->events[kept->seen[group]];
        if (event->kind != FBD_EVENT_USER) continue;
        struct event_state *state = next_place(kept, ensemble, group);
        if (!state) return false;
        state->group = group;
        state->order = kept->seen[group];
        if (!ensemble_group_coordinates(ensemble, group, time_dd_at(event->t), state->y))
            state->order = SIZE_MAX;
    }
    return true;
}

void event_states_restart(struct event_states *kept, size_t group)
{
    size_t count = 0;
    if (kept->seen) kept->seen[group] = 0;
    for (size_t i = 0; i < kept->count; i++) {
        if (kept->states[i].group == group)
            free(kept->states[i].y);
        else
            kept->states[count++] = kept->states[i];
    }
    kept->count = count;
}

const double *event_states_find(const struct event_states *kept, const struct run_event *event)
{
    for (size_t i = 0; i < kept->count; i++)
        if (kept->states[i].group == event->group && kept->states[i].order == event->order)
            return kept->states[i].y;
    return NULL;
}

void event_states_free(struct event_states *kept)
{
    for (size_t i = 0; i < kept->count; i++) free(kept->states[i].y);
    free(kept->states);
    free(kept->seen);
}
