/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Notation: an equation as people write it (LaTeX, Greek letters, dots and primes, products without a sign)
 * to the language of expressions. docs/notation.md has what is accepted.
 *
 * A text that is an expression already comes out with the same bytes. What the names mean is asked of the
 * scope: a run of letters that is no name is taken apart into names only where there is one way to do so.
 * A text that can be read in two ways is an error that shows both.
 */
#ifndef FBD_EXPR_NOTATION_H
#define FBD_EXPR_NOTATION_H

#include "expr/expr.h"

/* Where a stretch of the text that was made comes from. */
struct notation_stretch {
    size_t made, from, length; /* bytes; a stretch of `length` bytes in the source */
    const struct notation_stretch *next;
};

struct notation {
    const char *text;                         /* in the language of expressions */
    bool changed;                             /* it is not the text that was given */
    const struct notation_stretch *stretches; /* ascending in `made` */
};

/* Read `text`, which starts at `at`. `equation`: `==` stands between two sides and is read as `=`; otherwise it
 * is a condition, where `==` compares. The scope's lookup is asked for names that may not exist. Memory comes
 * from `arena`. False with a note at the column of the source: `ambiguous-notation` with both readings,
 * `expression-syntax` for LaTeX that has no meaning in an expression; false without a note when memory is out
 * (`arena->failed`). What else is wrong is left for expr_compile to find. */
bool notation_read(struct arena *arena, const char *text, struct pos at, const struct scope *scope,
                   bool equation, fbd_errors *errors, struct notation *notation);

/* The byte of the source that byte `made` of the text comes from. */
size_t notation_source(const struct notation *notation, size_t made);

#endif
