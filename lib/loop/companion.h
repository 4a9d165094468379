/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Companion: a second, more accurate run of the same scene, in parallel with the main run, for an estimate of
 * its global error.
 *
 * The true error of a run is x - x_true. A more accurate run x' replaces the true solution:
 *
 *     x - x' = (x - x_true) - (x' - x_true),
 *
 * so if the error of x' is s times that of x the estimate is off by a factor of 1 -+ s only. (Two
 * integrations of different tolerance: Shampine & Baca, "Global error estimates for ODEs based on
 * extrapolation methods", SIAM J. Sci. Stat. Comput. 6 (1985) 1; Hairer, Norsett & Wanner I, II.4 and the
 * notes on global error there. Tolerance proportionality, that a tolerance p times smaller gives an error p
 * times smaller: Stetter 1980; Hairer & al. II.4.) Both runs are complete, with their own events and modes,
 * so an error propagates through events, stick and slip, and grows in an unstable motion as the true error
 * does; a linearized estimate would not.
 *
 * Rounding affects both runs. Runs with different steps round independently, so their difference includes the
 * accumulated rounding of a long run (where a method has no other error, the companion makes different steps
 * for that: run_options.apart); common rounding (of the constants of the formulas, of their value at one
 * instant) cancels. It is represented by a floor of some roundings of the size of the motion:
 * companion_error.
 *
 * Both are ensembles of the same islands. Each reaches a common time by its own steps. Sampling does not
 * change the main run: it is the same to the bit with and without a companion.
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
    bool follows;        /* the main run chooses its steps alike; those of the companion are shorter */
    long samples;        /* multiples of 1/500 of the run that have been passed */
    double next;         /* time of the next sample; HUGE_VAL when there is none */
    double unknown_from; /* HUGE_VAL; or a time from which on there is no estimate */
};

/* A companion for a run of these options, at the start. NULL when memory is out. */
struct companion *companion_new(const struct fbd_model *model, const struct run_options *options);
void companion_free(struct companion *companion);

/* Advance it to time t if possible, where `main` is, or which is in the last step of `main`. False when
 * memory is out. */
bool companion_go(struct companion *companion, const struct ensemble *main, double t);

/* The companion's state, evaluated, at time t, where `main` is, or in its last step. `after_event`: `main` is
 * at t after events, and the state after them is requested. If the companion's own event is still to come
 * (later by the error of its time), the jump and the modes of `main` are applied to its state. False when
 * there is no such state: the companion has failed, or has ended long before. */
bool companion_look(struct companion *companion, const struct ensemble *main, double t, bool after_event,
                    struct fbd_state *state);

/* Update the largest errors by those at time t, which the companion has reached. companion->next is a
 * multiple of 1/500 of the run, like output rows: output times lie within steps, too, where the dense output
 * may have larger errors than the end of the step. The end of the run is a sample, too. */
void companion_sample(struct companion *companion, struct ensemble *main, double t);

/* There is no estimate from t on. */
void companion_lose(struct companion *companion, double t);

/* Estimated error of component i (n coordinates, then n rates) with value `main`, and `other` in the
 * companion. Includes a floor for rounding common to both runs. */
double companion_error(const struct companion *companion, size_t i, double main, double other);

/* The global error so far, without units: the largest over all coordinates and rates of the largest error
 * over the samples, over the largest size in the run. INFINITY when there is no estimate. */
double companion_global(const struct companion *companion);

/* After `main` has ended: advance the companion to the events of `main`, if they are near. False when memory
 * is out. */
bool companion_come_to_events(struct companion *companion, const struct ensemble *main);

/* Estimated errors of the times of all events of `main`, which has ended; the companion has reached its own.
 * INFINITY for an event that the companion does not have. errors[main->event_count]. */
void companion_event_errors(const struct companion *companion, const struct ensemble *main, double *errors);

#endif
