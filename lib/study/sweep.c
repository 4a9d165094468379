/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/sweep.h"

#include "base/api_check.h"
#include "base/file.h"
#include "base/hash.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- texts */

/* Add hashes of the data of the tables of the file, and of the varying files, to the key. */
static bool add_data(struct fbd_sweep *sweep, fbd_errors *errors)
{
    struct text *key = &sweep->key;
    rows_tables(sweep->rows, key);
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
    if (plan->find)
        text_printf(key, "find %s, %zu runs%s\n", plan->find, plan->find_runs,
                    plan->statics ? ", statics" : "");
    text_printf(key, "method %s, tolerance ", plan->run->method ? plan->run->method : "of the file");
    text_number(key, plan->run->tolerance, 17);
    text_add(key, ", step ");
    text_number(key, plan->run->step, 17);
    text_add(key, ", until ");
    text_number(key, plan->run->until, 17);
    if (plan->run->automatic_step) text_add(key, ", automatic steps");
    text_add(key, plan->run->no_structure ? ", no structure\n" : "\n");
}

/* ---- making and freeing */

static void put_value(const void *context, size_t parameter, uint64_t run, struct text *text)
{
    const struct axes *axes = context;
    axes_value(axes, &axes->members[parameter], run, text);
}

/* Prepare the rows of the varying parameters, and try the first and the last of them. */
static bool prepare(struct fbd_sweep *sweep, const fbd_sweep_plan *plan, fbd_errors *errors)
{
    const struct axes *axes = &sweep->axes;
    struct rows_parameter *parameters = ARENA_ARRAY(&sweep->arena, axes->member_count, struct rows_parameter);
    if (!parameters) return false;
    for (size_t i = 0; i < axes->member_count; i++)
        parameters[i] = (struct rows_parameter){.name = axes->members[i].name,
                                                .unit = axes->members[i].unit,
                                                .files = axes->members[i].kind == values_words};
    const struct rows_source source = {parameters, axes->member_count, put_value, axes, "--vary", "--output"};
    if (!rows_prepare(sweep->rows, &source, plan, errors)) return false;
    return rows_try(sweep->rows, 0, errors) &&
           (axes->runs == 1 || rows_try(sweep->rows, axes->runs - 1, errors));
}

static bool build(struct fbd_sweep *sweep, const char *name, const fbd_sweep_plan *plan, fbd_errors *errors)
{
    const char *file = name ? arena_text(&sweep->arena, name, strlen(name)) : NULL;
    bool axes =
        axes_read(&sweep->axes, &sweep->arena, plan->vary, plan->vary_count, plan->zip, plan->seed, errors);
    sweep->rows = rows_open(sweep->source, sweep->source_length, file, errors);
    if (!sweep->rows || !axes || !prepare(sweep, plan, errors)) return false;
    sweep->name = file;
    if (!plan->find)
        rows_header(sweep->rows, &sweep->header);
    else if (!sweep_find_prepare(sweep, plan, errors))
        return false;
    set_key(sweep, plan);
    return add_data(sweep, errors) && !sweep->header.failed && !sweep->key.failed;
}

/* Make a sweep and take ownership of `text`. NULL with notes in `errors`: those of a wrong file, `bad-vary`,
 * `unknown-output`, `unknown-parameter`, `varied-twice`, and those of wrong options. */
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
    else if (plan->find && (plan->output_count > 0 || plan->degrees))
        api_refuse(errors, "a question takes the place of outputs");
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
    rows_free(sweep->rows);
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
