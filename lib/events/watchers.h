/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Event functions: smooth functions of (t, y) that are positive while the modes of a state last.
 *
 * They are built from the plan, only for events that can happen: a friction force that is constant and within
 * its limit has none. Functions of time alone form a separate set, since their zeros are found before a step
 * is made.
 *
 * A user event may be an error of the method. A velocity that decays by drag, or one that approaches its
 * terminal value, reaches it in infinite time only, yet the computed difference alternates in sign once it is
 * below the tolerance. So where a step starts with a difference of the sides that is within 10 tolerances of
 * the largest one so far (300 for multistep methods), the event happens when the difference leaves this band
 * on the other side, not within it. The delay of a true crossing is of the order of the uncertainty of its
 * time.
 */
#ifndef FBD_EVENTS_WATCHERS_H
#define FBD_EVENTS_WATCHERS_H

#include "base/arena.h"
#include "dynamics/modes.h"
#include "events/affine.h"
#include "events/interval_roots.h"

enum watcher_kind {
    watch_kink,        /* a branch of a switch ends; index: kink, part: switch, end 0 or 1 */
    watch_stick_limit, /* the friction force needed to stick reaches its limit; index: pair, end 0: +x, 1: -x */
    watch_slip_stop,   /* the relative velocity reaches zero; index: pair */
    watch_normal_turns, /* the normal force of a two-sided guide with friction changes its side; index: pair
                         */
    watch_contact,      /* a normal force reaches zero; index: contact */
    watch_one_sided,    /* a taut rope goes slack, a slack one becomes taut; index: pair */
    watch_lift,         /* the normal force of a closed contact reaches zero; index: pair */
    watch_gap,          /* shapes meet; index: meeting, part: probe (dynamics/contact.h) */
    watch_edge,         /* the contact point reaches the end of a side; index: coupling, end 0 or 1 */
    watch_user,         /* a user event; index: watch */
    watch_share, /* the weight of a switch in a Filippov sliding mode reaches an end; index: kink, part, end */
};

struct watcher {
    enum watcher_kind kind;
    int index, part, end;
};

struct watcher_set {
    struct watcher *watchers;
    size_t count;
    struct root_group *groups; /* in the order of the watchers: functions that are enclosed together */
    size_t group_count;
};

struct watchers {
    struct watcher_set timed;    /* functions of t alone */
    bool timed_affine;           /* each is a + b t while the branches last */
    struct watcher_set moving;   /* all others */
    struct affine *affine;       /* per moving function: its affine form in the present modes */
    bool any_affine, all_affine; /* is any, or every active one, affine */
    double *scratch;             /* margins, rates and roundings of one kink */
    struct enclosure *margins;   /* the same as enclosures */
    int *armed;                  /* per user event: +1 or -1, its side; 0 while it is zero */
    double *fired;               /* per user event: time of the last one; NAN: none */
    bool *asleep;                /* per contact pair: too far apart to be evaluated in this step; or NULL */
    double *deep;                /* per contact pair: depth at which it was left open; or NULL */
    double width;                /* of the bands of user events, relative to the largest size */
    bool *held;                  /* per branch: sticking keeps the switch at zero; it is not watched */
    int *zeros;                  /* scratch for that: components that are zero */
    double *slacks;              /* scratch: of watchers_delay */
    double *place;               /* scratch: a state with these zeros, and as many zeros */
    double *fast,
        *quiet; /* per mode: largest driven slip speed; band of it that is ignored, see watchers_arm */
    int *stops; /* per mode: how many of its stops changed nothing, since it last moved */
    double *most, *band; /* per user event: largest size of the difference; half width of its band, or 0 */
};

/* Build the sets for a model, in `memory`; false when that is out. */
bool watchers_init(struct watchers *watchers, const struct fbd_model *model, double tolerance, bool multistep,
                   struct arena *memory);

/* values[count] and rates[count] (along the motion) of a set at an instant. +HUGE_VAL and 0 for events that
 * cannot happen in the present modes, and for those not asked for (NULL: all are). The modes and scratch of `state` are used; (t, y) may be any point of a
 * step. Kinks read the double-double time, all others its leading double. */
