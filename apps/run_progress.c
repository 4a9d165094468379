/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run_progress.h"

/* Steps may take only a microsecond: clock and signals are checked once in so many of them, but at each of
 * the first steps, which may be slow ones of a large scene. */
enum { steps_between_looks = 64, first_steps = 256 };

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
    if (now->steps > first_steps && ++progress->visits < steps_between_looks) return 0;
    progress->visits = 0;
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
