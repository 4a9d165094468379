/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The polynomial through the last points of a trajectory: dense output for backward differentiation.
 *
 * A BDF step of order k puts its result on the polynomial of degree k through the k points before and
 * itself, which is therefore the right one to read values between the last two points from: it errs like
 * the step. It uses no slopes; in a stiff system f(t, y) magnifies the error of y by h |lambda|, and an
 * interpolant made of slopes with it.
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

/* Add a point; t differs from that of all points before. The oldest one is forgotten when there is no room.
 */
void history_add(struct history *history, double t, const double *y);

/* y at t on the polynomial of this degree through the latest points; of a lower degree while there are too
 * few. There must be one point at least. */
void history_eval(const struct history *history, int degree, double t, double *y);

#endif
