/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Passages without end: a switch that watches places, as in -F sign(x), is passed infinitely often in a finite
 * time where each passage is slower than the one before by a constant factor, as with dry friction. When they
 * are too small to be seen the rest of the series is summed up, and the motion slides on the switch in second
 * order (dynamics/sliding.h): u = 0 and u' = 0.
 *
 * While the forces vary little the intervals from one passage to the one after the next are a geometric
 * series, with a ratio that the last five passages show. The event has the time of the limit.
 */
#ifndef FBD_LOOP_ZENO_SWITCH_H
#define FBD_LOOP_ZENO_SWITCH_H

#include <stdbool.h>

struct run;
struct watcher;

/* When a slide was left last, and with which slack. */
struct leave {
    double t, slack;
};

struct passage {
    int count;   /* passages since it was slid on last */
    double t[5]; /* of the last ones, the latest first */
    bool slides; /* from the end of the series */
    struct leave left;
};

struct zeno_switches {
    struct passage *list; /* of each branch; NULL where no switch can be slid on */
    bool *sticks;         /* of each friction pair: from that end, too */
    double end;           /* of a series that is summed up; HUGE_VAL without one */
    bool now;             /* it has been summed up at this event: what begins by that waits for the end */
};

/* False when memory is out. */
bool zeno_switch_init(struct run *run);

/* A switch has just been passed. */
void zeno_switch_remember(struct run *run, const struct watcher *watcher);

/* After all that happens at an event, before the modes are settled: say what has been passed for the last time. */
void zeno_switch_end(struct run *run);

/* A branch is slid on again. Where it has been left in this very instant, what lies beyond the end of its share is
 * less than what the method resolves, and would send it to and fro: it has room from there, more each time. */
void zeno_switch_blunt(struct run *run, int branch);

/* Note that a pair sticks, when that waits for the end of a series; and all that waits, when the end is there. */
void zeno_switch_log_stick(struct run *run, int pair);
void zeno_switch_log(struct run *run);

#endif
