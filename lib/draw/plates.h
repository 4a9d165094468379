/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plates: shapes for bodies without a shape in the file, from the points where joints and loads act: a wheel
 * for a gear, a bar or a plate through the points, a wedge under a sliding body.
 */
#ifndef FBD_DRAW_PLATES_H
#define FBD_DRAW_PLATES_H

#include "model/model.h"

enum { most_plate_points = 16 };

struct plate {
    struct vec points[most_plate_points]; /* in the body's frame, in order of angle around their middle */
    size_t count;
    double wheel; /* radius of the gear around `hub`; 0 if it is none */
    struct vec hub;
    const struct model_body *rider; /* the body that slides on this slide; else NULL */
};

/* The plate of a body; all members are zero if the body has a shape. */
struct plate plate_of(const struct fbd_model *model, int body);

#endif
