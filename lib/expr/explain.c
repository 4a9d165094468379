/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Messages for texts that are no expression. They show the correction, not the grammar: `5 N + x` needs
 * brackets, `2 x` a product sign, `9.81 ms-2` another spelling of the unit.
 */
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "expr/parser.h"
#include "expr/unit_table.h"

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static bool is_word(const char *word, const char *text, size_t length)
{
    return strlen(word) == length && memcmp(word, text, length) == 0;
}

bool explain_is_known(const struct scope *scope, const char *name, size_t length)
{
    const char *const *names = NULL;
    size_t count = scope->names ? scope->names(scope->context, &names) : 0;
    for (size_t i = 0; i < count; i++)
        if (is_word(names[i], name, length)) return true;
    return is_word("t", name, length) || is_word("pi", name, length);
}

/* ---- unexpected tokens */

static void stop(struct parser *p, const char *hint, const char *message)
{
    parse_stop(p, "expression-syntax", p->token.at, hint, message);
}

/* The lower-case form of a current token such as `AND`; NULL for other tokens. */
static const char *shouted_word(const struct parser *p)
{
    static const char *const words[][2] = {{"AND", "and"}, {"And", "and"}, {"OR", "or"}, {"Or", "or"}};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (lex_is(&p->lexer, &p->token, words[i][0])) return words[i][1];
    return NULL;
}

static void explain_missing_operator(struct parser *p)
{
    int length = (int)p->token.length;
    const char *text = p->lexer.text + p->token.start;
    if (p->token.kind == token_unit) {
        stop(p, diag_hint(p->errors, "multiply by a quantity: `*1[%.*s]`", length, text),
             "a unit in brackets can only follow a number");
        return;
    }
    const char *word = shouted_word(p);
    const char *hint = word ? diag_hint(p->errors, "write `%s`", word) : "a product is written with `*`";
    diag_add(p->errors, FBD_ERROR, "expression-syntax", p->token.at, hint,
             "an operator is missing before `%.*s`", length, text);
    parse_halt(p);
}

void explain_unexpected(struct parser *p, const char *wanted)
{
    if (p->stopped) return;
    int length = (int)p->token.length;
    const char *text = p->lexer.text + p->token.start;
    bool value = strcmp(wanted, "a value") == 0;
    char message[96];
    switch (p->token.kind) {
    case token_number:
    case token_name:
    case token_open:
    case token_unit:
        if (value)
            stop(p, NULL,
                 p->token.kind == token_unit ? "a number is missing before its unit" : "a value is missing");
        else
            explain_missing_operator(p);
        return;
    case token_end:
        snprintf(message, sizeof message, "%s is missing at the end", wanted);
        stop(p, NULL, message);
        return;
    case token_close: stop(p, NULL, p->nesting ? "a value is missing before `)`" : "`)` without `(`"); return;
    case token_comma:
        stop(p, p->nesting ? NULL : "a decimal point is written `.`",
             value ? "a value is missing before `,`" : "`,` can only separate arguments");
        return;
    default:
        snprintf(message, sizeof message, "%s is missing before `%.*s`", wanted, length, text);
        stop(p, NULL, message);
    }
}

/* ---- a number and a name without an operator */

enum { longest_unit = 80 }; /* a longer run of names is no unit */

/* The length of the longest unit that `text` begins with. */
static size_t unit_length(const char *text, size_t length)
{
    struct unit unit;
    for (size_t end = length < longest_unit ? length : longest_unit; end > 0; end--) {
        bool whole = end == length || !is_letter(text[end]) || !is_letter(text[end - 1]);
        bool blank = text[end - 1] == ' ' || text[end - 1] == '\t';
        if (whole && !blank && unit_parse(text, end, unit_si, NULL, (struct pos){0}, &unit)) return end;
    }
    return 0;
}

static size_t skip_blanks(const char *text, size_t length, size_t from)
{
    while (from < length && (text[from] == ' ' || text[from] == '\t')) from++;
    return from;
}

/* True if the text behind a unit of `used` bytes is an error in the unit (`m/s2`, `ms-2`, `m^0.5`, `ft*lb`)
 * rather than the next operator of an expression. */
