/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FBD_BENCH_OPEN_SWEEP_H
#define FBD_BENCH_OPEN_SWEEP_H

#include <stdio.h>
#include <stdlib.h>

#include "fbd.h"
#include "fbd_study.h"

/* A sweep over one parameter, to be freed. `until`: of all runs, NAN for that of the file. Ends the program where there is none. */
static inline fbd_sweep *open_sweep(const char *path, const char *vary, double until)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = until;
    const fbd_sweep_plan plan = {.vary = &vary, .vary_count = 1, .run = &options};
    fbd_sweep *sweep = errors ? fbd_sweep_read(path, &plan, errors) : NULL;
    if (errors && !sweep) fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    if (!sweep) exit(2);
    return sweep;
}

#endif
