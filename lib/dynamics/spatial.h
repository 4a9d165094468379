/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Planar spatial algebra by value: wrenches, accelerations and inertias about a reference point O, with all
 * components in the world (Featherstone, Rigid Body Dynamics Algorithms, chapter 2, in the plane).
 *
 * A wrench is a force and its moment about O. An acceleration is that of the point of the body at O, and the
 * angular one. The inertia relates the two:
 *
 *     moment = J alpha + h . a,    force = h alpha + M a
 *
 * For a rigid body of mass m whose centre of mass is at r from O: J = I_O, h = m k x r, M = m.
 */
#ifndef FBD_DYNAMICS_SPATIAL_H
#define FBD_DYNAMICS_SPATIAL_H

#include "base/vec.h"

struct wrench {
    double moment;
    struct vec force;
};

struct acceleration {
    double alpha;
    struct vec a;
};

struct inertia_about_O {
    double J;
    struct vec h;
    double xx, xy, yy; /* M */
};

static inline struct vec inertia_times(const struct inertia_about_O *I, struct vec a)
{
    return (struct vec){I->xx * a.x + I->xy * a.y, I->xy * a.x + I->yy * a.y};
}

/* I A + p. */
static inline struct wrench inertia_wrench(const struct inertia_about_O *I, struct acceleration A,
                                           struct wrench p)
{
    struct vec Ma = inertia_times(I, A.a);
    return (struct wrench){I->J * A.alpha + vec_dot(I->h, A.a) + p.moment,
                           {I->h.x * A.alpha + Ma.x + p.force.x, I->h.y * A.alpha + Ma.y + p.force.y}};
}

/* Add `wrench`, taken about a point at d from O, to `sum`, taken about O. */
static inline void wrench_add(struct wrench *sum, struct wrench wrench, struct vec d)
{
    sum->moment += wrench.moment + vec_cross(d, wrench.force);
    sum->force = vec_add(sum->force, wrench.force);
}

/* Add an inertia about a point at d from O: with u = k x d,
 * M' = M, h' = h + M u, J' = J + 2 h . u + u . M u. */
static inline void inertia_add(struct inertia_about_O *sum, const struct inertia_about_O *I, struct vec d)
{
    struct vec u = vec_perp(d), h = vec_add(I->h, inertia_times(I, u));
    sum->J += I->J + vec_dot(u, vec_add(I->h, h));
    sum->h = vec_add(sum->h, h);
    sum->xx += I->xx;
    sum->xy += I->xy;
    sum->yy += I->yy;
}

/* The acceleration of a point at d from O, without the centripetal term. */
static inline struct acceleration acceleration_at(struct acceleration A, struct vec d)
{
    return (struct acceleration){A.alpha, {A.a.x - A.alpha * d.y, A.a.y + A.alpha * d.x}};
}

#endif
