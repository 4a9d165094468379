/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Shapes: the size of a body, from its parts, and points of the public structures as vectors.
 */
#ifndef FBD_DRAW_SHAPES_H
#define FBD_DRAW_SHAPES_H

#include "base/vec.h"
#include "fbd_view.h"

/* From the frame of a body to the world. */
static inline struct vec pose_point(const fbd_pose *pose, const fbd_body *body, struct vec point)
{
    const struct vec turn = {pose->cosine, pose->sine};
    return vec_add((struct vec){pose->x, pose->y}, vec_turn(turn, vec_sub(point, vec_of(body->pin))));
}

/* The largest extent of the body from `center` in the direction `along` (a unit vector), all in the body
 * frame; 0 when no part has a size. */
double shapes_reach(const fbd_model *model, size_t body, struct vec center, struct vec along);

/* The corners of the smallest axis-parallel rectangle, in the body frame, around the body's parts. False when
 * no part has a size. */
bool shapes_size(const fbd_model *model, size_t body, struct vec *low, struct vec *high);

#endif
