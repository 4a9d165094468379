/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Run: the loop that integrates a scene over time.
 *
 * One turn of the loop: find the next event that depends on time alone, by root exclusion and however many
 * periods ahead; make one accepted step that ends there at the latest; search the dense output of the step
 * for the first other event: all zeros of its function are found, by interval enclosures where they exist
 * (watchers_can_enclose), else by its Chebyshev series (series.h states the assumptions); if there is an
 * event, go back to it by a partial step and refine its time by Newton's method; apply all events of that
 * instant; settle the modes; restart the stepper. Between events everything is smooth, so every method keeps
 * its order.
 *
 * Searches use doubles. A root is refined to a time_dd (base/time_dd.h) where it is applied: within a
 * rounding of the time every function is linear, so its value and rate at a double next to the event
 * determine the rest.
 */
#ifndef FBD_LOOP_RUN_H
#define FBD_LOOP_RUN_H

#include "dynamics/diagram.h"
#include "dynamics/modes.h"
#include "dynamics/rates.h"
#include "dynamics/tree.h"
#include "events/coupled_error_scale.h"
#include "events/poles.h"
#include "events/scan.h"
#include "events/trajectory_poly.h"
#include "events/watchers.h"
#include "integrate/linear.h"
#include "integrate/switcher.h"
#include "loop/contacts.h"
#include "loop/energy_guard.h"
#include "loop/structure.h"
#include "loop/zeno.h"

struct run_options {
    double until;
    double tolerance;
    double step; /* fixed size, or 0 */
    const struct method *method;
    bool automatic;                /* switch between the explicit and the stiff method as needed */
    bool structure;                /* exploit the structure of the plan (structure.h) */
    bool apart;                    /* of a companion: where events set steps, they differ */
    bool delays;                   /* of events are asked for, see run_event */
    bool ends_only;                /* states between start and end are not asked for */
    const struct fbd_state *start; /* initial state of the whole model; NULL: that of the file */
    bool continues; /* the start continues a run of the whole model: its changed modes are events */
};

struct run_event {
    double t;
    double delay; /* it may be so late, since a force passes its limit by some roundings before it acts [s] */
    fbd_event_kind kind;
    int body, load, watch; /* -1 where it does not apply */
    int own;               /* a switch in the rate of this user state, or -1 */
    int branch;            /* of a switch */
    size_t group, order;   /* of an ensemble: the island, and the index in its log */
    double force, limit;   /* friction: after the event; static limit. Contact: N; its rounding */
    struct impact_record impact;
};

/* Are they of the same kind, body and source? */
static inline bool events_are_alike(const struct run_event *a, const struct run_event *b)
{
    return a->kind == b->kind && a->body == b->body && a->load == b->load && a->watch == b->watch;
}

/* The largest residuals of the coupling equations at the end of a step, before and after the projection. */
struct drift {
    double position, velocity, left_position, left_velocity;
    double reach, speed; /* the largest of the links so far, the scale of the residuals */
    const char *worst;   /* the row with the largest residual in position; NULL without steps */
};

enum { reason_size = 400 };

/* The last step, and limits for the next one. */
struct stride {
    double from, from_rest;   /* where it began; it ends at state->t and state->rest */
    double h;                 /* step size proposed */
    double first;             /* the first proposed size */
    double longest;           /* longest step to an event so far */
    double flight;            /* limit of the size of the next step without a closed contact; 0: no limit */
    double most;              /* limit of the size of the next steps if options.apart; 0: no limit */
    bool restart;             /* restart the stepper before the next step */
    int crawl;                /* number of successive steps of a few roundings of the time */
    unsigned long not_finite; /* rejections before the last step because values were not finite */
};

/* Time gained per work: see progress.c. */
struct progress {
    double start; /* the time at which the run began */
    double t;     /* at the last check */
    unsigned long work, accepted, rejected;
};

/* Status, and how the run has ended. */
struct ending {
    fbd_outcome outcome;
    const char *reason;  /* "" without a failure */
    const char *refusal; /* of a start: id of the reason (start.h), and position; or NULL */
    struct pos refusal_at;
};

