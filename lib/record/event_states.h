/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Event states: the coordinates and rates at the events of the file, for the report.
 */
#ifndef FBD_RECORD_EVENT_STATES_H
#define FBD_RECORD_EVENT_STATES_H

#include "loop/ensemble.h"

/* Limit for the first events of each group; its last event is kept besides, as a report lists no more. */
enum { most_event_states = 40 };

struct event_states {
    struct event_state *states;
    size_t count, room;
    size_t *seen; /* per group: number of processed log entries */
};

/* After a step of a group: keep the states at the file's events in it. False when memory is out. */
bool event_states_note(struct event_states *kept, struct ensemble *ensemble, size_t group);

/* The group is restarted: discard its states. */
void event_states_restart(struct event_states *kept, size_t group);

/* Coordinates and rates at an event, in the order of the whole scene; NULL if they were not kept. Those of
 * other groups are zero. */
const double *event_states_find(const struct event_states *kept, const struct run_event *event);

void event_states_free(struct event_states *kept);

#endif
