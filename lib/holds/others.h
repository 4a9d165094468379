/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Other forces that agree with the modes, where these leave them open.
 */
#ifndef FBD_HOLDS_OTHERS_H
#define FBD_HOLDS_OTHERS_H

#include "holds/holds.h"

/* Steps from the forces there are to others of the same modes: rows of `count` forces, at most 2 count of them. Their number,
 * or -1 when memory is out. Problems without guides. It looks for more and for less at each surface, by the least change of
 * all: that it finds none is no proof that there are none. */
int holds_other_forces(struct hold_problem *problem, double *steps);

#endif