/* A rope that has just become taut. */
struct snap {
    int pair;    /* its mode, or -1 */
    double work; /* energy lost in its impact (below zero) */
};

/* Search for events, besides the watchers. */
struct event_search {
    struct scan timed, moving;
    bool knows_timed; /* timed.t and timed.crossed are those of the next zero (functions that are affine) */
    bool *reads;      /* for each group of moving functions: the components that it reads */
    bool *wanted;     /* the groups that are searched at present */
    bool paced,
        paced_by_motion; /* sampled functions may change as fast as formulas do; with the motion, too */
    bool follows_places; /* the trajectory polynomial includes positions in the world */
    bool leads;          /* there are prescribed motions (impose_drives) */
    bool leads_speeds;   /* drives prescribe speeds, too: guides turn by them */
    bool wakes;          /* there are levels in switches that may be silent (expr_switch_is_silent) */
};

/* Round-off levels of accelerations: see roundoff.c. */
struct roundoff {
    double *accelerations; /* plan_rates: round-off level of accelerations and of rates of user states */
    double *largest;       /* plan_rates: the largest values for which that was computed */
    bool heeds_time;       /* a force, or the rate of a user state, depends on time explicitly */
    double *along;         /* plan_rates: rates of change along the motion at the last update */
    double *turned;        /* twice the links of the tree */
    double *cancelled;     /* for each body a force and its moment */
    double *formulas;      /* n: effect of rounding within formulas on accelerations */
    double *nothing;       /* plan_size: values negligible compared with the largest motion, at a start */
    unsigned long since,
        pause; /* steps since; and steps to wait while the level matters but hardly changes */
};

/* Scratch of the loop: plan_size numbers each, unless noted. */
struct run_work {
    double *y, *f; /* the end of the last step, before its events */
    double *sample;
    double *aside;  /* 2 plan_size: a sample computed by another formula */
    double *values; /* event functions of a set, their rates, the roundings of timed ones */
    double *kept;   /* 2 plan_size: y and f during the search for user events */
    bool *crossed;  /* crossed moving event functions, likewise */
};

struct event_log {
    struct run_event *events;
    size_t count, room;
};

/* Events that accumulate at one instant, and events that recur around one state. */
struct recent {
    double time;           /* of the last event */
    int crowd, turns;      /* events at that instant; and sign changes of normal forces there */
    struct time_dd moment; /* the start, or the time of the last events */
    double interval[2];    /* the last two intervals between these; infinite before there are three */
    double *anchor; /* 2 plan_size: the state around which the last events happened; the largest |y_i| */
    int around;     /* number of events around it */
};

struct run {
    struct arena *memory; /* of all runs of an ensemble: for data from the start to the end of the run */
    const struct fbd_model *model;
    struct run_options options;
    enum structure kind;          /* in use: general unless options.structure and options.automatic */
    bool flies;                   /* of structure_flights, in a mode without closed contacts */
    struct fbd_state *state;      /* at the end of the last step, with the modes of the next one */
    struct fbd_state *during;     /* modes of the last step; its scratch is used for samples within it */
    struct fbd_state *kept_modes; /* those modes, while forces and couplings begin and end; NULL if none do */
    struct stride step;
    struct progress progress;
    struct ending end;
    bool lazy;        /* no step needs the forces of `state` at its end */
    bool plain;       /* nor can a step be cut or projected: no events and couplings */
    bool undisturbed; /* nor can a step be cut: no events, and couplings without limits */
    bool leaps;   /* plain and linear, and works follow from potentials: steps need not resolve the motion */
    bool stale;   /* the forces have not been evaluated at the time of `state` */
    double delay; /* of the events at the end of the last step, see run_event */

    struct counted_system system;
    struct rates *rates; /* in the modes of `during` */
    struct switcher *stepper;
    struct linear_pace pace; /* of a linear system */
    bool *keeps_force;       /* of a linear system, for each load: structure_keeps_force */
    struct roundoff roundoff;
    struct drift drift; /* residuals of the constraints */
    bool projected;

    struct watchers watchers;
    struct event_search search;
    struct trajectory trajectory; /* input of moving functions with enclosures */
    struct poles poles;
    struct coupled_scales mechanisms;
    struct zeno_switches zeno_switches;

