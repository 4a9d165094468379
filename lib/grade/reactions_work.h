/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How a reaction is compared at one state: between reactions.c and misdrawn.c.
 */
#ifndef FBD_GRADE_REACTIONS_WORK_H
#define FBD_GRADE_REACTIONS_WORK_H

#include "grade/reactions.h"

/* Forces below this share of the largest one are zero: reactions are solutions of systems of equations. */
extern const double reaction_zero;

bool reaction_is_zero(const struct sides *sides, const struct item *item, size_t s);
bool reaction_is_couple(const struct sides *sides, const struct item *item, size_t s);

/* The first state where it is not zero, at the start if possible; `samples` when there is none. */
size_t reaction_when(const struct sides *sides, const struct item *key);

/* Is the second action the first, to the tolerance? */
bool reaction_is_near(const struct sides *sides, const struct action *key, const struct action *other);

/* Does the line of action of `item` pass a point? */
bool reaction_passes(const struct sides *sides, const struct action *item, struct vec point);
bool reaction_is_parallel(const struct sides *sides, struct vec a, struct vec b);

/* Number k of what can be a reaction: those of couplings and joints, then normal forces and friction that the key lists.
 * NULL for what is used or zero. */
struct item *reaction_candidate(const struct sides *sides, size_t k);

#endif
