/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * printf with the same output of numbers in every locale. A program that uses this library may have called
 * setlocale, and printf then writes the decimal point of that locale, which readers of our files do not
 * expect. All numbers of the library with a fraction are printed here (tests/tools/check_files).
 */
#ifndef FBD_BASE_FORMAT_H
#define FBD_BASE_FORMAT_H

#include <stdarg.h>
#include <stddef.h>

/* As snprintf and vsnprintf. */
int format_into(char *buffer, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));
int format_list(char *buffer, size_t size, const char *format, va_list args)
    __attribute__((format(printf, 3, 0)));

/* The shortest decimal that reads back as `value`, as %g writes it with 15 to 17 digits; infinity and NaN as
 * by %g. */
int format_shortest(char *buffer, size_t size, double value);

#endif
