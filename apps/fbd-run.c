/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd-run: read a model, inspect it or run it, and write the requested outputs.
 */
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "cutting.h"
#include "deliver.h"
#include "examples.h"
#include "fbd_export.h"
#include "fbd_grade.h"
#include "fbd_study.h"
#include "fbd_view.h"
#include "finding.h"
#include "fmu.h"
#include "grading.h"
#include "linearizing.h"
#include "live_page.h"
#include "options.h"
#include "outputs.h"
#include "place.h"
#include "run_progress.h"
#include "standard_streams.h"

static enum exit_code no_memory(void)
{
    complain("fbd-run: out of memory");
    return exit_failed;
}

/* Print a text of the library and free it. */
static enum exit_code print(char *text, enum exit_code code)
{
    return deliver_text(NULL, text) ? code : exit_failed;
}

/* Report a violated energy balance. */
static enum exit_code balanced(fbd_result *result)
{
    double residual, explained;
    if (fbd_result_balanced(result, &residual, &explained)) return exit_done;
    complain("fbd-run: the motion is not accurate: the residual of its energy is %.2g, where the tolerance "
             "explains "
             "%.2g. Steps have gone over something much shorter than they are: give a small --step",
             residual, explained);
    return exit_inaccurate;
}

/* Report if the requested accuracy was not reached; `interrupt` may be NULL. */
static enum exit_code accurate(const fbd_result *result, const fbd_simulation *simulation,
                               const struct interrupt *interrupt)
{
    if (fbd_result_accurate(result)) return exit_done;
    fbd_stats stats = fbd_simulation_stats(simulation);
    const char *cut = interrupt && interrupt_asked(interrupt) ? "interrupted; " : "";
    if (isfinite(stats.error_estimate))
        complain("fbd-run: %sthe accuracy %g was not reached: %.2g is the best of %lu runs, at tolerance %g",
                 cut, stats.accuracy, stats.error_estimate, stats.runs, stats.tolerance);
    else
        complain("fbd-run: %sthe accuracy %g was not reached: no more accurate run is completed, so the "
                 "error is not known",
                 cut, stats.accuracy);
    return exit_inaccurate;
}

/* ---- the state of --at */

static bool set_coordinate(fbd_state *state, const char *text, bool degrees, fbd_errors *errors)
{
    const char *equals = strchr(text, '=');
    char name[200];
    size_t length = (size_t)(equals - text);
    if (length >= sizeof name) return false;
    memcpy(name, text, length);
    name[length] = '\0';
    return (degrees ? fbd_state_set_text_degrees : fbd_state_set_text)(state, name, equals + 1, errors);
}

/* Run until `t` and return the state there. */
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
        code = !fbd_simulation_state(simulation, t, state) ? exit_failed : accurate(result, simulation, NULL);
    else if (result)
        complain("fbd-run: the run ends before t = %g: %s", t, fbd_simulation_reason(simulation));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    return code;
}

static enum exit_code place(const fbd_model *model, const struct options *options, fbd_state *state,
                            fbd_errors *errors)
{
    for (size_t i = 0; i < options->at_count; i++) {
        if (strchr(options->at[i], '=')) {
            if (!set_coordinate(state, options->at[i], options->degrees, errors)) return exit_usage;
            continue;
        }
        double t;
        if (!command_line_seconds(options->at[i], &t)) {
            complain("fbd-run: --at wants a time, as `2` or `200ms`, or NAME=VALUE, not `%s`",
                     options->at[i]);
            return exit_usage;
        }
        enum exit_code code = run_until(model, options, t, state, errors);
        if (code != exit_done) return code;
    }
    return exit_done;
}

/* ---- instead of a run */

/* Write a text of the library to a file, and free it. */
static enum exit_code write_text(const char *path, char *text)
{
    return deliver_text(path, text) ? exit_done : exit_failed;
}

/* The same for the JSON of a result. */
static enum exit_code write_json(const struct options *options, char *text)
{
    *options->json_written = true;
    return write_text(options->json, text);
}

/* Then the message is all that there is. */
static bool is_out_of_memory(fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++)
        if (strcmp(fbd_errors_get(errors, i).id, "out-of-memory") == 0) return true;
    return false;
}

/* With --check the notes as {"notes": [...]}, if --json asks for them; without a result also where standard output
 * waits for one. A file that would have had it stays as it is. */
