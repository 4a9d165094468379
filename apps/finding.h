/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd-run --find: the values of a parameter at which something changes; and --fit: parameters by measured data.
 */
#ifndef FBD_APPS_FINDING_H
#define FBD_APPS_FINDING_H

#include "options.h"

/* False, with a message, when --find or --fit is given with options that have no effect there. */
bool finding_agrees(const struct options *options, const struct command_line *line);

/* Search and print. Notes that `errors` has already are not repeated. */
enum exit_code finding(const fbd_model *model, const struct options *options, fbd_errors *errors);
enum exit_code fitting(const fbd_model *model, const struct options *options, fbd_errors *errors);

#endif
