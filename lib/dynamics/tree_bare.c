/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/tree_bare.h"

#include "base/simd2_sine.h"
#include "dynamics/rates_row.h"
#include "dynamics/tree.h"

/* ---- conditions */

bool tree_is_in_chains(const struct tree *tree)
{
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        bool slides = link->kind == motion_slide && link->parent == 0, chained = link->parent == i - 1;
        if (!(link->kind == motion_pivot || slides) || !(chained || link->parent == 0)) return false;
    }
    return true;
}

bool tree_is_bare(const struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    if (!tree_joins(tree) || tree->loaded || tree->ends) return false;
    /* Forces on the others read its places. */
    if (model->names_places && tree->joined < tree->count) return false;
    if (tree->coupling_count + tree->joined_watched + tree->massless_count > 0) return false;
    if (tree->joined_loads.of[list_potentials].count > 0) return false;
    return tree_is_in_chains(tree);
}

/* ---- outward: the bias
 *
 * A pivot on the ground has its O at rest, and only J and a moment; a slide on the ground does not turn, and
 * has only M and a force. */

/* Passed from link to link. */
struct trajectory {
    double omega;
    struct vec turn, a;
};

/* All sines and cosines first, of two links at a time: values in registers do not survive a call. */
static void turn_links(const struct tree_link *links, int count, const double *y, struct tree_bare *s)
{
    double angle = 0;
    int i = 0;
    if (links->kind == motion_slide) {
        angle = links->along;
        s[i++].turn = links->tilt;
    }
    for (; i + 1 < count; i += 2) {
        double first = angle + links[i].along + y[links[i].coordinate];
        angle = first + links[i + 1].along + y[links[i + 1].coordinate];
        units_by_sine(first, angle, &s[i].turn, &s[i + 1].turn);
    }
    if (i < count) s[i].turn = unit_by_sine(angle + links[i].along + y[links[i].coordinate]);
}

static inline struct trajectory set_out_from_ground(const struct tree_link *link, double v,
                                                    struct tree_bare *s)
{
    if (link->kind == motion_slide) return (struct trajectory){0, s->turn, {0, 0}};
    s->p.moment = -link->sine * s->turn.y - link->cosine * s->turn.x;
    return (struct trajectory){v, s->turn, {0, 0}};
}

static inline struct trajectory set_out(const struct tree_link *link, const struct trajectory *on, double v,
                                        struct tree_bare *s)
{
    double w2 = on->omega * on->omega, omega = on->omega + v, own = omega * omega, m = link->mass;
    struct vec turn = s->turn, d = vec_turn(on->turn, link->at), mr = vec_turn(turn, link->moment);
    struct vec a = {on->a.x - w2 * d.x, on->a.y - w2 * d.y};
    s->d = d;
    s->mr = mr;
    s->p.force = (struct vec){m * a.x - own * mr.x - link->force.x, m * a.y - own * mr.y - link->force.y};
    s->p.moment = vec_cross(mr, a) - link->sine * turn.y - link->cosine * turn.x;
    return (struct trajectory){omega, turn, a};
}

static void set_joint_forces(const struct fbd_model *model, const double *y, struct tree_bare *links)
{
    const struct plan *plan = &model->plan;
    const struct affine_term *term = plan->affine, *end = term + plan->affine_count;
    for (; term < end; term++)
        links[term->link].g =
            term->c0 - term->kq * y[term->coordinate] - term->kv * y[plan->n + term->coordinate];
}

/* ---- inward: inertia and wrench passed to the previous link, about its O */

struct passed {
    struct inertia_about_O I;
    struct wrench p;
};

static inline struct passed pass(const struct inertia_about_O *R, struct wrench p, const struct tree_bare *s)
{
    struct vec f = vec_add(p.force, vec_scale(s->u * s->D, s->h)), k = vec_perp(s->d),
               Rk = inertia_times(R, k);
    return (struct passed){{vec_dot(k, Rk), Rk, R->xx, R->xy, R->yy}, {s->g + vec_cross(s->d, f), f}};
}

static inline struct passed pass_last(const struct tree_link *link, struct tree_bare *s)
{
    s->D = link->inverse_I_O;
    s->u = s->g - s->p.moment;
    s->h = vec_perp(s->mr);
    struct inertia_about_O R = tree_last_pivot(link->across, s->mr, s->D);
    return pass(&R, s->p, s);
}

static inline struct passed pass_on(const struct tree_link *link, const struct passed *behind,
                                    struct tree_bare *s)
{
    double m = link->mass;
    struct inertia_about_O I = {link->I_O + behind->I.J, vec_add(vec_perp(s->mr), behind->I.h),
                                m + behind->I.xx, behind->I.xy, m + behind->I.yy};
    struct wrench p = {s->p.moment + behind->p.moment, vec_add(s->p.force, behind->p.force)};
    s->D = 1 / I.J;
    s->u = s->g - p.moment;
    s->h = I.h;
    struct inertia_about_O R = tree_pivot(&I, s->D);
    return pass(&R, p, s);
}

