/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Run: the loop that carries a scene through time.
 *
 * One turn of the loop: find the next event of time alone, with proof and however many periods ahead; make
 * one accepted step, at most to there; look on the step's dense output for the first other event: all zeros
 * of its function are found, by enclosures where it has some (watchers_can_enclose), else by its Chebyshev
 * series (series.h says what that assumes); if there is one, go back to it by a partial step and polish its
 * time by Newton; apply all events of that instant; settle the modes; start the stepper anew. Between events
 * everything is smooth, so every method keeps its order.
 *
 * Searches run over doubles. A root is refined to a time_dd (base/time_dd.h) where it is applied:
 * within a rounding of the time every function is linear, so that its value and rate at a double next to the
 * event tell the rest.
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
#include "loop/zeno_switch.h"

struct run_options {
    double until;
    double tolerance;
    double step; /* fixed size, or 0 */
    const struct method *method;
    bool automatic;                /* switch to the stiff method and back as the motion demands */
    bool structure;                /* exploit the structure of the plan (structure.h) */
    bool apart;                    /* of a companion: where events set steps, they differ */
    const struct fbd_state *start; /* where it begins, a state of the whole; NULL for the start of the file */
};

struct run_event {
    double t;
    fbd_event_kind kind;
    int body, load, watch; /* -1 where it does not apply */
    int own;               /* a switch in the rate of this state, or -1 */
    int branch;            /* of a switch */
    size_t group, order;   /* of an ensemble, and its place in the log of that group */
    double force, limit;   /* friction: after the event; static limit. Contact: N; its rounding */
    struct impact_record impact;
};

/* The most that the rows of couplings have been off by at the end of a step: before it was brought back onto
 * them, and after. */
struct drift {
    double position, velocity, left_position, left_velocity;
    double reach, speed; /* the largest of the links so far: what that is measured against */
    const char *worst;   /* the row that was off the most in position; NULL without steps */
};

enum { reason_size = 400 };

/* The last step, and what the next one is to be. */
struct stride {
    double from, from_rest;   /* where it began; it ends at state->t and its rest */
    double h;                 /* step size proposed */
    double first;             /* the first one that was */
    double longest;           /* to an event so far */
    double most;              /* that the next ones may be; 0: as long as they like. Of one that is apart */
    bool restart;             /* the stepper has to start anew */
    int crawl;                /* steps in a row of a few roundings of the time */
    unsigned long not_finite; /* rejections for that reason before the last step */
};

/* The time gained by the run for its work: see progress.c. */
struct progress {
    double start;   /* the time at which the run began */
    double t, work; /* at the last check */
    unsigned long accepted, rejected;
};

/* How it stands or has ended. */
struct ending {
    fbd_outcome outcome;
    char reason[reason_size];
    const char *refusal; /* of a start: id of the reason (start.h), and position; or NULL */
    struct pos refusal_at;
};

/* A rope that has just got taut. */
struct snap {
    int pair;    /* or -1 */
    double work; /* what that has taken (below zero) */
};

/* What events are looked for with, beside the watchers. */
struct event_search {
    struct scan timed, moving;
    bool *reads;                 /* for each group of moving functions: the components that it reads */
    bool *wanted;                /* those of the groups that are searched at present */
    bool paced, paced_by_motion; /* sampled functions may change as fast as formulas do, of the motion too */
    bool follows_places;         /* the course has places in the world */
    bool leads;                  /* there are drives or surfaces that may lead (impose_drives) */
    bool leads_speeds;           /* drives say what their speeds are, too: guides turn by them */
    bool wakes; /* there are levels of what wakes up with the motion (expr_switch_is_silent) */
};

/* Round-off levels of accelerations: see roundoff.c. */
struct roundoff {
    double *accelerations;      /* plan_rates: what they, and rates of states, are known to */
    double *largest;            /* plan_rates: the largest for which that has been found */
    bool heeds_time;            /* a force, or the rate of a state, names the time */
    double *along;              /* plan_rates: rates of change along the motion at the last update */
    double *turned;             /* three times the links of the tree */
    double *cancelled;          /* for each body a force and its moment */
    double *formulas;           /* n: what rounding within formulas does to accelerations */
    double *nothing;            /* plan_size: what has been nothing beside the largest motion, at a start */
    unsigned long since, pause; /* steps; and how many may pass while it counts but hardly changes */
};

/* Scratch of the loop: plan_size numbers each, where nothing else is said. */
struct run_work {
    double *y, *f; /* the end of the last step, before its events */
    double *sample;
    double *aside;        /* 2 plan_size: a sample made in another way */
    double *values;       /* event functions of a set, their rates, the roundings of timed ones */
    double *kept;         /* 2 plan_size: y and f while user events are looked for */
    bool *crossed;        /* of the moving event functions: likewise */
    struct arrow *arrows; /* of one body */
};

