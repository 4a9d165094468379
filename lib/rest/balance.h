/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Do the forces of the diagrams add up to the motion: m a = sum of f, I alpha = sum of M of each body?
 *
 * The right-hand side and the diagrams are two implementations of the same mechanics. Where they differ, or
 * where modes are inconsistent with the forces, the motion is not that of the scene, and the error would be
 * invisible. So every run is checked at the states that are output.
 */
#ifndef FBD_REST_BALANCE_H
#define FBD_REST_BALANCE_H

#include "base/text.h"
#include "dynamics/diagram.h"
#include "dynamics/state.h"

/* Describe the equation with the largest residual relative to rounding, at the evaluated state. Returns
 * false, with nothing added to `lack`, when all equations are satisfied; without memory true, and `lack` has
 * failed. */
bool balance_lack(struct fbd_state *state, struct text *lack);

/* The largest acceleration of a body that the sum of the magnitudes of its forces would cause, at the
 * evaluated state: the reference for round-off of balanced forces. */
double balance_size(const struct fbd_state *state);

#endif
