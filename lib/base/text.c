/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"

#include "base/dtoa_shortest.h"
#include "base/format.h"
#include "base/utf8.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool text_grow(struct text *text, size_t more)
{
    if (text->failed) return false;
    size_t capacity = text->capacity ? text->capacity : 1024;
    while (capacity - text->length <= more) capacity *= 2;
    char *data = realloc(text->data, capacity);
    if (!data) {
        text->failed = true;
        return false;
    }
    text->data = data;
    text->capacity = capacity;
    return true;
}

void text_add_bytes(struct text *text, const char *bytes, size_t length)
{
    if (!text_reserve(text, length)) return;
    if (length > 0) memcpy(text->data + text->length, bytes, length); /* NULL has no bytes */
    text->length += length;
    text->data[text->length] = '\0';
}

void text_add(struct text *text, const char *string)
{
    text_add_bytes(text, string, strlen(string));
}

void text_shown(struct text *text, const char *string)
{
    while (*string) {
        struct utf8_shown next = utf8_show(string);
        text_add_bytes(text, next.text, next.length);
        string += next.taken;
    }
}

void text_heading(struct text *text, const char *title)
{
    text_shown(text, title);
    if (title[0]) text_add(text, "\n\n");
}

/* Usually there is room, and one pass is enough. */
void text_printf(struct text *text, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    size_t room = text->failed ? 0 : text->capacity - text->length;
    int length = format_list(room ? text->data + text->length : NULL, room, format, args);
    va_end(args);
    bool fits = length >= 0 && (size_t)length < room;
    if (!fits && length >= 0 && text_reserve(text, (size_t)length)) {
        format_list(text->data + text->length, (size_t)length + 1, format, again);
        fits = true;
    }
    if (fits)
        text->length += (size_t)length;
    else if (room)
        text->data[text->length] = '\0';
    va_end(again);
}

void text_number(struct text *text, double value, int digits)
{
    char buffer[64];
    double shown = value == 0 ? 0.0 : value; /* write -0 as 0 */
    if (dtoa_rounded(buffer, shown, digits) < 0 &&
        format_into(buffer, sizeof buffer, "%.*g", digits, shown) < 0)
        return;
    text->odd |= !isfinite(value);
    text_add(text, buffer);
}

/* The number of characters that a UTF-8 string takes on a terminal, one column each. */
static size_t text_width(const char *string)
{
    size_t width = 0;
    for (; *string; string++) width += ((unsigned char)*string & 0xC0) != 0x80;
    return width;
}

void text_pad(struct text *text, size_t column)
{
    size_t start = text->length;
    while (start > 0 && text->data[start - 1] != '\n') start--;
    size_t width = text->length > start ? text_width(text->data + start) : 0;
    if (width >= column && width > 0 && text->data[text->length - 1] != ' ') column = width + 1;
    if (width >= column || !text_reserve(text, column - width)) return;
    memset(text->data + text->length, ' ', column - width);
    text->length += column - width;
    text->data[text->length] = '\0';
}

/* JSON writes surrogate pairs as two \uXXXX, and cannot represent a byte that is not UTF-8. */
static void json_escape(struct text *text, unsigned code)
{
    const unsigned first = 0x10000;
    if (code < first)
        text_printf(text, "\\u%04x", code);
    else
        text_printf(text, "\\u%04x\\u%04x", 0xD800 + ((code - first) >> 10),
                    0xDC00 + ((code - first) & 0x3FF));
}

static const uint64_t each_byte = UINT64_C(0x0101010101010101);

/* The highest bit of each byte of `word` that is zero, and perhaps of later ones. */
static uint64_t zero_bytes(uint64_t word)
{
    return (word - each_byte) & ~word & (each_byte << 7);
}

/* Are eight bytes ASCII without escapes? It may be false even if they are. */
static bool are_plain(const char *bytes)
{
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    uint64_t other = (word | (word + each_byte) | (word - each_byte * ' ')) & (each_byte << 7);
    return (other | zero_bytes(word ^ each_byte * '"') | zero_bytes(word ^ each_byte * '\\')) == 0;
}

/* The length of the beginning of `string` that is ASCII without escapes. */
static size_t json_plain(const char *string)
{
    const char *end = string, *last = string + strlen(string);
    while (last - end >= (ptrdiff_t)sizeof(uint64_t) && are_plain(end)) end += sizeof(uint64_t);
    while (*end >= ' ' && *end <= '~' && *end != '"' && *end != '\\') end++;
    return (size_t)(end - string);
}

/* Usually that is all of it. */
static void add_quoted(struct text *text, const char *plain, size_t length)
{
    if (!text_reserve(text, length + 2)) return;
    char *to = text->data + text->length;
    *to = '"';
    memcpy(to + 1, plain, length);
    memcpy(to + 1 + length, "\"", 2);
    text->length += length + 2;
}

void text_json_string(struct text *text, const char *string)
{
    const unsigned replacement = 0xFFFD;
    size_t first = json_plain(string);
    if (!string[first]) {
        add_quoted(text, string, first);
        return;
    }
    text_add_bytes(text, "\"", 1);
    for (;;) {
        size_t plain = json_plain(string);
        text_add_bytes(text, string, plain);
        string += plain;
        if (!*string) break;
        unsigned code = replacement;
        size_t width = utf8_decode(string, strnlen(string, 4), &code);
        if (code == '"' || code == '\\')
            text_printf(text, "\\%c", (int)code);
        else if (code == '\n')
            text_add(text, "\\n");
        else if (code == '\t')
            text_add(text, "\\t");
        else if (width == 0 || !utf8_is_plain(code))
            json_escape(text, code);
        else
            text_add_bytes(text, string, width);
        string += width ? width : 1;
    }
    text_add_bytes(text, "\"", 1);
}

void text_json_key(struct text *text, const char *name)
{
    text_json_string(text, name);
    text_add(text, ": ");
}

void text_exact(struct text *text, double value)
{
    enum { room = 64 };
    if (!text_reserve(text, room)) return;
    char *end = text->data + text->length;
    double shown = value + 0.0; /* write -0 as 0 */
    int length = dtoa_shortest(end, shown);
    if (length < 0) {
        length = format_shortest(end, room, shown);
        text->odd |= !isfinite(value);
    }
    if (length > 0) text->length += (size_t)length;
}

void text_json_number(struct text *text, double value)
{
    if (isfinite(value))
        text_exact(text, value);
    else
        text_add(text, "null");
}

void text_json_member(struct text *text, const char *name, double value, const char *behind)
{
    text_json_key(text, name);
    text_json_number(text, value);
    text_add(text, behind);
}

void text_json_words(struct text *text, const char *name, const char *value, const char *behind)
{
    text_json_key(text, name);
    text_json_string(text, value);
    text_add(text, behind);
}

void text_json_flag(struct text *text, const char *name, bool value, const char *behind)
{
    text_json_key(text, name);
    text_add(text, value ? "true" : "false");
    text_add(text, behind);
}

void text_free(struct text *text)
{
    free(text->data);
    *text = (struct text){0};
}
