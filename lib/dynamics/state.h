/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * State: the time, coordinates, rates and modes of one run, with the scratch that dynamics needs. One
 * allocation.
 */
#ifndef FBD_DYNAMICS_STATE_H
#define FBD_DYNAMICS_STATE_H

#include "dynamics/forward.h"
#include "dynamics/sliding.h"
#include "holds/holds.h"

#include <string.h>

/* Why holds could not be decided, or that they could be in several ways: `pair` is a friction whose normal
 * force answers to it, 1 N of it with `answer` N more of what presses; -1 when that is not it. */
struct holds_trouble {
    enum holds_found found;
    int pair;
    double answer;
    int contradicts; /* what neither holds nor gives as was decided, by the forces that follow; or -1 */
};

struct fbd_state {
    const struct fbd_model *model;
    bool settled;               /* the modes agree with t and y */
    bool degrees;               /* texts of it show angles in degrees (output/display_units.h) */
    struct holds_trouble holds; /* of the last settling */
    double t, rest;             /* the time, and what its rounding leaves: see base/time_dd.h */
    double *y;     /* plan_size: coordinates, rates, states of the file's own; then what world_refs.h adds, by
                      state_evaluate */
    double *a;     /* plan_rates: accelerations, then the rates of those states, by state_evaluate */
    double *slots; /* plan.slots: generalized forces, by state_evaluate */
    int *branch, *slip, *pull;                    /* modes, see instant.h */
    int *branch_before;                           /* scratch for settling: plan.branches */
    int *slip_before, *slip_forced, *slip_barely; /* and plan.mode_count each */
    int *slip_idle;          /* and: the side on which friction slips that has no force in any of its modes */
    int *slip_rests;         /* and: friction that was at rest when the settling of a run began */
    int *slip_driven;        /* and: the side on which drives alone make it slip, 0 where forces do */
    double *scratch;         /* see struct scratch */
    double *extended;        /* scratch of world_refs.h */
    struct sliding *sliding; /* NULL when no switch can be slid on */
    struct tree_work *tree;  /* of the jointed bodies, by state_evaluate; NULL when there are none */
};

/* What the scratch of a state is for, whoever uses it: nothing in it outlives a call. */
struct scratch {
    double *slots, *slots_along; /* plan.slots each: sums of terms, and their variation */
    double *dy;                  /* plan_size: a direction */
    double *column;              /* plan_rates: how rates of change vary along it */
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

/* The direction in which an evaluated state goes on, (1, v, a, z'), written to dy. */
static inline struct direction state_flow(const struct fbd_state *state, double *dy)
{
    const struct plan *plan = &state->model->plan;
    size_t n = (size_t)plan->n;
    memcpy(dy, state->y + n, n * sizeof *dy);
    memcpy(dy + n, state->a, plan_rates(plan) * sizeof *dy);
    return (struct direction){1, dy};
}

/* A state at the scene's initial values, t = 0, modes not yet settled. NULL when memory is out. */
struct fbd_state *state_new(const struct fbd_model *model);

/* What a motion goes on from: a time, the plan_size numbers of y, the branches of what remembers them, and what
 * the couplings keep of their start, for example the length of a rope. */
struct state_start {
    double t;
    const double *y;
    const int *branch;
    const struct fbd_state
        *couplings; /* a state of this scene, or of one that has its couplings and others */
};

/* The same from there: what sticks, is taut or touches follows from it as it does at the start. */
struct fbd_state *state_new_from(const struct fbd_model *model, const struct state_start *start);
void state_free(struct fbd_state *state);

/* Make `to` equal to `from`; both belong to the same model. */
void state_copy(struct fbd_state *to, const struct fbd_state *from);

/* Rates that move nothing are zero: in all of `duration` less than a rounding of the coordinates of their kind. What
 * has come to rest does not begin to move by them. */
void state_still(struct fbd_state *state, double duration);

/* The switches that it slides on, if there are any. */
static inline struct sliding *state_sliding(const struct fbd_state *state)
{
    return state->sliding && state->sliding->count > 0 ? state->sliding : NULL;
}

/* In the modes of a state, at any other point. */
static inline struct instant state_instant_at(const struct fbd_state *state, double t, const double *y)
{
    return (struct instant){t,           y,           state->branch,   state->slip,
                            state->pull, state->tree, state->extended, state_sliding(state)};
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

/* Accelerations and slots at the state, modes as they are. What constraints leave open is shared within
 * limits (rest_system.h). */
void state_evaluate(struct fbd_state *state);

/* The same with what constraints leave open as it falls out: where no force is looked at. */
void state_evaluate_unshared(struct fbd_state *state);

/* Right after it, force_balance_of body b, with what is shared. */
void state_balance_of(struct fbd_state *state, int b, double *slots);

#endif
