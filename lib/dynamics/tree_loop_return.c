/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Back to the pin of a loop, by Newton's method: changes u of the links that mend what it is off by, sum u_j k x b_j = -g,
 * and of which u . M N = 0, so that they have the least u . M u (Hairer and Wanner II, VII.2).
 */
#include <float.h>
#include <string.h>

#include "dynamics/tree_loop.h"

/* The loop at y: its vectors, the motion N that is free with K = M N, and what the pin is off by. */
struct look {
    struct vec b[3], gap;
    double N[3], K[3], norm, inertia;
};

static bool goes_on(const struct tree_loop *loop, int i)
{
    return i == 1 || (i == 2 && loop->chain);
}

static struct look look_at(const struct tree_loop *loop, const double *y)
{
    struct look at = {.gap = loop->gap};
    struct vec S[3];
    double angle = 0;
    for (int i = 0; i < 3; i++) {
        const struct tree_loop_link *link = &loop->links[i];
        angle = goes_on(loop, i) ? angle + link->along : link->along;
        if (link->turns) angle += y[link->coordinate];
        struct vec turn = link->turns ? vec_unit(angle) : (struct vec){1, 0};
        at.b[i] = vec_turn(turn, link->b);
        S[i] = vec_turn(turn, link->S);
        struct vec way = link->turns ? at.b[i] : vec_scale(y[link->coordinate], vec_perp(at.b[i]));
        at.gap = vec_add(at.gap, vec_scale(link->inverse_unit, way));
    }
    double c01 = vec_dot(at.b[0], S[1]), c02 = loop->chain ? vec_dot(at.b[0], S[2]) : 0,
           c12 = loop->chain ? vec_dot(at.b[1], S[2]) : 0;
    for (int i = 0; i < 3; i++) at.N[i] = vec_cross(at.b[(i + 1) % 3], at.b[(i + 2) % 3]);
    at.K[0] = at.N[0] + c01 * at.N[1] + c02 * at.N[2];
    at.K[1] = c01 * at.N[0] + at.N[1] + c12 * at.N[2];
    at.K[2] = c02 * at.N[0] + c12 * at.N[1] + at.N[2];
    for (int i = 0; i < 3; i++) {
        at.norm += at.N[i] * at.N[i];
        at.inertia += at.N[i] * at.K[i];
    }
    return at;
}

/* Add to x, coordinates or rates, what moves the point of the pin by -off. */
static void mend(const struct tree_loop *loop, const struct look *at, struct vec off, double *x)
{
    int still = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(at->N[i]) > fabs(at->N[still])) still = i;
    int j = (still + 1) % 3, k = (still + 2) % 3;
    double u[3] = {0, 0, 0}, before = 0;
    u[j] = -vec_dot(off, at->b[k]) / at->N[still];
    u[k] = vec_dot(off, at->b[j]) / at->N[still];
    double along = -(at->K[j] * u[j] + at->K[k] * u[k]) / at->inertia;
    for (int i = 0; i < 3; i++) {
        const struct tree_loop_link *link = &loop->links[i];
        double own = link->unit * (u[i] + along * at->N[i]);
        x[link->coordinate] += goes_on(loop, i) ? own - before : own;
        before = link->turns ? own : 0;
    }
}

static struct vec rate_of(const struct tree_loop *loop, const struct look *at, const double *v)
{
    struct vec rate = {0, 0};
    double w = 0;
    for (int i = 0; i < 3; i++) {
        const struct tree_loop_link *link = &loop->links[i];
        w = goes_on(loop, i) && link[-1].turns ? w + v[link->coordinate] : v[link->coordinate];
        rate = vec_add(rate, vec_scale(link->inverse_unit * w, vec_perp(at->b[i])));
    }
    return rate;
}

static double largest(struct vec a)
{
    return fmax(fabs(a.x), fabs(a.y));
}

/* To rounding, which is where it gets no less. */
static bool close_gap(const struct tree_loop *loop, double *q, struct look *at)
{
    enum { most = 8 };
    const double far = 1e-2 * loop->size;
    double size = loop->size, before = far;
    for (int i = 0; i < 3; i++)
        if (!loop->links[i].turns) size += fabs(q[loop->links[i].coordinate]);
    for (int k = 0; k < most; k++) {
        *at = look_at(loop, q);
        double off = largest(at->gap);
        if (!(at->norm > loop->least && at->inertia > 1e-2 * at->norm && off <= far)) return false;
        if (off <= 16 * DBL_EPSILON * size || off > 0.9 * before) return off <= 1e3 * DBL_EPSILON * size;
        mend(loop, at, at->gap, q);
        before = off;
    }
    return false;
}

bool tree_loop_return(const struct tree_loop *loop, double *y)
{
    double before[3];
    struct look at;
    memcpy(before, y, sizeof before);
    if (!close_gap(loop, y, &at)) {
        memcpy(y, before, sizeof before);
        return false;
    }
    mend(loop, &at, rate_of(loop, &at, y + 3), y + 3);
    return true;
}