    struct decided decided;
    struct contacts_work contacts;
    struct snap snap;
    bool ended;          /* a coupling has begun or ended, and the modes are not settled yet */
    double *impact_work; /* per load: total work of impacts */
    struct energy_guard energy;
    double liveliest; /* the largest kinetic energy of jointed bodies so far */
    struct event_log log;
    unsigned long events; /* steps that ended in events */
    struct recent recent;
    struct run_work work;
};

/* A run at the start of the model, with modes settled and events of t = 0 applied. It is in `memory`, with its arrays and
 * states; run_free frees its other memory. NULL when memory is out. */
struct run *run_new(const struct fbd_model *model, const struct run_options *options,
                    const struct state_start *begin, struct arena *memory);
void run_free(struct run *run);

/* The cost of a run, and its balance of energy. */
struct run_totals {
    double t; /* the time reached */
    enum structure kind;
    unsigned long steps, stiff_steps, rhs, jacobians, event_samples, rejected;
    struct energy_balance energy;
};

struct run_totals run_totals(struct run *run);

/* Does the method in use make steps of any length without truncation error? Do they extend to the next event? */
static inline bool run_is_exact(const struct run *run)
{
    return run->flies || structure_is_exact(run->kind);
}

static inline bool run_is_one_step(const struct run *run)
{
    return run->flies || structure_is_one_step(run->kind);
}

/* Evaluate forces and accelerations of run->state if they are stale. */
static inline void run_evaluate(struct run *run)
{
    if (run->stale) state_evaluate_unshared(run->state);
    run->stale = false;
}

/* One turn of the loop. */
fbd_outcome run_advance(struct run *run);

/* The state at t in [from, state->t] of the last step, in the modes of that step: its numbers y alone, or with its
 * accelerations too. */
bool run_place(struct run *run, struct time_dd t, struct fbd_state *state);
bool run_look(struct run *run, struct time_dd t, struct fbd_state *state);

/* Coordinates, rates and user states at t (plan_size), from the dense output alone. */
bool run_coordinates(struct run *run, struct time_dd t, double *y);

/* The ends of the last step. */
static inline struct time_dd run_start(const struct run *run)
{
    return (struct time_dd){run->step.from, run->step.from_rest};
}

static inline struct time_dd run_end(const struct run *run)
{
    return state_moment(run->state);
}

/* Is the force of a load constant over the last step, or linear in time and all velocities constant? Then its work
 * between two times of the step is their difference times its power in the mean state: the mean positions, and the mean
 * velocities, by the displacements; `forces`: with its forces. */
bool run_keeps_force(const struct run *run, size_t load);
bool run_look_mean(struct run *run, struct time_dd from, struct time_dd to, bool forces,
                   struct fbd_state *state);

/* Number of panels of the last step for Gauss's rule with five points, such that the error of an integral of
 * powers is below that of the motion. For linear systems each panel is half a radian, or a decay by
 * 1/sqrt(e), of the fastest mode (4e-13, Abramowitz & Stegun 25.4.30). */
int run_panels(const struct run *run);

/* ---- internal to the loop */

/* The method (run_method.c): whether it follows from the structure; its steppers, false when memory is out; that of the
 * present modes; the start of its stepper, with the slopes (constant accelerations are those of the state; a code of GSL);
 * of a linear system its matrices, false when the run has failed; the size of the next step where the
 * method has no error estimate; and how far the next step without a closed contact may reach. */
bool run_chooses_structure(const struct run *run);
bool run_make_stepper(struct run *run);
void run_choose_method(struct run *run);
int run_start_stepper(struct run *run);
bool run_start_linear(struct run *run);
void run_limit_method(struct run *run);
void run_limit_flight(struct run *run);

/* Event functions and their scans (run_watch.c). False when memory is out. */
bool run_make_scans(struct run *run);

/* The first event up to `to` that depends on time alone, in search.timed: 1 found, 0 none, 2 given up (scan_interval).
 * (run_time.c) */
int run_find_timed(struct run *run, double to);

/* The time of the timed events that the scan has found; flags those of that time in
 * run->search.timed.crossed. (run_time.c) */
