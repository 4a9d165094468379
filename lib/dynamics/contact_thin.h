/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Thin meetings: two bars, or a point and a bar. Each corner has a side of the other's bar, which is part of the state,
 * and a gap: the larger one of its distances from the bar's line, positive on that side, and from the circle that has the
 * bar as its diameter. It has a sign wherever the corner is. The side changes where the corner comes into the circle
 * from the other side, round an end.
 */
#ifndef FBD_DYNAMICS_CONTACT_THIN_H
#define FBD_DYNAMICS_CONTACT_THIN_H

#include "dynamics/contact.h"

/* As meeting_probe() and meeting_touching(). */
struct gap thin_probe(const struct fbd_model *model, const struct instant *at, int index, int probe);
int thin_touching(const struct fbd_model *model, const struct tree_work *work, int index, double near,
                  int features[2]);

/* The side, +1 to the left of the bar's direction and -1 to its right, on which the corner of a probe is. */
int *thin_side_of(const struct fbd_model *model, const struct tree_work *work, int index, int probe);

/* Where the middle of the corner's shape lies, on the left of the bar: a point has no other middle, 0. */
double thin_middle(const struct fbd_model *model, const struct tree_work *work, int index, int probe);

/* Set the sides on which a motion starts (contact_sides.c); `near` is what counts as touching there. Contacts that have
 * not started are open. */
void thin_choose_sides(struct fbd_state *state, int index, double near);

#endif
