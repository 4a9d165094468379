/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The three sweeps where every joint is a free pivot, as in pendulums, chains and linkages. A pivot transmits
 * its own moment only, so that of the wrench I A + p only M and the force are passed to the parent:
 *
 *     R = M - h h^T / J,   p + h u / J   with   u = g - moment of p
 *
 * and the bias has no angular acceleration. The results are those of the general sweeps.
 */
#include "base/sine.h"
#include "dynamics/tree.h"

/* tree_move and tree_bias of a link in one. */
static void set_out(const struct tree_link *link, const struct tree_state *parent, double q, double v,
                    struct tree_state *s, struct tree_rhs *x)
{
    double w = parent->omega, angle = parent->angle + link->along + q, omega = w + v;
    struct vec turn = unit_by_sine(angle), d = vec_turn(parent->turn, link->at);
    struct vec mr = vec_turn(turn, link->moment), c = vec_scale(omega * omega, mr);
    struct vec a = vec_sub(parent->A.a, vec_scale(w * w, d));
    s->angle = angle;
    s->omega = omega;
    s->turn = turn;
    s->d = d;
    s->p = vec_add(parent->p, d);
    s->v = vec_add(parent->v, vec_scale(w, vec_perp(d)));
    s->mr = mr;
    s->A = (struct acceleration){0, a};
    s->I = (struct inertia_about_O){link->I_O, vec_perp(mr), link->mass, 0, link->mass};
    x->p.force = vec_sub(vec_sub(vec_scale(link->mass, a), c), link->force);
    x->p.moment = vec_cross(mr, a) - link->sine * turn.y - link->cosine * turn.x;
}

static void sweep_courses(const struct fbd_model *model, const struct instant *at, const double *slots)
{
    const struct tree *tree = model->tree;
    struct tree_work *work = at->tree;
    const double *q = at->y, *v = at->y + model->plan.n;
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        int k = link->coordinate;
        set_out(link, &work->links[link->parent], q[k], v[k], &work->links[i], &work->x[i]);
        work->x[i].g = slots[k];
    }
}

/* The articulated inertia and wrench that a link passes to its parent, about the parent's O. */
struct passed {
    struct inertia_about_O I;
    struct wrench p;
};

static void take(struct inertia_about_O *I, struct wrench *p, const struct passed *passed)
{
    I->J += passed->I.J;
    I->h = vec_add(I->h, passed->I.h);
    I->xx += passed->I.xx;
    I->xy += passed->I.xy;
    I->yy += passed->I.yy;
    p->moment += passed->p.moment;
    p->force = vec_add(p->force, passed->p.force);
}

static struct passed pass(const struct inertia_about_O *R, double g, struct vec f, struct vec d)
{
    struct vec k = vec_perp(d), Rk = inertia_times(R, k);
    return (struct passed){{vec_dot(k, Rk), Rk, R->xx, R->xy, R->yy}, {g + vec_cross(d, f), f}};
}

/* Along a chain the passed values stay in registers. */
static void sweep_inward(const struct tree *tree, struct tree_work *work)
{
    struct passed passed = {{0, {0, 0}, 0, 0, 0}, {0, {0, 0}}};
    int to = 0;
    for (int i = tree->joined - 1; i > 0; i--) {
        struct tree_state *s = &work->links[i];
        struct tree_rhs *x = &work->x[i];
        bool last = to != i; /* a leaf */
        if (last) {
            take(&work->links[to].I, &work->x[to].p, &passed);
            passed = (struct passed){{0, {0, 0}, 0, 0, 0}, {0, {0, 0}}};
        }
        struct inertia_about_O I = s->I;
        struct wrench p = x->p;
        take(&I, &p, &passed);
        double D = 1 / I.J, u = x->g - p.moment;
        s->I = I;
        s->D = D;
        x->p = p;
        x->u = u;
        struct inertia_about_O R =
            last ? tree_last_pivot(tree->links[i].across, s->mr, D) : tree_pivot(&I, D);
        passed = pass(&R, x->g, vec_add(p.force, vec_scale(u * D, I.h)), s->d);
        to = tree->links[i].parent;
    }
}

static void sweep_outward(const struct tree *tree, struct tree_work *work, double *a)
{
    struct tree_rhs *xs = work->x;
    struct acceleration A = {0, {0, 0}};
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        const struct tree_state *s = &work->links[i];
        if (link->parent != i - 1) A = xs[link->parent].A;
        double before = A.alpha;
        A = acceleration_at(A, s->d);
        A.alpha = s->D * (xs[i].u - vec_dot(s->I.h, A.a));
        xs[i].A = A;
        a[link->coordinate] = A.alpha - before;
    }
}

void tree_pivots(const struct fbd_model *model, const struct instant *at, const double *slots, double *a)
{
    struct tree_work *work = at->tree;
    work->links[0].turn = (struct vec){1, 0};
    work->links[0].I = (struct inertia_about_O){0, {0, 0}, 0, 0, 0};
    work->x[0].p = (struct wrench){0, {0, 0}};
    work->x[0].A = (struct acceleration){0, {0, 0}};
    sweep_courses(model, at, slots);
    tree_load(model->tree, at, &model->tree->joined_loads);
    sweep_inward(model->tree, work);
    sweep_outward(model->tree, work, a);
}