struct event_log {
    struct run_event *events;
    size_t count, room;
};

/* Events that crowd at one instant, and those that happen around one state again and again. */
struct recent {
    double time;      /* of the last one */
    int crowd, turns; /* how many at that instant; how often normal forces have changed their sides there */
    struct time_dd moment; /* the start, or when events happened last */
    double interval[2];    /* between the last three of these; infinite before there are three */
    double *anchor; /* 2 plan_size: the state around which the last events happened; the largest |y_i| */
    int around;     /* how many */
};

struct run {
    struct arena memory; /* of what is made once for all of the run */
    const struct fbd_model *model;
    struct run_options options;
    enum structure kind;      /* in use: general unless options.structure and options.automatic */
    struct fbd_state *state;  /* at the end of the last step, modes for what follows */
    struct fbd_state *during; /* modes of the last step; its scratch serves samples within it */
    struct stride step;
    struct progress progress;
    struct ending end;
    bool lazy;        /* no step asks for the forces of `state` at its end */
    bool plain;       /* nor can anything cut a step or bring it back: no events and couplings */
    bool undisturbed; /* nor cut it: no events, and couplings that have no end */
    bool stale;       /* they have not been found for its time */

    struct counted_system system;
    struct rates *rates; /* in the modes of `during` */
    struct switcher *stepper;
    struct linear_pace pace; /* of a linear system */
    struct roundoff roundoff;
    struct drift drift; /* from the constraints */
    bool projected;

    struct watchers watchers;
    struct event_search search;
    struct trajectory trajectory; /* of what moving functions with enclosures read */
    struct poles poles;
    struct coupled_scales mechanisms;
    struct zeno_switches zeno_switches;

    struct decided decided;
    struct contacts_work contacts;
    struct snap snap;
    double *impact_work; /* per load: what impacts have done in all */
    struct energy_guard energy;
    double liveliest; /* the most kinetic energy of jointed bodies so far */
    struct event_log log;
    struct recent recent;
    struct run_work work;
};

/* A run at the start of the model, modes settled, events of t = 0 applied. NULL when memory is out. */
struct run *run_new(const struct fbd_model *model, const struct run_options *options,
                    const struct state_start *begin);
void run_free(struct run *run);

/* Forces and accelerations of run->state, where they are stale. */
void run_evaluate(struct run *run);

/* One turn of the loop. */
fbd_outcome run_advance(struct run *run);

/* The state at t in [from, state->t] of the last step, with the modes of that step; evaluated (accelerations
 * are there). */
bool run_look(struct run *run, struct time_dd t, struct fbd_state *state);

/* Only coordinates, rates and states there, plan_size, without evaluating anything but the dense output. */
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

/* Into how many panels the last step is to be divided for Gauss's rule with five points, so that the error of
 * an integral of powers is below that of the motion. For linear systems: half a radian or a fall by 1/sqrt(e)
 * of the fastest mode each (4e-13, Abramowitz & Stegun 25.4.30). */
int run_panels(const struct run *run);

/* ---- for the files of the loop */

/* Event functions and their scans (run_watch.c). False when memory is out. */
bool run_make_scans(struct run *run);

/* The moment of the timed events that the scan has found, those that happen at it flagged in
 * run->search.timed.crossed. (run_time.c) */
struct time_dd run_pin_timed(struct run *run);

/* How long it is to the next event of time alone, or to the end of the run. */
double run_time_to_switch(struct run *run);

/* Bring y with slopes f from the double t to the moment of an event that is `move` away, a few roundings at
 * most; nothing happens where that is not within the step that ends at `end`. */
struct time_dd run_pin_moving(struct run *run, double t, double move, struct time_dd end);

/* What options.apart asks for: see run_time.c. Before a limit is known, and when it is. */
void desync_steps(struct run *run);
void desync_steps_from(struct run *run, struct time_dd limit);

/* Has the step that has been made to `end` an inside that does not obey the equations? (defect_control.c) */
bool defect_is_large(struct run *run, struct time_dd end);

/* The first event in the step that has been made to *t, which becomes its time, with y and f there; where the step has
 * passed a pole it is cut before that. 1 found, 0 none, -1 failed. (run_find.c) */
int run_find_event(struct run *run, struct time_dd *t);

/* Where steps fail: is the state on the brink of switches, by a rounding of the time, as the roots and powers of max(x, 0) or
 * abs(x) do not let a step look beyond? Then it is put behind them, by as little, and they are the moving functions that have
 * crossed. (run_find.c) */
bool run_pass_brink(struct run *run);

/* The same after events that have been found, where the forces beyond are not there for the rounding by which the state is
 * before them. */
void step_past_switch(struct run *run);

/* Apply what has happened at run->state: `timed` and `moving` flag the functions of each set that have
 * crossed; NULL for none. Settles the modes. */
void run_apply(struct run *run, const bool *timed, const bool *moving);

