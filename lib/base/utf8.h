/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * UTF-8, and how a text that somebody else wrote is shown.
 *
 * A title, a path or a word of the command line may hold what a terminal obeys (escape sequences), what turns
 * the order of the text around (bidirectional overrides) or what nobody sees (zero-width characters). None of
 * it reaches a person raw: it is shown as `\x1b`, `\u202e`, `\U000e0001`. Letters and signs of all scripts
 * stay.
 */
#ifndef FBD_BASE_UTF8_H
#define FBD_BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* The code point at text[0..length) and its number of bytes; 0 bytes when it is not valid UTF-8 (overlong
 * forms and surrogates are not). */
size_t utf8_decode(const char *text, size_t length, unsigned *code);

/* Is it what it looks like? False for controls, format characters, invisible ones, line separators, and for
 * what is no character. */
bool utf8_is_plain(unsigned code);

/* A character as it is shown, or a byte that is no UTF-8. */
struct utf8_shown {
    size_t taken, length; /* bytes of the text, and of what is shown */
    bool plain;           /* shown as it is */
    char text[16];
};

/* The first character of a zero-terminated text that is not empty. */
struct utf8_shown utf8_show(const char *text);

#endif
