/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Companion: a second, more accurate run of the same scene that goes along with the first, for an estimate of
 * its global error.
 *
 * The true error of a run is x - x_true. A run that is more accurate stands for the truth:
 *
 *     x - x' = (x - x_true) - (x' - x_true),
 *
 * so with an error of x' that is a share s of that of x the estimate is off by a factor of 1 -+ s only. (Two
 * integrations of different tolerance: Shampine & Baca, "Global error estimates for ODEs based on
 * extrapolation methods", SIAM J. Sci. Stat. Comput. 6 (1985) 1; Hairer, Norsett & Wanner I, II.4 and the
 * notes on global error there. Tolerance proportionality, that a tolerance p times smaller gives an error p
 * times smaller: Stetter 1980; Hairer & al. II.4.) As both runs are complete ones, with their own events and
 * modes, an error is carried through events, stick and slip, and grows in an unstable motion as it really
 * does; a linearised estimate would not pass them.
 *
 * Both runs round. Two runs of different steps round independently of each other, so their difference shows
 * what rounding adds up to in a long run (where a method has no other error, the companion makes other steps
 * for that: run_options.apart); what they round alike (the constants of the formulas, their value
 * at one instant) it cannot show. A floor of some roundings of the size of the motion stands for that:
 * companion_floor.
 *
 * Both are ensembles of the same groups. They meet at times, which each comes to by steps of its own; what is
 * asked of the first one there changes nothing in it: its bits are the same with and without.
 */
#ifndef FBD_LOOP_COMPANION_H
#define FBD_LOOP_COMPANION_H

#include "loop/ensemble.h"

struct companion {
    const struct fbd_model *model;
    struct ensemble *ensemble;
    double *scale, *worst; /* 2 n each: largest size so far, largest estimate so far */
    double *y;             /* 2 n each: both runs at the time of a sample */
    struct fbd_state *probe;
    bool follows;        /* the first run chooses its steps alike; those of the companion are shorter */
    long samples;        /* multiples of 1/500 of the run that have been passed */
    double next;         /* time of the next sample; HUGE_VAL when there is none */
    double unknown_from; /* HUGE_VAL; or a time from which on there is no estimate */
};

/* A companion for a run of these options, at the start. NULL when memory is out. */
struct companion *companion_new(const struct fbd_model *model, const struct run_options *options);
void companion_free(struct companion *companion);

/* Take it to time t, if it has not been there and can come there, where `main` is, or in its last step. False when
 * memory is out. */
bool companion_go(struct companion *companion, const struct ensemble *main, double t);

/* The companion's state at time t, which is where `main` is, or in its last step; evaluated. `after_event`: t
 * is where `main` is, and events have happened there; what is asked for is the state after them. If the
 * companion's own event is still to come (it is later by the error of its time), it is carried over the event
 * with `main`: it takes part in its jump, and its forces are those of the modes that `main` goes on in. False
 * when there is no such state any more: the companion has failed, or has ended long before. */
bool companion_look(struct companion *companion, const struct ensemble *main, double t, bool after_event,
                    struct fbd_state *state);

/* Take the errors at time t, where the companion has gone to, into the largest ones. companion->next is a
 * multiple of 1/500 of the run, as rows are: output times lie within steps, too, where the dense output may err more than
 * the end of the step does. The end of the run is a sample, too. */
void companion_sample(struct companion *companion, struct ensemble *main, double t);

/* There is no estimate from t on. */
void companion_lose(struct companion *companion, double t);

/* Estimated error of component i (n coordinates, then n rates) of value `main`, when the companion has
 * `other`. A part of it stands for roundings that both runs share. */
double companion_error(const struct companion *companion, size_t i, double main, double other);

/* The global error so far, without units: the largest over all coordinates and rates of the largest error
 * over the samples, over the largest size in the run. INFINITY when there is no estimate. */
double companion_global(const struct companion *companion);

/* After `main` has ended: let the companion come to the events that `main` has, if they are not far. False
 * when memory is out. */
bool companion_come_to_events(struct companion *companion, const struct ensemble *main);

/* Estimated errors of the times of all events of `main`, which has ended; the companion has come to its own.
 * INFINITY for an event that the companion does not have. errors[main->event_count]. */
void companion_event_errors(const struct companion *companion, const struct ensemble *main, double *errors);

#endif
