/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Characters of UTF-8 text: positions, and replacements for the signs that engineers paste from documents (a
 * dot for a product, a long minus, superscripts, Greek letters).
 */
#ifndef FBD_EXPR_GLYPH_H
#define FBD_EXPR_GLYPH_H

#include "base/diag.h"

/* The number of bytes of the character at text[0..length), length >= 1; 1 for a byte that is not UTF-8. */
size_t glyph_size(const char *text, size_t length);

/* The position of text[offset] if text[0] is at `start`: columns count characters, not bytes. */
struct pos glyph_pos(const char *text, size_t offset, struct pos start);

/* The replacement for the character of `size` bytes at `text`, as "theta" or "*"; NULL if none is known. */
const char *glyph_plain(const char *text, size_t size);

/* Add the note "`·` cannot be used here" with the replacement as its hint. */
void glyph_refuse(fbd_errors *errors, const char *id, struct pos at, const char *text, size_t length);

#endif
