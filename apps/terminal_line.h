/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A progress line that is redrawn on a terminal. Draws only if standard error is a terminal that can redraw a
 * line.
 */
#ifndef FBD_APPS_TERMINAL_LINE_H
#define FBD_APPS_TERMINAL_LINE_H

#include <stdbool.h>

struct terminal_line {
    bool visible;
    bool drawn;         /* a line is on the screen */
    double start, next; /* wall clock [s]: start, time of the next drawing */
};

/* `visible` false: never draw. */
void terminal_line_begin(struct terminal_line *line, bool visible);

/* Restart the clock. */
void terminal_line_restart(struct terminal_line *line);

/* True when the line should be redrawn. *elapsed is then the time since the start [s]. */
bool terminal_line_due(struct terminal_line *line, double *elapsed);

void terminal_line_draw(struct terminal_line *line, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Erase the line. */
void terminal_line_end(struct terminal_line *line);

enum { terminal_duration_size = 64 };

/* "1 h 20 min", "3 min 5 s", "12 s" */
const char *terminal_duration(double seconds, char text[terminal_duration_size]);

#endif
