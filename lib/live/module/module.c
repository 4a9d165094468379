/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The functions that the worker of a live page calls, compiled to WebAssembly: texts in, JSON out. They only call the library, as fbd-run does.
 *
 * `off` lists the effects that are switched off, one per line. Answers are to be freed with free(); NULL when
 * memory is out.
 */
#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fbd.h"
#include "fbd_export.h"
#include "fbd_find.h"
#include "fbd_grade.h"
#include "fbd_study.h"
#include "module.h"

enum { most_off = 256, most_settings = 256 };

/* ---- texts */

static char *joined(const char *const *parts)
{
    size_t length = 0;
    for (const char *const *part = parts; *part; part++) length += strlen(*part);
    char *text = malloc(length + 1), *end = text;
    for (const char *const *part = parts; text && *part; part++) end = stpcpy(end, *part);
    return text;
}

/* A text as a JSON string. */
static char *quoted(const char *text)
{
    char *json = text ? malloc(6 * strlen(text) + 3) : NULL, *end = json;
    if (!json) return NULL;
    *end++ = '"';
    for (; *text; text++)
        if (*text == '"' || *text == '\\' || (unsigned char)*text < ' ')
            end += sprintf(end, "\\u%04x", (unsigned)(unsigned char)*text);
        else
            *end++ = *text;
    *end++ = '"';
    *end = '\0';
    return json;
}

/* Names of a text, one per line; the text is cut up. */
static size_t split(char *text, const char *names[most_off])
{
    size_t count = 0;
    for (char *name = strtok(text, "\n"); name && count < most_off; name = strtok(NULL, "\n"))
        names[count++] = name;
    return count;
}

/* ---- models */

/* The text without the effects in `off`; NULL with notes if that is no model. */
static char *without(const char *text, const char *name, const char *off, fbd_errors *errors)
{
    char *list = strdup(off), *shown = NULL;
    const char *names[most_off];
    size_t count = list ? split(list, names) : 0;
    fbd_model *model = count > 0 ? fbd_model_parse(text, strlen(text), name, NULL, 0, errors) : NULL;
    if (count == 0)
        shown = strdup(text);
    else if (model)
        shown = fbd_model_without(model, names, count, errors);
    fbd_model_free(model);
    free(list);
    return shown;
}

static fbd_model *read_model(const char *text, const char *name, const char *off, fbd_errors *errors)
{
    char *shown = without(text, name, off, errors);
    fbd_model *model = shown ? fbd_model_parse(shown, strlen(shown), name, NULL, 0, errors) : NULL;
    free(shown);
    return model;
}

/* {"errors": ..., KEY: VALUE}; frees `errors` and `value`. */
static char *answer(fbd_errors *errors, const char *key, char *value)
{
    char *notes = fbd_errors_json(errors);
    const char *const parts[] = {"{\"errors\":", notes ? notes : "[]",   ",\"", key,
                                 "\":",          value ? value : "null", "}",   NULL};
    char *all = joined(parts);
    free(notes);
    free(value);
    fbd_errors_free(errors);
    return all;
}

char *live_schema(void)
{
    return fbd_schema();
}

char *live_text(const char *text, const char *name, const char *off)
{
    fbd_errors *errors = fbd_errors_new();
    char *shown = without(text, name, off, errors);
    fbd_errors_free(errors);
    return shown;
}

char *live_controls(const char *text, const char *name)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, strlen(text), name, NULL, 0, errors);
    char *controls = model ? fbd_model_controls(model, errors) : NULL;
    fbd_model_free(model);
    return answer(errors, "controls", controls);
}

/* The numbers of a text, divided by blanks; NULL when memory is out. */
static double *read_numbers(const char *text, size_t *count)
{
    double *numbers = malloc((strlen(text) / 2 + 1) * sizeof *numbers);
    *count = 0;
    for (char *end; numbers; text = end) {
        numbers[*count] = strtod(text, &end);
        if (end == text) break;
        ++*count;
    }
    return numbers;
}

char *live_pulled(const char *text, const char *name, const char *body, const char *path, double x, double y,
                  double stiffness, double from, double to)
{
    fbd_errors *errors = fbd_errors_new();
    size_t count;
    double *numbers = read_numbers(path, &count);
    const fbd_pull pull = {.body = body,
                           .at = {x, y},
                           .stiffness = stiffness,
                           .from = from,
                           .to = to,
                           .path = numbers,
                           .count = count / 3};
    fbd_model *model = fbd_model_parse(text, strlen(text), name, NULL, 0, errors);
    char *pulled = model ? fbd_model_pulled(model, &pull, errors) : NULL, *json = quoted(pulled);
    fbd_free(pulled);
    fbd_model_free(model);
    free(numbers);
    return answer(errors, "text", json);
}

/* ---- runs */

static double milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

/* Report at most as often as a page shows the progress. */
static int progress(void *context, const fbd_progress *now)
{
    double *last = context, clock = milliseconds();
    if (clock - *last < 100) return 0;
    *last = clock;
    bool run = strcmp(now->what, "run") == 0;
    page_progress(run ? now->t : now->share, run ? now->until : 1);
    return 0;
}

