/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Symbols of a notation: letters with subscripts, dots and primes.
 */
#include <string.h>

#include "expr/glyph.h"
#include "expr/notation_work.h"

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool writing_has(const struct writing *w, size_t offset, const char *word)
{
    size_t length = strlen(word);
    return offset + length <= w->length && memcmp(w->text + offset, word, length) == 0;
}

static size_t skip_blanks(const struct writing *w, size_t offset)
{
    while (offset < w->length && strchr(" \t\r\n", w->text[offset])) offset++;
    return offset;
}

size_t writing_skip(const struct writing *w, size_t offset)
{
    static const char *const spacing[] = {"\\,", "\\;", "\\:", "\\!", "\\ ", "~", "\xC2\xA0"};
    for (size_t before = w->length + 1; before != offset;) {
        before = offset;
        offset = skip_blanks(w, offset);
        for (size_t i = 0; i < sizeof spacing / sizeof *spacing; i++)
            if (writing_has(w, offset, spacing[i])) offset += strlen(spacing[i]);
    }
    return offset;
}

/* ---- commands of LaTeX */

size_t command_length(const struct writing *w, size_t offset)
{
    if (offset + 1 >= w->length || w->text[offset] != '\\' || !is_letter(w->text[offset + 1])) return 0;
    size_t length = 1;
    while (offset + length < w->length && is_letter(w->text[offset + length])) length++;
    return length;
}

bool command_is(const struct writing *w, size_t offset, const char *word)
{
    size_t length = command_length(w, offset);
    return length == strlen(word) + 1 && memcmp(w->text + offset + 1, word, length - 1) == 0;
}

static bool command_is_one_of(const struct writing *w, size_t offset, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (command_is(w, offset, words[i])) return true;
    return false;
}

static bool is_upright(const struct writing *w, size_t offset)
{
    static const char *const words[] = {"mathrm", "mathit", "mathbf", "mathsf",     "text", "textrm",
                                        "textit", "textbf", "mbox",   "boldsymbol", "bm",   "operatorname"};
    return command_is_one_of(w, offset, words, sizeof words / sizeof *words);
}

/* The Greek letter of a command, or NULL. */
static const char *greek_command(const struct writing *w, size_t offset)
{
    static const char *const letters[][2] = {
        {"alpha", "alpha"},    {"beta", "beta"},       {"gamma", "gamma"},
        {"delta", "delta"},    {"epsilon", "epsilon"}, {"varepsilon", "epsilon"},
        {"zeta", "zeta"},      {"eta", "eta"},         {"theta", "theta"},
        {"vartheta", "theta"}, {"kappa", "kappa"},     {"lambda", "lambda"},
        {"mu", "mu"},          {"nu", "nu"},           {"xi", "xi"},
        {"pi", "pi"},          {"rho", "rho"},         {"sigma", "sigma"},
        {"tau", "tau"},        {"phi", "phi"},         {"varphi", "phi"},
        {"chi", "chi"},        {"psi", "psi"},         {"omega", "omega"},
        {"Delta", "Delta"},    {"Theta", "Theta"},     {"Omega", "Omega"},
        {"Phi", "Phi"},        {"ell", "l"},
    };
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
        if (command_is(w, offset, letters[i][0])) return letters[i][1];
    return NULL;
}

static int accent_marks(const struct writing *w, size_t offset)
{
    return command_is(w, offset, "dot") ? 1 : command_is(w, offset, "ddot") ? 2 : 0;
}

/* ---- letters beyond ASCII */

struct sign {
    const char *sign, *text;
    int marks;
};

static const struct sign dotted[] = {
    {"ẋ", "x", 1}, {"ẍ", "x", 2}, {"ẏ", "y", 1}, {"ÿ", "y", 2}, {"ż", "z", 1}, {"ṡ", "s", 1},
    {"ṙ", "r", 1}, {"ẇ", "w", 1}, {"ẅ", "w", 2}, {"ṁ", "m", 1}, {"ḣ", "h", 1}, {"ḧ", "h", 2},
    {"ṗ", "p", 1}, {"ȧ", "a", 1}, {"ä", "a", 2}, {"ö", "o", 2}, {"ü", "u", 2}, {"ė", "e", 1},
    {"ë", "e", 2}, {"Ẋ", "X", 1}, {"Ẍ", "X", 2}, {"Ẏ", "Y", 1}, {"Ÿ", "Y", 2},
};

static const struct sign lowered[] = {
    {"₀", "0", 0}, {"₁", "1", 0}, {"₂", "2", 0}, {"₃", "3", 0}, {"₄", "4", 0}, {"₅", "5", 0},
    {"₆", "6", 0}, {"₇", "7", 0}, {"₈", "8", 0}, {"₉", "9", 0}, {"ₐ", "a", 0}, {"ₑ", "e", 0},
    {"ₒ", "o", 0}, {"ₓ", "x", 0}, {"ₕ", "h", 0}, {"ₖ", "k", 0}, {"ₗ", "l", 0}, {"ₘ", "m", 0},
    {"ₙ", "n", 0}, {"ₚ", "p", 0}, {"ₛ", "s", 0}, {"ₜ", "t", 0}, {"ᵢ", "i", 0}, {"ᵣ", "r", 0},
};

