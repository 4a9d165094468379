/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The command line of fbd-sweep.
 */
#ifndef FBD_APPS_SWEEP_OPTIONS_H
#define FBD_APPS_SWEEP_OPTIONS_H

#include "command_line.h"
#include "fbd_study.h"

enum { most_texts = 200 };

struct sweep_options {
    const char *model;
    const char *csv; /* NULL for standard output */
    fbd_setting settings[most_settings];
    const char *vary[most_texts], *outputs[most_texts];
    fbd_options run;
    fbd_sweep_plan plan; /* its arrays are those above */
    size_t jobs;
    bool resume, quiet;
};

/* Read the command line; `silent` if another process prints the messages. Returns true to go on; false with
 * *code set when the program should exit (help, version, a mistake). */
bool sweep_options_read(int argc, char **argv, bool silent, struct sweep_options *options,
                        enum exit_code *code);

/* False, with a message, when the table would overwrite the model file. */
bool sweep_outputs_differ(const struct sweep_options *options, const fbd_errors *errors);

#endif
