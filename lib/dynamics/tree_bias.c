/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The accelerations of the links for zero joint accelerations, and the wrench of each for that motion. With P
 * the parent, w the velocity in the joint (R e q' of a slide), and r from O to the centre of mass:
 *
 *     alpha = alpha_P,  a = a_P + alpha_P k x d - omega_P^2 d + 2 omega_P k x w
 *     force = m a + alpha k x m r - omega^2 m r,   moment about O = m r x a + I_O alpha
 *
 * A sticking joint also has the acceleration of its surface, and on a track of curvature kappa
 *
 *     a += kappa q'^2 k x e,   alpha += kappa' q'^2  if the body turns.
 */
#include "dynamics/tree.h"

/* The velocity in the joint, in the world. */
static struct vec joint_velocity(const struct tree_link *link, const struct tree_state *s, const double *v)
{
    if (link->kind == motion_slide || link->kind == motion_track) return vec_scale(v[0], s->e);
    if (link->kind == motion_pivot) return (struct vec){0, 0};
    return vec_turn(s->e, (struct vec){v[0], v[1]}); /* e is the x axis of the body that it moves on */
}

static void hold(const struct tree_link *link, struct tree_state *s)
{
    if (link->kind == motion_pivot)
        s->A.alpha += s->held;
    else
        s->A.a = vec_add(s->A.a, vec_scale(s->held, s->e));
    if (link->kind == motion_track) s->A.alpha += s->held * s->turning;
}

static void bend(const struct tree_link *link, struct tree_state *s, double v)
{
    s->A.a = vec_add(s->A.a, vec_turning(s->bend * v * v, s->e));
    if (link->track->turns) s->A.alpha += s->slope * v * v;
}

static void bend_along(const struct tree_link *link, const struct instant *at, const struct direction *along,
                       int n, const struct tree_state *s, struct tree_variation *d)
{
    double dq = along->dy[link->coordinate], v = at->y[n + link->coordinate],
           dv = along->dy[n + link->coordinate];
    double d_bend = s->slope * dq * v * v + 2 * s->bend * v * dv;
    d->A.a = vec_add(d->A.a, vec_add(vec_turning(d_bend, s->e), vec_turning(s->bend * v * v, d->e)));
    if (!link->track->turns) return;
    const int *piece = link->track->piece.expr ? formula_branches(&link->track->piece, at) : NULL;
    double rate = curve_slope_rate(link->track->curve, piece, at->y[link->coordinate]);
    d->A.alpha += rate * dq * v * v + 2 * s->slope * v * dv;
}

static inline __attribute__((always_inline)) void bias(const struct tree *tree, const struct instant *at,
                                                       int n, bool curved)
{
    struct tree_state *links = at->tree->links;
    struct tree_rhs *x = at->tree->x;
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        struct tree_state *s = &links[i], *parent = &links[link->parent];
        double w2 = parent->omega * parent->omega;
        s->A = acceleration_at(parent->A, s->d);
        s->A.a.x -= w2 * s->d.x;
        s->A.a.y -= w2 * s->d.y;
        if (link->kind != motion_pivot) {
            struct vec w = joint_velocity(link, s, at->y + n + link->coordinate);
            s->A.a = vec_add(s->A.a, vec_turning(2 * parent->omega, w));
        }
        if (curved && link->track) bend(link, s, at->y[n + link->coordinate]);
        if (s->locked) hold(link, s);
        double own = s->omega * s->omega, alpha = s->A.alpha, m = s->mass;
        x[i].p.force.x = m * s->A.a.x - alpha * s->mr.y - own * s->mr.x - link->force.x;
        x[i].p.force.y = m * s->A.a.y + alpha * s->mr.x - own * s->mr.y - link->force.y;
        x[i].p.moment =
            vec_cross(s->mr, s->A.a) + s->I_O * alpha - link->sine * s->turn.y - link->cosine * s->turn.x;
    }
}

void tree_bias(const struct tree *tree, const struct instant *at, int n)
{
    if (tree->general)
        bias(tree, at, n, true);
    else
        bias(tree, at, n, false);
}

/* The variation of the velocity in the joint. */
static struct vec joint_velocity_along(const struct tree_link *link, const struct tree_state *s,
                                       const struct tree_variation *d, const double *v, const double *dv)
{
    if (joint_freedom(link->kind) == 1) return vec_add(vec_scale(dv[0], s->e), vec_scale(v[0], d->e));
    struct vec own = vec_turn(s->e, (struct vec){dv[0], dv[1]});
    return vec_add(own, vec_turn(d->e, (struct vec){v[0], v[1]}));
}

/* The term of the joint acceleration due to the variation of its direction. */
static struct vec joint_acceleration_along(const struct tree_link *link, const struct tree_variation *d,
                                           const double *a)
{
    if (joint_freedom(link->kind) == 1) return vec_scale(a[0], d->e);
    return vec_turn(d->e, (struct vec){a[0], a[1]});
}

void tree_bias_along(const struct tree *tree, const struct instant *at, const struct direction *along, int n,
                     const double *a)
{
    const struct tree_state *links = at->tree->links;
    struct tree_variation *variation = at->tree->variation;
    struct tree_rhs *x = at->tree->x;
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        const struct tree_state *s = &links[i], *parent = &links[link->parent];
        const struct tree_variation *dp = &variation[link->parent];
        struct tree_variation *d = &variation[i];
        double omega = parent->omega;
        d->A = acceleration_at(dp->A, s->d);
        d->A.a = vec_add(d->A.a, vec_turning(parent->A.alpha, d->d));
        d->A.a = vec_sub(d->A.a, vec_scale(omega * omega, d->d));
        d->A.a = vec_sub(d->A.a, vec_scale(2 * omega * dp->omega, s->d));
        if (link->kind != motion_pivot) {
            const double *v = at->y + n + link->coordinate, *dv = along->dy + n + link->coordinate;
            struct vec w = joint_velocity(link, s, v), dw = joint_velocity_along(link, s, d, v, dv);
            d->A.a = vec_add(d->A.a, vec_add(vec_turning(2 * dp->omega, w), vec_turning(2 * omega, dw)));
            d->A.a = vec_add(d->A.a, joint_acceleration_along(link, d, a + link->coordinate));
        }
        if (link->track) {
            d->A.alpha += a[link->coordinate] * d->turning;
            bend_along(link, at, along, n, s, d);
        }
        if (s->locked && link->kind == motion_pivot) d->A.alpha += d->held;
        if (s->locked && link->kind != motion_pivot) d->A.a = vec_add(d->A.a, vec_scale(d->held, s->e));
        if (s->locked && link->track) d->A.alpha += d->held * s->turning;
        struct vec dmr = vec_turning(d->angle, s->mr), f = vec_scale(s->mass, d->A.a);
        f = vec_add(f, vec_add(vec_turning(d->A.alpha, s->mr), vec_turning(s->A.alpha, dmr)));
        f = vec_sub(f, vec_scale(2 * s->omega * d->omega, s->mr));
        x[i].p.force = vec_sub(f, vec_scale(s->omega * s->omega, dmr));
        x[i].p.moment = vec_cross(dmr, s->A.a) + vec_cross(s->mr, d->A.a) + s->I_O * d->A.alpha -
                        (link->sine * s->turn.x - link->cosine * s->turn.y) * d->angle;
    }
}
