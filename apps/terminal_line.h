/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One line on a terminal that is drawn over and over: how far something is. Nothing at all where standard
 * error is no terminal, or one that cannot draw a line again.
 */
#ifndef FBD_APPS_TERMINAL_LINE_H
#define FBD_APPS_TERMINAL_LINE_H

#include <stdbool.h>
#include <stddef.h>

struct terminal_line {
    bool visible;
    bool drawn;         /* there is something to take away */
    double start, next; /* wall clock [s]: begun, to be drawn again */
};

/* `visible` false: nothing is ever drawn. */
void terminal_line_begin(struct terminal_line *line, bool visible);

/* What is shown begins anew. */
void terminal_line_restart(struct terminal_line *line);

/* Is it time to draw? *elapsed is then the time since the beginning [s]. */
bool terminal_line_due(struct terminal_line *line, double *elapsed);

void terminal_line_draw(struct terminal_line *line, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Take the line away. */
void terminal_line_end(struct terminal_line *line);

enum { terminal_duration_size = 64 };

/* "1 h 20 min", "3 min 5 s", "12 s" */
const char *terminal_duration(double seconds, char text[terminal_duration_size]);

#endif
