/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forward dynamics: accelerations from the state.
 */
#ifndef FBD_DYNAMICS_FORWARD_H
#define FBD_DYNAMICS_FORWARD_H

#include "dynamics/friction.h"

/* slots[plan.slots]: the forces in the joints, as by force_slots, and behind them the normal forces and those of
 * friction by the motion in the present modes (tree.h). */
void force_balance(const struct fbd_model *model, const struct instant *given, double *slots);

/* The same in the slots of body b only where it stands alone; else in all slots. */
void force_balance_of(const struct fbd_model *model, int b, const struct instant *given, double *slots);

/* The variation of force_balance along a direction, right after it. */
void force_balance_along(const struct fbd_model *model, const struct instant *given,
                         const struct direction *direction, const double *slots, double *slots_along);

/* Compute a[n] at an instant, and slots[plan.slots] as by force_balance. */
void accelerations(const struct fbd_model *model, const struct instant *at, double *slots, double *a);

/* The same with the present weights of switches in sliding modes (sliding.h). */
void accelerations_at_shares(const struct fbd_model *model, const struct instant *given, double *slots,
                             double *a);
void accelerations_along_at_shares(const struct fbd_model *model, const struct instant *given,
                                   const struct direction *direction, double *slots, double *slots_along,
                                   double *a_along);

/* The variation of the accelerations along a direction. `slots` and `slots_along` (plan.slots each) are
 * scratch. */
void accelerations_along(const struct fbd_model *model, const struct instant *at,
                         const struct direction *along, double *slots, double *slots_along, double *a_along);

/* dydt[2 n] for an integrator, without user states (user_states.h). A sticking coordinate moves with its
 * surface. */
void state_rates(const struct fbd_model *model, const struct instant *at, double *slots, double *dydt);

/* The exact Jacobian: dfdy[plan_size x plan_size] row by row and dfdt[plan_size]. `scratch` has 2 plan.slots + 3 n
 * + 2 own entries. */
void state_jacobian(const struct fbd_model *model, const struct instant *given, double *scratch, double *dfdy,
                    double *dfdt);

/* The derivatives of the same rates by an input that states hold: dfdu[plan_size]; `held` has 1 at its parameter, 0 elsewhere
 * (struct direction). */
void state_held_slopes(const struct fbd_model *model, const struct instant *at, double *scratch,
                       const double *held, double *dfdu);

#endif
