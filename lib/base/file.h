/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Files as texts.
 */
#ifndef FBD_BASE_FILE_H
#define FBD_BASE_FILE_H

#include "fbd.h"

/* Read the whole of a plain file, of standard input ("-") or of an open file (/dev/fd/3), with a zero behind
 * it, to be freed with free(); NULL with a note `cannot-read`. */
char *file_text(const char *path, size_t *length, fbd_errors *errors);

/* A copy of a text owned by the caller; NULL with a note when memory is out. */
char *file_copy(const char *text, size_t length, fbd_errors *errors);

/* Does the path lead from the root, wherever the program stands? Windows has another rule. */
#ifndef PATH_IS_ABSOLUTE
#define PATH_IS_ABSOLUTE(path) ((path)[0] == '/')
#endif

/* The name of a file in messages. */
const char *file_name(const char *path);

#endif
