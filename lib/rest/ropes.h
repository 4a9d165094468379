/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ropes on the way to a place of rest: one that is slack becomes taut where it is too long for its length, one that is
 * taut goes slack where it would have to push.
 */
#ifndef FBD_REST_ROPES_H
#define FBD_REST_ROPES_H

#include "dynamics/state.h"

/* At an evaluated state: is a rope slack; and is one of them too long? */
bool ropes_are_slack(const struct fbd_state *state);
bool ropes_are_too_long(const struct fbd_state *state);

/* Those that are too long become taut, those that would push go slack; true where there are such. The state has been
 * evaluated, and is to be again. */
bool ropes_take_up(struct fbd_state *state);
bool ropes_let_go(struct fbd_state *state);

#endif
