/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows in SIMD lanes: the runs of some rows at a time, in the lanes of a batch (batch.h). A row whose run is at its end is kept until
 * those before it are there, and the lane gets the next one. The rows are those of row_make, to the last byte.
 */
#ifndef FBD_STUDY_SWEEP_SIMD_H
#define FBD_STUDY_SWEEP_SIMD_H

#include "study/sweep.h"

/* Does it gain anything: may the runs be put into lanes, and does no column ask for more than their ends? */
bool sweep_simd_suits(const struct fbd_sweep *sweep);

struct sweep_simd;

/* What one thread needs, with at most so many lanes; asks `stop`, unless that is NULL, every few steps. NULL when memory is
 * out. */
struct sweep_simd *sweep_simd_new(const struct fbd_sweep *sweep, unsigned lanes, fbd_stop *stop,
                                  void *stop_context);
unsigned sweep_simd_lanes(const struct sweep_simd *simd);
void sweep_simd_free(struct sweep_simd *simd);

/* Rows of one share. */
struct rows_made {
    uint64_t made; /* fewer than were asked for where `stop` said so, or memory is out (text->failed) */
    size_t failed; /* of them: runs that came to no good end */
};

/* Append the rows of the runs `first` to before `end`, in this order, to `text`. */
struct rows_made sweep_simd_make(struct sweep_simd *simd, uint64_t first, uint64_t end, struct text *text);

#endif
