/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * CSV: one header line, a row at every output time and at every event; as text, as a table of numbers, or both.
 */
#ifndef FBD_OUTPUT_CSV_H
#define FBD_OUTPUT_CSV_H

#include "output/run_columns.h"
#include "record/result.h"

struct csv {
    const struct fbd_model *model;
    struct ledger *ledger;          /* NULL without force and energy columns */
    struct bars *bars;              /* NULL without columns of errors */
    const fbd_recording *recording; /* destination and callbacks */
    struct numbers *numbers;        /* destination of the numbers, or NULL */
    double start, every, until;
    double near; /* a regular row and an event within this time share a row */
    double last; /* time of the row before */
    long next;   /* index of the next regular row: t = start + next * every */
    struct run_columns columns;
    struct text line;
    struct arrow *arrows;
    double *work;            /* integrals up to the row */
    double *values, *others; /* of a row, and of the companion with error bars */
    bool evaluated;          /* columns need accelerations, forces or energies */
    bool failed;             /* out of memory or error of the writer */
};

/* Write the header and the row at the start, the current time of the run. False when memory is out or the
 * writer refused. */
bool csv_begin(struct csv *csv, fbd_result *result, const fbd_recording *recording);

/* The time of the next regular row. */
double csv_next(const struct csv *csv);

/* Write the row at the ensemble's time if one is due: by the output interval, by an event, or as the last
 * one. */
bool csv_row(struct csv *csv, struct ensemble *ensemble, bool event);

void csv_free(struct csv *csv);

#endif
