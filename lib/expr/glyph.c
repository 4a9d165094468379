/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/glyph.h"

#include <string.h>

static bool continues(char c)
{
    return ((unsigned char)c & 0xC0u) == 0x80u;
}

size_t glyph_size(const char *text, size_t length)
{
    unsigned char first = (unsigned char)text[0];
    size_t size = first >= 0xF0u ? 4 : first >= 0xE0u ? 3 : first >= 0xC0u ? 2 : 1;
    if (size > length) return 1;
    for (size_t i = 1; i < size; i++)
        if (!continues(text[i])) return 1;
    return size;
}

struct pos glyph_pos(const char *text, size_t offset, struct pos start)
{
    struct pos at = start;
    for (size_t i = 0; i < offset;) {
        i += glyph_size(text + i, offset - i);
        at.column++;
    }
    return at;
}

/* The micro sign U+00B5 and the letter mu look the same; outside of a unit the letter is more likely. */
const char *glyph_plain(const char *text, size_t size)
{
    static const char *const table[][2] = {
        {"α", "alpha"},   {"β", "beta"},  {"γ", "gamma"},  {"δ", "delta"},
        {"ε", "epsilon"}, {"ζ", "zeta"},  {"η", "eta"},    {"θ", "theta"},
        {"ϑ", "theta"},   {"κ", "kappa"}, {"λ", "lambda"}, {"μ", "mu"},
        {"µ", "mu"},      {"ν", "nu"},    {"ξ", "xi"},     {"π", "pi"},
        {"ρ", "rho"},     {"σ", "sigma"}, {"τ", "tau"},    {"φ", "phi"},
        {"ϕ", "phi"},     {"χ", "chi"},   {"ψ", "psi"},    {"ω", "omega"},
        {"Δ", "Delta"},   {"Θ", "Theta"}, {"Ω", "Omega"},  {"Φ", "Phi"},
        {"·", "*"},       {"⋅", "*"},     {"×", "*"},      {"∙", "*"},
        {"•", "*"},       {"∗", "*"},     {"÷", "/"},      {"∕", "/"},
        {"⁄", "/"},       {"−", "-"},     {"–", "-"},      {"—", "-"},
        {"‐", "-"},       {"¹", "^1"},    {"²", "^2"},     {"³", "^3"},
        {"⁴", "^4"},      {"⁻", "^-"},    {"°", "deg"},    {"º", "deg"},
        {"√", "sqrt()"},  {"≤", "<="},    {"≥", ">="},     {"≠", "not ... == ..."},
        {"½", "0.5"},     {"¼", "0.25"},  {"′", "ft"},     {"″", "in"},
        {"（", "("},      {"）", ")"},    {"，", ","},
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (strlen(table[i][0]) == size && memcmp(table[i][0], text, size) == 0) return table[i][1];
    return NULL;
}

void glyph_refuse(fbd_errors *errors, const char *id, struct pos at, const char *text, size_t length)
{
    size_t size = glyph_size(text, length);
    unsigned char first = (unsigned char)text[0];
    if (size == 1 && (first < 0x20u || first >= 0x7Fu)) {
        diag_add(errors, FBD_ERROR, id, at, NULL, "the byte 0x%02X cannot be used here", (unsigned)first);
        return;
    }
    bool blank = size == 2 && memcmp(text, "\xC2\xA0", 2) == 0;
    const char *plain = glyph_plain(text, size);
    const bool sum = size > 1 && (strncmp(text, "Σ", size) == 0 || strncmp(text, "∑", size) == 0);
    const char *hint = plain   ? diag_hint(errors, "write `%s`", plain)
                       : sum   ? "write the sum out, and an equation behind it: `ΣF_x = F - f = m*a`"
                       : blank ? "this is a no-break space: write an ordinary blank"
                               : NULL;
    diag_add(errors, FBD_ERROR, id, at, hint, "`%.*s` cannot be used here", (int)size, text);
}
