/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch/row_formula.h"

#include <math.h>
#include <string.h>

#include "base/number.h"
#include "batch/row.h"
#include "expr/expr.h"

enum { most_outputs = 64 };

struct row_formula {
    struct arena *arena;
    char *text; /* with `max(ball.y)` written `max_ball.y_`, a name of the same length */
    char *right;
    const char *outputs[most_outputs];
    const char *masked[most_outputs]; /* as in `text` */
    size_t count;
    double factors[most_outputs]; /* from the unit of a column to the coherent one */
    const struct rows *rows;
    const struct expr *sides[2];
    char unit[64];
};

static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
static const char inside[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789.";

static bool refuse(fbd_errors *errors, const char *text, const char *why)
{
    diag_add(errors, FBD_ERROR, "bad-find", (struct pos){0, 0},
             "as `ball.x = 12 m`, `max(ball.y) = 2*R` or `time(land) = 1.5 s`", "`%.80s` %s", text, why);
    return false;
}

/* ---- the outputs that it names */

/* The length of the parentheses that the text begins with, or 0. */
static size_t braces_length(const char *text)
{
    int depth = 0;
    for (size_t i = 0; text[i]; i++) {
        depth += (text[i] == '(') - (text[i] == ')');
        if (depth == 0) return i > 0 ? i + 1 : 0;
    }
    return 0;
}

/* The length of `min(NAME)`, `max(NAME)`, `time(NAME)`, `count(NAME)`, `at(EVENT, NAME)` or a section (section/name.h),
 * whose function has `name` bytes; or 0. `min(a, b)` and `max(2*x)` are functions of the language. */
static size_t call_length(const char *text, size_t name)
{
    static const char *const functions[] = {"min", "max", "time", "count", "at", "N", "V", "M"};
    enum { names = 4, count = sizeof functions / sizeof *functions }; /* those of one name */
    const char *argument = text + name + 1;
    const size_t length = text[name] == '(' ? braces_length(text + name) : 0,
                 inner = length ? strspn(argument, inside) : 0;
    const bool section = inner == 1 && strchr("NVM", argument[0]) && argument[1] == '(';
    for (size_t i = 0; length > 2 && i < count; i++) {
        if (strlen(functions[i]) != name || strncmp(functions[i], text, name) != 0) continue;
        return i >= names || section || inner == length - 2 ? name + length : 0;
    }
    return 0;
}

/* Is the masked text that of another output, as of `M(L/2)` and `M(L*2)`? */
static bool is_taken(const struct row_formula *formula, const char *at, size_t length)
{
    for (size_t i = 0; i < formula->count; i++)
        if (strlen(formula->masked[i]) == length && strncmp(formula->masked[i], at, length) == 0) return true;
    return false;
}

static bool add_output(struct row_formula *formula, char *at, size_t length)
{
    const char *output = arena_text(formula->arena, at, length);
    const bool call = output && strchr(output, '(');
    if (!output) return false;
    for (size_t i = 0; i < formula->count; i++) {
        if (strcmp(formula->outputs[i], output) != 0) continue;
        memcpy(at, formula->masked[i], length);
        return true;
    }
    for (size_t i = 0; call && i < length; i++)
        if (at[i] == '.' || !strchr(inside, at[i])) at[i] = '_';
    for (char other = 'a'; call && is_taken(formula, at, length) && other <= 'z'; other++)
        at[length - 1] = other;
    const char *masked = arena_text(formula->arena, at, length);
    if (!masked) return false;
    if (formula->count == most_outputs) return false;
    formula->outputs[formula->count] = output;
    formula->masked[formula->count++] = masked;
    return true;
}

/* Take the name, call or function at `at`; returns its end, NULL when memory is out or there are too many. */
static char *take_name(struct row_formula *formula, char *at)
{
    size_t name = strspn(at, inside), call = call_length(at, name);
    const bool function = !call && at[name + strspn(at + name, " ")] == '(';
    const bool constant = name == 2 && strncmp(at, "pi", 2) == 0;
    if (function || constant) return at + name;
    size_t length = call ? call : name;
    return add_output(formula, at, length) ? at + length : NULL;
}

/* Skip a number, and a unit behind it: `12 m/s` up to the end of its side. */
static char *skip_number(char *at)
{
    size_t length = number_length(at, strlen(at));
    at += length ? length : 1;
    const char *next = at + strspn(at, " ");
    return *next && strchr(letters, *next) ? at + strlen(at) : at;
}

static bool find_outputs(struct row_formula *formula, char *side)
{
    while (side && *side) {
        if (*side == '[')
            side += strcspn(side, "]");
        else if (strchr(letters, *side))
            side = take_name(formula, side);
        else if (strchr(".0123456789", *side))
            side = skip_number(side);
        else
            side++;
    }
    return side != NULL;
}

struct row_formula *row_formula_read(struct arena *arena, const char *text, fbd_errors *errors)
{
    struct row_formula *formula = ARENA_ARRAY(arena, 1, struct row_formula);
    char *copy = arena_text(arena, text, strlen(text));
    if (!formula || !copy) return NULL;
    *formula = (struct row_formula){.arena = arena, .text = copy};
    const char *equals = strchr(text, '=');
    if (!equals || strpbrk(text, "<>") || strchr(equals + 1, '=')) {
        refuse(errors, text, "is no equation");
        return NULL;
    }
    formula->right = copy + (equals - text) + 1;
    formula->right[-1] = '\0';
    if (find_outputs(formula, copy) && find_outputs(formula, formula->right)) return formula;
    if (formula->count == most_outputs) refuse(errors, text, "names too many outputs");
    return NULL;
}

const char *const *row_formula_outputs(const struct row_formula *formula, size_t *count)
{
    *count = formula->count;
    return formula->outputs;
}

/* ---- values */

static struct symbol parameter_symbol(const struct scene *scene, const struct column *column)
{
    const struct parameter *parameter = &scene->parameters[column->index];
    return (struct symbol){.kind = symbol_variable, .dim = parameter->dim, .free = parameter->bare};
}

static struct symbol column_symbol(struct row_formula *formula, size_t index)
{
    const struct scene *scene = formula->rows->base->scene;
    const struct column *column = &formula->rows->columns.list[index];
    const bool time = column->kind == row_time;
    const char *name = time ? "s"
                       : column->kind == row_quantity || column->kind == row_extreme || column->kind == row_at
                           ? column->quantity.unit
                           : "";
    struct unit unit = {.factor = 1};
    if (column->kind == row_parameter) return parameter_symbol(scene, column);
    if (name[0] && !unit_parse(name, strlen(name), scene->units, NULL, (struct pos){0, 0}, &unit))
        return (struct symbol){.kind = symbol_unknown};
    formula->factors[index] = unit.factor;
    return (struct symbol){.kind = symbol_variable, .dim = unit.dim, .angle = unit.angle};
}

static struct symbol lookup(void *context, const char *name, struct pos at)
{
    struct row_formula *formula = context;
    (void)at;
    for (size_t i = 0; i < formula->count; i++) {
        if (strcmp(formula->masked[i], name) != 0) continue;
        struct symbol symbol = column_symbol(formula, i);
        symbol.slot = (int)i + 1;
        return symbol;
    }
    return (struct symbol){.kind = symbol_unknown};
}

bool row_formula_compile(struct row_formula *formula, const struct rows *rows, fbd_errors *errors)
{
    formula->rows = rows;
    for (size_t i = 0; i < formula->count; i++) formula->factors[i] = 1;
    const enum unit_system units = rows->base->scene->units;
    const struct scope scope = {.lookup = lookup, .context = formula, .units = units};
    struct expr_want want = {{0}, true, false, false, false, false, "left side"};
    diag_in_file(errors, "--find");
    formula->sides[0] =
        expr_compile(formula->arena, formula->text, (struct pos){0, 0}, &scope, &want, errors);
    if (!formula->sides[0]) return false;
    want = (struct expr_want){expr_dim(formula->sides[0]), false, false, false, false, false, "right side"};
    formula->sides[1] =
        expr_compile(formula->arena, formula->right, (struct pos){0, 0}, &scope, &want, errors);
    unit_name(want.dim, units, formula->unit, sizeof formula->unit);
    return formula->sides[1] != NULL;
}

double row_formula_value(const struct row_formula *formula, const double *values)
{
    double y[most_outputs];
    for (size_t i = 0; i < formula->count; i++) {
        y[i] = values[i] * formula->factors[i];
        if (isnan(y[i])) return NAN;
    }
    return expr_eval(formula->sides[0], 0, y, NULL) - expr_eval(formula->sides[1], 0, y, NULL);
}

const char *row_formula_unit(const struct row_formula *formula)
{
    return formula->unit;
}

bool row_formula_of_events(const struct row_formula *formula)
{
    for (size_t i = 0; i < formula->count; i++) {
        const enum row_kind kind = formula->rows->columns.list[i].kind;
        if (kind != row_time && kind != row_at && kind != row_parameter) return false;
    }
    return true;
}
