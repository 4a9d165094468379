/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/format.h"

#include "base/dtoa_shortest.h"

#include <locale.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the directives of most texts, without printf and its locale */

struct output {
    char *next;
    size_t room; /* with the terminating zero */
};

/* False when there is no room. */
static bool put(struct output *output, const char *bytes, size_t length)
{
    if (length >= output->room) return false;
    memcpy(output->next, bytes, length);
    output->next += length;
    output->room -= length;
    *output->next = '\0';
    return true;
}

static bool put_rounded(struct output *output, double value, int digits, bool plus)
{
    char buffer[dtoa_size];
    int length = dtoa_rounded(buffer, value, digits);
    if (length < 0 || (plus && value >= 0 && !put(output, "+", 1))) return false;
    return put(output, buffer, (size_t)length);
}

/* Write a text with %s, %%, %.6g and %+.6g, of any digit; false for other directives or numbers, or without room. */
static bool write_simple(struct output *output, const char *format, va_list args)
{
    for (;;) {
        const char *next = strchr(format, '%');
        if (!put(output, format, next ? (size_t)(next - format) : strlen(format))) return false;
        if (!next) return true;
        bool plus = next[1] == '+';
        next += 1 + plus;
        if (*next == 's' && !plus) {
            const char *string = va_arg(args, const char *);
            if (!put(output, string, strlen(string))) return false;
            format = next + 1;
        } else if (*next == '%' && !plus) {
            if (!put(output, "%", 1)) return false;
            format = next + 1;
        } else if (next[0] == '.' && next[1] >= '1' && next[1] <= '9' && next[2] == 'g') {
            if (!put_rounded(output, va_arg(args, double), next[1] - '0', plus)) return false;
            format = next + 3;
        } else {
            return false;
        }
    }
}

/* ---- all of them */

/* The C locale is a constant of the C library (glibc, musl): newlocale allocates no memory for it and cannot
 * fail. uselocale affects this thread only. */
int format_list(char *buffer, size_t size, const char *format, va_list args)
{
    struct output output = {buffer, size};
    va_list copy;
    va_copy(copy, args);
    bool simple = write_simple(&output, format, copy);
    va_end(copy);
    if (simple) return (int)(output.next - buffer);
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    locale_t before = plain ? uselocale(plain) : (locale_t)0;
    int length = vsnprintf(buffer, size, format, args);
    if (before) uselocale(before);
    if (plain) freelocale(plain);
    return length;
}

int format_shortest(char *buffer, size_t size, double value)
{
    enum { fewest = 15, most = 17 };
    int written = size >= dtoa_size ? dtoa_shortest(buffer, value) : -1;
    if (written >= 0) return written;
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    locale_t before = plain ? uselocale(plain) : (locale_t)0;
    int length = 0;
    for (int digits = fewest; digits <= most; digits++) {
        length = snprintf(buffer, size, "%.*g", digits, value);
        if (!(strtod(buffer, NULL) < value || strtod(buffer, NULL) > value)) break;
    }
    if (before) uselocale(before);
    if (plain) freelocale(plain);
    return length;
}

int format_into(char *buffer, size_t size, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = format_list(buffer, size, format, args);
    va_end(args);
    return length;
}
