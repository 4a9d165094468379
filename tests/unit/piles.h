/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Piles of boxes and discs on a floor, looked at without the library: how far shapes are apart, where they touch, and
 * the laws of what touches.
 */
#ifndef FBD_TESTS_PILES_H
#define FBD_TESTS_PILES_H

#include <stdbool.h>

#include "base/vec.h"

enum { most_bodies = 12, most_touches = 60, floor_of_pile = -1 };

struct pile {
    int count;
    bool disc[most_bodies];
    double a[most_bodies], b[most_bodies], mass[most_bodies]; /* sides; the diameter of a disc */
    double slope, mu, e;
};

/* Places, angles and their rates. */
struct pile_motion {
    double q[most_bodies][3], v[most_bodies][3];
};

/* A disc, or a rectangle with its corners counter-clockwise. */
struct pile_shape {
    bool disc;
    struct vec center, corner[4];
    double radius;
};

/* The floor is the upper side of a slab. */
struct pile_shape pile_shape_of(const struct pile *pile, int body, const struct pile_motion *motion);

/* Below zero by the least way that would take them apart. */
double pile_apart(const struct pile_shape *A, const struct pile_shape *B);

/* Where two shapes touch. `point`: the corners, middles or material points between which the gap is measured. */
struct pile_touch {
    int body[2];
    struct vec at, normal; /* from body 1 to body 0 */
    struct vec point[2];
    double length; /* between the points where they turn about each other, 0 where body 1 has a side */
};

/* All of them; -1 where two corners meet, and it is open which side they are on. */
int pile_find_touches(const struct pile *pile, const struct pile_motion *motion, struct pile_touch *touches);

/* The forces at a touch on body 0. */
struct pile_force {
    double N, T;
};

/* What the laws of contact and friction say of accelerations and forces: by how much they are broken at worst [m/s^2 and
 * N/kg]. */
double pile_law_error(const struct pile *pile, const struct pile_motion *motion, const double a[][3],
                      const struct pile_touch *touches, int count, const struct pile_force *forces);

enum pile_verdict {
    pile_agrees,     /* the accelerations are those of a set of modes that the laws allow */
    pile_differs,    /* no set of modes has them */
    pile_undecided,  /* they are those of modes whose forces are open, and may be within the limits */
    pile_not_looked, /* too many modes, or something strikes just then */
};

/* All modes of the touches of what hangs together with body `first`, one after the other: each is open, sticks, or slips
 * one way or the other. At most four touches, with two holds each. `solutions`: how many different accelerations
 * there are. */
enum pile_verdict pile_try_modes(const struct pile *pile, const struct pile_motion *motion,
                                 const double a[][3], const struct pile_touch *touches, int count, int first,
                                 int *solutions);

#endif
