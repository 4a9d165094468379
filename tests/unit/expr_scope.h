/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A small world of names for the tests of expressions:
 *
 * variables         t time, x length (y[0]), v velocity (y[1]), theta angle (y[2]), omega rate (y[3]),
 *                   crank.theta angle (y[4])
 * constants         m = 2 kg, k = 200 N/m, c = 3 N*s/m, F = 5 N, zero = 0 (a pure number), gain = 4 (bare)
 * failed before     secret
 */
#ifndef TESTS_EXPR_SCOPE_H
#define TESTS_EXPR_SCOPE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after its prerequisites */
#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "expr/expr.h"

static const char *const scope_names[] = {"t", "x", "v", "theta", "omega", "crank.theta",
                                          "m", "k", "c", "F",     "zero",  "gain"};

static inline size_t scope_list(void *context, const char *const **names)
{
    (void)context;
    *names = scope_names;
    return sizeof scope_names / sizeof scope_names[0];
}

static inline struct symbol scope_lookup(void *context, const char *name, struct pos at)
{
    const struct {
        const char *name;
        struct symbol symbol;
    } table[] = {
        {"t", {.kind = symbol_variable, .dim = DIM_TIME, .slot = 0, .because = "is the time"}},
        {"x", {.kind = symbol_variable, .dim = DIM_LENGTH, .slot = 1}},
        {"v", {.kind = symbol_variable, .dim = DIM_VELOCITY, .slot = 2}},
        {"theta", {.kind = symbol_variable, .dim = DIM_NONE, .slot = 3}},
        {"omega", {.kind = symbol_variable, .dim = DIM_RATE, .slot = 4}},
        {"crank.theta", {.kind = symbol_variable, .dim = DIM_NONE, .slot = 5}},
        {"m", {.kind = symbol_constant, .dim = DIM_MASS, .value = 2}},
        {"k", {.kind = symbol_constant, .dim = DIM_STIFFNESS, .value = 200}},
        {"c", {.kind = symbol_constant, .dim = DIM_DAMPING, .value = 3}},
        {"F", {.kind = symbol_constant, .dim = DIM_FORCE, .value = 5}},
        {"zero", {.kind = symbol_constant, .dim = DIM_NONE, .value = 0}},
        {"gain", {.kind = symbol_constant, .dim = DIM_NONE, .free = true, .value = 4}},
        {"secret", {.kind = symbol_failed}},
    };
    (void)context, (void)at;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (strcmp(table[i].name, name) == 0) return table[i].symbol;
    return (struct symbol){.kind = symbol_unknown};
}

/* One compiled text and all that belongs to it. */
struct trial {
    struct arena arena;
    fbd_errors *errors;
    const struct expr *expr;
};

static inline struct trial try_text(const char *text, const struct expr_want *want, enum unit_system units)
{
    struct trial trial = {.errors = fbd_errors_new()};
    struct scope scope = {.lookup = scope_lookup, .names = scope_list, .units = units};
    trial.expr = expr_compile(&trial.arena, text, (struct pos){1, 1}, &scope, want, trial.errors);
    return trial;
}

static inline void end_trial(struct trial *trial)
{
    arena_free(&trial->arena);
    fbd_errors_free(trial->errors);
}

/* Compile what must be right. */
static inline struct trial must_compile(const char *text)
{
    struct expr_want want = {.any_dim = true, .what = "value"};
    struct trial trial = try_text(text, &want, unit_si);
    if (!trial.expr) {
        print_message("%s\n", text);
        fbd_errors_print(trial.errors, stdout);
        fail_msg("`%s` does not compile", text);
    }
    return trial;
}

#endif
