/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dormand and Prince's pair of order 8(5,3) as a program by hand has it: Hairer's dop853.f without dense output, its sums
 * written out, its step control without memory (HNW I, II.4, II.10), and nothing else.
 */
#ifndef FBD_BENCH_DOP853_BY_HAND_H
#define FBD_BENCH_DOP853_BY_HAND_H

#include <stddef.h>

typedef int rates_by_hand(double t, const double y[], double dydt[], void *params);

/* From t to `until`, y[n] in place. The local error of component i is at most tolerance * (scale[i] + |y[i]|), as a root
 * mean square; without `scale` 1 stands in its place. 0, or -1 without memory, when the right-hand side fails or the step
 * gets too small. */
int dop853_by_hand(rates_by_hand *rates, void *params, size_t n, double t, double until, double *y,
                   double tolerance, const double *scale);

#endif
