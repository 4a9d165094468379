/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sweep: a model with many values of its parameters.
 *
 * The common data of all runs are made once and constant from then on: the tree of the file, the programs
 * that contain no varying parameter (scene/programs.h), the axes, the columns. A run evaluates the programs
 * that depend on its values, compiles a plan of its own, and is carried to its end; only its row is kept. A
 * value is passed to the reader as the text that the row shows, so that `fbd-run --set` with it makes a
 * bitwise equal model.
 */
#ifndef FBD_STUDY_SWEEP_H
#define FBD_STUDY_SWEEP_H

#include "fbd_study.h"
#include "loop/ensemble.h"
#include "model/model.h"
#include "scene/patch.h"
#include "study/axes.h"
#include "study/columns.h"

struct fbd_sweep {
    struct arena arena;
    char *source; /* the text of the file, owned */
    size_t source_length;
    struct document document;
    struct override *fixed; /* parameters that are set and do not vary */
    size_t fixed_count;
    struct axes axes;
    struct fbd_model *base; /* the model with the values of the file: names and units */
    struct columns columns;
    fbd_options options;
    struct text header, key;
};

/* ---- rows (row.c) */

/* The data of one thread that makes rows one after another. */
struct row_maker {
    const struct fbd_sweep *sweep;
    struct override *overrides; /* the varying ones, then the fixed ones */
    size_t *starts;             /* of the texts of the values */
    struct text values;
    struct extreme *extremes;
    struct patch *patch; /* a scene into which the values of successive runs are patched, or NULL */
    uint64_t rows;       /* rows since the last attempt to make a patch */
    uint64_t served;     /* rows made with this patch */
    fbd_stop *stop;      /* called in every step, or NULL */
    void *stop_context;
};

bool row_maker_init(struct row_maker *maker, const struct fbd_sweep *sweep);
void row_maker_free(struct row_maker *maker);

/* Set the overrides to the values of a run (row_make does it). False when memory is out. */
bool row_maker_set(struct row_maker *maker, uint64_t run);

enum row_end {
    row_well,   /* the run reached its end, or an event of the file stopped it */
    row_failed, /* it did not, and its row has the reason */
    row_stopped /* stopped by `stop`: no row was added */
};

/* Make run `run` (from 0) and append its row to `text`. */
enum row_end row_make(struct row_maker *maker, uint64_t run, struct text *text);

/* A row whose run has not ended. */
struct open_row {
    fbd_errors *errors;
    struct fbd_model *model;
    struct ensemble *run;
};

/* row_make in two parts, for a run that the caller advances, if no column requires more than its end.
 * row_open appends the start of the row and starts the run; returns false if that fails, and the row is then
 * complete (row_failed). row_put appends the rest at the end of the run. The maker must not be used for
 * another row until this one is closed. */
bool row_open(struct row_maker *maker, uint64_t run, struct open_row *row, struct text *text);
enum row_end row_put(struct row_maker *maker, const struct open_row *row, struct text *text);
void row_close(struct open_row *row);

#endif
