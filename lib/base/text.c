/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool text_reserve(struct text *text, size_t more)
{
    if (text->failed) return false;
    if (text->capacity - text->length > more) return true;
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
    memcpy(text->data + text->length, bytes, length);
    text->length += length;
    text->data[text->length] = '\0';
}

void text_add(struct text *text, const char *string)
{
    text_add_bytes(text, string, strlen(string));
}

/* Mostly there is room, and one pass is enough. */
void text_printf(struct text *text, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    size_t room = text->failed ? 0 : text->capacity - text->length;
    int length = vsnprintf(room ? text->data + text->length : NULL, room, format, args);
    va_end(args);
    bool fits = length >= 0 && (size_t)length < room;
    if (!fits && length >= 0 && text_reserve(text, (size_t)length)) {
        vsnprintf(text->data + text->length, (size_t)length + 1, format, again);
        fits = true;
    }
    if (fits)
        text->length += (size_t)length;
    else if (room)
        text->data[text->length] = '\0';
    va_end(again);
}

/* printf writes the decimal point of the locale, which is all in a finite number that is no digit, sign or
 * exponent. (localeconv, which knows it, must not be called from several threads.) */
static void set_point(char *number)
{
    char *found = number + strspn(number, "+-0123456789");
    if (*found == '\0' || *found == 'e' || *found == '.') return;
    size_t width = strcspn(found, "0123456789");
    *found = '.';
    memmove(found + 1, found + width, strlen(found + width) + 1);
}

void text_number(struct text *text, double value, int digits)
{
    char buffer[64];
    double shown = value == 0 ? 0.0 : value; /* -0 and 0 read the same */
    if (snprintf(buffer, sizeof buffer, "%.*g", digits, shown) < 0) return;
    if (isfinite(value))
        set_point(buffer);
    else
        text->odd = true;
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
    if (width >= column || !text_reserve(text, column - width)) return;
    memset(text->data + text->length, ' ', column - width);
    text->length += column - width;
    text->data[text->length] = '\0';
}

void text_json_string(struct text *text, const char *string)
{
    text_add(text, "\"");
    for (const char *c = string; *c; c++) {
        unsigned char byte = (unsigned char)*c;
        if (byte == '"' || byte == '\\')
            text_printf(text, "\\%c", byte);
        else if (byte == '\n')
            text_add(text, "\\n");
        else if (byte == '\t')
            text_add(text, "\\t");
        else if (byte < 0x20 || byte == 0x7f)
            text_printf(text, "\\u%04x", byte);
        else
            text_add_bytes(text, c, 1);
    }
    text_add(text, "\"");
}

void text_json_key(struct text *text, const char *name)
{
    text_json_string(text, name);
    text_add(text, ": ");
}

void text_json_number(struct text *text, double value)
{
    enum { all_digits = 17 };
    if (isfinite(value))
        text_number(text, value, all_digits);
    else
        text_add(text, "null");
}

void text_free(struct text *text)
{
    free(text->data);
    *text = (struct text){0};
}
