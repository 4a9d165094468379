/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points of bodies in the world: position, velocity, acceleration, and proper acceleration.
 */
#ifndef FBD_OUTPUT_WORLD_H
#define FBD_OUTPUT_WORLD_H

#include "dynamics/state.h"

/* `.x .y .vx .vy .ax .ay` of a point in the axes of the world, and its proper acceleration a - g in those of the
 * body, `.proper_ax .proper_ay`. */
enum world_part {
    world_x,
    world_y,
    world_vx,
    world_vy,
    world_ax,
    world_ay,
    world_proper_ax,
    world_proper_ay,
    world_parts
};

enum { world_G = -1, world_O = -2 };

struct world_quantity {
    int body;
    int point; /* G, O, or a number of a named point: its position depends on the parameters of a model */
    enum world_part part;
};

const char *world_part_name(enum world_part part);
const char *world_part_unit(const struct fbd_model *model, enum world_part part);

/* Find `rod.right.vx`: a named point, G, or O of a pivot. False if it does not exist. */
bool world_find(const struct fbd_model *model, const char *name, struct world_quantity *quantity);

/* The point in the frame of its body. */
struct vec world_point(const struct fbd_model *model, int body, int point);

/* All parts of a point, in coherent units; the state has been evaluated. */
void world_values(const struct fbd_state *state, int body, struct vec point, double values[world_parts]);

#endif
