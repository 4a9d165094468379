/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Twofold numbers: a number as the unevaluated sum of two doubles, x + rest with |rest| <= ulp(x) / 2, which
 * has some 32 digits.
 *
 * The rounding error of a sum and of a product of doubles is itself a double, and can be had:
 *
 *     a + b = s + e,  s = fl(a + b),  z = fl(s - a),  e = fl(fl(a - fl(s - z)) + fl(b - z))    (Knuth)
 *     a * b = p + e,  p = fl(a * b),  e = fma(a, b, -p), rounded once
 *
 * exactly, for operands of any order of size, as long as nothing overflows and the product's error is no
 * denormal number. The operations below add up such errors to first order and leave some eps^2 = 5e-32 of the
 * result (of the operands, where they cancel).
 *
 * Source: T. J. Dekker, A floating-point technique for extending the available precision, Numer. Math. 18
 * (1971) 224; D. E. Knuth, The Art of Computer Programming 2, 4.2.2; J.-M. Muller et al., Handbook of
 * Floating-Point Arithmetic, 2nd ed., 2018, chapter 14.
 */
#ifndef FBD_BASE_TWOFOLD_H
#define FBD_BASE_TWOFOLD_H

#include <math.h>

struct twofold {
    double x, rest;
};

/* The sum of two doubles, exactly. What is not finite has no rest. */
static inline struct twofold twofold_sum(double a, double b)
{
    double s = a + b, z = s - a, rest = (a - (s - z)) + (b - z);
    return (struct twofold){s, isfinite(rest) ? rest : 0};
}

/* The product of two doubles, exactly. */
static inline struct twofold twofold_product(double a, double b)
{
    double p = a * b, rest = isfinite(p) ? fma(a, b, -p) : 0;
    return (struct twofold){p, rest};
}

static inline double twofold_value(struct twofold a)
{
    return a.x + a.rest;
}

/* a.x + b.x with what both leave. */
static inline struct twofold twofold_add(struct twofold a, struct twofold b)
{
    struct twofold s = twofold_sum(a.x, b.x);
    return twofold_sum(s.x, s.rest + (a.rest + b.rest));
}

static inline struct twofold twofold_negate(struct twofold a)
{
    return (struct twofold){-a.x, -a.rest};
}

static inline struct twofold twofold_subtract(struct twofold a, struct twofold b)
{
    return twofold_add(a, twofold_negate(b));
}

static inline struct twofold twofold_multiply(struct twofold a, struct twofold b)
{
    struct twofold p = twofold_product(a.x, b.x);
    double rest = p.rest + (a.x * b.rest + a.rest * b.x);
    return isfinite(rest) ? twofold_sum(p.x, rest) : p;
}

/* The quotient q of the leading parts, and what a - q b leaves of it. */
static inline struct twofold twofold_divide(struct twofold a, struct twofold b)
{
    double q = a.x / b.x;
    struct twofold p = twofold_product(q, b.x);
    double rest = ((a.x - p.x) - p.rest + a.rest - q * b.rest) / b.x;
    return isfinite(rest) ? twofold_sum(q, rest) : (struct twofold){q, 0};
}

#endif
