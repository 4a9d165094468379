/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/engineering.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/format.h"

/* ---- units */

/* N*m^2 as N·m²; units are shorter than `size`. */
static void print_unit(char *printed, size_t size, const char *prefix, const char *unit)
{
    size_t length = (size_t)snprintf(printed, size, "%s", prefix);
    for (const char *c = unit; *c && length + sizeof "²" < size; c++) {
        const char *sign = *c == '*' ? "·" : NULL;
        if (strncmp(c, "^2", 2) == 0) sign = "²";
        if (strncmp(c, "^3", 2) == 0) sign = "³";
        if (sign) {
            length += (size_t)snprintf(printed + length, size - length, "%s", sign);
            c += *c == '^';
        } else {
            printed[length++] = *c;
            printed[length] = '\0';
        }
    }
}

/* Units that begin with a newton, joule, watt or pascal take a prefix. */
static bool takes_prefix(const char *unit)
{
    static const char *const begins[] = {"N", "J", "W", "Pa"};
    for (size_t i = 0; i < sizeof begins / sizeof *begins; i++) {
        const size_t length = strlen(begins[i]);
        const char next = unit[length];
        if (strncmp(unit, begins[i], length) == 0 && (next == '\0' || next == '*' || next == '/'))
            return true;
    }
    return false;
}

/* A force in pounds, or a moment, energy or stiffness of them, in thousands: kip, ft·kip. */
static bool in_kips(struct scaled_unit *scaled, const char *unit, double size)
{
    const char *pound = strstr(unit, "lbf");
    char kips[sizeof scaled->name];
    if (!pound || !(size >= 1e4) || !isfinite(size)) return false;
    snprintf(kips, sizeof kips, "%.*skip%s", (int)(pound - unit), unit, pound + strlen("lbf"));
    print_unit(scaled->name, sizeof scaled->name, "", kips);
    scaled->size = 1e3;
    return true;
}

static struct scaled_unit in_degrees(const char *unit)
{
    const double degree = 3.14159265358979323846 / 180;
    struct scaled_unit scaled = {.size = degree};
    snprintf(scaled.name, sizeof scaled.name, "%s", strcmp(unit, "rad") == 0 ? "°" : "°/s");
    return scaled;
}

struct scaled_unit unit_for(const char *unit, double size, bool degrees)
{
    struct scaled_unit scaled = {.size = 1};
    const char *prefix = "";
    if (degrees && (strcmp(unit, "rad") == 0 || strcmp(unit, "rad/s") == 0)) return in_degrees(unit);
    if (strcmp(unit, "1") == 0 || in_kips(&scaled, unit, size)) return scaled;
    if (takes_prefix(unit) && size >= 1e4 && isfinite(size)) {
        prefix = size >= 1e7 ? "M" : "k";
        scaled.size = size >= 1e7 ? 1e6 : 1e3;
    } else if (strcmp(unit, "m") == 0 && size > 0 && size < 1e-2) {
        prefix = "m";
        scaled.size = 1e-3;
    }
    print_unit(scaled.name, sizeof scaled.name, prefix, unit);
    return scaled;
}

/* ---- numbers */

static void write_power(struct text *text, int power)
{
    static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    char digits[16];
    snprintf(digits, sizeof digits, "%d", abs(power));
    text_add(text, power < 0 ? "·10⁻" : "·10");
    for (const char *c = digits; *c; c++) text_add(text, raised[*c - '0']);
}

/* Zeros at the end of digits with a point. */
static void drop_zeros(char *digits)
{
    if (!strchr(digits, '.')) return;
    char *end = digits + strlen(digits);
    while (end[-1] == '0') *--end = '\0';
    if (end[-1] == '.') end[-1] = '\0';
}

void number_write(struct text *text, double value, int digits)
{
    char number[64];
    if (!isfinite(value)) {
        text_add(text, "?");
        return;
    }
    format_into(number, sizeof number, "%.*e", digits - 1, fabs(value));
    char *e = strchr(number, 'e');
    const int power = (int)strtol(e + 1, NULL, 10);
    const bool plain = value == 0 || (power >= -4 && power < 6);
    if (plain && power >= digits) digits = power + 1; /* all digits before the point */
    if (plain)
        format_into(number, sizeof number, "%.*f", value == 0 ? 0 : digits - 1 - power, fabs(value));
    else
        *e = '\0';
    drop_zeros(number);
    if (value < 0) text_add(text, "−");
    text_add(text, number);
    if (!plain) write_power(text, power);
}

void value_write(struct text *text, double value, const char *unit, int digits, bool degrees)
{
    const struct scaled_unit scaled = unit_for(unit, fabs(value), degrees);
    number_write(text, value / scaled.size, digits);
    if (scaled.name[0]) text_printf(text, scaled.name[0] == '\xC2' ? "%s" : "\u00a0%s", scaled.name);
}

/* ---- round-off */

double rounded_off(double value, double error, double size)
{
    const double level = 1e-12;
    const bool within = isfinite(error) && fabs(value) <= error;
    return within || fabs(value) <= level * size ? 0 : value;
}
