/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Progress: how far a sweep is and how long it will take, on one line of a terminal. Nothing at all where
 * standard error is none.
 */
#ifndef FBD_APPS_PROGRESS_H
#define FBD_APPS_PROGRESS_H

#include "fbd.h"

struct progress {
    bool shown; /* standard error is a terminal, and nobody asked for quiet */
    size_t before, runs;
    double start, last; /* seconds */
    bool drawn;
};

void progress_start(struct progress *progress, size_t before, size_t runs, bool quiet);

/* The signature is that of fbd_sweep_work.progress; `context` is a struct progress. */
void progress_show(void *context, const fbd_sweep_counts *counts);

/* Take the line away. */
void progress_end(struct progress *progress);

#endif
