/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Zeno limits: infinitely many events in finite time, of bounces and of switches. When the events are below the
 * tolerance the series is cut, and its limit computed.
 *
 * Bounces (zeno.c, zeno_rest.c). A body that bounces with e < 1 does so infinitely often in finite time. When its
 * bounces are lower than the tolerance, the rest of the series is summed: the intervals form a geometric series,
 * exactly so with constant acceleration. The body then rests on its surface; the event has the time of the Zeno
 * limit. The same is done for a body that rocks from corner to corner, and for one that lands plastically and is
 * lifted again by a rope that becomes taut, as in Atwood's machine on the floor: at the limit the surface and the
 * rope are both closed.
 *
 * Remaining impulses (zeno_impulses.c). The cut is at a height, so that the answer must not depend on it. Let v be the
 * velocities after the impact at the cut along the lines of all constraints that are closed at the limit, touching
 * or still in flight, T the time to the limit, W the response to unit impulses and a the acceleration by all other
 * forces. The remaining impulses P end all of v; the impulses N T of rest in that time keep it zero:
 *
 *     v + W P + a T = 0,     W N T + a T = 0,     so that     W (P - N T) = -v
 *
 * The impulses D = P - N T, followed by rest, have the velocities of the series at the limit: without a, T and the
 * height of the cut. D is of either sign: a corner that leaves exerts m v less than its weight does in the same time, one
 * that approaches exerts more. Friction is the same linear function of the normal impulse in both motions while a
 * point slips in one direction, D_t = -mu D_n sign(v_t), and of the load of a guide on a slide; a point that sticks,
 * or whose slip D would reverse, has v_t = 0 at the limit. The order of the impacts does not matter, nor does their number.
 *
 * Limits: a and W are constant during T, which neglects a change of the velocities of second order in T. Positions
 * have the accuracy of the cut, 1e-9 of the scene. Between the cut and the limit the velocities are those of rest.
 *
 * Switches (zeno_switch.c). A switch that depends on positions, as in -F sign(x), is crossed infinitely often in a
 * finite time where each crossing is slower than the one before by a constant factor, as with dry friction. When the
 * amplitude is below the tolerance the rest of the series is summed, and a Filippov sliding mode of second order
 * begins (dynamics/sliding.h): u = 0 and u' = 0. While the forces vary little the intervals over two crossings form
 * a geometric series, with a ratio given by the last five crossings. The event has the time of the Zeno limit.
 */
#ifndef FBD_LOOP_ZENO_H
#define FBD_LOOP_ZENO_H

#include <stdbool.h>

struct run;
struct watcher;

/* ---- bounces */

/* Height of bounces below the tolerance, in units of `near` of dynamics/contact.h: 1e-9 of the scene. */
enum { zeno_height = 1000 };

/* The recent impacts of a contact pair. */
struct bounces {
    int count;         /* since it was last at rest */
    double t[5];       /* times of the last ones, the latest first */
    int feature;       /* of the last one */
    int unseen;        /* number of successive ones with bounces below the tolerance */
    double slow;       /* a speed whose bounce stays within the tolerance of position */
    double rests_from; /* Zeno limit of a summed series; HUGE_VAL without one */
    /* Impacts of a contact that was closed before and is reopened by ropes: their times, the latest first. */
    bool is_closed;
    int returns;
    double returned[12];
};

/* After an impact of `count` impact constraints: has a sequence of bounces become smaller than the tolerance? */
bool zeno_end_bounces(struct run *run, int count);

/* Would zeno_rest change the speed of each body by no more than bounces below the tolerance do? */
bool zeno_rest_is_harmless(struct run *run, int count);

/* Place bouncing bodies on their surfaces, and apply their remaining impulses; the impact constraints are then the
 * touching contacts. Returns their number. */
int zeno_rest(struct run *run);

/* A body placed on its surface by zeno_rest may overlap neighbouring ones, the deeper the farther they are
 * from its axis of rotation: move these out. Returns whether there were any, which may now touch. */
bool zeno_lift_others(struct run *run);

/* Apply the remaining impulses of the first `count` impact constraints: of all that do not separate, and of those that
 * `stays` marks; rest takes the speed `slow` in that time. contacts_find_responses was called, or contacts_strike. */
void zeno_apply_remaining(struct run *run, int count, double slow);

/* A rope became taut, or a contact landed, and opened others by it, which do the same alternately: as soon as
 * one opens by less than the tolerance all stay closed. */
void zeno_end_rope_impacts(struct run *run, int count);

/* The interval between the last two of many successive such impacts below the tolerance; 0 otherwise. */
double zeno_rope_limit(const struct run *run);

/* The next Zeno limit of a sequence of bounces; HUGE_VAL without one. zeno_log_rests logs those that are over. */
double zeno_next_rest(const struct run *run);
void zeno_log_rests(struct run *run);

/* ---- switches */

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
