/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The yardstick: an O(n) recursion for this one chain and nothing else.
 *
 * With d the vector from the pin of a rod to its end, u = k x d and w its absolute rate of turning:
 *
 *   outward  the acceleration of each pin if no rod had an angular one, a_next = a - w^2 d, where the ground
 *            accelerates upward by g instead of gravity
 *   inward   what the rod and all below it answer at its pin to an acceleration A of the pin beside a:
 *            a force M A + f. For the rod alone and (M', f') at its end,
 *                J = m l^2 / 3 + u . M' u,   h = m u / 2 + M' u,   moment = d x (m a / 2 + f')
 *                M = m 1 + M' - h h^T / J,   f = m (a - w^2 d / 2) + f' - h moment / J
 *   outward  alpha = -(moment + h . A) / J,  A_next = A + alpha u
 */
#include <math.h>
#include <stdlib.h>

#include "chain.h"

struct rod {
    double dx, dy;         /* d */
    double fx, fy, moment; /* of the rod alone, on its course without angular accelerations */
    double hx, hy, turn;   /* h / J and -moment / J */
};

struct chain {
    int n;
    struct rod rods[];
};

static void *chain_open(int n)
{
    struct chain *chain = calloc(1, sizeof *chain + (size_t)n * sizeof chain->rods[0]);
    if (chain) chain->n = n;
    return chain;
}

static void outward(struct chain *chain, const double *q, const double *v)
{
    const double m = CHAIN_MASS, l = CHAIN_LENGTH;
    double angle = 0, w = 0, ax = 0, ay = CHAIN_GRAVITY;
    for (int i = 0; i < chain->n; i++) {
        struct rod *rod = &chain->rods[i];
        angle += q[i];
        w += v[i];
        double dx = l * sin(angle), dy = -l * cos(angle), cx = w * w * dx, cy = w * w * dy;
        rod->dx = dx;
        rod->dy = dy;
        rod->fx = m * (ax - cx / 2);
        rod->fy = m * (ay - cy / 2);
        rod->moment = m / 2 * (dx * ay - dy * ax);
        ax -= cx;
        ay -= cy;
    }
}

static void inward(struct chain *chain)
{
    const double m = CHAIN_MASS, own = CHAIN_MASS * CHAIN_LENGTH * CHAIN_LENGTH / 3;
    double xx = 0, xy = 0, yy = 0, fx = 0, fy = 0; /* M' and f' */
    for (int i = chain->n - 1; i >= 0; i--) {
        struct rod *rod = &chain->rods[i];
        double ux = -rod->dy, uy = rod->dx, x = xx * ux + xy * uy, y = xy * ux + yy * uy;
        double D = 1 / (own + ux * x + uy * y), hx = m / 2 * ux + x, hy = m / 2 * uy + y;
        double turn = -D * (rod->moment + ux * fx + uy * fy);
        rod->hx = D * hx;
        rod->hy = D * hy;
        rod->turn = turn;
        xx += m - rod->hx * hx;
        xy -= rod->hx * hy;
        yy += m - rod->hy * hy;
        fx += rod->fx + turn * hx;
        fy += rod->fy + turn * hy;
    }
}

static void chain_accelerations(void *data, const double *q, const double *v, double *a)
{
    struct chain *chain = data;
    outward(chain, q, v);
    inward(chain);
    double before = 0, Ax = 0, Ay = 0;
    for (int i = 0; i < chain->n; i++) {
        const struct rod *rod = &chain->rods[i];
        double alpha = rod->turn - (rod->hx * Ax + rod->hy * Ay);
        a[i] = alpha - before;
        Ax -= alpha * rod->dy;
        Ay += alpha * rod->dx;
        before = alpha;
    }
}

const struct chain_solver chain_by_hand = {"by hand", chain_open, chain_accelerations, free};
