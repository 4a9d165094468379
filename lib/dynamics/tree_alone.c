/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A link that stands alone, by the equations of tree_sweep.c with the ground as the parent, which is at rest: there
 * is nothing to pass on, and one function does all of its sweeps. With the wrench p of the velocities minus the
 * applied loads, g the force in the joint and u = g - S . p:
 *
 *     slide      q'' = u / m
 *     pivot      q'' = u / I_O
 *     particle   a_O = (g - p_f) / m
 *     planar     I_G alpha = u with the moment of p about G,  a_O = (g - p_f - alpha k x m r) / m
 *
 * Each has its own part of the lists of loads. All that the variation of accelerations and the diagrams read of a
 * link is set here as by the sweeps.
 */
#include "base/sine.h"
#include "dynamics/friction.h"
#include "dynamics/tree.h"

/* ---- the state of the link */

/* A slide and a particle do not turn, and their inertias are constant. */
void tree_begin_alone(const struct tree_link *link, struct tree_state *s)
{
    s->angle = link->along;
    s->turn = link->tilt;
    s->e = link->e;
    s->d = s->p = link->at;
    s->mr = vec_turn(s->turn, link->moment);
    s->I = (struct inertia_about_O){link->I_O, vec_perp(s->mr), link->mass, 0, link->mass};
    s->inverse[0] = s->inverse[2] = 1 / link->mass;
    s->inverse[1] = 0;
    s->U = vec_scale(1 / link->mass, s->I.h);
    switch (link->kind) {
    case motion_pivot: s->D = link->inverse_I_O; break;
    case motion_planar: s->D = 1 / link->I_G; break;
    case motion_slide:
        s->D = 1 / link->mass;
        s->U = vec_scale(link->mass, s->e);
        s->Uh = vec_dot(s->I.h, s->e);
        break;
    case motion_particle:
    case motion_weld:
    case motion_track: break;
    }
}

static void turn_to(const struct tree_link *link, double angle, double omega, struct tree_state *s)
{
    s->angle = angle;
    s->omega = omega;
    s->turn = unit_by_sine(angle);
    if (s->turn.y == 0 && fabs(angle) < 1) s->turn.y = angle; /* not the rounding of a turn */
    s->mr = vec_turn(s->turn, link->moment);
    s->I.h = vec_perp(s->mr);
    if (link->kind == motion_planar) s->U = vec_scale(s->inverse[0], s->I.h);
}

static inline void move(const struct tree_link *link, const double *q, const double *v, struct tree_state *s)
{
    if (link->kind == motion_pivot) {
        turn_to(link, q[0], v[0], s);
        return;
    }
    if (link->kind == motion_slide) {
        s->d = vec_add(link->at, vec_scale(q[0], s->e));
        s->v = vec_scale(v[0], s->e);
    } else {
        s->d = (struct vec){link->at.x + q[0], link->at.y + q[1]};
        s->v = (struct vec){v[0], v[1]};
        if (link->kind == motion_planar) turn_to(link, q[2], v[2], s);
    }
    s->p = s->d;
}

void tree_move_alone(const struct fbd_model *model, const struct instant *at)
{
    const struct tree *tree = model->tree;
    const double *q = at->y, *v = at->y + model->plan.n;
    for (int i = tree->joined; i < tree->count; i++) {
        const struct tree_link *link = &tree->links[i];
        move(link, q + link->coordinate, v + link->coordinate, &at->tree->links[i]);
    }
}

/* ---- forces */

/* The moment about O of a force in the centre of mass. */
static inline double moment_of(const struct tree_state *s, struct vec force)
{
    return vec_cross(s->mr, force) / s->mass;
}

/* A planar body turns about its centre of mass, with moments about it that are not differences. */
struct wrench tree_alone_weight(const struct tree_link *link, const struct tree_state *s)
{
    const struct vec force = {-link->force.x, -link->force.y};
    double moment = -link->sine * s->turn.y - link->cosine * s->turn.x;
    if (link->kind == motion_planar) moment += moment_of(s, force);
    return (struct wrench){moment, force};
}

