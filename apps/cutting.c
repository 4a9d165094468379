/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cutting.h"

#include <stdlib.h>
#include <string.h>

#include "deliver.h"
#include "fbd_section.h"

bool cutting_agrees(const struct options *options, const struct command_line *line, bool drawing)
{
    if (options->action != action_run && options->action != action_static)
        return command_line_usage(
            line, "--cut goes with a run, at its start or at the time of --at, and with --static", "");
    if (options->find || options->fit || options->csv || options->html || options->note || options->plot ||
        options->gnuplot || options->watch || options->full || options->run.error_bars || drawing ||
        options->drawing.solution)
        return command_line_usage(line,
                                  "--cut goes with --at, --static, --settle, --svg, --json, --set, --without "
                                  "and the options of the simulation only",
                                  "");
    return true;
}

static enum exit_code write_all(const struct options *options, const fbd_section *section, const double *x)
{
    const bool quiet = options->quiet || options_use_stdout(options);
    if (!quiet && !deliver_text(NULL, fbd_section_text(section, x))) return exit_failed;
    if (options->json) {
        *options->json_written = true;
        if (!deliver_text(options->json, fbd_section_json(section, x))) return exit_failed;
    }
    return !options->svg || deliver_picture(options->svg, fbd_section_svg(section)) ? exit_done : exit_failed;
}

/* A wrong name or place is one of the command line. */
static enum exit_code blame(fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const char *id = fbd_errors_get(errors, i).id;
        if (strcmp(id, "unknown-body") == 0) return exit_usage;
    }
    return exit_failed;
}

/* A scene in motion needs an admissible state; one at rest may be moved to its equilibrium. */
static bool find_state(const struct options *options, fbd_state *state, fbd_errors *errors)
{
    if (options->action == action_static) return !options->settle || fbd_find_equilibrium(state, errors);
    return options->at_count > 0 || fbd_state_close(state, errors);
}

enum exit_code cutting(const struct options *options, fbd_state *state, fbd_errors *errors)
{
    if (!find_state(options, state, errors)) return exit_failed;
    const char *equals = strchr(options->cut, '=');
    const size_t length = equals ? (size_t)(equals - options->cut) : strlen(options->cut);
    char *body = strndup(options->cut, length);
    const bool rests = options->action == action_static;
    fbd_statics *statics = rests ? fbd_statics_new(state, errors) : NULL;
    fbd_section *section = body && (statics || !rests) ? fbd_section_new(state, statics, body, errors) : NULL;
    double x;
    enum exit_code code = section ? exit_done : blame(errors);
    if (section && equals && !fbd_section_place(section, equals + 1, &x, errors)) code = exit_usage;
    if (code == exit_done) code = write_all(options, section, equals ? &x : NULL);
    fbd_section_free(section);
    fbd_statics_free(statics);
    free(body);
    return code;
}
