/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/tree_loop.h"

#include "base/simd2_sine.h"
#include "dynamics/tree_bare.h"

/* ---- constants */

/* In the frame of a link, or, if it does not turn, in the world. */
static struct vec arm_of(const struct tree_link *link, struct vec point)
{
    return link->kind == motion_slide ? (struct vec){link->e.y, -link->e.x} : point;
}

/* Add the contribution of an end of the pin at `point` of a link to b of all links that move it. */
static void add_end(const struct tree *tree, struct tree_loop *loop, int link, struct vec point, double sign)
{
    for (; link > 0; link = tree->links[link].parent) {
        struct tree_loop_link *own = loop->of[link];
        struct vec arm = arm_of(&tree->links[link], point), fixed = vec_turn(tree->links[link].tilt, point);
        own->b = vec_add(own->b, vec_scale(sign, arm));
        if (tree->links[link].kind == motion_slide) loop->gap = vec_add(loop->gap, vec_scale(sign, fixed));
        point = tree->links[link].at;
    }
    loop->gap = vec_add(loop->gap, vec_scale(sign, point));
}

/* Scale to units of sqrt(inertia). */
static void scale(struct tree_loop_link *own, double inertia)
{
    own->unit = 1 / sqrt(inertia);
    own->inverse_unit = sqrt(inertia);
    own->b = vec_scale(own->unit, own->b);
    own->S = vec_scale(own->unit, own->S);
    own->sine *= own->unit;
    own->cosine *= own->unit;
    own->steady *= own->unit;
}

/* Set a link with the mass and the constant forces of all links behind it, applied at the O of `next`.
 * Returns its inertia. */
static double set_link(const struct tree_link *link, const struct tree_link *next, double mass,
                       struct vec force, struct tree_loop_link *own)
{
    bool turns = link->kind == motion_pivot;
    struct vec at = next ? next->at : (struct vec){0, 0};
    own->coordinate = link->coordinate;
    own->turns = turns;
    own->along = link->along;
    own->passes_on = next && turns;
    if (!turns) {
        own->steady = vec_dot(link->e, vec_add(link->force, force));
        return link->mass + mass;
    }
    own->S = vec_add(link->moment, vec_scale(mass, at));
    own->sine = link->sine - vec_dot(at, force);
    own->cosine = link->cosine + vec_cross(at, force);
    return link->I_O + mass * vec_dot(at, at);
}

/* Add a constant moment, or on a slide a constant force in its frame. */
static void add_following(const struct tree *tree, const struct tree_following *following,
                          struct tree_loop_link *own)
{
    const struct tree_link *link = &tree->links[following->link];
    double along = vec_dot(link->e, vec_turn(link->tilt, following->force));
    own->steady += own->unit * (own->turns ? following->moment : along);
}

/* Do all loads beside constant forces act along coordinates, independently of positions? */
static bool is_loaded_simply(const struct tree *tree)
{
    if (tree->spring_count + tree->drag_count + tree->bulk_count > 0) return false;
    for (size_t i = 0; i < tree->following_count; i++) {
        const struct tree_following *f = &tree->following[i];
        bool pushes = f->force.x != 0 || f->force.y != 0;
        if (pushes && tree->links[f->link].kind != motion_slide) return false;
    }
    for (size_t i = 0; i < tree->force_count; i++)
        if (tree->links[tree->forces[i].link].kind != motion_slide) return false;
    return true;
}

/* The order of the links in the loop: those of a chain of two come first. */
static void set_order(const struct tree *tree, struct tree_loop *loop, struct tree_loop_link **of)
{
    bool alone_first = tree->links[2].parent == 0;
    loop->chain = !alone_first && tree->links[3].parent == 2;
    for (int i = 1; i <= 3; i++) of[i] = &loop->links[alone_first ? (i + 1) % 3 : i - 1];
}

/* The pin joins the end of the first chain to the third link or to the ground. */
static bool close_loop(const struct tree *tree, struct tree_loop *loop)
{
    const struct coupling_end *end = tree->couplings[0].end;
    const struct tree_loop_link *from = &loop->links[loop->chain ? 2 : 1], *to = &loop->links[2];
    int first = loop->of[end[0].link] == from ? 0 : 1, other = 1 - first;
    if (loop->of[end[first].link] != from || loop->of[end[other].link] != (loop->chain ? NULL : to))
        return false;
    add_end(tree, loop, end[first].link, end[first].point, 1);
    add_end(tree, loop, end[other].link, end[other].point, -1);
    return true;
}

