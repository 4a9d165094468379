/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "finding.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "deliver.h"
#include "fbd_find.h"
#include "fbd_view.h"
#include "place.h"

bool finding_agrees(const struct options *options, const struct command_line *line)
{
    if (options->fit && (options->find || options->action == action_static))
        return command_line_usage(line, "--fit goes without --find and --static", "");
    if (options->action != action_run && options->action != action_static)
        return command_line_usage(line, "--find and --fit go with a run, --find also with --static", "");
    if ((options->find && (options->plot || options->gnuplot)) || options->svg || options->csv ||
        options->html || options->note || options->plot_of || options->at_count || options->settle ||
        options->watch || options->full || options->degrees)
        return command_line_usage(
            line,
            "--find goes with --set, --without, --static, --runs, --json, --until, --method, --tolerance, "
            "--step and --no-structure only, --fit also with --plot and --gnuplot",
            "");
    if (options->run.error_bars || options->run.accuracy > 0)
        return command_line_usage(
            line,
            "--find and --fit have the errors of their values by themselves: without --error-bars "
            "and --accuracy",
            "");
    if (options->fit && isfinite(options->run.until))
        return command_line_usage(line,
                                  "--until does not go with --fit: a run ends at the last time of the data",
                                  "");
    return true;
}

static bool is_among(const fbd_error *note, fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const fbd_error other = fbd_errors_get(errors, i);
        if (strcmp(other.id, note->id) == 0 && strcmp(other.message, note->message) == 0) return true;
    }
    return false;
}

/* Print the notes that were not printed for the file. The exit code of the first error. */
static enum exit_code print_notes(fbd_errors *notes, fbd_errors *errors)
{
    enum exit_code code = exit_done;
    for (size_t i = 0; i < fbd_errors_count(notes); i++) {
        const fbd_error note = fbd_errors_get(notes, i);
        if (code == exit_done && note.severity == FBD_ERROR)
            code = note.line > 0 ? exit_bad_model : exit_usage;
        if (is_among(&note, errors)) continue;
        char place[40] = "";
        if (note.line > 0) snprintf(place, sizeof place, ":%d:%d", note.line, note.column);
        complain("%s%s: %s: %s [%s]", note.file ? note.file : "fbd-run", place,
                 note.severity == FBD_ERROR ? "error" : "warning", note.message, note.id);
        if (note.hint) complain("    hint: %s", note.hint);
    }
    return exit_code_for(code, notes);
}

/* The searched value exists, and no run of the search failed. */
static enum exit_code verdict(const fbd_find *find)
{
    size_t solutions = 0, failed = 0;
    for (size_t i = 0; i < fbd_find_solution_count(find); i++)
        solutions += fbd_find_solution(find, i).kind != FBD_SOLUTION_JUMP;
    for (size_t i = 0; i < fbd_find_gap_count(find); i++) failed += fbd_find_gap_get(find, i).failed;
    if (failed)
        complain("fbd-run: %zu runs of the search did not succeed, and their neighbourhood was not searched",
                 failed);
    return solutions > 0 && failed == 0 ? exit_done : exit_failed;
}

enum exit_code finding(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    size_t length;
    const char *source = fbd_model_source(model, &length);
    const fbd_find_plan plan = {.size = sizeof plan,
                                .settings = options->settings,
                                .setting_count = options->setting_count,
                                .run = &options->run,
                                .statics = options->action == action_static,
                                .runs = options->find_runs};
    fbd_errors *notes = fbd_errors_new();
    fbd_find *find =
        notes ? fbd_find_parse(source, length, fbd_model_file(model), options->find, &plan, notes) : NULL;
    enum exit_code code = notes ? print_notes(notes, errors) : exit_failed;
    if (find) {
        const bool quiet = options->quiet || place_is_stdout(options->json);
        bool written = quiet || deliver_text(NULL, fbd_find_text(find));
        if (options->json && !deliver_text(options->json, fbd_find_json(find))) written = false;
        fflush(stdout);
        code = written ? verdict(find) : exit_failed;
    }
    fbd_find_free(find);
    fbd_errors_free(notes);
    return code;
}

/* ---- --fit */

/* The text of a file, to be freed; NULL with a message. */
static char *read_text(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    size_t room = 0;
    *length = 0;
    for (size_t read = 1; file && read > 0; *length += read) {
        if (*length == room) {
            char *larger = realloc(text, room = room ? 2 * room : 65536);
            if (!larger) break;
            text = larger;
        }
        read = fread(text + *length, 1, room - *length, file);
    }
    const bool whole = file && feof(file) && !ferror(file);
    if (!whole) complain("fbd-run: cannot read `%s`: %s", path, strerror(errno));
    if (file) fclose(file);
    if (whole) return text;
    free(text);
    return NULL;
}

static fbd_fit *fit_to(const fbd_model *model, const struct options *options, char *list, fbd_errors *notes)
{
    enum { most_names = 100 };
    const char *names[most_names];
    size_t length, data_length;
    const char *source = fbd_model_source(model, &length);
    char *data = read_text(options->fit, &data_length);
    const fbd_fit_plan plan = {.size = sizeof plan,
                               .parameters = names,
                               .parameter_count = cut_list(list, names, most_names),
                               .settings = options->settings,
                               .setting_count = options->setting_count,
                               .run = &options->run};
    fbd_fit *fit = data ? fbd_fit_parse(source, length, fbd_model_file(model), data, data_length,
                                        options->fit, &plan, notes)
                        : NULL;
    free(data);
    return fit;
}

/* A fit is done if the data determine all parameters. */
static enum exit_code show_fit(const fbd_fit *fit, const struct options *options)
{
    const bool quiet = options->quiet || options_use_stdout(options);
    bool written = quiet || deliver_text(NULL, fbd_fit_text(fit)), determined = true;
    if (options->json && !deliver_text(options->json, fbd_fit_json(fit))) written = false;
    if (options->gnuplot && !deliver_text(options->gnuplot, fbd_fit_gnuplot(fit, options->plot)))
        written = false;
    if (options->plot && !deliver_plot(options->plot, fbd_fit_gnuplot(fit, options->plot))) written = false;
    for (size_t i = 0; i < fbd_fit_count(fit); i++) determined &= !isinf(fbd_fit_get(fit, i).error);
    fflush(stdout);
    return written && determined ? exit_done : exit_failed;
}

/* The exit code of a fit that was not made. */
static enum exit_code blame_fit(fbd_errors *notes)
{
    for (size_t i = 0; i < fbd_errors_count(notes); i++) {
        const fbd_error note = fbd_errors_get(notes, i);
        if (note.severity == FBD_ERROR)
            return exit_code_for(strcmp(note.id, "no-fit") == 0 ? exit_failed : exit_usage, notes);
    }
    return exit_usage; /* the data cannot be read */
}

enum exit_code fitting(const fbd_model *model, const struct options *options, fbd_errors *errors)
{
    fbd_errors *notes = fbd_errors_new();
    char *list = options->parameters ? strdup(options->parameters) : NULL;
    fbd_fit *fit = notes ? fit_to(model, options, list, notes) : NULL;
    if (notes) print_notes(notes, errors);
    enum exit_code code = fit ? show_fit(fit, options) : notes ? blame_fit(notes) : exit_failed;
    fbd_fit_free(fit);
    fbd_errors_free(notes);
    free(list);
    return code;
}
