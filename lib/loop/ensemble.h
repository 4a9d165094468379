/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ensemble: the islands of a scene, each integrated by a run of its own, seen as one run of the whole.
 *
 * Every island has its own stepper, step size, modes and event functions, and restarts at its own events
 * only. So a thousand bodies with one stiff one cost the sum of their costs, and not the steps of the
 * stiffest times the number of bodies. A scene whose bodies are all coupled is an ensemble of one.
 *
 * There are two ways to advance the common time t:
 *
 *     ensemble_advance   the island that is furthest behind makes a step, and t becomes the least of the ends of
 *                        all last steps, or an event to log before it. The last step of every island then
 *                        covers [from, t], so the state is available anywhere in it.
 *
 *     ensemble_go        t goes to a given time, by any number of steps; the state is available at t only. An
 *                        island without event functions makes all its steps at once, which keeps its
 *                        memory in the processor's caches.
 *
 * Both give the same trajectory bit for bit: a step of an island depends on nothing outside it. A simulation
 * uses one of them.
 *
 * When the run ends early at t, by an event or a failure in one island, the state of the others at t is
 * needed, too. An island without events that ensemble_go has advanced beyond t is integrated again up to t.
 *
 * A run takes some 20 kB for one body. Where states before the end are not asked for (options.ends_only), ensemble_go
 * advances each island of a scene with many, if it has neither events nor couplings and few steps, from the start to the
 * end at once, and frees its run; its coordinates at the end are those of ensemble->state.
 */
#ifndef FBD_LOOP_ENSEMBLE_H
#define FBD_LOOP_ENSEMBLE_H

#include "loop/islands.h"
#include "loop/run.h"

struct group {
    const struct selection *selection; /* NULL: the whole scene */
    struct arena memory;               /* of the run, the probe and the owned model */
    const struct fbd_model *model;     /* that of the whole scene, or `owned` */
    struct fbd_model *owned;
    struct run *run;         /* NULL: freed, see ensemble_free_run */
    struct fbd_state *probe; /* NULL until it is needed */
    struct run_totals past;  /* of a run that is freed */
    bool quiet;              /* without event functions */
    size_t released;         /* events of run->log copied to the ensemble */
};

struct ensemble;

/* Called after every step of every island. */
struct observer {
    void *context;
    bool (*step)(void *context, struct ensemble *ensemble, size_t group); /* false ends the run */
    void (*restart)(void *context, struct ensemble *ensemble,
                    size_t group); /* the island restarts at t = 0 */
};

struct ensemble {
    const struct fbd_model *model;
    struct run_options options;
    struct islands division;
    struct arena memory; /* of the arrays and the state of the whole */
    size_t count;
    struct group *groups;
    size_t *queue; /* heap of islands by the ends of their last steps */
    size_t queued;
    bool started;     /* the queue is filled */
    bool cut;         /* an interruption is requested */
    bool stepping;    /* an island is making a step */
    double from, t;   /* see above; with ensemble_go from == t */
    double next_told; /* with ensemble_advance: the first event to log within the last step of an island */
    double calm;      /* before this time no island steps, logs an event or ends */
    fbd_outcome outcome;
    const char *reason; /* "" without a failure */
    char own_reason[reason_size];
    const struct run *refused; /* an island whose start is refused, or NULL */
    struct observer observer;

    struct run_event
        *events; /* up to t, of all islands in the order of time, with indices of the whole scene */
    size_t event_count, event_room;
    struct fbd_state *state; /* of the whole, see ensemble_state */
    bool current;
    size_t *due; /* scratch: islands at t */
};

/* A run of the model at its start, divided into islands if options->structure. NULL when memory is out. */
struct ensemble *ensemble_new(const struct fbd_model *model, const struct run_options *options);
void ensemble_free(struct ensemble *ensemble);

/* Advance as described above, at most to the end of the run. With `pause` ensemble_go stops before `target`
 * at an event, also at one beyond it by at most `near`. */
fbd_outcome ensemble_advance(struct ensemble *ensemble);
fbd_outcome ensemble_go(struct ensemble *ensemble, double target, double near, bool pause);

