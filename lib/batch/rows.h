/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows: the runs of one model file with many values of its parameters, each as a row of a table.
 *
 * The common data of all runs are made once and constant from then on: the tree of the file, the programs
 * that contain no varying parameter (scene/programs.h), the columns. A run evaluates the programs that depend
 * on its values, compiles a plan of its own, and is carried to its end; only its row is kept. A value is passed
 * to the reader as the text that the row shows, so that `fbd-run --set` with it makes a bitwise equal model.
 *
 * This header is the view that sweeps have of the core: it needs nothing else of it.
 */
#ifndef FBD_BATCH_ROWS_H
#define FBD_BATCH_ROWS_H

#include <stdint.h>

#include "base/text.h"
#include "fbd_study.h"

/* A parameter that varies. */
struct rows_parameter {
    const char *name;
    const char *unit; /* behind each of its values, or "" */
    bool files;       /* its values are paths, as those of a table must be */
};

/* The parameters that vary, and their values. */
struct rows_source {
    const struct rows_parameter *parameters;
    size_t count;
    /* Append the value of a parameter in run `run` (from 0), without its unit. Called by any thread. */
    void (*value)(const void *context, size_t parameter, uint64_t run, struct text *text);
    const void *context;
    const char *option, *outputs; /* where they and the outputs were given, for messages: "--vary" */
};

struct rows;

/* Parse a model file; the text and the name must live as long as the rows. NULL with notes in `errors`. */
struct rows *rows_open(const char *text, size_t length, const char *name, fbd_errors *errors);

/* Prepare the rows: read the file for values of these parameters, whose arrays must live as long as the rows,
 * and choose columns and options by the plan; of the plan only settings, outputs, run and degrees are used.
 * Returns false with notes in `errors`: those of a wrong file or option, `unknown-parameter`, `varied-twice`,
 * `bad-vary` and `unknown-output`. */
bool rows_prepare(struct rows *rows, const struct rows_source *source, const fbd_sweep_plan *plan,
                  fbd_errors *errors);
void rows_free(struct rows *rows);

/* Try the values of a run, for errors such as a wrong dimension, which occur in every run. Errors of the
 * resulting scene are reported by the rows. Returns false with notes in `errors`. */
bool rows_try(const struct rows *rows, uint64_t run, fbd_errors *errors);

/* Append the header line, and a line with a hash for each table of the file. */
void rows_header(const struct rows *rows, struct text *text);

/* Append the start of the header, `run` and the varying parameters; and the end of a row, with its newline. */
void rows_header_start(const struct rows *rows, struct text *text);
void rows_put_end(struct text *text, const char *status, const char *reason);
void rows_tables(const struct rows *rows, struct text *text);

/* ---- making rows */

/* The data of one thread that makes rows one after another. */
struct row_maker;

/* `stop`, unless NULL, is called in every step and ends the run if it returns nonzero. NULL when memory is
 * out. */
struct row_maker *row_maker_new(const struct rows *rows, fbd_stop *stop, void *stop_context);
void row_maker_free(struct row_maker *maker);

enum row_end {
    row_well,   /* the run reached its end, or an event of the file stopped it */
    row_failed, /* it did not, and its row has the reason */
    row_stopped /* stopped by `stop`: no row was added */
};

/* Make run `run` (from 0) and append its row to `text`. */
enum row_end row_make(struct row_maker *maker, uint64_t run, struct text *text);

/* A row as numbers. All belongs to the look, and lasts until the next one. */
struct row_look {
    double *values; /* of the columns, NAN for an empty one; the array is the caller's */
    const char *status, *reason;
    struct text story; /* happenings: "block contact, block breakaway, land, block impact 3 times" */
    struct text row;
};

/* Make run `run` and read its row. Memory is out if look->row or look->story has failed. */
enum row_end row_look(struct row_maker *maker, uint64_t run, struct row_look *look);
void row_look_free(struct row_look *look);

/* The same of the scene at rest at its start, in equilibrium: without a run. Before, rows_rest tells whether all columns
 * are known there: section forces, coordinates and parameters; false with a note `unknown-output`. */
bool rows_rest(const struct rows *rows, fbd_errors *errors);
enum row_end row_look_at_rest(struct row_maker *maker, uint64_t run, struct row_look *look);

#endif
