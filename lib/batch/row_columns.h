/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Columns: the outputs of each run of a sweep. They have the names of fbd-run's CSV where it has the same
 * quantity:
 *
 *     t, block.x, block.v          at the end of the run
 *     rod.right.x, .vx, .ax ...    of a point in the world, at the end of the run
 *     M(beam, 0.4 m)            of a section (section/name.h), at the end of the run
 *     min(block.x), max(rod.right.y)   over the run; also of a section
 *     time(land), count(land)      of an event of the file: time of the first, number; also of a kind of event,
 *                                  time(stick), and of one body, time(block.stick); or of a word for an
 *                                  outcome, time(block.slips) (row_words.h), time(cord.breaks)
 *     at(wall, ball.y)             a coordinate, a rate, of a point or a section, just before the first of such an event
 *     R                            a parameter of the file
 *     energy.kinetic, .potential, .work, .residual    at the end
 *     block.friction.work          work of a force or moment
 *     steps, rhs                   cost of the run
 *
 * and in groups: `final` (t, all coordinates and rates), `times` (time of the first occurrence of each event
 * of the file), `energy` (all four).
 */
#ifndef FBD_BATCH_ROW_COLUMNS_H
#define FBD_BATCH_ROW_COLUMNS_H

#include "base/text.h"
#include "batch/extremes.h"
#include "batch/row_words.h"
#include "output/run_columns.h"
#include "record/ledger.h"

struct column {
    const char *title; /* as in the header, with its unit */
    enum row_kind {
        row_quantity, /* of the table of columns, at the end of the run */
        row_extreme,  /* extremes[index] */
        row_time,
        row_count,
        row_steps,
        row_rhs,
        row_at,        /* a quantity just before the first of the events: at[index] of the run */
        row_parameter, /* of the scene: parameters[index] */
    } kind;
    struct run_column quantity; /* for row_extreme its unit */
    int index;
    /* time, count: which events; -1 for any. event: of fbd_event_kind, or of enum row_word */
    int event, body, watch;
    bool breaks; /* couplings and forces that end */
};

struct columns {
    struct column *list;
    size_t count, room;
    struct extreme *extremes; /* quantities to watch; each run has its own values */
    size_t extreme_count;
    size_t at_count; /* columns of row_at */
    bool ledger;     /* energies or works are required */
    bool words;      /* the words of row_words.h are required */
};

/* Read lists of names, separated by commas; without any, `final` and `times`; angles in degrees if `degrees`.
 * Returns false with notes in `errors` (id `unknown-output`). Memory comes from `arena`. */
bool columns_read(struct columns *columns, struct arena *arena, const struct fbd_model *model,
                  const char *const *texts, size_t count, bool degrees, fbd_errors *errors);

/* The data of a run from which columns are computed. */
struct observed {
    struct ensemble *run;
    struct ledger *ledger;          /* NULL when not required */
    const struct extreme *extremes; /* as in columns */
    const double *at;               /* at_count: values of row_at, NAN until the event */
    const struct word_log *words;   /* NULL when not required */
};

/* Take the values of row_at at the events of the last step, from event `seen` on. `probe` is a scratch state.
 * False when the dense output is not available, or the quantity has no value. */
bool columns_step(const struct columns *columns, struct ensemble *run, size_t seen, struct fbd_state *probe,
                  double *at, fbd_errors *errors);

/* Append `,value` for each column; the value is empty if it does not exist, with a note for a section. */
void columns_put(const struct columns *columns, const struct observed *observed, struct text *text,
                 fbd_errors *errors);

#endif
