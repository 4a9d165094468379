/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sweeps: the wrench and inertia that a joint transmits, and its acceleration (Featherstone, Rigid Body
 * Dynamics Algorithms, section 7.3).
 *
 * Accelerations are relative to the bias (tree_bias.c), about the reference point O of each link, with
 * components in the world. A link with its subtree has the acceleration A = (alpha, a) when its joint exerts
 * the wrench
 *
 *     F = I A + p,   p = wrench for the bias - applied wrench
 *
 * F acts on the link, -F on the parent. The joint moves along S, A = A' + S q'' with A' the acceleration of
 * the parent at O, and the component of F along S is the generalized force of the joint, S . F = g. With
 *
 *     U = I S,   D = 1 / (S . U),   u = g - S . p
 *
 * this gives q'' and, as a function of A' only, the wrench that the parent has to exert:
 *
 *     q'' = D (u - U . A')
 *     F = I' A' + p',   I' = I - D U U^T,   p' = p + D u U
 *
 * Inward, from the last link to the first, I' and p' are shifted by d to the O of the parent and added to its
 * own; outward q'' and A follow from A'. A sticking joint has no S: I' = I, p' = p, A = A'. Joint by joint, S
 * = (alpha; a):
 *
 *     pivot   (1; 0)         U = (J; h). The transmitted moment is g: the first row and column of I' are zero
 *     slide   (0; e)         U = (h . e; M e) = (Uh; U)
 *     track   (kappa; e)     U = (kappa J + h . e; kappa h + M e), kappa 0 if the body does not turn
 *     free    a, and alpha when planar, in two steps: a = M^-1 (gf - p_f - h alpha) leaves the moment
 *             J_G alpha + p_m + h . M^-1 (gf - p_f) with J_G = J - h . M^-1 h, which is g for a planar body; the
 *             parent of a particle receives J_G, of a planar body only g and gf
 *
 * A joint to which an inertia w is added (model/tree_massless.c) has D = 1 / (S . U + w), and then all of I'
 * and p' are those above, also for a pivot.
 *
 * Checked against Kane's equations with a separate mass matrix, Newton's and Euler's for each body
 * (tests/unit/test_tree.c), and inverse dynamics of long chains (test_chain.c).
 */
#include <math.h>

#include "dynamics/tree.h"

/* ---- the inertia that each joint transmits */

static void factor_pivot(const struct tree_link *link, int i, struct tree_state *s,
                         struct inertia_about_O *rest)
{
    const struct inertia_about_O *I = &s->I;
    s->D = 1 / I->J;
    *rest = link->end == i + 1 ? tree_last_pivot(s->across, s->mr, s->D) : tree_pivot(I, s->D);
}

/* The inertia `added` to a coordinate whose own, by the bodies that it carries, is smaller. */
static double added_to(double added, double own)
{
    return added > 0 && !(own > added / 2) ? added : 0;
}

/* A pivot with an added inertia; false if its own suffices. */
static bool factor_massless_pivot(const struct tree_link *link, struct tree_state *s,
                                  struct inertia_about_O *rest)
{
    const struct inertia_about_O *I = &s->I;
    const double w = s->added[0] = added_to(link->added[0], I->J);
    if (w == 0) return false;
    s->D = 1 / (I->J + w);
    struct vec hD = vec_scale(s->D, I->h);
    *rest = (struct inertia_about_O){w * s->D * I->J, vec_scale(w * s->D, I->h), I->xx - hD.x * I->h.x,
                                     I->xy - hD.x * I->h.y, I->yy - hD.y * I->h.y};
    return true;
}

static inline __attribute__((always_inline)) void
factor_slide(const struct tree_link *link, struct tree_state *s, struct inertia_about_O *rest, bool massless)
{
    const struct inertia_about_O *I = &s->I;
    s->U = inertia_times(I, s->e);
    s->Uh = vec_dot(I->h, s->e);
    double own = vec_dot(s->e, s->U);
    if (massless) own += s->added[0] = added_to(link->added[0], own);
    s->D = 1 / own;
    struct vec UD = vec_scale(s->D, s->U);
    *rest = (struct inertia_about_O){I->J - s->D * s->Uh * s->Uh, vec_sub(I->h, vec_scale(s->Uh, UD)),
                                     I->xx - UD.x * s->U.x, I->xy - UD.x * s->U.y, I->yy - UD.y * s->U.y};
}

/* As a slide that rotates by `turning` per length. */
static void factor_track(const struct tree_link *link, struct tree_state *s, struct inertia_about_O *rest)
{
    const struct inertia_about_O *I = &s->I;
    s->U = vec_add(inertia_times(I, s->e), vec_scale(s->turning, I->h));
    s->Uh = vec_dot(I->h, s->e) + s->turning * I->J;
    const double own = vec_dot(s->e, s->U) + s->turning * s->Uh;
    s->added[0] = added_to(link->added[0], own);
    s->D = 1 / (own + s->added[0]);
    struct vec UD = vec_scale(s->D, s->U);
    *rest = (struct inertia_about_O){I->J - s->D * s->Uh * s->Uh, vec_sub(I->h, vec_scale(s->Uh, UD)),
                                     I->xx - UD.x * s->U.x, I->xy - UD.x * s->U.y, I->yy - UD.y * s->U.y};
}

/* The smaller eigenvalue of M is at least det M / trace M. */
static double least_mass(const struct inertia_about_O *I)
{
    const double trace = I->xx + I->yy;
    return trace > 0 ? (I->xx * I->yy - I->xy * I->xy) / trace : 0;
}

static inline __attribute__((always_inline)) void
factor_free(const struct tree_link *link, struct tree_state *s, struct inertia_about_O *rest, bool massless)
{
    const struct inertia_about_O *I = &s->I;
    double xx = I->xx, yy = I->yy;
    if (massless) {
        s->added[0] = added_to(link->added[0], least_mass(I));
        xx += s->added[0];
        yy += s->added[0];
    }
    double det = xx * yy - I->xy * I->xy;
    s->inverse[0] = yy / det;
    s->inverse[1] = -I->xy / det;
    s->inverse[2] = xx / det;
    s->U = (struct vec){s->inverse[0] * I->h.x + s->inverse[1] * I->h.y,
                        s->inverse[1] * I->h.x + s->inverse[2] * I->h.y};
    double J = I->J - vec_dot(I->h, s->U);
    if (massless) J += s->added[1] = added_to(link->added[1], J);
    s->D = link->kind == motion_planar ? 1 / J : 0;
    *rest = (struct inertia_about_O){link->kind == motion_planar ? 0 : J, {0, 0}, 0, 0, 0};
}

/* Trees without tracks and massless coordinates skip those tests for each link: `general` is a constant in each use. */
static inline __attribute__((always_inline)) void factor_link(const struct tree_link *link, int i,
                                                              struct tree_state *s, struct tree_state *parent,
                                                              bool general)
{
    struct inertia_about_O rest;
    if (s->locked) {
        rest = s->I;
    } else if (link->kind == motion_pivot) {
        if (!general || !factor_massless_pivot(link, s, &rest)) factor_pivot(link, i, s, &rest);
    } else if (link->kind == motion_slide) {
        factor_slide(link, s, &rest, general);
    } else if (general && link->kind == motion_track) {
        factor_track(link, s, &rest);
    } else {
        factor_free(link, s, &rest, general);
    }
    if (link->parent > 0) inertia_add(&parent->I, &rest, s->d);
}

/* ---- one right-hand side inward */

static inline __attribute__((always_inline)) void inward_link(const struct tree_link *link,
                                                              const struct tree_state *s, struct tree_rhs *x,
                                                              struct tree_rhs *parent, bool general)
{
    struct wrench rest = x->p;
    if (s->locked) {
        /* rigid */
    } else if (link->kind == motion_pivot) {
        x->u = x->g - x->p.moment;
        rest.moment = general ? x->g - s->added[0] * s->D * x->u : x->g;
        rest.force = vec_add(rest.force, vec_scale(x->u * s->D, s->I.h));
    } else if (link->kind == motion_slide) {
        x->u = x->g - vec_dot(s->e, x->p.force);
        rest.moment += s->Uh * s->D * x->u;
        rest.force = vec_add(rest.force, vec_scale(s->D * x->u, s->U));
    } else if (general && link->kind == motion_track) {
        x->u = x->g - vec_dot(s->e, x->p.force) - s->turning * x->p.moment;
        rest.moment += s->Uh * s->D * x->u;
        rest.force = vec_add(rest.force, vec_scale(s->D * x->u, s->U));
    } else {
        x->uf = vec_sub(x->gf, x->p.force);
        rest.force = x->gf;
        rest.moment += vec_dot(s->U, x->uf);
        x->u = x->g - rest.moment; /* planar: the moment about its centre */
        if (link->kind == motion_planar) rest.moment = x->g;
    }
    if (link->parent > 0) wrench_add(&parent->p, rest, s->d);
}

static inline __attribute__((always_inline)) void factor(const struct tree *tree, struct tree_work *work,
                                                         bool general)
{
    struct tree_state *links = work->links;
    links[0].I = (struct inertia_about_O){0, {0, 0}, 0, 0, 0};
    work->x[0].p = (struct wrench){0, {0, 0}};
    for (int i = 1; i < tree->joined; i++) {
        struct tree_state *s = &links[i];
        s->I = (struct inertia_about_O){s->I_O, {-s->mr.y, s->mr.x}, s->mass, 0, s->mass};
    }
    for (int i = tree->joined - 1; i > 0; i--) {
        const struct tree_link *link = &tree->links[i];
        factor_link(link, i, &links[i], &links[link->parent], general);
        inward_link(link, &links[i], &work->x[i], &work->x[link->parent], general);
    }
}

void tree_factor(const struct tree *tree, struct tree_work *work)
{
    if (tree->general)
        factor(tree, work, true);
    else
        factor(tree, work, false);
}

static inline __attribute__((always_inline)) void inward(const struct tree *tree, struct tree_work *work,
                                                         int from, int to, bool general)
{
    for (int i = to - 1; i >= from; i--) {
        const struct tree_link *link = &tree->links[i];
        inward_link(link, &work->links[i], &work->x[i], &work->x[link->parent], general);
    }
}

void tree_inward(const struct tree *tree, struct tree_work *work, int from, int to)
{
    if (tree->general)
        inward(tree, work, from, to, true);
    else
        inward(tree, work, from, to, false);
}

/* Pass a wrench on a link to its parent; sets the force on the joint between them. */
static inline __attribute__((always_inline)) void push_link(const struct tree *tree, int i,
                                                            const struct tree_state *s, struct wrench *p,
                                                            struct tree_push *push)
{
    const struct tree_link *link = &tree->links[i];
    struct tree_rhs x = {.p = *p}, parent = {.p = {0, {0, 0}}};
    inward_link(link, s, &x, &parent, tree->general);
    *p = parent.p;
    push->link = i;
    push->u = x.u;
    push->alone = s->D * x.u;
    push->uf = push->alone_f = (struct vec){0, 0};
    if (joint_freedom(link->kind) == 1) return;
    push->uf = x.uf;
    push->alone_f = (struct vec){s->inverse[0] * x.uf.x + s->inverse[1] * x.uf.y,
                                 s->inverse[1] * x.uf.x + s->inverse[2] * x.uf.y};
}

int tree_push(const struct tree *tree, const struct tree_work *work, int *at, struct wrench *p, int count,
              struct tree_push *pushes)
{
    int made = 0;
    for (;;) {
        int last = 0;
        for (int k = 1; k < count; k++)
            if (at[k] > at[last]) last = k;
        int i = at[last];
        if (i <= 0) return made;
        for (int k = 0; k < count; k++) {
            if (k == last || at[k] != i) continue;
            p[last] = (struct wrench){p[last].moment + p[k].moment, vec_add(p[last].force, p[k].force)};
            at[k] = 0;
        }
        push_link(tree, i, &work->links[i], &p[last], &pushes[made]);
        if (!work->links[i].locked) made++;
        at[last] = tree->links[i].parent;
    }
}

/* ---- accelerations outward */

static void outward_free(const struct tree_link *link, const struct tree_state *s, struct tree_rhs *x,
                         double *a)
{
    double alpha = link->kind == motion_planar ? s->D * x->u : x->A.alpha;
    struct vec f = vec_sub(x->uf, vec_scale(alpha, s->I.h));
    struct vec own = {s->inverse[0] * f.x + s->inverse[1] * f.y, s->inverse[1] * f.x + s->inverse[2] * f.y};
    struct vec relative = vec_sub(own, x->A.a);
    if (link->kind == motion_planar) a[2] = alpha - x->A.alpha;
    a[0] = vec_dot(s->e, relative);
    a[1] = vec_cross(s->e, relative);
    x->A = (struct acceleration){alpha, own};
}

static inline __attribute__((always_inline)) void outward(const struct tree *tree, struct tree_work *work,
                                                          int from, int to, double *a, bool general)
{
    struct tree_rhs *xs = work->x;
    xs[0].A = (struct acceleration){0, {0, 0}};
    for (int i = from; i < to; i++) {
        const struct tree_link *link = &tree->links[i];
        const struct tree_state *s = &work->links[i];
        const struct tree_rhs *parent = &xs[link->parent];
        struct tree_rhs *x = &xs[i];
        double *own = a + link->coordinate;
        x->A = acceleration_at(parent->A, s->d);
        if (s->locked) {
            own[0] = 0;
        } else if (general && s->added[0] > 0 && link->kind == motion_pivot) {
            own[0] = s->D * (x->u - s->I.J * x->A.alpha - vec_dot(s->I.h, x->A.a));
            x->A.alpha += own[0];
        } else if (link->kind == motion_pivot) {
            x->A.alpha = s->D * (x->u - vec_dot(s->I.h, x->A.a));
            own[0] = x->A.alpha - parent->A.alpha;
        } else if (link->kind == motion_slide) {
            own[0] = s->D * (x->u - s->Uh * x->A.alpha - vec_dot(s->U, x->A.a));
            x->A.a = vec_add(x->A.a, vec_scale(own[0], s->e));
        } else if (general && link->kind == motion_track) {
            own[0] = s->D * (x->u - s->Uh * x->A.alpha - vec_dot(s->U, x->A.a));
            x->A.a = vec_add(x->A.a, vec_scale(own[0], s->e));
            x->A.alpha += s->turning * own[0];
        } else {
            outward_free(link, s, x, own);
        }
    }
}

void tree_outward(const struct tree *tree, struct tree_work *work, int from, int to, double *a)
{
    if (tree->general)
        outward(tree, work, from, to, a, true);
    else
        outward(tree, work, from, to, a, false);
}
