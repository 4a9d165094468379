/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The polynomial through the last points of a trajectory: dense output for backward differentiation.
 *
 * A BDF step of order k puts its result on the polynomial of degree k through the k points before and itself.
 * So this polynomial is the appropriate interpolant between the last two points: its error is that of the
 * step. It uses no slopes; in a stiff system f(t, y) magnifies the error of y by h |lambda|, and so would an
 * interpolant of slopes.
 */
#ifndef FBD_INTEGRATE_HISTORY_H
#define FBD_INTEGRATE_HISTORY_H

#include <stddef.h>

enum { history_points = 6 }; /* BDF has orders up to 5 */

struct history;

/* For states of n numbers; NULL when memory is out. */
struct history *history_alloc(size_t n);
void history_free(struct history *history);

void history_clear(struct history *history);

/* Add a point; t differs from that of all points before. The oldest one is dropped when the ring is full. */
void history_add(struct history *history, double t, const double *y);

/* y at t on the polynomial of this degree through the latest points; of a lower degree while there are too
 * few. At least one point is required. */
void history_eval(const struct history *history, int degree, double t, double *y);

#endif
