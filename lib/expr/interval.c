/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/interval.h"

/* Error bound of functions of the mathematical library, in units of DBL_EPSILON. */
static const double library = 4;

static const double pi = 3.14159265358979323846;

struct interval interval_divide(struct interval a, struct interval b)
{
    if (interval_has_zero(b)) return a.low == 0 && a.high == 0 ? a : interval_everything();
    return interval_multiply(a, interval_widen(1 / b.high, 1 / b.low, 1));
}

/* x^n for x >= 0 and n >= 1 by multiplication, as in the programs: the error grows with the number of
 * products. */
static double power_of(double x, int n)
{
    double product = 1;
    while (n > 0) {
        if (n & 1) product *= x;
        n >>= 1;
        x *= x;
    }
    return product;
}

struct interval interval_whole_power(struct interval a, int n)
{
    enum { most = 1 << 20 };
    if (n == 0) return interval_point(1);
    if (n > most || n < -most) return interval_everything();
    if (n < 0) return interval_divide(interval_point(1), interval_whole_power(a, -n));
    if (n == 1) return a;
    double low = power_of(fabs(a.low), n), high = power_of(fabs(a.high), n);
    if (n % 2 != 0) return interval_widen(copysign(low, a.low), copysign(high, a.high), n);
    if (interval_has_zero(a)) return interval_widen(0, fmax(low, high), n);
    return interval_widen(fmin(low, high), fmax(low, high), n);
}

struct interval interval_rising(double (*f)(double), struct interval a, double low, double high)
{
    double from = fmin(fmax(a.low, low), high), to = fmin(fmax(a.high, low), high);
    return interval_widen(f(from), f(to), library);
}

/* Powers with a constant exponent are monotone in the base; others are e^(b ln a). */
struct interval interval_power(struct interval a, struct interval b)
{
    double low = fmax(a.low, 0), high = fmax(a.high, 0);
    if (b.low != b.high) {
        struct interval logarithm = interval_rising(log, (struct interval){low, high}, 0, HUGE_VAL);
        return interval_rising(exp, interval_multiply(b, logarithm), -HUGE_VAL, HUGE_VAL);
    }
    if (a.low < 0 && b.low == floor(b.low))
        return interval_everything(); /* a whole exponent: also defined below zero */
    double from = pow(low, b.low), to = pow(high, b.low);
    return interval_widen(fmin(from, to), fmax(from, to), library);
}

struct interval interval_hypot(struct interval a, struct interval b)
{
    double low = hypot(interval_has_zero(a) ? 0 : fmin(fabs(a.low), fabs(a.high)),
                       interval_has_zero(b) ? 0 : fmin(fabs(b.low), fabs(b.high)));
    return interval_widen(low, hypot(interval_size(a), interval_size(b)), library);
}

/* True if the range contains a point x0 + 2 pi k, also if that is undecided by rounding. */
static bool has_place(struct interval a, double x0)
{
    const double turn = 2 * pi, rounding = 4 * DBL_EPSILON;
    double doubt = rounding * (fabs(x0) + interval_size(a));
    double k = ceil((a.low - doubt - x0) / turn);
    return x0 + k * turn <= a.high + 2 * doubt;
}

/* The range of a wave: its values at the ends, and its crest and trough if they are inside. */
static struct interval wave(struct interval a, double from, double to, double crest)
{
    if (!(interval_width(a) < 2 * pi)) return (struct interval){-1, 1};
    struct interval ends = interval_widen(fmin(from, to), fmax(from, to), library);
    ends.low = has_place(a, crest - pi) ? -1 : fmax(ends.low, -1);
    ends.high = has_place(a, crest) ? 1 : fmin(ends.high, 1);
    return ends;
}

/* sin and cos are not evaluated at infinite ends. */
struct interval interval_sin(struct interval a)
{
    if (!(interval_width(a) < HUGE_VAL)) return (struct interval){-1, 1};
    return wave(a, sin(a.low), a.high == a.low ? sin(a.low) : sin(a.high), pi / 2);
}

struct interval interval_cos(struct interval a)
{
    if (!(interval_width(a) < HUGE_VAL)) return (struct interval){-1, 1};
    return wave(a, cos(a.low), a.high == a.low ? cos(a.low) : cos(a.high), 0);
}

struct interval interval_tan(struct interval a)
{
    if (interval_has_zero(interval_cos(a))) return interval_everything();
    return interval_widen(tan(a.low), tan(a.high), library);
}

/* Over a rectangle that does not touch the cut y = 0, x <= 0, the angle has its extremes at the corners. */
struct interval interval_atan2(struct interval y, struct interval x)
{
    if (x.low <= 0 && interval_has_zero(y)) return interval_widen(-pi, pi, library);
    const double corner[4] = {atan2(y.low, x.low), atan2(y.low, x.high), atan2(y.high, x.low),
                              atan2(y.high, x.high)};
    double low = corner[0], high = corner[0];
    for (int k = 1; k < 4; k++) {
        low = fmin(low, corner[k]);
        high = fmax(high, corner[k]);
    }
    return interval_widen(low, high, library);
}

struct interval interval_cosh(struct interval a)
{
    double least = interval_has_zero(a) ? 0 : fmin(fabs(a.low), fabs(a.high));
    return interval_widen(cosh(least), cosh(interval_size(a)), library);
}
