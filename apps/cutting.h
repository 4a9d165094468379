/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd-run --cut: section forces of a body.
 */
#ifndef FBD_APPS_CUTTING_H
#define FBD_APPS_CUTTING_H

#include "options.h"

/* Write the section forces of the body of --cut at a state, which is at rest with --static. */
enum exit_code cutting(const struct options *options, fbd_state *state, fbd_errors *errors);

#endif
