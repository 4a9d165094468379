/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where points of bodies are, and forces along the line between two.
 */
#ifndef FBD_EMIT_PLACED_H
#define FBD_EMIT_PLACED_H

#include "emit/emit.h"

/* The function that gives the pose of a body that moves by itself; it is written when it is first asked for. */
const char *emit_pose(struct emitter *emitter, int b);

/* The force of a spring or damper on the end that is at `reach` from the other and moves so against it. */
const char *emit_link_force(struct emitter *emitter, const struct model_load *load, const char *reach,
                            const char *velocity);

/* C: the links of the tree `l`, of which only the ground has its place, on which the others move. */
extern const char emit_new_links[];

/* The function that writes places in the world behind the coordinates and rates, if any are named. */
void emit_places(struct emitter *emitter);

#endif
