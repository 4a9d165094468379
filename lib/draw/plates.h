/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plates: shapes for bodies without a shape in the file, from the points where joints and loads act: a wheel
 * for a gear, a bar or a plate through the points, a wedge under a sliding body.
 */
#ifndef FBD_DRAW_PLATES_H
#define FBD_DRAW_PLATES_H

#include "draw/shapes.h"

enum { most_plate_points = 16 };

struct plate {
    struct vec points[most_plate_points]; /* in the body's frame, in order of angle around their middle */
    size_t count;
    double wheel; /* radius of the gear around `hub`; 0 if it is none */
    struct vec hub;
    int cam; /* the connection with the closed curve on which another body is one-sided: the outline; else -1 */
    int rods;  /* that end at the body */
    int rider; /* the body that slides on this slide; else -1 */
};

/* The plate of a body; it has no points, wheel and rider if the body has a shape. */
struct plate plate_of(const fbd_model *model, const fbd_view *view, size_t body);

#endif
