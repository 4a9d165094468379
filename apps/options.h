/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The command line of fbd-run.
 */
#ifndef FBD_APPS_OPTIONS_H
#define FBD_APPS_OPTIONS_H

#include "command_line.h"
#include "fbd_export.h"
#include "watch.h"

struct options {
    const char *model;
    enum action {
        action_run,
        action_check,
        action_check_hand,
        action_equations,
        action_explain,
        action_linearize,
        action_static,
        action_emit_c,
        action_grade,   /* `model` is the key of `answers` */
        action_handout, /* `model` is the key */
        action_fmu,
        action_examples, /* without a model, as is the next */
        action_example,
    } action;
    fbd_setting settings[most_settings];
    size_t setting_count;
    const char *without[most_settings]; /* effects that are left out */
    size_t without_count;
    const char *at[most_settings]; /* a time, or coordinates: "theta=180 deg" */
    size_t at_count;
    fbd_options run;
    double every;
    bool ledger, origin, quiet, settle, latex, full, degrees;
    const char *csv, *json, *svg, *html, *note;
    const char *plot, *gnuplot, *plot_of;
    const char *emit_c; /* destination of the program, of action_emit_c */
    fbd_drawing drawing;
    const char *scale; /* of the drawing: a force with its unit, or NULL */
    unsigned seed;
    const char *student; /* of the answer, or NULL */
    const char *page;    /* of action_handout: destination of the drawing page, or NULL */
    bool details, exam;
    char **answers;
    size_t answer_count;
    const char *fit;              /* a file of measured data, or NULL */
    const char *parameters;       /* those to fit, with commas between; NULL for all */
    const char *inputs, *outputs; /* of --linearize, with commas between; NULL for the usual ones */
    const char *cut;              /* a body, or BODY=PLACE: its section forces; or NULL */
    const char *find;             /* a question, or NULL */
    size_t find_runs;             /* of the scan of the range, or 0 */
    const char *example;          /* the name of action_example */
    const char *fmu;
    int fmu_version; /* 0 when not given */
    const char *fmu_outputs;
    bool watch, live;
    const struct watched_run *watched; /* of --watch, or NULL */
    bool *json_written;                /* set when the JSON of a result has been written */
};

/* Read the command line. Returns true to go on; false with *code set when the program should exit (help,
 * version, a mistake). */
bool options_read(int argc, char **argv, struct options *options, enum exit_code *code);

/* False, with a message, when an output would overwrite a file that was read. */
bool options_spare(const struct options *options, const fbd_errors *errors);

/* True if data goes to standard output; then the report is not printed. */
bool options_use_stdout(const struct options *options);

#endif
