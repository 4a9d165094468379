/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Intervals: interval arithmetic with outward rounding.
 *
 * The result of an operation contains every value of the operation for operands in their ranges. An end is
 * moved outward by a relative amount that exceeds the rounding error of the operation, and for functions that
 * of the mathematical library (4 units in the last place; glibc states at most 2 for those in use). So zero
 * stays zero, and exact results stay within one rounding. Not covered: results below 1e-307, whose rounding
 * is absolute; they are zero for all purposes here.
 *
 * Where a function is undefined for a part of an operand, as ln and sqrt below zero, it is evaluated for the
 * remaining part: elsewhere the formula itself has no value, and a run that gets there ends. Results that are
 * undefined or unbounded otherwise have the range of everything.
 *
 * Source: R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009.
 */
#ifndef FBD_EXPR_INTERVAL_H
#define FBD_EXPR_INTERVAL_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

struct interval {
    double low, high;
};

static inline struct interval interval_point(double x)
{
    return (struct interval){x, x};
}

static inline struct interval interval_everything(void)
{
    return (struct interval){-HUGE_VAL, HUGE_VAL};
}

static inline double interval_width(struct interval a)
{
    return a.high - a.low;
}

/* The largest magnitude. */
static inline double interval_size(struct interval a)
{
    return fmax(fabs(a.low), fabs(a.high));
}

static inline bool interval_has_zero(struct interval a)
{
    return a.low <= 0 && a.high >= 0;
}

/* Round outward by `units` roundings; NaN, from infinite ends, becomes everything. */
static inline struct interval interval_widen(double low, double high, double units)
{
    low -= units * DBL_EPSILON * fabs(low);
    high += units * DBL_EPSILON * fabs(high);
    return (struct interval){low == low ? low : -HUGE_VAL, high == high ? high : HUGE_VAL};
}

static inline struct interval interval_negate(struct interval a)
{
    return (struct interval){-a.high, -a.low};
}

/* All numbers within `radius` of the centre. */
static inline struct interval interval_around(double centre, double radius)
{
    return interval_widen(centre - radius, centre + radius, 1);
}

static inline struct interval interval_add(struct interval a, struct interval b)
{
    return interval_widen(a.low + b.low, a.high + b.high, 1);
}

static inline struct interval interval_subtract(struct interval a, struct interval b)
{
    return interval_widen(a.low - b.high, a.high - b.low, 1);
}

/* Without the NaN handling of fmin and fmax, which costs a call. */
static inline double interval_lesser(double x, double y)
{
    return x < y ? x : y;
}

static inline double interval_larger(double x, double y)
{
    return x > y ? x : y;
}

/* Zero times an infinite end is zero: the values in a range are finite. */
static inline double interval_product(double x, double y)
{
    return x == 0 || y == 0 ? 0 : x * y;
}

/* Operands of zero width, such as constants, are common. */
static inline struct interval interval_multiply(struct interval a, struct interval b)
{
    double p = interval_product(a.low, b.low), q = interval_product(a.high, b.high);
    if (a.low == a.high || b.low == b.high)
        return interval_widen(interval_lesser(p, q), interval_larger(p, q), 1);
    double r = interval_product(a.low, b.high), s = interval_product(a.high, b.low);
    return interval_widen(interval_lesser(interval_lesser(p, q), interval_lesser(r, s)),
                          interval_larger(interval_larger(p, q), interval_larger(r, s)), 1);
}

static inline struct interval interval_scale(double k, struct interval a)
{
    double p = interval_product(k, a.low), q = interval_product(k, a.high);
    return k < 0 ? interval_widen(q, p, 1) : interval_widen(p, q, 1);
}

static inline struct interval interval_hull(struct interval a, struct interval b)
{
    return (struct interval){fmin(a.low, b.low), fmax(a.high, b.high)};
}

/* The intersection; a if rounding made that empty. */
static inline struct interval interval_meet(struct interval a, struct interval b)
{
    double low = interval_larger(a.low, b.low), high = interval_lesser(a.high, b.high);
    return low <= high ? (struct interval){low, high} : a;
}

struct interval interval_divide(struct interval a, struct interval b);
struct interval interval_whole_power(struct interval a, int n);
struct interval interval_power(struct interval a, struct interval b);
struct interval interval_hypot(struct interval a, struct interval b);
struct interval interval_sin(struct interval a);
struct interval interval_cos(struct interval a);
struct interval interval_tan(struct interval a);
struct interval interval_atan2(struct interval y, struct interval x);
struct interval interval_cosh(struct interval a);

/* An increasing function with the domain [low, high], for the part of `a` in it. */
struct interval interval_rising(double (*f)(double), struct interval a, double low, double high);

/* ---- functions of time */

/* Bounds of a function f on a time interval [m - radius, m + radius]. The width of `middle` bounds the
 * rounding error of f as a program computes it. */
struct enclosure {
    struct interval value, rate; /* of f and of df/dt over the interval */
    struct interval middle;      /* of f(m) */
};

/* A time interval, and a point near its middle. */
struct stretch {
    double from, to, middle;
};

static inline struct stretch stretch_between(double from, double to)
{
    return (struct stretch){from, to, from + (to - from) / 2};
}

static inline double stretch_radius(const struct stretch *stretch)
{
    return interval_larger(stretch->to - stretch->middle, stretch->middle - stretch->from);
}

static inline struct enclosure enclosure_point(double x)
{
    return (struct enclosure){interval_point(x), {0, 0}, interval_point(x)};
}

static inline struct enclosure enclosure_everything(void)
{
    return (struct enclosure){interval_everything(), interval_everything(), interval_everything()};
}

/* The mean value theorem: f also lies in f(m) + f'([..]) [-radius, radius], a bound whose excess decreases
 * with the square of the radius. */
static inline void enclosure_centre(struct enclosure *f, double radius)
{
    struct interval reach = interval_multiply(f->rate, (struct interval){-radius, radius});
    f->value = interval_meet(f->value, interval_add(f->middle, reach));
}

static inline struct enclosure enclosure_negate(struct enclosure f)
{
    return (struct enclosure){interval_negate(f.value), interval_negate(f.rate), interval_negate(f.middle)};
}

static inline struct enclosure enclosure_add(struct enclosure f, struct enclosure g)
{
    return (struct enclosure){interval_add(f.value, g.value), interval_add(f.rate, g.rate),
                              interval_add(f.middle, g.middle)};
}

static inline struct enclosure enclosure_subtract(struct enclosure f, struct enclosure g)
{
    return enclosure_add(f, enclosure_negate(g));
}

static inline struct enclosure enclosure_scale(double k, struct enclosure f)
{
    return (struct enclosure){interval_scale(k, f.value), interval_scale(k, f.rate),
                              interval_scale(k, f.middle)};
}

static inline struct enclosure enclosure_multiply(struct enclosure f, struct enclosure g)
{
    struct interval rate =
        interval_add(interval_multiply(f.rate, g.value), interval_multiply(f.value, g.rate));
    return (struct enclosure){interval_multiply(f.value, g.value), rate,
                              interval_multiply(f.middle, g.middle)};
}

#endif
