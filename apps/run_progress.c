/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run_progress.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* A run that is over within the first moment needs no line; a line that changes faster cannot be read. */
static const double first_after = 0.5, between = 0.2;

/* Steps take a microsecond or so: the clock and the signals are looked at once in so many of them, but at
 * each of the first steps, which may be slow ones of a large scene. */
enum { steps_between_looks = 64, first_steps = 256 };

static double wall_clock(void)
{
    struct timespec now;
    return clock_gettime(CLOCK_MONOTONIC, &now) == 0 ? (double)now.tv_sec + 1e-9 * (double)now.tv_nsec : 0;
}

static bool terminal_can_redraw(void)
{
    const char *term = getenv("TERM");
    return isatty(STDERR_FILENO) && term && strcmp(term, "dumb") != 0;
}

void run_progress_begin(struct run_progress *progress, const struct interrupt *interrupt, bool visible)
{
    double now = wall_clock();
    *progress = (struct run_progress){.interrupt = interrupt,
                                      .visible = visible && terminal_can_redraw(),
                                      .start = now,
                                      .next = now + first_after};
}

/* "1 h 20 min", "3 min 5 s", "12 s" */
static void put_duration(double seconds, char *text, size_t size)
{
    const double most = 3.6e8; /* beyond that it will not be waited for */
    long whole = (long)(seconds < most ? seconds + 0.5 : most);
    if (whole >= 3600)
        snprintf(text, size, "%ld h %ld min", whole / 3600, whole % 3600 / 60);
    else if (whole >= 60)
        snprintf(text, size, "%ld min %ld s", whole / 60, whole % 60);
    else
        snprintf(text, size, "%ld s", whole);
}

static void draw(struct run_progress *progress, const fbd_progress *now, double elapsed)
{
    double rate = now->t / elapsed;
    char left[64];
    put_duration(rate > 0 ? (now->until - now->t) / rate : HUGE_VAL, left, sizeof left);
    /* back to the start of the line, write, erase what an earlier, longer line has left */
    fprintf(stderr, "\rt = %.4g of %.4g s (%.0f %%), %.3g s simulated per second, %s left, %zu event%s\033[K",
            now->t, now->until, 100 * now->t / now->until, rate, left, now->events,
            now->events == 1 ? "" : "s");
    fflush(stderr);
    progress->drawn = true;
}

int run_progress_watch(void *context, const fbd_progress *now)
{
    struct run_progress *progress = context;
    if (now->steps > first_steps && ++progress->visits < steps_between_looks) return 0;
    progress->visits = 0;
    if (interrupt_asked(progress->interrupt)) return 1;
    if (!progress->visible) return 0;
    double clock = wall_clock();
    if (clock < progress->next) return 0;
    draw(progress, now, clock - progress->start);
    progress->next = clock + between;
    return 0;
}

void run_progress_end(struct run_progress *progress)
{
    if (progress->drawn) fputs("\r\033[K", stderr);
    progress->drawn = false;
}
