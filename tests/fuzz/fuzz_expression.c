/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Expressions: compiled, evaluated at several points, with first and second derivatives and with branches.
 * The value is one and the same, to the bit, however it is asked for.
 */
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "claims.h"
#include "expr/expr.h"
#include "fuzz.h"

enum { variables = 5, most_switches = 256, most_summands = 64 };

static const char *const names[] = {"t", "x", "v", "theta", "omega", "crank.theta", "m", "F", "gain"};

static struct symbol look_up(void *context, const char *name, struct pos at)
{
    static const struct symbol symbols[] = {
        {.kind = symbol_variable, .dim = DIM_INIT(0, 0, 1), .slot = 0},
        {.kind = symbol_variable, .dim = DIM_INIT(0, 1, 0), .slot = 1},
        {.kind = symbol_variable, .dim = DIM_INIT(0, 1, -1), .slot = 2},
        {.kind = symbol_variable, .slot = 3},
        {.kind = symbol_variable, .dim = DIM_INIT(0, 0, -1), .slot = 4},
        {.kind = symbol_variable, .slot = 5},
        {.kind = symbol_constant, .dim = DIM_INIT(1, 0, 0), .value = 2},
        {.kind = symbol_constant, .dim = DIM_INIT(1, 1, -2), .value = 5},
        {.kind = symbol_constant, .free = true, .value = 4},
    };
    (void)context, (void)at;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i], name) == 0) return symbols[i];
    return (struct symbol){.kind = symbol_unknown};
}

static size_t list_names(void *context, const char *const **list)
{
    (void)context;
    *list = names;
    return sizeof names / sizeof *names;
}

static bool same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* Zeros of any sign are one. */
static bool same_number(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

/* Value and derivatives at a point, without branches or along those given. */
static void claim_one_value(const struct expr *expr, double t, const double *y, const int *branch)
{
    const double dy[variables] = {1, -0.5, 2, 0, 1e-3};
    double value = expr_eval(expr, t, y, branch), first, a, b, ab;
    for (int slot = 0; slot <= variables; slot++) {
        double again = expr_eval_slot(expr, t, y, slot, branch, &first);
        if (!same_bits(value, again)) fuzz_fail("%.17g, with its slope %.17g", value, again);
        again = expr_eval_second(expr, t, y, slot, slot, branch, &a, &b, &ab);
        if (!same_bits(value, again)) fuzz_fail("%.17g, with its curvature %.17g", value, again);
        if (!same_number(a, first) || !same_number(b, first))
            fuzz_fail("slope %.17g, and %.17g, %.17g", first, a, b);
    }
    double again = expr_eval_along(expr, t, y, 1, dy, branch, &first);
    if (!same_bits(value, again)) fuzz_fail("%.17g, along a direction %.17g", value, again);
}

static void evaluate(const struct expr *expr)
{
    static const double points[][1 + variables] = {
        {0, 0, 0, 0, 0, 0},      {0.5, 1, -2, 0.25, 3, -1},      {1e-3, -1, 1e-9, 1, 1, 1},
        {1, 1e9, 1e9, 7, -7, 3}, {1e5, -1e300, 1e-320, 0, 1, 0},
    };
    static const double direction[variables] = {1, -0.5, 2, 0, 1e-3};
    double margins[2 * most_switches], rates[2 * most_switches];
    int branch[most_switches];
    size_t switches = expr_switches(expr);
    for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
        double t = points[i][0];
        const double *y = points[i] + 1;
        claim_one_value(expr, t, y, NULL);
        if (switches == 0 || switches > most_switches) continue;
        expr_resolve(expr, time_dd_at(t), y, 1, direction, NULL, branch);
        claim_one_value(expr, t, y, branch);
        expr_margins(expr, time_dd_at(t), y, 1, direction, branch, margins, rates, NULL);
        for (size_t k = 0; k < switches; k++)
            for (int end = 0; end < 2; end++) expr_branch_beyond(expr, k, end, branch[k]);
    }
}

/* The summands of a text are pieces of it, in order. */
static void split(const char *text)
{
    struct summand summands[most_summands];
    size_t length = strlen(text), count = expr_summands(text, length, summands, most_summands), end = 0;
    for (size_t i = 0; i < count && i < most_summands; i++) {
        if (summands[i].start < end || summands[i].start + summands[i].length > length)
            fuzz_fail("summand %zu of %zu is no piece of the text", i, count);
        end = summands[i].start + summands[i].length;
    }
}

static void compile(const char *text, const struct expr_want *want, fbd_errors *errors)
{
    const struct scope scope = {.lookup = look_up, .names = list_names};
    const struct pos at = {1, 1};
    struct arena arena = {0};
    const struct expr *expr = expr_compile(&arena, text, at, &scope, want, errors), *left, *right;
    char relation;
    if (expr && expr_is_constant(expr)) claim_finite("a constant", expr_value(expr));
    if (expr) evaluate(expr);
    if (expr && want->any_dim && !want->condition) split(text);
    if (expr_compile_relation(&arena, text, at, &scope, want, errors, &left, &relation, &right)) {
        evaluate(left);
        if (right) evaluate(right);
    }
    arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const struct expr_want wants[] = {
        {.any_dim = true, .what = "value"},
        {.dim = DIM_INIT(1, 1, -2), .what = "force"},
        {.constant = true, .angle = true, .what = "angle"},
        {.any_dim = true, .condition = true, .what = "condition"},
    };
    char *text = malloc(size + 1);
    fbd_errors *errors = fbd_errors_new();
    memcpy(text, data, size);
    text[size] = '\0';
    for (size_t i = 0; i < sizeof wants / sizeof *wants; i++) compile(text, &wants[i], errors);
    claim_notes(errors);
    double value;
    if (number_read(text, size, &value)) claim_finite("a number", value);
    fbd_errors_free(errors);
    free(text);
    return 0;
}
