/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Does a state fit the couplings of its scene?
 */
#ifndef FBD_SOLVE_FIT_H
#define FBD_SOLVE_FIT_H

#include "base/text.h"
#include "dynamics/state.h"

/* Say what a state lacks to fit: by how much a coupling is off, and the nearest state that fits, which
 * `other` becomes. False, with nothing added to `lack`, when it fits to six digits, as many as files have. */
bool fit_lack(struct fbd_state *state, struct fbd_state *other, struct text *lack);

#endif
