/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/dtoa_shortest.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* 128 bits hold all products here. Compilers for 32 bits have no such integer; there every fraction returns
 * -1. */
#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 wide;
static const bool is_wide = true;
#else
typedef uint64_t wide;
static const bool is_wide = false;
#endif

enum { most_digits = 17, greatest_scale = 27, mantissa_bits = 52, exponent_bias = 1075 };

static const uint64_t least_mantissa = UINT64_C(1) << mantissa_bits;

/* |value| 10^scale = m u / d = whole + rest / d exactly, with 17 digits in `whole`: u / d is one unit in the last place
 * of the value. */
struct scaled {
    uint64_t m, whole;
    wide u, d, rest;
    int exponent; /* of the first digit */
};

static uint64_t power_of_five(int exponent)
{
#define FIVE_POWERS(five) (five), (five)*5, (five)*25
    static const uint64_t powers[] = {FIVE_POWERS(UINT64_C(1)),
                                      FIVE_POWERS(UINT64_C(125)),
                                      FIVE_POWERS(UINT64_C(15625)),
                                      FIVE_POWERS(UINT64_C(1953125)),
                                      FIVE_POWERS(UINT64_C(244140625)),
                                      FIVE_POWERS(UINT64_C(30517578125)),
                                      FIVE_POWERS(UINT64_C(3814697265625)),
                                      FIVE_POWERS(UINT64_C(476837158203125)),
                                      FIVE_POWERS(UINT64_C(59604644775390625)),
                                      UINT64_C(7450580596923828125)}; /* 5^27 < 2^63 */
#undef FIVE_POWERS
    return powers[exponent];
}

/* m 2^twos 5^scale. Of numbers with 17 digits before the point no shift is longer than 63 bits. */
static void scale_by(struct scaled *scaled, int twos, int scale)
{
    uint64_t five = power_of_five(scale >= 0 ? scale : -scale);
    scaled->u = scale >= 0 ? five : 1;
    scaled->d = scale >= 0 ? 1 : five;
    if (twos >= 0)
        scaled->u <<= twos;
    else
        scaled->d <<= -twos;
    wide number = scaled->m * scaled->u;
    if (scale >= 0 && twos < 0) { /* usual: the denominator is a power of two */
        scaled->whole = (uint64_t)(number >> -twos);
        scaled->rest = number & (scaled->d - 1);
        return;
    }
    scaled->whole = (uint64_t)(number / scaled->d);
    scaled->rest = number - scaled->whole * scaled->d;
}

static const uint64_t ten_to_16 = UINT64_C(10000000000000000);

/* Scale a number above 0 to 17 digits before the point; false outside the supported range. */
static bool scale_to_17(double value, struct scaled *scaled)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    int exponent = (int)(bits >> mantissa_bits) - exponent_bias, log2 = exponent + mantissa_bits;
    scaled->m = (bits & (least_mantissa - 1)) | least_mantissa;
    scaled->exponent = (int)((log2 * INT64_C(1292913986)) >> 32); /* of 2^log2: the same or one less */
    for (int tries = 0; tries < 2; tries++, scaled->exponent++) {
        const int scale = most_digits - 1 - scaled->exponent;
        if (scale < -greatest_scale || scale > greatest_scale) return false;
        scale_by(scaled, exponent + scale, scale);
        if (scaled->whole / 10 < ten_to_16) return true;
    }
    return false;
}

/* The nearest integer to the number over `step`, halves to the even one, as printf rounds. */
static uint64_t round_to(const struct scaled *scaled, uint64_t step)
{
    uint64_t floor = scaled->whole / step;
    wide rest = 2 * ((scaled->whole - floor * step) * scaled->d + scaled->rest), unit = step * scaled->d;
    return floor + (rest > unit || (rest == unit && (floor & 1)));
}

/* A decimal reads back as the value if it is within half a unit of its last place; at exactly half a unit if
 * the value is the even one. Below a power of two the unit is half as large. */
