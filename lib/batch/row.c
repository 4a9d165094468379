/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One run of a sweep, and its row.
 */
#include "batch/row.h"
#include "base/format.h"
#include "base/number.h"
#include "base/utf8.h"
#include "loop/options.h"
#include "record/finite_result.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the maker */

bool row_maker_init(struct row_maker *maker, const struct rows *table)
{
    size_t varying = table->source.count, count = varying + table->fixed_count;
    *maker =
        (struct row_maker){.table = table,
                           .overrides = calloc(count + 1, sizeof *maker->overrides),
                           .at = calloc(table->columns.at_count + 1, sizeof *maker->at),
                           .starts = calloc(varying + 1, sizeof *maker->starts),
                           .extremes = calloc(table->columns.extreme_count + 1, sizeof *maker->extremes)};
    if (!maker->overrides || !maker->starts || !maker->extremes || !maker->at) return false;
    for (size_t i = 0; i < varying; i++)
        maker->overrides[i] = (struct override){.name = table->source.parameters[i].name, .varies = true};
    for (size_t i = varying; i < count; i++) maker->overrides[i] = table->fixed[i - varying];
    for (size_t i = 0; i < table->columns.extreme_count; i++) maker->extremes[i] = table->columns.extremes[i];
    return true;
}

void row_maker_end(struct row_maker *maker)
{
    free(maker->overrides);
    free(maker->starts);
    free(maker->extremes);
    free(maker->at);
    text_free(&maker->values);
    word_log_free(&maker->words);
    patch_free(maker->patch);
}

struct row_maker *row_maker_new(const struct rows *rows, fbd_stop *stop, void *stop_context)
{
    struct row_maker *maker = calloc(1, sizeof *maker);
    if (!maker) return NULL;
    bool made = row_maker_init(maker, rows);
    maker->stop = stop;
    maker->stop_context = stop_context;
    if (made) return maker;
    row_maker_free(maker);
    return NULL;
}

void row_maker_free(struct row_maker *maker)
{
    if (!maker) return;
    row_maker_end(maker);
    free(maker);
}

bool row_maker_set(struct row_maker *maker, uint64_t run)
{
    const struct rows_source *source = &maker->table->source;
    struct text *values = &maker->values;
    values->length = 0;
    for (size_t i = 0; i < source->count; i++) {
        const char *unit = source->parameters[i].unit;
        maker->starts[i] = values->length;
        source->value(source->context, i, run, values);
        if (unit[0]) text_add(values, " ");
        text_add_bytes(values, unit, strlen(unit) + 1); /* with its terminating zero */
    }
    for (size_t i = 0; i < source->count && !values->failed; i++)
        maker->overrides[i].value = values->data + maker->starts[i];
    return !values->failed;
}

/* ---- pieces of a row */

/* Append a CSV field (RFC 4180) on one line: a truncated row is recognized by its missing newline. A field
 * that a spreadsheet would take for a formula (a file may be called `=1+1.yaml`) is marked as text. */
static void put_field(struct text *text, const char *field)
{
    text_add(text, ",");
    bool formula = field[0] && strchr("=+-@", field[0]);
    bool quoted = formula || field[strcspn(field, ",\"")];
    if (quoted) text_add(text, "\"");
    if (formula) text_add(text, "'");
    while (*field) {
        struct utf8_shown next = utf8_show(field);
        text_add_bytes(text, next.text, next.length);
        if (*field == '"') text_add(text, "\"");
        field += next.taken;
    }
    if (quoted) text_add(text, "\"");
}

static void put_start(const struct row_maker *maker, uint64_t run, struct text *text)
{
    text_exact(text, (double)(run + 1));
    for (size_t i = 0; i < maker->table->source.count; i++) {
        const char *value = maker->overrides[i].value;
        text_add(text, ",");
        text_add_bytes(text, value, strcspn(value, " "));
    }
}

void rows_put_end(struct text *text, const char *status, const char *reason)
{
    put_field(text, status);
    put_field(text, reason);
    text_add(text, "\n");
}

/* Mark the row as failed when memory is out: rows may only depend on the scene. */
static void lose(struct text *text)
{
    text->failed = true;
}

void row_write_reason(fbd_errors *errors, char *reason, size_t size)
{
    const fbd_error *note = errors->out_of_memory ? NULL : diag_first_error(errors);
    const char *file = note && note->file ? note->file : "model";
    reason[0] = '\0';
    if (note && note->line > 0)
        snprintf(reason, size, "%s:%d:%d: %s [%s]", file, note->line, note->column, note->message, note->id);
    else if (note)
        snprintf(reason, size, "%s: %s [%s]", file, note->message, note->id);
}

