/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Does a state fit the couplings of its scene?
 */
#ifndef FBD_REST_FIT_H
#define FBD_REST_FIT_H

#include "base/diag.h"
#include "base/text.h"
#include "dynamics/state.h"

/* Say what a state lacks to fit: by how much a coupling is off, and the nearest state that fits, which
 * `other` becomes. *at (may be NULL) is the coupling's place in the file. False, with nothing added to
 * `lack`, when it fits to six digits, as many as files have. */
bool fit_lack(struct fbd_state *state, struct fbd_state *other, struct pos *at, struct text *lack);

/* Report a rope that has no path: an end lies within the rim of the pulley that it runs round, or a piece of it has no
 * length. */
bool fit_blocked(struct fbd_state *state, struct pos *at, struct text *lack);

/* tree.mass_ratio beyond which a coupling that is missed is blamed on the masses, and one beyond which rounding of forces leaves
 * too little of accelerations. */
static const double masses_far_apart = 1e10, masses_too_far_apart = 1e12;

/* Do the accelerations of a state, which is evaluated here, miss the couplings by more than rounding? Then no finite forces
 * hold a mechanism in its position, or, with `masses`, the masses are too far apart (a pulley of a milligram between weights
 * of kilograms) for the forces to be told; `lack` gets a sentence, and *at (may be NULL) the coupling's place in the file. */
bool fit_unsolved(struct fbd_state *state, bool *masses, struct pos *at, struct text *lack);

/* Is a settled state at rest where its couplings have no slope, and set out on a way that they do not allow?
 */
bool fit_locked(const struct fbd_state *state, struct fbd_state *other, struct pos *at, struct text *lack);

#endif
