/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plates: what a body without a shape in its file is drawn as. The points where others take hold of it say how
 * large it is: a wheel for a gear, a bar or a plate through the points, a wedge under what slides on it.
 */
#ifndef FBD_DRAW_PLATES_H
#define FBD_DRAW_PLATES_H

#include "model/model.h"

enum { most_plate_points = 16 };

struct plate {
    struct vec points[most_plate_points]; /* in the body's frame, in order around their middle */
    size_t count;
    double wheel; /* radius of the gear that it is, around `hub`; else 0 */
    struct vec hub;
    const struct model_body *rider; /* what slides on it, when nothing else says how large it is; else NULL */
};

/* Of a body with a shape of its own all is zero. */
struct plate plate_of(const struct fbd_model *model, int body);

#endif
