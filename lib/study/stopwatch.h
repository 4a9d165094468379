/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Stopwatch: how long something took on this machine.
 */
#ifndef FBD_STUDY_STOPWATCH_H
#define FBD_STUDY_STOPWATCH_H

struct stopwatch {
    double wall, processor; /* of the start */
};

struct stopwatch stopwatch_start(void);

/* Seconds since the start: wall time, or processor time where the process was held up by others (it had the
 * processor for less than 95 % of the time). A clock of the processor that counts in ticks may not have moved: then wall time.
 * Budgets are counted by it as well, so that a study measures the same points on a loaded machine. */
double stopwatch_seconds(const struct stopwatch *stopwatch);

#endif
