/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The command line of fbd-cost.
 */
#ifndef FBD_APPS_COST_OPTIONS_H
#define FBD_APPS_COST_OPTIONS_H

#include "command_line.h"
#include "fbd_study.h"

enum { most_names = 64 };

struct cost_options {
    const char *model;
    fbd_setting settings[most_settings];
    size_t setting_count;
    const char *methods[most_names], *quantities[most_names];
    fbd_cost_options study; /* points into the lists above */
    bool effects, quiet;
    const char *csv, *json, *svg;
};

/* Read the command line. Returns true to go on; false with *code set when the program should exit (help,
 * version, a mistake). */
bool cost_options_read(int argc, char **argv, struct cost_options *options, enum exit_code *code);

/* False, with a message, when an output would overwrite a file that was read. */
bool cost_options_spare(const struct cost_options *options, const fbd_errors *errors);

#endif
