/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "expr/notation.h"

#include <string.h>

#include "expr/glyph.h"
#include "expr/notation_work.h"

bool writing_refuse(struct writing *w, const char *id, size_t offset, const char *hint, const char *message)
{
    const struct pos at = glyph_pos(w->text, offset, w->at);
    if (!w->failed)
        diag_add(w->errors, FBD_ERROR, id, at, diag_hint(w->errors, "%s", hint ? hint : ""), "%s", message);
    w->failed = true;
    return false;
}

bool writing_ambiguous(struct writing *w, size_t offset, const char *first, const char *second)
{
    const char *hint = first && second ? diag_hint(w->errors, "write `%s` or `%s`", first, second) : NULL;
    if (!hint) w->arena->failed = true;
    return hint && writing_refuse(w, "ambiguous-notation", offset, hint, "this can be read in two ways");
}

/* ---- headings */

/* The bytes of the first of these words with which the text begins; 0 for none. */
static size_t word_length(const char *text, const char *const *words, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strncmp(text, words[i], strlen(words[i])) == 0) return strlen(words[i]);
    return 0;
}

#define WORD_LENGTH(text, words) word_length((text), (words), sizeof(words) / sizeof *(words))

/* Does an equation follow: is there a sign of equality outside brackets? */
static bool is_equation(const char *text)
{
    int depth = 0;
    for (; *text && !(depth == 0 && *text == '='); text++) {
        if (strchr("([{", *text)) depth++;
        if (strchr(")]}", *text)) depth--;
    }
    return *text != 0;
}

/* The bytes of a heading before an equation, which only says which sum it is: `ΣF_x = T - f = m*a`, `+↑ \sum M_A: ...`. The
 * sum has a letter and at most an index. 0 for none. */
static size_t heading_length(const char *text)
{
    static const char *const senses[] = {" ", "$", "+", "(", ")", "→", "←", "↑", "↓", "↺", "↻", "⟲", "⟳"};
    static const char *const sums[] = {"Σ", "∑", "\\sum", "\\Sigma", "sum "}, *const letters[] = {"F", "M"};
    const char *at = text;
    for (size_t n = 1; n > 0; at += n) n = WORD_LENGTH(at, senses);
    const size_t sum = WORD_LENGTH(at, sums);
    at += sum;
    at += strspn(at, " ");
    const size_t letter = sum ? WORD_LENGTH(at, letters) : 0;
    if (letter == 0) return 0;
    at += strcspn(at, "=:+-*/(");
    if (*at != '=' && *at != ':') return 0;
    at += 1 + strspn(at + 1, " ");
    return is_equation(at) ? (size_t)(at - text) : 0;
}

/* ---- the whole text */

static bool compiles(const struct writing *w, const char *text)
{
    const struct expr_want want = {.any_dim = true, .condition = !w->equation, .what = "equation"};
    const struct expr *left, *right;
    char relation;
    fbd_errors *errors = fbd_errors_new();
    bool fine =
        errors && text &&
        expr_compile_relation(w->arena, text, w->at, w->scope, &want, errors, &left, &relation, &right);
    if (!errors || errors->out_of_memory || errors->arena.failed) w->arena->failed = true;
    fbd_errors_free(errors);
    return fine;
}

static bool keep(struct arena *arena, const char *text, const struct notation_stretch *stretches,
                 struct notation *notation)
{
    struct notation_stretch **last = (struct notation_stretch **)&notation->stretches;
    notation->changed = true;
    notation->text = arena_text(arena, text, strlen(text));
    for (; stretches; stretches = stretches->next) {
        struct notation_stretch *copy = ARENA_NEW(arena, struct notation_stretch);
        if (!copy) return false;
        *copy = *stretches;
        copy->next = NULL;
        *last = copy;
        last = (struct notation_stretch **)&copy->next;
    }
    return notation->text != NULL;
}

bool notation_read(struct arena *arena, const char *text, struct pos at, const struct scope *scope,
                   bool equation, fbd_errors *errors, struct notation *notation)
{
    struct arena scratch = {0};
    const struct notation_stretch *stretches, *others;
    struct writing w = {.arena = &scratch, .text = text, .length = strlen(text), .at = at};
    w.scope = scope;
    w.errors = errors;
    w.equation = equation;
    *notation = (struct notation){.text = text};
    w.start = equation ? heading_length(text) : 0;
    const struct notation_stretch whole = {.from = w.start, .length = w.length - w.start};
    stretches = &whole;
    const bool plain = compiles(&w, text + w.start);
    const char *made = plain || scratch.failed ? text + w.start : writing_make(&w, &stretches);
    if (!plain && made && w.doubtful && !compiles(&w, made)) {
        w.products = true;
        const char *other = writing_make(&w, &others);
        if (other && compiles(&w, other)) {
            made = other;
            stretches = others;
        }
    }
    bool fine = made && !w.failed;
    if (fine && strcmp(made, text) != 0) fine = keep(arena, made, stretches, notation);
    if (scratch.failed) arena->failed = true;
    arena_free(&scratch);
    return fine;
}

size_t notation_source(const struct notation *notation, size_t made)
{
    const struct notation_stretch *at = notation->stretches;
    if (!at) return made;
    while (at->next && at->next->made <= made) at = at->next;
    size_t into = made - at->made;
    return at->from + (into < at->length ? into : at->length);
}
