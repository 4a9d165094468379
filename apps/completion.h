/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Completion of a command line by the shell, generated from the option tables; names of the model come from the
 * program itself (model_names.h).
 */
#ifndef FBD_APPS_COMPLETION_H
#define FBD_APPS_COMPLETION_H

#include "command_line.h"

/* Write the script for `shell` (bash, zsh or fish) to standard output; false when there is no such shell. */
bool completion_write(const struct command_line *line, const char *shell);

/* Restricted Damerau-Levenshtein distance: number of letters to insert, delete, replace or exchange with the
 * next one; 32 for words longer than that. */
int completion_distance(const char *a, const char *b);

/* The option most similar to `wrong` (`--acuracy`), or NULL. */
const char *completion_nearest(const struct command_line *line, const char *wrong);

#endif
