/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_workers: sweeps distributed over several processes. The rules of fbd.h apply.
 *
 * A leader has the sweep and writes the table; helpers have the same sweep (fbd_sweep_source, fbd_sweep_key)
 * and compute shares of its rows by fbd_sweep_run. The caller transports shares and rows between them:
 * fbd-sweep uses MPI.
 */
#ifndef FBD_WORKERS_H
#define FBD_WORKERS_H

#include "fbd.h"
#include "fbd_study.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The workers of one sweep: the threads of this process, and `helpers` other processes. */
typedef struct fbd_sweep_workers fbd_sweep_workers;

/* A share of the rows: runs `first` to before `end`; `ticket` is internal. */
typedef struct fbd_sweep_share {
    size_t first, end;
    void *ticket;
} fbd_sweep_share;

/* Start the threads and return. NULL when memory is out, or `write` is NULL. Sweep and the pointers in `work`
 * must outlive the workers, which only fbd_sweep_finish ends. */
FBD_API fbd_sweep_workers *fbd_sweep_start(const fbd_sweep *sweep, const fbd_sweep_work *work,
                                           size_t helpers);

/* 1: *share is claimed for a helper of `jobs` threads; 0: none now, since earlier rows are missing; -1: no
 * more shares. Does not wait. */
FBD_API int fbd_sweep_claim(fbd_sweep_workers *crew, size_t jobs, fbd_sweep_share *share);

/* Deliver the rows of a claimed share and their number; if they are fewer than the share, the sweep stops
 * after them. A share that was not claimed, or was delivered before, is ignored. The rows are copied. */
FBD_API void fbd_sweep_deliver(fbd_sweep_workers *crew, const fbd_sweep_share *share, const char *rows,
                               size_t length, const fbd_sweep_counts *counts);

/* Compute the remaining rows, wait for the threads and free the workers. */
FBD_API fbd_sweep_end fbd_sweep_finish(fbd_sweep_workers *crew, fbd_sweep_counts *counts);

#ifdef __cplusplus
}
#endif

#endif
