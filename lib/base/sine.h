/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sine by operations that every processor rounds alike, one number at a time or in vectors: a run computed
 * alone and in a SIMD batch (batch.h) has the same bits, with every mathematics library.
 *
 * Derivation. x = n pi/2 + r with the integer n nearest to x 2/pi. pi/2 is the sum of three parts; the first
 * two have 33 bits, so that n times each of them, and with it both differences, are exact up to n = 2^20 (W.
 * J. Cody, W. Waite, Software Manual for the Elementary Functions, 1980). r is kept as y0 + y1. The third
 * part and its product are rounded, with a total error of n 2^-120: checked for each n, for the double
 * nearest to n pi/2 this error is 0.24 of the rounding of r up to n = 14,500, and 0.76 up to 2^17. Then sin r
 * or cos r, depending on n, by the polynomials of fdlibm (K. C. Ng, Sun Microsystems, 1993: k_sin.c,
 * k_cos.c), summed in an order with few dependent operations: where each state depends on the one before,
 * latency is the cost of a sine. Measured against quadruple precision: at most 0.79 of a rounding of the
 * result.
 *
 * Beyond 20,000 rad, and for infinity and NaN, the result is that of the mathematics library.
 */
#ifndef FBD_BASE_SINE_H
#define FBD_BASE_SINE_H

#include <math.h>
#include <string.h>

#include "base/vec.h"

/* The largest |x| that is reduced here. */
#define SINE_MOST 20000.0

/* For a scalar or vector x: y0 + y1 = r; the last two bits of `shifted` are those of n. */
#define SINE_REDUCE(number, x, shifted, y0, y1)                                                              \
    do {                                                                                                     \
        const double whole_ = 6755399441055744.0; /* 1.5 2^52, whose last bit is 1 */                        \
        (shifted) = (x)*0.63661977236758138 + whole_;                                                        \
        const number n_ = (shifted)-whole_, a_ = (x)-n_ * 1.5707963267341256,                                \
                     b_ = n_ * 6.0771005063039657e-11;                                                       \
        (y0) = a_ - b_;                                                                                      \
        (y1) = ((a_ - (y0)) - b_) - n_ * 2.0222662487959506e-21;                                             \
    } while (0)

/* sin(y0 + y1), given z = y0^2, */
#define SINE_OF_REST(number, y0, y1, z, result)                                                              \
    do {                                                                                                     \
        const number w_ = (z) * (z),                                                                         \
                     p_ = (8.33333333332248946124e-03 + (z) * -1.98412698298579493134e-04) +                 \
                          w_ * ((2.75573137070700676789e-06 + (z) * -2.50507602534068634195e-08) +           \
                                w_ * 1.58969099521155010221e-10);                                            \
        (result) = (y0) - ((0.5 * (z) * (y1) - (y1)) - (z) * (y0) * (-1.66666666666666324348e-01 + (z)*p_)); \
    } while (0)

/* and cos(y0 + y1). */
#define COSINE_OF_REST(number, y0, y1, z, result)                                                            \
    do {                                                                                                     \
        const number w_ = (z) * (z), half_ = 0.5 * (z), one_ = 1.0 - half_,                                  \
                     g_ = (4.16666666666666019037e-02 + (z) * -1.38888888888741095749e-03) +                 \
                          w_ * ((2.48015872894767294178e-05 + (z) * -2.75573143513906633035e-07) +           \
                                w_ * (2.08757232129817482790e-09 + (z) * -1.13596475577881948265e-11));      \
        (result) = one_ + ((((1.0 - one_) - half_) - (y0) * (y1)) + w_ * g_);                                \
    } while (0)

static inline double sine(double x)
{
    if (!(fabs(x) <= SINE_MOST)) return sin(x);
    unsigned long long quarter;
    double shifted, y0, y1, result;
    SINE_REDUCE(double, x, shifted, y0, y1);
    memcpy(&quarter, &shifted, sizeof quarter);
    const double z = y0 * y0;
    if (quarter & 1)
        COSINE_OF_REST(double, y0, y1, z, result);
    else
        SINE_OF_REST(double, y0, y1, z, result);
    return quarter & 2 ? -result : result;
}

/* Cosine and sine of an angle. */
static inline void cosine_and_sine(double x, double *cosine, double *sine)
{
    if (!(fabs(x) <= SINE_MOST)) {
        *cosine = cos(x);
        *sine = sin(x);
        return;
    }
    unsigned long long quarter;
    double shifted, y0, y1, of_even, of_odd;
    SINE_REDUCE(double, x, shifted, y0, y1);
    memcpy(&quarter, &shifted, sizeof quarter);
    const double z = y0 * y0;
    SINE_OF_REST(double, y0, y1, z, of_even);
    COSINE_OF_REST(double, y0, y1, z, of_odd);
    const double s = quarter & 1 ? of_odd : of_even, c = quarter & 1 ? of_even : of_odd;
    *sine = quarter & 2 ? -s : s;
    *cosine = (quarter + 1) & 2 ? -c : c;
}

/* vec_unit by these functions: in the right-hand sides of small trees. */
static inline struct vec unit_by_sine(double angle)
{
    struct vec unit;
    cosine_and_sine(angle, &unit.x, &unit.y);
    return vec_without_rounding(unit);
}

/* The unit vector at `angle`, given the one at an angle `from`: if that is near, by the series of sine and
 * cosine, exact to rounding. */
static inline struct vec unit_turned_on(struct vec unit, double from, double angle)
{
    const double near = 5e-6, by = angle - from, half = by * by / 2;
    if (!(fabs(by) <= near)) return unit_by_sine(angle);
    return vec_without_rounding(
        (struct vec){unit.x - (half * unit.x + by * unit.y), unit.y - (half * unit.y - by * unit.x)});
}

#endif
