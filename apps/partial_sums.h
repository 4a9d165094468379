/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The key of a partial table, followed by a checksum for each of its rows, one per line, by which rows that
 * were changed later are detected before they are used.
 *
 * A checksum is written before its row. After a kill there may be one too many, never one too few; rows
 * without one (after a power failure) are not used.
 */
#ifndef FBD_APPS_PARTIAL_SUMS_H
#define FBD_APPS_PARTIAL_SUMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

struct partial_sums {
    FILE *stream; /* positioned after the last checksum read or written */
    uint64_t seed;
    long start; /* position of the first checksum */
};

enum partial_sums_opening {
    partial_sums_opened,
    partial_sums_differ, /* another key */
    partial_sums_failed, /* reason in errno */
};

/* Make a new file of this key, without checksums. False with errno set. */
bool partial_sums_make(struct partial_sums *sums, const char *path, const char *key, const char *header);

/* Open an existing file. *why, to be freed, describes the difference. */
enum partial_sums_opening partial_sums_open(struct partial_sums *sums, const char *path, const char *key,
                                            const char *header, char **why);

/* Compare the next row with its checksum. */
enum partial_row { partial_row_same, partial_row_differs, partial_row_unknown };
enum partial_row partial_sums_check(struct partial_sums *sums, const char *row, size_t length);

/* Truncate to `rows` checksums. False with errno set. */
bool partial_sums_cut(struct partial_sums *sums, size_t rows);

/* Append the checksums of complete rows. False with errno set. */
bool partial_sums_add(struct partial_sums *sums, const char *rows, size_t length);

void partial_sums_close(struct partial_sums *sums);

#endif
