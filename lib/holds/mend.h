/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Principal pivoting from modes that are nearly consistent.
 */
#ifndef FBD_HOLDS_MEND_H
#define FBD_HOLDS_MEND_H

#include "holds/holds.h"

/* Start from the present modes; change the mode of the first constraint that violates its law, repeatedly
 * (Murty's rule, which is finite if friction couples weakly: Cottle, Pang and Stone, section 4.2). holds_lost
 * where no consistent modes are reached; modes and forces are then undefined. */
enum holds_found holds_mend(struct hold_problem *problem);

#endif
