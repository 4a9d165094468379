/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/kinematics.h"

#include "dynamics/tree.h"

/* From its link, as set by the last tree_move. */
struct pose body_pose(const struct model_body *body, const struct instant *at)
{
    const struct tree_state *link = body_link(body, at);
    if (body->count > 0) return (struct pose){link->p, link->turn, link->v, link->omega};
    struct vec arm = vec_turn(link->turn, body->place.shift);
    return (struct pose){vec_add(link->p, arm), vec_turn(link->turn, body->place.turn),
                         vec_add(link->v, vec_scale(link->omega, vec_perp(arm))), link->omega};
}

double body_angle(const struct model_body *body, const struct instant *at)
{
    return body_link(body, at)->angle + body->place.angle;
}
