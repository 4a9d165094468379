/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "expr/parser.h"

struct phrase check_phrase(struct dim dim, enum unit_system units)
{
    struct phrase phrase;
    char unit[64];
    const char *name = unit_quantity(dim);
    unit_name(dim, units, unit, sizeof unit);
    if (dim_equal(dim, DIM_NONE))
        snprintf(phrase.text, sizeof phrase.text, "a pure number");
    else
        snprintf(phrase.text, sizeof phrase.text, "%s [%s]", name ? name : "a quantity", unit);
    return phrase;
}

static struct kind failed_kind(struct parser *p)
{
    p->failed = true;
    return (struct kind){.free = true, .failed = true};
}

/* Note an error, unless an error of syntax has stopped the parser. */
static void note(struct parser *p, const char *id, struct pos at, const char *hint, const char *message)
{
    if (!p->stopped) diag_add(p->errors, FBD_ERROR, id, at, hint, "%s", message);
    p->failed = true;
}

/* ---- numbers and conditions */

bool check_number(struct parser *p, const struct operand *a)
{
    if (!a->kind.truth || a->kind.failed) return !a->kind.failed;
    note(p, "expression-syntax", a->at, "write `if(condition, 1, 0)` for a number that depends on it",
         "a condition where a number is needed");
    return false;
}

/* Check both, so that both are reported. */
static bool check_numbers(struct parser *p, const struct operand *a, const struct operand *b)
{
    bool first = check_number(p, a), second = check_number(p, b);
    return first && second;
}

bool check_condition(struct parser *p, const struct operand *a)
{
    if (a->kind.truth || a->kind.failed) return !a->kind.failed;
    note(p, "expression-syntax", a->at, "compare it with something, as in `x > 0`",
         "a number where a condition is needed");
    return false;
}

/* ---- equal dimensions */

/* A hint at a possibly missing factor: "stiffness [N/m] times length is force". */
static const char *missing_factor(struct parser *p, struct dim a, struct dim b)
{
    enum unit_system units = p->scope->units;
    struct dim pure = DIM_NONE;
    char unit[64];
    if (dim_equal(a, pure) || dim_equal(b, pure)) {
        unit_name(dim_equal(a, pure) ? b : a, units, unit, sizeof unit);
        return diag_hint(p->errors, "a pure number can be multiplied by `1[%s]`", unit);
    }
    for (int turn = 0; turn < 2; turn++) {
        struct dim large = turn ? b : a, small = turn ? a : b, factor = dim_over(large, small);
        const char *names[] = {unit_quantity(factor), unit_quantity(small), unit_quantity(large)};
        if (!names[0] || !names[1] || !names[2]) continue;
        unit_name(factor, units, unit, sizeof unit);
        return diag_hint(p->errors, "is a factor missing? %s [%s] times %s is %s", names[0], unit, names[1],
                         names[2]);
    }
    return "both must have the same dimension";
}

struct kind check_same(struct parser *p, struct pos at, const char *verb, const struct operand *a,
                       const char *joint, const struct operand *b)
{
    if (!check_numbers(p, a, b)) return failed_kind(p);
    bool equal = dim_equal(a->kind.dim, b->kind.dim);
    if (a->kind.free && b->kind.free) {
        struct kind kind = {.free = true};
        if (equal || dim_equal(b->kind.dim, DIM_NONE))
            kind.dim = a->kind.dim;
        else if (dim_equal(a->kind.dim, DIM_NONE))
            kind.dim = b->kind.dim;
        return kind;
    }
    if (a->kind.free) return b->kind;
    if (b->kind.free || equal) return a->kind;
    struct phrase left = check_phrase(a->kind.dim, p->scope->units);
    struct phrase right = check_phrase(b->kind.dim, p->scope->units);
    char message[400];
    snprintf(message, sizeof message, "cannot %s %s %s %s", verb, left.text, joint, right.text);
    note(p, "wrong-dimension", at, missing_factor(p, a->kind.dim, b->kind.dim), message);
    return failed_kind(p);
}

/* ---- products, powers and roots */