static enum exit_code write_notes(const struct options *options, fbd_errors *errors, enum exit_code code)
{
    const bool asked = options->action == action_check ||
                       (place_is_stdout(options->json) && fbd_errors_failed_count(errors) > 0);
    if (!options->json || *options->json_written || !asked || is_out_of_memory(errors)) return code;
    char *notes = fbd_errors_json(errors),
         *text = notes ? malloc(strlen(notes) + sizeof "{\"notes\":}\n") : NULL;
    if (text) sprintf(text, "{\"notes\":%s}\n", notes);
    fbd_free(notes);
    enum exit_code written = write_text(options->json, text);
    return code == exit_done ? written : code;
}

static enum exit_code write_picture(const char *path, char *svg)
{
    return deliver_picture(path, svg) ? exit_done : exit_failed;
}

/* Draw the diagram of a state, if requested. */
static enum exit_code draw_state(const struct options *options, fbd_state *state, fbd_errors *errors)
{
    if (!options->svg) return exit_done;
    char *svg = fbd_diagram_svg(state, &options->drawing, errors);
    if (svg) return write_picture(options->svg, svg);
    const fbd_error first = fbd_errors_get(errors, 0);
    return first.id && strcmp(first.id, "unknown-body") == 0 ? exit_usage : exit_failed;
}

/* Print the reactions that keep the state at rest; with --json as JSON instead of text. */
static enum exit_code show_statics(const struct options *options, fbd_state *state, fbd_errors *errors)
{
    if (options->settle && !fbd_find_equilibrium(state, errors)) return exit_failed;
    fbd_statics *statics = fbd_statics_new(state, errors);
    if (!statics) return exit_failed;
    enum exit_code written = exit_done, code = fbd_statics_holds(statics) ? exit_done : exit_failed;
    bool json_only = place_is_stdout(options->json);
    if (!json_only && !options->quiet) written = print(fbd_statics_text(statics), exit_done);
    if (written == exit_done && options->json) written = write_json(options, fbd_statics_json(statics));
    fbd_statics_free(statics);
    if (written == exit_done) written = draw_state(options, state, errors);
    return written == exit_done ? code : written;
}

/* True if data on standard output, or --quiet, suppresses the text. */
static bool data_alone(const struct options *options)
{
    return options->quiet || place_is_stdout(options->svg) || place_is_stdout(options->json);
}

static enum exit_code show_equations(const struct options *options, fbd_state *state)
{
    const bool symbols = options->drawing.symbols && !options->svg; /* else for the arrows */
    fbd_equations_options written = {.size = sizeof written,
                                     .format = options->latex ? FBD_LATEX
                                               : symbols      ? FBD_SYMBOLS
                                                              : FBD_TEXT,
                                     .components = options->drawing.components || symbols};
    enum exit_code code = exit_done;
    if (!data_alone(options)) code = print(fbd_equations_write(state, &written, NULL), code);
    written.format = FBD_JSON;
    if (code == exit_done && options->json)
        code = write_json(options, fbd_equations_write(state, &written, NULL));
    return code;
}

static enum exit_code show_placed(const struct options *options, fbd_state *state, fbd_errors *errors)
{
    if (options->cut) return cutting(options, state, errors);
    if (options->action == action_static) return show_statics(options, state, errors);
    if (options->action == action_linearize) return linearizing(options, state, errors);
    if (!fbd_state_close(state, errors)) return exit_failed;
    const enum exit_code code = show_equations(options, state);
    return code == exit_done ? draw_state(options, state, errors) : code;
}

static enum exit_code show_state(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    fbd_state *state = fbd_state_new(model);
    if (!state) return no_memory();
    fbd_state_show_degrees(state, options->degrees);
    enum exit_code code = place(model, options, state, errors);
    if (code == exit_done) code = show_placed(options, state, errors);
    fbd_state_free(state);
    return code;
}

/* Check that the start is admissible, which a readable file does not guarantee. */
static enum exit_code check_start(const fbd_model *model, fbd_errors *errors)
{
    fbd_state *state = fbd_state_new(model);
    if (!state) return no_memory();
    enum exit_code code = fbd_state_close(state, errors) ? exit_done : exit_failed;
    fbd_state_free(state);
    return code;
}

/* Check the start; grade a key against itself. */
static enum exit_code check(const fbd_model *model, fbd_errors *errors)
{
    enum exit_code code = check_start(model, errors);
    return fbd_model_check_key(model, errors) ? code : exit_bad_model;
}

