/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/stopwatch.h"

#include <time.h>

static double read_clock(clockid_t clock)
{
    struct timespec now;
    return clock_gettime(clock, &now) == 0 ? (double)now.tv_sec + 1e-9 * (double)now.tv_nsec : 0;
}

struct stopwatch stopwatch_start(void)
{
    double processor = read_clock(CLOCK_PROCESS_CPUTIME_ID);
    return (struct stopwatch){.wall = read_clock(CLOCK_MONOTONIC), .processor = processor};
}

double stopwatch_seconds(const struct stopwatch *stopwatch)
{
    const double had = 0.95;
    double wall = read_clock(CLOCK_MONOTONIC) - stopwatch->wall,
           processor = read_clock(CLOCK_PROCESS_CPUTIME_ID) - stopwatch->processor;
    return processor > 0 && processor < had * wall ? processor : wall;
}