struct time_dd run_pin_timed(struct run *run);

/* Time to the next event that depends on time alone, or to the end of the run. */
double run_time_to_switch(struct run *run);

/* Move y with slopes f from the double t to the time of an event, `move` away and a few roundings at most; no
 * effect where that is outside the step that ends at `end`. */
struct time_dd run_pin_moving(struct run *run, double t, double move, struct time_dd end);

/* Implement options.apart (run_time.c): before a limit is found, and when it is. */
void desync_steps(struct run *run);
void desync_steps_from(struct run *run, struct time_dd limit);

/* Does the dense output of the step to `end` violate the equations of motion? (defect_control.c) */
bool defect_is_large(struct run *run, struct time_dd end);

/* Find the first event in the step to *t that changes the motion. Sets *t to its time, and y and f to the values there; a
 * step that has passed a pole is cut before it. 1 found, 0 none, -1 failed. Then log the user events up to there, once the
 * step is final: `change` if none of them cuts it. (run_find.c) */
int run_find_event(struct run *run, struct time_dd *t);
int run_tell_events(struct run *run, struct time_dd *t, int change);

/* When steps fail: if the state is before switches by a rounding of the time, move it past them by as much,
 * and flag them as crossed moving functions. Roots and powers of max(x, 0) or abs(x) do not allow a step
 * beyond their switch. (run_find.c) */
bool run_pass_brink(struct run *run);

/* The same after events, where the state is before the switch by a rounding, so that the forces beyond it are
 * not active. */
void step_past_switch(struct run *run);

/* Apply the events at run->state: `timed` and `moving` flag the functions of each set that have crossed; NULL
 * for none. Settles the modes. */
void run_apply(struct run *run, const bool *timed, const bool *moving);

/* Let forces and couplings begin and end whose conditions are true at run->state, and settle the modes. */
void run_apply_endings(struct run *run);

/* Let the force or coupling of a watch begin or end; no effect if it has already. The modes are to be settled
 * (run->ended). The same for all watches whose conditions are true: whether the modes are to be settled (lifetime_events.c). */
void run_change_lifetime(struct run *run, int watch);
bool run_change_lifetimes(struct run *run);

/* At the end of a step, before watchers_arm: end the run where a condition that was exactly at its limit, and that no
 * watcher followed, has become true. */
void run_check_lifetimes(struct run *run);

/* Is it the begin or the end of a force or coupling? */
static inline bool watch_of_lifetime(const struct user_event *event)
{
    return event->lifetime > 0;
}

/* Log the user events that have crossed at t; false when one of them ends the run. */
bool log_user_events(struct run *run, double t);

/* Project the end of a step onto the couplings; before the first one, note the size of the mechanism. */
void project_step(struct run *run);
void projection_begin(struct run *run);

/* Joint friction that slips although the couplings prevent motion: set its speed relative to its surface to
 * zero. */
void rest_held(struct run *run);

/* Check that the forces of the diagrams balance the accelerations. */
void run_check_balance(struct run *run);

/* Where a taut rope leaves a pulley within the step that ends at *t, cut the step there and end the run. */
void run_watch_pulleys(struct run *run, struct time_dd *t);

/* Where both pieces of a rope at a pulley have become taut while the rope is off the pulley, end the run.
 * After events: `during` is free. */
void run_check_pulleys(struct run *run);

/* A point off its slot, in the air: where it passes an end of the slot within the last step, cut the step
 * there, before events are searched. Fails the run where the point returns behind the slot. */
void run_watch_slots(struct run *run, struct time_dd *t);

/* The end of the first part of (from, to] of the step in which such points stay far from their slots and
 * slack ropes from their full length, or move little. */
double run_flights(struct run *run, double from, double to);

/* Where a coupling reaches a limit within the step that ends at *t (a rope is unwound, a point is at the end
 * of its slot), cut the step there and end the run (coupling_limits.c). */
void run_watch_ends(struct run *run, struct time_dd *t);

/* Where a rope has become taut that is longer than its wound length allows, end the run. After events:
 * `during` is free. */
void run_check_ends(struct run *run);

