/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The point of a polyhedron that is nearest to the origin: least |x| with G x >= h.
 *
 * By the dual active-set method (active_set.h), from the origin.
 */
#ifndef FBD_NUMERIC_LEAST_DISTANCE_H
#define FBD_NUMERIC_LEAST_DISTANCE_H

#include <stdbool.h>
#include <stddef.h>

enum least_distance {
    least_distance_found,
    least_distance_empty, /* the inequalities contradict each other, to rounding */
    least_distance_no_memory
};

/* G is `rows` by `size`, row by row; x takes `size`. Rows should be scaled to one size, and h to size 1; an x
 * beyond 1e4 is rejected. If the polyhedron is very thin, the caller should check the inequalities with x. */
enum least_distance least_distance(size_t rows, size_t size, const double *G, const double *h, double *x);

/* The greatest level, not above `most`, for which there is an x with G x >= h + level; and the multipliers of the rows: their
 * sum is one, and that of the rows times them is zero; all zero where the level is `most`. The level rises from that of
 * x = 0, with x the nearest to the origin, until a limit cannot be satisfied. x takes `size`, or is NULL. False when memory is
 * out. */
bool least_distance_rise(size_t rows, size_t size, const double *G, const double *h, double most,
                         double *level, double *u, double *x);

#endif
