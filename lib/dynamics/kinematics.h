/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where the points of a body are and how they move, and how both vary with the coordinates.
 *
 *   slide      p = origin + x e + R(along) r            p' = v e
 *   pivot      p = O + R(theta) (r - pin)               p' = omega k x (p - O)
 *   particle   p = (x, y) + r                           p' = (vx, vy)
 *   planar     p = (x, y) + R(theta) r                  p' = (vx, vy) + omega k x R(theta) r
 */
#ifndef FBD_DYNAMICS_KINEMATICS_H
#define FBD_DYNAMICS_KINEMATICS_H

#include "dynamics/instant.h"

struct pose {
    struct vec origin;   /* of the body frame in the world; for a pivot the axis O */
    struct vec rotation; /* cosine and sine of the angle of the body frame */
    struct vec velocity; /* of the origin */
    double omega;
};

struct motion_of_point {
    struct vec p, v; /* position and velocity in the world */
};

struct pose body_pose(const struct model_body *body, const struct instant *at);

/* The same where cosine and sine of the body's angle are known already; what cannot turn ignores them. */
struct pose body_pose_turned(const struct model_body *body, const struct instant *at, struct vec cos_sin);

struct motion_of_point point_motion(const struct model_body *body, const struct pose *pose, struct vec point);

/* How position and velocity of the point vary along a direction. */
struct motion_of_point point_variation(const struct model_body *body, const struct pose *pose,
                                       struct vec point, const struct direction *along);

/* The angle of the body frame in the world [rad], and its index as a coordinate or -1 when it cannot turn. */
double body_angle(const struct model_body *body, const struct instant *at);
int body_angle_coordinate(const struct model_body *body);

#endif
