/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch/row_words.h"

#include <stdlib.h>
#include <string.h>

#include "dynamics/contact.h"

static const char *const words[] = {"slips", "lifts", "tips"};
enum { word_count = sizeof words / sizeof *words };

int row_word_find(const char *name)
{
    for (int i = 0; i < word_count; i++)
        if (strcmp(words[i], name) == 0) return word_slips + i;
    return -1;
}

const char *row_word_name(enum row_word word)
{
    return words[word - word_slips];
}

/* ---- notes */

static bool add(struct word_log *log, double t, enum row_word word, int body)
{
    if (body < 0) return true; /* the ground */
    if (log->count == log->room) {
        size_t room = log->room ? 2 * log->room : 16;
        struct word_note *larger = realloc(log->notes, room * sizeof *larger);
        if (!larger) return false;
        log->notes = larger;
        log->room = room;
    }
    log->notes[log->count++] = (struct word_note){t, word, body};
    return true;
}

/* Both bodies of a coupling. */
static bool add_both(struct word_log *log, double t, enum row_word word, const struct coupling *coupling)
{
    return add(log, t, word, coupling->end[0].body) && add(log, t, word, coupling->end[1].body);
}

static const struct coupling *coupling_of_mode(const struct fbd_model *model, size_t index)
{
    int coupling = model->plan.modes[index].coupling;
    return coupling < 0 ? NULL : &model->tree->couplings[coupling];
}

/* ---- the start */

/* Friction that slips at the start; that of an open contact does not exist. */
static bool note_friction(struct word_log *log, const struct fbd_state *state, size_t index)
{
    const struct mode *mode = &state->model->plan.modes[index];
    const struct coupling *coupling = coupling_of_mode(state->model, index);
    if (!mode_is_friction(mode) || slip_side(state->slip[index]) == 0) return true;
    if (!coupling) return add(log, 0, word_slips, mode->body);
    const bool open = coupling->surface >= 0 && state->slip[coupling->surface] != stick;
    return open || add_both(log, 0, word_slips, coupling);
}

/* Is another feature of the same contact pair closed? */
static bool stays_beside(const struct fbd_state *state, const struct coupling *coupling)
{
    const struct tree *tree = state->model->tree;
    if (coupling->meeting < 0) return false;
    const struct meeting *meeting = &tree->meetings[coupling->meeting];
    for (int k = 0; k < meeting->coupling_count; k++) {
        const struct coupling *other = &tree->couplings[meeting->first_coupling + k];
        if (other != coupling && state->slip[other->surface] == stick) return true;
    }
    return false;
}

static bool note_lift(struct word_log *log, double t, const struct fbd_state *state,
                      const struct coupling *coupling)
{
    return add_both(log, t, word_lifts, coupling) &&
           (!stays_beside(state, coupling) || add_both(log, t, word_tips, coupling));
}

/* A surface that was closed before the modes were settled, and is open after. */
static bool note_surface(struct word_log *log, const struct fbd_state *touching,
                         const struct fbd_state *state, size_t index)
{
    const enum mode_kind kind = state->model->plan.modes[index].kind;
    if (kind != mode_contact && kind != mode_surface) return true;
    if (touching->slip[index] != stick || state->slip[index] == stick) return true;
    return note_lift(log, 0, state, coupling_of_mode(state->model, index));
}

static bool note_start(struct word_log *log, struct ensemble *run, struct fbd_state *probe)
{
    struct fbd_state *touching = state_new(run->model);
    bool fine = touching && ensemble_look(run, run->from, probe);
    for (size_t i = 0; fine && i < run->model->plan.mode_count; i++)
        fine = note_friction(log, probe, i) && note_surface(log, touching, probe, i);
    state_free(touching);
    return fine;
}

/* ---- events */

/* The contact or surface of an event: that of the same load and body, if possible one that is open while its
 * contact pair stays closed beside it. NULL without one. */
static const struct coupling *coupling_of_event(const struct fbd_state *state, const struct run_event *event)
{
    const struct tree *tree = state->model->tree;
    const struct coupling *found = NULL;
    for (int i = 0; event->load >= 0 && i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->load != event->load || coupling->end[0].body != event->body) continue;
        const bool open = coupling->surface >= 0 && state->slip[coupling->surface] != stick;
        if (!found || (open && stays_beside(state, coupling))) found = coupling;
    }
    return found;
}

static bool note_event(struct word_log *log, struct ensemble *run, const struct run_event *event)
{
    const bool slips = event->kind == FBD_EVENT_BREAKAWAY, lifts = event->kind == FBD_EVENT_LIFT_OFF;
    if (event->kind == FBD_EVENT_CONTACT_LOST) return add(log, event->t, word_lifts, event->body);
    if (!slips && !lifts) return true;
    const struct fbd_state *state = ensemble_state(run);
    const struct coupling *coupling = coupling_of_event(state, event);
    if (!coupling) return add(log, event->t, slips ? word_slips : word_lifts, event->body);
    return slips ? add_both(log, event->t, word_slips, coupling) : note_lift(log, event->t, state, coupling);
}

bool word_log_step(struct word_log *log, struct ensemble *run, struct fbd_state *probe)
{
    if (!log->started && run->t > run->from) {
        log->started = true;
        if (!note_start(log, run, probe)) return false;
        log->at_start = log->count;
    }
    for (; log->seen < run->event_count; log->seen++)
        if (!note_event(log, run, &run->events[log->seen])) return false;
    return true;
}

void word_log_restart(struct word_log *log)
{
    log->count = log->at_start = log->seen = 0;
    log->started = false;
}

void word_log_free(struct word_log *log)
{
    free(log->notes);
    *log = (struct word_log){0};
}
