/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "progress.h"

#include <time.h>
#include <unistd.h>

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

void progress_start(struct progress *progress, size_t before, size_t runs, bool quiet)
{
    *progress = (struct progress){.shown = !quiet && isatty(STDERR_FILENO), .before = before, .runs = runs};
    progress->start = progress->last = now();
}

/* "3 h 05 min", "4 min 10 s", "12 s" */
static void write_time(double seconds)
{
    const double longest = 1e9;
    long whole = (long)ceil(seconds < longest ? seconds : longest), minutes = whole / 60,
         hours = minutes / 60;
    if (hours > 0)
        fprintf(stderr, "%ld h %02ld min", hours, minutes % 60);
    else if (minutes > 0)
        fprintf(stderr, "%ld min %02ld s", minutes, whole % 60);
    else
        fprintf(stderr, "%ld s", whole);
}

void progress_show(void *context, const fbd_sweep_counts *counts)
{
    const double pause = 0.2; /* between two pictures */
    struct progress *progress = context;
    double time = now(), elapsed = time - progress->start;
    if (!progress->shown || time - progress->last < pause || counts->written == 0) return;
    size_t done = progress->before + counts->written;
    double rate = (double)counts->written / elapsed;
    progress->last = time;
    progress->drawn = true;
    fprintf(stderr, "\r\033[K%zu of %zu runs (%.0f %%), %.3g runs/s", done, progress->runs,
            100 * (double)done / (double)progress->runs, rate);
    if (counts->failed) fprintf(stderr, ", %zu failed", counts->failed);
    fputs(", ", stderr);
    write_time((double)(progress->runs - done) / rate);
    fputs(" left", stderr);
    fflush(stderr);
}

void progress_end(struct progress *progress)
{
    if (progress->drawn) fputs("\r\033[K", stderr);
    progress->drawn = false;
}
