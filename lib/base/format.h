/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * printf whose numbers look the same in every locale. A program that has this library in it may have called
 * setlocale, and printf then writes the decimal point of that locale: no reader of the files that we write
 * expects one. All numbers of the library with a fraction are printed here (tests/tools/check_files).
 */
#ifndef FBD_BASE_FORMAT_H
#define FBD_BASE_FORMAT_H

#include <stdarg.h>
#include <stddef.h>

/* As snprintf and vsnprintf. */
int format_into(char *buffer, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));
int format_list(char *buffer, size_t size, const char *format, va_list args)
    __attribute__((format(printf, 3, 0)));

/* The shortest decimal that reads back as `value`, as %g writes it with 15 to 17 digits; what is not finite as %g has it. */
int format_shortest(char *buffer, size_t size, double value);

#endif
