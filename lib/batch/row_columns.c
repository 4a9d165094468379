/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch/row_columns.h"

#include "integrate/switcher.h"
#include "record/result.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { longest_output = 200 };

struct list {
    struct columns *columns;
    struct arena *arena;
    const struct fbd_model *model;
    fbd_errors *errors;
    struct run_columns known; /* quantities at the end of a run */
};

static bool add(struct list *list, struct column column)
{
    struct columns *columns = list->columns;
    if (columns->count == columns->room) {
        size_t room = columns->room ? 2 * columns->room : 32;
        struct column *larger = ARENA_ARRAY(list->arena, room, struct column);
        if (!larger) return false;
        if (columns->count) memcpy(larger, columns->list, columns->count * sizeof *larger);
        columns->list = larger;
        columns->room = room;
    }
    if (!column.title) return false;
    columns->list[columns->count++] = column;
    return true;
}

static const char *title(struct list *list, const char *name, const char *unit)
{
    return arena_printf(list->arena, *unit ? "%s [%s]" : "%s%s", name, unit);
}

/* ---- quantities of the table of columns */

static bool add_quantity(struct list *list, const struct run_column *quantity)
{
    const enum column_quantity kind = column_quantity(quantity);
    list->columns->ledger |= kind == quantity_energy || kind == quantity_work;
    return add(list, (struct column){.title = title(list, quantity->name, quantity->unit),
                                     .kind = row_quantity,
                                     .quantity = *quantity});
}

/* A quantity that is available at any state: a component of y, of a point, or a section. */
static bool find_watched(struct list *list, const char *name, struct run_column *quantity)
{
    if (section_is_name(name))
        return run_column_of_section(list->model, list->arena, name, quantity, list->errors);
    return run_columns_find(&list->known, name, quantity) &&
           (quantity->kind == column_point || column_is_entry(quantity));
}

/* False for other quantities. */
static bool add_extreme(struct list *list, int sign, const char *name)
{
    struct columns *columns = list->columns;
    struct run_column quantity;
    if (!find_watched(list, name, &quantity)) return false;
    struct extreme *larger = ARENA_ARRAY(list->arena, columns->extreme_count + 1, struct extreme);
    if (!larger) return false;
    if (columns->extreme_count) memcpy(larger, columns->extremes, columns->extreme_count * sizeof *larger);
    larger[columns->extreme_count] = (struct extreme){.column = quantity, .sign = sign};
    columns->extremes = larger;
    const char *text =
        arena_printf(list->arena, "%s(%s) [%s]", sign > 0 ? "max" : "min", quantity.name, quantity.unit);
    return add(list, (struct column){.title = text,
                                     .kind = row_extreme,
                                     .quantity = quantity,
                                     .index = (int)columns->extreme_count++});
}

/* ---- events */

static const fbd_event_kind kinds[] = {
    FBD_EVENT_BREAKAWAY,   FBD_EVENT_STICK,         FBD_EVENT_REVERSAL,        FBD_EVENT_CONTACT_LOST,
    FBD_EVENT_ROPE_SLACK,  FBD_EVENT_ROPE_TAUT,     FBD_EVENT_LIFT_OFF,        FBD_EVENT_LANDING,
    FBD_EVENT_SWITCH,      FBD_EVENT_IMPACT,        FBD_EVENT_CONTACT,         FBD_EVENT_REST,
    FBD_EVENT_JAM,         FBD_EVENT_SEVERAL,       FBD_EVENT_SLIDING,         FBD_EVENT_SLIDING_ENDS,
    FBD_EVENT_TRACK_END,   FBD_EVENT_COUPLING_ENDS, FBD_EVENT_COUPLING_BEGINS, FBD_EVENT_FORCE_ENDS,
    FBD_EVENT_FORCE_BEGINS};

static int find_body(const struct fbd_model *model, const char *name, size_t length)
{
    for (size_t b = 0; b < model->body_count; b++)
        if (strlen(model->bodies[b].name) == length && strncmp(model->bodies[b].name, name, length) == 0)
            return (int)b;
    return -1;
}

