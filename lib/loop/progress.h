/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Progress of a run relative to its work (progress.c).
 */
#ifndef FBD_LOOP_PROGRESS_H
#define FBD_LOOP_PROGRESS_H

#include <stdbool.h>

/* Since the last check [s]. */
struct gain {
    double time;           /* gained since then */
    double passed, length; /* since the start of the run; length of the whole run */
    double first;          /* its first step */
    bool rejects;          /* most steps since then were rejected */
};

/* Is the time gained negligible? Compared with the elapsed time, or the first step where that is longer, and
 * with the length of the run, which may be very long if an event is to end it. */
bool progress_is_none(const struct gain *gain);

#endif
