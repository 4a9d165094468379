/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Texts, drawings and plots of the library to files. Each function frees its text, which is NULL where memory is out,
 * and returns false with a message when it fails.
 */
#ifndef FBD_APPS_DELIVER_H
#define FBD_APPS_DELIVER_H

#include <stdbool.h>
#include <stddef.h>

/* Write a text; `path` is NULL for standard output. */
bool deliver_text(const char *path, char *text);

/* Write a drawing in the format given by the ending of the file. */
bool deliver_picture(const char *path, char *svg);

/* Make a plot by gnuplot from its script. */
bool deliver_plot(const char *path, char *script);

/* Cut a list at its commas into at most `room` names, which point into it; returns their number. `list` may be
 * NULL. */
size_t cut_list(char *list, const char **names, size_t room);

#endif
