/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Positions and velocities of the links. With P the parent, R its rotation:
 *
 *     pivot   d = R at,           omega = omega_P + q',  v = v_P + omega_P k x d
 *     slide   d = R (at + q e),   omega = omega_P,       v = v_P + omega_P k x d + q' R e
 *     track   d = R (at + r(q)),  omega = omega_P + kappa q' if it turns,  v = v_P + omega_P k x d + q' R e(q)
 *     free    d = R (at + x e + y k x e) likewise, with an angular velocity of its own when it is planar
 *
 * e is given in the frame of the parent's link: a body that is welded to it at an angle has other axes.
 */
#include "base/sine.h"
#include "dynamics/tree.h"

/* For the joint's own coordinates. */
struct joint {
    const double *q, *v;
};

static void move_slide(const struct tree_link *link, const struct tree_state *parent, struct joint joint,
                       struct tree_state *s)
{
    s->angle = parent->angle + link->along;
    s->omega = parent->omega;
    s->turn = vec_turn(parent->turn, link->tilt);
    s->e = vec_turn(parent->turn, link->e);
    s->d = vec_add(vec_turn(parent->turn, link->at), vec_scale(joint.q[0], s->e));
    s->v = vec_scale(joint.v[0], s->e);
}

static const int *piece_of(const struct tree_link *link, const struct instant *at)
{
    return link->track->piece.expr ? formula_branches(&link->track->piece, at) : NULL;
}

static void move_track(const struct tree_link *link, const struct tree_state *parent,
                       const struct instant *at, struct joint joint, struct tree_state *s)
{
    struct curve_place place = curve_at(link->track->curve, piece_of(link, at), joint.q[0]);
    struct vec frame = vec_turn(parent->turn, link->e);
    s->e = vec_turn(frame, place.e);
    s->bend = place.bend;
    s->slope = place.slope;
    s->turning = link->track->turns ? place.bend : 0;
    s->angle = parent->angle + link->along + (link->track->turns ? place.angle : 0);
    s->omega = parent->omega + s->turning * joint.v[0];
    s->turn = link->track->turns ? s->e : frame;
    s->d = vec_add(vec_turn(parent->turn, link->at), vec_turn(frame, place.r));
    s->v = vec_scale(joint.v[0], s->e);
}

static void move_free(const struct tree_link *link, const struct tree_state *parent, struct joint joint,
                      struct tree_state *s)
{
    bool turns = link->kind == motion_planar;
    struct vec own = {joint.q[0], joint.q[1]}, rate = {joint.v[0], joint.v[1]};
    s->angle = parent->angle + link->along + (turns ? joint.q[2] : 0);
    s->omega = parent->omega + (turns ? joint.v[2] : 0);
    s->turn = unit_by_sine(s->angle);
    s->e = vec_turn(parent->turn, link->e);
    s->d = vec_turn(parent->turn, vec_add(link->at, vec_turn(link->e, own)));
    s->v = vec_turn(s->e, rate);
}

static inline __attribute__((always_inline)) void
move_links(const struct fbd_model *model, const struct instant *at, bool curved, const struct vec *turns)
{
    const struct tree *tree = model->tree;
    int n = model->plan.n;
    struct tree_state *links = at->tree->links;
    links[0].turn = (struct vec){1, 0};
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        const struct tree_state *parent = &links[link->parent];
        struct tree_state *s = &links[i];
        struct joint joint = {at->y + link->coordinate, at->y + n + link->coordinate};
        if (link->kind == motion_pivot) {
            s->angle = parent->angle + link->along + joint.q[0];
            s->omega = parent->omega + joint.v[0];
            s->turn = turns ? turns[i] : unit_by_sine(s->angle);
            s->d = vec_turn(parent->turn, link->at);
            s->v = (struct vec){0, 0};
        } else if (link->kind == motion_slide) {
            move_slide(link, parent, joint, s);
        } else if (curved && link->kind == motion_track) {
            move_track(link, parent, at, joint, s);
        } else {
            move_free(link, parent, joint, s);
        }
        s->p = vec_add(parent->p, s->d);
        s->v = vec_add(s->v, vec_add(parent->v, vec_scale(parent->omega, vec_perp(s->d))));
        s->mr = vec_turn(s->turn, link->moment);
    }
}

void tree_move_joined(const struct fbd_model *model, const struct instant *at)
{
    if (model->tree->general)
        move_links(model, at, true, NULL);
    else
        move_links(model, at, false, NULL);
    if (model->tree->bulk_count > 0) tree_weigh(model->tree, at);
}

void tree_move(const struct fbd_model *model, const struct instant *at)
{
    if (tree_joins(model->tree)) tree_move_joined(model, at);
    tree_move_alone(model, at);
}

void tree_move_turned(const struct fbd_model *model, const struct instant *at, const struct vec *turns)
{
    move_links(model, at, false, turns);
}

void tree_move_along(const struct fbd_model *model, const struct instant *at, const struct direction *along)
{
    const struct tree *tree = model->tree;
    int n = model->plan.n;
    const struct tree_state *links = at->tree->links;
    struct tree_variation *variation = at->tree->variation;
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        const struct tree_state *s = &links[i], *parent = &links[link->parent];
        const struct tree_variation *dp = &variation[link->parent];
        struct tree_variation *d = &variation[i];
        const double *v = at->y + n + link->coordinate;
        const double *dq = along->dy + link->coordinate, *dv = dq + n;
        d->angle = dp->angle;
        d->omega = dp->omega;
        d->d = vec_turning(dp->angle, s->d);
        d->e = (struct vec){0, 0};
        struct vec own = {0, 0}; /* of the velocity relative to the parent */
        if (link->kind == motion_pivot) {
            d->angle += dq[0];
            d->omega += dv[0];
        } else if (link->kind == motion_slide) {
            d->e = vec_turning(dp->angle, s->e);
            d->d = vec_add(d->d, vec_scale(dq[0], s->e));
            own = vec_add(vec_scale(v[0], d->e), vec_scale(dv[0], s->e));
        } else if (link->kind == motion_track) {
            d->e = vec_turning(dp->angle + s->bend * dq[0], s->e);
            d->turning = link->track->turns ? s->slope * dq[0] : 0;
            d->d = vec_add(d->d, vec_scale(dq[0], s->e));
            d->angle += s->turning * dq[0];
            d->omega += s->turning * dv[0] + d->turning * v[0];
            own = vec_add(vec_scale(v[0], d->e), vec_scale(dv[0], s->e));
        } else {
            d->e = vec_turning(dp->angle, s->e);
            d->d = vec_add(d->d, vec_turn(s->e, (struct vec){dq[0], dq[1]}));
            struct vec w = vec_turn(s->e, (struct vec){v[0], v[1]});
            own = vec_add(vec_turning(dp->angle, w), vec_turn(s->e, (struct vec){dv[0], dv[1]}));
            if (link->kind == motion_planar) {
                d->angle += dq[2];
                d->omega += dv[2];
            }
        }
        d->p = vec_add(dp->p, d->d);
        d->v = vec_add(vec_add(dp->v, own),
                       vec_add(vec_turning(dp->omega, s->d), vec_turning(parent->omega, d->d)));
    }
}
