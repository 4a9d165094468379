/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "expr/glyph.h"
#include "expr/parser.h"

enum { text_limit = 16384 };

struct span {
    const char *text;
    size_t length;
    struct pos at;
};

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

static struct span skip(struct span span, size_t bytes)
{
    struct pos at = {span.at.line, span.at.column + (int)bytes};
    return (struct span){span.text + bytes, span.length - bytes, at};
}

static struct span trim(struct span span)
{
    while (span.length && is_blank(span.text[0])) span = skip(span, 1);
    while (span.length && is_blank(span.text[span.length - 1])) span.length--;
    return span;
}

/* ---- a scalar that consists of a number and a unit: `30 deg`, `-5 lbf` */

struct quantity {
    struct span number, unit; /* with the sign; the trimmed unit */
    struct unit read;
};

static bool read_quantity(struct span span, enum unit_system units, struct quantity *quantity)
{
    size_t sign = span.length && (span.text[0] == '-' || span.text[0] == '+') ? 1 : 0;
    size_t digits = number_length(span.text + sign, span.length - sign);
    if (!digits) return false;
    struct span unit = trim(skip(span, sign + digits));
    if (!unit.length || !(is_letter(unit.text[0]) || unit.text[0] == '1')) return false;
    quantity->number = (struct span){span.text, sign + digits, span.at};
    quantity->unit = unit;
    return unit_parse(unit.text, unit.length, units, NULL, unit.at, &quantity->read);
}

static struct operand quantity_operand(const struct quantity *quantity)
{
    double number = HUGE_VAL;
    number_read(quantity->number.text, quantity->number.length, &number);
    number *= quantity->read.factor;
    struct operand result =
        build_constant(number, (struct kind){.dim = quantity->read.dim}, quantity->unit.at);
    result.is_broken = !isfinite(number);
    result.broken = quantity->number.at;
    return result;
}

/* ---- a single number */

/* False for a number out of range: the parser reports it. */
static bool read_number(struct span span, struct operand *whole)
{
    if (span.length == 0 || number_length(span.text, span.length) != span.length) return false;
    *whole = build_constant(number_value(span.text, span.length), (struct kind){.free = true}, span.at);
    return isfinite(whole->value);
}

/* ---- a quantity of the wrong dimension */

bool compile_would_do(const struct parser *p, const char *text)
{
    struct arena scratch = {0};
    struct expr_want want = *p->want;
    want.in_braces = false; /* the hint shows the expression in quotes */
    fbd_errors *errors = fbd_errors_new();
    bool right = errors && expr_compile(&scratch, text, p->lexer.start, p->scope, &want, errors) != NULL;
    if (!errors || errors->out_of_memory || scratch.failed) diag_out_of_memory(p->errors);
    fbd_errors_free(errors);
    arena_free(&scratch);
    return right;
}

/* The unit of the number before a name such that the expression has the wanted dimension: the given one if it
 * fits (a bare number before a variable takes any dimension), else the required one. False for a bare number
 * before a constant of another dimension. */
static bool unit_before(const struct parser *p, const struct quantity *q, size_t before, size_t name,
                        size_t end, bool over, char *text, size_t size)
{
    struct unit own = {.dim = DIM_NONE};
    const char *copy = arena_text(&p->builder->scratch, q->unit.text + name, end - name);
    if (!copy || (before && !unit_parse(q->unit.text, before, p->scope->units, NULL, q->unit.at, &own)))
        return false;
    struct symbol symbol = p->scope->lookup(p->scope->context, copy, q->unit.at);
    if (symbol.kind != symbol_constant && symbol.kind != symbol_variable) return false;
    const struct dim wanted = over ? dim_times(p->want->dim, symbol.dim) : dim_over(p->want->dim, symbol.dim);
    bool fits = symbol.free || dim_equal(own.dim, wanted) || (!before && symbol.kind == symbol_variable);
    if (fits || end < q->unit.length)
        snprintf(text, size, "%.*s", (int)before, q->unit.text);
    else
        unit_name(wanted, p->scope->units, text, size);
    return fits || before > 0;
}

