/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Vectors of `LANES` numbers, for lanes_step.h. Comparisons set all bits where true, and none where false.
 */
#ifndef FBD_BATCH_LANES_VECTOR_H
#define FBD_BATCH_LANES_VECTOR_H

#include <float.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/sine.h"
#include "batch/lanes.h"

/* Every processor has vectors of two. */
#ifndef LANES
#define LANES 2
#endif

typedef double wide __attribute__((vector_size(LANES * sizeof(double))));
typedef long long mask __attribute__((vector_size(LANES * sizeof(long long))));

#define INLINE static inline __attribute__((always_inline))

/* ---- vectors */

INLINE wide load(const double *from)
{
    wide x;
    memcpy(&x, from, sizeof x);
    return x;
}

INLINE void store(double *to, wide x)
{
    memcpy(to, &x, sizeof x);
}

INLINE wide select(mask which, wide a, wide b)
{
    return (wide)((which & (mask)a) | (~which & (mask)b));
}

INLINE wide larger_of(wide a, wide b)
{
    return select(a > b, a, b);
}

INLINE wide smaller_of(wide a, wide b)
{
    return select(a < b, a, b);
}

INLINE wide size_of(wide x)
{
    return (wide)((mask)x & 0x7fffffffffffffff);
}

INLINE wide root_of(wide x)
{
    double numbers[LANES];
    store(numbers, x);
    for (int i = 0; i < LANES; i++) numbers[i] = sqrt(numbers[i]);
    return load(numbers);
}

/* One bit for each lane. */
INLINE unsigned bits_of(mask which)
{
    unsigned bits = 0;
    for (int i = 0; i < LANES; i++) bits |= (unsigned)(which[i] & 1) << i;
    return bits;
}

INLINE mask mask_of(unsigned bits)
{
    mask which = {0};
    for (int i = 0; i < LANES; i++) which[i] = -(long long)(bits >> i & 1);
    return which;
}

/* x, or -x where the lowest bit of `which` is set. */
INLINE wide with_sign(wide x, mask which)
{
    return (wide)((mask)x ^ (-(which & 1) & LLONG_MIN));
}

INLINE wide sine_of(wide x)
{
    wide shifted, y0, y1, of_even, of_odd;
    SINE_REDUCE(wide, x, shifted, y0, y1);
    const wide z = y0 * y0;
    SINE_OF_REST(wide, y0, y1, z, of_even);
    COSINE_OF_REST(wide, y0, y1, z, of_odd);
    const mask quarter = (mask)shifted;
    return with_sign(select(-(quarter & 1), of_odd, of_even), quarter >> 1);
}

/* The unit vector of an angle, as vec_unit (base/vec.h). */
struct unit {
    wide x, y;
};

INLINE wide without_rounding(wide x)
{
    const wide zero = {0};
    return select(size_of(x) < 2.5e-16, zero, x);
}

INLINE struct unit unit_of(wide angle)
{
    wide shifted, y0, y1, of_even, of_odd;
    SINE_REDUCE(wide, angle, shifted, y0, y1);
    const wide z = y0 * y0;
    SINE_OF_REST(wide, y0, y1, z, of_even);
    COSINE_OF_REST(wide, y0, y1, z, of_odd);
    const mask quarter = (mask)shifted, odd = -(quarter & 1);
    const wide s = with_sign(select(odd, of_odd, of_even), quarter >> 1),
               c = with_sign(select(odd, of_even, of_odd), (quarter + 1) >> 1);
    return (struct unit){without_rounding(c), without_rounding(s)};
}

#endif
