/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/sweep.h"

#include "base/api_check.h"
#include "base/file.h"
#include "document/node.h"
#include "fbd_study.h"
#include "loop/options.h"
#include "scene/names.h"
#include "study/hash.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

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
    const char *names[most_members], *dot = strrchr(name, '.'), *last = dot ? dot + 1 : name;
    const char *zero = name_is_reserved(last) ? "0" : "";
    size_t count = 0;
    for (; map && count < map->count && count < most_members; count++) names[count] = map->pairs[count].key;
    return diag_hint(errors,
                     "%s%sonly parameters vary: for another number of the file write `parameters: "
                     "{%.40s%s: ...}` and `%.40s%s` in its place",
                     count ? diag_nearest(errors, name, names, count) : "", count ? "; " : "", last, zero,
                     last, zero);
}

static const struct node *find_map(const struct fbd_sweep *sweep, const char *key)
{
    const struct pair *pair = node_find(sweep->document.root, key);
    return pair && pair->value->kind == node_map ? pair->value : NULL;
}

/* The values of a table must be files. */
static bool check_table(const struct member *member, fbd_errors *errors)
{
    if (member->kind == values_words) return true;
    diag_add(errors, FBD_ERROR, "bad-vary", (struct pos){0, 0},
             diag_hint(errors, "write `%.40s=a.csv,b.csv`", member->name),
             "`%.40s` is a table: it varies over files", member->name);
    return false;
}

static bool check_member(const struct fbd_sweep *sweep, const struct member *member, fbd_errors *errors)
{
    const struct node *map = find_map(sweep, "parameters"), *inputs = find_map(sweep, "inputs");
    const struct node *tables = find_map(sweep, "tables");
    for (size_t i = 0; i < sweep->fixed_count; i++) {
        if (strcmp(sweep->fixed[i].name, member->name) != 0) continue;
        diag_add(errors, FBD_ERROR, "varied-twice", (struct pos){0, 0}, "leave one of the two out",
                 "`%s` is both set and varied", member->name);
        return false;
    }
    if (map && node_find(map, member->name)) return true;
    if (inputs && node_find(inputs, member->name)) return true;
    if (tables && node_find(tables, member->name)) return check_table(member, errors);
    diag_add(errors, FBD_ERROR, "unknown-parameter", (struct pos){0, 0},
             hint_of_parameters(member->name, map, errors), "the model has no parameter `%.40s` to vary",
             member->name);
    return false;
}

static bool check_members(const struct fbd_sweep *sweep, fbd_errors *errors)
{
    bool fine = true;
    errors->file = "--vary";
    for (size_t i = 0; i < sweep->axes.member_count; i++)
        if (!check_member(sweep, &sweep->axes.members[i], errors)) fine = false;
    return fine;
}

/* Copy a note about a value itself. Returns false if it was an error. */
static bool pass_on(const fbd_error *error, fbd_errors *errors)
{
    const char *option = "--set ";
    bool value = error->file && strncmp(error->file, option, strlen(option)) == 0;
    if (!value && strcmp(error->id, "wrong-dimension") != 0) return true;
    errors->file = value ? diag_hint(errors, "--vary %s", error->file + strlen(option))
                         : diag_hint(errors, "%s", error->file ? error->file : "");
    diag_add(errors, error->severity, error->id, (struct pos){error->line, error->column},
             error->hint ? diag_hint(errors, "%s", error->hint) : NULL, "%s", error->message);
    return error->severity != FBD_ERROR;
}

/* Try the values of a run, for errors such as a wrong dimension, which occur in every run. Errors of
 * the resulting scene are reported by the rows. */
static bool try_values(const struct fbd_sweep *sweep, uint64_t run, fbd_errors *errors)
{
    struct row_maker maker;
    fbd_errors *notes = fbd_errors_new();
    bool fine = row_maker_init(&maker, sweep) && notes;
    if (fine) {
        row_maker_set(&maker, run);
        scene_free(scene_make(&sweep->document, maker.overrides,
                              sweep->axes.member_count + sweep->fixed_count, notes));
    } else {
        diag_out_of_memory(errors);
    }
    for (const struct diag_note *note = fine ? notes->first : NULL; note; note = note->next)
        if (!pass_on(&note->error, errors)) fine = false;
    fbd_errors_free(notes);
    row_maker_free(&maker);
    return fine;
}

/* ---- texts */

static void set_header(struct fbd_sweep *sweep)
{
    struct text *header = &sweep->header;
    const struct scene *scene = sweep->base->scene;
    text_add(header, "run");
    for (size_t i = 0; i < sweep->axes.member_count; i++) {
        const struct member *member = &sweep->axes.members[i];
        const struct parameter *parameter = find_parameter(scene, member->name);
        char unit[64];
        snprintf(unit, sizeof unit, "%s", member->unit);
        if (!unit[0] && parameter && !parameter->bare)
            unit_name(parameter->dim, scene->units, unit, sizeof unit);
        text_printf(header, unit[0] ? ",%s [%s]" : ",%s%s", member->name, unit);
    }
    for (size_t i = 0; i < sweep->columns.count; i++)
        text_printf(header, ",%s", sweep->columns.list[i].title);
    text_add(header, ",events,status,reason\n");
}

