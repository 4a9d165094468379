/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch/rows.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "batch/row.h"
#include "document/node.h"
#include "loop/options.h"
#include "scene/names.h"

/* ---- the varying parameters */

static const struct parameter *find_parameter(const struct scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (strcmp(scene->parameters[i].name, name) == 0) return &scene->parameters[i];
    return NULL;
}

/* How to vary another number of the file: `block.v`, say, becomes a parameter `v0`. */
static const char *hint_of_parameters(const char *name, const struct node *map, fbd_errors *errors)
{
    enum { most_names = 100 };
    const char *names[most_names], *dot = strrchr(name, '.'), *last = dot ? dot + 1 : name;
    const char *zero = name_is_reserved(last) ? "0" : "";
    size_t count = 0;
    for (; map && count < map->count && count < most_names; count++) names[count] = map->pairs[count].key;
    return diag_hint(errors,
                     "%s%sonly parameters vary: for another number of the file write `parameters: "
                     "{%.40s%s: ...}` and `%.40s%s` in its place",
                     count ? diag_nearest(errors, name, names, count) : "", count ? "; " : "", last, zero,
                     last, zero);
}

static const struct node *find_map(const struct rows *rows, const char *key)
{
    const struct pair *pair = node_find(rows->document.root, key);
    return pair && pair->value->kind == node_map ? pair->value : NULL;
}

/* The values of a table must be files. */
static bool check_table(const struct rows_parameter *parameter, fbd_errors *errors)
{
    if (parameter->files) return true;
    diag_add(errors, FBD_ERROR, "bad-vary", (struct pos){0, 0},
             diag_hint(errors, "write `%.40s=a.csv,b.csv`", parameter->name),
             "`%.40s` is a table: it varies over files", parameter->name);
    return false;
}

static bool check_parameter(const struct rows *rows, const struct rows_parameter *parameter,
                            fbd_errors *errors)
{
    const struct node *map = find_map(rows, "parameters"), *inputs = find_map(rows, "inputs");
    const struct node *tables = find_map(rows, "tables");
    for (size_t i = 0; i < rows->fixed_count; i++) {
        if (strcmp(rows->fixed[i].name, parameter->name) != 0) continue;
        diag_add(errors, FBD_ERROR, "varied-twice", (struct pos){0, 0}, "leave one of the two out",
                 "`%s` is both set and varied", parameter->name);
        return false;
    }
    if (map && node_find(map, parameter->name)) return true;
    if (inputs && node_find(inputs, parameter->name)) return true;
    if (tables && node_find(tables, parameter->name)) return check_table(parameter, errors);
    diag_add(errors, FBD_ERROR, "unknown-parameter", (struct pos){0, 0},
             hint_of_parameters(parameter->name, map, errors), "the model has no parameter `%.40s` to vary",
             parameter->name);
    return false;
}

static bool check_parameters(const struct rows *rows, fbd_errors *errors)
{
    bool fine = true;
    errors->file = rows->source.option;
    for (size_t i = 0; i < rows->source.count; i++)
        if (!check_parameter(rows, &rows->source.parameters[i], errors)) fine = false;
    return fine;
}

/* Copy a note about a value itself. Returns false if it was an error. */
static bool pass_on(const struct rows *rows, const fbd_error *error, fbd_errors *errors)
{
    const char *option = "--set ";
    bool value = error->file && strncmp(error->file, option, strlen(option)) == 0;
    if (!value && strcmp(error->id, "wrong-dimension") != 0) return true;
    errors->file = value ? diag_hint(errors, "%s %s", rows->source.option, error->file + strlen(option))
                         : diag_hint(errors, "%s", error->file ? error->file : "");
    diag_add(errors, error->severity, error->id, (struct pos){error->line, error->column},
             error->hint ? diag_hint(errors, "%s", error->hint) : NULL, "%s", error->message);
    return error->severity != FBD_ERROR;
}

bool rows_try(const struct rows *rows, uint64_t run, fbd_errors *errors)
{
    struct row_maker maker;
    fbd_errors *notes = fbd_errors_new();
    bool fine = row_maker_init(&maker, rows) && notes;
    if (fine) {
        row_maker_set(&maker, run);
        scene_free(
            scene_make(&rows->document, maker.overrides, rows->source.count + rows->fixed_count, notes));
    } else {
        diag_out_of_memory(errors);
    }
    for (const struct diag_note *note = fine ? notes->first : NULL; note; note = note->next)
        if (!pass_on(rows, &note->error, errors)) fine = false;
    fbd_errors_free(notes);
    row_maker_end(&maker);
    return fine;
}

/* ---- texts */

void rows_header_start(const struct rows *rows, struct text *text)
{
    const struct scene *scene = rows->base->scene;
    text_add(text, "run");
    for (size_t i = 0; i < rows->source.count; i++) {
        const struct rows_parameter *varying = &rows->source.parameters[i];
        const struct parameter *parameter = find_parameter(scene, varying->name);
        char unit[64];
        snprintf(unit, sizeof unit, "%s", varying->unit);
        if (!unit[0] && parameter && !parameter->bare)
            unit_name(parameter->dim, scene->units, unit, sizeof unit);
        text_printf(text, unit[0] ? ",%s [%s]" : ",%s%s", varying->name, unit);
    }
}