/* Check the derivations. Without an admissible start all would differ, so that error is reported instead. */
static enum exit_code check_hand(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    size_t differing;
    char *text = fbd_check_hand(model, options->seed, &differing);
    if (text && differing > 0 && check_start(model, errors) != exit_done) {
        free(text);
        return exit_failed;
    }
    return print(text, differing > 0 ? exit_hand_differs : exit_done);
}

/* ---- a run */

/* Draw the diagram of a separate state: at the start, or that of --at. */
static enum exit_code draw_diagram(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    if (!options->svg) return exit_done;
    fbd_state *state = fbd_state_new(model);
    if (!state) return no_memory();
    /* An inadmissible start has no diagram; the following run reports the reason, except lack of memory. */
    fbd_errors *why = fbd_errors_new();
    bool refused = options->at_count == 0 && !fbd_state_close(state, why);
    bool lacking = !why || exit_code_for(exit_done, why) != exit_done;
    fbd_errors_free(why);
    enum exit_code code = lacking ? no_memory() : refused ? exit_done : place(model, options, state, errors);
    if (code == exit_done && !refused) code = draw_state(options, state, errors);
    fbd_state_free(state);
    return code;
}

/* Choose the exit code of a wrong option: an error with a position in the file is one of the model. */
static enum exit_code blame(fbd_errors *errors)
{
    const fbd_error first = fbd_errors_get(errors, 0);
    return first.line > 0 ? exit_bad_model : exit_usage;
}

/* Run the simulation to its end or interruption, and write the requested outputs. */
static enum exit_code carry_and_write(fbd_simulation *simulation, const struct options *options,
                                      struct outputs *outputs, const struct interrupt *interrupt,
                                      fbd_errors *errors)
{
    bool report = !options->quiet && !options_use_stdout(options); /* it needs the works */
    struct run_progress progress;
    fbd_recording recording = {.every = options->every,
                               .ledger = options->ledger,
                               .components = options->drawing.components,
                               .degrees = options->degrees,
                               .csv = options->csv ? whole_file_write : NULL,
                               .csv_context = &outputs->files[output_csv],
                               .motion_only = !options->json && !options->note && !report,
                               .table = options->note != NULL,
                               .keep = options->html || options->plot || options->gnuplot,
                               .progress = run_progress_watch,
                               .progress_context = &progress};
    run_progress_begin(&progress, interrupt, report);
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    run_progress_end(&progress);
    bool refused = outputs->files[output_csv].stream &&
                   ferror(outputs->files[output_csv].stream); /* reported at closing */
    enum exit_code code = result ? exit_done : refused ? exit_failed : no_memory(), noted = exit_done;
    if (result && !outputs_write(outputs, options, result, errors)) code = exit_failed;
    if (code == exit_done &&
        !outputs_make_note(simulation, result, options, outputs, interrupt, errors, &noted))
        code = exit_failed;
    *options->json_written = result && code == exit_done;
    bool closed = outputs_close(outputs, result && code == exit_done) && outputs_announce(options, code);
    if (code == exit_done && report) code = print(fbd_result_report(result, options->full), exit_done);
    if (!closed) code = exit_failed;
    fbd_outcome outcome = result ? fbd_result_outcome(result) : FBD_FAILED;
    if (outcome != FBD_FAILED && outcome != FBD_INTERRUPTED && code == exit_done)
        code = accurate(result, simulation, interrupt);
    if (outcome != FBD_FAILED && code == exit_done) code = balanced(result); /* else see its reason */
    if (code == exit_done) code = noted;
    if (result && outcome != FBD_DONE && outcome != FBD_STOPPED) {
        if (!fbd_simulation_blame(simulation, errors))
            complain("fbd-run: %s", fbd_simulation_reason(simulation));
        code = exit_failed;
    }
    fbd_result_free(result);
    return code;
}

static enum exit_code run(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    if (options->plot_of && !fbd_model_has_columns(model, options->plot_of, errors)) return exit_usage;
    enum exit_code code = draw_diagram(model, options, errors);
    if (code != exit_done) return code;
    fbd_simulation *simulation = fbd_simulation_new(model, &options->run, errors);
    if (!simulation) return blame(errors);
    struct outputs outputs = {0};
    struct interrupt interrupt;
    interrupt_hold(&interrupt);
    code = exit_failed;
    if (outputs_open(&outputs, options, model))
        code = carry_and_write(simulation, options, &outputs, &interrupt, errors);
    fbd_simulation_free(simulation);
    fflush(stdout);
    interrupt_release(&interrupt);
    return code;
}

