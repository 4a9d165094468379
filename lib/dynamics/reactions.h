/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The reactions that events name: `cord.tension`, `hinge.x`. They stand among the positions in the world behind y
 * (world_refs.h), and are written when the forces are known.
 *
 * The force of a coupling on a body is the sum of lambda_j f_j over its rows, with f_j the force of a unit multiplier,
 * and its rate along the motion that of lambda'_j f_j + lambda_j f'_j. The multipliers are those of the least norm
 * where reactions are not unique.
 */
#ifndef FBD_DYNAMICS_REACTIONS_H
#define FBD_DYNAMICS_REACTIONS_H

#include "dynamics/forward.h"

/* Write their values behind `y`, after force_balance() or accelerations() at the instant, whose results are `slots`. */
void reactions_write(const struct fbd_model *model, const struct instant *at, const double *slots, double *y);

/* Copy them from behind `y` to behind `to`. */
void reactions_copy(const struct fbd_model *model, const double *y, double *to);

/* Write their rates along the motion behind `dy`, right after force_balance_along(). */
void reactions_write_along(const struct fbd_model *model, const struct instant *at,
                           const struct direction *along, const double *slots, const double *slots_along,
                           double *dy);

#endif