static bool unit_goes_wrong(const struct parser *p, const char *text, size_t length, size_t used)
{
    size_t next = skip_blanks(text, length, used);
    if (next == length) return false;
    char c = text[next];
    if (is_digit(c) || c == '^' || c == '.' || (unsigned char)c >= 0x80u) return true;
    if (c == '-') {
        size_t end = next + 1;
        while (end < length && is_digit(text[end])) end++;
        return next == used && end > next + 1 && end == length;
    }
    if (c != '*' && c != '/') return false;
    size_t name = skip_blanks(text, length, next + 1), end = name;
    while (end < length && is_letter(text[end])) end++;
    return end > name && p->scope->names && !explain_is_known(p->scope, text + name, end - name) &&
           !function_exists(text + name, end - name);
}

/* The whole text with all its units in brackets; NULL for a long one. */
static const char *with_brackets(struct parser *p)
{
    const char *text = p->lexer.text;
    const char *result = "";
    enum { longest_shown = 200 };
    size_t length = p->lexer.length, from = 0;
    if (length > longest_shown) return NULL;
    for (size_t at = 0; at < length && result;) {
        bool word = at > 0 && (is_letter(text[at - 1]) || is_digit(text[at - 1]));
        size_t digits = word ? 0 : number_length(text + at, length - at),
               unit = skip_blanks(text, length, at + digits);
        size_t used = digits ? unit_length(text + unit, length - unit) : 0;
        at += digits ? digits : 1;
        if (used == 0) continue;
        result = diag_hint(p->errors, "%s%.*s[%.*s]", result, (int)(at - from), text + from, (int)used,
                           text + unit);
        from = at = unit + used;
    }
    return result ? diag_hint(p->errors, "%s%.*s", result, (int)(length - from), text + from) : NULL;
}

/* True if parentheses do not match: inside braces a comma ends the text, even one between arguments. */
static bool is_torn(const struct parser *p)
{
    int open = 0;
    for (size_t i = 0; i < p->lexer.length; i++)
        open += (p->lexer.text[i] == '(') - (p->lexer.text[i] == ')');
    return open != 0;
}

void explain_name_after_number(struct parser *p, struct token number)
{
    const char *text = p->lexer.text + p->token.start, *digits = p->lexer.text + number.start;
    size_t length = p->lexer.length - p->token.start, used = unit_length(text, length);
    int name = (int)p->token.length, figures = (int)number.length;
    bool known = explain_is_known(p->scope, text, p->token.length) || function_exists(text, p->token.length);
    struct unit unit;
    if (shouted_word(p)) {
        explain_missing_operator(p);
        return;
    }
    if (text[0] == '_') {
        stop(p, "write 1000, not 1_000", "digits cannot be grouped");
        return;
    }
    bool slip = used ? unit_goes_wrong(p, text, length, used) : !known;
    if (slip && !unit_parse(text, length, p->scope->units, p->errors, p->token.at, &unit)) {
        parse_halt(p);
        return;
    }
    if (used) {
        const char *hint = diag_hint(p->errors, "write `%.*s[%.*s]`", figures, digits, (int)used, text);
        const char *whole = p->want->in_braces && !is_torn(p) ? with_brackets(p) : NULL;
        if (whole && compile_would_do(p, whole))
            hint = diag_hint(p->errors, "inside braces in quotes: write `\"%s\"`", whole);
        else if (known)
            hint = diag_hint(p->errors, "write `%.*s[%.*s]`, or `%.*s*%.*s` for a product", figures, digits,
                             (int)used, text, figures, digits, name, text);
        diag_add(p->errors, FBD_ERROR, "unit-needs-brackets", p->token.at, hint,
                 "inside an expression the unit `%.*s` needs brackets", (int)used, text);
    } else {
        const char *hint = diag_hint(p->errors, "write `%.*s*%.*s`", figures, digits, name, text);
        diag_add(p->errors, FBD_ERROR, "expression-syntax", p->token.at, hint,
                 "an operator is missing before `%.*s`", name, text);
    }
    parse_halt(p);
}

/* ---- unknown names */