/* Append an error in place of the columns; no error means that memory is out. */
static void put_wrong(const struct row_maker *maker, fbd_errors *errors, struct text *text)
{
    const struct columns *columns = &maker->table->columns;
    char reason[row_reason_room];
    for (size_t i = 0; i < columns->count + 1; i++) text_add(text, ","); /* plus the number of events */
    row_write_reason(errors, reason, sizeof reason);
    if (!reason[0]) lose(text);
    rows_put_end(text, "wrong", reason);
}

static const char *status_of(fbd_outcome outcome)
{
    switch (outcome) {
    case FBD_DONE: return "done";
    case FBD_STOPPED: return "stopped";
    case FBD_BROKEN: return "broken";
    case FBD_GOING:
    case FBD_FAILED:
    case FBD_OUT_OF_MEMORY:
    case FBD_INTERRUPTED: break;
    }
    return "failed";
}

/* ---- happenings */

/* The next in time of words and events: those of the start come first. */
static const char *next_happening(const struct observed *o, size_t *word, size_t *event, int *body)
{
    const struct word_log *words = o->words;
    if (*word < words->at_start) {
        *body = words->notes[*word].body;
        return row_word_name(words->notes[(*word)++].word);
    }
    if (*event == o->run->event_count) return NULL;
    const struct run_event *next = &o->run->events[(*event)++];
    *body = next->body;
    if (next->kind != FBD_EVENT_USER) return fbd_event_kind_name(next->kind);
    return o->run->model->plan.watches[next->watch].source->name;
}

/* Append the happenings of a run, "block contact, block breakaway, land, block impact 3 times". */
static void story_put(const struct observed *o, struct text *text)
{
    const char *name, *last = NULL;
    size_t word = 0, event = 0, times = 0;
    int body = -1, last_body = -1;
    for (;;) {
        name = next_happening(o, &word, &event, &body);
        times++;
        if (name && last && strcmp(name, last) == 0 && body == last_body) continue;
        if (last && times > 1) text_printf(text, " %zu times", times);
        times = 0;
        if (!name) break;
        if (last) text_add(text, ", ");
        if (body >= 0) text_printf(text, "%s ", o->run->model->bodies[body].name);
        text_add(text, name);
        last = name;
        last_body = body;
    }
}

/* ---- the run */

static bool account(void *context, struct ensemble *run, size_t group)
{
    ledger_note(context, &run->groups[group]);
    return ledger_step(context, run, group);
}

static void account_again(void *context, struct ensemble *run, size_t group)
{
    ledger_restart(context, run, group);
}

static bool wants_words(const struct row_maker *maker)
{
    return maker->table->columns.words || maker->story;
}

/* Carry the run to its end, with ledger and extremes if required. Returns false when it was stopped or memory
 * is out. */
static bool carry(struct row_maker *maker, struct ensemble *run, struct ledger *ledger,
                  struct fbd_state *probe, fbd_errors *errors)
{
    size_t extremes = maker->table->columns.extreme_count;
    const bool words = wants_words(maker);
    if (ledger) run->observer = (struct observer){ledger, account, account_again};
    while (run->outcome == FBD_GOING) {
        if (maker->stop && maker->stop(maker->stop_context) != 0) return false;
        const size_t seen = run->event_count;
        ensemble_advance(run);
        if (words && run->outcome != FBD_FAILED && run->outcome != FBD_OUT_OF_MEMORY &&
            !word_log_step(&maker->words, run, probe))
            run->outcome = FBD_OUT_OF_MEMORY;
        if (!(run->t > run->from)) continue; /* no step was made */
        if ((maker->table->columns.at_count &&
             !columns_step(&maker->table->columns, run, seen, probe, maker->at, errors)) ||
            (extremes && !extremes_step(maker->extremes, extremes, run, probe, errors)))
            run->outcome = FBD_FAILED;
    }
    if (words && run->refused && !word_log_step(&maker->words, run, probe)) run->outcome = FBD_OUT_OF_MEMORY;
    if (ledger && !ledger_at(ledger, run, ledger->work)) run->outcome = FBD_FAILED;
    return true;
}

/* Check the energy balance. `ledger` may be NULL. */
static bool is_balanced(struct ensemble *run, struct ledger *ledger, char *reason, size_t size)
{
    struct energy_balance balance = ensemble_energy_balance(run);
    if (ledger && run->options.step == 0 && !(fabs(balance.residual) > balance.explained)) {
        struct fbd_state *state = ensemble_state(run);
        double steps = 0;
        for (size_t g = 0; g < run->count; g++)
            steps += (double)switcher_counts(run->groups[g].run->stepper).accepted;
        balance.residual = ledger_energy(ledger, state, ledger->work).residual;
        balance.explained = ledger_explained(ledger, state, run->options.tolerance, steps);
    }
    format_into(reason, size, "the residual of the energy is %.2g, where the tolerance explains %.2g",
                balance.residual, balance.explained);
    return !(fabs(balance.residual) > balance.explained);
}