bool tree_loop_is_steady(const struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    const struct plan *plan = &model->plan;
    for (size_t i = 0; i < plan->affine_count; i++)
        if (plan->affine[i].kq != 0 || plan->affine[i].kv != 0) return false;
    return plan->potential_count + tree->force_count + tree->moment_count == 0;
}

/* Expressions with positions in the world or accelerations need the tree. */
static bool names_others(const struct fbd_model *model)
{
    return model->names_places && (model->plan.own > 0 || !tree_loop_is_steady(model));
}

bool tree_loop_may_be(const struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    return tree->count == 4 && tree->coupling_count == 1 && tree->massless_count == 0 && model->plan.n == 3;
}

bool tree_loop_find(const struct fbd_model *model, struct tree_loop *loop)
{
    const struct tree *tree = model->tree;
    struct tree_loop_link **of = loop->of;
    double mass = 0, trace = 0;
    struct vec force = {0, 0};
    if (!tree_loop_may_be(model) || tree->couplings[0].kind != constraint_pin || !tree_is_in_chains(tree) ||
        !is_loaded_simply(tree) || model->plan.mode_count > 0 || tree->ends || names_others(model) ||
        (tree->links[2].parent == 0 && tree->links[3].parent == 0))
        return false;
    *loop = (struct tree_loop){.tree = tree};
    set_order(tree, loop, of);
    if (!close_loop(tree, loop)) return false;
    for (int i = 3; i > 0; i--) {
        const struct tree_link *link = &tree->links[i];
        bool last = i == 3 || tree->links[i + 1].parent == 0;
        if (last) mass = 0, force = (struct vec){0, 0};
        double inertia = set_link(link, last ? NULL : link + 1, mass, force, of[i]);
        if (!(inertia > 0)) return false;
        scale(of[i], inertia);
        if (of[i]->turns) loop->size += of[i]->inverse_unit * vec_norm(of[i]->b);
        trace += vec_dot(of[i]->b, of[i]->b);
        mass += link->mass;
        force = vec_add(force, link->force);
    }
    for (size_t i = 0; i < tree->following_count; i++)
        add_following(tree, &tree->following[i], of[tree->following[i].link]);
    loop->size += vec_norm(loop->gap);
    loop->least = 1e-3 * trace * trace;
    return true;
}

/* ---- variable terms */

void tree_loop_forces(const struct tree_loop *loop, const struct instant *at, const double *slots, double *f)
{
    const struct tree *tree = loop->tree;
    const struct tree_loop_link *l = loop->links;
    for (int i = 0; i < 3; i++) {
        f[i] = l[i].steady + l[i].unit * slots[l[i].coordinate];
        if (i > 0 && l[i - 1].passes_on) f[i - 1] -= l[i - 1].unit * slots[l[i].coordinate];
    }
    for (size_t i = 0; i < tree->moment_count; i++) {
        const struct tree_moment *moment = &tree->moments[i];
        const struct tree_loop_link *own = loop->of[moment->link];
        const struct tree_loop_link *partner = moment->partner > 0 ? loop->of[moment->partner] : NULL;
        const double value = formula_value(&moment->value, at);
        if (own->turns) f[own - l] += own->unit * value;
        if (partner && partner->turns) f[partner - l] -= partner->unit * value;
    }
    for (size_t i = 0; i < tree->force_count; i++) {
        const struct tree_force *force = &tree->forces[i];
        const struct tree_link *link = &tree->links[force->link];
        const struct tree_loop_link *own = loop->of[force->link];
        double angle = formula_value(&force->angle, at) + force->turn + (force->body_frame ? link->along : 0);
        f[own - l] += own->unit * formula_value(&force->value, at) * vec_dot(link->e, vec_unit(angle));
    }
}

/* ---- rates */

#define INLINE static inline __attribute__((always_inline))

/* Turn a vector of a link, if the link turns. */
INLINE struct vec turned(bool turns, struct vec turn, struct vec own)
{
    return turns ? vec_turn(turn, own) : own;
}

INLINE double force_along(const struct tree_loop_link *link, bool turns, double f, struct vec turn)
{
    return turns ? f + link->sine * turn.y + link->cosine * turn.x : f;
}

/* Two links in one chain: returns their coupling inertia, and adds their centrifugal forces. The O of the
 * second is at the end of b of the first. */
INLINE double couple(struct vec b, struct vec S, double z_first, double z_second, double *f_first,
                     double *f_second)
{
    double x = vec_cross(b, S);
    *f_first += x * z_second;
    *f_second -= x * z_first;
    return vec_dot(b, S);
}