/* Dots above a letter, and primes. */
static const struct sign marks[] = {
    {"\xCC\x87", "", 1}, {"\xCC\x88", "", 2}, {"'", "", 1}, {"\"", "", 2},
    {"′", "", 1},        {"″", "", 2},        {"’", "", 1}, {"”", "", 2},
};

static const struct sign *find_sign(const struct writing *w, size_t offset, const struct sign *signs,
                                    size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (writing_has(w, offset, signs[i].sign)) return &signs[i];
    return NULL;
}

#define FIND_SIGN(w, offset, signs) find_sign((w), (offset), (signs), sizeof(signs) / sizeof *(signs))

/* The Greek letter at `offset`, and its size in bytes. */
static const char *greek_letter(const struct writing *w, size_t offset, size_t *size)
{
    *size = glyph_size(w->text + offset, w->length - offset);
    unsigned char first = (unsigned char)w->text[offset];
    bool greek = *size == 2 && (first == 0xCE || first == 0xCF || writing_has(w, offset, "µ"));
    return greek ? glyph_plain(w->text + offset, *size) : NULL;
}

/* ---- symbols */

static void add(struct run *run, const char *text, size_t length, size_t start, size_t end, bool greek)
{
    if (run->count == most_atoms) {
        run->failed = true;
        return;
    }
    run->atoms[run->count++] = (struct atom){text, length, start, end, 0, greek};
}

static void mark(struct run *run, int count, size_t end)
{
    if (run->count == 0) return;
    run->atoms[run->count - 1].marks += count;
    run->atoms[run->count - 1].end = end;
}

static size_t read_part(const struct writing *w, size_t offset, struct run *run);

/* Read letters or commands in braces, without blanks and commas; returns the byte behind the brace. */
static size_t read_braced(const struct writing *w, size_t offset, struct run *run)
{
    size_t at = offset + 1;
    while (at < w->length && w->text[at] != '}' && !run->failed) {
        size_t behind = writing_skip(w, at);
        if (behind == at && writing_has(w, at, ",")) behind++;
        if (behind == at && writing_has(w, at, "\\_")) add(run, "_", 1, at, behind = at + 2, false);
        if (behind == at) behind = read_part(w, at, run);
        if (behind == at) run->failed = true;
        at = behind;
    }
    if (at >= w->length) run->failed = true;
    return at + 1;
}

/* Read an argument as in LaTeX: one letter, digit, command or group. */
static size_t read_argument(const struct writing *w, size_t offset, struct run *run)
{
    size_t at = skip_blanks(w, offset);
    if (at >= w->length) return offset;
    return w->text[at] == '{' ? read_braced(w, at, run) : read_part(w, at, run);
}

/* Read the letter, digit or command at `offset`; returns the byte behind it, or `offset` if there is none. */
static size_t read_part(const struct writing *w, size_t offset, struct run *run)
{
    size_t size = command_length(w, offset), behind;
    if (size > 0) {
        const char *greek = greek_command(w, offset);
        int dots = accent_marks(w, offset);
        if (greek) {
            add(run, greek, strlen(greek), offset, offset + size, true);
            return offset + size;
        }
        if (!dots && !is_upright(w, offset)) return offset;
        behind = read_argument(w, offset + size, run);
        if (behind == offset + size) run->failed = true;
        if (dots) mark(run, dots, behind);
        return behind;
    }
    char c = offset < w->length ? w->text[offset] : '\0';
    if (is_letter(c) || is_digit(c) || c == '_') {
        add(run, w->text + offset, 1, offset, offset + 1, false);
        return offset + 1;
    }
    if (c == '.' && run->count > 0 && offset + 1 < w->length &&
        (is_letter(w->text[offset + 1]) || w->text[offset + 1] == '_' ||
         greek_letter(w, offset + 1, &size))) {
        add(run, ".", 1, offset, offset + 1, false);
        return offset + 1;
    }
    if (c == '\0') return offset;
    const struct sign *dot = FIND_SIGN(w, offset, dotted);
    const char *greek = dot ? NULL : greek_letter(w, offset, &size);
    if (!dot && !greek) return offset;
    behind = offset + (dot ? strlen(dot->sign) : size);
    add(run, dot ? dot->text : greek, dot ? strlen(dot->text) : strlen(greek), offset, behind, greek != NULL);
    if (dot) mark(run, dot->marks, behind);
    return behind;
}