/* With the acceleration of a surface to which it sticks, and its wrench. */
static void lock(const struct fbd_model *model, const struct instant *at, const struct tree_link *link,
                 struct tree_state *s, struct wrench *p)
{
    s->locked = at->slip[link->pair] == stick;
    if (!s->locked) return;
    friction_surface_speed(&model->plan.modes[link->pair], at, &s->held);
    s->A = link->kind == motion_pivot ? (struct acceleration){s->held, {0, 0}}
                                      : (struct acceleration){0, vec_scale(s->held, s->e)};
    *p = inertia_wrench(&s->I, s->A, *p);
}

void tree_alone_slots(const struct fbd_model *model, const struct instant *at, int i, double *slots)
{
    const struct tree_link *link = &model->tree->links[i];
    const struct tree_state *s = &at->tree->links[i];
    const struct wrench p = at->tree->x[i].p;
    if (link->normal_slot >= 0)
        slots[link->normal_slot] = -vec_dot(tree_normal(model->tree, at->tree, i), p.force);
    if (link->pair < 0) return;
    const struct mode *mode = &model->plan.modes[link->pair];
    double inertial = s->locked ? mode->inertia * s->held : 0; /* part of the wrench of a locked joint */
    slots[mode->hold_slot] = slots[link->coordinate] - joint_share(link, s, p) + inertial;
}

/* Kinetic friction along the joint, in the direction e; the normal force is that of the applied forces. */
static double kinetic_friction(const struct fbd_model *model, const struct instant *at,
                               const struct tree_link *link, struct vec e, struct vec p)
{
    const int side = slip_side(at->slip[link->pair]);
    if (side == 0) return 0;
    const struct mode *mode = &model->plan.modes[link->pair];
    const double mu = formula_value(&mode->mu_k, at);
    if (mode->normal_slot < 0) return -side * mu;
    const double N = at->pull[link->pair] * link->side * vec_cross(e, p);
    return N > 0 ? -side * mu * N : 0;
}

/* ---- accelerations */

/* With x and y, and an angular acceleration alpha. */
static inline void accelerate_free(const struct tree_state *s, const double *own, double alpha,
                                   struct tree_rhs *x, double *a)
{
    x->gf = (struct vec){own[0], own[1]};
    x->uf = vec_sub(x->gf, x->p.force);
    x->A = (struct acceleration){alpha, vec_scale(s->inverse[0], vec_sub(x->uf, vec_scale(alpha, s->I.h)))};
    a[0] = x->A.a.x;
    a[1] = x->A.a.y;
}

/* The rest of p of a planar link is that of its velocity, a force in its centre of mass. */
static inline void accelerate_planar(const struct tree_state *s, const double *own, struct tree_rhs *x,
                                     double *a)
{
    x->g = own[2];
    const double of_joint = x->g - moment_of(s, (struct vec){own[0], own[1]}); /* its force acts in O */
    a[2] = s->D * (of_joint - (x->p.moment - moment_of(s, x->p.force)));
    x->p.force = vec_sub(x->p.force, vec_scale(s->omega * s->omega, s->mr));
    accelerate_free(s, own, a[2], x, a);
    x->u = x->g - x->p.moment - vec_dot(s->U, x->uf);
}

/* The whole acceleration, and the wrench of the joint. */
static void complete(struct tree_state *s, const struct tree_rhs *x)
{
    s->F = inertia_wrench(&s->I, x->A, x->p);
    s->A = (struct acceleration){s->A.alpha + x->A.alpha, vec_add(s->A.a, x->A.a)};
}

