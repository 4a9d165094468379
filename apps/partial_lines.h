/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Texts of partial tables: lines that are read, messages that are made.
 */
#ifndef FBD_APPS_PARTIAL_LINES_H
#define FBD_APPS_PARTIAL_LINES_H

#include <stdbool.h>
#include <stdio.h>

/* A text to be freed; NULL when memory is out. */
char *partial_format(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A line of a stream without its end, to be freed; NULL at the end, and for a line that was torn off. */
char *partial_line(FILE *stream, size_t *length);

/* What cannot be read, or held in memory, is no end: to be asked before anything is cut off for it. */
bool partial_line_failed(FILE *stream);

#endif
