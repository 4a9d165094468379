/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Positions and velocities of points of a body: p = O + R r, p' = v_O + omega k x R r, r from the origin of the body
 * frame, or from the axis.
 *
 * The pose of a body is that of its link, valid after accelerations() or tree_move() at the same instant.
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

/* From the frame's origin (or the axis) to a point of the body, in the world. */
static inline struct vec point_arm(const struct model_body *body, const struct pose *pose, struct vec point)
{
    return vec_turn(pose->rotation, vec_sub(point, body->pin));
}

static inline struct motion_of_point point_motion(const struct model_body *body, const struct pose *pose,
                                                  struct vec point)
{
    struct vec arm = point_arm(body, pose, point);
    return (struct motion_of_point){vec_add(pose->origin, arm),
                                    vec_add(pose->velocity, vec_scale(pose->omega, vec_perp(arm)))};
}

/* The angle of the body frame in the world [rad]. */
double body_angle(const struct model_body *body, const struct instant *at);

#endif
