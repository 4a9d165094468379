/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Do the forces of the diagrams add up to the motion: m a = sum of f, I alpha = sum of M of each body?
 *
 * The right-hand side and the diagrams are two ways through the same mechanics. Where they differ, or where
 * modes were decided that no forces agree with, the motion is not that of the scene: a wrong number that
 * looks like any other. So every run is held to it where it is looked at.
 */
#ifndef FBD_REST_BALANCE_H
#define FBD_REST_BALANCE_H

#include "base/text.h"
#include "dynamics/diagram.h"
#include "dynamics/state.h"

/* Say of the body that is farthest off which equation does not hold at the evaluated state, by how much, and
 * what rounding explains. False, with nothing added to `lack`, when all hold; without memory
 * true, and `lack` has failed. `arrows` is scratch:
 * diagram_most_arrows. */
bool balance_lack(struct fbd_state *state, struct arrow *arrows, struct text *lack);

/* The accelerations that the forces on a body would give it if none met another: the largest of all bodies, at the
 * evaluated state. Those that balance leave some roundings of it. */
double balance_size(const struct fbd_state *state, struct arrow *arrows);

#endif
