/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scripts for gnuplot: plots over time, one below the other.
 */
#ifndef FBD_BASE_GNUPLOT_H
#define FBD_BASE_GNUPLOT_H

#include "base/text.h"

/* The time gnuplot takes to read data within a script is quadratic. */
enum { gnuplot_most_rows = 4000 };

/* Begin a script for a number of plots. The ending of `file`, .svg, .pdf or .png, chooses the terminal; NULL for that
 * of the user. */
void gnuplot_begin(struct text *text, const char *file, size_t plots);

/* Begin the plots, after the data, for times from `from` to `to` [s]. */
void gnuplot_layout(struct text *text, const char *title, size_t plots, double from, double to);

/* Append a string in single quotes, in which gnuplot takes everything literally, commands as well. */
void gnuplot_quote(struct text *text, const char *string);

/* Append a unit: m/s^2 as m/s², N*m as N·m. */
void gnuplot_unit(struct text *text, const char *unit);

#endif
