/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/printed.h"

#include <stdbool.h>
#include <string.h>

static const struct greek {
    const char *name, *letter;
} greek[] = {
    {"alpha", "α"}, {"beta", "β"}, {"gamma", "γ"}, {"delta", "δ"}, {"theta", "θ"}, {"lambda", "λ"},
    {"mu", "μ"},    {"phi", "φ"},  {"psi", "ψ"},   {"omega", "ω"}, {"rho", "ρ"},   {"tau", "τ"},
};

const char *greek_letter(const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (strlen(greek[i].name) == length && memcmp(greek[i].name, name, length) == 0)
            return greek[i].letter;
    return NULL;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_word(char c)
{
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80);
}

/* The length of an index for which Unicode has subscripts, else 0. */
static size_t low_index(const char *index)
{
    size_t length = 0;
    while (is_digit(index[length])) length++;
    if (length == 0 && (*index == 'k' || *index == 's')) length = 1;
    return is_word(index[length]) || index[length] == '_' ? 0 : length;
}

static void add_low(struct text *text, char c)
{
    if (is_digit(c))
        text_printf(text, "\xE2\x82%c", 0x80 + (c - '0'));
    else
        text_add(text, c == 'k' ? "ₖ" : "ₛ");
}

/* Append the index behind an underscore; returns the length of the symbol that it takes. */
typedef size_t add_index(struct text *text, const char *index);

static size_t add_low_index(struct text *text, const char *index)
{
    const size_t length = low_index(index);
    for (size_t i = 0; i < length; i++) add_low(text, index[i]);
    return length;
}

static size_t add_index_in_braces(struct text *text, const char *index)
{
    size_t length = 0;
    while (is_word(index[length]) || index[length] == '_') length++;
    const char *letter = greek_letter(index, length);
    if (length == 0) return 0;
    text_add(text, "_{");
    if (letter)
        text_add(text, letter);
    else
        text_add_bytes(text, index, length);
    text_add(text, "}");
    return length;
}

static void add_symbol(struct text *text, const char *symbol, add_index *index)
{
    for (const char *c = symbol; *c;) {
        size_t length = 0;
        while (is_word(c[length])) length++;
        const char *letter = greek_letter(c, length);
        size_t low = *c == '_' ? index(text, c + 1) : 0;
        if (letter)
            text_add(text, letter);
        else if (length)
            text_add_bytes(text, c, length);
        else if (!low && *c != ' ')
            text_add_bytes(text, c, 1);
        c += letter || length ? length : 1 + low;
    }
}

void text_symbol(struct text *text, const char *symbol)
{
    add_symbol(text, symbol, add_low_index);
}

void text_symbol_indexed(struct text *text, const char *symbol)
{
    add_symbol(text, symbol, add_index_in_braces);
}
