/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * An expression passes to another branch, a normal force to the other side.
 */
#ifndef FBD_LOOP_SWITCH_EVENT_H
#define FBD_LOOP_SWITCH_EVENT_H

#include "loop/run.h"

/* Take the branch beyond what `watcher`, a watch_kink, watches, and note it where there is something to see. Ends the
 * run where a table has no more values. */
void switch_cross(struct run *run, const struct watcher *watcher);

/* The normal force of a guide with two sides, that of friction `pair`, changes its side, and friction goes on with its
 * size. Where friction feeds that force by more than all of it neither side agrees, which ends the run. */
void run_turn_normal(struct run *run, int pair);

/* End the run where such a normal force has come to the other side without an event: it has grown beyond all bounds. */
void run_check_sides(struct run *run);

/* End the run where a coefficient of friction has come below zero. */
void run_check_friction(struct run *run);

/* End the run where a rounding or a periodic table is past counting (expr.h). */
void run_check_counts(struct run *run);

/* When all is decided that changes at an event: end the run where a prescribed motion jumps, or its velocity. */
void run_check_drives(struct run *run);

#endif