void rows_header(const struct rows *rows, struct text *text)
{
    rows_header_start(rows, text);
    for (size_t i = 0; i < rows->columns.count; i++) text_printf(text, ",%s", rows->columns.list[i].title);
    text_add(text, ",events,status,reason\n");
}

void rows_tables(const struct rows *rows, struct text *text)
{
    const struct scene *scene = rows->base->scene;
    for (size_t i = 0; i < scene->table_count; i++) {
        const struct table *table = &scene->tables[i].shared->table;
        uint64_t x = hash_text((const char *)table->x, table->count * sizeof *table->x),
                 c = hash_text((const char *)table->c, 4 * (table->count - 1) * sizeof *table->c);
        text_printf(text, "table %s %016" PRIx64 " %016" PRIx64 "\n", table->name, x, c);
    }
}

/* ---- making and freeing */

static bool copy_settings(struct rows *rows, const fbd_sweep_plan *plan)
{
    rows->fixed = ARENA_ARRAY(&rows->arena, plan->setting_count, struct override);
    for (size_t i = 0; rows->fixed && i < plan->setting_count; i++) {
        const char *name = plan->settings[i].name, *value = plan->settings[i].value;
        rows->fixed[i] = (struct override){.name = arena_text(&rows->arena, name, strlen(name)),
                                           .value = arena_text(&rows->arena, value, strlen(value))};
    }
    rows->fixed_count = plan->setting_count;
    rows->options = *plan->run;
    const char *method = plan->run->method;
    if (method) rows->options.method = arena_text(&rows->arena, method, strlen(method));
    return !rows->arena.failed;
}

/* Read the file once: report all its errors, and compile the common part of all runs. */
static bool compile(struct rows *rows, fbd_errors *errors)
{
    size_t varying = rows->source.count, count = varying + rows->fixed_count;
    struct override *overrides = ARENA_ARRAY(&rows->arena, count, struct override);
    if (!overrides) return false;
    for (size_t i = 0; i < varying; i++) overrides[i].name = rows->source.parameters[i].name;
    for (size_t i = varying; i < count; i++) overrides[i] = rows->fixed[i - varying];
    if (!document_prepare(&rows->document, overrides, count, errors)) return false;
    rows->document.without_hands = true;
    fbd_errors *again = fbd_errors_new(); /* warnings were given before */
    struct scene *scene =
        again ? scene_make(&rows->document, overrides + varying, rows->fixed_count, again) : NULL;
    rows->base = scene ? model_compile(scene, errors) : NULL;
    fbd_errors_free(again);
    return rows->base != NULL;
}

/* Refuse error bars and accuracies, which need several runs: every row is one run. */
static bool refuse_errors(const fbd_options *options, fbd_errors *errors)
{
    if (!options->error_bars && options->accuracy == 0) return false;
    diag_add(errors, FBD_ERROR, "bad-option", (struct pos){0, 0}, "give a tolerance",
             "a sweep has neither error bars nor an accuracy");
    return true;
}

/* Warn of an accuracy in the file, which a sweep does not use. */
static void warn_of_accuracy(const struct rows *rows, fbd_errors *errors)
{
    const fbd_options *options = &rows->options;
    if (!(rows->base->scene->simulate.accuracy > 0) || options->tolerance != 0 || options->step != 0) return;
    diag_add(errors, FBD_WARNING, "accuracy-not-used", (struct pos){0, 0},
             "give a tolerance by --tolerance; fbd-run --accuracy prints the one that is needed",
             "the `accuracy` of the file is not used by a sweep");
}

struct rows *rows_open(const char *text, size_t length, const char *name, fbd_errors *errors)
{
    struct rows *rows = calloc(1, sizeof *rows);
    if (!rows) {
        diag_out_of_memory(errors);
        return NULL;
    }
    if (document_open(&rows->document, text, length, name, errors)) return rows;
    rows_free(rows);
    return NULL;
}

bool rows_prepare(struct rows *rows, const struct rows_source *source, const fbd_sweep_plan *plan,
                  fbd_errors *errors)
{
    struct run_options chosen;
    rows->source = *source;
    if (!copy_settings(rows, plan)) return false;
    if (!check_parameters(rows, errors) || !compile(rows, errors)) return false;
    if (!options_choose(rows->base, &rows->options, &chosen, errors)) return false;
    if (refuse_errors(&rows->options, errors)) return false;
    warn_of_accuracy(rows, errors);
    errors->file = rows->source.outputs;
    if (!columns_read(&rows->columns, &rows->arena, rows->base, plan->outputs, plan->output_count,
                      plan->degrees, errors))
        return false;
    rows_warn_of_sections(rows, errors);
    return true;
}

void rows_free(struct rows *rows)
{
    if (!rows) return;
    model_free(rows->base);
    document_close(&rows->document);
    arena_free(&rows->arena);
    free(rows);
}