/* Is it the name of an event, as of a force also behind that of its body? */
static bool is_named(const struct fbd_model *model, const struct watch *watch, const char *name,
                     size_t length)
{
    const char *own = watch->source->name;
    const size_t size = strlen(own);
    if (length == size && strncmp(own, name, size) == 0) return true;
    if (watch->load < 0 || length <= size + 1 || strncmp(name + length - size, own, size) != 0) return false;
    const char *body = model->bodies[model->loads[watch->load].body].name;
    return strlen(body) == length - size - 1 && strncmp(name, body, strlen(body)) == 0 &&
           name[strlen(body)] == '.';
}

/* The event of the file, or the `until` of a force or coupling if `ends`, with the name of `length` bytes; or -1. */
static int find_watch(const struct fbd_model *model, const char *name, size_t length, bool ends)
{
    int found = -1;
    for (size_t i = 0; i < model->plan.watch_count; i++) {
        const struct user_event *event = model->plan.watches[i].source;
        const bool same = is_named(model, &model->plan.watches[i], name, length);
        if (same && ((event->lifetime > 0 && !event->begins) || !ends)) found = (int)i;
    }
    return found;
}

/* `breaks`, `cord.breaks` of a coupling, `band.breaks` or `bob.band.breaks` of a force, `bob.breaks` of a body: one ends
 * by its `until`. */
static bool find_break(const struct fbd_model *model, const char *name, const char *dot,
                       struct column *column)
{
    column->event = (int)FBD_EVENT_COUPLING_ENDS;
    column->breaks = true;
    if (!dot) return true;
    column->watch = find_watch(model, name, (size_t)(dot - name), true);
    column->body = find_body(model, name, (size_t)(dot - name));
    return column->watch >= 0 || column->body >= 0;
}

/* NAME of the file, KIND, or BODY.KIND. */
static bool find_event(const struct fbd_model *model, const char *name, struct column *column)
{
    column->event = column->body = -1;
    column->watch = find_watch(model, name, strlen(name), false);
    if (column->watch >= 0) return true;
    const char *dot = strrchr(name, '.');
    if (strcmp(dot ? dot + 1 : name, "breaks") == 0) return find_break(model, name, dot, column);
    if (dot && (column->body = find_body(model, name, (size_t)(dot - name))) < 0) return false;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if (strcmp(fbd_event_kind_name(kinds[k]), dot ? dot + 1 : name) == 0) column->event = (int)kinds[k];
    if (column->event < 0) column->event = row_word_find(dot ? dot + 1 : name);
    return column->event >= 0;
}

static bool add_event(struct list *list, enum row_kind kind, const char *name)
{
    struct column column = {.kind = kind};
    if (!find_event(list->model, name, &column)) return false;
    list->columns->words |= column.event >= word_slips;
    column.title = arena_printf(list->arena, kind == row_time ? "time(%s) [s]" : "count(%s)", name);
    return add(list, column);
}

/* ---- names */

/* `final`: time and components; `energy`. */
static bool add_group(struct list *list, const char *name)
{
    const struct fbd_model *model = list->model;
    const bool energy = strcmp(name, "energy") == 0;
    bool fine = true;
    if (strcmp(name, "times") == 0) {
        for (size_t i = 0; i < model->plan.watch_count; i++)
            fine = fine && add_event(list, row_time, model->plan.watches[i].source->name);
        return fine;
    }
    for (size_t i = 0; i < list->known.count && fine; i++) {
        const struct run_column *known = &list->known.list[i];
        const bool wanted =
            energy ? known->kind == column_energy : known->kind == column_time || column_is_entry(known);
        if (wanted) fine = add_quantity(list, known);
    }
    return fine;
}

/* at(EVENT, NAME). */
static bool add_at(struct list *list, char *argument)
{
    char *comma = strchr(argument, ',');
    struct column column = {.kind = row_at, .index = (int)list->columns->at_count};
    if (!comma) return false;
    *comma = '\0';
    const char *name = comma + 1 + strspn(comma + 1, " ");
    if (!find_event(list->model, argument, &column) || column.event >= word_slips ||
        !find_watched(list, name, &column.quantity))
        return false;
    list->columns->at_count++;
    column.title =
        arena_printf(list->arena, "at(%s %s) [%s]", argument, column.quantity.name, column.quantity.unit);
    return add(list, column);
}

