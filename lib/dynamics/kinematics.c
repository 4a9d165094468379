/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/kinematics.h"

#include "dynamics/tree.h"

/* From its link, as set by the last tree_move. */
struct pose body_pose(const struct model_body *body, const struct instant *at)
{
    const struct tree_state *link = &at->tree->links[body->place.link];
    if (body->kind != motion_weld) return (struct pose){link->p, link->turn, link->v, link->omega};
    struct vec arm = vec_turn(link->turn, body->place.shift);
    return (struct pose){vec_add(link->p, arm), vec_turn(link->turn, body->place.turn),
                         vec_add(link->v, vec_scale(link->omega, vec_perp(arm))), link->omega};
}

int body_angle_coordinate(const struct model_body *body)
{
    if (body->kind == motion_pivot) return body->first;
    return body->kind == motion_planar ? body->first + 2 : -1;
}

double body_angle(const struct model_body *body, const struct instant *at)
{
    return at->tree->links[body->place.link].angle + body->place.angle;
}

struct motion_of_point point_variation(const struct model_body *body, const struct pose *pose,
                                       struct vec point, const struct direction *along)
{
    const double *dq = along->dy + body->first, *dv = along->dy + body->first_rate;
    if (body->kind == motion_slide)
        return (struct motion_of_point){vec_scale(dq[0], body->e), vec_scale(dv[0], body->e)};
    if (body->kind == motion_particle) return (struct motion_of_point){{dq[0], dq[1]}, {dv[0], dv[1]}};
    /* d(R r) = dtheta k x R r; d(omega k x R r) = domega k x R r - omega dtheta R r */
    struct vec arm = point_arm(body, pose, point), across = vec_perp(arm);
    int turn = body->kind == motion_pivot ? 0 : 2;
    struct motion_of_point d = {vec_scale(dq[turn], across),
                                vec_sub(vec_scale(dv[turn], across), vec_scale(pose->omega * dq[turn], arm))};
    if (body->kind == motion_planar) {
        d.p = vec_add(d.p, (struct vec){dq[0], dq[1]});
        d.v = vec_add(d.v, (struct vec){dv[0], dv[1]});
    }
    return d;
}
