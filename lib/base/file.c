/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/file.h"

#include "base/diag.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { largest_file = 64 * 1024 * 1024 };

/* `why` is NULL when memory is out. */
static void cannot_read(fbd_errors *errors, const char *path, const char *why)
{
    if (!why) {
        diag_out_of_memory(errors);
        return;
    }
    diag_in_file(errors, path);
    diag_add(errors, FBD_ERROR, "cannot-read", (struct pos){0, 0}, NULL, "cannot read the file: %s", why);
}

/* The whole of a stream, with a zero behind it, or NULL with *why, which is NULL when memory is out. */
static char *read_stream(FILE *stream, size_t *length, const char **why)
{
    size_t room = 16384;
    char *text = NULL;
    *length = 0;
    for (;;) {
        char *more = realloc(text, room);
        if (!more) break;
        text = more;
        *length += fread(text + *length, 1, room - *length, stream);
        if (*length < room) {
            *why = ferror(stream) ? strerror(errno) : NULL;
            text[*length] = '\0';
            if (!*why) return text;
            free(text);
            return NULL;
        }
        if (room > largest_file) {
            free(text);
            *why = "it is larger than 64 MiB";
            return NULL;
        }
        room *= 2;
    }
    free(text);
    *why = NULL;
    return NULL;
}

char *file_text(const char *path, size_t *length, fbd_errors *errors)
{
    bool standard = strcmp(path, "-") == 0;
    if (!standard) diag_reads(errors, path);
    FILE *stream = standard ? stdin : fopen(path, "rb");
    if (!stream) {
        cannot_read(errors, path, errno == ENOMEM ? NULL : strerror(errno));
        return NULL;
    }
    const char *why = NULL;
    char *text = read_stream(stream, length, &why);
    if (!standard) fclose(stream);
    if (!text) cannot_read(errors, path, why);
    return text;
}

char *file_copy(const char *text, size_t length, fbd_errors *errors)
{
    char *copy = malloc(length + 1);
    if (copy)
        memcpy(copy, text, length);
    else
        diag_out_of_memory(errors);
    return copy;
}

const char *file_name(const char *path)
{
    return strcmp(path, "-") == 0 ? "<stdin>" : path;
}
