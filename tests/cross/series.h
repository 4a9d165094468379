/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Series in one variable to the second order: a quantity u, its first derivative u1 and its second u2, by the
 * rules of sum, product and chain. Everything geometric is written once, as a function of positions; what the
 * variable is (time, or one coordinate with the others held) decides whether the derivatives are rates or a
 * row of a Jacobian.
 */
#ifndef CROSS_SERIES_H
#define CROSS_SERIES_H

#include <math.h>

struct series {
    double u, u1, u2;
};

struct place {
    struct series x, y;
};

static inline struct series ser(double u)
{
    return (struct series){u, 0, 0};
}

static inline struct series ser_add(struct series a, struct series b)
{
    return (struct series){a.u + b.u, a.u1 + b.u1, a.u2 + b.u2};
}

static inline struct series ser_scale(double k, struct series a)
{
    return (struct series){k * a.u, k * a.u1, k * a.u2};
}

static inline struct series ser_sub(struct series a, struct series b)
{
    return ser_add(a, ser_scale(-1, b));
}

static inline struct series ser_mul(struct series a, struct series b)
{
    return (struct series){a.u * b.u, a.u1 * b.u + a.u * b.u1, a.u2 * b.u + 2 * a.u1 * b.u1 + a.u * b.u2};
}

/* f(a), given f and its derivatives at a. */
static inline struct series ser_chain(double f, double f1, double f2, struct series a)
{
    return (struct series){f, f1 * a.u1, f1 * a.u2 + f2 * a.u1 * a.u1};
}

static inline struct series ser_sin(struct series a)
{
    return ser_chain(sin(a.u), cos(a.u), -sin(a.u), a);
}

static inline struct series ser_cos(struct series a)
{
    return ser_chain(cos(a.u), -sin(a.u), -cos(a.u), a);
}

static inline struct series ser_sqrt(struct series a)
{
    double s = sqrt(a.u);
    return ser_chain(s, 0.5 / s, -0.25 / (s * a.u), a);
}

static inline struct series ser_inverse(struct series a)
{
    double s = 1 / a.u;
    return ser_chain(s, -s * s, 2 * s * s * s, a);
}

static inline struct place place_add(struct place a, struct place b)
{
    return (struct place){ser_add(a.x, b.x), ser_add(a.y, b.y)};
}

static inline struct place place_sub(struct place a, struct place b)
{
    return (struct place){ser_sub(a.x, b.x), ser_sub(a.y, b.y)};
}

static inline struct place place_scale(struct series k, struct place a)
{
    return (struct place){ser_mul(k, a.x), ser_mul(k, a.y)};
}

/* A quarter turn to the left. */
static inline struct place place_left(struct place a)
{
    return (struct place){ser_scale(-1, a.y), a.x};
}

static inline struct series place_dot(struct place a, struct place b)
{
    return ser_add(ser_mul(a.x, b.x), ser_mul(a.y, b.y));
}

static inline struct series place_cross(struct place a, struct place b)
{
    return ser_sub(ser_mul(a.x, b.y), ser_mul(a.y, b.x));
}

static inline struct series place_length(struct place a)
{
    return ser_sqrt(place_dot(a, a));
}

/* The direction of a as an angle: d(angle) = (a x da) / a^2. */
static inline struct series place_angle(struct place a)
{
    double r2 = a.x.u * a.x.u + a.y.u * a.y.u;
    double rate = (a.x.u * a.y.u1 - a.y.u * a.x.u1) / r2;
    double r2_rate = 2 * (a.x.u * a.x.u1 + a.y.u * a.y.u1);
    double second = (a.x.u * a.y.u2 - a.y.u * a.x.u2 - rate * r2_rate) / r2;
    return (struct series){atan2(a.y.u, a.x.u), rate, second};
}

#endif
