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

void text_symbol(struct text *text, const char *symbol)
{
    for (const char *c = symbol; *c;) {
        size_t length = 0;
        while (is_word(c[length])) length++;
        const char *letter = greek_letter(c, length);
        size_t low = *c == '_' ? low_index(c + 1) : 0;
        if (letter)
            text_add(text, letter);
        else if (length)
            text_add_bytes(text, c, length);
        else if (low)
            for (size_t i = 0; i < low; i++) add_low(text, c[1 + i]);
        else if (*c != ' ')
            text_add_bytes(text, c, 1);
        c += letter || length ? length : 1 + low;
    }
}
