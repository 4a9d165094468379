/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "note/note.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"

/* ---- the note */

static void compose(struct making *making)
{
    static void (*const parts[])(struct making *) = {note_identity, note_system,   note_assumptions,
                                                     note_data,     note_diagrams, note_equations,
                                                     note_statics,  note_results,  note_plots,
                                                     note_checks,   note_limits,   note_file};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (!making->document->arena.failed && !making->refused) parts[i](making);
}

/* The statics of the start, if it is in equilibrium; other scenes have none, for whatever reason. */
static fbd_statics *statics_of(struct making *making)
{
    fbd_errors *others = fbd_errors_new();
    fbd_statics *statics = others ? fbd_statics_new(making->start, others) : NULL;
    making_end_list(making, others);
    if (fbd_statics_holds(statics)) return statics;
    fbd_statics_free(statics);
    return NULL;
}

static bool is_at_rest(const struct making *making)
{
    for (size_t i = 0; i < fbd_model_coordinate_count(making->model); i++) {
        double rate = 0;
        fbd_state_get(making->start, fbd_model_coordinate(making->model, i).rate_name, &rate);
        if (rate != 0) return false;
    }
    return true;
}

static bool begin(struct making *making)
{
    const size_t count = 2 * fbd_model_coordinate_count(making->model) + fbd_model_state_count(making->model);
    making->start = fbd_state_new_start(making->model);
    making->view = making->start ? fbd_view_new(making->start, making->list) : NULL;
    making->errors = calloc(count + 1, sizeof *making->errors);
    if (!making->view || !making->errors) return false;
    fbd_state_get(making->end, "t", &making->t);
    if (!fbd_simulation_errors(making->simulation, making->t, making->errors)) {
        making->document->arena.failed |= !isnan(making->stats.error_estimate); /* there are error bars */
        free(making->errors);
        making->errors = NULL;
    }
    if (is_at_rest(making)) making->statics = statics_of(making);
    const char *title = fbd_model_title(making->model);
    making->document->title =
        arena_printf(&making->document->arena, "Calculation note%s%s", title[0] ? ": " : "", title);
    return true;
}

static void end(struct making *making)
{
    fbd_view_free(making->view);
    fbd_statics_free(making->statics);
    fbd_state_free(making->start);
    free(making->errors);
    text_free(&making->text);
}

static fbd_note *make(struct making *making)
{
    making->note = calloc(1, sizeof *making->note);
    if (!making->note) return diag_out_of_memory(making->list), NULL;
    making->document = &making->note->document;
    if (begin(making))
        compose(making);
    else
        making->refused = true;
    if (making->document->arena.failed || (making->refused && fbd_errors_failed_count(making->list) == 0))
        diag_out_of_memory(making->list);
    const bool made = !making->document->arena.failed && !making->refused;
    end(making);
    if (made) return making->note;
    fbd_note_free(making->note);
    return NULL;
}

static bool is_admitted(const struct making *making)
{
    const fbd_outcome outcome = fbd_result_outcome(making->result);
    const bool ended = outcome == FBD_DONE || outcome == FBD_STOPPED || outcome == FBD_BROKEN;
    diag_in_file(making->list, fbd_model_file(making->model));
    if (!ended)
        diag_add(making->list, FBD_ERROR, "no-note", (struct pos){0, 0}, NULL,
                 "there is no calculation note of a run that did not come to its end: %s",
                 fbd_simulation_reason(making->simulation));
    else if (making->table.rows == 0)
        diag_add(making->list, FBD_ERROR, "not-recorded", (struct pos){0, 0}, NULL,
                 "a calculation note needs a run that was recorded with `table`");
    else
        return true;
    return false;
}

fbd_note *fbd_note_new(fbd_simulation *simulation, fbd_result *result, const fbd_note_options *options,
                       fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_note_options own = {0};
    fbd_note *note = NULL;
    struct making making = {.options = &own, .simulation = simulation, .result = result, .list = errors};
    if (!simulation || !result) {
        api_refuse(errors, "there is no simulation, or no result");
    } else if (api_take_options(&own, sizeof own, options, errors) &&
               (api_has_settings(own.settings, own.setting_count) ||
                api_refuse(errors, "a setting has no text"))) {
        making.end = fbd_result_state(result);
        making.model = fbd_state_model(making.end);
        making.stats = fbd_simulation_stats(simulation);
        making.table = fbd_result_table(result);
        if (is_admitted(&making)) note = make(&making);
    }
    diag_end(&call);
    return note;
}

void fbd_note_free(fbd_note *note)
{
    if (!note) return;
    arena_free(&note->document.arena);
    free(note);
}

char *fbd_note_write(const fbd_note *note, fbd_note_format format, const char *stem)
{
    struct text text = {0};
    if (!note) return NULL;
    switch (format) {
    case FBD_NOTE_HTML: write_html(&text, &note->document); break;
    case FBD_NOTE_MARKDOWN: write_markdown(&text, &note->document, stem ? stem : "note"); break;
    case FBD_NOTE_LATEX: write_latex(&text, &note->document, stem ? stem : "note"); break;
    default: return NULL;
    }
    if (text.failed) text_free(&text);
    return text.data;
}

size_t fbd_note_drawing_count(const fbd_note *note)
{
    return note ? note->document.pictures : 0;
}

const char *fbd_note_drawing(const fbd_note *note, size_t index)
{
    for (const struct block *block = note ? note->document.first : NULL; block; block = block->next)
        if (block->kind == block_picture && block->number == index + 1) return block->svg;
    return NULL;
}

size_t fbd_note_check_count(const fbd_note *note)
{
    return note ? note->checks : 0;
}

size_t fbd_note_failed_check_count(const fbd_note *note)
{
    return note ? note->failed_checks : 0;
}
