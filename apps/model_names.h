/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of a model for the completion of command lines by the shell.
 */
#ifndef FBD_APPS_MODEL_NAMES_H
#define FBD_APPS_MODEL_NAMES_H

#include <stdbool.h>

/* Write the names of one kind to standard output, one in a line: `methods`, and of a model file `parameters`, `bodies`, `effects` or `forces`
 * (--fmu-outputs).
 * Nothing for a file that cannot be read (NULL: without one). False when there is no such kind. */
bool model_names_write(const char *kind, const char *path);

#endif