/* Add hashes of the data of the tables of the file, and of the varying files, to the key. */
static bool add_data(struct fbd_sweep *sweep, fbd_errors *errors)
{
    const struct scene *scene = sweep->base->scene;
    struct text *key = &sweep->key;
    for (size_t i = 0; i < scene->table_count; i++) {
        const struct table *table = &scene->tables[i].shared->table;
        uint64_t x = hash_text((const char *)table->x, table->count * sizeof *table->x),
                 c = hash_text((const char *)table->c, 4 * (table->count - 1) * sizeof *table->c);
        text_printf(key, "table %s %016" PRIx64 " %016" PRIx64 "\n", table->name, x, c);
    }
    for (size_t i = 0; i < sweep->axes.member_count; i++) {
        const struct member *member = &sweep->axes.members[i];
        for (uint64_t k = 0; member->kind == values_words && k < member->count; k++) {
            size_t length;
            char *data = file_text(member->words[k], &length, errors);
            if (!data) return false;
            text_printf(key, "file %s %016" PRIx64 "\n", member->words[k], hash_text(data, length));
            free(data);
        }
    }
    return true;
}

/* Write everything that determines the rows, one line for each: a sweep is only continued with the same key. */
static void set_key(struct fbd_sweep *sweep, const fbd_sweep_plan *plan)
{
    struct text *key = &sweep->key;
    text_printf(key, "fbd-sweep %s\n", FBD_VERSION);
    text_printf(key, "model %016" PRIx64 ", %zu bytes\n", hash_text(sweep->source, sweep->source_length),
                sweep->source_length);
    for (size_t i = 0; i < plan->setting_count; i++)
        text_printf(key, "set %s=%s\n", plan->settings[i].name, plan->settings[i].value);
    for (size_t i = 0; i < plan->vary_count; i++) text_printf(key, "vary %s\n", plan->vary[i]);
    text_printf(key, "%s, seed %lu\n", plan->zip ? "side by side" : "each with each", plan->seed);
    for (size_t i = 0; i < plan->output_count; i++) text_printf(key, "output %s\n", plan->outputs[i]);
    if (plan->degrees) text_add(key, "angles in degrees\n");
    text_printf(key, "method %s, tolerance ", plan->run->method ? plan->run->method : "of the file");
    text_number(key, plan->run->tolerance, 17);
    text_add(key, ", step ");
    text_number(key, plan->run->step, 17);
    text_add(key, ", until ");
    text_number(key, plan->run->until, 17);
    text_add(key, plan->run->no_structure ? ", no structure\n" : "\n");
}

/* ---- making and freeing */

static bool copy_settings(struct fbd_sweep *sweep, const fbd_sweep_plan *plan)
{
    sweep->fixed = ARENA_ARRAY(&sweep->arena, plan->setting_count, struct override);
    for (size_t i = 0; sweep->fixed && i < plan->setting_count; i++) {
        const char *name = plan->settings[i].name, *value = plan->settings[i].value;
        sweep->fixed[i] = (struct override){.name = arena_text(&sweep->arena, name, strlen(name)),
                                            .value = arena_text(&sweep->arena, value, strlen(value))};
    }
    sweep->fixed_count = plan->setting_count;
    sweep->options = *plan->run;
    const char *method = plan->run->method;
    if (method) sweep->options.method = arena_text(&sweep->arena, method, strlen(method));
    return !sweep->arena.failed;
}

