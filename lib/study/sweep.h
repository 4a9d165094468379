/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sweep: a model under many values of its parameters.
 *
 * What all runs share is made once and is constant from then on: the tree of the file, the programs that name
 * no parameter that varies (scene/programs.h), the axes, the columns. A run evaluates what depends on its
 * values, folds it into a plan of its own, and is carried to its end; nothing of it remains but its row. A
 * value is handed to the reader as the text that the row shows, so that `fbd-run --set` with it makes the
 * same model, to the last bit.
 */
#ifndef FBD_STUDY_SWEEP_H
#define FBD_STUDY_SWEEP_H

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

/* What one thread needs to make rows, one after the other. */
struct row_maker {
    const struct fbd_sweep *sweep;
    struct override *overrides; /* those that vary, then the fixed ones */
    size_t *starts;             /* of the texts of the values */
    struct text values;
    struct extreme *extremes;
    struct patch *patch; /* a scene that takes the values of one run after the other, or NULL */
    uint64_t rows;       /* since the last one was asked for */
    uint64_t served;     /* by this patch */
    fbd_stop *stop;      /* asked in every step, or NULL */
    void *stop_context;
};

bool row_maker_init(struct row_maker *maker, const struct fbd_sweep *sweep);
void row_maker_free(struct row_maker *maker);

/* Set the overrides to the values of a run (row_make does it). False when memory is out. */
bool row_maker_set(struct row_maker *maker, uint64_t run);

enum row_end {
    row_well,   /* the run reached its end, or an event of the file stopped it */
    row_failed, /* it did not, and its row says why */
    row_stopped /* `stop` said so: no row was added */
};

/* Make run `run` (from 0) and append its row to `text`. */
enum row_end row_make(struct row_maker *maker, uint64_t run, struct text *text);

/* A row whose run is under way. */
struct open_row {
    fbd_errors *errors;
    struct fbd_model *model;
    struct ensemble *run;
};

/* The same in parts, for a run that somebody else carries to its end, of which no column asks for more than that. Append
 * the start of the row and begin the run: false where there is none, and the row is whole (row_failed). Then, at the end
 * of the run, the rest of it. The maker is not to be used for another row until this one is closed. */
bool row_open(struct row_maker *maker, uint64_t run, struct open_row *row, struct text *text);
enum row_end row_put(struct row_maker *maker, const struct open_row *row, struct text *text);
void row_close(struct open_row *row);

#endif
