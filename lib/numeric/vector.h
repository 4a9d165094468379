/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Products and sums of vectors of any length, two components at a time: the same bits on every processor.
 */
#ifndef FBD_NUMERIC_VECTOR_H
#define FBD_NUMERIC_VECTOR_H

#include <stddef.h>

#include "base/simd2.h"

static inline double vector_dot(const double *a, const double *b, size_t n)
{
    simd2 even = {0, 0}, odd = {0, 0};
    size_t k = 0;
    for (; k + 4 <= n; k += 4) {
        even += simd2_load(a + k) * simd2_load(b + k);
        odd += simd2_load(a + k + 2) * simd2_load(b + k + 2);
    }
    even += odd;
    double sum = even[0] + even[1];
    for (; k < n; k++) sum += a[k] * b[k];
    return sum;
}

/* a += share b. */
static inline void vector_add_multiple(double *a, const double *b, double share, size_t n)
{
    size_t k = 0;
    for (; k + 4 <= n; k += 4) {
        simd2_store(a + k, simd2_load(a + k) + share * simd2_load(b + k));
        simd2_store(a + k + 2, simd2_load(a + k + 2) + share * simd2_load(b + k + 2));
    }
    for (; k < n; k++) a[k] += share * b[k];
}

#endif
