/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Positions in the world that expressions refer to: `rod.right.x`, `rod.angle`. They are functions of
 * coordinates and rates, and stand behind these in an extended vector: [q, v, z, the slots of derivations by
 * hand, positions].
 *
 * Without such references an instant is not extended; nor if only derivations by hand contain them, which are
 * written after the forces (state_evaluate).
 */
#ifndef FBD_DYNAMICS_WORLD_REFS_H
#define FBD_DYNAMICS_WORLD_REFS_H

#include "dynamics/kinematics.h"

/* Callbacks that compute inputs receive at most this many coordinates, rates and user states. */
enum { most_called_numbers = 500 };

/* The length of an extended vector, that of y without references. */
static inline size_t extended_size(const struct fbd_model *model)
{
    return plan_size(&model->plan) + (model->absolute_count > 0 ? hand_slots + model->absolute_count : 0);
}

/* The instant with its y extended, in at->extended. Moves the links if positions of bodies are referred to. */
struct instant instant_extend(const struct fbd_model *model, const struct instant *at);

/* The same for the right-hand side, without unneeded copies: extended into `room`, or unchanged. */
static inline const struct instant *instant_with_places(const struct fbd_model *model,
                                                        const struct instant *at, struct instant *room)
{
    if (!model->names_places) return at;
    *room = instant_extend(model, at);
    return room;
}

/* Extend a direction likewise, behind the instant's vector. `at` is extended. */
struct direction direction_extend(const struct fbd_model *model, const struct instant *at,
                                  const struct direction *along);

/* Write the positions behind `y`, which has room for them; poses are those of the instant. */
void world_refs_write(const struct fbd_model *model, const struct instant *at, double *y);

#endif
