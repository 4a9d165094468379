/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The key of a partial table, and behind it a checksum for each of its rows, a line each: what a disk, an
 * editor or a hand has changed in a row is found before the row is relied on.
 *
 * A checksum is written before its row. After a kill there may be one too many, never one too few; rows
 * without one (a machine that lost its power) are not relied on.
 */
#ifndef FBD_APPS_PARTIAL_SUMS_H
#define FBD_APPS_PARTIAL_SUMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

struct partial_sums {
    FILE *stream; /* behind the last checksum that was read or written */
    uint64_t seed;
    long start; /* where checksums begin */
};

enum partial_sums_opening {
    partial_sums_opened,
    partial_sums_differ, /* another key */
    partial_sums_failed, /* errno says why */
};

/* Make a new file of this key, without checksums. False with errno set. */
bool partial_sums_make(struct partial_sums *sums, const char *path, const char *key, const char *header);

/* Open one that is there. *why, to be freed, says what differs. */
enum partial_sums_opening partial_sums_open(struct partial_sums *sums, const char *path, const char *key,
                                            const char *header, char **why);

/* What is known of the next row. */
enum partial_row { partial_row_same, partial_row_differs, partial_row_unknown };
enum partial_row partial_sums_check(struct partial_sums *sums, const char *row, size_t length);

/* Only `rows` checksums stay. False with errno set. */
bool partial_sums_cut(struct partial_sums *sums, size_t rows);

/* Add those of whole rows. False with errno set. */
bool partial_sums_add(struct partial_sums *sums, const char *rows, size_t length);

void partial_sums_close(struct partial_sums *sums);

#endif
