/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "terminal_line.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Short operations need no line; a line that changes faster cannot be read. [s] */
static const double first_after = 0.5, between = 0.2;

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

void terminal_line_begin(struct terminal_line *line, bool visible)
{
    double now = wall_clock();
    *line = (struct terminal_line){.visible = visible && terminal_can_redraw(),
                                   .start = now,
                                   .next = now + first_after};
}

void terminal_line_restart(struct terminal_line *line)
{
    if (line->visible) line->start = wall_clock();
}

bool terminal_line_due(struct terminal_line *line, double *elapsed)
{
    if (!line->visible) return false;
    double now = wall_clock();
    if (now < line->next) return false;
    *elapsed = now - line->start;
    line->next = now + between;
    return true;
}

/* Return to the start of the line, write, and erase the rest of a longer line. */
void terminal_line_draw(struct terminal_line *line, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fputs("\r", stderr);
    vfprintf(stderr, format, args);
    fputs("\033[K", stderr);
    fflush(stderr);
    va_end(args);
    line->drawn = true;
}

void terminal_line_end(struct terminal_line *line)
{
    if (line->drawn) fputs("\r\033[K", stderr);
    line->drawn = false;
}

const char *terminal_duration(double seconds, char text[terminal_duration_size])
{
    const double most = 3.6e8; /* not shown beyond that */
    long whole = (long)(seconds < most ? seconds + 0.5 : most);
    if (whole >= 3600)
        snprintf(text, terminal_duration_size, "%ld h %ld min", whole / 3600, whole % 3600 / 60);
    else if (whole >= 60)
        snprintf(text, terminal_duration_size, "%ld min %ld s", whole / 60, whole % 60);
    else
        snprintf(text, terminal_duration_size, "%ld s", whole);
    return text;
}
