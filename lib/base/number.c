/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/number.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t digits(const char *text, size_t length, size_t from)
{
    size_t end = from;
    while (end < length && text[end] >= '0' && text[end] <= '9') end++;
    return end - from;
}

size_t number_length(const char *text, size_t length)
{
    size_t at = digits(text, length, 0), whole = at;
    if (at < length && text[at] == '.') {
        size_t fraction = digits(text, length, at + 1);
        if (whole == 0 && fraction == 0) return 0;
        at += 1 + fraction;
    }
    if (at == 0) return 0;
    if (at < length && (text[at] == 'e' || text[at] == 'E')) {
        size_t sign = at + 1 < length && (text[at + 1] == '+' || text[at + 1] == '-') ? 1 : 0;
        size_t exponent = digits(text, length, at + 1 + sign);
        if (exponent) at += 1 + sign + exponent;
    }
    return at;
}

/* Further digits affect the rounding only by whether one of them is not zero: the longest exact decimal
 * halfway between two doubles has 767 significant digits. */
enum { most_digits = 770, widest_exponent = 1000000 };

/* The whole number given by the first `count` characters of `text`, times 10^exponent. */
struct decimal {
    char text[most_digits + 16]; /* room for the exponent behind the digits */
    int count, exponent;
};

static void add_digit(struct decimal *d, char digit, bool fraction)
{
    bool leading_zero = d->count == 0 && digit == '0';
    if (!leading_zero && d->count < most_digits) {
        d->text[d->count++] = digit;
        if (fraction) d->exponent--;
        return;
    }
    if (leading_zero) {
        if (fraction) d->exponent--;
        return;
    }
    if (digit != '0') d->text[most_digits - 1] = '1';
    if (!fraction) d->exponent++;
}

static int read_exponent(const char *text, size_t length)
{
    bool negative = length > 0 && text[0] == '-';
    int value = 0;
    for (size_t i = length > 0 && (text[0] == '-' || text[0] == '+') ? 1 : 0; i < length; i++)
        if (value < widest_exponent) value = value * 10 + (text[i] - '0');
    return negative ? -value : value;
}

/* Whole numbers up to 2^53 and powers of ten up to 10^22 are exact doubles, so that their product or quotient
 * is rounded once (Clinger, How to read floating point numbers accurately, PLDI 1990). This covers most
 * numbers of files. */
static bool read_short(const struct decimal *d, double *value)
{
    enum { most_exact = 15, most_power = 22 };
    if (FLT_EVAL_METHOD != 0 || d->count > most_exact || d->exponent > most_power ||
        d->exponent < -most_power)
        return false;
    double whole = 0, power = 1;
    for (int i = 0; i < d->count; i++) whole = 10 * whole + (d->text[i] - '0');
    for (int i = d->exponent < 0 ? -d->exponent : d->exponent; i > 0; i--) power *= 10;
    *value = d->exponent < 0 ? whole / power : whole * power;
    return true;
}

/* The number is rewritten as whole digits and an exponent: strtod then rounds correctly, and needs no decimal
 * point, the only part of a plain number that depends on the locale. */
double number_value(const char *text, size_t length)
{
    struct decimal d = {.count = 0, .exponent = 0};
    bool fraction = false;
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '.') {
            fraction = true;
        } else if (text[i] == 'e' || text[i] == 'E') {
            d.exponent += read_exponent(text + i + 1, length - i - 1);
            break;
        } else {
            add_digit(&d, text[i], fraction);
        }
    }
    double value;
    if (d.count == 0) return 0;
    if (read_short(&d, &value)) return value;
    snprintf(d.text + d.count, sizeof d.text - (size_t)d.count, "e%d", d.exponent);
    return strtod(d.text, NULL);
}

bool number_read(const char *text, size_t length, double *value)
{
    size_t sign = length > 0 && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    size_t rest = length - sign;
    if (rest == 0 || number_length(text + sign, rest) != rest) return false;
    double size = number_value(text + sign, rest);
    if (isinf(size)) return false;
    *value = sign && text[0] == '-' ? -size : size;
    return true;
}
