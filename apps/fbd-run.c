/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd-run: read a model, look at it or run it, write what was asked for.
 */
#include <errno.h>
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "options.h"
#include "whole_file.h"

static enum exit_code no_memory(void)
{
    fputs("fbd-run: out of memory\n", stderr);
    return exit_failed;
}

/* Print a text of the library and free it. */
static enum exit_code print(char *text, enum exit_code code)
{
    if (!text) return no_memory();
    fputs(text, stdout);
    free(text);
    if (fflush(stdout) == 0) return code;
    fprintf(stderr, "fbd-run: cannot write to standard output: %s\n", strerror(errno));
    return exit_failed;
}

/* Say so when the accuracy that was asked for has not been reached. */
static enum exit_code accurate(const fbd_result *result, const fbd_simulation *simulation)
{
    if (fbd_result_accurate(result)) return exit_done;
    fbd_stats stats = fbd_simulation_stats(simulation);
    fprintf(stderr, "fbd-run: the accuracy %g was not reached: ", stats.accuracy);
    if (isfinite(stats.error_estimate))
        fprintf(stderr, "%.2g is the best of %lu runs, at tolerance %g\n", stats.error_estimate, stats.runs,
                stats.tolerance);
    else
        fputs("no more accurate run comes to the end, so the error is not known\n", stderr);
    return exit_inaccurate;
}

/* ---- the state that --at asks for */

static bool set_coordinate(fbd_state *state, const char *text, fbd_errors *errors)
{
    const char *equals = strchr(text, '=');
    char name[200];
    size_t length = (size_t)(equals - text);
    if (length >= sizeof name) return false;
    memcpy(name, text, length);
    name[length] = '\0';
    return fbd_state_set_text(state, name, equals + 1, errors);
}

/* Run until `t` and take the state there. */
static enum exit_code run_until(const fbd_model *model, const struct options *options, double t,
                                fbd_state *state, fbd_errors *errors)
{
    fbd_options run = options->run;
    run.until = t;
    fbd_simulation *simulation = fbd_simulation_new(model, &run, errors);
    if (!simulation) return exit_usage;
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    double from, to;
    fbd_simulation_interval(simulation, &from, &to);
    enum exit_code code = result ? exit_failed : no_memory();
    if (result && to == t)
        code = !fbd_simulation_state(simulation, t, state) ? exit_failed : accurate(result, simulation);
    else if (result)
        fprintf(stderr, "fbd-run: the run ends before t = %g: %s\n", t, fbd_simulation_reason(simulation));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    return code;
}

static enum exit_code place(const fbd_model *model, const struct options *options, fbd_state *state,
                            fbd_errors *errors)
{
    for (size_t i = 0; i < options->at_count; i++) {
        if (strchr(options->at[i], '=')) {
            if (!set_coordinate(state, options->at[i], errors)) return exit_usage;
            continue;
        }
        char *end;
        double t = strtod(options->at[i], &end);
        if (end == options->at[i] || *end) {
            fprintf(stderr, "fbd-run: --at wants a time in seconds or NAME=VALUE, not `%s`\n",
                    options->at[i]);
            return exit_usage;
        }
        enum exit_code code = run_until(model, options, t, state, errors);
        if (code != exit_done) return code;
    }
    return exit_done;
}

/* ---- instead of a run */

static enum exit_code show_state(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    fbd_state *state = fbd_state_new(model);
    if (!state) return no_memory();
    enum exit_code code = place(model, options, state, errors);
    if (code == exit_done && options->action == action_equations) {
        code = print(fbd_equations_text(state), exit_done);
    } else if (code == exit_done) {
        fbd_linearization *linear = fbd_linearize(state, errors);
        code = linear ? print(fbd_linearization_text(linear), exit_done) : exit_failed;
        fbd_linearization_free(linear);
    }
    fbd_state_free(state);
    return code;
}

static enum exit_code check_hand(const fbd_model *model, const struct options *options)
{
    char *text = NULL;
    int differ = fbd_check_hand(model, options->seed, &text);
    return print(text, differ > 0 ? exit_hand_differs : exit_done);
}

/* ---- a run */

