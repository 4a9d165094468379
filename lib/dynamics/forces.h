/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The forces in the joints: springs, dampers and potentials of coordinates, but no dry friction.
 */
#ifndef FBD_DYNAMICS_FORCES_H
#define FBD_DYNAMICS_FORCES_H

#include "dynamics/kinematics.h"

/* slots[plan.slots]: the forces in the joints along the n coordinates, then zeros. */
void force_slots(const struct fbd_model *model, const struct instant *at, double *slots);

/* Those of a link that stands alone; other slots are left as they are. */
void force_slots_alone(const struct fbd_model *model, const struct instant *at, int link, double *slots);

/* The variation of all along a direction (exact, no differences). */
void force_slots_along(const struct fbd_model *model, const struct instant *at, const struct direction *along,
                       double *variation);

#endif
