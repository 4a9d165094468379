/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The parts of reading an expression: grammar (parse.c), functions (function.c), dimensions (check.c), and
 * messages for a text that is no expression (explain.c).
 *
 * After an error of dimension or name, reading continues with an operand of kind `failed`, so that all such
 * errors of a text are reported at once. After an error of syntax it stops: the current token becomes
 * token_end, and no further errors are noted.
 */
#ifndef FBD_EXPR_PARSER_H
#define FBD_EXPR_PARSER_H

#include "expr/build.h"
#include "expr/lex.h"

struct parser {
    struct lexer lexer;
    struct token token; /* the next token */
    struct builder *builder;
    const struct scope *scope;
    const struct expr_want *want;
    fbd_errors *errors;
    int nesting;
    bool failed, stopped;
};

enum { nesting_limit = 100, most_arguments = 8 };

/* Read the whole text as one expression. `failed` is the outcome. */
struct operand parse_all(struct parser *parser);

/* Read a condition or sum in parentheses or an argument. */
struct operand parse_expression(struct parser *parser);

/* Go to the next token. */
void parse_advance(struct parser *parser);

/* Note an error of syntax and stop. */
void parse_stop(struct parser *parser, const char *id, struct pos at, const char *hint, const char *message);

/* Stop after an error of syntax that was noted already. */
void parse_halt(struct parser *parser);

/* The operand that results from an error. */
struct operand parse_failed(struct parser *parser, struct pos at);

/* Enter a level (parentheses, signs, exponents); false, with an error, when that is too deep. */
bool parse_enter(struct parser *parser);
void parse_leave(struct parser *parser);

/* ---- compile.c */

/* True if `text` would be a valid expression in the place of this one. */
bool compile_would_do(const struct parser *parser, const char *text);

/* ---- function.c */

/* True when `name[0..length)` is a function. */
bool function_exists(const char *name, size_t length);

/* Read the call of the function `name`; the current token is its opening parenthesis. */
struct operand function_call(struct parser *parser, struct token name);

/* a^b */
struct operand function_power(struct parser *parser, int base, const struct operand *a,
                              const struct operand *b, struct pos at);

/* ---- check.c: the kind of a result; an error is reported and yields the kind `failed` */

/* A quantity in words: "force [N]", "a pure number". */
struct phrase {
    char text[160];
};
struct phrase check_phrase(struct dim dim, enum unit_system units);

/* The common kind of `a` and `b`, where a free one adapts; else the error "cannot VERB a JOINT b", as in
 * "cannot add force [N] and length [m]". */
struct kind check_same(struct parser *parser, struct pos at, const char *verb, const struct operand *a,
                       const char *joint, const struct operand *b);

struct kind check_product(struct parser *parser, bool divide, const struct operand *a,
                          const struct operand *b);
struct kind check_power(struct parser *parser, const struct operand *a, const struct operand *b);

/* A root of degree 2 or 3. */
struct kind check_root(struct parser *parser, const struct operand *a, int degree);

/* An argument of `function` that must be a pure number or free. */
struct kind check_pure(struct parser *parser, const struct operand *a, const char *function);

/* True for a bare number beyond one turn, as `30` for `30 deg`. */
bool check_is_bare_angle(const struct operand *a);

/* Warn of such a number compared with an angle. */
void check_note_bare_angle(fbd_errors *errors, struct pos at, double value);

/* Check for a number or a condition; false with an error when it is the other one. */
bool check_number(struct parser *parser, const struct operand *a);
bool check_condition(struct parser *parser, const struct operand *a);

/* ---- explain.c: errors of syntax */

/* Note that the current token cannot stand here; `wanted` names a valid one, as "an operator" or "`)`". */
void explain_unexpected(struct parser *parser, const char *wanted);

/* Note that the current token, a name, follows the number `number` without an operator. */
void explain_name_after_number(struct parser *parser, struct token number);

/* Note an unknown name. */
void explain_unknown_name(struct parser *parser, struct token name);

/* True when the scope lists `name[0..length)`, or for t and pi. */
bool explain_is_known(const struct scope *scope, const char *name, size_t length);

#endif
