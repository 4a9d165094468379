/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Decimal numbers, correctly rounded and independent of the locale.
 */
#ifndef FBD_BASE_NUMBER_H
#define FBD_BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/* The length of the unsigned number that text[0..length) begins with (`2`, `.5`, `3.`, `1e-3`), or 0. */
size_t number_length(const char *text, size_t length);

/* The double nearest to the number text[0..length), for which number_length yields `length`; HUGE_VAL beyond
 * the range of a double. */
double number_value(const char *text, size_t length);

/* Read a bare YAML 1.2 core number (also .5, 1e3, -2; not inf, nan, 0x, 1_000, 1:30). Locale independent. */
bool number_read(const char *text, size_t length, double *value);

#endif
