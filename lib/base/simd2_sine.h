/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Cosines and sines of two angles at a time, bit for bit those of sine.h.
 */
#ifndef FBD_BASE_SIMD2_SINE_H
#define FBD_BASE_SIMD2_SINE_H

#include "base/simd2.h"
#include "base/sine.h"

/* Set components to zero that are the rounding of a quarter turn: vec_without_rounding. */
static inline simd2 simd2_without_rounding(simd2 x)
{
    const simd2_bits size = (simd2_bits)x & LLONG_MAX;
    return (simd2)((simd2_bits)x & ~((simd2)size < 2.5e-16));
}

static inline void simd2_cosines_and_sines(simd2 x, simd2 *cosines, simd2 *sines)
{
    simd2 shifted, y0, y1, of_even, of_odd;
    SINE_REDUCE(simd2, x, shifted, y0, y1);
    const simd2 z = y0 * y0;
    SINE_OF_REST(simd2, y0, y1, z, of_even);
    COSINE_OF_REST(simd2, y0, y1, z, of_odd);
    const simd2_bits quarter = (simd2_bits)shifted, odd = -(quarter & 1);
    *sines = simd2_flip_sign(simd2_select(odd, of_odd, of_even), quarter >> 1);
    *cosines = simd2_flip_sign(simd2_select(odd, of_even, of_odd), (quarter + 1) >> 1);
}

/* unit_by_sine of both. */
static inline void units_by_sine(double first, double second, struct vec *a, struct vec *b)
{
    if (!(fabs(first) <= SINE_MOST && fabs(second) <= SINE_MOST)) {
        *a = unit_by_sine(first);
        *b = unit_by_sine(second);
        return;
    }
    simd2 x, y;
    simd2_cosines_and_sines((simd2){first, second}, &x, &y);
    x = simd2_without_rounding(x);
    y = simd2_without_rounding(y);
    *a = (struct vec){x[0], y[0]};
    *b = (struct vec){x[1], y[1]};
}

#endif
