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

enum {
    most_digits = 17,
    greatest_scale = 27,
    mantissa_bits = 52,
    exponent_bias = 1075,
    fraction_bits = 4 * sizeof(wide)
};

static const uint64_t least_mantissa = UINT64_C(1) << mantissa_bits, ten_to_17 = UINT64_C(100000000000000000);

/* |value| 10^scale exactly, with 17 digits before the binary point and `fraction_bits` behind it, and half a unit in the
 * last place of the value. */
struct scaled {
    wide number, half;
    uint64_t m;   /* the mantissa of the value */
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

static uint64_t whole_of(const struct scaled *scaled)
{
    return (uint64_t)(scaled->number >> fraction_bits);
}

/* Scale |value|, of the supported range. Between powers of two log2 is at least linear in the mantissa, which the bits
 * below the exponent are: the exponent of ten is right, or, for few numbers, one too small. The product is
 * m 5^scale 2^(exponent + scale), with at most 62 bits behind the point. */
static inline struct scaled scale_to_17(double value)
{
    enum { kept_bits = 20 }; /* of the mantissa */
    const double size = fabs(value);
    struct scaled scaled;
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    int exponent = (int)(bits >> mantissa_bits) - exponent_bias;
    int64_t log2 = (int64_t)(bits >> (mantissa_bits - kept_bits)) -
                   ((int64_t)(exponent_bias - mantissa_bits) << kept_bits);
    scaled.m = (bits & (least_mantissa - 1)) | least_mantissa;
    scaled.exponent =
        (int)((log2 * INT64_C(1292913986)) >> (32 + kept_bits)); /* log10(2) 2^32, rounded down */
    for (;; scaled.exponent++) {
        const int scale = most_digits - 1 - scaled.exponent, shift = fraction_bits + exponent + scale;
        const uint64_t five = power_of_five(scale);
        scaled.half = (wide)(five >> (fraction_bits + 1 - shift)) << fraction_bits | five << (shift - 1);
        scaled.number = 2 * scaled.m * scaled.half;
        if (whole_of(&scaled) < ten_to_17) return scaled;
    }
}

/* A decimal of fewer digits, as an integer of 17; and how far it is from the number. */
struct decimal {
    uint64_t value;
    wide apart;
};

/* The nearest multiple of `step`, halves to the even one, as printf rounds. */
static inline struct decimal round_to(const struct scaled *scaled, uint64_t step)
{
    uint64_t whole = whole_of(scaled), floor = whole / step, low = floor * step;
    wide below = scaled->number - ((wide)low << fraction_bits), above = ((wide)step << fraction_bits) - below;
    bool down = below < above || (below == above && floor % 2 == 0);
    return down ? (struct decimal){low, below} : (struct decimal){low + step, above};
}

/* A decimal reads back as the value if it is within half a unit of its last place; at exactly half a unit if
 * the value is the even one. Below a power of two the unit is half as large. */
static inline bool reads_back(const struct scaled *scaled, struct decimal decimal)
{
    bool is_short = scaled->m == least_mantissa && decimal.value <= whole_of(scaled);
    wide half = is_short ? scaled->half / 2 : scaled->half;
    return decimal.apart < half || (decimal.apart == half && scaled->m % 2 == 0);
}

/* As %g writes `count` digits, the first of them worth 10^exponent. Copies of one size are some moves; their excess is
 * written over, or lies behind the end. */
static inline int write(char *buffer, const char digits[2 * most_digits], int count, int exponent)
{
    char *at = buffer;
    int last = count;
    while (last > 8 && memcmp(digits + last - 8, "00000000", 8) == 0) last -= 8;
    while (last > 1 && digits[last - 1] == '0') last--;
    bool fixed = exponent >= -4 && exponent < count;
    int before = !fixed ? 1 : exponent >= 0 ? exponent + 1 : 0; /* digits before the point */
    if (before == 0) *at++ = '0';
    memcpy(at, digits, most_digits);
    at += before;
    if (last > before) {
        memcpy(at, ".000", 4);
        at += before == 0 ? -exponent : 1;
        memcpy(at, digits + before, most_digits);
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

enum { pair_bits = 57 };

/* Write the integer before the binary point of `rest`, two digits; returns 100 times the fraction. */
static inline uint64_t write_pair(char *digits, uint64_t rest)
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
    memcpy(digits, pairs + 2 * (rest >> pair_bits), 2);
    return 100 * (rest & ((UINT64_C(1) << pair_bits) - 1));
}

/* Write eight digits: the integers of part / 10^6 times 1, 100, 100^2 and 100^3, with 57 bits behind the binary point,
 * which leave room for 100 before it. The quotient is too large by less than 10^8 / 2^57, and 100^3 times that is less
 * than one. */
static inline void write_eight(char *digits, uint32_t part)
{
    uint64_t rest = part * ((UINT64_C(1) << pair_bits) / 1000000 + 1);
    rest = write_pair(digits, rest);
    rest = write_pair(digits + 2, rest);
    rest = write_pair(digits + 4, rest);
    write_pair(digits + 6, rest);
}

/* Write an integer of 17 digits, rounded to `count` of them, whose first is worth 10^exponent; rounding of 9.99... may
 * have given 18. */
static inline __attribute__((always_inline)) int write_decimal(char *buffer, bool minus, uint64_t decimal,
                                                               int count, int exponent)
{
    const uint64_t half = UINT64_C(100000000);
    char digits[2 * most_digits] = {0};
    bool carried = decimal >= ten_to_17;
    if (carried) decimal /= 10;
    uint64_t high = decimal / half, first = high / half;
    digits[0] = (char)('0' + first);
    write_eight(digits + 1, (uint32_t)(high - first * half));
    write_eight(digits + 9, (uint32_t)(decimal - high * half));
    *buffer = '-';
    return minus + write(buffer + minus, digits, count, exponent + carried);
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

static inline bool is_supported(double value)
{
    return is_wide && fabs(value) >= 1e-10 && fabs(value) < 1e15;
}

int dtoa_shortest(char buffer[dtoa_size], double value)
{
    if (fabs(value) < 1e15 && value == (double)(int64_t)value && !signbit(value))
        return write_whole(buffer, (uint64_t)value);
    if (!is_supported(value)) return -1;
    const struct scaled scaled = scale_to_17(value);
    struct decimal decimal = round_to(&scaled, 10);
    int digits = most_digits - 1;
    bool is_enough = reads_back(&scaled, decimal);
    if (is_enough ||
        scaled.m == least_mantissa) { /* or of 15 digits none does, as the nearest are no nearer */
        struct decimal shorter = round_to(&scaled, 100);
        if (reads_back(&scaled, shorter)) {
            is_enough = true;
            digits--;
            decimal = shorter;
        }
    }
    if (!is_enough) {
        digits = most_digits;
        decimal = round_to(&scaled, 1);
    }
    return write_decimal(buffer, value < 0, decimal.value, digits, scaled.exponent);
}

int dtoa_rounded(char buffer[dtoa_size], double value, int digits)
{
    if (digits < 1 || digits > most_digits) return -1;
    if (value == 0 && !signbit(value)) return write_whole(buffer, 0);
    if (!is_supported(value)) return -1;
    const struct scaled scaled = scale_to_17(value);
    uint64_t step = 1;
    for (int i = digits; i < most_digits; i++) step *= 10;
    return write_decimal(buffer, value < 0, round_to(&scaled, step).value, digits, scaled.exponent);
}
