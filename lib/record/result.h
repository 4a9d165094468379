/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Result: a run carried to its end, with its ledger, for the report and for JSON.
 */
#ifndef FBD_RECORD_RESULT_H
#define FBD_RECORD_RESULT_H

#include "base/text.h"
#include "record/bars.h"
#include "record/event_states.h"
#include "record/ledger.h"
#include "record/numbers.h"

/* The simulation of the public interface: a run of the whole, its error bars, and where its time went. */
struct fbd_simulation {
    struct ensemble *ensemble;
    struct bars *bars; /* NULL without error bars */
    double seconds;
    double accuracy;                  /* asked for, 0 when it is not */
    bool cut;                         /* the search for it was interrupted; this run came to its end */
    unsigned long runs;               /* it took, each with its companion */
    double seconds_spent;             /* in all of them, companions and ledgers included */
    double *event_errors;             /* of the times of run->events; NULL until asked for */
    size_t main_events, other_events; /* ... when both runs had that many */
    struct fbd_state *start;          /* that it begins with; NULL for the file's */
    char **details;                   /* texts of events, made when they are asked for */
    size_t detail_count;
};

struct fbd_result {
    struct fbd_simulation *simulation;
    struct ledger ledger;
    double ledger_seconds;   /* processor time of its integrals */
    struct fbd_state *start; /* the state at the start */
    struct record *record;   /* for the page and for plots (draw/record.h), NULL without */
    struct event_states event_states;
    struct numbers numbers; /* the rows as numbers; empty without */
    bool degrees;           /* angles are shown in degrees */
};

/* Find the errors of the times of the events, with error bars. False when memory is out. */
bool simulation_match_events(fbd_simulation *simulation);

/* The estimated error of the time of an event; NAN without error bars or memory. */
double simulation_event_error(fbd_simulation *simulation, size_t index);

#endif
