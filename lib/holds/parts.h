/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Holds that do not feel each other are decided apart: what has to be tried then is a sum, not a product.
 */
#ifndef FBD_HOLDS_PARTS_H
#define FBD_HOLDS_PARTS_H

#include "holds/holds.h"

/* Number the connected parts of `count` things from 0; `meet` says whether two of them feel each other. Returns how
 * many there are. */
int parts_find(int count, bool (*meet)(const void *context, int i, int j), const void *context, int *part);

/* Decide each connected part of the problem by `decide`. What is found is the worst of them all. */
enum holds_found parts_decide(struct hold_problem *problem,
                              enum holds_found (*decide)(struct hold_problem *problem));

#endif
