/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd-run --fmu: a model as an FMU.
 */
#ifndef FBD_APPS_FMU_H
#define FBD_APPS_FMU_H

#include "options.h"

/* Write the FMU of the model to options->fmu. */
enum exit_code write_fmu(const fbd_model *model, const struct options *options, fbd_errors *errors);

/* False, with a message, where this program was built without. */
bool fmu_can_be_made(const struct command_line *line);

/* Read the version of FMI that is asked for, 2 or 3; false, with a message, for another text. */
bool fmu_take_version(const struct command_line *line, const char *text, int *version);

/* The binary of an FMU, embedded in this program; NULL when it was built without. */
const char *fmu_binary(size_t *length);

#endif
