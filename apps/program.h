/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Another program as a child process, between a text and a file: gnuplot, rsvg-convert.
 */
#ifndef FBD_APPS_PROGRAM_H
#define FBD_APPS_PROGRAM_H

#include <stdbool.h>

/* Is there a program of that name in PATH? */
bool program_is_there(const char *name);

/* Let the program arguments[0] read the text, its output going to the descriptor. False when it fails; it has then
 * said why on standard error. */
bool program_run(const char *const *arguments, const char *text, int output);

#endif
