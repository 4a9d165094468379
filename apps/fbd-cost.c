/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd-cost: the cost of accuracy for a scene, and the cost of each of its effects.
 */
#include <errno.h>
#include <gsl/gsl_errno.h>
#include <string.h>

#include "complain.h"
#include "cost_options.h"
#include "fbd_study.h"
#include "place.h"
#include "standard_streams.h"
#include "terminal_line.h"
#include "whole_file.h"

static enum exit_code no_memory(void)
{
    complain("fbd-cost: out of memory");
    return exit_failed;
}

/* ---- progress, on a terminal only */

static int show_progress(void *context, const fbd_progress *now)
{
    struct terminal_line *line = context;
    double elapsed;
    if (terminal_line_due(line, &elapsed))
        terminal_line_draw(line, "%-12s %3.0f %%", now->what, 100 * now->share);
    return 0;
}

/* ---- outputs */

struct output {
    const char *path;
    char *(*make)(const void *study);
};

static enum exit_code write_file(const char *path, char *text)
{
    if (!text) return no_memory();
    bool written = whole_file_put(path, text);
    if (!written) complain("fbd-cost: cannot write `%s`: %s", path, strerror(errno));
    fbd_free(text);
    return written ? exit_done : exit_failed;
}

static enum exit_code write_all(const struct cost_options *options, const struct output *outputs,
                                size_t count, char *(*table)(const void *study), const void *study)
{
    bool table_wanted = !options->quiet;
    for (size_t i = 0; i < count; i++) {
        if (!outputs[i].path) continue;
        if (place_is_stdout(outputs[i].path)) table_wanted = false;
        enum exit_code code = write_file(outputs[i].path, outputs[i].make(study));
        if (code != exit_done) return code;
    }
    return table_wanted ? write_file("-", table(study)) : exit_done;
}

static char *cost_text(const void *study)
{
    return fbd_cost_text(study);
}

static char *cost_csv(const void *study)
{
    return fbd_cost_csv(study);
}

static char *cost_json(const void *study)
{
    return fbd_cost_json(study);
}

static char *cost_svg(const void *study)
{
    return fbd_cost_svg(study);
}

static char *effects_text(const void *study)
{
    return fbd_effects_text(study);
}

static char *effects_csv(const void *study)
{
    return fbd_effects_csv(study);
}

static char *effects_json(const void *study)
{
    return fbd_effects_json(study);
}

/* ---- the studies */

/* Choose the exit code of a wrong option: an error with a position in the file is one of the model. */
static enum exit_code blame(fbd_errors *errors)
{
    const fbd_error first = fbd_errors_get(errors, 0);
    if (!first.id) return exit_failed;
    if (strcmp(first.id, "no-reference") == 0) return exit_failed;
    return first.line > 0 ? exit_bad_model : exit_usage;
}

/* Report an invalid or incomplete reference. */
static enum exit_code judge(const fbd_cost *cost)
{
    fbd_reference reference = fbd_cost_reference(cost);
    if (reference.exact_differs) {
        complain("fbd-cost: %s", reference.says);
        return exit_hand_differs;
    }
    if (reference.complete) return exit_done;
    complain("fbd-cost: %s", reference.says);
    return exit_failed;
}

static enum exit_code study_cost(const fbd_model *model, const struct cost_options *options,
                                 fbd_errors *errors)
{
    fbd_cost *cost = fbd_cost_new(model, &options->study, errors);
    terminal_line_end(options->study.progress_context);
    if (!cost) return blame(errors);
    const struct output outputs[] = {{options->csv, cost_csv},
                                     {options->json, cost_json},
                                     {options->svg, cost_svg}};
    enum exit_code code = write_all(options, outputs, 3, cost_text, cost);
    fflush(stdout);
    if (code == exit_done) code = judge(cost);
    fbd_cost_free(cost);
    return code;
}

static enum exit_code study_effects(const fbd_model *model, const struct cost_options *options,
                                    fbd_errors *errors)
{
    fbd_effects *effects = fbd_effects_new(model, &options->study, errors);
    terminal_line_end(options->study.progress_context);
    if (!effects) return blame(errors);
    const struct output outputs[] = {{options->csv, effects_csv}, {options->json, effects_json}};
    enum exit_code code = write_all(options, outputs, 2, effects_text, effects);
    fbd_effects_free(effects);
    return code;
}

static enum exit_code read_and_study(const struct cost_options *options)
{
    fbd_errors *errors = fbd_errors_new();
    if (!errors) return no_memory();
    fbd_model *model = fbd_model_read(options->model, options->settings, options->setting_count, errors);
    enum exit_code code = exit_bad_model;
    if (model && !cost_options_spare(options, errors))
        code = exit_usage;
    else if (model)
        code = options->effects ? study_effects(model, options, errors) : study_cost(model, options, errors);
    fflush(stdout);
    fbd_errors_print(errors, stderr);
    code = exit_code_for(code, errors);
    fbd_errors_free(errors);
    fbd_model_free(model);
    return code;
}

int main(int argc, char **argv)
{
    struct cost_options options;
    enum exit_code code;
    struct terminal_line line;
    standard_streams_begin();
    gsl_set_error_handler_off(); /* every status is checked instead */
    if (cost_options_read(argc, argv, &options, &code)) {
        terminal_line_begin(&line, true);
        options.study.progress = show_progress;
        options.study.progress_context = &line;
        code = read_and_study(&options);
    }
    return (int)code;
}
