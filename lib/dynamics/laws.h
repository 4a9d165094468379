/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Force laws that act at a point: the force on the body, and its variation when the point's position and
 * velocity vary.
 */
#ifndef FBD_DYNAMICS_LAWS_H
#define FBD_DYNAMICS_LAWS_H

#include "dynamics/kinematics.h"

/* Spring and damper from the body's point p to a fixed anchor A, with d = p - A, l = |d|, u = d / l:
 *
 *     f = -(k (l - l0) + c l') u,    l' = u . p'
 *
 * A spring of zero free length pulls with -k d, also at l = 0, where a damper has no direction and no force.
 */
struct link_law {
    struct vec anchor;
    double stiffness, free_length, damping;
};

static inline struct vec link_force(const struct link_law *law, struct motion_of_point at)
{
    struct vec d = vec_sub(at.p, law->anchor);
    double length = vec_norm(d);
    if (length == 0) return (struct vec){0, 0};
    double tension = law->stiffness * (length - law->free_length);
    if (law->damping != 0) tension += law->damping * (vec_dot(d, at.v) / length);
    return vec_scale(-tension / length, d);
}

struct vec link_variation(const struct link_law *law, struct motion_of_point at, struct motion_of_point d);

/* Actuator between two points that pulls with F on the line of its points, d from the second to the first: on the first
 * f = -F d/l. At l = 0 it has no direction; a run ends there (`zero_distance` of struct load). */
static inline struct vec pull_force(double F, struct vec d)
{
    return vec_scale(-F / vec_norm(d), d);
}

struct vec pull_variation(double F, double dF, struct vec d, struct vec dd);

/* The same in direction e of the other body, whose frame is turned by `turn`: F is along e. */
static inline struct vec guided_force(double F, struct vec turn, struct vec e)
{
    return vec_scale(F, vec_turn(turn, e));
}

/* Drag against the velocity v of the point: f = -(c + k |v|) v. */
struct drag_law {
    double linear, quadratic;
};

static inline struct vec drag_force(const struct drag_law *law, struct vec v)
{
    return vec_scale(-(law->linear + law->quadratic * vec_norm(v)), v);
}

struct vec drag_variation(const struct drag_law *law, struct vec v, struct vec dv);

#endif
