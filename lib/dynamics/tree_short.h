/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Chains of tree_bare.h that are so short that a closed form is less work than a recursion: the double pendulum, three
 * links, the cart with a pole. s[i].g is what acts in the joint of link i; y, v and a are the coordinates of the scene.
 */
#ifndef FBD_DYNAMICS_TREE_SHORT_H
#define FBD_DYNAMICS_TREE_SHORT_H

#include "dynamics/tree_bare.h"

void tree_pole(const struct tree_link *links, const struct tree_bare *s, const double *y, const double *v,
               double *a);
void tree_two_pivots(const struct tree_link *links, const struct tree_bare *s, const double *y,
                     const double *v, double *a);
void tree_three_pivots(const struct tree_link *links, const struct tree_bare *s, const double *y,
                       const double *v, double *a);

#endif