/* A hint for `4 N*t`, 4 newton times tonnes, if the variable t was meant: `4[N/s]*t`. NULL if no name in the
 * unit is also a name of the scope, or if the replacement does not compile. `is_time`: the name is t. */
static const char *hint_of_name(const struct parser *p, const struct quantity *q, bool *is_time)
{
    char own[96] = "";
    const char *unit = q->unit.text;
    for (size_t at = 0; at < q->unit.length;) {
        size_t end = at;
        while (end < q->unit.length && is_letter(unit[end])) end++;
        if (end > at && explain_is_known(p->scope, unit + at, end - at)) {
            size_t before = at;
            while (before && is_blank(unit[before - 1])) before--;
            bool over = before && unit[before - 1] == '/';
            if (before && (over || unit[before - 1] == '*' || unit[before - 1] == '.')) before--;
            while (before && is_blank(unit[before - 1])) before--;
            bool known = unit_before(p, q, before, at, end, over, own, sizeof own);
            const char *variable = diag_hint(p->errors, "%.*s%s%s%s%c%.*s", (int)q->number.length,
                                             q->number.text, *own ? "[" : "", own, *own ? "]" : "",
                                             over ? '/' : '*', (int)(q->unit.length - at), unit + at);
            *is_time = end - at == 1 && unit[at] == 't';
            if (known && variable && compile_would_do(p, variable))
                return diag_hint(p->errors, "`%.*s` is a unit here; for the variable write `%s`",
                                 (int)(end - at), unit + at, variable);
        }
        at = end > at ? end : at + 1;
    }
    return NULL;
}

/* `N/m/s` is N/(m*s). A hint if a/(b/c) has the wanted dimension. */
static const char *hint_of_division(const struct quantity *q, const struct expr_want *want,
                                    fbd_errors *errors)
{
    char other[96];
    struct unit unit;
    const char *text = q->unit.text, *end = text + q->unit.length;
    const char *first = memchr(text, '/', q->unit.length);
    const char *second = first ? memchr(first + 1, '/', (size_t)(end - first - 1)) : NULL;
    if (!second || memchr(text, '(', q->unit.length)) return NULL;
    int a = (int)(first - text), b = (int)(second - first - 1), c = (int)(end - second - 1);
    int length = snprintf(other, sizeof other, "%.*s*%.*s/%.*s", a, text, c, second + 1, b, first + 1);
    if (length < 0 || (size_t)length >= sizeof other) return NULL;
    if (!unit_parse(other, (size_t)length, unit_si, NULL, q->unit.at, &unit) ||
        !dim_equal(unit.dim, want->dim))
        return NULL;
    return diag_hint(errors, "`%.*s` divides twice, by %.*s and by %.*s; write `%s`", (int)q->unit.length,
                     text, b, first + 1, c, second + 1, other);
}

static const char *hint_of_want(struct parser *p, const struct operand *got, const struct quantity *q)
{
    char text[160];
    const struct expr_want *want = p->want;
    const char *hint = q ? hint_of_division(q, want, p->errors) : NULL;
    if (hint) return hint;
    if (q && q->unit.length == 1 && q->unit.text[0] == 'g' && dim_equal(want->dim, DIM_ACCELERATION))
        return "`g` is the gram; standard gravity is 9.80665 m/s^2";
    if (!q && dim_equal(got->kind.dim, DIM_NONE)) {
        unit_name(want->dim, p->scope->units, text, sizeof text);
        return diag_hint(p->errors, "a pure number can be multiplied by `1[%s]`", text);
    }
    if (dim_equal(want->dim, DIM_NONE)) return NULL;
    const struct dim power = dim_over(got->kind.dim, want->dim);
    if (!q && dim_equal(want->dim, DIM_LENGTH) && power.length > 0 && power.mass == 0 && power.time == 0) {
        unit_name(power, p->scope->units, text, sizeof text); /* y = x^2 */
        return diag_hint(p->errors, "divide it by `1[%s]` to make it a length", text);
    }
    unit_examples(want->dim, text, sizeof text);
    if (!text[0]) return NULL;
    if (!q) return diag_hint(p->errors, "units of %s: %s", unit_quantity(want->dim), text);
    char unit[64];
    unit_name(want->dim, p->scope->units, unit, sizeof unit);
    return diag_hint(p->errors, "units of %s: %s, as in `%.*s %s`", unit_quantity(want->dim), text,
                     (int)q->number.length, q->number.text, unit);
}

