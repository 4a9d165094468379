/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/values.h"

#include "base/utf8.h"
#include "document/scalar.h"
#include "scene/record.h"

#include <string.h>

const char *value_found(struct reader *reader, const struct node *node)
{
    switch (node->kind) {
    case node_null: return "nothing";
    case node_list: return "a list";
    case node_map: return "a mapping";
    case node_scalar: break;
    }
    enum { most_shown = 40 };
    size_t shown = 0;
    while (shown < node->length && shown < most_shown) {
        unsigned code;
        shown += utf8_decode(node->text + shown, node->length - shown, &code);
    }
    const char *text =
        diag_hint(reader->errors, "`%.*s%s`", (int)shown, node->text, shown < node->length ? "..." : "");
    return text ? text : "text";
}

bool value_refuse(struct reader *reader, const struct node *node, const char *what, const char *wanted,
                  const char *hint)
{
    if (node->kind == node_null)
        diag_add(reader->errors, FBD_ERROR, "missing-value", node->at, hint,
                 "`%s` has no value: it must be %s", what, wanted);
    else
        diag_add(reader->errors, FBD_ERROR, "wrong-type", node->at, hint, "`%s` must be %s, not %s", what,
                 wanted, value_found(reader, node));
    return false;
}

bool value_refuse_list(struct reader *reader, const struct node *node, const char *key, const char *wanted,
                       const char *hint)
{
    if (node->kind != node_list) return value_refuse(reader, node, key, wanted, hint);
    diag_add(reader->errors, FBD_ERROR, "wrong-type", node->at, hint, "`%s` must be %s, not a list of %zu",
             key, wanted, node->count);
    return false;
}

/* ---- expressions */

/* Columns in notes count along the joined text. Where the text was folded from several lines, move the notes
 * behind `last` to the lines of their tokens. */
static void replace_notes(struct reader *reader, const struct node *node, struct diag_note *last)
{
    if (!node->many_lines) return;
    for (struct diag_note *note = last ? last->next : reader->errors->first; note; note = note->next) {
        int offset = note->error.column - node->text_at.column;
        if (note->error.line != node->text_at.line || offset < 0) continue;
        struct pos at = node_place(node, (size_t)offset);
        note->error.line = at.line;
        note->error.column = at.column;
    }
}

/* True if a hint shows, between backticks, an expression that needs quotes inside braces. */
static bool needs_quotes(const char *hint)
{
    for (const char *code = strchr(hint, '`'); code; code = strchr(code, '`')) {
        size_t length = strcspn(++code, "`");
        if (code[0] != '"' && strcspn(code, "[,") < length) return true;
        code += length + (code[length] == '`');
    }
    return false;
}

static void quote_hints(struct reader *reader, const struct node *node, struct diag_note *last)
{
    if (!node->in_braces) return;
    for (struct diag_note *note = last ? last->next : reader->errors->first; note; note = note->next) {
        const char *hint = note->error.hint;
        if (!hint || !needs_quotes(hint)) continue;
        const char *quoted = diag_hint(reader->errors, "%s; inside braces the expression needs quotes", hint);
        if (quoted) note->error.hint = quoted;
    }
}

/* The site of an expression. A value from outside the file has no node. */
static struct program_site site_of(const struct node *node, const struct expr_want *want,
                                   const struct scope *scope)
{
    const struct names *names = scope->context;
    struct program_site site = {node->at.line > 0 ? node : NULL, names->place, names->body, *want};
    site.want.in_braces = node->in_braces;
    return site;
}

/* Keep a program that compiled without notes and does not depend on varying parameters. */
static void keep(struct reader *reader, const struct program *program, const struct diag_note *last)
{
    bool noted = reader->errors->last != last;
    if (reader->keep && program->site.node && !reader->varies && !noted) programs_keep(reader->keep, program);
}

const struct expr *value_compile(struct reader *reader, const struct node *node, const struct expr_want *want,
                                 const struct scope *scope)
{
    struct diag_note *last = reader->errors->last;
    struct program program = {.site = site_of(node, want, scope)};
    const struct program *known = programs_find(reader->known, &program.site);
    if (known) return known->left;
    bool outer = reader->varies, outer_names = reader->names_varying;
    reader->varies = reader->names_varying = false;
    program.left =
        expr_compile(reader->exprs, node->text, node->text_at, scope, &program.site.want, reader->errors);
    if (program.left) keep(reader, &program, last);
    if (reader->record) record_compiled(reader, node, program.left);
    reader->varies |= outer;
    reader->names_varying |= outer_names;
    quote_hints(reader, node, last);
    replace_notes(reader, node, last);
    return program.left;
}

