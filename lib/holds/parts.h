/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Uncoupled parts of the problem are decided independently: the numbers of modes to enumerate then add up
 * instead of multiplying.
 */
#ifndef FBD_HOLDS_PARTS_H
#define FBD_HOLDS_PARTS_H

#include "holds/holds.h"

/* Number the connected parts of `count` nodes from 0; `meet` returns whether two nodes are coupled. Returns
 * the number of parts. */
int parts_find(int count, bool (*meet)(const void *context, int i, int j), const void *context, int *part);

/* Decide each connected part of the problem by `decide`. Returns the worst result of them all. */
enum holds_found parts_decide(struct hold_problem *problem,
                              enum holds_found (*decide)(struct hold_problem *problem));

#endif
