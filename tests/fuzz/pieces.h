/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Pieces of a model file as a text, found without a parser: the files that are cut up are wrong more often
 * than not.
 */
#ifndef TESTS_FUZZ_PIECES_H
#define TESTS_FUZZ_PIECES_H

#include "random_numbers.h"

#include <stdbool.h>
#include <stddef.h>

/* A text of limited length that is being changed. */
struct draft {
    char *data;
    size_t length, room;
};

struct piece {
    size_t start, length;
};

enum piece_kind {
    piece_line,   /* with its end */
    piece_block,  /* a line and those below it that are indented deeper */
    piece_flow,   /* {...} or [...] */
    piece_entry,  /* what stands between the commas of a flow */
    piece_value,  /* what stands behind `key: ` */
    piece_word,   /* a name */
    piece_number, /* digits, without a sign */
    piece_kinds,
};

/* The next piece of a kind that starts at `from` or later; of length 0 when there is none. */
struct piece piece_next(const struct draft *text, enum piece_kind kind, size_t from);

/* Any one of them: the first behind any place, so that what stands behind much else is more likely. */
struct piece piece_any(const struct draft *text, enum piece_kind kind, struct random_numbers *random);

/* Below `count`. */
size_t random_below(struct random_numbers *random, size_t count);

/* Put `length` bytes, which are no part of the draft, in the place of a piece. False, and nothing done, when
 * there is no room. */
bool draft_replace(struct draft *draft, struct piece piece, const char *bytes, size_t length);

/* Blanks at the start of the line that begins at `at`, dashes of lists among them with `dashes`. */
size_t indentation(const struct draft *text, size_t at, bool dashes);

/* The block of a top-level key, or a piece of length 0. */
struct piece find_section(const struct draft *text, const char *key);

/* Does the word stand anywhere in the text? */
bool has_word(const struct draft *text, const char *word, size_t length);

/* Append `suffix` to the word wherever it stands. */
void rename_word(struct draft *draft, const char *word, size_t length, const char *suffix);

#endif