/* Errors of --until or --tolerance are those of the command line, all others those of the file. */
static enum exit_code emit_c(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    char *program = fbd_emit_c(model, &options->run, errors);
    return program ? write_text(options->emit_c, program) : blame(errors);
}

static enum exit_code act(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    if (options->find) return finding(model, options, errors);
    if (options->fit) return fitting(model, options, errors);
    if (options->cut) return show_state(model, options, errors);
    switch (options->action) {
    case action_check: return check(model, errors);
    case action_check_hand: return check_hand(model, options, errors);
    case action_fmu: return write_fmu(model, options, errors);
    case action_emit_c: return emit_c(model, options, errors);
    case action_explain: return print(fbd_explain(model, &options->run), exit_done);
    case action_equations:
    case action_static:
    case action_linearize: return show_state(model, options, errors);
    case action_grade:
    case action_handout:
    case action_examples:
    case action_example:
    case action_run: break;
    }
    return run(model, options, errors);
}

/* The model without the effects of --without; NULL with *code set when there is none. */
static fbd_model *leave_out(fbd_model *model, const struct options *options, fbd_errors *errors,
                            enum exit_code *code)
{
    if (!model || options->without_count == 0) return model;
    fbd_errors *others = fbd_errors_new(); /* warnings of the complete file were printed before */
    if (!others) *code = no_memory();
    const char *name = strcmp(options->model, "-") == 0 ? NULL : options->model;
    char *text = fbd_model_without(model, options->without, options->without_count, errors);
    fbd_model_free(model);
    model = text && others
                ? fbd_model_parse(text, strlen(text), name, options->settings, options->setting_count, others)
                : NULL;
    if (!model && others) {
        fbd_errors_print(others, stderr);
        *code = exit_code_for(*code, others);
    }
    fbd_errors_free(others);
    fbd_free(text);
    return model;
}

/* The scale of the diagrams is a force in the units of the model. */
static bool find_scale(struct options *options, const fbd_model *model, fbd_errors *errors)
{
    double *scale = &options->drawing.scale;
    if (!options->scale) return true;
    if (fbd_model_quantity(model, "--scale", options->scale, "N", scale, errors) && *scale > 0) return true;
    complain("fbd-run: --scale wants a force above 0, as `5` or `2 kN`, not `%s`", options->scale);
    return false;
}

/* A plain run does not need the derivations of its file. */
static bool is_plain_run(const struct options *options)
{
    return options->action == action_run && !options->find && !options->fit && !options->cut &&
           !options->html && !options->note;
}

static enum exit_code read_and_act(struct options *options)
{
    *options->json_written = false;
    fbd_errors *errors = fbd_errors_new();
    if (!errors) return no_memory();
    fbd_model *model =
        (is_plain_run(options) ? fbd_model_read_motion : fbd_model_read)(options->model, options->settings,
                                                                         options->setting_count, errors);
    if (options->watched) watch_tell(options->watched, errors);
    enum exit_code missing = exit_bad_model;
    model = leave_out(model, options, errors, &missing);
    const bool spare = options_spare(options, errors);
    enum exit_code code = !model                                        ? missing
                          : spare && find_scale(options, model, errors) ? act(model, options, errors)
                                                                        : exit_usage;
    fflush(stdout);
    fbd_errors_print(errors, stderr);
    code = exit_code_for(code, errors);
    if (spare) code = write_notes(options, errors, code);
    fbd_errors_free(errors);
    fbd_model_free(model);
    return code;
}

/* ---- watched runs */

static enum exit_code run_watched(void *context, const struct watched_run *run)
{
    struct options *options = context;
    options->watched = run;
    return read_and_act(options);
}

static void end_watch(void *context)
{
    const struct options *options = context;
    if (options->html) live_page_settle(options->html);
}

static enum exit_code run_again_and_again(struct options *options)
{
    struct watch watch = {"fbd-run", options->model, options->quiet, run_watched, end_watch, options};
    return watch_files(&watch);
}

int main(int argc, char **argv)
{
    struct options options;
    enum exit_code code;
    bool json_written;
    standard_streams_begin();
    gsl_set_error_handler_off(); /* every status is checked instead */
    if (options_read(argc, argv, &options, &code)) {
        options.json_written = &json_written;
        code = options.action == action_grade      ? grading(&options)
               : options.action == action_handout  ? handout(&options)
               : options.action == action_examples ? examples_list()
               : options.action == action_example  ? examples_print(options.example)
               : options.watch                     ? run_again_and_again(&options)
                                                   : read_and_act(&options);
    }
    return (int)code;
}