struct kind check_product(struct parser *p, bool divide, const struct operand *a, const struct operand *b)
{
    if (!check_numbers(p, a, b)) return failed_kind(p);
    return (struct kind){.dim = divide ? dim_over(a->kind.dim, b->kind.dim)
                                       : dim_times(a->kind.dim, b->kind.dim),
                         .free = a->kind.free || b->kind.free};
}

/* dim^value for the fractions that exponents can have: halves, thirds, quarters, sixths and twelfths. A third
 * has no exact double, hence the tolerance of some roundings. */
static bool dim_real_power(struct dim dim, double value, struct dim *result)
{
    double twelfths = value * dim_unit, whole = round(twelfths);
    if (fabs(twelfths - whole) > 1e-12 * fabs(twelfths) || fabs(whole) > 10000) return false;
    return dim_power(dim, (int)whole, dim_unit, result);
}

struct kind check_power(struct parser *p, const struct operand *a, const struct operand *b)
{
    if (!check_numbers(p, a, b)) return failed_kind(p);
    char message[320];
    if (!b->kind.free && !dim_equal(b->kind.dim, DIM_NONE)) {
        struct phrase phrase = check_phrase(b->kind.dim, p->scope->units);
        snprintf(message, sizeof message, "an exponent must be a pure number, not %s", phrase.text);
        note(p, "wrong-dimension", b->at, "divide it by a reference value with a unit", message);
        return failed_kind(p);
    }
    struct kind kind = {.free = a->kind.free};
    if (dim_equal(a->kind.dim, DIM_NONE)) return kind;
    bool possible = b->place == place_constant && dim_real_power(a->kind.dim, b->value, &kind.dim);
    if (possible || kind.free) return kind;
    struct phrase phrase = check_phrase(a->kind.dim, p->scope->units);
    if (b->place == place_constant)
        snprintf(message, sizeof message, "%s cannot be raised to this power", phrase.text);
    else
        snprintf(message, sizeof message, "the exponent of %s must be a number", phrase.text);
    note(p, "wrong-dimension", b->at, "divide the base by a reference value, as in `(x/1[m])^n`", message);
    return failed_kind(p);
}

struct kind check_root(struct parser *p, const struct operand *a, int degree)
{
    if (!check_number(p, a)) return failed_kind(p);
    struct kind kind = {.free = a->kind.free};
    if (dim_power(a->kind.dim, 1, degree, &kind.dim) || kind.free) return kind;
    char message[320];
    struct phrase phrase = check_phrase(a->kind.dim, p->scope->units);
    snprintf(message, sizeof message, "%s has no such root", phrase.text);
    note(p, "wrong-dimension", a->at, NULL, message);
    return failed_kind(p);
}

/* ---- pure numbers */

struct kind check_pure(struct parser *p, const struct operand *a, const char *function)
{
    if (!check_number(p, a)) return failed_kind(p);
    if (a->kind.free || dim_equal(a->kind.dim, DIM_NONE)) return a->kind;
    struct phrase phrase = check_phrase(a->kind.dim, p->scope->units);
    char message[320], unit[64];
    const char *hint = NULL;
    unit_name(a->kind.dim, p->scope->units, unit, sizeof unit);
    if (dim_equal(a->kind.dim, DIM_TIME))
        hint = diag_hint(p->errors,
                         "multiply by a rate or divide by a time, as in `%s(2[rad/s]*t)`, `%s(t/3[s])`",
                         function, function);
    else
        hint = diag_hint(p->errors, "divide by a reference value, as in `%s(.../1[%s])`", function, unit);
    snprintf(message, sizeof message, "`%s` needs an angle or a pure number, not %s", function, phrase.text);
    note(p, "wrong-dimension", a->at, hint, message);
    return failed_kind(p);
}

bool check_is_bare_angle(const struct operand *a)
{
    const double turn = 6.2831853071795864769;
    bool bare = a->place == place_constant && a->kind.free && !a->pi;
    return bare && fabs(a->value) > turn * (1 + 1e-9);
}

void check_note_bare_angle(fbd_errors *errors, struct pos at, double value)
{
    diag_add(errors, FBD_WARNING, "bare-angle", at,
             diag_hint(errors,
                       "a bare angle is in rad; degrees are `%.6g[deg]`, and radians may be `%.6g[rad]`",
                       value, value),
             "an angle is compared with %.6g rad, which is more than one turn", value);
}
