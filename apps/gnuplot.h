/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Gnuplot as a child process, started only for a requested plot.
 */
#ifndef FBD_APPS_GNUPLOT_H
#define FBD_APPS_GNUPLOT_H

#include "command_line.h"
#include <stdbool.h>

/* True if there is a gnuplot in PATH. */
bool gnuplot_is_there(void);

/* Execute the script with gnuplot; its output (an image) goes to the descriptor. False when it fails, after
 * gnuplot has printed the reason on standard error. */
bool gnuplot_run(const char *script, int output);

/* False, with a message, when no plot can be written to a file of this name: another ending, no gnuplot. */
bool plot_can_be_written(const struct command_line *line, const char *file);

#endif
