/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Verdict: findings for the student from the comparison of a body.
 */
#ifndef FBD_GRADE_VERDICT_H
#define FBD_GRADE_VERDICT_H

#include "fbd_grade.h"
#include "grade/compare.h"

/* Findings on a body of the key, by its number: it is missing; it has another kind of motion. */
void verdict_body(struct fbd_grade *grade, size_t body);
void verdict_motion(struct fbd_grade *grade, size_t body, const fbd_body *other);

/* Finding for an answer with another gravity, and hence other forces. */
void verdict_gravity(struct fbd_grade *grade, size_t body);

/* Judge the properties and the list of a body; units of length and force of the answer in those of the key. */
void verdict_on(struct fbd_grade *grade, const fbd_model *answer, size_t body, const fbd_body *other,
                struct sides *sides, double length, double force);

/* Deduct points for a superfluous force, body or coupling. */
void verdict_superfluous(struct fbd_grade *grade, fbd_finding_kind kind, const char *body, const char *name,
                         struct pos at, const char *message);

/* Judge bodies and couplings that only one of answer and key has. */
void verdict_on_others(struct fbd_grade *grade, const fbd_model *answer);

#endif
