/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What batches could bring: runs of a pendulum four abreast, by the compiler's vector types, in equal steps of dop853,
 * beside the same runs one after the other. A prototype: the library has no batches. Each lane is made by the operations
 * of the single run in the same order, so the ends have the same bits, which is checked.
 *
 * The sine is that of the mathematics library, lane by lane, or a polynomial that works on all lanes: with the library's
 * own sine, the sines are what is left.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "integrate/dop853_table.h"
#include "timing.h"

enum { lanes = 4, steps = 200, runs = 2000, rounds = 15 };

static const double g = 9.81, h = 0.05; /* 1/s^2 (length 1 m), s */

typedef double wide __attribute__((vector_size(lanes * sizeof(double))));
typedef long long bits __attribute__((vector_size(lanes * sizeof(long long))));

#define INLINE static inline __attribute__((always_inline))

/* Processors that have them use registers of four doubles, in one and the same program. */
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define CLONES __attribute__((target_clones("avx2", "default")))
#else
#define CLONES
#endif

/* ---- sines: reduced by multiples of pi in two parts (Cody and Waite), then Taylor's polynomial up to r^15; some 1e-11 off
 * at pi/2, which is enough to time it */

#define POLYNOMIAL_SINE(number, whole, x)                                                                    \
    const double round = 6755399441055744.0;                                                                 \
    number shifted = (x) * (1 / 3.141592653589793) + round, n = shifted - round;                             \
    number r = (x)-n * 3.141592653589793116 - n * 1.2246467991473532e-16, z = r * r;                         \
    number p = z * -7.6471637318198165e-13 + 1.6059043836821615e-10;                                         \
    p = p * z - 2.5052108385441719e-08;                                                                      \
    p = p * z + 2.7557319223985891e-06;                                                                      \
    p = p * z - 1.984126984126984e-04;                                                                       \
    p = p * z + 8.333333333333333e-03;                                                                       \
    p = p * z - 1.6666666666666666e-01;                                                                      \
    number sine = r + r * z * p;                                                                             \
    whole odd, image;                                                                                        \
    memcpy(&odd, &shifted, sizeof odd);                                                                      \
    memcpy(&image, &sine, sizeof image);                                                                     \
    image ^= (odd & 1) << 63;                                                                                \
    memcpy(&sine, &image, sizeof sine);

INLINE void library_sine(double *x)
{
    *x = sin(*x);
}

INLINE void library_sines(wide *x)
{
    for (int i = 0; i < lanes; i++) (*x)[i] = sin((*x)[i]);
}

INLINE void polynomial_sine(double *x)
{
    POLYNOMIAL_SINE(double, long long, *x)
    *x = sine;
}

INLINE void polynomial_sines(wide *x)
{
    POLYNOMIAL_SINE(wide, bits, *x)
    *x = sine;
}

/* ---- runs: `q` from rest, to where it is after all steps */

#define RUN(name, number, sine)                                                                              \
    CLONES static void name(const number *start, number *end)                                                \
    {                                                                                                        \
        number q = *start, v = q - q;                                                                        \
        for (int n = 0; n < steps; n++) {                                                                    \
            number k[13][2];                                                                                 \
            k[1][0] = v;                                                                                     \
            number at = q;                                                                                   \
            sine(&at);                                                                                       \
            k[1][1] = -g * at;                                                                               \
            for (int s = 2; s <= 13; s++) {                                                                  \
                number a = k[1][0] * dop853_a[s][1], b = k[1][1] * dop853_a[s][1];                           \
                for (int j = 2; j < s; j++) {                                                                \
                    if (dop853_a[s][j] == 0) continue;                                                       \
                    a += k[j][0] * dop853_a[s][j];                                                           \
                    b += k[j][1] * dop853_a[s][j];                                                           \
                }                                                                                            \
                if (s == 13) {                                                                               \
                    q += h * a;                                                                              \
                    v += h * b;                                                                              \
                    break;                                                                                   \
                }                                                                                            \
                k[s][0] = v + h * b;                                                                         \
                at = q + h * a;                                                                              \
                sine(&at);                                                                                   \
                k[s][1] = -g * at;                                                                           \
            }                                                                                                \
        }                                                                                                    \
        *end = q;                                                                                            \
    }

RUN(one_by_library, double, library_sine)
RUN(one_by_polynomial, double, polynomial_sine)
RUN(all_by_library, wide, library_sines)
RUN(all_by_polynomial, wide, polynomial_sines)

/* ---- side by side */

static double starts[runs], ends[4][runs];

static double time_of(int way)
{
    double begin = processor_seconds();
    for (int i = 0; i < runs; i += way < 2 ? 1 : lanes) {
        wide q, end;
        if (way == 0) one_by_library(&starts[i], &ends[0][i]);
        if (way == 1) one_by_polynomial(&starts[i], &ends[1][i]);
        if (way < 2) continue;
        memcpy(&q, &starts[i], sizeof q);
        if (way == 2) all_by_library(&q, &end);
        if (way == 3) all_by_polynomial(&q, &end);
        memcpy(&ends[way][i], &end, sizeof end);
    }
    return (processor_seconds() - begin) / runs;
}

int main(void)
{
    static double seconds[4][rounds], by_library[rounds], by_polynomial[rounds];
    for (int i = 0; i < runs; i++) starts[i] = 0.1 + 1e-3 * i;
    for (int round = 0; round < rounds; round++) {
        for (int way = 0; way < 4; way++) seconds[way][round] = time_of(way);
        by_library[round] = seconds[0][round] / seconds[2][round];
        by_polynomial[round] = seconds[1][round] / seconds[3][round];
    }
    bool same =
        memcmp(ends[0], ends[2], sizeof ends[0]) == 0 && memcmp(ends[1], ends[3], sizeof ends[1]) == 0;
    printf("pendulum, %d steps of dop853: %.1f us a run, four abreast %.1f us: %.2f times as many runs\n",
           steps, 1e6 * median(seconds[0], rounds), 1e6 * median(seconds[2], rounds),
           median(by_library, rounds));
    printf(
        "with a sine for all lanes at once: %.1f us a run, four abreast %.1f us: %.2f times as many runs\n",
        1e6 * median(seconds[1], rounds), 1e6 * median(seconds[3], rounds), median(by_polynomial, rounds));
    printf("the bits of the single runs: %s\n", same ? "yes" : "NO");
    return same ? 0 : 1;
}
