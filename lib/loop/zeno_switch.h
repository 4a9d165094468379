/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Series of crossings of a switch: one that depends on positions, as in -F sign(x), is crossed infinitely
 * often in a finite time where each crossing is slower than the one before by a constant factor, as with dry
 * friction. When the amplitude is below the tolerance the rest of the series is summed, and a Filippov
 * sliding mode of second order begins (dynamics/sliding.h): u = 0 and u' = 0.
 *
 * While the forces vary little the intervals over two crossings form a geometric series, with a ratio given
 * by the last five crossings. The event has the time of the Zeno limit.
 */
#ifndef FBD_LOOP_ZENO_SWITCH_H
#define FBD_LOOP_ZENO_SWITCH_H

#include <stdbool.h>

struct run;
struct watcher;

/* When a sliding mode ended last, and its slack. */
struct leave {
    double t, slack;
};

struct passage {
    int count;   /* crossings since the last sliding mode */
    double t[5]; /* of the last ones, the latest first */
    bool slides; /* in a sliding mode, to be logged at the limit */
    struct leave left;
};

struct zeno_switches {
    struct passage *list; /* of each branch; NULL without possible sliding modes */
    bool *sticks;         /* of each friction pair: sticking, to be logged at the limit */
    double end;           /* Zeno limit of a summed series; HUGE_VAL without one */
    bool now;             /* summed at this event: logs of its new modes wait for the limit */
};

/* False when memory is out. */
bool zeno_switch_init(struct run *run);

/* Record a crossing of a switch. */
void zeno_switch_remember(struct run *run, const struct watcher *watcher);

/* After the changes of an event, before the modes are settled: find the switches whose series end. */
void zeno_switch_end(struct run *run);

/* A sliding mode begins again. Where it ended at this very instant the excess of its weight is below the
 * accuracy of the method, and it would alternate: increase its slack, each time further. */
void zeno_switch_blunt(struct run *run, int branch);

/* Log that a pair sticks, if that waits for the limit of a series; and log all waiting events once the limit
 * is reached. */
void zeno_switch_log_stick(struct run *run, int pair);
void zeno_switch_log(struct run *run);

#endif