static bool add_parameter(struct list *list, const char *name)
{
    const struct scene *scene = list->model->scene;
    for (size_t i = 0; i < scene->parameter_count; i++) {
        const struct parameter *parameter = &scene->parameters[i];
        if (strcmp(parameter->name, name) != 0) continue;
        const struct run_column quantity = {.name = parameter->name, .unit = parameter->unit, .size = 1};
        return add(list, (struct column){.title = title(list, parameter->name, parameter->unit),
                                         .kind = row_parameter,
                                         .quantity = quantity,
                                         .index = (int)i});
    }
    return false;
}

/* Cut FUNCTION(argument) in two; false for any other text. */
static bool cut_call(char *name, char **argument)
{
    char *brace = strchr(name, '(');
    size_t length = strlen(name);
    if (!brace || name[length - 1] != ')') return false;
    name[length - 1] = *brace = '\0';
    *argument = brace + 1;
    return true;
}

static bool add_call(struct list *list, const char *function, char *argument)
{
    if (strcmp(function, "at") == 0) return add_at(list, argument);
    if (strcmp(function, "min") == 0) return add_extreme(list, -1, argument);
    if (strcmp(function, "max") == 0) return add_extreme(list, 1, argument);
    if (strcmp(function, "time") == 0) return add_event(list, row_time, argument);
    return strcmp(function, "count") == 0 && add_event(list, row_count, argument);
}

static bool add_named(struct list *list, char *name)
{
    char *argument;
    struct run_column quantity;
    if (strcmp(name, "final") == 0 || strcmp(name, "times") == 0 || strcmp(name, "energy") == 0)
        return add_group(list, name);
    if (section_is_name(name)) return find_watched(list, name, &quantity) && add_quantity(list, &quantity);
    if (cut_call(name, &argument)) return add_call(list, name, argument);
    if (strcmp(name, "steps") == 0) return add(list, (struct column){.title = "steps", .kind = row_steps});
    if (strcmp(name, "rhs") == 0) return add(list, (struct column){.title = "rhs", .kind = row_rhs});
    if (run_columns_find(&list->known, name, &quantity)) return add_quantity(list, &quantity);
    return add_parameter(list, name);
}

static void note_unknown(struct list *list, const char *name)
{
    const struct fbd_model *model = list->model;
    const char *coordinate = model->plan.n > 0 ? model->labels[0].name : "block.x";
    const char *event = model->plan.watch_count > 0 ? model->plan.watches[0].source->name : "stick";
    diag_add(list->errors, FBD_ERROR, "unknown-output", (struct pos){0, 0},
             diag_hint(list->errors,
                       "for example `%s`, `max(%s)`, `time(%s)`, `count(%s)`, `energy.kinetic`, `final`, "
                       "`times`, `energy`",
                       coordinate, coordinate, event, event),
             "a run has no quantity `%.80s`", name);
}

/* Up to the next comma outside of parentheses. */
static size_t name_length(const char *text)
{
    size_t length = strcspn(text, ",(");
    if (text[length] == '(') length += strcspn(text + length, ")");
    return length + strcspn(text + length, ",");
}

static bool add_list(struct list *list, const char *text)
{
    bool fine = true;
    for (const char *end = text; *end; text = end + 1) {
        char name[longest_output], shown[longest_output];
        text += strspn(text, " ");
        size_t length = name_length(text);
        end = text + length;
        while (length && text[length - 1] == ' ') length--;
        if (length >= sizeof name) length = sizeof name - 1;
        memcpy(name, text, length);
        name[length] = '\0';
        memcpy(shown, name, sizeof name);
        const size_t noted = list->errors->errors;
        if (add_named(list, name) || list->arena->failed || list->known.arena.failed) continue;
        if (list->errors->errors == noted) note_unknown(list, shown);
        fine = false;
    }
    return fine;
}

