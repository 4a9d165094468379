/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Positions of points of bodies, and forces along the line between two points.
 */
#ifndef FBD_EMIT_PLACED_H
#define FBD_EMIT_PLACED_H

#include "emit/emit.h"

/* The function that computes the pose of a body outside the tree; written at its first use. */
const char *emit_pose(struct emitter *emitter, int b);

/* The force of a spring or damper on an end; `reach` and `velocity` are its position and velocity relative to
 * the other end. */
const char *emit_link_force(struct emitter *emitter, const struct model_load *load, const char *reach,
                            const char *velocity);

/* C: the links of the tree `l`; only the pose of the ground is set. */
extern const char emit_new_links[];

/* Write the function that computes positions in the world after coordinates and rates, if any are used. */
void emit_places(struct emitter *emitter);

#endif
