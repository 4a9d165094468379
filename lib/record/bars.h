/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Error bars: the estimated global errors of all outputs of a run (coordinates and rates, forces, works and
 * energies), from a companion (companion.h) with a separate ledger.
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
    double *work;            /* per load: integrals at the time of the last bars_look */
    struct arrow *arrows;    /* of one body of the companion */
    struct fbd_state *state; /* the companion at that time */
    bool known;              /* ... if it has one */
    bool behind;             /* the last step of the main run has not been compared: see bars_catch_up */
    /* Called after each step of the companion, which may need far more of them than the main run; true
     * interrupts it, and errors are unknown from then on. May be NULL. */
    bool (*is_ended)(void *watcher);
    void *watcher;
};

/* Error bars for a run with these options. False when memory is out. */
bool bars_init(struct bars *bars, const struct fbd_model *model, const struct run_options *options);
void bars_free(struct bars *bars);

/* The time of the next sample of the errors, at which `main` is to stop; HUGE_VAL when there is none. */
double bars_next(const struct bars *bars);

/* Take the samples of the errors that are due in the last step of `main`, or at its present time. False when
 * memory is out. */
bool bars_step(struct bars *bars, struct ensemble *main);

/* For callers that advance a run step by step and may evaluate its last step: set `behind` instead of calling
 * bars_step, and call this before the next step and at the end. `bars` may be NULL. */
bool bars_catch_up(struct bars *bars, struct ensemble *main);

/* Advance the companion to the time t, the present time of `main` or one in its last step; `after_event` as
 * in companion_look, `works`: compute the integrals too. False when memory is out; bars->known is true if
 * there is an estimate. */
bool bars_look(struct bars *bars, struct ensemble *main, double t, bool after_event, bool works);

/* Was bars_look called for t, with an estimate? */
bool bars_looked(const struct bars *bars, double t);

/* After the end of `main`: compare its end, works included, and advance the companion to its last event. The
 * result of bars_look is kept. */
bool bars_finish(struct bars *bars, struct ensemble *main);

/* Estimated errors at the time of the last bars_look; INFINITY when unknown. Of component i (n coordinates, n
 * rates) of `main`: */
double bars_component(const struct bars *bars, const struct fbd_state *main, size_t i);

/* Of any quantity: `main` of the main run, `other` of the companion. */
double bars_difference(const struct bars *bars, double main, double other);

/* The companion's diagram of body b, valid until the next call. Without an estimate its content is
 * meaningless, but finite. */
const struct arrow *bars_diagram(struct bars *bars, int b);

/* Of the work of load `index`, `work` being that of the main run. */
double bars_work(struct bars *bars, size_t index, double work);
double bars_residual(const struct bars *bars, double residual);
fbd_energy bars_energy(struct bars *bars, const fbd_energy *energy);

#endif
