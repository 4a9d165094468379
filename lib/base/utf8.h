/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * UTF-8, and the display of external text.
 *
 * A title, a path or a word of the command line may contain escape sequences of the terminal, bidirectional
 * overrides, which change the order of the text, or invisible (zero-width) characters. They are never printed
 * raw, but as `\x1b`, `\u202e`, `\U000e0001`. Letters and symbols of all scripts are printed unchanged.
 */
#ifndef FBD_BASE_UTF8_H
#define FBD_BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>

/* The code point at text[0..length) and its number of bytes; 0 bytes for invalid UTF-8 (overlong forms and
 * surrogates included). */
size_t utf8_decode(const char *text, size_t length, unsigned *code);

/* May this code point be printed unchanged? False for controls, format characters, invisible ones, line
 * separators and noncharacters. */
bool utf8_is_plain(unsigned code);

/* The display of a character, or of a byte that is not UTF-8. */
struct utf8_shown {
    size_t taken, length; /* bytes of the input, and of the displayed text */
    bool plain;           /* displayed unchanged */
    char text[16];
};

/* The first character of a zero-terminated text that is not empty. */
struct utf8_shown utf8_show(const char *text);

#endif