/* Log the user events that have crossed at t; false when one of them ends the run. */
bool log_user_events(struct run *run, double t);

/* Bring the end of a step back onto the couplings. */
void project_step(struct run *run);

/* Friction of joints that slips where couplings do not let it: its speed against its surface is zero. */
void rest_held(struct run *run);

/* The forces of the diagrams have to account for the motion. */
void run_check_balance(struct run *run);

/* Where a taut rope comes off a pulley within the step that ends at *t, cut the step there and end the run.
 */
void run_watch_pulleys(struct run *run, struct time_dd *t);

/* Where both pieces of a rope at a pulley have got taut and it is off it, end the run. After events: `during`
 * is free. */
void run_check_pulleys(struct run *run);

/* A point that is off its slot, in the air: where it passes an end of the slot within the last step this is cut there, before
 * events are looked for. Fails the run where it comes back behind the slot. */
void run_watch_slots(struct run *run, struct time_dd *t);

/* The end of the first stretch of (from, to] of the step in which such points stay far from their slots and slack ropes from
 * being taut, or do not go far. */
double run_flights(struct run *run, double from, double to);

/* Where a coupling has come to an end within the step that ends at *t (a rope is unwound, a point is at the end of its
 * slot), cut the step there and end the run (coupling_limits.c). */
void run_watch_ends(struct run *run, struct time_dd *t);

/* Where a rope has got taut that is longer than what was wound allows, end the run. After events: `during` is
 * free. */
void run_check_ends(struct run *run);

/* Slack ropes that are taut but for rounding become so, and take part in the impact of another: two that
 * strike each other taut in turn, a plastic impact each, come to that within a few events, and there they are
 * one impact. So do those at their full length in what strikes their bodies. Whether there were any. Links and rows are
 * those of the state. */
bool close_taut_ropes(struct run *run);

/* Has the step that ends at run->work.y been brought back so far that its method has to start anew? */
bool projection_has_failed(struct run *run);

/* Put drives, and what sticks, where they are at time t in the modes of the step. */
void impose_drives(const struct run *run, double t, double *y);

/* Bring y[2n] at a time within the last step back to the couplings. */
void project_within(struct run *run, double t, double *y);

/* User events whose function is exactly zero at run->state (a body came to rest there, or the run ends there)
 * happen now; within its band (watchers.h) a zero counts at an event only, which may be what stopped the
 * body. */
void run_apply_touched(struct run *run, bool at_event);

/* An entry of the log; NULL when memory is out. */
struct run_event *log_event(struct run *run, fbd_event_kind kind, int body, int load, int watch);

/* After the modes have settled: log what they tell; the events of this instant are those from `first` on. */
void log_mode_changes(struct run *run, size_t first, const bool *moving);

/* Note that several motions agree with the forces, where the last settling has found that. */
void log_several(struct run *run);

/* Note the lift-off of a body on its line at the start (a rolling wheel, a cam follower) that is lifted at once. */
void log_lifts_at_start(struct run *run);

/* What counts as no time: against the time that has passed and steps of this run, for its end may be very far away. */
double run_instant(const struct run *run);

/* Log what a friction pair does, with its force and limit. */
void log_friction(struct run *run, fbd_event_kind kind, int pair);

/* Log that the motion slides on a switch, or no longer, with the value that its force takes. */
void log_filippov(struct run *run, const struct kink *kink, fbd_event_kind kind);

/* Check normal forces at run->state; ends the run when one is negative, or about to be: `moving` are the watchers that
 * have crossed, or NULL. */
void run_check_contacts(struct run *run, const bool *moving);

/* Tell the error control what it cannot know: floors for what is exactly zero, and how well the accelerations
 * at run->state are known: to rounding of the forces that are summed up, and of the time at which they are
 * taken. */
void roundoff_estimate(struct run *run);

/* After a step without an event: from time to time how well the accelerations are known now, as the forces in
 * joints change with the motion. */
void roundoff_renew(struct run *run);

/* What run->roundoff asks for, and how it is put there: numbers. */
size_t roundoff_size(const struct fbd_model *model);
void roundoff_init(struct run *run, double *memory);

/* How many steps may be made before that has to be looked at for their number alone. */
unsigned long roundoff_steps(const struct run *run);

/* The time for messages: 0 where it is negligible compared with the first step. */
double run_time(const struct run *run);

/* End the run where it gains no time for its work. (progress.c) */
void run_check_progress(struct run *run);

/* End the run with a reason. */
void run_fail_step(struct run *run, enum stepper_status status);
void run_fail_pole(struct run *run, const struct pole *pole);
void run_fail_chatter(struct run *run);
void run_fail_progress(struct run *run, double gain);
/* What a switch belongs to: a load or a state; NULL for an event of the user. */
const char *run_kink_name(const struct run *run, const struct kink *kink);

void run_fail(struct run *run, fbd_outcome outcome, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
