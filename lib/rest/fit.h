/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Does a state satisfy the couplings of its scene?
 */
#ifndef FBD_REST_FIT_H
#define FBD_REST_FIT_H

#include "base/diag.h"
#include "base/text.h"
#include "dynamics/state.h"

/* Report how a state violates a coupling: by how much, and the nearest consistent state, which is stored in
 * `other`. *at (may be NULL) is the position of the coupling in the file. Returns false, with nothing added
 * to `lack`, when the couplings are satisfied to six digits, the precision of files. */
bool fit_lack(struct fbd_state *state, struct fbd_state *other, struct pos *at, struct text *lack);

/* Report a rope that has no path: an end lies inside the rim of its pulley, or a piece of it has no length. */
bool fit_blocked(struct fbd_state *state, struct pos *at, struct text *lack);

/* tree.mass_ratio beyond which a violated coupling is attributed to the masses, and one beyond which rounding
 * of forces makes accelerations useless. */
static const double masses_far_apart = 1e10, masses_too_far_apart = 1e12;

/* Do the accelerations of the state (evaluated here) violate the couplings by more than rounding? Then no
 * finite forces hold the mechanism in its position, or, with `masses`, the mass ratio is too large (a pulley
 * of a milligram between weights of kilograms) to compute the forces. `lack` gets a sentence, and *at (may be
 * NULL) the position of the coupling in the file. */
bool fit_unsolved(struct fbd_state *state, bool *masses, struct pos *at, struct text *lack);

/* Is a settled state at rest where its couplings have no gradient, with accelerations that violate them? */
bool fit_locked(const struct fbd_state *state, struct fbd_state *other, struct pos *at, struct text *lack);

#endif
