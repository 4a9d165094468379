/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Modes: which branch every switch is on and what every friction pair does, decided at the start and after
 * each event.
 *
 * A decision needs the rates of change, which need the modes: so the choice is repeated until it does not
 * change. Where a switching function is not zero the first pass is final; the repetition serves those that
 * sit exactly at their threshold.
 */
#ifndef FBD_DYNAMICS_MODES_H
#define FBD_DYNAMICS_MODES_H

#include "dynamics/state.h"

/* What an event has decided already and must stay: flags for plan.branches, and for plan.mode_count
 * pairs. */
struct decided {
    bool *branches;
    bool *slips, *pulls;
    bool later; /* it is a moment later than what is asked about, see tree_settle_holds */
};

/* Settle all modes at the state; `decided` may be NULL. Relative velocities of pairs that stick are set to
 * exactly zero. On return state_evaluate has been done. False when no choice agrees with itself (a scene
 * whose forces fight at their thresholds). */
bool modes_settle(struct fbd_state *state, const struct decided *decided);

/* All holds between jointed bodies together: what sticks, what is taut or presses (tree_holds.c). False when
 * that has changed state->slip; what is in the way stands in state->holds. */
bool tree_settle_holds(struct fbd_state *state, const struct decided *decided);

struct arena;
struct rest_margin;

/* What is left to the limits of a load that several holds share, right after force_balance_along with the
 * rates of change `flow`; `guides` as in rest_find_margin. False when none is shared, or memory is out
 * (arena->failed). */
bool tree_find_margin(struct fbd_state *state, const struct instant *at, bool guides,
                      const struct direction *flow, const double *slots, const double *slots_along,
                      struct arena *arena, struct rest_margin *margin);

/* A pair has come to the limit of what it shares: what gives with it gives, in state->slip, and is decided.
 * False when it shares nothing. */
bool tree_give_shared(struct fbd_state *state, int pair, struct decided *decided);

/* The velocity of a pair relative to its surface. */
double slip_velocity(const struct fbd_model *model, int pair, const struct instant *at);

/* The same for settling: in a run (with `decided`) what sticks between jointed bodies is at rest, whatever
 * rounding the constraints leave; where all comes to rest there is nothing else to measure that against. */
double settling_velocity(const struct fbd_state *state, const struct decided *decided, int pair);

/* How far beyond its limit friction at rest is at it, where rates decide: what they change within the rounding of the
 * time, and in a run, of what has just come to rest, friction_return. */
double settling_slack(const struct fbd_state *state, const struct decided *decided, int pair,
                      const struct friction_values *now, const struct friction_values *rate);

/* Give the rates of sticking coordinates the exact velocity of their surface. */
void modes_hold(struct fbd_state *state);

/* Put prescribed coordinates and their rates where the time says. */
void modes_drive(struct fbd_state *state);

struct tree_work;

/* The rounding of the normal force on a body, 1e-13 of the largest force about: what presses or pulls by less does
 * neither. `tree` may be NULL. */
double press_slack(const struct fbd_model *model, const struct tree_work *tree, int body);

#endif
