/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Notation: converts an equation as people write it (LaTeX, Greek letters, dots and primes, products without
 * a sign) to the language of expressions. docs/notation.md lists the accepted forms.
 *
 * A text that is an expression already is returned unchanged. Names are looked up in the scope: a sequence of
 * letters that is no name is split into names only if there is exactly one way to do so. A text with two
 * readings is an error that shows both.
 */
#ifndef FBD_EXPR_NOTATION_H
#define FBD_EXPR_NOTATION_H

#include "expr/expr.h"

/* The source of a part of the converted text. */
struct notation_stretch {
    size_t made, from, length; /* in bytes: start in the converted text; start and length in the source */
    const struct notation_stretch *next;
};

struct notation {
    const char *text;                         /* in the language of expressions */
    bool changed;                             /* it differs from the given text */
    const struct notation_stretch *stretches; /* ascending in `made` */
};

/* Read `text`, which starts at `at`. `equation`: `==` stands between two sides and is read as `=`; otherwise
 * the text is a condition, where `==` compares. The lookup of the scope is also called for names that may not
 * exist. Memory comes from `arena`. False with a note at the column of the source: `ambiguous-notation` with
 * both readings, `expression-syntax` for LaTeX that has no meaning in an expression; false without a note
 * when memory is out (`arena->failed`). Other errors are left to expr_compile. */
bool notation_read(struct arena *arena, const char *text, struct pos at, const struct scope *scope,
                   bool equation, fbd_errors *errors, struct notation *notation);

/* The byte of the source that corresponds to byte `made` of the text. */
size_t notation_source(const struct notation *notation, size_t made);

#endif
