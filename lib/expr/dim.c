/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/dim.h"

#include <limits.h>

/* Exponents saturate beyond +-2700: no quantity of mechanics comes near, and an overflow would be undefined. */
static short exponent(int twelfths)
{
    if (twelfths > SHRT_MAX) return SHRT_MAX;
    if (twelfths < SHRT_MIN) return SHRT_MIN;
    return (short)twelfths;
}

bool dim_equal(struct dim a, struct dim b)
{
    return a.mass == b.mass && a.length == b.length && a.time == b.time && a.current == b.current &&
           a.temperature == b.temperature;
}

struct dim dim_times(struct dim a, struct dim b)
{
    return (struct dim){exponent(a.mass + b.mass), exponent(a.length + b.length), exponent(a.time + b.time),
                        exponent(a.current + b.current), exponent(a.temperature + b.temperature)};
}

struct dim dim_over(struct dim a, struct dim b)
{
    return (struct dim){exponent(a.mass - b.mass), exponent(a.length - b.length), exponent(a.time - b.time),
                        exponent(a.current - b.current), exponent(a.temperature - b.temperature)};
}

static bool scale(short from, int numerator, int denominator, short *to)
{
    long long product = (long long)from * numerator;
    if (product % denominator != 0) return false;
    product /= denominator;
    if (product > SHRT_MAX || product < SHRT_MIN) return false;
    *to = (short)product;
    return true;
}

bool dim_power(struct dim a, int numerator, int denominator, struct dim *result)
{
    return denominator != 0 && scale(a.mass, numerator, denominator, &result->mass) &&
           scale(a.length, numerator, denominator, &result->length) &&
           scale(a.time, numerator, denominator, &result->time) &&
           scale(a.current, numerator, denominator, &result->current) &&
           scale(a.temperature, numerator, denominator, &result->temperature);
}
