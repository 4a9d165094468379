/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Progress: what a run gains for its work (progress.c).
 */
#ifndef FBD_LOOP_PROGRESS_H
#define FBD_LOOP_PROGRESS_H

#include <stdbool.h>

/* Of the run since the last check [s]. */
struct gain {
    double time;           /* gained since then */
    double passed, length; /* since the start of the run; of the whole run */
    double first;          /* its first step */
    bool rejects;          /* most steps since then were rejected */
};

/* Is the time gained negligible? Beside the time that has passed, or the first step where that is longer, and the length of
 * the run, which may be very long as an event is to end it. */
bool progress_is_none(const struct gain *gain);

#endif
