/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Run progress: one line on the terminal, never in a pipe or a file. It also ends a run after Ctrl-C.
 */
#ifndef FBD_APPS_RUN_PROGRESS_H
#define FBD_APPS_RUN_PROGRESS_H

#include "fbd.h"
#include "interrupt.h"
#include "terminal_line.h"

struct run_progress {
    const struct interrupt *interrupt;
    struct terminal_line line;
    unsigned long visits; /* steps and rows so far */
    double t;             /* simulated time then [s]; a smaller value later means another run, of a search */
};

/* `visible` false: only check for interruption. */
void run_progress_begin(struct run_progress *progress, const struct interrupt *interrupt, bool visible);

/* An fbd_watch: `context` is a struct run_progress. */
int run_progress_watch(void *context, const fbd_progress *now);

/* Erase the line. */
void run_progress_end(struct run_progress *progress);

#endif