/* End it as interrupted: now, or from an observer, as soon as the states of all islands are available at one
 * time. */
void ensemble_interrupt(struct ensemble *ensemble);

/* For ensemble_go: a target above ensemble->t, and at most the end of a step of any island. */
double ensemble_next_end(const struct ensemble *ensemble);

/* Have all islands made a step that reaches t? */
bool ensemble_has_reached(const struct ensemble *ensemble, double t);

/* The evaluated state at t, from <= t <= ensemble->t, with the modes of the steps around it; at an event with
 * those after it. False when it is not available. */
bool ensemble_look(struct ensemble *ensemble, double t, struct fbd_state *state);

/* Coordinates and rates of one island at t, within its last step, stored among those of the whole. False when
 * they are not available. */
bool ensemble_group_coordinates(struct ensemble *ensemble, size_t group, struct time_dd t, double *y);

/* The same, but at an event with the modes before it. */
bool ensemble_look_before(struct ensemble *ensemble, double t, struct fbd_state *state);

/* Only coordinates and rates at t, 2 n, from the dense output alone. */
bool ensemble_coordinates(struct ensemble *ensemble, double t, double *y);

/* Apply the jump of the events at the end of an island's last step, and its modes after them, to a state of
 * the whole before them; not evaluated. */
void ensemble_pass_on(const struct ensemble *ensemble, size_t index, struct fbd_state *state);

/* Index in the whole (n coordinates, then n rates) of component `i` of an island. */
size_t group_component(const struct fbd_model *whole, const struct group *group, size_t i);

/* Fail when the forces at ensemble->t do not balance the accelerations (balance.h). */
void ensemble_check_balance(struct ensemble *ensemble);

/* The state at ensemble->t; valid until the ensemble advances. Placed, by ensemble_go with its runs kept, it has its
 * coordinates, rates and user states alone: accelerations and forces are those of another time. */
const struct fbd_state *ensemble_placed(struct ensemble *ensemble);
struct fbd_state *ensemble_state(struct ensemble *ensemble);

/* The state of island `index` at t, within its last step or at the end of it, as by ensemble_look, in its own
 * coordinates: its probe, or NULL. Without `forces` only coordinates and rates are set. */
struct fbd_state *ensemble_look_group(struct ensemble *ensemble, size_t index, struct time_dd t, bool forces);

/* The probe of an island, for states within its steps; made at its first use. NULL when memory is out. */
struct fbd_state *ensemble_probe(struct ensemble *ensemble, struct group *group);

/* Index in the whole scene of load `index` of an island; -1 for -1. */
int group_load(const struct group *group, int index);

/* Number of its loads. */
static inline size_t group_load_count(const struct fbd_model *whole, const struct group *group)
{
    return group->selection ? group->selection->load_count : whole->load_count;
}

/* The time that an island has reached, and the cost of its run. */
static inline double group_end(const struct group *group)
{
    return group->run ? group->run->state->t : group->past.t;
}

static inline struct run_totals group_totals(const struct group *group)
{
    return group->run ? run_totals(group->run) : group->past;
}

/* ---- internal to the ensemble */

/* Copy the events up to ensemble->t of the islands due[0 .. count - 1] to the ensemble. */
void ensemble_release(struct ensemble *ensemble, size_t count);

/* Make the run of an island, once more if it has one. False when memory is out. */
bool ensemble_make_run(struct ensemble *ensemble, struct group *group);

/* Are runs freed at their ends? The memory of few islands does not matter. */
static inline bool ensemble_frees_runs(const struct ensemble *ensemble)
{
    enum { few = 256 };
    return ensemble->options.ends_only && ensemble->count > few;
}

/* Free the run of an island if it may be: at the start or the end of a run whose other states are not asked for. */
void ensemble_free_run(struct ensemble *ensemble, struct group *group);

/* Integrate the islands that are beyond t again, up to t. */
void ensemble_rewind(struct ensemble *ensemble, double t);

void ensemble_fail(struct ensemble *ensemble, fbd_outcome outcome, const char *reason);

/* End with failure, even after the end, when a later check shows the results to be wrong. */
void ensemble_spoil(struct ensemble *ensemble, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