/* True if a name, or its part behind the last dot, is one of these. */
static bool ends_as(const char *name, const char *const *called, size_t count)
{
    const char *dot = strrchr(name, '.');
    for (size_t i = 0; i < count; i++)
        if (strcmp(dot ? dot + 1 : name, called[i]) == 0) return true;
    return false;
}

/* Of accelerations: forces determine them, so none can depend on them. */
static const char *acceleration_hint(struct parser *p, const char *name)
{
    static const char *const of_points[] = {"ax", "ay", "proper_ax", "proper_ay"},
                             *const of_coordinates[] = {"v_dot",     "vx_dot",     "vy_dot",
                                                        "omega_dot", "theta_ddot", "x_ddot",
                                                        "y_ddot",    "a",          "alpha"};
    const char *dot = strrchr(name, '.');
    const size_t letters = dot ? 0 : 2; /* `a` and `alpha` alone may be anything */
    if (dot && ends_as(name, of_points, sizeof of_points / sizeof *of_points))
        return diag_hint(
            p->errors,
            "an acceleration follows from the forces and is known behind them only: `output: {points: "
            "[%.*s]}` writes it; only of a body that is driven on the ground may a value depend on it",
            (int)(dot - name), name);
    if (ends_as(name, of_coordinates, sizeof of_coordinates / sizeof *of_coordinates - letters))
        return "an acceleration follows from the forces and is known behind them only: `output` writes it; "
               "only of a body with a prescribed motion may a value of another body depend on it";
    return NULL;
}

/* Of names that textbooks have for quantities which have others here, or which a value cannot depend on. */
static const char *textbook_hint(const struct parser *p, const char *name)
{
    const bool inertia = strcmp(name, "I") == 0 || strcmp(name, "J") == 0;
    if (inertia && explain_is_known(p->scope, "I_G", strlen("I_G")))
        return "moments of inertia are `I_G`, about the centre of mass, and on a pivot `I_O`, about its axis";
    if (strcmp(name, "N") == 0)
        return "the normal force follows from the other forces, which cannot name it; as a unit N stands in "
               "brackets behind a "
               "number: `5[N]`";
    return NULL;
}

static const char *name_hint(struct parser *p, const char *name, size_t length)
{
    const char *hint = acceleration_hint(p, name);
    if (hint) return hint;
    static const char *const constants[][2] = {
        {"e", "Euler's number is `exp(1)`"},
        {"Pi", "write `pi`"},
        {"PI", "write `pi`"},
        {"inf", "numbers are finite here"},
        {"nan", "numbers are finite here"},
        {"true", "write a comparison"},
        {"false", "write a comparison"},
    };
    const char *const *names = NULL, *const *names_of_tables = NULL;
    size_t count = p->scope->names ? p->scope->names(p->scope->context, &names) : 0;
    for (size_t i = 0; i < sizeof constants / sizeof constants[0]; i++)
        if (strcmp(constants[i][0], name) == 0) return constants[i][1];
    if (function_exists(name, length))
        return diag_hint(p->errors, "`%s` is a function: write `%s(...)`", name, name);
    size_t tables = p->scope->tables ? p->scope->tables(p->scope->context, &names_of_tables) : 0;
    for (size_t i = 0; i < tables; i++)
        if (strcmp(names_of_tables[i], name) == 0)
            return diag_hint(p->errors, "`%s` is a table: write `%s(...)` with its argument", name, name);
    hint = textbook_hint(p, name);
    if (hint) return hint;
    if (unit_find(name, length))
        return diag_hint(p->errors, "`%s` as a unit stands in brackets behind a number: `5[%s]`", name, name);
    return diag_nearest(p->errors, name, names, count);
}

void explain_unknown_name(struct parser *p, struct token name)
{
    const char *text = arena_text(&p->builder->scratch, p->lexer.text + name.start, name.length);
    p->failed = true;
    if (!text) return;
    diag_add(p->errors, FBD_ERROR, "unknown-name", name.at, name_hint(p, text, name.length),
             "nothing is called `%s` here", text);
    /* Stop: the argument without parentheses would only give a second error. */
    if (function_exists(text, name.length)) parse_halt(p);
}
