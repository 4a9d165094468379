/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two numbers at a time. Every processor has vectors of two, and each of their halves is rounded as a number is.
 */
#ifndef FBD_BASE_TWO_H
#define FBD_BASE_TWO_H

#include <limits.h>
#include <string.h>

typedef double two __attribute__((vector_size(2 * sizeof(double))));

/* All bits of a half where something holds, or none; or the bits of two numbers. */
typedef long long two_bits __attribute__((vector_size(2 * sizeof(long long))));

static inline two load_two(const double *from)
{
    two both;
    memcpy(&both, from, sizeof both);
    return both;
}

static inline void store_two(double *to, two both)
{
    memcpy(to, &both, sizeof both);
}

static inline two select_two(two_bits which, two a, two b)
{
    return (two)((which & (two_bits)a) | (~which & (two_bits)b));
}

/* x, or -x where the last bit of `which` is set. */
static inline two two_with_sign(two x, two_bits which)
{
    return (two)((two_bits)x ^ (-(which & 1) & LLONG_MIN));
}

#endif
