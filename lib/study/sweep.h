/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sweep: a model with many values of its parameters.
 *
 * A sweep has the texts of the caller's plan, the values of its parameters (axes.h) and the rows of a table
 * (batch/rows.h), which several threads or processes make (thread_pool.h). With a question the row of a run is the
 * answer of a search (find.h) instead.
 */
#ifndef FBD_STUDY_SWEEP_H
#define FBD_STUDY_SWEEP_H

#include "batch/rows.h"
#include "fbd_find.h"
#include "fbd_study.h"
#include "study/axes.h"

struct fbd_sweep {
    struct arena arena;
    char *source; /* the text of the file, owned */
    size_t source_length;
    struct axes axes;
    struct rows *rows;
    struct text header, key;

    const char *question; /* or NULL; below: of its searches */
    const char *name;     /* of the file */
    fbd_find_plan find;   /* settings: those of the plan, then room for the varying ones */
    fbd_options run;
};

/* Copy the question of a plan, try it with the values of the first run, and write the header. Returns false with
 * notes (sweep_find.c). */
bool sweep_find_prepare(struct fbd_sweep *sweep, const fbd_sweep_plan *plan, fbd_errors *errors);

/* Append the row of a run; as row_make. */
enum row_end sweep_find_row(const struct fbd_sweep *sweep, uint64_t run, fbd_stop *stop, void *stop_context,
                            struct text *text);

#endif
