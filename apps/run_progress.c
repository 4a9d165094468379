/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run_progress.h"

/* A step or a row may take only a microsecond: clock and signals are checked once in so many of them, but at each
 * of the first ones, which may be slow steps of a large scene. */
enum { visits_between_looks = 64, first_visits = 256 };

void run_progress_begin(struct run_progress *progress, const struct interrupt *interrupt, bool visible)
{
    *progress = (struct run_progress){.interrupt = interrupt};
    terminal_line_begin(&progress->line, visible);
}

static void draw(struct run_progress *progress, const fbd_progress *now, double elapsed)
{
    double rate = now->t / elapsed;
    char left[terminal_duration_size];
    terminal_line_draw(&progress->line,
                       "t = %.4g of %.4g s (%.0f %%), %.3g s simulated per second, %s left, %zu event%s",
                       now->t, now->until, 100 * now->t / now->until, rate,
                       terminal_duration(rate > 0 ? (now->until - now->t) / rate : HUGE_VAL, left),
                       now->events, now->events == 1 ? "" : "s");
}

int run_progress_watch(void *context, const fbd_progress *now)
{
    struct run_progress *progress = context;
    double elapsed;
    if (++progress->visits > first_visits && progress->visits % visits_between_looks != 0) return 0;
    if (interrupt_asked(progress->interrupt)) return 1;
    if (now->t < progress->t) terminal_line_restart(&progress->line);
    progress->t = now->t;
    if (terminal_line_due(&progress->line, &elapsed)) draw(progress, now, elapsed);
    return 0;
}

void run_progress_end(struct run_progress *progress)
{
    terminal_line_end(&progress->line);
}
