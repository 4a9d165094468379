/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sums over stages of pair8.c, two components at a time and one at a time, in the same order. The
 * coefficients are compile-time constants, so that zero ones cost no operation.
 *
 * A wide load of numbers that were stored one by one has to wait until they have left the processor's store
 * buffer, and right-hand sides store one by one: measured, a step of a small system is slower if all stages
 * are loaded wide. Only the last stage is that recent.
 */
#ifndef FBD_INTEGRATE_PAIR8_SUMS_H
#define FBD_INTEGRATE_PAIR8_SUMS_H

#include <stddef.h>

#include "base/simd2.h"

#define INLINE static inline __attribute__((always_inline))

/* Load two numbers that have just been stored one by one; `volatile` keeps compilers from a wide load. */
INLINE simd2 load_young(const double *from)
{
    const volatile double *numbers = from;
    return (simd2){numbers[0], numbers[1]};
}

/* Load stage j in a sum over the stages before stage `count`. */
#define LOAD_TWO(j, from) ((j) < count - 1 ? simd2_load(from) : load_young(from))
#define LOAD_ONE(j, from) (*(from))

/* The term of stage j, and the sum; the stages of the component, or of two, begin at k and lie n apart. */
#define STAGE_TERM(j, load)                                                                                  \
    if ((j) < count && row[j] != 0) sum += row[j] * load(j, k + ((j)-1) * n)

#define STAGE_SUM(number, load)                                                                              \
    do {                                                                                                     \
        number sum = row[1] * load(1, k);                                                                    \
        STAGE_TERM(2, load);                                                                                 \
        STAGE_TERM(3, load);                                                                                 \
        STAGE_TERM(4, load);                                                                                 \
        STAGE_TERM(5, load);                                                                                 \
        STAGE_TERM(6, load);                                                                                 \
        STAGE_TERM(7, load);                                                                                 \
        STAGE_TERM(8, load);                                                                                 \
        STAGE_TERM(9, load);                                                                                 \
        STAGE_TERM(10, load);                                                                                \
        STAGE_TERM(11, load);                                                                                \
        STAGE_TERM(12, load);                                                                                \
        STAGE_TERM(13, load);                                                                                \
        STAGE_TERM(14, load);                                                                                \
        STAGE_TERM(15, load);                                                                                \
        STAGE_TERM(16, load);                                                                                \
        return sum;                                                                                          \
    } while (0)

INLINE simd2 sum_of_two(const double *row, int count, const double *k, size_t n)
{
    STAGE_SUM(simd2, LOAD_TWO);
}

INLINE double sum_of_one(const double *row, int count, const double *k, size_t n)
{
    STAGE_SUM(double, LOAD_ONE);
}

#endif
