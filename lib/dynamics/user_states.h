/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * User states: z' = rate(t, q, v, z), any number of equations of first order beside those of motion. Forces
 * may depend on z, and the rates on the same quantities as forces.
 */
#ifndef FBD_DYNAMICS_USER_STATES_H
#define FBD_DYNAMICS_USER_STATES_H

#include "dynamics/state.h"

/* rates[plan.own] at an instant. */
void user_state_rates(const struct fbd_model *model, const struct instant *given, double *rates);

/* Their variations along a direction. */
void user_state_rates_along(const struct fbd_model *model, const struct instant *given,
                            const struct direction *direction, double *rates_along);

/* The scale of the rate of state `own` at rest, as a sum of magnitudes, with which zero is compared. Each
 * number on which it depends counts with its size, at least 1 rad or a thousandth. */
double user_state_rate_size(const struct fbd_state *state, int own);

#endif
