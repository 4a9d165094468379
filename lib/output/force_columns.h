/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What an arrow of a diagram is in tables of numbers (CSV, page, plots), by the motion of its body whatever
 * that is joined to.
 *
 *   slide, track   the component along +x, of `normal` the normal force
 *   pivot          the moment about the axis
 *   particle       x and y
 *   planar, weld   x, y, and the moment about the centre of mass
 *
 * What the joint of the body itself gives has no such share: of a pivot x and y, of a guide nothing. With
 * `components` every arrow has x, y and the moment about the centre of mass as well.
 */
#ifndef FBD_OUTPUT_FORCE_COLUMNS_H
#define FBD_OUTPUT_FORCE_COLUMNS_H

#include "dynamics/diagram.h"

enum force_part { force_share, force_x, force_y, force_moment, force_parts };

/* The parts of an arrow of body b, in their order; returns their number. */
size_t force_columns(const struct fbd_model *model, int b, const struct arrow *arrow, bool components,
                     enum force_part parts[static force_parts]);

/* "", "x", "y" or "moment". */
const char *force_part_name(enum force_part part);
const char *force_part_unit(const struct fbd_model *model, int b, enum force_part part);

/* At the instant that the arrow is of. */
double force_part_value(const struct fbd_model *model, int b, const struct instant *at,
                        const struct arrow *arrow, enum force_part part);

#endif
