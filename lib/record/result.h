/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Result: a completed run with its ledger, for the report and for JSON.
 */
#ifndef FBD_RECORD_RESULT_H
#define FBD_RECORD_RESULT_H

#include "base/text.h"
#include "record/bars.h"
#include "record/event_states.h"
#include "record/ledger.h"
#include "record/numbers.h"

/* The parts of a simulation before its inputs were last set (fbd_simulation_set_input). */
struct past_parts {
    size_t parts;
    fbd_stats cost;                /* the sums of the counters of the work */
    struct energy_balance balance; /* the one with the largest ratio */
};

/* The simulation of the public interface: a run of all groups, its error bars, and its cost. */
struct fbd_simulation {
    struct ensemble *ensemble;
    struct bars *bars; /* NULL without error bars */
    double seconds;
    double accuracy;                  /* requested accuracy, 0 if none */
    bool cut;                         /* the search for the accuracy was interrupted; this run is complete */
    unsigned long runs;               /* number of runs for the accuracy, each with its companion */
    double seconds_spent;             /* of all of them, companions and ledgers included */
    double *event_errors;             /* of the times of run->events; NULL until requested */
    size_t main_events, other_events; /* ... numbers of events for which they were computed */
    struct fbd_state *start;          /* initial state; NULL for that of the file */
    char **details;                   /* texts of events, made on request */
    size_t detail_count;
    struct past_parts past;
};

struct fbd_result {
    struct fbd_simulation *simulation;
    struct ledger ledger;
    double ledger_seconds;   /* processor time of its integrals */
    struct fbd_state *start; /* the state at the start */
    struct record *record;   /* for the page and for plots (output/run_record.h), NULL without */
    struct event_states event_states;
    struct numbers numbers; /* the rows as numbers; empty if not requested */
    bool degrees;           /* angles are shown in degrees */
};

/* Add the counters of work of an ensemble. */
void stats_add(fbd_stats *stats, const struct ensemble *ensemble);

/* Compute the errors of the times of the events, with error bars. False when memory is out. */
bool simulation_match_events(fbd_simulation *simulation);

/* The estimated error of the time of an event; NAN without error bars or memory. */
double simulation_event_error(fbd_simulation *simulation, size_t index);

#endif
