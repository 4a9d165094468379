/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Expression text to tokens.
 */
#ifndef FBD_EXPR_LEX_H
#define FBD_EXPR_LEX_H

#include "base/diag.h"

enum token_kind {
    token_end,
    token_number,
    token_name, /* letters, digits, underscores and inner dots; also and, or, not */
    token_unit, /* [ ... ]; positioned at the bracket; start and length are those of the text inside */
    token_plus,
    token_minus,
    token_times,
    token_over,
    token_power,
    token_open,
    token_close,
    token_comma,
    token_less,
    token_less_equal,
    token_greater,
    token_greater_equal,
    token_equal,
};

struct token {
    enum token_kind kind;
    size_t start, length; /* in bytes */
    struct pos at;
    double number;
};

struct lexer {
    const char *text;
    size_t length;
    struct pos start; /* position of text[0] */
    fbd_errors *errors;
    size_t offset; /* start of the next token */
    struct pos at; /* position of text[offset] */
};

void lex_start(struct lexer *lexer, const char *text, size_t length, struct pos start, fbd_errors *errors);

/* The next token. False with one note (`expression-syntax` or `not-finite`) when there is no valid one. */
bool lex_next(struct lexer *lexer, struct token *token);

/* True when `token` is the name `word`. */
bool lex_is(const struct lexer *lexer, const struct token *token, const char *word);

#endif
