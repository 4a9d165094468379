/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The point of a polyhedron that is nearest to the origin: least |x| with G x >= h.
 *
 * Lawson and Hanson, Solving Least Squares Problems, chapter 23: with u >= 0 that minimises |E u - f|, E the
 * rows of G as columns with h below them and f = (0, ..., 0, 1), and r = E u - f, x = -r / r_last; r = 0
 * means that there is no such point.
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