/* Read the file once: report all its errors, and compile the common part of all runs. */
static bool prepare(struct fbd_sweep *sweep, fbd_errors *errors)
{
    size_t varying = sweep->axes.member_count, count = varying + sweep->fixed_count;
    struct override *overrides = ARENA_ARRAY(&sweep->arena, count, struct override);
    if (!overrides) return false;
    for (size_t i = 0; i < varying; i++) overrides[i].name = sweep->axes.members[i].name;
    for (size_t i = varying; i < count; i++) overrides[i] = sweep->fixed[i - varying];
    if (!document_prepare(&sweep->document, overrides, count, errors)) return false;
    sweep->document.without_hands = true;
    fbd_errors *again = fbd_errors_new(); /* warnings were given before */
    struct scene *scene =
        again ? scene_make(&sweep->document, overrides + varying, sweep->fixed_count, again) : NULL;
    sweep->base = scene ? model_compile(scene, errors) : NULL;
    fbd_errors_free(again);
    return sweep->base != NULL;
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
static void warn_of_accuracy(const struct fbd_sweep *sweep, fbd_errors *errors)
{
    const fbd_options *options = &sweep->options;
    if (!(sweep->base->scene->simulate.accuracy > 0) || options->tolerance != 0 || options->step != 0) return;
    diag_add(errors, FBD_WARNING, "accuracy-not-used", (struct pos){0, 0},
             "give a tolerance by --tolerance; fbd-run --accuracy prints the one that is needed",
             "the `accuracy` of the file is not used by a sweep");
}

static bool build(struct fbd_sweep *sweep, const char *name, const fbd_sweep_plan *plan, fbd_errors *errors)
{
    struct run_options chosen;
    const char *file = name ? arena_text(&sweep->arena, name, strlen(name)) : NULL;
    if (!copy_settings(sweep, plan)) return false;
    bool axes =
        axes_read(&sweep->axes, &sweep->arena, plan->vary, plan->vary_count, plan->zip, plan->seed, errors);
    if (!document_open(&sweep->document, sweep->source, sweep->source_length, file, errors) || !axes)
        return false;
    if (!check_members(sweep, errors) || !prepare(sweep, errors)) return false;
    if (!options_choose(sweep->base, &sweep->options, &chosen, errors)) return false;
    if (refuse_errors(&sweep->options, errors)) return false;
    warn_of_accuracy(sweep, errors);
    if (!columns_read(&sweep->columns, &sweep->arena, sweep->base, plan->outputs, plan->output_count,
                      plan->degrees, errors))
        return false;
    bool first = try_values(sweep, 0, errors);
    if (!first || (sweep->axes.runs > 1 && !try_values(sweep, sweep->axes.runs - 1, errors))) return false;
    set_header(sweep);
    set_key(sweep, plan);
    if (!add_data(sweep, errors)) return false;
    return !sweep->header.failed && !sweep->key.failed;
}

/* Make a sweep and take ownership of `text`. NULL with notes in `errors`: those of a wrong file, `bad-vary`,
 * `unknown-output`, `unknown-parameter`, `varied-twice`, and those of options_choose. */
static struct fbd_sweep *sweep_make(char *text, size_t length, const char *name, const fbd_sweep_plan *plan,
                                    fbd_errors *errors)
{
    struct fbd_sweep *sweep = calloc(1, sizeof *sweep);
    if (!sweep) {
        free(text);
        diag_out_of_memory(errors);
        return NULL;
    }
    sweep->source = text;
    sweep->source_length = length;
    if (build(sweep, name, plan, errors)) return sweep;
    if (fbd_errors_failed_count(errors) == 0) diag_out_of_memory(errors);
    fbd_sweep_free(sweep);
    return NULL;
}

/* ---- public functions */

/* The caller's plan with the current size of the structs. */
struct asked {
    fbd_sweep_plan plan;
    fbd_options run;
};

/* Check that there is a text and a plan. */
static bool is_asked(struct asked *asked, const char *text, const fbd_sweep_plan *given, fbd_errors *errors)
{
    const fbd_sweep_plan *plan = &asked->plan;
    *asked = (struct asked){.run = FBD_OPTIONS_DEFAULT};
    if (!api_take_options(&asked->plan, sizeof asked->plan, given, errors) ||
        !api_take_options(&asked->run, sizeof asked->run, asked->plan.run, errors))
        return false;
    asked->plan.run = &asked->run;
    if (!text || !given)
        api_refuse(errors, text ? "there is no plan" : "there is no text or path");
    else if (!api_has_texts(plan->vary, plan->vary_count) ||
             !api_has_texts(plan->outputs, plan->output_count) ||
             !api_has_settings(plan->settings, plan->setting_count))
        api_refuse(errors, "a text of the plan is missing");
    else
        return true;
    return false;
}

fbd_sweep *fbd_sweep_read(const char *path, const fbd_sweep_plan *plan, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    struct asked asked;
    size_t length;
    char *text = is_asked(&asked, path, plan, errors) ? file_text(path, &length, errors) : NULL;
    fbd_sweep *sweep = text ? sweep_make(text, length, file_name(path), &asked.plan, errors) : NULL;
    diag_end(&call);
    return sweep;
}

fbd_sweep *fbd_sweep_parse(const char *text, size_t length, const char *name, const fbd_sweep_plan *plan,
                           fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    struct asked asked;
    char *copy = is_asked(&asked, text, plan, errors) ? file_copy(text, length, errors) : NULL;
    fbd_sweep *sweep = copy ? sweep_make(copy, length, name, &asked.plan, errors) : NULL;
    diag_end(&call);
    return sweep;
}

void fbd_sweep_free(fbd_sweep *sweep)
{
    if (!sweep) return;
    model_free(sweep->base);
    document_close(&sweep->document);
    text_free(&sweep->header);
    text_free(&sweep->key);
    arena_free(&sweep->arena);
    free(sweep->source);
    free(sweep);
}

size_t fbd_sweep_run_count(const fbd_sweep *sweep)
{
    if (!sweep) return 0;
    return (size_t)sweep->axes.runs;
}

const char *fbd_sweep_header(const fbd_sweep *sweep)
{
    if (!sweep) return NULL;
    return sweep->header.data;
}

const char *fbd_sweep_key(const fbd_sweep *sweep)
{
    if (!sweep) return NULL;
    return sweep->key.data;
}

const char *fbd_sweep_source(const fbd_sweep *sweep, size_t *length)
{
    if (length) *length = sweep ? sweep->source_length : 0;
    return sweep ? sweep->source : NULL;
}
