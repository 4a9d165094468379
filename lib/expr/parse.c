/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/parser.h"

#include <math.h>

static struct operand parse_or(struct parser *p);
static struct operand parse_unary(struct parser *p);

/* ---- parser state */

void parse_halt(struct parser *p)
{
    p->failed = p->stopped = true;
    p->token = (struct token){.kind = token_end, .start = p->lexer.length, .at = p->lexer.at};
}

void parse_stop(struct parser *p, const char *id, struct pos at, const char *hint, const char *message)
{
    if (!p->stopped) diag_add(p->errors, FBD_ERROR, id, at, hint, "%s", message);
    parse_halt(p);
}

void parse_advance(struct parser *p)
{
    if (!p->stopped && !lex_next(&p->lexer, &p->token)) parse_halt(p);
}

struct operand parse_failed(struct parser *p, struct pos at)
{
    p->failed = true;
    return build_constant(1, (struct kind){.free = true, .failed = true}, at);
}

bool parse_enter(struct parser *p)
{
    if (++p->nesting <= nesting_limit) return true;
    parse_stop(p, "expression-too-long", p->token.at, "name parts of it as parameters",
               "the expression is nested more than 100 deep");
    return false;
}

void parse_leave(struct parser *p)
{
    p->nesting--;
}

static bool at_word(const struct parser *p, const char *word)
{
    return lex_is(&p->lexer, &p->token, word);
}

/* ---- leaves */

static struct operand parse_number(struct parser *p)
{
    struct token number = p->token;
    struct kind kind = {.free = true};
    double value = number.number;
    parse_advance(p);
    if (p->token.kind == token_unit) {
        struct unit unit;
        const char *text = p->lexer.text + p->token.start;
        struct pos inside = {p->token.at.line, p->token.at.column + 1};
        if (unit_parse(text, p->token.length, p->scope->units, p->errors, inside, &unit)) {
            kind = (struct kind){.dim = unit.dim};
            value *= unit.factor;
            parse_advance(p);
        } else {
            parse_advance(p);
            return parse_failed(p, number.at);
        }
    } else if (p->token.kind == token_name && !at_word(p, "and") && !at_word(p, "or")) {
        explain_name_after_number(p, number);
        return parse_failed(p, number.at);
    }
    struct operand result = build_constant(value, kind, number.at);
    if (!isfinite(value)) {
        result.is_broken = true;
        result.broken = number.at;
    }
    return result;
}

static struct operand not_constant(struct parser *p, struct token name, const char *because)
{
    const char *text = p->lexer.text + name.start;
    diag_add(p->errors, FBD_ERROR, "not-constant", name.at, "use numbers and parameters only",
             "`%s` must be constant, but `%.*s` %s", p->want->what ? p->want->what : "this", (int)name.length,
             text, because ? because : "changes with the motion");
    return parse_failed(p, name.at);
}

static struct operand parse_symbol(struct parser *p, struct token name)
{
    const char *text = arena_text(&p->builder->scratch, p->lexer.text + name.start, name.length);
    if (!text) return parse_failed(p, name.at);
    struct symbol symbol = p->scope->lookup(p->scope->context, text, name.at);
    struct kind kind = {.dim = symbol.dim, .free = symbol.free};
    struct operand variable;
    switch (symbol.kind) {
    case symbol_constant: return build_constant(symbol.value, kind, name.at);
    case symbol_variable:
        if (p->want->constant) return not_constant(p, name, symbol.because);
        variable = build_variable(symbol.slot, kind, name.at);
        variable.angle = symbol.angle;
        return variable;
    case symbol_unknown: explain_unknown_name(p, name); return parse_failed(p, name.at);
    default: return parse_failed(p, name.at);
    }
}

static struct operand parse_name(struct parser *p)
{
    struct token name = p->token;
    if (at_word(p, "and") || at_word(p, "or") || at_word(p, "not")) {
        explain_unexpected(p, "a value");
        return parse_failed(p, name.at);
    }
    parse_advance(p);
    if (p->token.kind == token_open) return function_call(p, name);
    if (lex_is(&p->lexer, &name, "pi")) {
        struct operand pi = build_constant(3.14159265358979323846, (struct kind){.free = true}, name.at);
        pi.rest = 1.2246467991473531772e-16;
        pi.pi = true;
        return pi;
    }
    return parse_symbol(p, name);
}

static struct operand parse_primary(struct parser *p)
{
    struct pos at = p->token.at;
    if (p->token.kind == token_number) return parse_number(p);
    if (p->token.kind == token_name) return parse_name(p);
    if (p->token.kind != token_open) {
        explain_unexpected(p, "a value");
        return parse_failed(p, at);
    }
    if (!parse_enter(p)) return parse_failed(p, at);
    parse_advance(p);
    struct operand inner = parse_or(p);
    if (p->token.kind == token_close)
        parse_advance(p);
    else
        explain_unexpected(p, "`)`");
    parse_leave(p);
    return inner;
}

/* ---- operators, tightest first */

