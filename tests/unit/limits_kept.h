/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What every state of a run has to keep, whatever the scene: friction that sticks bears no more than it can, and what
 * is closed presses, or pulls, the right way.
 */
#ifndef FBD_TESTS_LIMITS_KEPT_H
#define FBD_TESTS_LIMITS_KEPT_H

#include "fbd.h"

/* The first that is beyond its limit by more than rounding, as "name bears 2, up to 1"; NULL without one. The text
 * lives until the next call. */
const char *beyond_limits(fbd_state *state);

#endif
