/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/dtoa_shortest.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* 128 bits hold all products here. Compilers for 32 bits have no such integer; there every fraction returns
 * -1. */
#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 wide;
enum { wide_bits = 128 };
#else
typedef uint64_t wide;
enum { wide_bits = 64 };
#endif

enum { most_digits = 17, least_scale = -27, greatest_scale = 27 };

/* value 10^scale = m u / d exactly: u is one unit in the last place of the value. */
struct scaled {
    uint64_t m;
    wide u, d;
    bool known;
};

static uint64_t power_of_five(int exponent)
{
    uint64_t power = 1;
    for (int i = 0; i < exponent; i++) power *= 5; /* 5^27 < 2^63 */
    return power;
}

static bool lies_in(int value, int low, int high)
{
    return low <= value && value <= high;
}

static struct scaled scale_by(double value, int scale)
{
    enum { mantissa = 53, widest = wide_bits - 1, of_five = 63 };
    int exponent;
    struct scaled scaled = {.u = 1, .d = 1};
    scaled.m = (uint64_t)ldexp(frexp(value, &exponent), mantissa);
    int twos = exponent - mantissa + scale;
    if (!lies_in(scale, least_scale, greatest_scale) ||
        !lies_in(twos, of_five - widest, widest - mantissa - of_five))
        return scaled;
    scaled.known = true;
    *(scale >= 0 ? &scaled.u : &scaled.d) = power_of_five(scale >= 0 ? scale : -scale);
    *(twos >= 0 ? &scaled.u : &scaled.d) <<= twos >= 0 ? twos : -twos;
    return scaled;
}

/* The nearest integer to the number over 10^(17 - digits), halves to the even one, as printf rounds. */
static uint64_t round_to(const struct scaled *scaled, wide step)
{
    wide number = scaled->m * scaled->u, unit = step * scaled->d, floor = number / unit,
         rest = number - floor * unit;
    bool up = 2 * rest > unit || (2 * rest == unit && (floor & 1));
    return (uint64_t)floor + up;
}

/* A decimal reads back as the value if it is within half a unit of its last place; at exactly half a unit if
 * the value is the even one. */
static bool reads_back(const struct scaled *scaled, uint64_t decimal, wide step)
{
    wide number = scaled->m * scaled->u, there = decimal * step * scaled->d;
    wide apart = there > number ? there - number : number - there;
    return 2 * apart < scaled->u || (2 * apart == scaled->u && scaled->m % 2 == 0);
}

/* As %g writes `digits` digits, the first of them worth 10^exponent. */
static int write(char *buffer, const char *digits, int count, int exponent)
{
    char *at = buffer;
    int last = count;
    while (last > 1 && digits[last - 1] == '0') last--;
    bool fixed = exponent >= -4 && exponent < count;
    int before = !fixed ? 1 : exponent >= 0 ? exponent + 1 : 0; /* digits before the point */
    if (before == 0) *at++ = '0';
    for (int i = 0; i < before; i++) *at++ = i < last ? digits[i] : '0';
    if (last > before) {
        *at++ = '.';
        for (int i = exponent + 1; fixed && i < 0; i++) *at++ = '0';
        for (int i = before; i < last; i++) *at++ = digits[i];
    }
    if (!fixed) {
        int size = exponent < 0 ? -exponent : exponent;
        *at++ = 'e';
        *at++ = exponent < 0 ? '-' : '+';
        *at++ = (char)('0' + size / 10);
        *at++ = (char)('0' + size % 10);
    }
    *at = '\0';
    return (int)(at - buffer);
}

static int write_decimal(char *buffer, uint64_t decimal, int count, int exponent)
{
    char digits[most_digits];
    for (int i = count; i-- > 0; decimal /= 10) digits[i] = (char)('0' + decimal % 10);
    return write(buffer, digits, count, exponent);
}

static const uint64_t ten_to_16 = UINT64_C(10000000000000000);

/* Scale the number to 17 digits before the point; false outside the supported range. `exponent` is that of
 * the first digit. */
static bool scale_to_17(double value, struct scaled *scaled, int *exponent)
{
    *exponent = (int)floor(log10(value));
    for (int tries = 0; tries < 2; tries++) {
        *scaled = scale_by(value, most_digits - 1 - *exponent);
        if (!scaled->known) return false;
        uint64_t whole = (uint64_t)(scaled->m * scaled->u / scaled->d);
        if (whole < ten_to_16)
            --*exponent; /* the logarithm was rounded up */
        else if (whole / 10 >= ten_to_16)
            ++*exponent;
        else
            return true;
    }
    return false;
}

/* The part common to all functions: the sign, and the check of the range. False outside it. */
static bool begin(struct scaled *scaled, int *exponent, double value)
{
    return value != 0 && isfinite(value) && scale_to_17(fabs(value), scaled, exponent);
}

/* Write a decimal of so many digits; rounding of 9.99... may have given 10. */
static int write_rounded(char *buffer, bool minus, uint64_t decimal, int digits, uint64_t limit, int exponent)
{
    bool carried = decimal >= limit;
    if (minus) *buffer++ = '-';
    return minus + write_decimal(buffer, carried ? decimal / 10 : decimal, digits, exponent + carried);
}

/* Write the digits of an integer, without a power of ten. */
static int write_whole(char *buffer, uint64_t whole)
{
    char digits[most_digits];
    int first = most_digits;
    do digits[--first] = (char)('0' + whole % 10);
    while (whole /= 10);
    memcpy(buffer, digits + first, (size_t)(most_digits - first));
    buffer[most_digits - first] = '\0';
    return most_digits - first;
}

int dtoa_shortest(char buffer[dtoa_size], double value)
{
    const uint64_t least_mantissa = UINT64_C(1) << 52;
    const double largest_whole = 1e15;
    struct scaled scaled;
    int exponent;
    if (value >= 0 && value < largest_whole && !signbit(value) && value == (double)(uint64_t)value)
        return write_whole(buffer, (uint64_t)value);
    if (!begin(&scaled, &exponent, value)) return -1;
    if (scaled.m == least_mantissa) return -1; /* the distances to its neighbours differ */
    wide step = 100;
    uint64_t limit = ten_to_16 / 10;
    for (int digits = most_digits - 2; digits <= most_digits; digits++, step /= 10, limit *= 10) {
        uint64_t decimal = round_to(&scaled, step);
        if (digits == most_digits || reads_back(&scaled, decimal, step))
            return write_rounded(buffer, value < 0, decimal, digits, limit, exponent);
    }
    return -1;
}

int dtoa_rounded(char buffer[dtoa_size], double value, int digits)
{
    struct scaled scaled;
    int exponent;
    if (digits < 1 || digits > most_digits) return -1;
    if (value == 0 && !signbit(value)) return write(buffer, "0", 1, 0);
    if (!begin(&scaled, &exponent, value)) return -1;
    wide step = 1;
    uint64_t limit = 10 * ten_to_16;
    for (int i = digits; i < most_digits; i++, limit /= 10) step *= 10;
    return write_rounded(buffer, value < 0, round_to(&scaled, step), digits, limit, exponent);
}
