/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Output files that are written completely or not at all: to a temporary file next to the target, renamed at
 * the end. An existing file keeps its mode and, if permitted, its owner; of a link the target is replaced.
 * Files that cannot be replaced (a pipe, a terminal, an open file) are written directly.
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
    char *target, *temporary; /* with links resolved, and next to it; NULL for files written directly */
};

/* Open for writing; "-" is standard output. False with errno set. */
bool whole_file_open(struct whole_file *file, const char *path);

/* Write a piece to the whole_file `context`; nonzero when it fails. The signature is that of fbd_write. */
int whole_file_write(void *context, const char *text, size_t length);

/* Rename the file to its final name (`keep`) or remove it. False with errno set when that fails; then it is
 * removed too. */
bool whole_file_close(struct whole_file *file, bool keep);

/* Write a complete file with this text. False with errno set. Signals that would end the process are deferred
 * meanwhile. */
bool whole_file_put(const char *path, const char *text);
bool whole_file_put_bytes(const char *path, const char *bytes, size_t length);

/* Open a stream for direct writing; `stdout` itself for "-" and its other names. NULL with errno set. */
FILE *whole_file_straight(const char *path);

/* Give an open file the mode and owner of the file that it will replace, as far as permitted. */
void whole_file_be_like(int descriptor, const struct stat *before);

#endif
