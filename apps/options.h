/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The command line of fbd-run.
 */
#ifndef FBD_APPS_OPTIONS_H
#define FBD_APPS_OPTIONS_H

#include "fbd.h"

enum { most_settings = 200 };

/* Exit codes: a contract with scripts. */
enum exit_code {
    exit_done = 0,
    exit_failed = 1,       /* the run failed or ended early with a broken assumption */
    exit_usage = 2,        /* the command line is wrong */
    exit_bad_model = 3,    /* the model file is wrong */
    exit_hand_differs = 4, /* a hand derivation differs */
    exit_inaccurate = 5,   /* the accuracy asked for was not reached */
};

struct options {
    const char *model;
    enum action {
        action_run,
        action_check,
        action_check_hand,
        action_equations,
        action_explain,
        action_linearize,
    } action;
    fbd_setting settings[most_settings];
    size_t setting_count;
    const char *at[most_settings]; /* a time, or coordinates: "theta=180 deg" */
    size_t at_count;
    fbd_options run;
    double every;
    bool ledger, quiet;
    const char *csv, *json, *svg, *html;
    const char *plot, *gnuplot, *plot_of;
    fbd_drawing drawing;
    unsigned seed;
};

/* Read the command line. Returns true to go on; false with *code set when all is said (help, version, a
 * mistake). */
bool options_read(int argc, char **argv, struct options *options, enum exit_code *code);

#endif
