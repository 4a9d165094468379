/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Thread pool: threads that make the rows of a sweep, and the queue that puts them in order.
 *
 * Runs are assigned in shares, in order, to free workers: threads, or other processes. A finished share waits
 * in a ring until those before it are written. The ring is short, so a run that takes long delays the others
 * instead of filling the memory. Shares take some milliseconds and have few runs near the end, so that a kill
 * loses little and no worker waits long for the last share of another.
 */
#ifndef FBD_STUDY_THREAD_POOL_H
#define FBD_STUDY_THREAD_POOL_H

#include "fbd_study.h"
#include "fbd_workers.h"
#include "study/sweep.h"

#include <pthread.h>
#include <stdatomic.h>

/* An element of the ring: a share that was assigned and is not written yet. */
struct place {
    uint64_t first, end;
    uint64_t made; /* rows in it */
    size_t failed; /* failed runs among them */
    struct text rows;
    bool done;
};

struct fbd_sweep_workers {
    const struct fbd_sweep *sweep;
    fbd_sweep_work work;
    size_t jobs, threads; /* wanted; running */
    size_t helpers;       /* other processes that claim shares */
    bool simd;            /* use SIMD batches (batch/rows_simd.h) */
    pthread_t *thread;

    atomic_bool over; /* no more rows are required */

    pthread_mutex_t lock; /* of everything below */
    pthread_cond_t changed;
    uint64_t next;      /* the first run that was not assigned */
    struct place *ring; /* holds the shares `head` to before `tail`, modulo `room` */
    size_t room, head, tail;
    double seconds; /* running mean of the time of one run */
    fbd_sweep_counts counts;
    fbd_sweep_end end;
};

#endif
