/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Positions and velocities of points of a body, and their variation with the coordinates.
 *
 *   slide      p = origin + x e + R(along) r            p' = v e
 *   pivot      p = O + R(theta) (r - pin)               p' = omega k x (p - O)
 *   particle   p = (x, y) + r                           p' = (vx, vy)
 *   planar     p = (x, y) + R(theta) r                  p' = (vx, vy) + omega k x R(theta) r
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

/* The same, given cosine and sine of the body's angle; ignored for bodies that cannot turn. */
static inline struct pose body_pose_turned(const struct model_body *body, const struct instant *at,
                                           struct vec cos_sin)
{
    const double *q = at->y + body->first, *v = at->y + body->first_rate;
    switch (body->kind) {
    case motion_slide:
        return (struct pose){vec_add(body->origin, vec_scale(q[0], body->e)), body->e,
                             vec_scale(v[0], body->e), 0};
    case motion_pivot: return (struct pose){body->origin, vec_without_rounding(cos_sin), {0, 0}, v[0]};
    case motion_particle: return (struct pose){{q[0], q[1]}, {1, 0}, {v[0], v[1]}, 0};
    case motion_planar:
    case motion_weld:
    case motion_track: break; /* the last two are jointed */
    }
    return (struct pose){{q[0], q[1]}, vec_without_rounding(cos_sin), {v[0], v[1]}, v[2]};
}

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
/* The variation of position and velocity of the point along a direction. */
struct motion_of_point point_variation(const struct model_body *body, const struct pose *pose,
                                       struct vec point, const struct direction *along);

/* The angle of the body frame in the world [rad], and its index as a coordinate or -1 when it cannot turn. */
double body_angle(const struct model_body *body, const struct instant *at);
int body_angle_coordinate(const struct model_body *body);

#endif
