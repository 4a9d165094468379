/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Texts of partial tables: reading of lines, formatting of messages.
 */
#ifndef FBD_APPS_PARTIAL_LINES_H
#define FBD_APPS_PARTIAL_LINES_H

#include <stdbool.h>
#include <stdio.h>

/* A text to be freed; NULL when memory is out. */
char *partial_format(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A line of a stream without its end, to be freed; NULL at the end of the stream, and for a line without a
 * newline. */
char *partial_line(FILE *stream, size_t *length);

/* True if partial_line returned NULL because of a read error or lack of memory, not at the end of the file:
 * to be checked before the file is truncated there. */
bool partial_line_failed(FILE *stream);

#endif
