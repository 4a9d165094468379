/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Growing text buffer for output, and numbers that do not depend on the locale.
 */
#ifndef FBD_BASE_TEXT_H
#define FBD_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

struct text {
    char *data; /* zero-terminated once anything was added */
    size_t length, capacity;
    bool failed; /* memory ran out; later additions are ignored */
    bool odd;    /* a number that is not finite was written */
};

/* Reserve room for `more` bytes and the terminating zero; false when memory is out. */
bool text_grow(struct text *text, size_t more);
static inline bool text_reserve(struct text *text, size_t more)
{
    return (!text->failed && text->capacity - text->length > more) || text_grow(text, more);
}

void text_add(struct text *text, const char *string);
void text_add_bytes(struct text *text, const char *bytes, size_t length);

/* text_add of a literal, in place: for texts that are written many times. */
static inline __attribute__((always_inline)) void text_literal(struct text *text, const char *literal)
{
    const size_t length = strlen(literal);
    if (text->failed || text->capacity - text->length <= length) {
        text_add_bytes(text, literal, length);
        return;
    }
    memcpy(text->data + text->length, literal, length + 1);
    text->length += length;
}

void text_printf(struct text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Append external text (a title, an expression, a path) with control characters escaped: base/utf8.h. */
void text_shown(struct text *text, const char *string);

/* A title above the following text, and a line between; no output for "". */
void text_heading(struct text *text, const char *title);

/* `value` with `digits` significant digits as %g writes it, always with a decimal point. */
void text_number(struct text *text, double value, int digits);

/* The shortest decimal that reads back as `value`. */
void text_exact(struct text *text, double value);

/* Pad with blanks up to display column `column` of the current line (UTF-8 counted by characters); a line
 * that is already as long gets one blank, unless it ends with one. */
void text_pad(struct text *text, size_t column);

/* `string` between double quotes with JSON's escapes. */
void text_json_string(struct text *text, const char *string);

/* `"name": ` before a value; a number with all its digits, null for infinity and NaN. */
void text_json_key(struct text *text, const char *name);
void text_json_number(struct text *text, double value);

/* A member of an object, followed by `behind`: ", " or "}". */
void text_json_member(struct text *text, const char *name, double value, const char *behind);
void text_json_words(struct text *text, const char *name, const char *value, const char *behind);
void text_json_flag(struct text *text, const char *name, bool value, const char *behind);

void text_free(struct text *text);

#endif
