/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names and units of the entries of y in outputs. The library uses radians; angles are converted to degrees
 * here, just before a number is written.
 */
#ifndef FBD_OUTPUT_DISPLAY_UNITS_H
#define FBD_OUTPUT_DISPLAY_UNITS_H

#include "model/model.h"

struct display {
    const char *name, *unit; /* "pendulum.theta", "rad"; "1" for a pure number */
    double size;             /* of that unit: the number in y is divided by it, 60 deg are written as 60 */
};

/* Coordinate, rate or state `index` of y; angles and their rates in degrees if `degrees`. */
struct display display_of_component(const struct fbd_model *model, size_t index, bool degrees);

/* An angle or its rate in degrees if `degrees`. */
struct display display_in_degrees(struct display display, bool degrees);

#endif
