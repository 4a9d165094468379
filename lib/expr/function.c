/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "expr/parser.h"

/* The dimensions of the arguments and of the result of a function. */
enum rule {
    rule_pure,    /* a pure number to a pure number */
    rule_rounded, /* a pure number, which stays free */
    rule_any,     /* any dimension to a pure number */
    rule_kept,    /* any dimension, kept */
    rule_root_2,
    rule_root_3,
    rule_same,  /* equal dimensions to the same */
    rule_ratio, /* equal dimensions to a pure number */
    rule_power,
    rule_clamp, /* composed of max and min */
    rule_pulse, /* composed of two steps */
    rule_relay, /* equal dimensions to a pure number */
    rule_if,
};

struct function {
    const char *name;
    enum op op;
    int least, most; /* arguments */
    enum rule rule;
};

static const struct function functions[] = {
    {"sin", op_sin, 1, 1, rule_pure},
    {"cos", op_cos, 1, 1, rule_pure},
    {"tan", op_tan, 1, 1, rule_pure},
    {"asin", op_asin, 1, 1, rule_pure},
    {"acos", op_acos, 1, 1, rule_pure},
    {"atan", op_atan, 1, 1, rule_pure},
    {"atan2", op_atan2, 2, 2, rule_ratio},
    {"sinh", op_sinh, 1, 1, rule_pure},
    {"cosh", op_cosh, 1, 1, rule_pure},
    {"tanh", op_tanh, 1, 1, rule_pure},
    {"exp", op_exp, 1, 1, rule_pure},
    {"ln", op_ln, 1, 1, rule_pure},
    {"log", op_ln, 1, 1, rule_pure},
    {"log10", op_log10, 1, 1, rule_pure},
    {"sqrt", op_sqrt, 1, 1, rule_root_2},
    {"cbrt", op_cbrt, 1, 1, rule_root_3},
    {"hypot", op_hypot, 2, 2, rule_same},
    {"pow", op_power, 2, 2, rule_power},
    {"abs", op_abs, 1, 1, rule_kept},
    {"sign", op_sign, 1, 1, rule_any},
    {"min", op_min, 2, most_arguments, rule_same},
    {"max", op_max, 2, most_arguments, rule_same},
    {"floor", op_floor, 1, 1, rule_rounded},
    {"ceil", op_ceil, 1, 1, rule_rounded},
    {"round", op_round, 1, 1, rule_rounded},
    {"mod", op_mod, 2, 2, rule_same},
    {"step", op_step, 1, 1, rule_any},
    {"pulse", op_step, 3, 3, rule_pulse},
    {"square", op_square, 1, 1, rule_pure},
    {"sawtooth", op_sawtooth, 1, 1, rule_pure},
    {"clamp", op_max, 3, 3, rule_clamp},
    {"hysteresis", op_relay, 3, 3, rule_relay},
    {"if", op_copy, 3, 3, rule_if},
};

enum { function_count = sizeof functions / sizeof functions[0] };

static bool is_called(const char *name, const char *text, size_t length)
{
    return strlen(name) == length && memcmp(name, text, length) == 0;
}

static const struct function *find_function(const char *name, size_t length)
{
    for (size_t i = 0; i < function_count; i++)
        if (is_called(functions[i].name, name, length)) return &functions[i];
    return NULL;
}

bool function_exists(const char *name, size_t length)
{
    return find_function(name, length) != NULL;
}

const char *expr_function(size_t index)
{
    return index < function_count ? functions[index].name : NULL;
}

/* ---- errors in calls */

static const char *const other_names[][2] = {
    {"arcsin", "asin"}, {"arccos", "acos"}, {"arctan", "atan"},  {"arctan2", "atan2"},  {"tg", "tan"},
    {"sgn", "sign"},    {"signum", "sign"}, {"fabs", "abs"},     {"heaviside", "step"}, {"Heaviside", "step"},
    {"H", "step"},      {"u", "step"},      {"power", "pow"},    {"fmod", "mod"},       {"rem", "mod"},
    {"trunc", "floor"}, {"int", "floor"},   {"saw", "sawtooth"}, {"sat", "clamp"},      {"limit", "clamp"},
    {"iif", "if"},      {"ifelse", "if"},   {"where", "if"},     {"sqr", "x^2"},        {"rect", "pulse"},
};

