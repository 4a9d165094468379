/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Crew: threads that make the rows of a sweep, and the queue that puts them in order.
 *
 * Runs are handed out in shares, in order, to whoever is free: the threads, or other processes. A share that
 * is done waits in a ring until those before it are written. The ring has few places, so a run that takes
 * long holds up the others at its end rather than filling the memory. Shares are short in time (some
 * milliseconds) and few runs at the end, so that a kill loses little and nobody waits for a neighbour's last
 * share.
 */
#ifndef FBD_STUDY_THREAD_POOL_H
#define FBD_STUDY_THREAD_POOL_H

#include "fbd_workers.h"
#include "study/sweep.h"

#include <pthread.h>
#include <stdatomic.h>

/* A place of the ring: a share that was handed out and is not written yet. */
struct place {
    uint64_t first, end;
    uint64_t made; /* rows that it has */
    size_t failed; /* runs among them that came to no good end */
    struct text rows;
    bool done;
};

struct fbd_sweep_workers {
    const struct fbd_sweep *sweep;
    fbd_sweep_work work;
    size_t jobs, threads; /* wanted; running */
    size_t helpers;       /* other processes that claim shares */
    bool simd;            /* runs go into lanes (sweep_simd.h) */
    pthread_t *thread;

    atomic_bool over; /* no more rows are wanted */

    pthread_mutex_t lock; /* of everything below */
    pthread_cond_t changed;
    uint64_t next;      /* the first run that was not handed out */
    struct place *ring; /* places of the shares `head` to before `tail`, modulo `room` */
    size_t room, head, tail;
    double seconds; /* of one run, about */
    fbd_sweep_counts counts;
    fbd_sweep_end end;
};

#endif
