/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Double-double arithmetic: a number as the unevaluated sum of two doubles, x + rest with |rest| <= ulp(x) /
 * 2, which has some 32 digits.
 *
 * The rounding error of a sum and of a product of doubles is itself a double, and can be computed:
 *
 *     a + b = s + e,  s = fl(a + b),  z = fl(s - a),  e = fl(fl(a - fl(s - z)) + fl(b - z))    (Knuth)
 *     a * b = p + e,  p = fl(a * b),  e = fma(a, b, -p), rounded once
 *
 * exactly, for operands of any order of size, as long as nothing overflows and the product's error is not
 * denormal. The operations below add up such errors to first order, with an error of some eps^2 = 5e-32 of
 * the result (of the operands, where they cancel).
 *
 * Source: T. J. Dekker, A floating-point technique for extending the available precision, Numer. Math. 18
 * (1971) 224; D. E. Knuth, The Art of Computer Programming 2, 4.2.2; J.-M. Muller et al., Handbook of
 * Floating-Point Arithmetic, 2nd ed., 2018, chapter 14.
 */
#ifndef FBD_BASE_DOUBLE_DOUBLE_H
#define FBD_BASE_DOUBLE_DOUBLE_H

#include <math.h>

struct double_double {
    double x, rest;
};

/* The sum of two doubles, exactly. The rest of a sum that is not finite is 0. */
static inline struct double_double dd_sum(double a, double b)
{
    double s = a + b, z = s - a, rest = (a - (s - z)) + (b - z);
    return (struct double_double){s, isfinite(rest) ? rest : 0};
}

/* The product of two doubles, exactly. */
static inline struct double_double dd_product(double a, double b)
{
    double p = a * b, rest = isfinite(p) ? fma(a, b, -p) : 0;
    return (struct double_double){p, rest};
}

static inline double dd_value(struct double_double a)
{
    return a.x + a.rest;
}

/* a.x + b.x with the rests of both. */
static inline struct double_double dd_add(struct double_double a, struct double_double b)
{
    struct double_double s = dd_sum(a.x, b.x);
    return dd_sum(s.x, s.rest + (a.rest + b.rest));
}

static inline struct double_double dd_negate(struct double_double a)
{
    return (struct double_double){-a.x, -a.rest};
}

static inline struct double_double dd_subtract(struct double_double a, struct double_double b)
{
    return dd_add(a, dd_negate(b));
}

static inline struct double_double dd_multiply(struct double_double a, struct double_double b)
{
    struct double_double p = dd_product(a.x, b.x);
    double rest = p.rest + (a.x * b.rest + a.rest * b.x);
    return isfinite(rest) ? dd_sum(p.x, rest) : p;
}

/* The quotient q of the leading parts, corrected by the remainder a - q b. */
static inline struct double_double dd_divide(struct double_double a, struct double_double b)
{
    double q = a.x / b.x;
    struct double_double p = dd_product(q, b.x);
    double rest = ((a.x - p.x) - p.rest + a.rest - q * b.rest) / b.x;
    return isfinite(rest) ? dd_sum(q, rest) : (struct double_double){q, 0};
}

#endif
