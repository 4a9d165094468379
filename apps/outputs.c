/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "outputs.h"

#include <errno.h>
#include <string.h>

#include "complain.h"
#include "fbd_export.h"
#include "fbd_view.h"
#include "gnuplot.h"
#include "live_page.h"
#include "place.h"
#include "run_progress.h"

/* Close the note and its drawings. */
static bool note_end(struct outputs *outputs, bool keep)
{
    const char *path = NULL;
    if (note_close(&outputs->note, keep && outputs->note_made, &path)) return true;
    complain("fbd-run: cannot write `%s`: %s", path, strerror(errno));
    return false;
}

bool outputs_close(struct outputs *outputs, bool keep)
{
    bool done = true;
    for (int i = 0; i < output_count; i++) {
        struct whole_file *file = &outputs->files[i];
        if (whole_file_close(file, keep)) continue;
        if (!interrupt_by_pipe()) complain("fbd-run: cannot write `%s`: %s", file->path, strerror(errno));
        done = false;
    }
    return note_end(outputs, keep && done) && done;
}

/* False, with a message, when the file cannot be written. */
static bool open_file(struct whole_file *file, const char *path)
{
    if (!path || whole_file_open(file, path)) return true;
    complain("fbd-run: cannot write `%s`: %s", path, strerror(errno));
    *file = (struct whole_file){0};
    return false;
}

/* A file with the hash of its text. */
static void put_hashed(FILE *stream, const char *name, const char *file, const char *digits)
{
    char shown[place_size];
    fbd_escape(file ? file : "-", shown, sizeof shown);
    fprintf(stream, "# %s: %s, SHA-256 %s\n", name, shown, digits);
}

/* Write the comment lines of --origin. False, with a message, when memory is out. */
static bool write_origin(FILE *stream, const fbd_model *model)
{
    char *digits = fbd_model_hash(model);
    if (!digits) {
        complain("fbd-run: out of memory");
        return false;
    }
    fprintf(stream, "# fbd %s\n", fbd_version());
    put_hashed(stream, "model", fbd_model_file(model), digits);
    fbd_free(digits);
    for (size_t i = 0; i < fbd_model_data_file_count(model); i++)
        put_hashed(stream, "data", fbd_model_data_file(model, i).path, fbd_model_data_hash(model, i));
    fprintf(stream, "# parameters:");
    for (size_t i = 0; i < fbd_model_parameter_count(model); i++) {
        const fbd_parameter parameter = fbd_model_parameter(model, i);
        fprintf(stream, "%s %s = %.17g%s%s", i > 0 ? "," : "", parameter.name, parameter.value,
                parameter.unit[0] ? " " : "", parameter.unit);
    }
    fprintf(stream, "\n");
    return true;
}

bool outputs_open(struct outputs *outputs, const struct options *options, const fbd_model *model)
{
    const char *const paths[output_count] = {
        [output_csv] = options->csv,   [output_json] = options->json,       [output_html] = options->html,
        [output_plot] = options->plot, [output_gnuplot] = options->gnuplot,
    };
    bool open = open_file(&outputs->note.document, options->note);
    for (int i = 0; i < output_count && open; i++) open = open_file(&outputs->files[i], paths[i]);
    if (open && options->origin) open = write_origin(outputs->files[output_csv].stream, model);
    if (!open) outputs_close(outputs, false);
    return open;
}

/* Write a text of the library to a file, if it is open, and free it; false when there is no text. A write
 * error is reported when the file is closed. */
static bool put_text(struct whole_file *file, char *text)
{
    if (text) whole_file_write(file, text, strlen(text));
    fbd_free(text);
    return text != NULL;
}

static char *page_of(const struct options *options, fbd_result *result, fbd_errors *errors)
{
    const fbd_live_options live = {.settings = options->settings,
                                   .setting_count = options->setting_count,
                                   .run = &options->run};
    char *page =
        options->live ? fbd_result_live_html(result, &live, errors) : fbd_result_html(result, errors);
    if (!page || !options->watched) return page;
    page = live_page_make(page, options->watched->stamp);
    if (!page) complain("fbd-run: out of memory");
    return page;
}

static bool write_plot(struct outputs *outputs, const struct options *options, fbd_result *result,
                       fbd_errors *errors)
{
    char *script = fbd_result_gnuplot(result, options->plot, options->plot_of, errors);
    bool done = script && gnuplot_run(script, fileno(outputs->files[output_plot].stream));
    fbd_free(script);
    return done;
}

bool outputs_write(struct outputs *outputs, const struct options *options, fbd_result *result,
                   fbd_errors *errors)
{
    if (outputs->files[output_json].stream &&
        !put_text(&outputs->files[output_json], fbd_result_json(result))) {
        complain("fbd-run: out of memory");
        return false;
    }
    if (outputs->files[output_html].stream &&
        !put_text(&outputs->files[output_html], page_of(options, result, errors)))
        return false;
    if (outputs->files[output_gnuplot].stream &&
        !put_text(&outputs->files[output_gnuplot],
                  fbd_result_gnuplot(result, options->plot, options->plot_of, errors)))
        return false;
    return !outputs->files[output_plot].stream || write_plot(outputs, options, result, errors);
}

bool outputs_announce(const struct options *options, enum exit_code code)
{
    if (code != exit_done || !options->html || !options->watched) return true;
    if (live_page_announce(options->html, options->watched->stamp)) return true;
    complain("fbd-run: cannot write the stamp of `%s`: %s", options->html, strerror(errno));
    return false;
}

/* Check that the checks of a note are met. */
static enum exit_code checked(const fbd_note *note)
{
    const size_t failed = fbd_note_failed_check_count(note);
    if (failed == 0) return exit_done;
    complain("fbd-run: %zu of %zu checks of the note are not met: see `Checks` in it", failed,
             fbd_note_check_count(note));
    return exit_inaccurate;
}

bool outputs_make_note(fbd_simulation *simulation, fbd_result *result, const struct options *options,
                       struct outputs *outputs, const struct interrupt *interrupt, fbd_errors *errors,
                       enum exit_code *code)
{
    const fbd_outcome outcome = fbd_result_outcome(result);
    if (!options->note || outcome == FBD_FAILED || outcome == FBD_INTERRUPTED) return true;
    struct run_progress progress;
    const fbd_note_options chosen = {.size = sizeof chosen,
                                     .settings = options->settings,
                                     .setting_count = options->setting_count,
                                     .degrees = options->degrees,
                                     .progress = run_progress_watch,
                                     .progress_context = &progress};
    run_progress_begin(&progress, interrupt, false);
    fbd_note *note = fbd_note_new(simulation, result, &chosen, errors);
    run_progress_end(&progress);
    outputs->note_made = note && note_write(&outputs->note, note);
    if (note) *code = checked(note);
    fbd_note_free(note);
    return outputs->note_made;
}
