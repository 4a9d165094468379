/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Output files that are written whole or not at all: into a temporary file beside the target, renamed at the
 * end. A file that was there keeps its mode and, where the system lets us, its owner; a link stays a link,
 * and what it points to is replaced. What cannot be replaced (a pipe, a terminal, an open file) is written
 * straight.
 */
#ifndef FBD_APPS_WHOLE_FILE_H
#define FBD_APPS_WHOLE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/stat.h>

struct whole_file {
    FILE *stream;
    const char *path;
    char *target, *temporary; /* behind links, and beside it; NULL for what is written straight */
};

/* Open for writing; "-" is standard output. False with errno set. */
bool whole_file_open(struct whole_file *file, const char *path);

/* Write a piece to the whole_file `context`; non-zero when it fails. The signature is that of fbd_write. */
int whole_file_write(void *context, const char *text, size_t length);

/* Put the file in its place (`keep`) or leave nothing behind. False with errno set when that fails; nothing
 * is left behind then either. */
bool whole_file_close(struct whole_file *file, bool keep);

/* All of it at once: a file with this text. False with errno set. A signal that ends the process comes before
 * or after it. */
bool whole_file_put(const char *path, const char *text);
bool whole_file_put_bytes(const char *path, const char *bytes, size_t length);

/* A stream into what cannot be replaced; `stdout` itself for "-" and its other names. NULL with errno set. */
FILE *whole_file_straight(const char *path);

/* Give an open file the mode and the owner of the file that it will replace, as far as the system lets us. */
void whole_file_be_like(int descriptor, const struct stat *before);

#endif
