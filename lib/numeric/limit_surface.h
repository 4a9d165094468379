/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The limit surface of a rigid body that rubs on a plane at several points (S. Goyal, A. Ruina, J. Papadopoulos, Wear 143,
 * 1991, 307): the forces F and moments M that its friction can balance. With twists v = (V, Omega), velocities
 * u_i = V + Omega k x r_i of its points and limits c_i it is a convex set of support function
 *
 *     Phi(v) = sum c_i |u_i|,    F . V + M Omega <= Phi(v) for all v
 *
 * A load at its border sets the body in motion along the normal of the border. About a single point, where u_p = 0, the
 * force of that point is any within its limit.
 */
#ifndef FBD_NUMERIC_LIMIT_SURFACE_H
#define FBD_NUMERIC_LIMIT_SURFACE_H

#include <stddef.h>

#include "base/vec.h"

struct limit_point {
    struct vec r; /* its arm [m] */
    double c;     /* the limit of its friction [N] */
    struct vec u; /* set: its velocity, such that sum c_i |u_i| = sum c_i */
};

/* Find the velocities u for which (F . V + M Omega)/Phi is largest; without a load those along x. F [N] is at r = 0, M [N m]
 * about it. With their size sum c_i - F . V - M Omega is continuous in the load, also where that passes zero. */
void limit_surface_normal(struct limit_point *points, size_t count, struct vec F, double M);

#endif