/* Accelerations of two links for the pin: u_1 k x b_1 + u_2 k x b_2 = G. Returns their inertia force along N. */
INLINE double fit(struct vec G, struct vec b1, struct vec b2, double inverse, double K1, double K2,
                  double *u1, double *u2)
{
    *u1 = vec_dot(G, b2) * inverse;
    *u2 = -vec_dot(G, b1) * inverse;
    return K1 * *u1 + K2 * *u2;
}

/* The motion along N plus accelerations that satisfy the pin with one link at rest, the first if possible.
 * All sines and cosines first: values in registers do not survive a call. */
INLINE bool solve(const struct tree_loop *loop, bool chain, bool turns0, bool turns2, const double *f,
                  const double *y, const double *v, double *a)
{
    const struct tree_loop_link *l = loop->links;
    int q0 = l[0].coordinate, q1 = l[1].coordinate, q2 = l[2].coordinate;
    double angle0 = turns0 ? l[0].along + y[q0] : l[0].along, angle1 = angle0 + l[1].along + y[q1];
    double angle2 = (chain ? angle1 + l[2].along : l[2].along) + (turns2 ? y[q2] : 0);
    struct vec t0 = l[0].b, t1, t2;
    if (turns0)
        units_by_sine(angle0, angle1, &t0, &t1);
    else
        t1 = unit_by_sine(angle1);
    t2 = turns2 ? unit_by_sine(angle2) : t0;
    double w0 = turns0 ? v[q0] : 0, w1 = w0 + v[q1], w2 = turns2 ? (chain ? w1 + v[q2] : v[q2]) : 0;
    double z0 = turns0 ? w0 * w0 * l[0].inverse_unit : 0, z1 = w1 * w1 * l[1].inverse_unit,
           z2 = turns2 ? w2 * w2 * l[2].inverse_unit : 0;
    double f0 = force_along(&l[0], turns0, f[0], t0), f1 = force_along(&l[1], true, f[1], t1),
           f2 = force_along(&l[2], turns2, f[2], t2), c02 = 0, c12 = 0;
    struct vec b0 = turned(turns0, t0, l[0].b), b1 = vec_turn(t1, l[1].b), b2 = turned(turns2, t2, l[2].b);
    double c01 = couple(b0, vec_turn(t1, l[1].S), z0, z1, &f0, &f1);
    if (chain) {
        struct vec S2 = turned(turns2, t2, l[2].S);
        c02 = couple(b0, S2, z0, z2, &f0, &f2);
        c12 = couple(b1, S2, z1, z2, &f1, &f2);
    }
    double N0 = vec_cross(b1, b2), N1 = vec_cross(b2, b0), N2 = vec_cross(b0, b1);
    double K0 = N0 + c01 * N1, K1 = c01 * N0 + N1, K2 = N2;
    if (chain) {
        K0 += c02 * N2;
        K1 += c12 * N2;
        K2 += c02 * N0 + c12 * N1;
    }
    double N00 = N0 * N0, N11 = N1 * N1, N22 = N2 * N2, norm = N00 + N11 + N22;
    double inertia = N0 * K0 + N1 * K1 + N2 * K2;
    if (!(norm > loop->least && inertia > 1e-2 * norm)) return false;
    struct vec G = vec_scale(z1, b1);
    if (turns0) G = vec_add(G, vec_scale(z0, b0));
    if (turns2) G = vec_add(G, vec_scale(z2, b2));
    double u0 = 0, u1 = 0, u2 = 0, along;
    if (N00 > 0.05 * norm)
        along = fit(G, b1, b2, 1 / N0, K1, K2, &u1, &u2);
    else if (N11 > N22)
        along = fit(G, b2, b0, 1 / N1, K2, K0, &u2, &u0);
    else
        along = fit(G, b0, b1, 1 / N2, K0, K1, &u0, &u1);
    double s = (N0 * f0 + N1 * f1 + N2 * f2 - along) / inertia;
    double a0 = l[0].unit * (u0 + s * N0), a1 = l[1].unit * (u1 + s * N1), a2 = l[2].unit * (u2 + s * N2);
    a[q0] = a0;
    a[q1] = turns0 ? a1 - a0 : a1;
    a[q2] = chain ? a2 - a1 : a2;
    return true;
}

bool tree_loop_rates(const struct tree_loop *loop, const double *f, const double *y, const double *v,
                     double *a)
{
    if (!loop->chain && loop->links[0].turns && !loop->links[2].turns)
        return solve(loop, false, true, false, f, y, v, a);
    return solve(loop, loop->chain, loop->links[0].turns, loop->links[2].turns, f, y, v, a);
}