/* What is wrong with the options stands in the file when it has a place there. */
static enum exit_code blame(fbd_errors *errors)
{
    const fbd_error *first = fbd_errors_get(errors, 0);
    return first && first->line > 0 ? exit_bad_model : exit_usage;
}

struct outputs {
    struct whole_file csv, json;
};

static bool open_outputs(const struct options *options, struct outputs *outputs)
{
    const char *failed = NULL;
    if (options->csv && !whole_file_open(&outputs->csv, options->csv)) failed = options->csv;
    if (!failed && options->json && !whole_file_open(&outputs->json, options->json)) failed = options->json;
    if (!failed) return true;
    fprintf(stderr, "fbd-run: cannot write `%s`: %s\n", failed, strerror(errno));
    whole_file_close(&outputs->csv, false);
    return false;
}

static bool close_outputs(struct outputs *outputs, bool keep)
{
    struct whole_file *files[] = {&outputs->csv, &outputs->json};
    bool done = true;
    for (int i = 0; i < 2; i++) {
        if (whole_file_close(files[i], keep)) continue;
        fprintf(stderr, "fbd-run: cannot write `%s`: %s\n", files[i]->path, strerror(errno));
        done = false;
    }
    return done;
}

/* The report needs the works; it goes to standard output unless data goes there. */
static bool wants_report(const struct options *options, const struct outputs *outputs)
{
    return !options->quiet && outputs->csv.stream != stdout && outputs->json.stream != stdout;
}

static enum exit_code write_result(const struct options *options, fbd_result *result, struct outputs *outputs)
{
    char *json = outputs->json.stream ? fbd_result_json(result) : NULL;
    if (outputs->json.stream && !json) return no_memory();
    if (json)
        whole_file_write(&outputs->json, json, strlen(json)); /* an error shows when the file is closed */
    free(json);
    if (!wants_report(options, outputs)) return exit_done;
    return print(fbd_result_report(result), exit_done);
}

static enum exit_code run(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    fbd_simulation *simulation = fbd_simulation_new(model, &options->run, errors);
    if (!simulation) return blame(errors);
    struct outputs outputs = {0};
    enum exit_code code = exit_failed;
    if (open_outputs(options, &outputs)) {
        fbd_recording recording = {.every = options->every,
                                   .ledger = options->ledger,
                                   .csv = options->csv ? whole_file_write : NULL,
                                   .csv_context = &outputs.csv,
                                   .motion_only = !outputs.json.stream && !wants_report(options, &outputs)};
        fbd_result *result = fbd_simulation_run(simulation, &recording);
        bool refused = outputs.csv.stream && ferror(outputs.csv.stream); /* said when it is closed */
        code = result ? write_result(options, result, &outputs) : refused ? exit_failed : no_memory();
        if (!close_outputs(&outputs, result != NULL)) code = exit_failed;
        fbd_outcome outcome = result ? fbd_result_outcome(result) : FBD_FAILED;
        if (outcome != FBD_FAILED && code == exit_done) code = accurate(result, simulation);
        if (result && outcome != FBD_DONE && outcome != FBD_STOPPED) {
            fprintf(stderr, "fbd-run: %s\n", fbd_simulation_reason(simulation));
            code = exit_failed;
        }
        fbd_result_free(result);
    }
    fbd_simulation_free(simulation);
    return code;
}

static enum exit_code act(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    switch (options->action) {
    case action_check: return exit_done;
    case action_check_hand: return check_hand(model, options);
    case action_explain: return print(fbd_explain(model, &options->run), exit_done);
    case action_equations:
    case action_linearize: return show_state(model, options, errors);
    case action_run: break;
    }
    return run(model, options, errors);
}

static enum exit_code read_and_act(const struct options *options)
{
    fbd_errors *errors = fbd_errors_new();
    if (!errors) return no_memory();
    fbd_model *model = fbd_model_read(options->model, options->settings, options->setting_count, errors);
    enum exit_code code = model ? act(model, options, errors) : exit_bad_model;
    fflush(stdout);
    fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    fbd_model_free(model);
    return code;
}

int main(int argc, char **argv)
{
    struct options options;
    enum exit_code code;
    gsl_set_error_handler_off(); /* every status is looked at instead */
    if (options_read(argc, argv, &options, &code)) code = read_and_act(&options);
    return (int)code;
}
