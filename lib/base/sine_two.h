/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Cosines and sines of two angles at a time, with the bits that sine.h has for each.
 */
#ifndef FBD_BASE_SINE_TWO_H
#define FBD_BASE_SINE_TWO_H

#include "base/sine.h"
#include "base/two.h"

/* Zero where it is the rounding of a quarter turn: vec_without_rounding. */
static inline two two_without_rounding(two x)
{
    const two_bits size = (two_bits)x & LLONG_MAX;
    return (two)((two_bits)x & ~((two)size < 2.5e-16));
}

static inline void cosines_and_sines(two x, two *cosines, two *sines)
{
    two shifted, y0, y1, of_even, of_odd;
    SINE_REDUCE(two, x, shifted, y0, y1);
    const two z = y0 * y0;
    SINE_OF_REST(two, y0, y1, z, of_even);
    COSINE_OF_REST(two, y0, y1, z, of_odd);
    const two_bits quarter = (two_bits)shifted, odd = -(quarter & 1);
    *sines = two_with_sign(select_two(odd, of_odd, of_even), quarter >> 1);
    *cosines = two_with_sign(select_two(odd, of_even, of_odd), (quarter + 1) >> 1);
}

/* unit_by_sine of both. */
static inline void units_by_sine(double first, double second, struct vec *a, struct vec *b)
{
    if (!(fabs(first) <= SINE_MOST && fabs(second) <= SINE_MOST)) {
        *a = unit_by_sine(first);
        *b = unit_by_sine(second);
        return;
    }
    two x, y;
    cosines_and_sines((two){first, second}, &x, &y);
    x = two_without_rounding(x);
    y = two_without_rounding(y);
    *a = (struct vec){x[0], y[0]};
    *b = (struct vec){x[1], y[1]};
}

#endif