bool value_relation(struct reader *reader, const struct node *node, const struct expr_want *want,
                    const struct scope *scope, const struct expr **left, char *relation,
                    const struct expr **right)
{
    struct diag_note *last = reader->errors->last;
    struct program program = {.site = site_of(node, want, scope)};
    const struct program *known = programs_find(reader->known, &program.site);
    bool outer = reader->varies, outer_names = reader->names_varying, fine = known != NULL;
    if (known) {
        program = *known;
    } else {
        reader->varies = reader->names_varying = false;
        fine = expr_compile_relation(reader->exprs, node->text, node->text_at, scope, &program.site.want,
                                     reader->errors, &program.left, &program.relation, &program.right);
        if (fine) keep(reader, &program, last);
        if (reader->record) record_compiled(reader, node, program.left);
        if (reader->record) record_compiled(reader, node, program.right);
        reader->varies |= outer;
        reader->names_varying |= outer_names;
        quote_hints(reader, node, last);
        replace_notes(reader, node, last);
    }
    *left = program.left;
    *relation = program.relation;
    *right = program.right;
    return fine;
}

static const struct expr *compile(struct reader *reader, const struct node *node, const char *what,
                                  enum quantity quantity, unsigned flags, const struct scope *scope)
{
    bool constant = scope == &reader->constants;
    bool boolean;
    bool is_number = node->kind == node_scalar && node->length > 0 &&
                     (node->quoted || !scalar_boolean(node->text, &boolean));
    if (!is_number) {
        const char *hint =
            diag_hint(reader->errors, "write for example `%s: %s`", what, quantity_example(quantity));
        value_refuse(reader, node, what, quantity_name(quantity), hint);
        return NULL;
    }
    if (!scalar_check_number(node->text, node->text_at, what, reader->errors)) return NULL;
    const struct expr_want want = {.dim = quantity_dim(quantity),
                                   .constant = constant,
                                   .angle = quantity == an_angle,
                                   .any_dim = quantity == a_parameter,
                                   .what = what};
    const struct expr *expr = value_compile(reader, node, &want, scope);
    if (expr && reader->record && (flags & stored)) record_site(reader, expr, &want, scope->context);
    return expr;
}

/* True if the value is wrong only because it is not constant. */
static bool varies(struct reader *reader, const struct node *node, enum quantity quantity)
{
    const struct expr_want want = {.dim = quantity_dim(quantity),
                                   .any_dim = true,
                                   .constant = true,
                                   .what = "value"};
    bool boolean, found = false;
    bool plain =
        node->kind == node_scalar && strcspn(node->text, "0123456789") == 0 && !strpbrk(node->text, "[*+-");
    if (node->kind != node_scalar || node->length == 0 || plain || scalar_boolean(node->text, &boolean))
        return false;
    fbd_errors *errors = fbd_errors_new(), *given = reader->errors;
    if (!errors) {
        diag_out_of_memory(reader->errors);
        return false;
    }
    reader->errors = errors;
    bool outer = reader->varies, outer_names = reader->names_varying;
    struct names names = {.reader = reader, .place = place_constant, .body = ground_body, .tried = true};
    const struct scope scope = names_scope(&names);
    struct arena tried = {0};
    if (scalar_check_number(node->text, node->text_at, "value", errors))
        expr_compile(&tried, node->text, node->text_at, &scope, &want, errors);
    reader->varies = outer;
    reader->names_varying = outer_names;
    reader->errors = given;
    if (errors->out_of_memory || errors->arena.failed || tried.failed) diag_out_of_memory(given);
    for (const struct diag_note *note = errors->first; note; note = note->next)
        found |= strcmp(note->error.id, "not-constant") == 0 ||
                 (strcmp(note->error.id, "unknown-name") == 0 && strstr(node->text, "states."));
    fbd_errors_free(errors);
    arena_free(&tried);
    return found;
}

static bool check_range(struct reader *reader, const struct node *node, const char *what, unsigned flags,
                        double number)
{
    const char *range = (flags & positive) && number <= 0      ? "above zero"
                        : (flags & not_negative) && number < 0 ? "zero or above"
                                                               : NULL;
    if (range)
        diag_add(reader->errors, FBD_ERROR, "out-of-range", node->at, NULL, "`%s` must be %s", what, range);
    return !range;
}

