/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A table that grows row by row and can be resumed: FILE.part while it grows, renamed to FILE when it is
 * complete. FILE.part.key contains a text of everything that determines the rows, and a checksum for each
 * row; a table is resumed only with the same text, and only after rows with correct checksums. Rows are
 * appended in order, so after a kill at any instant the file holds the first rows, and at most an incomplete
 * line at its end, which is dropped. Where FILE is a link, all these files are next to its target.
 */
#ifndef FBD_APPS_PARTIAL_FILE_H
#define FBD_APPS_PARTIAL_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "partial_sums.h"

struct partial_file {
    FILE *stream;
    const char *path; /* NULL for standard output */
    char *target;     /* `path` with links resolved */
    char *part, *key; /* names; NULL for streams (stdout, a pipe, a terminal), which cannot be resumed */
    struct partial_sums sums;
    size_t rows;   /* existing rows */
    size_t failed; /* of these, failed runs */
    int error;     /* errno of the first failed write, which may have been in another thread */
};

enum partial_opening {
    partial_opened,
    partial_refused, /* an existing file must not be changed */
    partial_failed,  /* a system call failed, or memory is out */
};

/* Open for the missing rows. With `resume` an existing FILE.part is checked and continued; without it an
 * existing one is refused, and so is one locked by another process. On failure *why, to be freed, is the
 * reason, or NULL when memory is out. */
enum partial_opening partial_file_open(struct partial_file *file, const char *path, const char *header,
                                       const char *key, bool resume, char **why);

/* Append rows to the partial_file `context` and flush them. Nonzero when that fails. The signature is that of
 * fbd_write. */
int partial_file_write(void *context, const char *rows, size_t length);

/* Rename the file to its final name if it is complete, else keep it for later. False with errno set when that
 * fails. */
bool partial_file_close(struct partial_file *file, bool whole);

#endif
