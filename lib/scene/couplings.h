/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the files that read couplings share. All return false after noting what is wrong.
 */
#ifndef FBD_SCENE_COUPLINGS_H
#define FBD_SCENE_COUPLINGS_H

#include "scene/language.h"
#include "scene/reader.h"

/* All ends; at least one of them moves, and no two that follow each other are on the same body. */
bool coupling_ends_read(struct reader *reader, const struct node *list, const char *what, size_t least,
                        size_t most, struct constraint *constraint);

/* The circle of a body: the first of its parts that is round; NULL without one. */
const struct part *body_round_part(const struct body *body);

bool body_turns(const struct body *body);

/* The circle at end k: its centre, and its radius if that is not given (0). The body turns. */
bool coupling_circle_set(struct reader *reader, struct constraint *constraint, int k, double radius);

/* Two points; two bodies that turn, with their circles; and the rest of the kinds (read_couplings.c). */
bool points_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);
bool wheels_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);
bool rack_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);
bool roll_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

/* A point on a line or curve (read_slot.c). */
bool slot_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

/* A rope with all that its discs say (read_ropes.c). */
bool rope_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

#endif
