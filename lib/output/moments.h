/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The moment of a force in textbook form, by its arm:
 *
 *     l (R_y cos(theta) - R_x sin(theta))     of a force at a point on the x axis of the body's frame through G (or O)
 *     -l (R_x cos(theta) + R_y sin(theta))    on the y axis
 *     (0.2 R_y - 0.1 R_x)                     on a body that does not turn
 *     -r f                                    at one arm at all times, as on the rim of a disc
 *
 * theta is the coordinate if it is the angle of the body in the world, else `angle` is that angle. A length
 * is named after the parameter that has its value, or half of it, else it is a value with its unit, 0.2[m]; L
 * = |OG|.
 */
#ifndef FBD_OUTPUT_MOMENTS_H
#define FBD_OUTPUT_MOMENTS_H

#include "output/formulas.h"

/* The component of a force along an axis: R_1x, (mu_k N)_x. NULL when memory is out. */
const char *component_by_symbol(struct arena *arena, const char *symbol, const char *axis);

/* The length |d| of body b: L, a parameter or its half, or a value. NULL when memory is out. */
const char *arm_name(struct formulas *formulas, int b, double d);

/* The angle of a body in the world: its coordinate, or `angle`. */
const char *angle_name(const struct formulas *formulas, int b);

/* The direction of the line of the ground on which body b rolls, or which it touches, by the name of the
 * force; false for none. */
bool ground_line_of_force(const struct fbd_model *model, int b, const char *name, struct vec *e);

/* The letters of a force on a body: `sign` times `size`, or as a vector with the sign `minus`. */
struct letter {
    const char *size, *vector, *minus;
    double sign;
};

/* The moment of a force, or of a couple; M_G(..) if it has no arm, "" if it is zero at all times. NULL when
 * memory is out. */
const char *moment_by_arm(struct formulas *formulas, const struct equation *equation, const struct acts *acts,
                          bool moment, const struct letter *letter);

#endif
