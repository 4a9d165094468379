/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The command line of fbd-sweep.
 */
#ifndef FBD_APPS_SWEEP_OPTIONS_H
#define FBD_APPS_SWEEP_OPTIONS_H

#include "fbd.h"

enum { most_texts = 200 };

/* Exit codes: a contract with scripts. When a signal ends it, 128 and the signal's number. */
enum sweep_exit {
    sweep_done = 0,
    sweep_failed = 1,    /* some runs came to no good end, or the table could not be written */
    sweep_usage = 2,     /* the command line is wrong */
    sweep_bad_model = 3, /* the model file is wrong */
};

struct sweep_options {
    const char *model;
    const char *csv; /* NULL for standard output */
    fbd_setting settings[most_texts];
    const char *vary[most_texts], *outputs[most_texts];
    fbd_sweep_plan plan; /* its arrays are those above */
    size_t jobs;
    bool resume, quiet;
    bool silent; /* another process says what is wrong */
};

/* Read the command line. Returns true to go on; false with *code set when all is said (help, version, a
 * mistake). */
bool sweep_options_read(int argc, char **argv, struct sweep_options *options, enum sweep_exit *code);

#endif
