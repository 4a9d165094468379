/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch/row_columns.h"

#include "integrate/switcher.h"
#include "output/display_units.h"
#include "output/words.h"
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
    bool degrees;
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

/* ---- coordinates and rates */

static bool add_final(struct list *list, int index)
{
    const struct display shown = display_of_component(list->model, (size_t)index, list->degrees);
    return add(list, (struct column){.title = title(list, shown.name, shown.unit),
                                     .kind = column_final,
                                     .index = index,
                                     .size = shown.size});
}

static bool add_world(struct list *list, const char *name, const struct world_quantity *point)
{
    const char *text = arena_printf(list->arena, "%s [%s]", name, world_part_unit(list->model, point->part));
    return add(list, (struct column){.title = text, .kind = column_world, .point = *point});
}

/* Of y[index], or of a point if index is negative. */
static bool add_extreme(struct list *list, int sign, int index, const char *name,
                        const struct world_quantity *point)
{
    struct columns *columns = list->columns;
    const struct fbd_model *model = list->model;
    struct display shown = {name, "", 1};
    if (index < 0)
        shown.unit = world_part_unit(model, point->part);
    else
        shown = display_of_component(model, (size_t)index, list->degrees);
    struct extreme *larger = ARENA_ARRAY(list->arena, columns->extreme_count + 1, struct extreme);
    if (!larger) return false;
    if (columns->extreme_count) memcpy(larger, columns->extremes, columns->extreme_count * sizeof *larger);
    larger[columns->extreme_count] = (struct extreme){.index = index, .point = *point, .sign = sign};
    columns->extremes = larger;
    const char *text =
        arena_printf(list->arena, "%s(%s) [%s]", sign > 0 ? "max" : "min", shown.name, shown.unit);
    return add(list, (struct column){.title = text,
                                     .kind = column_extreme,
                                     .size = shown.size,
                                     .index = (int)columns->extreme_count++});
}

/* ---- events */

static const fbd_event_kind kinds[] = {FBD_EVENT_BREAKAWAY,    FBD_EVENT_STICK,      FBD_EVENT_REVERSAL,
                                       FBD_EVENT_CONTACT_LOST, FBD_EVENT_ROPE_SLACK, FBD_EVENT_ROPE_TAUT,
                                       FBD_EVENT_LIFT_OFF,     FBD_EVENT_LANDING,    FBD_EVENT_SWITCH,
                                       FBD_EVENT_IMPACT,       FBD_EVENT_CONTACT,    FBD_EVENT_REST,
                                       FBD_EVENT_JAM,          FBD_EVENT_SEVERAL,    FBD_EVENT_SLIDING,
                                       FBD_EVENT_SLIDING_ENDS, FBD_EVENT_TRACK_END};

static int find_body(const struct fbd_model *model, const char *name, size_t length)
{
    for (size_t b = 0; b < model->body_count; b++)
        if (strlen(model->bodies[b].name) == length && strncmp(model->bodies[b].name, name, length) == 0)
            return (int)b;
    return -1;
}

/* NAME of the file, KIND, or BODY.KIND. */
static bool find_event(const struct fbd_model *model, const char *name, struct column *column)
{
    column->event = column->body = column->watch = -1;
    for (size_t i = 0; i < model->plan.watch_count; i++)
        if (strcmp(model->plan.watches[i].source->name, name) == 0) column->watch = (int)i;
    if (column->watch >= 0) return true;
    const char *dot = strchr(name, '.');
    if (dot && (column->body = find_body(model, name, (size_t)(dot - name))) < 0) return false;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if (strcmp(fbd_event_kind_name(kinds[k]), dot ? dot + 1 : name) == 0) column->event = (int)kinds[k];
    return column->event >= 0;
}

static bool add_event(struct list *list, enum column_kind kind, const char *name)
{
    struct column column = {.kind = kind};
    if (!find_event(list->model, name, &column)) return false;
    column.title = arena_printf(list->arena, kind == column_time ? "time(%s) [s]" : "count(%s)", name);
    return add(list, column);
}

/* ---- energies and works */

static const char *const energies[] = {"energy.kinetic", "energy.potential", "energy.work",
                                       "energy.residual"};

static bool add_energy(struct list *list, int index)
{
    list->columns->ledger = true;
    const char *text = title(list, energies[index], energy_unit(list->model));
    return add(list, (struct column){.title = text, .kind = column_energy, .index = index});
}

/* BODY.LOAD.work, which is cut in pieces. */
static bool add_work(struct list *list, char *name)
{
    char *load = strchr(name, '.'), *work = strrchr(name, '.');
    if (work == load || strcmp(work, ".work") != 0) return false;
    *load++ = *work = '\0';
    int index = model_find_load(list->model, name, load);
    if (index < 0) return false;
    list->columns->ledger = true;
    const char *text = arena_printf(list->arena, "%s.%s.work [%s]", name, load, energy_unit(list->model));
    return add(list, (struct column){.title = text, .kind = column_work, .index = index});
}

/* ---- names */