static bool reads_back(const struct scaled *scaled, uint64_t decimal, uint64_t step)
{
    uint64_t there = decimal * step;
    bool above = there > scaled->whole;
    wide apart = above ? (there - scaled->whole) * scaled->d - scaled->rest
                       : (scaled->whole - there) * scaled->d + scaled->rest;
    apart *= !above && scaled->m == least_mantissa ? 4 : 2;
    return apart < scaled->u || (apart == scaled->u && scaled->m % 2 == 0);
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
    memcpy(at, digits, (size_t)before);
    at += before;
    if (last > before) {
        *at++ = '.';
        for (int i = exponent + 1; fixed && i < 0; i++) *at++ = '0';
        memcpy(at, digits + before, (size_t)(last - before));
        at += last - before;
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

/* Write eight digits, two by two. */
static void write_eight(char *digits, uint32_t part)
{
    static const char pairs[] = "00010203040506070809"
                                "10111213141516171819"
                                "20212223242526272829"
                                "30313233343536373839"
                                "40414243444546474849"
                                "50515253545556575859"
                                "60616263646566676869"
                                "70717273747576777879"
                                "80818283848586878889"
                                "90919293949596979899";
    const size_t high = part / 10000, low = part % 10000;
    memcpy(digits, pairs + 2 * (high / 100), 2);
    memcpy(digits + 2, pairs + 2 * (high % 100), 2);
    memcpy(digits + 4, pairs + 2 * (low / 100), 2);
    memcpy(digits + 6, pairs + 2 * (low % 100), 2);
}

/* An integer of 17 digits, rounded to `count` of them, whose first is worth 10^exponent. */
static int write_decimal(char *buffer, uint64_t decimal, int count, int exponent)
{
    const uint64_t half = UINT64_C(100000000);
    char digits[most_digits];
    digits[0] = (char)('0' + decimal / (half * half));
    write_eight(digits + 1, (uint32_t)(decimal / half % half));
    write_eight(digits + 9, (uint32_t)(decimal % half));
    return write(buffer, digits, count, exponent);
}

/* The part common to all functions: the check of the range, which leaves out subnormal numbers. False outside it. */
static bool begin(struct scaled *scaled, double value)
{
    return is_wide && value != 0 && isfinite(value) && scale_to_17(fabs(value), scaled);
}

/* Write a decimal of so many digits, in units of `step`; rounding of 9.99... may have given 10. */
static int write_rounded(char *buffer, bool minus, uint64_t decimal, uint64_t step, int digits, int exponent)
{
    uint64_t all = decimal * step;
    bool carried = all / 10 >= ten_to_16;
    if (minus) *buffer++ = '-';
    return minus + write_decimal(buffer, carried ? all / 10 : all, digits, exponent + carried);
}

/* Write the digits of an integer, without a power of ten. */
static int write_whole(char *buffer, uint64_t whole)
{
    int count = 1;
    for (uint64_t rest = whole; rest >= 10; rest /= 10) count++;
    for (int i = count; i-- > 0; whole /= 10) buffer[i] = (char)('0' + whole % 10);
    buffer[count] = '\0';
    return count;
}

/* Can a multiple of 100 be within half a unit of the last place, which is at most 10^17 / 2^53 < 12? */
static bool may_have_15_digits(const struct scaled *scaled)
{
    uint64_t off = scaled->whole % 100;
    return off < 12 || off >= 100 - 12;
}

int dtoa_shortest(char buffer[dtoa_size], double value)
{
    const double largest_whole = 1e15;
    struct scaled scaled;
    if (value >= 0 && value < largest_whole && !signbit(value) && value == (double)(uint64_t)value)
        return write_whole(buffer, (uint64_t)value);
    if (!begin(&scaled, value)) return -1;
    uint64_t step = may_have_15_digits(&scaled) ? 100 : 10;
    for (int digits = step == 100 ? most_digits - 2 : most_digits - 1;; digits++, step /= 10) {
        uint64_t decimal = round_to(&scaled, step);
        if (digits == most_digits || reads_back(&scaled, decimal, step))
            return write_rounded(buffer, value < 0, decimal, step, digits, scaled.exponent);
    }
}

int dtoa_rounded(char buffer[dtoa_size], double value, int digits)
{
    struct scaled scaled;
    if (digits < 1 || digits > most_digits) return -1;
    if (value == 0 && !signbit(value)) return write(buffer, "0", 1, 0);
    if (!begin(&scaled, value)) return -1;
    uint64_t step = 1;
    for (int i = digits; i < most_digits; i++) step *= 10;
    return write_rounded(buffer, value < 0, round_to(&scaled, step), step, digits, scaled.exponent);
}
