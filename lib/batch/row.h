/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data behind rows.h.
 */
#ifndef FBD_BATCH_ROW_H
#define FBD_BATCH_ROW_H

#include "base/arena.h"
#include "batch/row_columns.h"
#include "batch/rows.h"
#include "loop/ensemble.h"
#include "model/model.h"
#include "scene/patch.h"

struct rows {
    struct arena arena;
    struct document document;
    struct rows_source source;
    struct override *fixed; /* parameters that are set and do not vary */
    size_t fixed_count;
    struct fbd_model *base; /* the model with the values of the file: names and units */
    struct columns columns;
    fbd_options options;
};

struct row_maker {
    const struct rows *table;
    struct override *overrides; /* the varying ones, then the fixed ones */
    size_t *starts;             /* of the texts of the values */
    struct text values;
    struct extreme *extremes;
    double *at; /* columns.at_count */
    struct word_log words;
    struct text *story;  /* receives the happenings of the run (rows.h), or NULL */
    struct patch *patch; /* a scene into which the values of successive runs are patched, or NULL */
    uint64_t rows;       /* rows since the last attempt to make a patch */
    uint64_t served;     /* rows made with this patch */
    fbd_stop *stop;      /* called in every step, or NULL */
    void *stop_context;
};

/* row_maker_new in place; row_maker_end is called even if it fails. */
bool row_maker_init(struct row_maker *maker, const struct rows *table);
void row_maker_end(struct row_maker *maker);

/* Set the overrides to the values of a run (row_make does it). False when memory is out. */
bool row_maker_set(struct row_maker *maker, uint64_t run);

/* Warn where a column is of a section, and equilibrium does not determine all reactions at the start. */
void rows_warn_of_sections(const struct rows *rows, fbd_errors *errors);

/* The model of the values that are set; NULL with notes. */
struct fbd_model *row_model(struct row_maker *maker, fbd_errors *errors);

/* The first error with its position, "" without one. */
void row_write_reason(fbd_errors *errors, char *reason, size_t size);
enum { row_reason_room = 600 };

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
