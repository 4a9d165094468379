/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Event functions: smooth functions of (t, y) that are positive while the modes of a state last.
 *
 * They come from the plan and exist only for what can happen: a friction force that is constant and within
 * its limit has none. Functions of time alone form a set of their own, since their zeros are known before a
 * step is taken.
 *
 * A user event is not believed when it may be an error of the method. A velocity that drag lets decay, or one
 * that approaches its terminal value, gets there in infinite time only, yet the numbers pass to and fro once
 * the distance is below the tolerance. So where a step starts with a difference of the sides that is within
 * 10 tolerances of the largest one so far, the event happens when the difference has left this band on the
 * other side, not within it (300 tolerances for multistep methods). What crosses for good is late by as much
 * as its time is uncertain.
 */
#ifndef FBD_EVENTS_WATCHERS_H
#define FBD_EVENTS_WATCHERS_H

#include "base/arena.h"
#include "dynamics/modes.h"
#include "events/affine.h"
#include "events/interval_roots.h"

enum watcher_kind {
    watch_kink,         /* a branch of a switch ends; index: kink, part: switch, end 0 or 1 */
    watch_stick_limit,  /* the force needed to stick reaches its limit; index: pair, end 0: +x pull, 1: -x */
    watch_slip_stop,    /* the relative velocity reaches zero; index: pair */
    watch_normal_turns, /* the normal force of a two-sided guide with friction changes its side; index: pair
                         */
    watch_contact,      /* a normal force reaches zero; index: contact */
    watch_one_sided,    /* a taut rope goes slack, a slack one becomes taut; index: pair */
    watch_lift,         /* the normal force of a closed contact reaches zero; index: pair */
    watch_gap,          /* shapes meet; index: meeting, part: probe (dynamics/contact.h) */
    watch_edge,         /* what touches comes to the end of a side; index: coupling, end 0 or 1 */
    watch_user,         /* a user event; index: watch */
    watch_share,        /* the share of a switch that is slid on reaches an end; index: kink, part, end */
};

struct watcher {
    enum watcher_kind kind;
    int index, part, end;
};

struct watcher_set {
    struct watcher *watchers;
    size_t count;
    struct root_group *groups; /* in the order of the watchers: those that enclosures see together */
    size_t group_count;
};

struct watchers {
    struct watcher_set timed;    /* functions of t alone */
    struct watcher_set moving;   /* all others */
    struct affine *affine;       /* of each of these what it is in the present modes */
    bool any_affine, all_affine; /* are there some, and are all that can happen */
    double *scratch;             /* margins, rates and roundings of one kink */
    struct enclosure *margins;   /* the same as enclosures */
    int *armed;                  /* per user event: +1 or -1, the side where it is; 0 while it sits on zero */
    double *fired;               /* per user event: when it happened last; NAN: it has not */
    bool *asleep;                /* per meeting: it is too far apart to be looked at in this step; or NULL */
    double *deep;                /* per meeting: how deep it was left open; or NULL */
    double width;                /* of the bands of user events, relative to the largest size */
    bool *held;                  /* per branch: a stick holds the switch at zero; it is not watched */
    int *zeros;                  /* scratch for that: places where it is zero */
    double *place;               /* such a place, and as many zeros */
    double *fast, *quiet; /* per pair that drives alone make slip: its largest speed; 0, or where a step
                                  starts with next to none how fast it may seem to turn back. Of what is one-sided:
                                  how far beyond it was left open */
    double *most, *band;  /* per user event: largest size of the difference; 0, or where a step starts in the
                            band its half width */
};

/* Build the sets for a model, of `memory`; false when that is out. */
bool watchers_init(struct watchers *watchers, const struct fbd_model *model, double tolerance, bool multistep,
                   struct arena *memory);

/* values[count] and rates[count] (along the motion) of a set at an instant. +HUGE_VAL and 0 for what cannot
 * happen in the present modes. `state` lends its modes and scratch; (t, y) may be any point of a step. Kinks
 * read the moment, all else its double. */
void watchers_evaluate(const struct watchers *watchers, const struct watcher_set *set,
                       struct fbd_state *state, struct time_dd t, const double *y, double *values,
                       double *rates);

/* The same for all that moves, at a state whose rates of change dy are those of the modes that are followed. False where not all
 * of it is affine. */
bool watchers_evaluate_affine(const struct watchers *watchers, const double *y, const double *dy,
                              double *values, double *rates);

/* The same for functions of t alone, with how near to zero each counts as zero. */
void watchers_evaluate_timed(const struct watchers *watchers, struct fbd_state *state, struct time_dd t,
                             double *values, double *rates, double *roundings);

/* Are there enclosures of this function? */
bool watchers_can_enclose(const struct fbd_model *model, const struct watcher *watcher);

/* Flag the components of the extended vector (world_refs.h) that enclosures of the set read. */
void watchers_mark_used(const struct fbd_model *model, const struct watcher_set *set, bool *used);

/* Enclosures of the functions of a group over a stretch of time, in the modes of `state`, for motions within
 * the spans y of the extended vector; y may be NULL for functions of time alone. */
void watchers_enclose(const struct watchers *watchers, const struct watcher_set *set, size_t group,
                      const struct fbd_state *state, const struct stretch *stretch, const struct enclosure *y,
                      struct enclosure *out);

/* Say which functions have enclosures in the modes that follow: where the motion slides on switches whose shares
 * have none (enclosure.h), these and sums of forces are samples. */
void watchers_follow(struct watchers *watchers, const struct fbd_state *state);

/* Of functions that are samples, in the modes of `state` where it is now: what is rounding, half of what keeps a zero of
 * rounding from counting. Entries of others are left as they are. */
void watchers_set_rounding(const struct watcher_set *set, const struct fbd_state *state, double *rounding);

/* A part of it: set `held`. */
void watchers_hold(struct watchers *watchers, const struct fbd_state *state);

/* Arm user events that have left zero, and see which are in their band, and what drives make slip with next
 * to no speed; call at the start and after each accepted step, of the length `step` [s], 0 at the start. */
void watchers_arm(struct watchers *watchers, struct fbd_state *state, double step);

/* A user event has been passed within a step: it is armed on the other side. */
void watchers_turn(struct watchers *watchers, int watch);

/* A normal force is lost when it is below minus this: the rounding of the weight, and of what the joints of
 * `tree` pass on now (NULL: they are not known), so that a body that only just touches is not thrown off. */
double watchers_contact_slack(const struct fbd_model *model, const struct tree_work *tree,
                              const struct contact *contact);

#endif
