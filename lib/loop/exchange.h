/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Exchange: a run whose steps another program makes, with its own method. It sets time and coordinates, reads rates and
 * event functions, and finds the events; the transition at an event is that of the loop (run_apply).
 *
 * The other program locates an event up to its own tolerance: at the time t that it takes, functions are already negative.
 * So the state is moved back along the motion to the zero, by Newton's method on the first function, the transition is made
 * there, and the state is moved forward to t in the new modes. Both moves are linear: with a delay d of the location the
 * error is of the order of d^2, and after the event the functions are positive.
 *
 * Functions of time alone are no indicators: the time of the next zero is found in advance.
 *
 * Events that the loop finds by the dense output of its own steps, and not by functions, cannot be had: exchange_lack.
 */
#ifndef FBD_LOOP_EXCHANGE_H
#define FBD_LOOP_EXCHANGE_H

#include "base/text.h"
#include "loop/run.h"

struct exchange {
    struct arena memory; /* of the run */
    struct run *run;
    struct time_dd next; /* of functions of time alone, those flagged in run->search.timed.crossed */
    bool timed;          /* there is one */
    bool moved;          /* the state has been set since the last transition */
    double length;       /* of the run: for so long it is searched */
    double *kept;        /* plan_size: before a projection */
};

/* Name the part of a scene that has events of the other kind: the sentence in `words`, or false if there is none. */
bool exchange_lack(const struct fbd_model *model, struct text *words);

/* A run from a state; at t = 0 that is the start of its scene. False when memory is out; free it also then. */
bool exchange_init(struct exchange *exchange, const struct fbd_state *start,
                   const struct run_options *options);
void exchange_free(struct exchange *exchange);

/* Set time and coordinates, rates and user states within a step, in the present modes. */
void exchange_put(struct exchange *exchange, double t, const double *y);

/* Set an input that states have a value of (input_call.held), by its index among the parameters. */
void exchange_set_input(struct exchange *exchange, size_t input, double value);

/* Their derivatives, plan_size. */
void exchange_slopes(struct exchange *exchange, double *dy);

/* The event functions of the moving set; 1 for those that cannot cross in the present modes. */
void exchange_functions(struct exchange *exchange, double *values);

/* A step is complete. Returns whether exchange_update should follow: a function is negative, or the couplings have drifted
 * by more than the tolerance. */
bool exchange_complete(struct exchange *exchange);

/* Apply all events up to the present time, and find the next one of time alone: `next`, or NAN. */
void exchange_update(struct exchange *exchange, double *next);

#endif
