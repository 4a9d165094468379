/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows by SIMD batches: the runs of several rows at the same time, in the lanes of a batch (batch.h). A
 * finished row is kept until those before it are complete, and its lane gets the next one. The rows are
 * bytewise those of row_make.
 */
#ifndef FBD_BATCH_ROWS_SIMD_H
#define FBD_BATCH_ROWS_SIMD_H

#include "batch/rows.h"

/* True if the runs fit into lanes, and no column requires more than their ends. */
bool rows_simd_suits(const struct rows *rows);

struct rows_simd;

/* The largest number of lanes. */
enum { rows_simd_most = 8 };

/* The data of one thread, with at most `lanes` lanes; calls `stop`, unless NULL, every few steps. NULL when
 * memory is out. */
struct rows_simd *rows_simd_new(const struct rows *rows, unsigned lanes, fbd_stop *stop, void *stop_context);
unsigned rows_simd_lanes(const struct rows_simd *simd);
void rows_simd_free(struct rows_simd *simd);

/* Rows of one share. */
struct rows_made {
    uint64_t made; /* fewer than requested if `stop` returned nonzero, or memory is out (text->failed) */
    size_t failed; /* of these: failed runs */
};

/* Append the rows of the runs `first` to before `end`, in this order, to `text`. */
struct rows_made rows_simd_make(struct rows_simd *simd, uint64_t first, uint64_t end, struct text *text);

#endif