/* Append the outcome; for a refused start its id and, mostly, a position in the file. */
static void put_outcome(const struct ensemble *run, struct text *text)
{
    char reason[row_reason_room];
    const char *file = run->model->scene->file ? run->model->scene->file : "model";
    if (run->refused && run->refused->end.refusal_at.line > 0)
        snprintf(reason, sizeof reason, "%s:%d:%d: %s [%s]", file, run->refused->end.refusal_at.line,
                 run->refused->end.refusal_at.column, run->reason, run->refused->end.refusal);
    else if (run->refused)
        snprintf(reason, sizeof reason, "%s: %s [%s]", file, run->reason, run->refused->end.refusal);
    rows_put_end(text, status_of(run->outcome), run->refused ? reason : run->reason);
}

/* Append the columns of a finished run. */
static enum row_end put_run(struct row_maker *maker, struct ensemble *run, struct ledger *ledger,
                            struct text *text, fbd_errors *errors)
{
    const struct columns *columns = &maker->table->columns;
    bool ended = run->outcome == FBD_DONE || run->outcome == FBD_STOPPED;
    bool known =
        !ended || result_finite(run, ledger, ledger ? ledger->work : NULL) || run->outcome == FBD_FAILED;
    if (run->outcome == FBD_OUT_OF_MEMORY || !known) {
        lose(text);
        return row_failed;
    }
    const struct observed observed = {run, ledger, maker->extremes, maker->at, &maker->words};
    columns_put(columns, &observed, text, errors);
    if (maker->story) story_put(&observed, maker->story);
    text_add(text, ",");
    text_exact(text, (double)run->event_count);
    char reason[row_reason_room];
    row_write_reason(errors, reason, sizeof reason);
    ended = run->outcome == FBD_DONE || run->outcome == FBD_STOPPED;
    const bool valued = !reason[0] || run->reason[0];
    if (errors->out_of_memory) lose(text);
    if (!valued || (ended && !is_balanced(run, ledger, reason, sizeof reason))) {
        rows_put_end(text, valued ? "inaccurate" : "failed", reason);
        return row_failed;
    }
    put_outcome(run, text);
    return run->outcome == FBD_DONE || run->outcome == FBD_STOPPED ? row_well : row_failed;
}

/* A run at its start; NULL if the values do not permit the options, or memory is out. */
static struct ensemble *start_run(const struct row_maker *maker, const struct fbd_model *model,
                                  fbd_errors *errors)
{
    struct run_options options;
    if (!options_choose(model, &maker->table->options, &options, errors)) return NULL;
    return ensemble_new(model, &options);
}

static enum row_end simulate(struct row_maker *maker, struct ensemble *run, struct text *text,
                             fbd_errors *errors)
{
    const struct columns *columns = &maker->table->columns;
    const struct fbd_model *model = run->model;
    struct ledger ledger = {0};
    struct fbd_state *probe = NULL;
    bool ready = true;
    if (columns->ledger) ready = ledger_init(&ledger, model, ensemble_state(run), true);
    word_log_restart(&maker->words);
    for (size_t i = 0; i < columns->at_count; i++) maker->at[i] = NAN;
    if (ready && (columns->extreme_count || columns->at_count || wants_words(maker))) {
        probe = state_new(model);
        ready = probe != NULL;
        extremes_start(maker->extremes, columns->extreme_count, ensemble_state(run), errors);
    }
    struct ledger *kept = columns->ledger ? &ledger : NULL;
    enum row_end end = row_failed;
    if (!ready)
        put_wrong(maker, errors, text);
    else
        end = carry(maker, run, kept, probe, errors) ? put_run(maker, run, kept, text, errors) : row_stopped;
    if (columns->ledger) ledger_free(&ledger);
    state_free(probe);
    return end;
}

/* ---- its model */

/* Perturb the values of the run, each by a different small fraction, so that the structure of the scene is
 * likely the same. Returns false when one is not a number, or zero. */
static bool move_values(const struct row_maker *maker, struct text *moved, size_t *starts)
{
    size_t count = maker->table->source.count;
    for (size_t i = 0; i < count; i++) {
        const double part = 1.0 / 1024;
        char *rest;
        double value = strtod(maker->overrides[i].value, &rest);
        if (rest == maker->overrides[i].value || value == 0 || !isfinite(value)) return false;
        starts[i] = moved->length;
        text_exact(moved, value * (1 - part / (double)(i + 1)));
        text_add_bytes(moved, rest, strlen(rest) + 1);
    }
    return !moved->failed;
}

