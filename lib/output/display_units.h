/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the entries of y are called in outputs, and in which unit they are shown. The library counts angles in radians;
 * degrees are for people, and begin here, at the last moment before a number is written.
 */
#ifndef FBD_OUTPUT_DISPLAY_UNITS_H
#define FBD_OUTPUT_DISPLAY_UNITS_H

#include "model/model.h"

struct display {
    const char *name, *unit; /* "pendulum.theta", "rad"; "1" for a pure number */
    double size;             /* of that unit, by which the number in y is divided: 60 deg come back as 60 */
};

/* Coordinate, rate or state `index` of y; angles and their rates in degrees if that is asked for. */
struct display display_of_component(const struct fbd_model *model, size_t index, bool degrees);

/* Of an angle, or its rate: in degrees if that is asked for. */
struct display display_in_degrees(struct display display, bool degrees);

#endif
