/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Vectors of two doubles, which every supported processor has. Each component is rounded as a scalar.
 */
#ifndef FBD_BASE_SIMD2_H
#define FBD_BASE_SIMD2_H

#include <limits.h>
#include <string.h>

typedef double simd2 __attribute__((vector_size(2 * sizeof(double))));

/* A mask (all bits of a component set, or none) or the bits of two doubles. */
typedef long long simd2_bits __attribute__((vector_size(2 * sizeof(long long))));

static inline simd2 simd2_load(const double *from)
{
    simd2 both;
    memcpy(&both, from, sizeof both);
    return both;
}

static inline void simd2_store(double *to, simd2 both)
{
    memcpy(to, &both, sizeof both);
}

static inline simd2 simd2_select(simd2_bits which, simd2 a, simd2 b)
{
    return (simd2)((which & (simd2_bits)a) | (~which & (simd2_bits)b));
}

/* x, with the sign changed where the last bit of `which` is set. */
static inline simd2 simd2_flip_sign(simd2 x, simd2_bits which)
{
    return (simd2)((simd2_bits)x ^ (-(which & 1) & LLONG_MIN));
}

#endif