/* Close slack ropes that are taut to rounding, so that they take part in the impact of another rope: two
 * ropes with alternating plastic impacts come to that within a few events, and then have one impact. Likewise
 * ropes at full length on colliding bodies. Returns whether there were any. Links and rows are those of the
 * state. */
bool close_taut_ropes(struct run *run);

/* Has the projection moved the end of the step (run->work.y) so far that its method has to restart? */
bool projection_has_failed(struct run *run);

/* Set the coordinates of drives, and of sticking friction, to their values at time t in the modes of the
 * step. */
void impose_drives(const struct run *run, double t, double *y);

/* Project y[2n] at a time within the last step onto the couplings. */
void project_within(struct run *run, double t, double *y);

/* Apply user events whose function is exactly zero at run->state (a body came to rest there, or the run ends
 * there); a zero within the band (watchers.h) counts only at an event, which may have stopped the body. */
void run_apply_touched(struct run *run, bool at_event);

/* Append an entry to the log; NULL when memory is out. */
struct run_event *log_event(struct run *run, fbd_event_kind kind, int body, int load, int watch);

/* After the modes have settled: log their changes; the events of this instant start at index `first`. */
void log_mode_changes(struct run *run, size_t first, const bool *moving);

/* Log that the motion is not unique, where the last settling of the modes has found that. */
void log_several(struct run *run);

/* Log the lift-off of a body from its line (a rolling wheel, a cam follower) at the start. */
void log_lifts_at_start(struct run *run);

/* The interval that counts as zero, relative to elapsed time and step sizes, not to the end of the run, which
 * may be very far away. */
double run_instant(const struct run *run);

/* Log an event of a friction pair, with its force and limit. */
void log_friction(struct run *run, fbd_event_kind kind, int pair);

/* Set an entry of the log to a Filippov sliding mode on a switch, with the value of its force. */
void log_set_filippov(const struct run *run, const struct kink *kink, fbd_event_kind kind,
                      struct run_event *event);

/* Log the begin or the end of a Filippov sliding mode on a switch, with the value of its force. */
void log_filippov(struct run *run, const struct kink *kink, fbd_event_kind kind);

/* Check the normal forces at run->state; end the run when one is negative, or about to be: `moving` flags the
 * crossed watchers, or is NULL. */
void run_check_contacts(struct run *run, const bool *moving);

/* Pass to the error control: floors for components that are exactly zero, and the round-off level of the
 * accelerations at run->state, from rounding of the summed forces and of the time. */
void roundoff_estimate(struct run *run);

/* After a step without an event: update the round-off level of the accelerations from time to time, as joint
 * forces change with the motion. */
void roundoff_renew(struct run *run);

/* Number of doubles that run->roundoff requires, and setting it up in `memory`. */
size_t roundoff_size(const struct fbd_model *model);
void roundoff_init(struct run *run, double *memory);

/* Number of steps until the update of round-off levels is due. */
unsigned long roundoff_steps(const struct run *run);

/* The time for messages: 0 where it is negligible compared with the first step. */
double run_time(const struct run *run);

/* End the run where it gains too little time per work. (progress.c) */
void run_check_progress(struct run *run);

/* End the run with a reason. */
void run_fail_step(struct run *run, enum stepper_status status);
void run_fail_pole(struct run *run, const struct pole *pole);
void run_fail_chatter(struct run *run);
void run_fail_unsettled(struct run *run);
/* `load` is the load called `name`, or -1: a user event, or an expression in one; `state`: in a user state. */
void run_fail_chatter_of(struct run *run, int load, bool state, const char *name);
void run_fail_progress(struct run *run, double gain);
/* Name of the load or user state of a switch; NULL for a user event. */
const char *run_kink_name(const struct run *run, const struct kink *kink);

void run_fail(struct run *run, fbd_outcome outcome, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Has a velocity on a plane only turned (plane_stop.c)? Else its point stops, and others of its body with it. */
bool plane_only_turns(struct run *run, int pair);
void plane_stop_with(struct run *run, int pair);
void plane_drop_rounding(struct run *run, int pair);
bool planes_stop_slow(struct run *run);

#endif
