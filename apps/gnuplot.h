/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Gnuplot as a child process: only when a plot is asked for.
 */
#ifndef FBD_APPS_GNUPLOT_H
#define FBD_APPS_GNUPLOT_H

#include <stdbool.h>

/* Is there a gnuplot in PATH? */
bool gnuplot_is_there(void);

/* Let gnuplot carry the script out, its output (an image) going to the descriptor. False when it fails; it
 * has then said why on standard error. */
bool gnuplot_run(const char *script, int output);

#endif
