/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/unit.h"

#include <math.h>
#include <string.h>

#include "expr/glyph.h"
#include "expr/unit_table.h"

enum {
    deepest = 20,         /* nested parentheses */
    highest_exponent = 12 /* sufficient for units of mechanics, and factors stay finite */
};

struct reader {
    const char *text;
    size_t length, at;
    struct pos start;
    enum unit_system system;
    fbd_errors *errors;
    int depth;
};

/* A part of a unit, with its factor as a quotient so that exact ratios stay exact. */
struct part {
    struct dim dim;
    struct unit_ratio factor;
    bool angle, hertz;
};

static struct pos here(const struct reader *r)
{
    return glyph_pos(r->text, r->at, r->start);
}

static char peek(const struct reader *r)
{
    return r->at < r->length ? r->text[r->at] : '\0';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool skip_blanks(struct reader *r)
{
    size_t before = r->at;
    while (is_blank(peek(r))) r->at++;
    return r->at > before;
}

static bool refuse(const struct reader *r, const char *hint, const char *message)
{
    diag_add(r->errors, FBD_ERROR, "unit-syntax", here(r), hint, "%s", message);
    return false;
}

/* ---- errors */

static size_t letters_before(const struct reader *r)
{
    size_t n = 0;
    while (n < r->at && is_letter(r->text[r->at - 1 - n])) n++;
    return n;
}

static size_t digits_from(const struct reader *r, size_t at)
{
    size_t n = 0;
    while (at + n < r->length && is_digit(r->text[at + n])) n++;
    return n;
}

/* Refuse a minus: `ms-2` and `s-1` lack the `^`; `N-m` has a hyphen for the product. */
static bool refuse_minus(const struct reader *r)
{
    int before = (int)letters_before(r);
    const char *name = r->text + r->at - before;
    const char *after = r->text + r->at + 1;
    int digits = (int)digits_from(r, r->at + 1), letters = 0;
    while (r->at + 1 + (size_t)letters < r->length && is_letter(after[letters])) letters++;
    const char *hint = NULL;
    if (before == 2 && memcmp(name, "ms", 2) == 0 && digits == 1 && after[0] == '2')
        hint = "write `m/s^2`";
    else if (before == 2 && memcmp(name, "ms", 2) == 0 && digits == 1 && after[0] == '1')
        hint = "write `m/s`";
    else if (before && digits)
        hint = diag_hint(r->errors, "an exponent is written with `^`: `%.*s^-%.*s`", before, name, digits,
                         after);
    else if (before && letters)
        hint =
            diag_hint(r->errors, "a product is written with `*`: `%.*s*%.*s`", before, name, letters, after);
    return refuse(r, hint, "`-` cannot stand in a unit");
}

static bool refuse_digit(const struct reader *r)
{
    int before = (int)letters_before(r), digits = (int)digits_from(r, r->at);
    if (before) {
        const char *hint = diag_hint(r->errors, "an exponent is written with `^`: `%.*s^%.*s`", before,
                                     r->text + r->at - before, digits, r->text + r->at);
        return refuse(r, hint, "a number cannot follow a unit");
    }
    return refuse(r, "put the number before the unit; only a numerator of 1 may stand here, as in `1/s`",
                  "a number cannot stand in a unit");
}

/* Refuse a character in place of a unit or of the end. */
static bool refuse_character(const struct reader *r)
{
    char c = peek(r);
    const char *rest = r->text + r->at;
    bool micro = r->length - r->at >= 2 && (memcmp(rest, "µ", 2) == 0 || memcmp(rest, "μ", 2) == 0);
    if (c == '\0' && r->at >= r->length) {
        bool dangling = r->length > 0;
        return refuse(r, dangling ? NULL : "write a unit such as `N`, or leave the brackets out",
                      dangling ? "the unit ends too early" : "the unit is empty");
    }
    if (c == '-') return refuse_minus(r);
    if (is_digit(c)) return refuse_digit(r);
    if (c == '%') return refuse(r, "write 0.05 for 5 %", "`%` is not a unit");
    if (c == ')') return refuse(r, NULL, "`)` without `(`");
    if (micro) return refuse(r, "micro is written `u`, as in `us`", "`µ` cannot be used here");
    glyph_refuse(r->errors, "unit-syntax", here(r), rest, r->length - r->at);
    return false;
}

/* ---- reading */

static bool read_product(struct reader *r, struct part *result);

static bool read_name(struct reader *r, struct part *result)
{
    const char *name = r->text + r->at;
    size_t length = 0;
    while (r->at + length < r->length && is_letter(name[length])) length++;
    const struct unit_row *row = unit_find(name, length);
    if (!row) {
        if (r->errors)
            diag_add(r->errors, FBD_ERROR, "unknown-unit", here(r), unit_suggest(r->errors, name, length),
                     "unknown unit `%.*s`", (int)length, name);
        return false;
    }
    r->at += length;
    *result = (struct part){row->dim, row->factor[r->system], row->angle, strcmp(row->name, "Hz") == 0};
    return true;
}

static bool read_primary(struct reader *r, struct part *result)
{
    char c = peek(r);
    if (is_letter(c)) return read_name(r, result);
    if (c == '1' && digits_from(r, r->at) == 1) {
        r->at++;
        *result = (struct part){.factor = {1, 1}};
        return true;
    }
    if (c != '(') return refuse_character(r);
    if (++r->depth > deepest) return refuse(r, NULL, "the unit is nested too deeply");
    r->at++;
    if (!read_product(r, result)) return false;
    if (peek(r) != ')') return r->at >= r->length ? refuse(r, NULL, "`)` is missing") : refuse_character(r);
    r->at++;
    r->depth--;
    return true;
}

static double whole_power(double base, int exponent)
{
    double product = 1;
    for (int i = 0; i < exponent; i++) product *= base;
    return product;
}

static bool read_exponent(struct reader *r, struct part *result)
{
    size_t start = ++r->at;
    skip_blanks(r);
    bool negative = peek(r) == '-';
    if (negative || peek(r) == '+') r->at++;
    size_t digits = digits_from(r, r->at);
    char after = r->at + digits < r->length ? r->text[r->at + digits] : '\0';
    bool fraction = after == '.' && digits_from(r, r->at + digits + 1) > 0;
    if (digits == 0 || fraction) {
        r->at = start;
        return refuse(r, "exponents of units are whole numbers, as in `m^2` or `s^-1`",
                      fraction || peek(r) == '(' || peek(r) == '.'
                          ? "a unit cannot have a fraction as exponent"
                          : "the exponent after `^` is missing");
    }
    int exponent = 0;
    for (size_t i = 0; i < digits && exponent <= highest_exponent; i++)
        exponent = exponent * 10 + (r->text[r->at + i] - '0');
    if (exponent > highest_exponent) return refuse(r, NULL, "the exponent is too large");
    r->at += digits;
    double over = whole_power(result->factor.over, exponent),
           under = whole_power(result->factor.under, exponent);
    result->factor = negative ? (struct unit_ratio){under, over} : (struct unit_ratio){over, under};
    /* A power of a saturated dimension may be out of range; no unit has such a dimension. */
    if (!dim_power(result->dim, negative ? -exponent : exponent, 1, &result->dim))
        return refuse(r, NULL, "the exponent is too large");
    return true;
}

static bool read_factor(struct reader *r, struct part *result)
{
    if (!read_primary(r, result)) return false;
    size_t end = r->at;
    skip_blanks(r);
    if (peek(r) == '^') return read_exponent(r, result);
    if (peek(r) == '*' && r->at + 1 < r->length && r->text[r->at + 1] == '*')
        return refuse(r, "a power is written with `^`", "`**` cannot stand in a unit");
    r->at = end;
    return true;
}

static void multiply(struct part *a, struct part b, bool divide)
{
    if (divide) b.factor = (struct unit_ratio){b.factor.under, b.factor.over};
    a->dim = divide ? dim_over(a->dim, b.dim) : dim_times(a->dim, b.dim);
    a->factor.over *= b.factor.over;
    a->factor.under *= b.factor.under;
    a->angle = a->angle || b.angle;
    a->hertz = a->hertz || b.hertz;
}

static bool read_product(struct reader *r, struct part *result)
{
    skip_blanks(r);
    if (!read_factor(r, result)) return false;
    for (;;) {
        bool blank = skip_blanks(r);
        char c = peek(r);
        bool sign = c == '*' || c == '/' || c == '.';
        if (!sign && !(blank && (is_letter(c) || c == '('))) return true;
        if (sign) r->at++;
        skip_blanks(r);
        struct part factor;
        if (!read_factor(r, &factor)) return false;
        multiply(result, factor, c == '/');
    }
}

static bool is_absurd(short exponent)
{
    const int most = 100 * dim_unit; /* far from where dimensions saturate */
    return exponent > most || exponent < -most;
}

bool unit_parse(const char *text, size_t length, enum unit_system system, fbd_errors *errors, struct pos at,
                struct unit *result)
{
    struct reader r = {.text = text, .length = length, .start = at, .system = system, .errors = errors};
    struct part whole = {.factor = {1, 1}};
    if (!read_product(&r, &whole)) return false;
    if (r.at < length) return refuse_character(&r);
    double factor = whole.factor.over / whole.factor.under;
    if (is_absurd(whole.dim.mass) || is_absurd(whole.dim.length) || is_absurd(whole.dim.time) ||
        is_absurd(whole.dim.current) || is_absurd(whole.dim.temperature))
        return refuse(&r, NULL, "the exponents are too large");
    if (!isnormal(factor)) return refuse(&r, NULL, "the factor of this unit is out of range");
    *result = (struct unit){whole.dim, factor, whole.angle, whole.hertz};
    return true;
}
