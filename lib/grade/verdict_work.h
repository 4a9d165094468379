/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Between verdict.c and verdict_reactions.c: the findings about pairs of forces.
 */
#ifndef FBD_GRADE_VERDICT_WORK_H
#define FBD_GRADE_VERDICT_WORK_H

#include "fbd_grade.h"
#include "grade/reactions.h"
#include "grade/verdict.h"

/* Record the finding on a force of the key and one of the answer; both are then used. */
void verdict_pair(struct fbd_grade *grade, const char *body, struct item *key, struct item *item,
                  fbd_finding_kind kind, const char *message, const char *detail);
void verdict_right(struct fbd_grade *grade, const char *body, struct item *key, struct item *item,
                   const char *message);

/* The points for one of the key. */
double verdict_worth(const struct fbd_grade *grade, const struct item *key);

/* `force` or `moment`. */
const char *verdict_noun(const fbd_listed_force *force);

/* The reactions, and then the rest: of all readings of the drawn forces the one with the most points. */
void verdict_reactions(struct fbd_grade *grade, const fbd_model *answer, size_t body, struct sides *sides);

/* The remaining items: forces that the key lists by components, and wrong ones. */
void verdict_rest(struct fbd_grade *grade, size_t body, struct sides *sides);

void verdict_misdrawn(struct fbd_grade *grade, const char *body, const struct misdrawn *misdrawn);
void verdict_zeros(struct fbd_grade *grade, const char *body, struct sides *sides);

#endif
