/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ranks: the processes started by mpirun. The first is the leader: it reads the file, distributes shares and
 * writes. Without MPI (ranks_none.c) there is one.
 */
#ifndef FBD_APPS_RANKS_H
#define FBD_APPS_RANKS_H

#include "fbd_study.h"

struct ranks {
    int rank, count;
};

/* Start MPI if the process runs under mpirun. False, with a message, when it does and MPI cannot be used. */
bool ranks_start(struct ranks *ranks);
void ranks_end(const struct ranks *ranks);

/* Send a text from the leader to all others (NULL: no text, and no work), and receive it in them, to be freed
 * with free(). False when memory is out in one of them. */
bool ranks_give(const struct ranks *ranks, const char *text, size_t length);
bool ranks_take(char **text, size_t *length);

/* The leader's part: as fbd_sweep_run, with the help of the other ranks. */
fbd_sweep_end ranks_lead(const struct ranks *ranks, const fbd_sweep *sweep, const fbd_sweep_work *work,
                         fbd_sweep_counts *counts);

/* The part of the other ranks, until no share is left; of `work` they use jobs and stop. A rank without a
 * sweep (NULL, memory is out) aborts all. */
void ranks_follow(const fbd_sweep *sweep, const fbd_sweep_work *work);

#endif
