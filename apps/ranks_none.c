/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ranks.h"

#include <stdlib.h>
#include <string.h>

#include "complain.h"
#include "fbd_study.h"

bool ranks_start(struct ranks *ranks)
{
    const char *size = getenv("OMPI_COMM_WORLD_SIZE");
    *ranks = (struct ranks){0, 1};
    if (!size || strcmp(size, "1") == 0) return true;
    complain("fbd-sweep: started under mpirun, but built without MPI");
    return false;
}

void ranks_end(const struct ranks *ranks)
{
    (void)ranks;
}

bool ranks_give(const struct ranks *ranks, const char *text, size_t length)
{
    (void)ranks;
    (void)text;
    (void)length;
    return true;
}

bool ranks_take(char **text, size_t *length)
{
    *text = NULL;
    *length = 0;
    return true;
}

fbd_sweep_end ranks_lead(const struct ranks *ranks, const fbd_sweep *sweep, const fbd_sweep_work *work,
                         fbd_sweep_counts *counts)
{
    (void)ranks;
    return fbd_sweep_run(sweep, work, counts);
}

void ranks_follow(const fbd_sweep *sweep, const fbd_sweep_work *work)
{
    (void)sweep;
    (void)work;
}
