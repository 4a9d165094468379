/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Thin contact pairs: two bars, or a point and a bar. Each corner has a side of the other's bar, which is
 * part of the state, and a gap: the larger one of its distances from the bar's line, positive on that side,
 * and from the circle that has the bar as its diameter. The gap has a sign at every position of the corner.
 * Outside of the circle, and at the end face of the bar, there is no side (0), and the gap is that from the
 * circle; as the corner enters the circle it gets a side, or touches the end face.
 */
#ifndef FBD_DYNAMICS_CONTACT_THIN_H
#define FBD_DYNAMICS_CONTACT_THIN_H

#include "dynamics/contact.h"

/* As meeting_probe() and meeting_touching(). */
struct gap thin_probe(const struct fbd_model *model, const struct instant *at, int index, int probe);
int thin_touching(const struct fbd_model *model, const struct tree_work *work, int index, double near,
                  int features[2]);

/* The depth by which two bars cross; else 0. */
double thin_crossing(const struct fbd_model *model, const struct tree_work *work, int index);

/* The side of the corner of a probe: +1 to the left of the bar's direction, -1 to its right, 0 none. */
int *thin_side_of(const struct fbd_model *model, const struct tree_work *work, int index, int probe);

/* The distance of the middle of the corner's shape from the bar, positive on its left; 0 for a point. */
double thin_middle(const struct fbd_model *model, const struct tree_work *work, int index, int probe);

/* Is the corner at an end of the bar, and does its own bar lie beyond that end on the same line? */
bool thin_is_in_line(const struct fbd_model *model, const struct tree_work *work, int index, int probe,
                     double near);

/* Set the sides at the start of a motion (contact_sides.c); `near` is the touching distance. Contacts that
 * have not started are open. */
void thin_choose_sides(struct fbd_state *state, int index, double near);

/* Does a corner start exactly on the bar and move to the side from which its forces pull it? The state is evaluated. */
bool thin_moves_against_forces(struct fbd_state *state, int index, double near);

#endif
