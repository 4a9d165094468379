/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Another program as a child process that converts a text to a file: gnuplot, rsvg-convert.
 */
#ifndef FBD_APPS_PROGRAM_H
#define FBD_APPS_PROGRAM_H

#include <stdbool.h>

/* True if there is a program of that name in PATH. */
bool program_is_there(const char *name);

/* Run the program arguments[0] with the text as input and the descriptor as output. False when it fails,
 * after it has printed the reason on standard error. */
bool program_run(const char *const *arguments, const char *text, int output);

/* Run the program within a folder; its output goes to a file `log` there. False when it fails, after its last lines were
 * printed on standard error. */
bool program_run_in(const char *const *arguments, const char *folder);

#endif