bool columns_read(struct columns *columns, struct arena *arena, const struct fbd_model *model,
                  const char *const *texts, size_t count, bool degrees, fbd_errors *errors)
{
    struct list list = {columns, arena, model, errors, {.model = model, .degrees = degrees}};
    bool fine = true;
    *columns = (struct columns){0};
    if (!run_columns_make(&list.known, column_in_sweep, NULL)) arena->failed = true;
    for (size_t i = 0; i < count; i++)
        if (!add_list(&list, texts[i])) fine = false;
    if (count == 0) fine = add_list(&list, "final,times");
    arena->failed |= list.known.arena.failed;
    run_columns_free(&list.known);
    if (arena->failed) diag_out_of_memory(errors);
    return fine && !arena->failed;
}

/* ---- values */

static bool is_meant(const struct column *column, const struct run_event *event)
{
    if (column->watch >= 0) return event->watch == column->watch;
    const bool breaks = column->breaks && event->kind == FBD_EVENT_FORCE_ENDS;
    return ((int)event->kind == column->event || breaks) && (column->body < 0 || event->body == column->body);
}

static void put_number(struct text *text, double value)
{
    if (isfinite(value)) text_exact(text, value);
}

static void put_event(const struct column *column, const struct observed *o, struct text *text)
{
    const bool word = column->event >= word_slips;
    size_t count = 0;
    double first = NAN;
    for (size_t i = 0; !word && i < o->run->event_count; i++) {
        if (!is_meant(column, &o->run->events[i])) continue;
        if (count++ == 0) first = o->run->events[i].t;
    }
    for (size_t i = 0; word && i < o->words->count; i++) {
        const struct word_note *note = &o->words->notes[i];
        if ((int)note->word != column->event || (column->body >= 0 && note->body != column->body)) continue;
        if (count++ == 0) first = note->t;
    }
    if (column->kind == row_count)
        text_printf(text, "%zu", count);
    else
        put_number(text, first);
}

static unsigned long steps_of(const struct run *run)
{
    return switcher_counts(run->stepper).accepted;
}

static unsigned long rhs_of(const struct run *run)
{
    return run->system.rhs;
}

/* Append the sum over the islands. */
static void put_total(const struct ensemble *run, unsigned long (*count)(const struct run *),
                      struct text *text)
{
    unsigned long sum = 0;
    for (size_t i = 0; i < run->count; i++) sum += count(run->groups[i].run);
    text_printf(text, "%lu", sum);
}

static void put(const struct column *column, const struct observed *o, struct column_view *view,
                struct text *text)
{
    switch (column->kind) {
    case row_quantity: put_number(text, run_column_value(&column->quantity, view)); return;
    case row_extreme: put_number(text, o->extremes[column->index].value); return;
    case row_time:
    case row_count: put_event(column, o, text); return;
    case row_at: put_number(text, o->at[column->index]); return;
    case row_parameter: put_number(text, o->run->model->scene->parameters[column->index].value); return;
    case row_steps: put_total(o->run, steps_of, text); return;
    case row_rhs: put_total(o->run, rhs_of, text); return;
    }
}

bool columns_step(const struct columns *columns, struct ensemble *run, size_t seen, struct fbd_state *probe,
                  double *at, fbd_errors *errors)
{
    struct column_view view;
    for (size_t e = seen; e < run->event_count; e++) {
        for (size_t i = 0; i < columns->count; i++) {
            const struct column *column = &columns->list[i];
            if (column->kind != row_at || !isnan(at[column->index])) continue;
            if (!is_meant(column, &run->events[e])) continue;
            if (!ensemble_look_before(run, run->events[e].t, probe)) return false;
            column_view_begin(&view, probe, NULL, NULL, NULL);
            view.errors = errors;
            at[column->index] = run_column_value(&column->quantity, &view);
            if (isnan(at[column->index])) return false;
        }
    }
    return true;
}

void columns_put(const struct columns *columns, const struct observed *observed, struct text *text,
                 fbd_errors *errors)
{
    struct column_view view;
    column_view_begin(&view, ensemble_state(observed->run), observed->ledger,
                      observed->ledger ? observed->ledger->work : NULL, NULL);
    view.errors = errors;
    for (size_t i = 0; i < columns->count; i++) {
        text_add(text, ",");
        put(&columns->list[i], observed, &view, text);
    }
}
