/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * State: the time, coordinates, rates and modes of one run, with the scratch that dynamics needs. One
 * allocation.
 */
#ifndef FBD_DYNAMICS_STATE_H
#define FBD_DYNAMICS_STATE_H

#include "base/arena.h"
#include "dynamics/forward.h"
#include "dynamics/sliding.h"
#include "holds/holds.h"

#include <string.h>

/* Why the modes of unilateral constraints could not be decided, or that they are not unique: `pair` is a
 * friction whose normal force depends on it, by `answer` N for 1 N of friction; -1 without one. */
struct holds_trouble {
    enum holds_found found;
    int pair;
    double answer;
    int contradicts; /* the constraint whose solved mode contradicts the resulting forces; or -1 */
};

struct fbd_state {
    const struct fbd_model *model;
    bool settled;               /* the modes agree with t and y */
    bool in_arena;              /* its memory is that of an arena */
    bool degrees;               /* messages show its angles in degrees (output/display_units.h) */
    struct holds_trouble holds; /* of the last settling */
    double t, rest;             /* the time as a double-double: see base/time_dd.h */
    double *y;     /* plan_size: coordinates, rates, user states; then world_refs.h, by state_evaluate */
    double *a;     /* plan_rates: accelerations, then the rates of user states, by state_evaluate */
    double *slots; /* plan.slots: generalized forces, by state_evaluate */
    double *held;  /* values of inputs, by parameter, see instant.h; copied with y, a and slots */
    int *branch, *slip, *pull;                    /* modes, see instant.h */
    int *branch_before;                           /* scratch for settling: plan.branches */
    int *slip_before, *slip_forced, *slip_barely; /* and plan.mode_count each */
    int *slip_idle;          /* and: the side on which friction slips that is zero in all of its modes */
    int *slip_rests;         /* and: friction that was at rest when settling began */
    int *slip_driven;        /* and: the side on which drives make it slip, 0 if forces decide */
    double *scratch;         /* see struct scratch */
    struct arrow *arrows;    /* scratch: the diagram of one body */
    double *extended;        /* scratch of world_refs.h */
    struct sliding *sliding; /* NULL if no switch can have a sliding mode */
    struct tree_work *tree;  /* of the bodies, by state_evaluate */
    struct arena kept;       /* memory of looks at redundant forces, for the next one (state_lend) */
};

/* Parts of the scratch of a state: none of them outlives a call. */
struct scratch {
    double *slots, *slots_along; /* plan.slots each: sums of terms, and their variation */
    double *dy;                  /* plan_size: a direction */
    double *column;              /* plan_rates: variation of the rates along it */
};

static inline const struct mode *mode_of(const struct fbd_state *state, int pair)
{
    return &state->model->plan.modes[pair];
}

static inline struct scratch scratch_of(const struct plan *plan, double *memory)
{
    double *slots_along = memory + plan->slots, *dy = slots_along + plan->slots;
    return (struct scratch){memory, slots_along, dy, dy + plan_size(plan)};
}

static inline struct scratch state_scratch(const struct fbd_state *state)
{
    return scratch_of(&state->model->plan, state->scratch);
}

/* The direction of motion of an evaluated state, (1, v, a, z'), written to dy. */
static inline struct direction state_flow(const struct fbd_state *state, double *dy)
{
    const struct plan *plan = &state->model->plan;
    size_t n = (size_t)plan->n;
    memcpy(dy, state->y + n, n * sizeof *dy);
    memcpy(dy + n, state->a, plan_rates(plan) * sizeof *dy);
    return (struct direction){.dt = 1, .dy = dy};
}

/* A state of zeros, without modes, for the functions that make states: in an arena, or NULL for a block of its own. NULL
 * when memory is out. */
struct fbd_state *state_allocate(const struct fbd_model *model, struct arena *memory);

/* Initial values for the continuation of a motion: a time, the plan_size numbers of y, the branches of
 * switches with memory, and the references of couplings from their start, for example the length of a rope. */
struct state_start {
    double t;
    const double *y;
    const int *branch;
    const struct fbd_state
        *couplings; /* a state of this scene, or of one whose couplings and inputs include those of it */
};

/* A state with these initial values, whose sticking, taut and closed modes follow from it as at the start; NULL: at those
 * of the scene, t = 0, modes not yet settled. NULL when memory is out. */
struct fbd_state *state_make(const struct fbd_model *model, const struct state_start *start,
                             struct arena *memory);

static inline struct fbd_state *state_new(const struct fbd_model *model)
{
    return state_make(model, NULL, NULL);
}

/* Lend the kept memory, empty; state_take_back returns it, and notes if it was short. */
struct arena state_lend(struct fbd_state *state);
void state_take_back(struct fbd_state *state, struct arena *arena);

/* Free a state; of one in an arena, its memory outside of it. */
void state_free(struct fbd_state *state);

/* Set in `to` which loads and constraints are there as in `from`; both are of the same scene, or of islands of it. */
void state_copy_lives(struct fbd_state *to, const struct fbd_state *from);

/* Let all forces and moments of the file act, also those that begin later. */
void state_let_forces_act(struct fbd_state *state);

/* Make `to` equal to `from`; both belong to the same model. */
void state_copy(struct fbd_state *to, const struct fbd_state *from);

/* Set rates to zero that in a run to the time `until` change the coordinates of their kind by less than a rounding, so
 * that bodies at rest stay there. */
void state_still(struct fbd_state *state, double until);

/* The switches in a sliding mode, or NULL. */
static inline struct sliding *state_sliding(const struct fbd_state *state)
{
    return state->sliding && state->sliding->count > 0 ? state->sliding : NULL;
}

/* In the modes of a state, at any other point. */
static inline struct instant state_instant_at(const struct fbd_state *state, double t, const double *y)
{
    return (struct instant){t,           y,           state->branch,   state->slip,
                            state->pull, state->tree, state->extended, state_sliding(state),
                            false,       state->held};
}

static inline struct time_dd state_moment(const struct fbd_state *state)
{
    return (struct time_dd){state->t, state->rest};
}

static inline void state_set_moment(struct fbd_state *state, struct time_dd t)
{
    state->t = t.t;
    state->rest = t.rest;
}

static inline struct instant state_instant(const struct fbd_state *state)
{
    return state_instant_at(state, state->t, state->y);
}

/* Compute accelerations and slots at the state, in its modes. Indeterminate reactions are chosen within
 * limits (rest_system.h). */
void state_evaluate(struct fbd_state *state);

/* The same with any solution for indeterminate reactions, if no force is read. */
void state_evaluate_unshared(struct fbd_state *state);

/* Right after state_evaluate: force_balance_of body b with the chosen reactions. */
void state_balance_of(struct fbd_state *state, int b, double *slots);

#endif
