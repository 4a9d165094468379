/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The states of the file's own: z' = rate(t, q, v, z), any number of equations of first order beside those of motion.
 * Forces may name the z, and the rates may name whatever a force may.
 */
#ifndef FBD_DYNAMICS_USER_STATES_H
#define FBD_DYNAMICS_USER_STATES_H

#include "dynamics/state.h"

/* rates[plan.own] at an instant. */
void user_state_rates(const struct fbd_model *model, const struct instant *given, double *rates);

/* Their variations along a direction. */
void user_state_rates_along(const struct fbd_model *model, const struct instant *given,
                            const struct direction *direction, double *rates_along);

/* How large the rate of state `own` is at a state of rest, as a sum of magnitudes: what zero is measured against. Of each
 * number that it depends on its size counts, at least 1 rad or a thousandth. */
double user_state_rate_size(const struct fbd_state *state, int own);

#endif
