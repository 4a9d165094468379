/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/expr.h"
#include "expr/lex.h"

static bool ends_operand(enum token_kind kind)
{
    return kind == token_number || kind == token_name || kind == token_unit || kind == token_close;
}

size_t expr_summands(const char *text, size_t length, struct summand *summands, size_t room)
{
    struct lexer lexer;
    struct token token;
    lex_start(&lexer, text, length, (struct pos){0, 0}, NULL);
    enum token_kind before = token_end;
    int depth = 0;
    size_t count = 0;
    bool inside = false, negative = false;
    while (lex_next(&lexer, &token) && token.kind != token_end) {
        bool sign = depth == 0 && (token.kind == token_plus || token.kind == token_minus);
        if (token.kind == token_open) depth++;
        if (token.kind == token_close) depth--;
        if (sign && !inside) negative ^= token.kind == token_minus;
        if (sign && inside && ends_operand(before)) {
            inside = false;
            negative = token.kind == token_minus;
        } else if (!inside && !sign) {
            inside = true;
            if (count < room) summands[count] = (struct summand){token.start, 0, negative};
            count++;
        }
        before = token.kind;
        size_t end = token.start + token.length + (token.kind == token_unit);
        if (inside && count <= room) summands[count - 1].length = end - summands[count - 1].start;
    }
    return count;
}
