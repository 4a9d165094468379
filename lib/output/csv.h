/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * CSV: one header line, a row at every output time and at every event.
 */
#ifndef FBD_OUTPUT_CSV_H
#define FBD_OUTPUT_CSV_H

#include "output/result.h"

struct csv {
    const struct fbd_model *model;
    struct ledger *ledger;          /* NULL without force and energy columns */
    struct bars *bars;              /* NULL without columns of errors */
    const fbd_recording *recording; /* where to write, and whom to ask */
    double start, every, until;
    long next; /* index of the next regular row: t = start + next * every */
    struct text line;
    struct fbd_state *probe;
    struct arrow *arrows;
    double *work; /* integrals up to the row */
    bool failed;  /* memory or the writer */
};

/* Write the header and the row of the start, where the run is; `bars` may be NULL. False when memory is out
 * or the writer refused. */
bool csv_begin(struct csv *csv, struct run *run, struct ledger *ledger, struct bars *bars,
               const fbd_recording *recording);

/* Rows within the last step of the run; to be called before ledger_step. A row is added at its end when the
 * step has added to the first `events` events. A step of a body at rest may have millions of rows: the
 * recording's progress function is asked between them as well, and may end the run at one of them. */
bool csv_step(struct csv *csv, struct run *run, size_t events);

void csv_free(struct csv *csv);

#endif