bool value_number(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                  unsigned flags, double *number)
{
    if ((flags & may_vary) && varies(reader, node, quantity)) {
        *number = HUGE_VAL;
        return true;
    }
    const struct expr *expr = compile(reader, node, what, quantity, flags, &reader->constants);
    if (!expr || !check_range(reader, node, what, flags, expr_value(expr))) return false;
    *number = expr_value(expr);
    return true;
}

bool value_formula(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                   unsigned flags, const struct scope *scope, struct value *value)
{
    reader->names_input = false;
    const struct expr *expr = compile(reader, node, what, quantity, flags, scope);
    if (!expr) return false;
    if (expr_is_constant(expr) && !check_range(reader, node, what, flags, expr_value(expr))) return false;
    *value = (struct value){expr, node->at, reader->names_input};
    return true;
}

bool value_vector(struct reader *reader, const struct node *node, const char *what, enum quantity quantity,
                  struct vec *vector)
{
    if (node->kind != node_list || node->count != 2) {
        const char *hint =
            diag_hint(reader->errors, "write for example `%s: [0, %s]`", what, quantity_example(quantity));
        return value_refuse_list(reader, node, what, "a pair [x, y]", hint);
    }
    bool x = value_number(reader, node->items[0], what, quantity, 0, &vector->x);
    bool y = value_number(reader, node->items[1], what, quantity, 0, &vector->y);
    return x && y;
}

/* ---- words */

bool value_text(struct reader *reader, const struct node *node, const char *what, const char **text)
{
    if (node->kind != node_scalar) return value_refuse(reader, node, what, "text", NULL);
    *text = arena_text(reader->arena, node->text, node->length);
    return *text != NULL;
}

bool value_name(struct reader *reader, const struct node *node, const char *what, const char **name)
{
    return value_text(reader, node, what, name) && name_check(reader->errors, *name, node->at, NULL);
}

bool value_flag(struct reader *reader, const struct node *node, const char *what, bool *flag)
{
    if (node->kind != node_scalar) return value_refuse(reader, node, what, "true or false", NULL);
    bool truth = scalar_boolean(node->text, flag);
    if (truth && !node->quoted) return true;
    const char *word = scalar_boolean_word(node->text);
    const char *hint = truth  ? "leave out the quotes"
                       : word ? diag_replace(reader->errors, node->text, word, "write `%s`", word)
                              : "write `true` or `false`";
    return value_refuse(reader, node, what, "true or false", hint);
}

/* A hint if `word` is a common synonym of one of the choices; else NULL. */
static const char *usual_choice(fbd_errors *errors, const char *word, const char *const *names, size_t count)
{
    static const char *const words[][2] = {
        {"ball", "sphere"},    {"box", "prism"},        {"block", "prism"},
        {"cube", "prism"},     {"brick", "prism"},      {"rectangle", "prism"},
        {"plate", "prism"},    {"triangle", "polygon"}, {"wheel", "disc"},
        {"circle", "disc"},    {"roller", "disc"},      {"pulley", "disc"},
        {"bar", "rod"},        {"beam", "rod"},         {"stick", "rod"},
        {"line", "rod"},       {"hoop", "ring"},        {"tube", "hollow_cylinder"},
        {"particle", "point"}, {"mass", "point"},       {"rk45", "rkf45"},
        {"ode45", "rk8pd"},    {"implicit", "rodas5p"},
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        for (size_t k = 0; k < count && strcmp(word, words[i][0]) == 0; k++)
            if (strcmp(names[k], words[i][1]) == 0)
                return diag_replace(errors, word, names[k], "it is `%s`", names[k]);
    return NULL;
}

bool value_choice(struct reader *reader, const struct node *node, const char *what,
                  const struct choice *choices, size_t count, int *choice)
{
    enum { most_choices = 32 };
    const char *names[most_choices];
    if (count > most_choices) count = most_choices;
    for (size_t i = 0; i < count; i++) {
        names[i] = choices[i].name;
        if (node->kind != node_scalar || strcmp(node->text, names[i]) != 0) continue;
        *choice = choices[i].value;
        return true;
    }
    if (node->kind != node_scalar) return value_refuse(reader, node, what, "one word", NULL);
    const char *hint = usual_choice(reader->errors, node->text, names, count);
    if (!hint) hint = diag_nearest(reader->errors, node->text, names, count);
    diag_add(reader->errors, FBD_ERROR, "unknown-choice", node->at, hint, "`%s` cannot be %s", what,
             value_found(reader, node));
    return false;
}
