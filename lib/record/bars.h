/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Error bars: the estimated global errors of everything that a run writes, from a companion (companion.h)
 * with a ledger of its own: coordinates and rates, forces, works and energies.
 *
 * The error of a force is the difference of the two diagrams, that of a work the difference of the two
 * ledgers, each with a floor of some roundings of its size.
 */
#ifndef FBD_RECORD_BARS_H
#define FBD_RECORD_BARS_H

#include "loop/companion.h"
#include "record/ledger.h"

struct bars {
    struct companion *companion;
    struct ledger ledger;    /* of the companion */
    double *work;            /* per load: integrals at the time looked at */
    struct arrow *arrows;    /* of one body of the companion */
    struct fbd_state *state; /* the companion at the time looked at */
    bool known;              /* ... which is there */
    bool behind;             /* the last step of the first run has not been looked at: see bars_catch_up */
    /* Asked after each step of the companion, which may need far more of them than the first run; true
     * interrupts it, and nothing is known from there. May be NULL. */
    bool (*is_ended)(void *watcher);
    void *watcher;
};

/* Error bars for a run of these options. False when memory is out. */
bool bars_init(struct bars *bars, const struct fbd_model *model, const struct run_options *options);
void bars_free(struct bars *bars);

/* The time of the next sample of the errors, at which `main` is to stop; HUGE_VAL when there is none. */
double bars_next(const struct bars *bars);

/* Take the samples of the errors that are due in the last step of `main`, or where it is. False when memory
 * is out. */
bool bars_step(struct bars *bars, struct ensemble *main);

/* For who advances a run by hand and may look into its last step: leave bars_step undone, set `behind`, and
 * call this before the next step and at the end. `bars` may be NULL. */
bool bars_catch_up(struct bars *bars, struct ensemble *main);

/* Take the companion to the time t where `main` is, or in its last step; `after_event` as in companion_look,
 * `works`: the integrals are wanted too. False when memory is out; bars->known says whether there is an
 * estimate. */
bool bars_look(struct bars *bars, struct ensemble *main, double t, bool after_event, bool works);

/* Has that been done for t, and found something? */
bool bars_looked(const struct bars *bars, double t);

/* After `main` has ended: look at its end, works included, and let the companion come to its own last event.
 * What has been looked at stays. */
bool bars_finish(struct bars *bars, struct ensemble *main);

/* Estimated errors at the time looked at; INFINITY when unknown. Of component i (n coordinates, n rates) of
 * `main`: */
double bars_component(const struct bars *bars, const struct fbd_state *main, size_t i);

/* Of anything that the companion has as well: `main` of the first run, `other` of the companion. */
double bars_difference(const struct bars *bars, double main, double other);

/* The companion's diagram of body b; there until the next call. What it holds while nothing is known is of no
 * use, but finite. */
const struct arrow *bars_diagram(struct bars *bars, int b);

/* Of the work of load `index`, `work` being that of the first run. */
double bars_work(struct bars *bars, size_t index, double work);
fbd_energy bars_energy(struct bars *bars, const fbd_energy *energy);

#endif