static struct operand parse_power(struct parser *p)
{
    int base = p->builder->depth;
    struct operand left = parse_primary(p);
    if (p->token.kind != token_power) return left;
    struct pos at = p->token.at;
    if (!parse_enter(p)) return parse_failed(p, at);
    parse_advance(p);
    struct operand right = parse_unary(p);
    parse_leave(p);
    return function_power(p, base, &left, &right, at);
}

static struct operand parse_unary(struct parser *p)
{
    if (p->token.kind != token_minus && p->token.kind != token_plus) return parse_power(p);
    int base = p->builder->depth;
    struct token sign = p->token;
    if (!parse_enter(p)) return parse_failed(p, sign.at);
    parse_advance(p);
    struct operand inner = parse_unary(p);
    parse_leave(p);
    if (!check_number(p, &inner)) return parse_failed(p, sign.at);
    if (sign.kind == token_plus) return inner;
    return build_operation(p->builder, base, op_negate, 0, &inner, NULL, inner.kind, sign.at);
}

static struct operand parse_product(struct parser *p)
{
    int base = p->builder->depth;
    struct operand left = parse_unary(p);
    while (p->token.kind == token_times || p->token.kind == token_over) {
        struct pos at = p->token.at;
        bool divide = p->token.kind == token_over;
        parse_advance(p);
        struct operand right = parse_unary(p);
        struct kind kind = check_product(p, divide, &left, &right);
        left =
            build_operation(p->builder, base, divide ? op_divide : op_multiply, 0, &left, &right, kind, at);
    }
    return left;
}

static struct operand parse_sum(struct parser *p)
{
    int base = p->builder->depth;
    struct operand left = parse_product(p);
    while (p->token.kind == token_plus || p->token.kind == token_minus) {
        struct pos at = p->token.at;
        bool minus = p->token.kind == token_minus;
        parse_advance(p);
        struct operand right = parse_product(p);
        struct kind kind = minus ? check_same(p, at, "subtract", &right, "from", &left)
                                 : check_same(p, at, "add", &left, "and", &right);
        left = build_operation(p->builder, base, minus ? op_subtract : op_add, 0, &left, &right, kind, at);
    }
    return left;
}

static bool comparison(enum token_kind kind, enum op *op)
{
    switch (kind) {
    case token_less: *op = op_less; return true;
    case token_less_equal: *op = op_less_equal; return true;
    case token_greater: *op = op_greater; return true;
    case token_greater_equal: *op = op_greater_equal; return true;
    case token_equal: *op = op_equal; return true;
    default: return false;
    }
}

static struct operand parse_comparison(struct parser *p)
{
    int base = p->builder->depth;
    enum op op, again;
    struct operand left = parse_sum(p);
    if (!comparison(p->token.kind, &op)) return left;
    struct pos at = p->token.at;
    parse_advance(p);
    struct operand right = parse_sum(p);
    struct kind kind = check_same(p, at, "compare", &left, "with", &right);
    if ((left.angle && check_is_bare_angle(&right)) || (right.angle && check_is_bare_angle(&left)))
        check_note_bare_angle(p->errors, at, left.angle ? right.value : left.value);
    if (comparison(p->token.kind, &again))
        parse_stop(p, "expression-syntax", p->token.at, "write `a < b and b < c`",
                   "comparisons cannot be chained");
    return build_operation(p->builder, base, op, 0, &left, &right,
                           (struct kind){.truth = true, .failed = kind.failed}, at);
}

static struct operand parse_not(struct parser *p)
{
    if (!at_word(p, "not")) return parse_comparison(p);
    int base = p->builder->depth;
    struct pos at = p->token.at;
    if (!parse_enter(p)) return parse_failed(p, at);
    parse_advance(p);
    struct operand inner = parse_not(p);
    parse_leave(p);
    if (!check_condition(p, &inner)) return parse_failed(p, at);
    return build_operation(p->builder, base, op_not, 0, &inner, NULL, inner.kind, at);
}

static struct operand parse_joined(struct parser *p, const char *word, enum op op,
                                   struct operand (*parse_part)(struct parser *))
{
    int base = p->builder->depth;
    struct operand left = parse_part(p);
    while (at_word(p, word)) {
        struct pos at = p->token.at;
        parse_advance(p);
        struct operand right = parse_part(p);
        bool left_sound = check_condition(p, &left), right_sound = check_condition(p, &right);
        struct kind kind = {.truth = true, .failed = !left_sound || !right_sound};
        left = build_operation(p->builder, base, op, 0, &left, &right, kind, at);
    }
    return left;
}

static struct operand parse_and(struct parser *p)
{
    return parse_joined(p, "and", op_and, parse_not);
}

static struct operand parse_or(struct parser *p)
{
    return parse_joined(p, "or", op_or, parse_and);
}

struct operand parse_expression(struct parser *p)
{
    return parse_or(p);
}

struct operand parse_all(struct parser *p)
{
    parse_advance(p);
    if (p->token.kind == token_end && !p->stopped)
        parse_stop(p, "expression-syntax", p->token.at, NULL, "an expression is missing");
    struct operand whole = parse_or(p);
    if (p->token.kind != token_end) explain_unexpected(p, "an operator");
    return whole;
}