/* ---- checks of the result */

static bool check_dimension(struct parser *p, const struct operand *got, const struct quantity *quantity)
{
    const struct expr_want *want = p->want;
    if (want->any_dim || got->kind.free || dim_equal(got->kind.dim, want->dim)) return true;
    struct phrase needed = check_phrase(want->dim, p->scope->units);
    struct phrase given = check_phrase(got->kind.dim, p->scope->units);
    const bool divides = quantity && hint_of_division(quantity, want, p->errors);
    bool is_time = false;
    const char *name = quantity && !divides ? hint_of_name(p, quantity, &is_time) : NULL;
    diag_add(p->errors, FBD_ERROR, name && is_time ? "time-as-unit" : "wrong-dimension", got->at,
             name ? name : hint_of_want(p, got, quantity), "`%s` needs %s, not %s",
             want->what ? want->what : "this", needed.text, given.text);
    return false;
}

static void warn_of_angle(struct parser *p, const struct operand *got, const struct quantity *quantity)
{
    if (p->want->angle && check_is_bare_angle(got))
        diag_add(p->errors, FBD_WARNING, "bare-angle", got->at,
                 "a bare angle is in rad; degrees are `30 deg`", "`%s` is more than one turn",
                 p->want->what ? p->want->what : "this angle");
    bool rate = !p->want->any_dim && dim_equal(p->want->dim, DIM_RATE);
    if (rate && quantity && quantity->read.hertz && !quantity->read.angle)
        diag_add(p->errors, FBD_WARNING, "hertz-as-rate", got->at, "turns per second are `rev/s`",
                 "1 Hz is read as 1 rad/s, not as one turn per second");
}

static bool check_whole(struct parser *p, const struct operand *got, const struct quantity *quantity)
{
    if (p->failed || got->kind.failed) return false;
    bool kind_fits = p->want->condition ? check_condition(p, got) : check_number(p, got);
    if (!kind_fits) return false;
    if (!p->want->condition && !check_dimension(p, got, quantity)) return false;
    if (got->is_broken) {
        diag_add(p->errors, FBD_ERROR, "not-finite", got->broken, NULL,
                 "this has no finite value, as in a division by zero");
        return false;
    }
    if (build_is_too_long(p->builder)) {
        diag_add(p->errors, FBD_ERROR, "expression-too-long", p->lexer.start,
                 "name parts of it as parameters",
                 "the expression has more than %d operations or %d different values", operation_limit,
                 frame_limit);
        return false;
    }
    warn_of_angle(p, got, quantity);
    return true;
}

/* ---- compiling */

static struct expr *compile_span(struct arena *arena, struct span span, const struct scope *scope,
                                 const struct expr_want *want, fbd_errors *errors)
{
    struct builder builder = {.depth = 0};
    struct parser parser = {.builder = &builder, .scope = scope, .want = want, .errors = errors};
    struct quantity quantity;
    struct operand whole;
    span = trim(span);
    if (span.length > text_limit) {
        diag_add(errors, FBD_ERROR, "expression-too-long", span.at, "name parts of it as parameters",
                 "the expression has more than %d characters", text_limit);
        return NULL;
    }
    bool is_quantity = read_quantity(span, scope->units, &quantity);
    lex_start(&parser.lexer, span.text, span.length, span.at, errors);
    if (is_quantity)
        whole = quantity_operand(&quantity);
    else if (!read_number(span, &whole))
        whole = parse_all(&parser);
    struct expr *expr = NULL;
    if (builder.scratch.failed) {
        diag_out_of_memory(errors);
    } else if (check_whole(&parser, &whole, is_quantity ? &quantity : NULL)) {
        expr = build_finish(&builder, arena, &whole);
        if (!expr) diag_out_of_memory(errors);
        if (expr && !want->any_dim && !want->condition) expr->dim = want->dim;
        if (expr) expr->angle = whole.angle;
        if (expr) expr->bare_angle = check_is_bare_angle(&whole);
    }
    build_free(&builder);
    return expr;
}