static struct patch *make_patch(const struct row_maker *maker)
{
    const struct rows *table = maker->table;
    size_t varying = table->source.count, count = varying + table->fixed_count;
    struct text moved = {0};
    size_t *starts = calloc(varying + 1, sizeof *starts);
    const char **beside = calloc(count + 1, sizeof *beside);
    bool fine = starts && beside && move_values(maker, &moved, starts);
    for (size_t i = 0; fine && i < varying; i++) beside[i] = moved.data + starts[i];
    struct patch *patch = fine ? patch_new(&table->document, maker->overrides, count, beside) : NULL;
    text_free(&moved);
    free(starts);
    free(beside);
    return patch;
}

/* The scene of the current values by a patch, or NULL. Making a patch reads the file twice, which costs as
 * much as a few rows; it is attempted after a few rows, and again when the patch has served for some rows and
 * no longer fits the values, as after a change of sign. */
static struct scene *patched(struct row_maker *maker)
{
    enum { first_row = 3, last_row = 6, worth = 16 };
    struct scene *scene = maker->patch ? patch_apply(maker->patch, maker->overrides) : NULL;
    maker->rows++;
    if (scene) maker->served++;
    if (scene || (maker->patch && maker->served < worth)) return scene;
    if (!maker->patch && !(maker->rows >= first_row && maker->rows <= last_row)) return NULL;
    patch_free(maker->patch);
    maker->served = 0;
    maker->patch = make_patch(maker);
    if (!maker->patch) maker->rows = 0; /* retry after a few rows */
    return maker->patch ? patch_apply(maker->patch, maker->overrides) : NULL;
}

struct fbd_model *row_model(struct row_maker *maker, fbd_errors *errors)
{
    const struct rows *table = maker->table;
    size_t count = table->source.count + table->fixed_count;
    struct scene *scene = patched(maker);
    diag_in_file(errors, table->document.file);
    if (scene) return model_compile_again(scene, table->base, errors);
    scene = scene_make(&table->document, maker->overrides, count, errors);
    return scene ? model_compile(scene, errors) : NULL;
}

bool row_open(struct row_maker *maker, uint64_t run, struct open_row *row, struct text *text)
{
    *row = (struct open_row){.errors = fbd_errors_new()};
    if (!row->errors || !row_maker_set(maker, run)) lose(text);
    if (text->failed) return false;
    put_start(maker, run, text);
    row->model = row_model(maker, row->errors);
    row->run = row->model ? start_run(maker, row->model, row->errors) : NULL;
    if (!row->run) put_wrong(maker, row->errors, text);
    return row->run != NULL;
}

void row_close(struct open_row *row)
{
    ensemble_free(row->run);
    model_free(row->model);
    fbd_errors_free(row->errors);
    *row = (struct open_row){0};
}

enum row_end row_put(struct row_maker *maker, const struct open_row *row, struct text *text)
{
    return put_run(maker, row->run, NULL, text, row->errors);
}

/* ---- as numbers */

/* Cut the next field of a row in place, without its quotes. */
static char *next_field(char **rest)
{
    char *field = *rest, *to = field;
    const bool quoted = *field == '"';
    char *from = field + quoted;
    while (quoted ? *from && (from[0] != '"' || from[1] == '"') : *from && *from != ',' && *from != '\n') {
        from += quoted && from[0] == '"';
        *to++ = *from++;
    }
    if (quoted && *from) from++;
    *rest = *from ? from + 1 : from;
    *to = '\0';
    return field;
}

static double field_value(const char *field)
{
    double value;
    return number_read(field, strlen(field), &value) ? value : NAN;
}

enum row_end row_look(struct row_maker *maker, uint64_t run, struct row_look *look)
{
    const struct rows *rows = maker->table;
    look->row.length = look->story.length = 0;
    text_add(&look->story, "");
    maker->story = &look->story;
    enum row_end end = row_make(maker, run, &look->row);
    maker->story = NULL;
    if (end == row_stopped || look->row.failed || look->story.failed) return end;
    char *rest = look->row.data;
    for (size_t i = 0; i < 1 + rows->source.count; i++) next_field(&rest);
    for (size_t i = 0; i < rows->columns.count; i++) look->values[i] = field_value(next_field(&rest));
    next_field(&rest); /* the number of events */
    look->status = next_field(&rest);
    look->reason = next_field(&rest);
    return end;
}

void row_look_free(struct row_look *look)
{
    text_free(&look->row);
    text_free(&look->story);
}

enum row_end row_make(struct row_maker *maker, uint64_t run, struct text *text)
{
    size_t start = text->length;
    struct open_row row;
    enum row_end end = row_failed;
    if (row_open(maker, run, &row, text)) end = simulate(maker, row.run, text, row.errors);
    row_close(&row);
    if (end == row_stopped) text->length = start;
    return end;
}