static const char *suggest_function(struct parser *p, const char *name)
{
    enum { most_tables = 50 };
    const char *names[function_count + most_tables];
    const char *const *tables = NULL;
    for (size_t i = 0; i < sizeof other_names / sizeof other_names[0]; i++)
        if (strcmp(other_names[i][0], name) == 0)
            return strchr(other_names[i][1], '^') /* in place of the whole call */
                       ? diag_hint(p->errors, "write `%s`", other_names[i][1])
                       : diag_replace(p->errors, name, other_names[i][1], "write `%s`", other_names[i][1]);
    if (explain_is_known(p->scope, name, strlen(name)))
        return diag_hint(p->errors, "`%s` is a value; a product is written `%s*(...)`", name, name);
    size_t count = p->scope->tables ? p->scope->tables(p->scope->context, &tables) : 0;
    if (count > most_tables) count = most_tables;
    for (size_t i = 0; i < count; i++) names[i] = tables[i];
    for (size_t i = 0; i < function_count; i++) names[count + i] = functions[i].name;
    return diag_nearest(p->errors, name, names, count + function_count);
}

static struct operand unknown_function(struct parser *p, struct token name)
{
    const char *text = arena_text(&p->builder->scratch, p->lexer.text + name.start, name.length);
    if (text)
        diag_add(p->errors, FBD_ERROR, "unknown-function", name.at, suggest_function(p, text),
                 "unknown function `%s`", text);
    return parse_failed(p, name.at);
}

static struct operand wrong_count(struct parser *p, const struct function *function, struct token name,
                                  int count)
{
    static const char *const forms[][2] = {{"atan2", "atan2(y, x)"},
                                           {"mod", "mod(a, b)"},
                                           {"pulse", "pulse(t, start, width)"},
                                           {"clamp", "clamp(u, low, high)"},
                                           {"hysteresis", "hysteresis(u, low, high)"},
                                           {"if", "if(condition, a, b)"}};
    const char *hint = NULL;
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++)
        if (strcmp(forms[i][0], function->name) == 0) hint = diag_hint(p->errors, "write `%s`", forms[i][1]);
    char given[32] = "none";
    if (count > 0) snprintf(given, sizeof given, "%d", count);
    diag_add(p->errors, FBD_ERROR, "argument-count", name.at, hint, "`%s` takes %s%d argument%s, not %s",
             function->name, function->most > function->least ? "at least " : "", function->least,
             function->least == 1 ? "" : "s", given);
    return parse_failed(p, name.at);
}

/* ---- operations */

/* Limit of whole exponents that are multiplied out; beyond, pow is as fast. */
enum { largest_whole_power = 32 };

struct operand function_power(struct parser *p, int base, const struct operand *a, const struct operand *b,
                              struct pos at)
{
    struct kind kind = check_power(p, a, b);
    bool whole =
        b->place == place_constant && fabs(b->value) <= largest_whole_power && b->value == floor(b->value);
    if (whole && b->value == 1) {
        struct operand same = *a;
        same.kind = kind;
        return same;
    }
    if (whole && !b->is_broken)
        return build_operation(p->builder, base, op_whole_power, (int)b->value, a, NULL, kind, at);
    /* c^b = exp(b ln c) */
    double of_exponent = a->place == place_constant && a->value > 0 ? fabs(log(a->value)) : 0;
    struct operand exponent =
        of_exponent > 0 ? build_levels(p->builder, p->builder->depth, b, 1 / of_exponent) : *b;
    return build_operation(p->builder, base, op_power, 0, a, &exponent, kind, at);
}

/* True for functions that vary only in a limited range of their argument. */
static bool wakes_up(enum op op)
{
    return op == op_exp || op == op_sinh || op == op_cosh || op == op_tanh;
}

/* min(max(u, low), high): its two switches compare u with its bounds. */
static struct operand build_clamp(struct builder *b, int base, const struct operand *args, struct kind kind,
                                  struct pos at)
{
    struct operand raised = build_operation(b, b->depth, op_max, 0, &args[0], &args[1], kind, at);
    return build_operation(b, base, op_min, 0, &raised, &args[2], kind, at);
}

