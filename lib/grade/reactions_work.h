/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Comparison of a reaction at one state: shared by reactions.c and misdrawn.c.
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

/* True if the second wrench equals the first within the tolerance. */
bool reaction_is_near(const struct sides *sides, const struct action *key, const struct action *other);

/* True if the line of action of `item` passes a point. */
bool reaction_passes(const struct sides *sides, const struct action *item, struct vec point);
bool reaction_is_parallel(const struct sides *sides, struct vec a, struct vec b);

/* Candidate number k for a reaction: those of couplings and joints, then normal forces and friction that the
 * key lists. NULL for used or zero ones. */
struct item *reaction_candidate(const struct sides *sides, size_t k);

#endif
