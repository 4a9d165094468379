/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Timing: the times that runs take, each the median of repeats.
 *
 * The timed operation is the whole life of a simulation without output: making it, all steps, freeing it. The
 * runs are interleaved, each round starting at another one, so that a temporary disturbance of the machine
 * affects all alike. A run too short for the clock is made several times per reading.
 */
#ifndef FBD_STUDY_TIMING_H
#define FBD_STUDY_TIMING_H

#include "fbd.h"

enum { most_repeats = 31 };

struct timed {
    const fbd_model *model;
    fbd_options options;
    double estimate; /* of one run, seconds */
    unsigned repeats;
    double samples[most_repeats];
    double seconds, low, high; /* median and quartiles */
};

/* Receives the progress of a study, 0 to 1. */
struct progress {
    fbd_watch *watch; /* or NULL */
    void *context;
};

/* Returns false, with the note `stopped`, when the study is to end. */
bool progress_report(const struct progress *progress, const char *what, double share, fbd_errors *errors);

/* Time all of them within about `seconds`: each at least once, the short ones up to most_repeats times.
 * Returns false when memory is out. */
bool timing_in_turn(struct timed *timed, size_t count, double seconds, const struct progress *progress,
                    fbd_errors *errors);

#endif
