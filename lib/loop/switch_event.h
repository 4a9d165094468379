/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Change of the branch of an expression, and of the loaded side of a guide.
 */
#ifndef FBD_LOOP_SWITCH_EVENT_H
#define FBD_LOOP_SWITCH_EVENT_H

#include "loop/run.h"

/* Change to the branch beyond `watcher`, a watch_kink, and log it unless the change is smooth. Ends the run
 * where a table has no more values. */
void switch_cross(struct run *run, const struct watcher *watcher);

/* The normal force of a two-sided guide, that of friction `pair`, changes its side; friction continues with
 * its magnitude. Where friction increases that force by more than itself no side is consistent, which ends
 * the run. */
void run_turn_normal(struct run *run, int pair);

/* End the run where such a normal force has changed its side without an event: it has become infinite. */
void run_check_sides(struct run *run);

/* End the run where a coefficient of friction is negative. */
void run_check_friction(struct run *run);

/* End the run where the branch number of a rounding or a periodic table overflows (expr.h). */
void run_check_counts(struct run *run);

/* After all changes of an event: end the run where a prescribed motion, or its velocity, jumps. */
void run_check_drives(struct run *run);

#endif
