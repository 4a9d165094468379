/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The columns of an arrow of a diagram in tables of numbers (CSV, page, plots). They depend on the motion of
 * its body, not on its connections.
 *
 *     slide, track   the component along +x, of `normal` the normal force
 *     pivot          the moment about the axis
 *     particle       x and y
 *     planar, weld   x, y, and the moment about the centre of mass
 *
 * The reaction of the body's own joint has no such component: of a pivot x and y are written, of a guide no
 * column. With `components` every arrow has x, y and the moment about the centre of mass as well.
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

/* The value at the instant of the arrow. */
double force_part_value(const struct fbd_model *model, int b, const struct instant *at,
                        const struct arrow *arrow, enum force_part part);

#endif
