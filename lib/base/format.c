/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/format.h"

#include "base/dtoa_shortest.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

/* The C locale is a constant of the C library (glibc, musl): newlocale allocates no memory for it and cannot
 * fail. uselocale affects this thread only. */
int format_list(char *buffer, size_t size, const char *format, va_list args)
{
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