void watchers_evaluate(const struct watchers *watchers, const struct watcher_set *set,
                       struct fbd_state *state, struct time_dd t, const double *y, const bool *asked,
                       double *values, double *rates);

/* How late may an event be whose functions of the moving set have crossed at (t, y)? A function is zero where a force is
 * past its limit, or a corner past an edge, by some roundings, so that nothing happens by rounding alone: the delay [s] is
 * the largest of these divided by the rate of the function; 0 where the zero was that of the force itself (affine.h). Gaps
 * have none: a body that has met another one is as deep at each meeting after that. 2 `values` of each are scratch. */
double watchers_delay(const struct watchers *watchers, struct fbd_state *state, struct time_dd t,
                      const double *y, const bool *crossed, double *values);

/* The same for the moving set, at a state whose derivative dy is that of the modes in use. False if a
 * function is not affine. */
bool watchers_evaluate_affine(const struct watchers *watchers, const double *y, const double *dy,
                              double *values, double *rates);

/* The same for functions of t alone, with the round-off level of each. */
void watchers_evaluate_timed(const struct watchers *watchers, struct fbd_state *state, struct time_dd t,
                             double *values, double *rates, double *roundings);

/* Does this function have enclosures? */
bool watchers_can_enclose(const struct fbd_model *model, const struct watcher *watcher);

/* Flag the components of the extended vector (world_refs.h) that enclosures of the set read. */
void watchers_mark_used(const struct fbd_model *model, const struct watcher_set *set, bool *used);

/* Enclosures of the functions of a group over a stretch of time, in the modes of `state`, for motions within
 * the ranges y of the extended vector; y may be NULL for functions of time alone. */
void watchers_enclose(const struct watchers *watchers, const struct watcher_set *set, size_t group,
                      const struct fbd_state *state, const struct stretch *stretch, const struct enclosure *y,
                      struct enclosure *out);

/* Determine which functions have enclosures in the present modes: in a Filippov sliding mode whose weights
 * have none (enclosure.h), these and sums of forces are sampled. */
void watchers_follow(struct watchers *watchers, const struct fbd_state *state);

/* Set the round-off level of sampled functions, in the modes of `state` at its present point; a zero within
 * twice that level does not count. Other entries are left unchanged. */
void watchers_set_rounding(const struct watcher_set *set, const struct fbd_state *state, double *rounding,
                           double *jump);

/* A part of watchers_arm: set `quiet`. */
void watchers_calm(struct watchers *watchers, const struct fbd_state *state, double step);

/* After events, of which `moving` crossed: count stops after which friction slips on to the same side. It may be blocked, with
 * a velocity of round-off. */
void watchers_count_stops(struct watchers *watchers, const bool *moving, const struct fbd_state *before,
                          const struct fbd_state *after);

/* A part of watchers_follow: set `held`. */
void watchers_hold(struct watchers *watchers, const struct fbd_state *state);

/* Arm user events that have left zero, and determine which are within their band, and which pairs slip by
 * drives alone at nearly zero speed: `quiet` is the speed up to which their reversal is ignored. (For
 * one-sided modes it is how far beyond zero they were left open.) Call at the start and after each accepted
 * step, of the length `step` [s], 0 at the start. */
void watchers_arm(struct watchers *watchers, struct fbd_state *state, double step);

/* The rate along the motion of the difference of a user event, in the modes of `state`. */
double watch_rate(const struct watch *watch, struct fbd_state *state);

/* A user event has occurred within a step: arm it on the other side. */
void watchers_turn(struct watchers *watchers, int watch);

/* A normal force is lost when it is below minus this value: the round-off of the weight, and of the forces
 * that the joints of `tree` transmit (NULL: unknown), so that a body that barely touches does not separate. */
double watchers_contact_slack(const struct fbd_model *model, const struct tree_work *tree,
                              const struct contact *contact);

#endif