/* Read primes and dots at `offset`; returns the byte behind them. */
static size_t read_marks(const struct writing *w, size_t offset, struct run *run)
{
    for (;;) {
        size_t power = offset + (writing_has(w, offset, "^"));
        bool brace = power > offset && writing_has(w, power, "{");
        size_t prime = brace ? power + 1 : power;
        const struct sign *sign = FIND_SIGN(w, offset, marks);
        if (sign) {
            offset += strlen(sign->sign);
            mark(run, sign->marks, offset);
        } else if (power > offset && command_is(w, prime, "prime")) {
            for (; command_is(w, prime, "prime"); prime = skip_blanks(w, prime + 6)) mark(run, 1, prime + 6);
            if (brace && !writing_has(w, prime, "}")) run->failed = true;
            offset = prime + brace;
        } else {
            return offset;
        }
    }
}

/* Read subscript characters at `offset`; returns the byte behind them. */
static size_t read_lowered(const struct writing *w, size_t offset, struct run *run)
{
    const struct sign *sign = FIND_SIGN(w, offset, lowered);
    if (sign) add(run, "_", 1, offset, offset, false);
    for (; sign; sign = FIND_SIGN(w, offset, lowered)) {
        add(run, sign->text, 1, offset, offset + strlen(sign->sign), false);
        offset += strlen(sign->sign);
    }
    return offset;
}

bool run_begins(const struct writing *w, size_t offset)
{
    struct run run = {.count = 0};
    if (offset >= w->length || is_digit(w->text[offset])) return false;
    return command_length(w, offset) > 0
               ? greek_command(w, offset) || accent_marks(w, offset) || is_upright(w, offset)
               : read_part(w, offset, &run) > offset;
}

size_t run_read(const struct writing *w, size_t offset, struct run *run)
{
    bool command = command_length(w, offset) > 0, ends = command;
    size_t at = read_part(w, offset, run);
    for (size_t before = offset; at != before && !run->failed;) {
        before = at;
        at = read_lowered(w, read_marks(w, at, run), run);
        bool lower = writing_has(w, at, "_"), braced = lower && writing_has(w, at + 1, "{");
        if (lower && (braced || command_length(w, at + 1) > 0)) {
            add(run, "_", 1, at, at + 1, false);
            at = read_argument(w, at + 1, run);
            ends = true;
        } else if (lower || !ends) {
            at = command_length(w, at) > 0 ? at : read_part(w, at, run);
            if (lower && ends) at = read_part(w, at, run);
        }
    }
    return at;
}

/* ---- derivatives as quotients */

static size_t read_d(const struct writing *w, size_t offset)
{
    static const char *const words[] = {"\\mathrm{d}", "\\text{d}", "\\mathrm d", "d"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (writing_has(w, offset, words[i])) return writing_skip(w, offset + strlen(words[i]));
    return 0;
}

/* The byte behind an exponent 2 at `offset`; `offset` if there is none. */
static size_t read_square(const struct writing *w, size_t offset)
{
    static const char *const words[] = {"^{2}", "^2", "**2", "²"};
    size_t at = writing_skip(w, offset);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (writing_has(w, at, words[i])) return at + strlen(words[i]);
    return offset;
}

static bool goes_on(const struct writing *w, size_t offset)
{
    struct run run = {.count = 1};
    return offset < w->length &&
           (is_digit(w->text[offset]) || w->text[offset] == '_' || w->text[offset] == '(' ||
            (command_length(w, offset) == 0 && read_part(w, offset, &run) > offset));
}

size_t derivative_read(const struct writing *w, size_t offset, struct run *run)
{
    size_t command = command_length(w, offset), at = offset;
    bool fraction = command > 4 && memcmp(w->text + offset + command - 4, "frac", 4) == 0;
    if (command > 0 && !fraction && !read_d(w, offset)) return 0;
    if (fraction) {
        at = skip_blanks(w, offset + command);
        if (!writing_has(w, at, "{")) return 0;
        at = skip_blanks(w, at + 1);
    }
    size_t d = read_d(w, at);
    if (d == 0) return 0;
    size_t behind = read_square(w, d);
    int order = behind > d ? 2 : 1;
    behind = writing_skip(w, behind);
    at = run_begins(w, behind) ? run_read(w, behind, run) : 0;
    if (at == 0 || run->failed) return 0;
    at = writing_skip(w, at);
    if (!writing_has(w, at, fraction ? "}" : "/")) return 0;
    at = writing_skip(w, at + 1);
    if (fraction && !writing_has(w, at, "{")) return 0;
    at = read_d(w, fraction ? writing_skip(w, at + 1) : at);
    if (at == 0 || !writing_has(w, at, "t")) return 0;
    size_t square = read_square(w, ++at);
    if ((square > at) != (order == 2)) return 0;
    at = order == 2 ? square : at;
    if (fraction) at = writing_skip(w, at);
    if (fraction ? !writing_has(w, at, "}") : order == 1 && goes_on(w, at)) return 0;
    mark(run, order, run->atoms[run->count - 1].end);
    return fraction ? at + 1 : at;
}