/* With one coordinate. */
static inline void accelerate_along(const struct tree_link *link, const struct tree_state *s,
                                    struct tree_rhs *x, double *a)
{
    x->u = x->g - (link->kind == motion_pivot ? x->p.moment : vec_dot(s->e, x->p.force));
    const double own = *a = s->locked ? 0 : s->D * x->u;
    x->A = link->kind == motion_pivot ? (struct acceleration){own, {0, 0}}
                                      : (struct acceleration){0, vec_scale(own, s->e)};
}

void tree_accelerate_alone(const struct fbd_model *model, const struct instant *at, int i, double *slots,
                           double *a)
{
    const struct tree *tree = model->tree;
    const struct tree_link *link = &tree->links[i];
    const struct link_loads *loads = tree_alone_loads(tree, i);
    const double *q = at->y + link->coordinate;
    struct tree_state *s = &at->tree->links[i];
    struct tree_rhs *x = &at->tree->x[i];
    if (!at->moved) move(link, q, q + model->plan.n, s);
    s->A = (struct acceleration){0, {0, 0}};
    x->p = tree_alone_weight(link, s);
    if (link->pair >= 0) lock(model, at, link, s, &x->p);
    if (loads->any) tree_load(tree, at, loads);
    double *own = a + link->coordinate;
    if (link->kind == motion_planar) {
        accelerate_planar(s, slots + link->coordinate, x, own);
    } else if (link->kind == motion_particle) {
        accelerate_free(s, slots + link->coordinate, 0, x, own);
    } else {
        x->p.force = vec_sub(x->p.force, vec_scale(s->omega * s->omega, s->mr));
        x->g = slots[link->coordinate];
        if (link->pair >= 0 && !s->locked) x->g += kinetic_friction(model, at, link, s->e, x->p.force);
        accelerate_along(link, s, x, own);
        if (s->locked) own[0] = s->held;
    }
    if (at->tree->rates_only) return;
    tree_alone_slots(model, at, i, slots);
    complete(s, x);
}

/* ---- their variation, as in tree_along.c
 *
 * The ground does not vary, nor does the direction of a line; so from the wrench p of the link, with the acceleration
 * alpha that it has, and the variation `held` of that of its surface,
 *
 *     dp_f = held m e + alpha k x d(m r) - 2 omega domega m r - omega^2 d(m r),   d(m r) = dangle k x m r
 */

static void move_along(const struct tree_link *link, const struct tree_state *s, const double *dq,
                       const double *dv, struct tree_variation *d)
{
    const int turn = link->kind == motion_pivot ? 0 : 2;
    const bool turns = link->kind == motion_pivot || link->kind == motion_planar;
    d->angle = turns ? dq[turn] : 0;
    d->omega = turns ? dv[turn] : 0;
    d->d = d->v = (struct vec){0, 0};
    if (link->kind == motion_slide) {
        d->d = vec_scale(dq[0], s->e);
        d->v = vec_scale(dv[0], s->e);
    } else if (link->kind != motion_pivot) {
        d->d = (struct vec){dq[0], dq[1]};
        d->v = (struct vec){dv[0], dv[1]};
    }
    d->p = d->d;
}

void tree_move_alone_along(const struct fbd_model *model, const struct instant *at,
                           const struct direction *along)
{
    const struct tree *tree = model->tree;
    for (int i = tree->joined; i < tree->count; i++) {
        const struct tree_link *link = &tree->links[i];
        const double *dq = along->dy + link->coordinate;
        move_along(link, &at->tree->links[i], dq, dq + model->plan.n, &at->tree->variation[i]);
    }
}

static struct wrench bias_along(const struct tree_link *link, const struct tree_state *s,
                                const struct tree_variation *d)
{
    const struct vec dmr = vec_scale(d->angle, vec_perp(s->mr));
    const double twice = 2 * s->omega * d->omega, w2 = s->omega * s->omega;
    struct vec f = vec_scale(s->A.alpha, vec_perp(dmr));
    f = vec_sub(f, vec_add(vec_scale(twice, s->mr), vec_scale(w2, dmr)));
    double weight = (link->sine * s->turn.x - link->cosine * s->turn.y) * d->angle;
    if (link->kind == motion_planar) weight += vec_cross(dmr, link->force) / s->mass;
    return (struct wrench){vec_cross(dmr, s->A.a) - weight, f};
}

