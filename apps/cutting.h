/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd-run --cut: section forces of a body.
 */
#ifndef FBD_APPS_CUTTING_H
#define FBD_APPS_CUTTING_H

#include "options.h"

/* False, with a message, when --cut is given with options that have no effect there; `drawing`: those of --svg. */
bool cutting_agrees(const struct options *options, const struct command_line *line, bool drawing);

/* Write the section forces of the body of --cut at the state of --at: of the motion, which must be admissible, or with
 * --static at rest. */
enum exit_code cutting(const struct options *options, fbd_state *state, fbd_errors *errors);

#endif
