/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/kinematics.h"

int body_angle_coordinate(const struct model_body *body)
{
    if (body->kind == motion_pivot) return body->first;
    return body->kind == motion_planar ? body->first + 2 : -1;
}

double body_angle(const struct model_body *body, const struct instant *at)
{
    int coordinate = body_angle_coordinate(body);
    if (coordinate >= 0) return at->y[coordinate];
    return body->kind == motion_slide ? body->source->motion.along : 0;
}

struct pose body_pose(const struct model_body *body, const struct instant *at)
{
    int turn = body_angle_coordinate(body);
    return body_pose_turned(body, at, turn >= 0 ? vec_cos_sin(at->y[turn]) : (struct vec){1, 0});
}

struct pose body_pose_turned(const struct model_body *body, const struct instant *at, struct vec cos_sin)
{
    const double *q = at->y + body->first, *v = at->y + body->first_rate;
    switch (body->kind) {
    case motion_slide:
        return (struct pose){vec_add(body->origin, vec_scale(q[0], body->e)), body->e,
                             vec_scale(v[0], body->e), 0};
    case motion_pivot: return (struct pose){body->origin, vec_without_rounding(cos_sin), {0, 0}, v[0]};
    case motion_particle: return (struct pose){{q[0], q[1]}, {1, 0}, {v[0], v[1]}, 0};
    case motion_planar: break;
    }
    return (struct pose){{q[0], q[1]}, vec_without_rounding(cos_sin), {v[0], v[1]}, v[2]};
}

static struct vec arm_of(const struct model_body *body, const struct pose *pose, struct vec point)
{
    return vec_turn(pose->rotation, vec_sub(point, body->pin));
}

struct motion_of_point point_motion(const struct model_body *body, const struct pose *pose, struct vec point)
{
    struct vec arm = arm_of(body, pose, point);
    return (struct motion_of_point){vec_add(pose->origin, arm),
                                    vec_add(pose->velocity, vec_scale(pose->omega, vec_perp(arm)))};
}

struct motion_of_point point_variation(const struct model_body *body, const struct pose *pose,
                                       struct vec point, const struct direction *along)
{
    const double *dq = along->dy + body->first, *dv = along->dy + body->first_rate;
    if (body->kind == motion_slide)
        return (struct motion_of_point){vec_scale(dq[0], body->e), vec_scale(dv[0], body->e)};
    if (body->kind == motion_particle) return (struct motion_of_point){{dq[0], dq[1]}, {dv[0], dv[1]}};
    /* d(R r) = dtheta k x R r; d(omega k x R r) = domega k x R r - omega dtheta R r */
    struct vec arm = arm_of(body, pose, point), across = vec_perp(arm);
    int turn = body->kind == motion_pivot ? 0 : 2;
    struct motion_of_point d = {vec_scale(dq[turn], across),
                                vec_sub(vec_scale(dv[turn], across), vec_scale(pose->omega * dq[turn], arm))};
    if (body->kind == motion_planar) {
        d.p = vec_add(d.p, (struct vec){dq[0], dq[1]});
        d.v = vec_add(d.v, (struct vec){dv[0], dv[1]});
    }
    return d;
}