/* The acceleration in the joint on the ground. */
static double give_way(const struct tree_link *link, const struct passed *behind, const struct tree_bare *s)
{
    if (link->kind == motion_pivot)
        return 1 / (link->I_O + behind->I.J) * (s->g - (s->p.moment + behind->p.moment));
    struct inertia_about_O I = {
        0, {0, 0}, link->mass + behind->I.xx, behind->I.xy, link->mass + behind->I.yy};
    struct vec force = vec_sub(behind->p.force, link->force);
    double D = 1 / vec_dot(link->e, inertia_times(&I, link->e));
    return D * (s->g - vec_dot(link->e, force));
}

/* ---- all of it, chain by chain */

static void chain(const struct tree_link *links, struct tree_bare *s, int count, const double *y,
                  const double *v, double *a)
{
    struct passed passed = {{0, {0, 0}, 0, 0, 0}, {0, {0, 0}}};
    turn_links(links, count, y, s);
    struct trajectory course = set_out_from_ground(links, v[links->coordinate], s);
    for (int i = 1; i < count; i++) course = set_out(&links[i], &course, v[links[i].coordinate], &s[i]);
    if (count > 1) passed = pass_last(&links[count - 1], &s[count - 1]);
    for (int i = count - 2; i > 0; i--) passed = pass_on(&links[i], &passed, &s[i]);
    double own = give_way(links, &passed, s);
    bool turns = links->kind == motion_pivot;
    struct acceleration A = {turns ? own : 0, {0, 0}};
    if (!turns) A.a = vec_scale(own, links->e);
    a[links->coordinate] = own;
    for (int i = 1; i < count; i++) {
        double before = A.alpha;
        A = acceleration_at(A, s[i].d);
        A.alpha = s[i].D * (s[i].u - vec_dot(s[i].h, A.a));
        a[links[i].coordinate] = A.alpha - before;
    }
}

/* ---- two links
 *
 * Lagrange's equations in the angles of the links in the world. With d the vector from the O of the first link to
 * that of the last, h the mass of the last times the vector to its centre, and C = d . h, X = d x h, the last row
 *
 *     I alpha = tau - C alpha_0 - X omega_0^2
 *
 * eliminates alpha. The inertia of the last link that remains for the first is
 *
 *     m d . d - C^2 / I = across d . d + X^2 / I,    across = m I_G / I, I = I_G + h^2 / m:
 *
 * in this form there is no cancellation for a bob on a light cart. A slide moves along e as the end of a d with
 * k x d = e that does not turn, under a force instead of a moment. */

static inline double moment_of_forces(const struct tree_link *link, struct vec turn)
{
    return link->sine * turn.y + link->cosine * turn.x;
}

static void two_links(const struct tree_link *links, const struct tree_bare *s, const double *y,
                      const double *v, double *a)
{
    const struct tree_link *first = &links[0], *last = &links[1];
    const int q0 = first->coordinate, q1 = last->coordinate;
    const bool turns = first->kind == motion_pivot;
    const double angle = turns ? first->along + y[q0] : first->along, sum = angle + last->along + y[q1];
    struct vec turn0, turn1, d = {first->e.y, -first->e.x};
    double load = s[0].g, J = first->mass + last->across, w0 = 0;
    if (turns) {
        units_by_sine(angle, sum, &turn0, &turn1);
        d = vec_turn(turn0, last->at);
        load = load - s[1].g + moment_of_forces(first, turn0);
        J = first->I_O + last->across * vec_dot(last->at, last->at);
        w0 = v[q0];
    } else {
        turn1 = unit_by_sine(sum);
        load += vec_dot(first->e, first->force);
    }
    const struct vec h = vec_turn(turn1, last->moment);
    const double C = vec_dot(d, h), X = vec_cross(d, h), D = last->inverse_I_O, w1 = w0 + v[q1];
    const double u = D * (s[1].g + moment_of_forces(last, turn1) - w0 * w0 * X);
    load = load + vec_cross(d, last->force) + w1 * w1 * X;
    const double alpha = (load - C * u) / (J + D * X * X);
    a[q0] = alpha;
    a[q1] = u - D * C * alpha - (turns ? alpha : 0);
}

/* ---- the scene */

int bare_row(double t, const double y[], double dydt[], void *params)
{
    const struct row *row = params;
    const struct fbd_model *model = row->all->state->model;
    const struct tree_link *links = model->tree->links;
    struct tree_bare *bare = row->bare;
    const int n = model->plan.n, joined = model->tree->joined;
    (void)t;
    if (model->plan.affine_count > 0) set_joint_forces(model, y, bare);
    for (int i = 0; i < n; i++) dydt[i] = y[n + i];
    for (int i = 1; i < joined; i = links[i].end) {
        int count = links[i].end - i;
        if (count == 2)
            two_links(&links[i], &bare[i], y, y + n, dydt + n);
        else
            chain(&links[i], &bare[i], count, y, y + n, dydt + n);
    }
    return 0;
}
