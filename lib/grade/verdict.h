/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Verdict: what the comparison of a body means for the student.
 */
#ifndef FBD_GRADE_VERDICT_H
#define FBD_GRADE_VERDICT_H

#include "fbd_grade.h"
#include "grade/compare.h"

/* The body is not there; it moves in another way. */
void verdict_body(struct fbd_grade *grade, const struct model_body *key);
void verdict_motion(struct fbd_grade *grade, const struct model_body *key, const struct model_body *body);

/* The answer has another gravity, and with it other forces. */
void verdict_gravity(struct fbd_grade *grade, const struct model_body *key);

/* What it is and what it lists; units of length and force of the answer in those of the key. */
void verdict_on(struct fbd_grade *grade, const fbd_model *answer, const struct model_body *key,
                const struct model_body *body, struct sides *sides, double length, double force);

/* A force, body or coupling that is too much costs points. */
void verdict_superfluous(struct fbd_grade *grade, fbd_finding_kind kind, const char *body, const char *name,
                         struct pos at, const char *message);

/* Bodies and couplings that the key does not have, or the answer. */
void verdict_on_others(struct fbd_grade *grade, const fbd_model *answer);

#endif
