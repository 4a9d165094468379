/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Places in the world that expressions name: `rod.right.x`, `rod.angle`. They are functions of coordinates
 * and rates, and follow these in an extended vector: [q, v, z, the slots of derivations by hand, places].
 *
 * A model without such names has none of this: an instant then stays as it is. Where derivations by hand alone have them
 * it does, too, and the places are written with the forces only (state_evaluate).
 */
#ifndef FBD_DYNAMICS_WORLD_REFS_H
#define FBD_DYNAMICS_WORLD_REFS_H

#include "dynamics/kinematics.h"

/* The length of an extended vector, that of y without places. */
size_t extended_size(const struct fbd_model *model);

/* The instant with its y extended, in at->extended. For jointed bodies the links are moved there. */
struct instant instant_extend(const struct fbd_model *model, const struct instant *at);

/* The same for the right-hand side, which copies nothing that it need not: extended into `room`, or as it is.
 */
static inline const struct instant *instant_with_places(const struct fbd_model *model,
                                                        const struct instant *at, struct instant *room)
{
    if (!model->names_places) return at;
    *room = instant_extend(model, at);
    return room;
}

/* A direction likewise, behind the instant's vector. `at` is extended. */
struct direction direction_extend(const struct fbd_model *model, const struct instant *at,
                                  const struct direction *along);

/* Write the places behind `y`, which has room for them; poses are those of the instant. */
void world_refs_write(const struct fbd_model *model, const struct instant *at, double *y);

#endif