/* step(t - start) * (1 - step((t - start) - width)): start + width would round a short width. */
static struct operand build_pulse(struct builder *b, int base, const struct operand *args, struct kind kind,
                                  struct pos at)
{
    struct kind pure = {.failed = kind.failed};
    struct operand one = build_constant(1, pure, at);
    struct operand since = build_operation(b, b->depth, op_subtract, 0, &args[0], &args[1], kind, at);
    struct operand on = build_operation(b, b->depth, op_step, 0, &since, NULL, pure, at);
    struct operand after = build_operation(b, b->depth, op_subtract, 0, &since, &args[2], kind, at);
    struct operand off = build_operation(b, b->depth, op_step, 0, &after, NULL, pure, at);
    struct operand not_off = build_operation(b, b->depth, op_subtract, 0, &one, &off, pure, at);
    return build_operation(b, base, op_multiply, 0, &on, &not_off, pure, at);
}

/* A relay over ((u - low) - (high - u))/(high - low), which is -1 and 1 at the thresholds. Varying thresholds
 * must not cross: the added term 0*sqrt(high - low) is then NaN, and ends the run. */
static struct operand build_relay(struct parser *p, int base, const struct operand *args, struct kind kind,
                                  struct pos at)
{
    struct builder *b = p->builder;
    const struct operand *u = &args[0], *low = &args[1], *high = &args[2];
    struct kind same = {.dim = u->kind.dim, .failed = kind.failed};
    if (low->place == place_constant && high->place == place_constant && !(low->value < high->value)) {
        diag_add(p->errors, FBD_ERROR, "argument-order", low->at, "write `hysteresis(u, low, high)`",
                 "the lower threshold of `hysteresis` must be below the upper one");
        return parse_failed(p, at);
    }
    struct operand above = build_operation(b, b->depth, op_subtract, 0, u, low, same, at);
    struct operand below = build_operation(b, b->depth, op_subtract, 0, high, u, same, at);
    struct operand off = build_operation(b, b->depth, op_subtract, 0, &above, &below, same, at);
    struct operand width = build_operation(b, b->depth, op_subtract, 0, high, low, same, at);
    struct operand share = build_operation(b, b->depth, op_divide, 0, &off, &width, kind, at);
    bool constant = low->place == place_constant && high->place == place_constant;
    if (constant) return build_operation(b, base, op_relay, 0, &share, NULL, kind, at);
    struct operand nothing = build_constant(0, kind, at);
    struct operand state = build_operation(b, b->depth, op_relay, 0, &share, NULL, kind, at);
    struct operand apart = build_operation(b, b->depth, op_subtract, 0, high, low, same, at);
    struct operand root = build_operation(b, b->depth, op_sqrt, 0, &apart, NULL, kind, at);
    struct operand none = build_operation(b, b->depth, op_multiply, 0, &nothing, &root, kind, at);
    return build_operation(b, base, op_add, 0, &state, &none, kind, at);
}

/* ---- tables */

/* Call a table. A number without a unit takes the dimension of the points, and vice versa. */
static struct operand build_lookup(struct parser *p, const struct table *table, int base,
                                   const struct operand *args, int count, struct token name)
{
    const char *text = p->lexer.text + name.start;
    struct kind kind = {.dim = table->y_dim, .free = table->y_free};
    if (count != 1) {
        diag_add(p->errors, FBD_ERROR, "argument-count", name.at, NULL,
                 "the table `%.*s` takes 1 argument, not %d", (int)name.length, text, count);
        return parse_failed(p, name.at);
    }
    if (!check_number(p, &args[0])) return parse_failed(p, name.at);
    if (!args[0].kind.failed && !args[0].kind.free && !table->x_free &&
        !dim_equal(args[0].kind.dim, table->x_dim)) {
        struct phrase given = check_phrase(args[0].kind.dim, p->scope->units),
                      needed = check_phrase(table->x_dim, p->scope->units);
        diag_add(p->errors, FBD_ERROR, "wrong-dimension", args[0].at, NULL,
                 "the table `%.*s` is a function of %s, not of %s", (int)name.length, text, needed.text,
                 given.text);
        return parse_failed(p, name.at);
    }
    kind.failed = args[0].kind.failed;
    return build_table(p->builder, base, table, &args[0], kind, name.at);
}

static struct table_symbol find_table(struct parser *p, struct token name)
{
    const char *text = arena_text(&p->builder->scratch, p->lexer.text + name.start, name.length);
    if (!text || !p->scope->table) return (struct table_symbol){NULL, !text};
    return p->scope->table(p->scope->context, text, name.at);
}

