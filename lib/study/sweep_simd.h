/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows by SIMD batches: the runs of several rows at the same time, in the lanes of a batch (batch.h). A
 * finished row is kept until those before it are complete, and its lane gets the next one. The rows are
 * bytewise those of row_make.
 */
#ifndef FBD_STUDY_SWEEP_SIMD_H
#define FBD_STUDY_SWEEP_SIMD_H

#include "fbd_study.h"
#include "study/sweep.h"

/* True if the runs fit into lanes, and no column requires more than their ends. */
bool sweep_simd_suits(const struct fbd_sweep *sweep);

struct sweep_simd;

/* The data of one thread, with at most `lanes` lanes; calls `stop`, unless NULL, every few steps. NULL when
 * memory is out. */
struct sweep_simd *sweep_simd_new(const struct fbd_sweep *sweep, unsigned lanes, fbd_stop *stop,
                                  void *stop_context);
unsigned sweep_simd_lanes(const struct sweep_simd *simd);
void sweep_simd_free(struct sweep_simd *simd);

/* Rows of one share. */
struct rows_made {
    uint64_t made; /* fewer than requested if `stop` returned nonzero, or memory is out (text->failed) */
    size_t failed; /* of these: failed runs */
};

/* Append the rows of the runs `first` to before `end`, in this order, to `text`. */
struct rows_made sweep_simd_make(struct sweep_simd *simd, uint64_t first, uint64_t end, struct text *text);

#endif
