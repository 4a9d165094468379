/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ropes during the search for a position of rest: a slack rope becomes taut where it exceeds its length, a
 * taut one becomes slack where its tension would be negative.
 */
#ifndef FBD_REST_ROPES_H
#define FBD_REST_ROPES_H

#include "dynamics/state.h"

/* At an evaluated state: is a rope slack; and does one exceed its length? */
bool ropes_are_slack(const struct fbd_state *state);
bool ropes_are_too_long(const struct fbd_state *state);

/* Close ropes that exceed their length; open ropes with negative tension. True where there are such. The
 * state was evaluated before, and must be evaluated again. */
bool ropes_take_up(struct fbd_state *state);
bool ropes_let_go(struct fbd_state *state);

#endif
