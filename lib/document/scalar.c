/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document/scalar.h"

#include <string.h>

static bool is_one_of(const char *text, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(text, words[i]) == 0) return true;
    return false;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Compare without regard to case, independently of the locale: a Turkish one has no `i` for `I`. */
static bool same_letters(const char *text, const char *word)
{
    while (*text && lower(*text) == *word) {
        text++;
        word++;
    }
    return *text == *word;
}

bool scalar_is_null(const char *text)
{
    static const char *const words[] = {"", "~", "null", "Null", "NULL"};
    return is_one_of(text, words, sizeof words / sizeof *words);
}

bool scalar_boolean(const char *text, bool *value)
{
    static const char *const yes[] = {"true", "True", "TRUE"}, *const no[] = {"false", "False", "FALSE"};
    *value = is_one_of(text, yes, 3);
    return *value || is_one_of(text, no, 3);
}

const char *scalar_boolean_word(const char *text)
{
    static const char *const words[][2] = {{"yes", "true"}, {"on", "true"},   {"y", "true"},
                                           {"no", "false"}, {"off", "false"}, {"n", "false"}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (same_letters(text, words[i][0])) return words[i][1];
    return NULL;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static size_t digits(const char *text)
{
    size_t count = 0;
    while (is_digit(text[count])) count++;
    return count;
}

static bool is_infinite(const char *text)
{
    static const char *const words[] = {"inf", ".inf", "infinity", "nan", ".nan"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (same_letters(text, words[i])) return true;
    return false;
}

/* The fault of the unsigned number at the start of `text`, with a hint; NULL if it has none. */
static const char *number_trap(const char *text, const char **hint)
{
    size_t whole = digits(text);
    if (whole == 0) return NULL;
    const char *next = text + whole;
    if (*next == ':' && is_digit(next[1])) {
        *hint = "write seconds, as `90 s`, or minutes, as `1.5 min`";
        return "a time with a colon";
    }
    if (*next == '_' && is_digit(next[1])) {
        *hint = "write the digits without `_`";
        return "a number with `_` in it";
    }
    if (whole == 1 && *text == '0' && strchr("xXoObB", *next) && *next && next[1]) {
        *hint = "write it in decimal";
        return "a hexadecimal, octal or binary number";
    }
    if (whole > 1 && *text == '0') {
        *hint = "leave out the leading zero; some readers take such a number as octal";
        return "a number with a leading zero";
    }
    if (*next == '.') next += 1 + digits(next + 1);
    if (*next == ',' && is_digit(next[1])) {
        *hint = "write a decimal point, as `1.5`, and no mark between thousands; a pair is `[1, 5]`";
        return "a number with a comma";
    }
    if (*next == '%' && !next[1]) {
        *hint = "write the fraction, as `0.5`";
        return "a percentage";
    }
    return NULL;
}

bool scalar_check_number(const char *text, struct pos at, const char *what, fbd_errors *errors)
{
    const char *number = text + (*text == '-' || *text == '+');
    if (is_infinite(number)) {
        diag_add(errors, FBD_ERROR, "not-finite", at, "write a finite number", "`%s` cannot be `%s`", what,
                 text);
        return false;
    }
    const char *hint = NULL, *trap = number_trap(number, &hint);
    if (trap)
        diag_add(errors, FBD_ERROR, "number-format", at, hint, "`%s` wants a plain number, and `%.40s` is %s",
                 what, text, trap);
    return !trap;
}

bool scalar_is_word(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || is_digit(c);
}

bool scalar_is_name(const char *text)
{
    for (const char *c = text; *c; c++)
        if (!scalar_is_word(*c)) return false;
    return *text != '\0' && !is_digit(*text);
}
