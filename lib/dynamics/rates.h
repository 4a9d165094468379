/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rates: the right-hand side that a stepper calls, built for one plan and one set of modes.
 *
 * Between two events the modes are fixed, and most coordinates of bodies that stand alone have few terms: a block
 * that slides down a plane has a constant acceleration, a pendulum one sine. So each time the stepper starts, every
 * scalar equation (plan.h) becomes a row; the friction of a mode is a number in it, and any other body that stands
 * alone is one row. Jointed bodies are one row. Where their tree has no form of
 * its own, all bodies are one row, by forward.h. A single row is called directly.
 *
 *   row          dv/dt                                                  for
 *   scalar       (c0 - kq q - kv v + s sin q + c cos q - k |v| v        constant friction; f: formulas, of which a
 *                 + sum of scale f(t, q, v) - F) / m                    single c u^k or c sin(w u + p) is inline
 *   held         0, dx/dt = the speed of the surface                    stick on a surface of constant speed
 *   alone        tree_alone.c                                           other bodies that stand alone
 *   bare tree    tree_bare.h                                            pivots under gravity and the like
 *   loop         tree_loop.h                                            slider-cranks, four-bars
 *   loops        closed_loops.h                                         pivots and slides, their loops closed by pins
 *   whole        forward.h                                              all others
 *   own          z' = f(t, q, v, z)                                     user states
 *
 * All agree with state_rates to within rounding.
 */
#ifndef FBD_DYNAMICS_RATES_H
#define FBD_DYNAMICS_RATES_H

#include "dynamics/state.h"

/* As in gsl_odeiv2_system: 0, and dydt[plan_size]. */
typedef int rates_function(double t, const double y[], double dydt[], void *params);

/* Rows where possible; the general path always (for comparison); or zero rates, if the scene cannot move. */
enum rates_kind { rates_by_rows, rates_general, rates_none };

struct rates;

/* Rates in the modes of `state`, whose branches, slips and pulls are read during their use. NULL when memory
 * is out. */
struct rates *rates_new(struct fbd_state *state, enum rates_kind kind);
void rates_free(struct rates *rates);

/* Build the rows for the present modes of the state; to be called after every change of the slips. */
void rates_bind(struct rates *rates);

/* The function to call, and its params. */
rates_function *rates_call(struct rates *rates, void **params);

/* The state behind the params of a call. */
struct fbd_state *rates_state(void *params);

/* The number of rows of each kind. */
struct rates_census {
    int scalar, held, alone, own, bare, loops, whole;
};

struct rates_census rates_census(const struct rates *rates);

#endif
