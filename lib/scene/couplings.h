/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Declarations shared by the files that read couplings. All return false after noting an error.
 */
#ifndef FBD_SCENE_COUPLINGS_H
#define FBD_SCENE_COUPLINGS_H

#include "scene/fields.h"
#include "scene/language.h"
#include "scene/names.h"
#include "scene/reader.h"

/* Read all ends; at least one of them moves, and no two subsequent ones are on the same body. */
bool coupling_ends_read(struct reader *reader, const struct node *list, const char *key, size_t least,
                        size_t most, struct constraint *constraint);

/* The circle of a body: the first of its parts that is round; NULL without one. */
const struct part *body_round_part(const struct body *body);

bool body_turns(const struct body *body);

/* The circle at end k: its centre, and its radius if that is not given (0). The body turns. */
bool coupling_circle_set(struct reader *reader, struct constraint *constraint, int k, double radius);

/* A given moment or force between two bodies (read_actuator.c), when its keys other than `force` are read. */
bool actuator_read(struct reader *reader, const struct chosen *chosen, struct names *names,
                   const struct coupling_keys *keys, struct force_coupling *coupling);

/* The speed of the surface of end 1: a function of t alone, without jumps. */
bool surface_speed_read(struct reader *reader, const struct value *speed, struct constraint *constraint);

/* Two points; two turning bodies with their circles; and the remaining kinds (read_wheels.c). */
bool points_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);
bool wheels_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);
bool rack_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);
bool roll_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

/* A linear relation of coordinates (read_ratio.c). */
bool ratio_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

/* A point on a line or curve (read_slot.c). */
bool slot_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

/* A point of a body on a plane with friction (read_plane.c). */
bool plane_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

/* Two bodies that may touch, or a body and the ground (read_contacts.c). */
bool contact_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

/* A rope with its discs (read_ropes.c). */
bool rope_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint);

#endif