static void lock_along(const struct fbd_model *model, const struct instant *at, const struct direction *along,
                       const struct tree_link *link, const struct tree_state *s, struct tree_variation *d,
                       struct wrench *p)
{
    d->held = friction_surface_jerk(&model->plan.modes[link->pair], at) * along->dt;
    d->A = link->kind == motion_pivot ? (struct acceleration){d->held, {0, 0}}
                                      : (struct acceleration){0, vec_scale(d->held, s->e)};
    *p = inertia_wrench(&s->I, d->A, *p);
}

static double kinetic_friction_along(const struct fbd_model *model, const struct instant *at,
                                     const struct direction *along, const struct tree_link *link,
                                     const struct vec normal, const struct vec dp, const double *slots)
{
    const struct mode *mode = &model->plan.modes[link->pair];
    const int side = slip_side(at->slip[link->pair]), pull = at->pull[link->pair];
    double d_mu, mu = formula_along(&mode->mu_k, at, along, &d_mu);
    if (mode->normal_slot < 0) return -side * d_mu;
    const double press = fmax(0, -pull * slots[mode->normal_slot]);
    return -side * (d_mu * press + mu * pull * vec_dot(normal, dp));
}

/* Of the sums of applied forces across and along the line. */
static void slots_along_line(const struct fbd_model *model, const struct instant *at, int i,
                             double *slots_along)
{
    const struct tree_link *link = &model->tree->links[i];
    const struct tree_state *s = &at->tree->links[i];
    const struct wrench dp = at->tree->x[i].p;
    if (link->normal_slot >= 0)
        slots_along[link->normal_slot] -= vec_dot(tree_normal(model->tree, at->tree, i), dp.force);
    if (link->pair < 0) return;
    const struct mode *mode = &model->plan.modes[link->pair];
    double d = joint_share(link, s, dp);
    if (s->locked) d -= mode->inertia * at->tree->variation[i].held;
    slots_along[mode->hold_slot] += slots_along[link->coordinate] - d;
}

void tree_vary_alone(const struct fbd_model *model, const struct instant *at, const struct direction *along,
                     int i, const double *slots, double *slots_along, double *a_along)
{
    const struct tree *tree = model->tree;
    const struct tree_link *link = &tree->links[i];
    const struct link_loads *loads = tree_alone_loads(tree, i);
    const double *dq = along->dy + link->coordinate;
    const struct tree_state *s = &at->tree->links[i];
    struct tree_variation *d = &at->tree->variation[i];
    struct tree_rhs *x = &at->tree->x[i];
    double *own = a_along + link->coordinate;
    move_along(link, s, dq, dq + model->plan.n, d);
    x->p = bias_along(link, s, d);
    if (s->locked) lock_along(model, at, along, link, s, d, &x->p);
    if (loads->any) tree_load_along(tree, at, along, loads);
    if (joint_freedom(link->kind) > 1) {
        const double *g = slots_along + link->coordinate;
        struct vec u = vec_sub((struct vec){g[0], g[1]}, x->p.force);
        bool turns = link->kind == motion_planar;
        if (turns) own[2] = s->D * (g[2] - x->p.moment - vec_dot(s->U, u));
        accelerate_free(s, g, turns ? own[2] : 0, x, own);
        return;
    }
    x->g = slots_along[link->coordinate];
    if (link->pair >= 0 && !s->locked)
        x->g +=
            kinetic_friction_along(model, at, along, link, tree_normal(tree, at->tree, i), x->p.force, slots);
    accelerate_along(link, s, x, own);
    slots_along_line(model, at, i, slots_along);
}