static struct kind same_arguments(struct parser *p, const struct function *function,
                                  const struct operand *args, int count)
{
    char verb[40];
    snprintf(verb, sizeof verb, "give `%s`", function->name);
    struct operand common = args[0];
    for (int i = 1; i < count; i++) common.kind = check_same(p, args[i].at, verb, &common, "and", &args[i]);
    return common.kind;
}

static void warn_of_degrees(struct parser *p, const struct function *function, const struct operand *argument)
{
    bool angle = function->op == op_sin || function->op == op_cos || function->op == op_tan;
    if (!angle || !check_is_bare_angle(argument)) return;
    diag_add(p->errors, FBD_WARNING, "bare-angle", argument->at,
             diag_hint(p->errors,
                       "a bare angle is in rad; degrees are `%.6g[deg]`, and as a value `%.6g deg`",
                       argument->value, argument->value),
             "`%s` is taken of %.6g rad, which is more than one turn", function->name, argument->value);
}

static struct kind kind_of_call(struct parser *p, const struct function *function, const struct operand *args,
                                int count)
{
    struct kind kind, pure = {0};
    switch (function->rule) {
    case rule_pure:
        pure.failed = check_pure(p, &args[0], function->name).failed;
        warn_of_degrees(p, function, &args[0]);
        return pure;
    case rule_rounded: return check_pure(p, &args[0], function->name);
    case rule_root_2: return check_root(p, &args[0], 2);
    case rule_root_3: return check_root(p, &args[0], 3);
    case rule_any: pure.failed = !check_number(p, &args[0]) || args[0].kind.failed; return pure;
    case rule_kept:
        kind = args[0].kind;
        kind.failed = !check_number(p, &args[0]) || kind.failed;
        return kind;
    case rule_relay:
    case rule_ratio: pure.failed = same_arguments(p, function, args, count).failed; return pure;
    default: return same_arguments(p, function, args, count);
    }
}

static struct operand build_call(struct parser *p, const struct function *function, int base,
                                 const struct operand *args, int count, struct pos at)
{
    struct builder *b = p->builder;
    if (function->rule == rule_power) {
        struct operand power = function_power(p, base, &args[0], &args[1], at);
        power.at = at;
        return power;
    }
    struct kind kind = kind_of_call(p, function, args, count);
    if (function->rule == rule_clamp) return build_clamp(b, base, args, kind, at);
    if (function->rule == rule_relay) return build_relay(p, base, args, kind, at);
    if (function->rule == rule_pulse) return build_pulse(b, base, args, kind, at);
    if (count == 1) {
        struct operand argument = wakes_up(function->op) ? build_levels(b, base, &args[0], 1) : args[0];
        return build_operation(b, base, function->op, 0, &argument, NULL, kind, at);
    }
    struct operand result = args[0];
    for (int i = 1; i < count; i++)
        result = build_operation(b, i == count - 1 ? base : b->depth, function->op, 0, &result, &args[i],
                                 kind, at);
    return result;
}

/* ---- reading calls */

/* Skip the `,` or `)` behind an argument; true when another argument follows. */
static bool another_argument(struct parser *p)
{
    bool comma = p->token.kind == token_comma;
    if (comma || p->token.kind == token_close)
        parse_advance(p);
    else
        explain_unexpected(p, p->token.kind == token_end ? "`)`" : "`,` or `)`");
    return comma && !p->stopped;
}

/* Read all arguments up to the closing parenthesis; those beyond `most_arguments` are counted only. */
static int read_arguments(struct parser *p, struct operand *args)
{
    int count = 0;
    if (p->token.kind == token_close) {
        parse_advance(p);
        return 0;
    }
    do {
        struct operand arg = parse_expression(p);
        if (count < most_arguments) args[count] = arg;
        count++;
    } while (another_argument(p));
    return count;
}