static bool add_group(struct list *list, const char *name)
{
    const struct fbd_model *model = list->model;
    bool fine = true;
    if (strcmp(name, "final") == 0) {
        fine = add(list, (struct column){.title = "t [s]", .kind = column_t});
        for (size_t b = 0; fine && b < model->body_count; b++) {
            const struct model_body *body = &model->bodies[b];
            for (int k = 0; k < body->count; k++) fine = fine && add_final(list, body->first + k);
            for (int k = 0; k < body->count; k++) fine = fine && add_final(list, body->first_rate + k);
        }
        for (int i = 0; i < model->plan.own; i++) fine = fine && add_final(list, 2 * model->plan.n + i);
        return fine;
    }
    if (strcmp(name, "times") == 0) {
        for (size_t i = 0; i < model->plan.watch_count; i++)
            fine = fine && add_event(list, column_time, model->plan.watches[i].source->name);
        return fine;
    }
    for (int i = 0; i < 4 && fine; i++) fine = add_energy(list, i);
    return fine;
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

static bool add_call(struct list *list, const char *function, const char *argument)
{
    struct world_quantity point = {.body = 0};
    int index = model_find_component(list->model, argument, true);
    bool known = index >= 0 || world_find(list->model, argument, &point);
    if (strcmp(function, "min") == 0 && known) return add_extreme(list, -1, index, argument, &point);
    if (strcmp(function, "max") == 0 && known) return add_extreme(list, 1, index, argument, &point);
    if (strcmp(function, "time") == 0) return add_event(list, column_time, argument);
    return strcmp(function, "count") == 0 && add_event(list, column_count, argument);
}

static bool add_named(struct list *list, char *name)
{
    char *argument;
    if (strcmp(name, "final") == 0 || strcmp(name, "times") == 0 || strcmp(name, "energy") == 0)
        return add_group(list, name);
    if (cut_call(name, &argument)) return add_call(list, name, argument);
    if (strcmp(name, "t") == 0) return add(list, (struct column){.title = "t [s]", .kind = column_t});
    if (strcmp(name, "steps") == 0) return add(list, (struct column){.title = "steps", .kind = column_steps});
    if (strcmp(name, "rhs") == 0) return add(list, (struct column){.title = "rhs", .kind = column_rhs});
    int index = model_find_component(list->model, name, true);
    struct world_quantity point;
    if (index >= 0) return add_final(list, index);
    if (world_find(list->model, name, &point)) return add_world(list, name, &point);
    for (int i = 0; i < 4; i++)
        if (strcmp(name, energies[i]) == 0) return add_energy(list, i);
    return add_work(list, name);
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

static bool add_list(struct list *list, const char *text)
{
    bool fine = true;
    for (const char *end = text; *end; text = end + 1) {
        char name[longest_output], shown[longest_output];
        text += strspn(text, " ");
        size_t length = strcspn(text, ",");
        end = text + length;
        while (length && text[length - 1] == ' ') length--;
        if (length >= sizeof name) length = sizeof name - 1;
        memcpy(name, text, length);
        name[length] = '\0';
        memcpy(shown, name, sizeof name);
        if (add_named(list, name) || list->arena->failed) continue;
        note_unknown(list, shown);
        fine = false;
    }
    return fine;
}

bool columns_read(struct columns *columns, struct arena *arena, const struct fbd_model *model,
                  const char *const *texts, size_t count, bool degrees, fbd_errors *errors)
{
    struct list list = {columns, arena, model, errors, degrees};
    bool fine = true;
    *columns = (struct columns){0};
    errors->file = "--output";
    for (size_t i = 0; i < count; i++)
        if (!add_list(&list, texts[i])) fine = false;
    if (count == 0) fine = add_list(&list, "final,times");
    if (arena->failed) diag_out_of_memory(errors);
    return fine && !arena->failed;
}

/* ---- values */

static bool is_meant(const struct column *column, const struct run_event *event)
{
    if (column->watch >= 0) return event->kind == FBD_EVENT_USER && event->watch == column->watch;
    return (int)event->kind == column->event && (column->body < 0 || event->body == column->body);
}

static void put_number(struct text *text, double value)
{
    if (isfinite(value)) text_exact(text, value);
}

static void put_event(const struct column *column, const struct ensemble *run, struct text *text)
{
    size_t count = 0;
    double first = NAN;
    for (size_t i = 0; i < run->event_count; i++) {
        if (!is_meant(column, &run->events[i])) continue;
        if (count++ == 0) first = run->events[i].t;
    }
    if (column->kind == column_count)
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

static void put(const struct column *column, const struct observed *o, struct text *text)
{
    struct ensemble *run = o->run;
    switch (column->kind) {
    case column_t: put_number(text, run->t); return;
    case column_final: put_number(text, ensemble_state(run)->y[column->index] / column->size); return;
    case column_world: {
        double values[world_parts];
        world_values(ensemble_state(run), column->point.body, column->point.point, values);
        put_number(text, values[column->point.part]);
        return;
    }
    case column_extreme: put_number(text, o->extremes[column->index].value / column->size); return;
    case column_time:
    case column_count: put_event(column, run, text); return;
    case column_energy: {
        fbd_energy e = ledger_energy(o->ledger, ensemble_state(run), o->ledger->work);
        const double values[] = {e.kinetic, e.potential, e.work, e.residual};
        put_number(text, values[column->index]);
        return;
    }
    case column_work:
        put_number(text, ledger_work(o->ledger, ensemble_state(run), (size_t)column->index, o->ledger->work));
        return;
    case column_steps: put_total(run, steps_of, text); return;
    case column_rhs: put_total(run, rhs_of, text); return;
    }
}

void columns_put(const struct columns *columns, const struct observed *observed, struct text *text)
{
    for (size_t i = 0; i < columns->count; i++) {
        text_add(text, ",");
        put(&columns->list[i], observed, text);
    }
}
