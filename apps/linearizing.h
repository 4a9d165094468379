/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd-run --linearize: the linear motion about an equilibrium, and transfer functions where the file has inputs.
 */
#ifndef FBD_APPS_LINEARIZING_H
#define FBD_APPS_LINEARIZING_H

#include "options.h"

/* Linearize near the state of --at, and write text, JSON, eigenvalues and frequency responses. */
enum exit_code linearizing(const struct options *options, fbd_state *state, fbd_errors *errors);

#endif
