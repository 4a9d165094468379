/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The solutions of a problem of unilateral constraints by the law alone: the forces of all combinations of modes, each by a
 * linear system.
 */
#ifndef FBD_TESTS_HOLDS_BY_MODES_H
#define FBD_TESTS_HOLDS_BY_MODES_H

#include "holds/holds.h"

/* The number of solutions with different accelerations; those of the first are left in the problem. Kinetic coefficients
 * equal static ones. */
int holds_by_modes(struct hold_problem *problem);

#endif
