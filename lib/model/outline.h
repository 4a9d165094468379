/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Outline: the visible shape of a body, from its parts, in its own frame and in the scene's lengths.
 */
#ifndef FBD_MODEL_OUTLINE_H
#define FBD_MODEL_OUTLINE_H

#include "model/model.h"

enum outline_kind {
    outline_dot,     /* too small to have a size: a point mass, a rod seen from its end */
    outline_bar,     /* slender: from corner[0] to corner[1] */
    outline_circle,  /* center, radius; inner > 0 for a ring or tube */
    outline_polygon, /* corners, convex, counter-clockwise */
    outline_unknown, /* the file gives only its moment of inertia */
};

struct outline_part {
    enum outline_kind kind;
    bool hole; /* of negative mass: cut out of the others */
    struct vec center;
    double radius, inner;
    size_t count; /* corners: 2 of a bar; of a polygon; else 0 */
    struct vec corner[FBD_MOST_CORNERS];
};

/* The shape of the part in the plane. */
struct outline_part outline_of_part(const struct part *part);

/* The first hole whose centre lies in no other part; NULL if there is none, or if this cannot be told, since the file
 * gives the inertia of a part in place of its shape, or a part has no area. */
const struct part *outline_hole_outside(const struct body *body);

#endif
