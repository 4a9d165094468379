/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Chains of tree_bare.h for which a closed form is faster than a recursion: the double pendulum, three links,
 * the cart with a pole. s[i].g is the force in the joint of link i; y, v and a are the coordinates of the
 * scene.
 */
#ifndef FBD_DYNAMICS_TREE_SHORT_H
#define FBD_DYNAMICS_TREE_SHORT_H

#include "dynamics/tree_bare.h"

/* The closed form of a chain. */
static inline enum tree_form tree_form_of(const struct tree_link *links, int count)
{
    if (count == 2) return links->kind == motion_slide ? tree_form_pole : tree_form_two_pivots;
    return count == 3 && links->kind == motion_pivot ? tree_form_three_pivots : tree_form_none;
}

/* A pole on a slide of the ground. With e the direction of the slide and h as in tree_short.c, h . e = P cos + Q sin and
 * h x e = Q cos - P sin of the angle of the pole. */
struct tree_pole {
    int x, q;
    double along, P, Q, sine, cosine, D, mass, force;
};

struct tree_pole tree_pole_of(const struct tree_link *links);
void tree_pole(const struct tree_pole *pole, double force, double moment, const double *y, const double *v,
               double *a);
void tree_two_pivots(const struct tree_link *links, const struct tree_bare *s, const double *y,
                     const double *v, double *a);
void tree_three_pivots(const struct tree_link *links, const struct tree_bare *s, const double *y,
                       const double *v, double *a);

#endif