const struct expr *expr_compile(struct arena *arena, const char *text, struct pos at,
                                const struct scope *scope, const struct expr_want *want, fbd_errors *errors)
{
    return compile_span(arena, (struct span){text, strlen(text), at}, scope, want, errors);
}

const struct expr *expr_constant(struct arena *arena, double value, struct dim dim)
{
    struct expr *expr = ARENA_NEW(arena, struct expr);
    double *constant = ARENA_NEW(arena, double);
    if (!expr || !constant) return NULL;
    *constant = value;
    *expr = (struct expr){.constants = 1, .constant = constant, .dim = dim};
    return expr;
}

/* ---- relations */

struct relation {
    size_t at, size; /* of the sign; size 0 when there is none */
    size_t again;    /* of a second one, or 0 */
};

static struct relation find_relation(const char *text, size_t length)
{
    struct relation found = {0};
    int depth = 0;
    for (size_t i = 0; i < length; i++) {
        char c = text[i];
        if (c == '(' || c == '[') depth++;
        if (c == ')' || c == ']') depth--;
        if (depth != 0 || (c != '=' && c != '<' && c != '>')) continue;
        if (found.size) {
            found.again = i;
            return found;
        }
        found.at = i;
        found.size = i + 1 < length && text[i + 1] == '=' ? 2 : 1;
        i += found.size - 1;
    }
    return found;
}

/* Compare the dimensions of both sides, which compiled without errors; a free one takes that of the other. */
static bool match_sides(struct expr *left, struct expr *right, struct pos at, enum unit_system units,
                        fbd_errors *errors)
{
    if (left->bare && !right->bare) left->dim = right->dim;
    if (right->bare && !left->bare) right->dim = left->dim;
    if ((left->angle && right->bare_angle) || (right->angle && left->bare_angle))
        check_note_bare_angle(errors, at, expr_value(left->angle ? right : left));
    if (left->bare || right->bare || dim_equal(left->dim, right->dim)) return true;
    struct phrase a = check_phrase(left->dim, units), b = check_phrase(right->dim, units);
    diag_add(errors, FBD_ERROR, "wrong-dimension", at, "both sides must have the same dimension",
             "the left side is %s, the right side is %s", a.text, b.text);
    return false;
}

bool expr_compile_relation(struct arena *arena, const char *text, struct pos at, const struct scope *scope,
                           const struct expr_want *want, fbd_errors *errors, const struct expr **left,
                           char *relation, const struct expr **right)
{
    struct span whole = {text, strlen(text), at};
    struct relation sign = find_relation(text, whole.length);
    *relation = sign.size ? text[sign.at] : '\0';
    *left = *right = NULL;
    if (sign.again) {
        diag_add(errors, FBD_ERROR, "expression-syntax", glyph_pos(text, sign.again, at), NULL,
                 "only one of `=`, `<`, `>` can stand here");
        return false;
    }
    if (!sign.size) {
        *left = compile_span(arena, whole, scope, want, errors);
        return *left != NULL;
    }
    size_t end = sign.at + sign.size;
    struct span first = {text, sign.at, at};
    struct span second = {text + end, whole.length - end, glyph_pos(text, end, at)};
    struct expr *a = compile_span(arena, first, scope, want, errors);
    struct expr *b = compile_span(arena, second, scope, want, errors);
    if (!a || !b || !match_sides(a, b, glyph_pos(text, sign.at, at), scope->units, errors)) return false;
    *left = a;
    *right = b;
    return true;
}
