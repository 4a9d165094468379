/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ranks: the processes that mpirun has started, of which the first leads: it reads the file, hands out shares
 * and writes. Built without MPI (ranks_none.c) there is one.
 */
#ifndef FBD_APPS_RANKS_H
#define FBD_APPS_RANKS_H

#include "fbd.h"

struct ranks {
    int rank, count;
};

/* MPI is started only under mpirun. False, with a message, when that is so and it cannot be used. */
bool ranks_start(struct ranks *ranks);
void ranks_end(const struct ranks *ranks);

/* The leader gives a text to all others (NULL: there is none, and they have nothing to do), and each of these
 * takes it, to be freed with free(). False when memory is out in one of them. */
bool ranks_give(const struct ranks *ranks, const char *text, size_t length);
bool ranks_take(char **text, size_t *length);

/* The leader's part: like fbd_sweep_run, with the help of the others. */
fbd_sweep_end ranks_lead(const struct ranks *ranks, const fbd_sweep *sweep, const fbd_sweep_work *work,
                         fbd_sweep_counts *counts);

/* What the others do until no share is left: `work` gives them jobs and stop. One that has no sweep (NULL),
 * since memory is out, ends all. */
void ranks_follow(const fbd_sweep *sweep, const fbd_sweep_work *work);

#endif
