/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/lex.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "expr/glyph.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool starts_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

void lex_start(struct lexer *lexer, const char *text, size_t length, struct pos start, fbd_errors *errors)
{
    *lexer = (struct lexer){
        .text = text, .length = length, .start = start, .errors = errors, .offset = 0, .at = start};
}

bool lex_is(const struct lexer *lexer, const struct token *token, const char *word)
{
    return token->kind == token_name && strlen(word) == token->length &&
           memcmp(lexer->text + token->start, word, token->length) == 0;
}

static bool refuse(const struct lexer *lexer, const char *hint, const char *message)
{
    diag_add(lexer->errors, FBD_ERROR, "expression-syntax", lexer->at, hint, "%s", message);
    return false;
}

/* ---- invalid characters */

struct foreign {
    const char *text, *hint;
};

/* Operators of programming languages and of spreadsheets, longest first. */
static const struct foreign foreigners[] = {
    {"!=", "write `not (a == b)`"},
    {"<>", "write `not (a == b)`"},
    {"&&", "write `and`"},
    {"||", "write `or`"},
    {"&", "write `and`"},
    {"|", "write `or`; a magnitude is `abs(x)`"},
    {"!", "write `not`"},
    {"=", "a comparison for equality is written `==`"},
    {"%", "a remainder is `mod(a, b)`; 5 % is `0.05`"},
    {"?", "write `if(condition, a, b)`"},
    {":", "write `if(condition, a, b)` for a choice; a time such as 1:30 is `90 s`"},
    {";", "arguments are separated by `,`"},
    {"{", "use parentheses: `(`"},
    {"}", "use parentheses: `)`"},
    {"'", "names are written without quotes; a derivative has a name of its own"},
    {"\"", "names are written without quotes"},
    {"]", "a unit is written `[N]`, right after its number"},
};

/* True for a micro sign in a unit, as in `5 µs`; elsewhere it is the letter. */
static bool is_micro(const struct lexer *lexer)
{
    const char *rest = lexer->text + lexer->offset;
    size_t left = lexer->length - lexer->offset, before = lexer->offset;
    if (left < 3 || (memcmp(rest, "µ", 2) != 0 && memcmp(rest, "μ", 2) != 0)) return false;
    while (before > 0 && lexer->text[before - 1] == ' ') before--;
    bool number = before > 0 && lexer->text[before - 1] >= '0' && lexer->text[before - 1] <= '9';
    return number && ((rest[2] >= 'a' && rest[2] <= 'z') || (rest[2] >= 'A' && rest[2] <= 'Z'));
}

static bool refuse_character(const struct lexer *lexer)
{
    const char *rest = lexer->text + lexer->offset;
    size_t left = lexer->length - lexer->offset;
    if (is_micro(lexer)) {
        diag_add(lexer->errors, FBD_ERROR, "expression-syntax", lexer->at, "micro is written `u`, as in `us`",
                 "`%.2s` cannot be used here", rest);
        return false;
    }
    for (size_t i = 0; i < sizeof foreigners / sizeof foreigners[0]; i++) {
        size_t size = strlen(foreigners[i].text);
        if (size > left || memcmp(rest, foreigners[i].text, size) != 0) continue;
        diag_add(lexer->errors, FBD_ERROR, "expression-syntax", lexer->at, foreigners[i].hint,
                 "`%s` cannot be used here", foreigners[i].text);
        return false;
    }
    glyph_refuse(lexer->errors, "expression-syntax", lexer->at, rest, left);
    return false;
}

/* ---- tokens */

/* Consume `size` bytes as `token`. */
static bool take(struct lexer *lexer, struct token *token, enum token_kind kind, size_t size)
{
    *token = (struct token){.kind = kind, .start = lexer->offset, .length = size, .at = lexer->at};
    lexer->at = glyph_pos(lexer->text + lexer->offset, size, lexer->at);
    lexer->offset += size;
    return true;
}

static bool take_number(struct lexer *lexer, struct token *token, size_t size)
{
    double value = number_value(lexer->text + lexer->offset, size);
    if (isinf(value)) {
        int shown = size < 40 ? (int)size : 40;
        diag_add(lexer->errors, FBD_ERROR, "not-finite", lexer->at, NULL,
                 "the number %.*s is beyond the range of a double, 1.8e308", shown,
                 lexer->text + lexer->offset);
        return false;
    }
    take(lexer, token, token_number, size);
    token->number = value;
    return true;
}

static bool take_name(struct lexer *lexer, struct token *token)
{
    const char *text = lexer->text;
    size_t end = lexer->offset;
    for (;;) {
        while (end < lexer->length && (starts_name(text[end]) || is_digit(text[end]))) end++;
        bool inner_dot = end + 1 < lexer->length && text[end] == '.' && starts_name(text[end + 1]);
        if (!inner_dot) break;
        end++;
    }
    return take(lexer, token, token_name, end - lexer->offset);
}

static bool take_unit(struct lexer *lexer, struct token *token)
{
    const char *open = lexer->text + lexer->offset;
    size_t left = lexer->length - lexer->offset;
    const char *close = memchr(open, ']', left);
    if (!close) return refuse(lexer, "a unit is written `[N]`, right after its number", "`[` without `]`");
    take(lexer, token, token_unit, (size_t)(close - open) + 1);
    token->start += 1;
    token->length -= 2;
    return true;
}

static enum token_kind sign_kind(char c, char next, size_t *size)
{
    static const struct {
        char sign;
        enum token_kind kind;
    } signs[] = {
        {'+', token_plus}, {'-', token_minus}, {'*', token_times}, {'/', token_over}, {'^', token_power},
        {'(', token_open}, {')', token_close}, {',', token_comma}, {'<', token_less}, {'>', token_greater},
    };
    *size = 2;
    if (c == '<' && next == '=') return token_less_equal;
    if (c == '>' && next == '=') return token_greater_equal;
    if (c == '=' && next == '=') return token_equal;
    *size = 1;
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++)
        if (signs[i].sign == c) return signs[i].kind;
    return token_end;
}

bool lex_next(struct lexer *lexer, struct token *token)
{
    const char *text = lexer->text;
    while (lexer->offset < lexer->length && is_blank(text[lexer->offset])) {
        lexer->offset++;
        lexer->at.column++;
    }
    if (lexer->offset >= lexer->length) return take(lexer, token, token_end, 0);
    size_t left = lexer->length - lexer->offset;
    char c = text[lexer->offset], next = left > 1 ? text[lexer->offset + 1] : '\0';
    size_t size = number_length(text + lexer->offset, left);
    if (size > 0) return take_number(lexer, token, size);
    if (starts_name(c)) return take_name(lexer, token);
    if (c == '[') return take_unit(lexer, token);
    if (c == '*' && next == '*')
        return refuse(lexer, "a power is written with `^`", "`**` cannot be used here");
    if (c == '<' && next == '>') return refuse_character(lexer);
    enum token_kind kind = sign_kind(c, next, &size);
    return kind == token_end ? refuse_character(lexer) : take(lexer, token, kind, size);
}