/* Read an `if`. Each side is compiled between its jumps, so the arguments cannot be read in one go. */
static struct operand read_if(struct parser *p, const struct function *function, int base, struct token name)
{
    struct choice choice;
    int count = 1;
    if (p->token.kind == token_close) {
        parse_advance(p);
        return wrong_count(p, function, name, 0);
    }
    struct operand condition = parse_expression(p);
    bool sound = check_condition(p, &condition);
    if (!another_argument(p))
        return p->stopped ? parse_failed(p, name.at) : wrong_count(p, function, name, count);
    build_choice_start(p->builder, &choice, base, &condition);
    struct operand first = parse_expression(p);
    count++;
    if (!another_argument(p))
        return p->stopped ? parse_failed(p, name.at) : wrong_count(p, function, name, count);
    build_choice_first(p->builder, &choice, &first);
    struct operand second = parse_expression(p);
    count++;
    while (another_argument(p)) {
        parse_expression(p);
        count++;
    }
    if (p->stopped) return parse_failed(p, name.at);
    if (count > function->most) return wrong_count(p, function, name, count);
    struct kind kind = check_same(p, second.at, "choose between", &first, "and", &second);
    kind.failed = kind.failed || !sound;
    return build_choice_second(p->builder, &choice, &second, kind, name.at);
}

/* `before(v)`: the value of the expression, whose names have another meaning. */
static struct operand read_in_sense(struct parser *p, struct token name)
{
    struct operand inside = parse_expression(p);
    p->scope->sense(p->scope->context, NULL);
    if (!p->stopped && another_argument(p))
        parse_stop(p, "argument-count", name.at, NULL, "there must be one expression in these brackets");
    return p->stopped ? parse_failed(p, name.at) : inside;
}

static bool has_sense(struct parser *p, struct token name)
{
    const char *word = arena_text(&p->builder->scratch, p->lexer.text + name.start, name.length);
    return word && p->scope->sense && p->scope->sense(p->scope->context, word);
}

/* Is it a variable at a constant length? Its text, and whether it takes bare numbers. */
static bool is_at_length(struct parser *p, struct token name, const char **text, bool *bare)
{
    *text = arena_text(&p->builder->scratch, p->lexer.text + name.start, name.length);
    if (!*text || !p->scope->at_length) return false;
    const struct symbol symbol = p->scope->at_length(p->scope->context, *text, NAN, name.at);
    *bare = symbol.free;
    return symbol.kind != symbol_unknown;
}

/* `M(0.4[m])` */
static struct operand read_at_length(struct parser *p, const char *text, bool bare, struct token name)
{
    const struct operand x = parse_expression(p);
    const bool length = x.kind.free ? bare : dim_equal(x.kind.dim, DIM_LENGTH);
    if (!p->stopped && another_argument(p))
        parse_stop(p, "argument-count", name.at, NULL, "there must be one expression in these brackets");
    if (p->stopped || x.kind.failed) return parse_failed(p, name.at);
    if (x.place != place_constant || x.kind.truth || !length) {
        diag_add(p->errors, FBD_ERROR, "bad-place", x.at,
                 diag_hint(p->errors, "as `%s(0.4[m])` or `%s(L/2)`", text, text),
                 "the place of `%s` must be a length, of numbers and parameters", text);
        return parse_failed(p, name.at);
    }
    const struct symbol symbol = p->scope->at_length(p->scope->context, text, x.value, name.at);
    if (symbol.kind != symbol_variable) return parse_failed(p, name.at);
    return build_variable(symbol.slot, (struct kind){.dim = symbol.dim}, name.at);
}

struct operand function_call(struct parser *p, struct token name)
{
    int base = p->builder->depth;
    const struct function *function = find_function(p->lexer.text + name.start, name.length);
    if (!parse_enter(p)) return parse_failed(p, name.at);
    parse_advance(p);
    struct operand result;
    const char *variable;
    bool bare;
    if (!function && has_sense(p, name)) {
        result = read_in_sense(p, name);
    } else if (!function && is_at_length(p, name, &variable, &bare)) {
        result = read_at_length(p, variable, bare, name);
    } else if (function && function->rule == rule_if) {
        result = read_if(p, function, base, name);
    } else {
        struct operand args[most_arguments] = {{.index = 0}};
        int count = read_arguments(p, args);
        struct table_symbol table = {NULL, false};
        if (!p->stopped && !function) table = find_table(p, name);
        if (p->stopped || table.failed)
            result = parse_failed(p, name.at);
        else if (table.table)
            result = build_lookup(p, table.table, base, args, count, name);
        else if (!function)
            result = unknown_function(p, name);
        else if (count < function->least || count > function->most)
            result = wrong_count(p, function, name, count);
        else
            result = build_call(p, function, base, args, count, name.at);
    }
    parse_leave(p);
    return result;
}
