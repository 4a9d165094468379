/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sums of a step of the method of nystrom_table.h: for scalars (nystrom.c) and for vectors with one lane
 * for each run of a SIMD batch, in the same order, as another order would change the bits. They are written
 * out, in two chains of additions that a processor can execute in parallel: measured, loops over the
 * coefficients are slower.
 *
 * STAGE(i, sum) makes stage i, given the sum over the stages before, whose terms are A(i, j) = a_ij k_j.
 */
#ifndef FBD_INTEGRATE_NYSTROM_SUMS_H
#define FBD_INTEGRATE_NYSTROM_SUMS_H

#include "integrate/nystrom_table.h"

#define NYSTROM_STAGES_2_TO_9(STAGE, A)                                                                      \
    STAGE(2, A(2, 1))                                                                                        \
    STAGE(3, A(3, 1) + A(3, 2))                                                                              \
    STAGE(4, A(4, 1) + A(4, 2) + A(4, 3))                                                                    \
    STAGE(5, A(5, 1) + A(5, 3) + A(5, 4))                                                                    \
    STAGE(6, (A(6, 1) + A(6, 4)) + (A(6, 3) + A(6, 5)))                                                      \
    STAGE(7, (A(7, 1) + A(7, 4) + A(7, 6)) + (A(7, 3) + A(7, 5)))                                            \
    STAGE(8, (A(8, 1) + A(8, 5) + A(8, 7)) + (A(8, 4) + A(8, 6)))                                            \
    STAGE(9, (A(9, 1) + A(9, 4) + A(9, 6) + A(9, 8)) + (A(9, 3) + A(9, 5) + A(9, 7)))

#define NYSTROM_STAGES_10_TO_14(STAGE, A)                                                                    \
    STAGE(10, (A(10, 1) + A(10, 4) + A(10, 6) + A(10, 8)) + (A(10, 3) + A(10, 5) + A(10, 7) + A(10, 9)))     \
    STAGE(11, (A(11, 1) + A(11, 4) + A(11, 6) + A(11, 8) + A(11, 10)) +                                      \
                  (A(11, 3) + A(11, 5) + A(11, 7) + A(11, 9)))                                               \
    STAGE(12, (A(12, 1) + A(12, 4) + A(12, 6) + A(12, 8) + A(12, 10)) +                                      \
                  (A(12, 3) + A(12, 5) + A(12, 7) + A(12, 9) + A(12, 11)))                                   \
    STAGE(13, (A(13, 1) + A(13, 4) + A(13, 6) + A(13, 8) + A(13, 10) + A(13, 12)) +                          \
                  (A(13, 3) + A(13, 5) + A(13, 7) + A(13, 9) + A(13, 11)))                                   \
    STAGE(14, (A(14, 1) + A(14, 4) + A(14, 6) + A(14, 8) + A(14, 10) + A(14, 12)) +                          \
                  (A(14, 3) + A(14, 5) + A(14, 7) + A(14, 9) + A(14, 11) + A(14, 13)))

#define NYSTROM_STAGES_15_TO_17(STAGE, A)                                                                    \
    STAGE(15, (A(15, 1) + A(15, 4) + A(15, 6) + A(15, 8) + A(15, 10) + A(15, 12) + A(15, 14)) +              \
                  (A(15, 3) + A(15, 5) + A(15, 7) + A(15, 9) + A(15, 11) + A(15, 13)))                       \
    STAGE(16, (A(16, 1) + A(16, 4) + A(16, 6) + A(16, 8) + A(16, 10) + A(16, 12) + A(16, 14)) +              \
                  (A(16, 3) + A(16, 5) + A(16, 7) + A(16, 9) + A(16, 11) + A(16, 13) + A(16, 15)))           \
    STAGE(17, (A(17, 1) + A(17, 4) + A(17, 6) + A(17, 8) + A(17, 10) + A(17, 12) + A(17, 14)) +              \
                  (A(17, 3) + A(17, 5) + A(17, 7) + A(17, 9) + A(17, 11) + A(17, 13) + A(17, 15)))

/* sum w_j k_j for the weights b, d and those of order 10. */
#define NYSTROM_SUM(w, k)                                                                                    \
    (((w)[1] * (k)[1] + (w)[8] * (k)[8] + (w)[10] * (k)[10] + (w)[12] * (k)[12] + (w)[14] * (k)[14] +        \
      (w)[16] * (k)[16]) +                                                                                   \
     ((w)[7] * (k)[7] + (w)[9] * (k)[9] + (w)[11] * (k)[11] + (w)[13] * (k)[13] + (w)[15] * (k)[15] +        \
      (w)[17] * (k)[17]))

#endif
