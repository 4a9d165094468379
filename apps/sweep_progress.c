/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sweep_progress.h"

void sweep_progress_begin(struct sweep_progress *progress, size_t before, size_t runs, bool visible)
{
    *progress = (struct sweep_progress){.before = before, .runs = runs};
    terminal_line_begin(&progress->line, visible);
}

int sweep_progress_show(void *context, const fbd_progress *now)
{
    struct sweep_progress *progress = context;
    double elapsed;
    char failed[32] = "", left[terminal_duration_size];
    if (now->written == 0 || !terminal_line_due(&progress->line, &elapsed)) return 0;
    size_t done = progress->before + now->written;
    double rate = (double)now->written / elapsed;
    if (now->failed) snprintf(failed, sizeof failed, ", %zu failed", now->failed);
    terminal_line_draw(&progress->line, "%zu of %zu runs (%.0f %%), %.3g runs/s%s, %s left", done,
                       progress->runs, 100 * (double)done / (double)progress->runs, rate, failed,
                       terminal_duration((double)(progress->runs - done) / rate, left));
    return 0;
}

void sweep_progress_end(struct sweep_progress *progress)
{
    terminal_line_end(&progress->line);
}
