/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Projection onto the pin of a loop, by Newton's method: changes u of the links that cancel its error, sum
 * u_j k x b_j = -g, with u . M N = 0, so that u . M u is least (Hairer and Wanner II, VII.2).
 */
#include <float.h>
#include <string.h>

#include "base/sine.h"
#include "dynamics/tree_loop.h"
#include "numeric/tolerances.h"

/* The loop at y: its vectors, the coupling inertias, the free motion N with K = M N, and the error of the
 * pin. */
struct look {
    double angle[3];
    struct vec turn[3], b[3], gap;
    double c01, c02, c12;
    double N[3], K[3], norm, inertia;
};

static bool goes_on(const struct tree_loop *loop, int i)
{
    return i == 1 || (i == 2 && loop->chain);
}

/* Turn the links to y. `known`: `at` is the loop at another y. */
static void turn_links(const struct tree_loop *loop, const double *y, bool known, struct look *at)
{
    double angle = 0;
    for (int i = 0; i < 3; i++) {
        const struct tree_loop_link *link = &loop->links[i];
        angle = goes_on(loop, i) ? angle + link->along : link->along;
        if (link->turns) angle += y[link->coordinate];
        if (!link->turns)
            at->turn[i] = (struct vec){1, 0};
        else
            at->turn[i] = known ? unit_turned_on(at->turn[i], at->angle[i], angle) : unit_by_sine(angle);
        at->angle[i] = angle;
    }
}

/* After the links are turned. */
static void set_free_motion(const struct tree_loop *loop, const struct vec *S, struct look *at)
{
    at->c01 = vec_dot(at->b[0], S[1]);
    at->c02 = loop->chain ? vec_dot(at->b[0], S[2]) : 0;
    at->c12 = loop->chain ? vec_dot(at->b[1], S[2]) : 0;
    for (int i = 0; i < 3; i++) at->N[i] = vec_cross(at->b[(i + 1) % 3], at->b[(i + 2) % 3]);
    at->K[0] = at->N[0] + at->c01 * at->N[1] + at->c02 * at->N[2];
    at->K[1] = at->c01 * at->N[0] + at->N[1] + at->c12 * at->N[2];
    at->K[2] = at->c02 * at->N[0] + at->c12 * at->N[1] + at->N[2];
    at->norm = at->N[0] * at->N[0] + at->N[1] * at->N[1] + at->N[2] * at->N[2];
    at->inertia = at->N[0] * at->K[0] + at->N[1] * at->K[1] + at->N[2] * at->K[2];
}

static void look_at(const struct tree_loop *loop, const double *y, bool known, struct look *at)
{
    struct vec S[3];
    turn_links(loop, y, known, at);
    at->gap = loop->gap;
    for (int i = 0; i < 3; i++) {
        const struct tree_loop_link *link = &loop->links[i];
        at->b[i] = vec_turn(at->turn[i], link->b);
        S[i] = vec_turn(at->turn[i], link->S);
        struct vec way = link->turns ? at->b[i] : vec_scale(y[link->coordinate], vec_perp(at->b[i]));
        at->gap = vec_add(at->gap, vec_scale(link->inverse_unit, way));
    }
    set_free_motion(loop, S, at);
}

/* Add to x, coordinates or rates, the change that moves the point of the pin by -off. */
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

/* The velocities of the links in the world, in their units. */
static void set_motion(const struct tree_loop *loop, const double *v, double *u)
{
    double w = 0;
    for (int i = 0; i < 3; i++) {
        const struct tree_loop_link *link = &loop->links[i];
        w = goes_on(loop, i) && link[-1].turns ? w + v[link->coordinate] : v[link->coordinate];
        u[i] = link->inverse_unit * w;
    }
}

static struct vec rate_of(const struct look *at, const double *u)
{
    struct vec sum =
        vec_add(vec_scale(u[0], at->b[0]), vec_add(vec_scale(u[1], at->b[1]), vec_scale(u[2], at->b[2])));
    return vec_perp(sum);
}

static struct tree_loop_sight sight(const struct look *at, const double *u)
{
    double own = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    double shared = at->c01 * u[0] * u[1] + at->c02 * u[0] * u[2] + at->c12 * u[1] * u[2];
    return (struct tree_loop_sight){at->gap, rate_of(at, u), own / 2 + shared};
}

static double largest(struct vec a)
{
    return fmax(fabs(a.x), fabs(a.y));
}

/* Iterate to rounding, until the error no longer decreases. `at` is the loop at q, before and after. */
static bool close_gap(const struct tree_loop *loop, double *q, struct look *at)
{
    enum { most = 8 };
    const double far = 1e-2 * loop->size;
    double size = loop->size, before = far;
    for (int i = 0; i < 3; i++)
        if (!loop->links[i].turns) size += fabs(q[loop->links[i].coordinate]);
    for (int k = 0; k < most; k++) {
        double off = largest(at->gap);
        if (!(at->norm > loop->least && at->inertia > 1e-2 * at->norm && off <= far)) return false;
        if (off <= round_off(16, size) || off > 0.9 * before) return off <= round_off(1000, size);
        mend(loop, at, at->gap, q);
        before = off;
        look_at(loop, q, true, at);
    }
    return false;
}

bool tree_loop_close(const struct tree_loop *loop, double *y, struct tree_loop_closing *closing)
{
    double start[3], u[3];
    struct look at = {.norm = 0};
    memcpy(start, y, sizeof start);
    look_at(loop, y, false, &at);
    set_motion(loop, y + 3, u);
    closing->before = sight(&at, u);
    if (!close_gap(loop, y, &at)) {
        memcpy(y, start, sizeof start);
        return false;
    }
    mend(loop, &at, rate_of(&at, u), y + 3);
    set_motion(loop, y + 3, u);
    closing->after = sight(&at, u);
    for (int i = 1; i < 4; i++) closing->turn[i] = at.turn[loop->of[i] - loop->links];
    return true;
}

bool tree_loop_return(const struct tree_loop *loop, double *y)
{
    struct tree_loop_closing closing;
    return tree_loop_close(loop, y, &closing);
}
