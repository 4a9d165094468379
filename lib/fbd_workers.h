/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_workers: sweeps with the help of other processes, of which fbd.h needs to know nothing. Its rules hold here.
 *
 * A leader has the sweep and writes the table; helpers have the same sweep (fbd_sweep_source, fbd_sweep_key) and make
 * shares of its rows by fbd_sweep_run. How shares and rows travel between them is the caller's: fbd-sweep takes MPI.
 */
#ifndef FBD_WORKERS_H
#define FBD_WORKERS_H

#include "fbd.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Who makes the rows of one sweep: the threads of this process, and `helpers` others. */
typedef struct fbd_sweep_workers fbd_sweep_workers;

/* A share of the rows: runs `first` to before `end`; `ticket` is the crew's. */
typedef struct fbd_sweep_share {
    size_t first, end;
    void *ticket;
} fbd_sweep_share;

/* Begin with the threads and return. NULL when memory is out, or `write` is not there. Sweep and what `work` points to
 * must outlive the crew, which is ended by fbd_sweep_finish alone. */
FBD_API fbd_sweep_workers *fbd_sweep_start(const fbd_sweep *sweep, const fbd_sweep_work *work,
                                           size_t helpers);

/* 1: *share is claimed for a helper of `jobs` threads; 0: none now, since earlier rows are missing; -1: there
 * will be none any more. Does not wait. */
FBD_API int fbd_sweep_claim(fbd_sweep_workers *crew, size_t jobs, fbd_sweep_share *share);

/* The rows of a claimed share, and how many they are; fewer than it has stop the sweep after them. What was not claimed,
 * or has been delivered, is passed over. The rows are copied. */
FBD_API void fbd_sweep_deliver(fbd_sweep_workers *crew, const fbd_sweep_share *share, const char *rows,
                               size_t length, const fbd_sweep_counts *counts);

/* Make what is left, wait for the threads and free the crew. */
FBD_API fbd_sweep_end fbd_sweep_finish(fbd_sweep_workers *crew, fbd_sweep_counts *counts);

#ifdef __cplusplus
}
#endif

#endif
