/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Stopwatch: elapsed time on this machine.
 */
#ifndef FBD_STUDY_STOPWATCH_H
#define FBD_STUDY_STOPWATCH_H

struct stopwatch {
    double wall, processor; /* of the start */
};

struct stopwatch stopwatch_start(void);

/* Seconds since the start: wall time, or processor time if other processes took the processor (it was
 * available for less than 95 % of the time). A processor clock that has not ticked yet is ignored. Budgets
 * use the same time, so that a study measures the same points on a loaded machine. */
double stopwatch_seconds(const struct stopwatch *stopwatch);

#endif
