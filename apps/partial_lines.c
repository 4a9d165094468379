/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "partial_lines.h"

#include <stdarg.h>
#include <stdlib.h>

char *partial_format(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *made = length < 0 ? NULL : malloc((size_t)length + 1);
    va_start(args, format);
    if (made) vsnprintf(made, (size_t)length + 1, format, args);
    va_end(args);
    return made;
}

char *partial_line(FILE *stream, size_t *length)
{
    char *line = NULL;
    size_t room = 0;
    ssize_t read = getline(&line, &room, stream);
    if (read > 0 && line[read - 1] == '\n') {
        *length = (size_t)read - 1;
        line[*length] = '\0';
        return line;
    }
    free(line);
    return NULL;
}

bool partial_line_failed(FILE *stream)
{
    return ferror(stream) || !feof(stream);
}
