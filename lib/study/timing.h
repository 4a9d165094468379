/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Timing: how long runs take, each by the median of repeats.
 *
 * What is timed is the whole life of a simulation without any output: making it, all steps, freeing it. All
 * runs are repeated in turn, each round starting at another one, so that what disturbs the machine for a
 * while disturbs all alike. A run too short for the clock is made several times for one reading.
 */
#ifndef FBD_STUDY_TIMING_H
#define FBD_STUDY_TIMING_H

#include "study/track.h"

enum { most_repeats = 31 };

struct timed {
    const fbd_model *model;
    fbd_options options;
    double estimate; /* of its time, seconds */
    unsigned repeats;
    double samples[most_repeats];
    double seconds, low, high; /* median and quartiles */
};

/* Told now and then how far a study has got, 0 to 1. */
struct progress {
    fbd_watch *watch; /* or NULL */
    void *context;
};

/* False, with the note `stopped`, when the study is to end. */
bool progress_report(const struct progress *progress, const char *what, double share, fbd_errors *errors);

/* Time all of them within about `seconds`: each at least once, the short ones up to most_repeats times.
 * False when memory is out. */
bool timing_in_turn(struct timed *timed, size_t count, double seconds, const struct progress *progress,
                    fbd_errors *errors);

#endif
