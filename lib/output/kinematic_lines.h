/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The acceleration of G of a body cut free in terms of those of the coordinates, in textbook form:
 *
 *     a_Gx = a_Ox - L (angle_ddot sin(angle) + angle_dot^2 cos(angle))
 *     a_Ox = -l (rod.omega_dot sin(rod.theta) + rod.omega^2 cos(rod.theta))
 *
 * O is the axis of a pivot; its acceleration follows from the body that carries it.
 */
#ifndef FBD_OUTPUT_KINEMATIC_LINES_H
#define FBD_OUTPUT_KINEMATIC_LINES_H

#include "output/formulas.h"

enum { most_kinematic_lines = 4 };

/* Write the lines of body b. Returns their number, 0 if a_G is a coordinate's acceleration or has no such
 * line. A line is NULL when memory is out. */
int kinematic_lines(struct formulas *formulas, int b, const char *lines[static most_kinematic_lines]);

#endif
