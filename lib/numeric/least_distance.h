/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The point of a polyhedron that is nearest to the origin: least |x| with G x >= h.
 *
 * By the dual active-set method (active_set.h), from the origin.
 */
#ifndef FBD_NUMERIC_LEAST_DISTANCE_H
#define FBD_NUMERIC_LEAST_DISTANCE_H

#include <stddef.h>

enum least_distance {
    least_distance_found,
    least_distance_empty, /* the inequalities contradict each other, to rounding */
    least_distance_no_memory
};

/* G is `rows` by `size`, row by row; x takes `size`. Rows should be scaled to one size, and h to size 1; an x
 * beyond 1e4 is rejected. If the polyhedron is very thin, the caller should check the inequalities with x. */
enum least_distance least_distance(size_t rows, size_t size, const double *G, const double *h, double *x);

#endif
