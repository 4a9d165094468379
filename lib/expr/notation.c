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
    const bool plain = compiles(&w, text);
    const char *made = plain || scratch.failed ? text : writing_make(&w, &stretches);
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
