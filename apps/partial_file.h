/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A table that grows row by row and can be gone on with: FILE.part while it grows, renamed FILE when it is
 * whole. Beside it lies FILE.part.key, a text that says what the rows depend on, with a checksum for each
 * row; only a table with the same text is gone on with, and only behind rows that have their checksums. Rows
 * are appended in order, so after a kill at any instant the file holds the first rows, and at most a torn
 * line at its end, which is dropped. Where FILE is a link, all this lies beside what it points to.
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
    char *target;     /* what the path leads to */
    char *part, *key; /* names; NULL for what cannot be gone on with: standard output, a pipe, a terminal */
    struct partial_sums sums;
    size_t rows;   /* that are there already */
    size_t failed; /* of these, runs that came to no good end */
    int error;     /* errno of the first write that failed: it may have been in another thread */
};

enum partial_opening {
    partial_opened,
    partial_refused, /* what is there is not to be touched */
    partial_failed,  /* the system says no, or memory is out */
};

/* Open for the rows that are missing. With `resume` what is there is checked and gone on with; without it a
 * FILE.part that is there is refused, and so is one that another process writes. When it is not opened, *why
 * says why, to be freed, or is NULL when memory is out. */
enum partial_opening partial_file_open(struct partial_file *file, const char *path, const char *header,
                                       const char *key, bool resume, char **why);

/* Append rows to the partial_file `context`; they are handed to the system at once. Non-zero when that fails.
 * The signature is that of fbd_write. */
int partial_file_write(void *context, const char *rows, size_t length);

/* Put the file in its place, if it is whole, or keep it for later. False with errno set when that fails. */
bool partial_file_close(struct partial_file *file, bool whole);

#endif