char *live_run(const char *text, const char *name, const char *off, double rows)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = read_model(text, name, off, errors);
    fbd_simulation *simulation = model ? fbd_simulation_new(model, NULL, errors) : NULL;
    double last = milliseconds();
    fbd_recording recording = {.keep = true,
                               .rows = (unsigned)rows,
                               .progress = progress,
                               .progress_context = &last};
    fbd_result *result = simulation ? fbd_simulation_run(simulation, &recording) : NULL;
    fbd_outcome outcome = result ? fbd_result_outcome(result) : FBD_DONE;
    if (result && outcome != FBD_DONE && outcome != FBD_STOPPED) fbd_simulation_blame(simulation, errors);
    char *data = result ? fbd_result_page_data(result, 0, errors) : NULL;
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return answer(errors, "data", data);
}

struct growing {
    char *text;
    size_t length, room;
};

static int grow(void *context, const char *text, size_t length)
{
    struct growing *growing = context;
    if (growing->length + length + 1 > growing->room) {
        size_t room = 2 * (growing->length + length + 1);
        char *more = realloc(growing->text, room);
        if (!more) return 1;
        growing->text = more;
        growing->room = room;
    }
    memcpy(growing->text + growing->length, text, length);
    growing->length += length;
    growing->text[growing->length] = '\0';
    return 0;
}

char *live_csv(const char *text, const char *name, const char *off)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = read_model(text, name, off, errors);
    fbd_simulation *simulation = model ? fbd_simulation_new(model, NULL, errors) : NULL;
    struct growing csv = {0};
    fbd_recording recording = {.ledger = true, .csv = grow, .csv_context = &csv};
    fbd_result *result = simulation ? fbd_simulation_run(simulation, &recording) : NULL;
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return csv.text;
}

/* ---- cost of accuracy */

char *live_cost(const char *text, const char *name, const char *off, double budget)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = read_model(text, name, off, errors);
    double last = milliseconds();
    fbd_cost_options options = FBD_COST_OPTIONS_DEFAULT;
    options.budget = budget;
    options.progress = progress;
    options.progress_context = &last;
    fbd_cost *cost = model ? fbd_cost_new(model, &options, errors) : NULL;
    char *svg = cost ? fbd_cost_svg(cost) : NULL;
    fbd_cost_free(cost);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return svg;
}

/* ---- derivations and answers */

char *live_check_hand(const char *text, const char *name)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, strlen(text), name, NULL, 0, errors);
    size_t differing = 0;
    char *verdict = model ? fbd_check_hand(model, 1, &differing) : NULL, *json = quoted(verdict);
    char number[40];
    snprintf(number, sizeof number, "%zu", differing);
    const char *const parts[] = {"{\"differing\":", number, ",\"text\":", json ? json : "", "}", NULL};
    char *hand = json ? joined(parts) : NULL;
    free(json);
    free(verdict);
    fbd_model_free(model);
    return answer(errors, "hand", hand);
}

/* Split lines NAME=VALUE in place. */
static size_t read_settings(char *lines, fbd_setting settings[most_settings])
{
    size_t count = 0;
    for (char *line = lines; line && *line && count < most_settings;) {
        char *end = strchr(line, '\n'), *value = strchr(line, '=');
        if (!end || !value || value > end) break;
        *end = *value = '\0';
        settings[count++] = (fbd_setting){line, value + 1};
        line = end + 1;
    }
    return count;
}

char *live_grade(const char *key_text, const char *settings, const char *text, const char *student,
                 double details)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_setting values[most_settings];
    const char *const parts[] = {settings, NULL};
    char *lines = joined(parts);
    size_t count = read_settings(lines, values);
    fbd_key *key = lines ? fbd_key_parse(key_text, strlen(key_text), "key", values, count, errors) : NULL;
    fbd_grade *grade = key ? fbd_grade_parse(key, text, strlen(text), student, errors) : NULL;
    char *json = grade ? fbd_grade_json(grade, details != 0) : NULL;
    fbd_grade_free(grade);
    fbd_key_free(key);
    free(lines);
    return answer(errors, "grade", json);
}

/* ---- values and notes */

char *live_find(const char *text, const char *name, const char *question, double statics)
{
    fbd_errors *errors = fbd_errors_new();
    double last = milliseconds();
    const fbd_find_plan plan = {.statics = statics != 0, .progress = progress, .progress_context = &last};
    fbd_find *find = fbd_find_parse(text, strlen(text), name, question, &plan, errors);
    char *json = find ? fbd_find_json(find) : NULL;
    fbd_find_free(find);
    return answer(errors, "find", json);
}

char *live_note(const char *text, const char *name, const char *off)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = read_model(text, name, off, errors);
    fbd_options exact = FBD_OPTIONS_DEFAULT;
    exact.error_bars = true;
    fbd_simulation *simulation = model ? fbd_simulation_new(model, &exact, errors) : NULL;
    double last = milliseconds();
    const fbd_recording recording = {.table = true, .progress = progress, .progress_context = &last};
    fbd_result *result = simulation ? fbd_simulation_run(simulation, &recording) : NULL;
    const fbd_note_options options = {.progress = progress, .progress_context = &last};
    fbd_note *note = result ? fbd_note_new(simulation, result, &options, errors) : NULL;
    char *html = note ? fbd_note_write(note, FBD_NOTE_HTML, "note") : NULL, *json = quoted(html);
    fbd_free(html);
    fbd_note_free(note);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return answer(errors, "note", json);
}

/* Called once, before the others. */
void live_begin(void)
{
    gsl_set_error_handler_off(); /* every status is checked instead */
}
