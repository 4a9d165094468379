/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sweep progress: completed runs and remaining time, on one line of a terminal.
 */
#ifndef FBD_APPS_SWEEP_PROGRESS_H
#define FBD_APPS_SWEEP_PROGRESS_H

#include "fbd.h"
#include "terminal_line.h"

struct sweep_progress {
    struct terminal_line line;
    size_t before, runs; /* rows that existed at the beginning, and total number */
};

void sweep_progress_begin(struct sweep_progress *progress, size_t before, size_t runs, bool visible);

/* An fbd_watch; `context` is a struct sweep_progress. */
int sweep_progress_show(void *context, const fbd_progress *now);

/* Erase the line. */
void sweep_progress_end(struct sweep_progress *progress);

#endif
