/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ensemble: the independent groups of a scene, each carried by a run of its own, seen as one run of the
 * whole.
 *
 * Every group has its own stepper, step size, modes and event functions, and starts anew at its own events
 * only. So a thousand bodies with one stiff one cost the sum of their costs, and not the steps of the worst
 * one times the number of bodies. A scene whose bodies all hang together is an ensemble of one.
 *
 * There are two ways to move the common time t on:
 *
 *   ensemble_advance   the group that is furthest behind makes a step, and t becomes the least of the ends of
 *                      all last steps, or an event to tell before it. The last step of every group then
 *                      covers [from, t], so the state is to be had anywhere in it.
 *
 *   ensemble_go        t goes to a given time, by any number of steps; the state is to be had at t only. A
 *                      group in which nothing can happen (no event function at all) is carried there in one
 *                      go, which keeps its memory in the processor's caches.
 *
 * Both give the same trajectory bit for bit: a step of a group depends on nothing but the group. One
 * simulation uses one of them.
 *
 * When the run ends early at t, by an event or a failure in one group, the others are looked at there too.
 * One that has gone beyond, which ensemble_go allows to groups without events, is carried there again.
 */
#ifndef FBD_LOOP_ENSEMBLE_H
#define FBD_LOOP_ENSEMBLE_H

#include "loop/islands.h"
#include "loop/run.h"

struct group {
    const struct fbd_model *model; /* the whole scene's, or `owned` */
    struct fbd_model *owned;
    const struct selection *selection;
    struct run *run;
    struct fbd_state *probe;
    bool quiet;          /* no event can happen in it */
    size_t released;     /* of run->log.events: taken over by the ensemble */
    int *branch, *pairs; /* of its branches and friction pairs in the whole plan; NULL when it is the whole */
    int *loads;          /* of its loads in the whole model; NULL when it is the whole */
};

struct ensemble;

/* Told of every step of every group as soon as it is made. */
struct observer {
    void *context;
    bool (*step)(void *context, struct ensemble *ensemble, size_t group); /* false ends the run */
    void (*restart)(void *context, struct ensemble *ensemble,
                    size_t group); /* the group begins again at t = 0 */
};

struct ensemble {
    const struct fbd_model *model;
    struct run_options options;
    struct islands division;
    size_t count;
    struct group *groups;
    int *maps;     /* memory of the groups' maps */
    int *counts;   /* scratch of their making, in `maps` */
    size_t *queue; /* heap of groups by the ends of their last steps */
    size_t queued;
    bool lazy;        /* moved by ensemble_go: quiet groups are not queued */
    bool started;     /* the queue is there */
    bool cut;         /* it has been asked to end */
    bool stepping;    /* a group is making a step */
    double from, t;   /* see above; with ensemble_go from == t */
    double next_told; /* with ensemble_advance: the first event to tell that lies within the last step of a
                         group */
    double calm;      /* before this time no group steps, tells an event or ends: ensemble_go looks at none */
    fbd_outcome outcome;
    const char *reason; /* "" while all is well */
    char own_reason[reason_size];
    const struct run *refused; /* the one whose start is, and so the whole; or NULL */
    struct observer observer;

    struct run_event *events; /* up to t, of all groups in the order of time, indices of the whole scene */
    size_t event_count, event_room;
    struct fbd_state *state; /* of the whole, see ensemble_state */
    bool current;
    size_t *due;          /* scratch: groups at t */
    struct arrow *arrows; /* scratch: the most of a diagram */
};

/* A run of the model at its start, divided if options->structure. NULL when memory is out. */
struct ensemble *ensemble_new(const struct fbd_model *model, const struct run_options *options);
void ensemble_free(struct ensemble *ensemble);

/* Move on as said above, at most to the end of the run. ensemble_go stops before `target` at an event if
 * `pause`, also at one that lies beyond it by `near` at most. */
fbd_outcome ensemble_advance(struct ensemble *ensemble);
fbd_outcome ensemble_go(struct ensemble *ensemble, double target, double near, bool pause);

/* End it, as interrupted: now, or from an observer, as soon as all groups can be seen at one time. */
void ensemble_interrupt(struct ensemble *ensemble);

/* With ensemble_go: a target that is at most the end of a step of any group, and above ensemble->t. */
double ensemble_next_end(const struct ensemble *ensemble);

/* Have all groups made a step that reaches t? */
bool ensemble_has_reached(const struct ensemble *ensemble, double t);

/* The evaluated state at t, from <= t <= ensemble->t, with the modes of the steps around it, and those after
 * an event at its very time. False when it cannot be had. */
bool ensemble_look(struct ensemble *ensemble, double t, struct fbd_state *state);

/* Coordinates and rates of one group at t, within its last step, in their places among those of the whole. False when
 * they cannot be had. */
bool ensemble_group_coordinates(struct ensemble *ensemble, size_t group, struct time_dd t, double *y);

/* The same, but at the very time of an event with the modes before it. */
bool ensemble_look_before(struct ensemble *ensemble, double t, struct fbd_state *state);

/* Only coordinates and rates there, 2 n, without evaluating anything but the dense output. */
bool ensemble_coordinates(struct ensemble *ensemble, double t, double *y);

/* Put the jump of the events at the end of a group's last step, and its modes after them, into a state of the
 * whole that has not come to them; not evaluated. */
void ensemble_pass_on(const struct ensemble *ensemble, size_t index, struct fbd_state *state);

/* The component of the whole (n coordinates, then n rates) that is `i` in a group. */
size_t group_component(const struct fbd_model *whole, const struct group *group, size_t i);

/* End it as failed when the forces at ensemble->t do not account for the motion (balance.h). */
void ensemble_check_balance(struct ensemble *ensemble);

/* The state at ensemble->t; stays valid until the ensemble moves on. */
struct fbd_state *ensemble_state(struct ensemble *ensemble);

/* Group `index` at t, within its last step or at the end of it, as by ensemble_look, in its own coordinates:
 * its probe, or NULL. Without `forces` only its coordinates and rates are those at t. */
struct fbd_state *ensemble_look_group(struct ensemble *ensemble, size_t index, struct time_dd t, bool forces);

/* The body or load of the whole scene that is `index` in a group; -1 for -1. */
int group_body(const struct group *group, int index);
int group_load(const struct group *group, int index);

/* ---- for the files of the ensemble */

/* Take over the events up to ensemble->t of the groups listed in due[0 .. count - 1]. */
void ensemble_release(struct ensemble *ensemble, size_t count);

/* Make the run of a group. */
bool ensemble_make_run(struct ensemble *ensemble, struct group *group);

void ensemble_fail(struct ensemble *ensemble, fbd_outcome outcome, const char *reason);

/* End with failure, also where it had come to its end: what has been found makes it worthless. */
void ensemble_spoil(struct ensemble *ensemble, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
