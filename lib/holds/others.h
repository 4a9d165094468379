/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Other forces that are consistent with the modes, where forces are indeterminate.
 */
#ifndef FBD_HOLDS_OTHERS_H
#define FBD_HOLDS_OTHERS_H

#include "holds/holds.h"

/* Steps from the present forces to others of the same modes: rows of `count` forces, at most 2 count. Returns
 * their number, or -1 when memory is out. Problems without guides. At each surface it searches for larger and
 * for smaller forces by the least total change: an empty result does not prove uniqueness. */
int holds_other_forces(struct hold_problem *problem, double *steps);

#endif
