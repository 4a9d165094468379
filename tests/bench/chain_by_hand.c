/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The yardstick: an O(n) recursion for this one chain and nothing else.
 *
 * With d the vector from the pin of a rod to its end, u = k x d and w its absolute rate of turning:
 *
 *   outward  the acceleration of each pin if no rod had an angular one, a_next = a - w^2 d, where the ground
 *            accelerates upward by g instead of gravity
 *   inward   what the rod and all below it answer at its pin to an acceleration A of the pin beside a and an
 *            angular one: a moment J alpha + h . A + c and a force h alpha + M A + f. The joint leaves
 *            alpha = -(c + h . A) / J to the rod, so that the rod before gets
 *                M - h h^T / J,   f - h c / J
 *            at its end, and with its own u and m at its own pin
 *                J = m l^2 / 3 + u . M u - (h . u)^2 / J,   h = m u / 2 + M u - h (h . u) / J
 *   outward  alpha, and A_next = A + alpha u
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
    double J = own, hx = 0, hy = 0, xx = 0, xy = 0, yy = 0, fx = 0, fy = 0;
    for (int i = chain->n - 1; i >= 0; i--) {
        struct rod *rod = &chain->rods[i];
        hx -= m / 2 * rod->dy;
        hy += m / 2 * rod->dx;
        xx += m;
        yy += m;
        double D = 1 / J, turn = -D * (rod->moment + rod->dx * fy - rod->dy * fx);
        rod->hx = D * hx;
        rod->hy = D * hy;
        rod->turn = turn;
        fx += rod->fx + turn * hx;
        fy += rod->fy + turn * hy;
        if (i == 0) break;
        double ux = -rod[-1].dy, uy = rod[-1].dx, x = xx * ux + xy * uy, y = xy * ux + yy * uy;
        double hu = hx * ux + hy * uy;
        J = own + (x * ux + y * uy) - D * (hu * hu);
        xx -= D * (hx * hx);
        xy -= D * (hx * hy);
        yy -= D * (hy * hy);
        double share = D * hu, oldx = hx, oldy = hy;
        hx = x - share * oldx;
        hy = y - share * oldy;
    }
}

static void chain_rates(void *data, const double *y, double *dydt)
{
    struct chain *chain = data;
    int n = chain->n;
    outward(chain, y, y + n);
    inward(chain);
    double before = 0, Ax = 0, Ay = 0;
    for (int i = 0; i < n; i++) {
        const struct rod *rod = &chain->rods[i];
        double alpha = rod->turn - (rod->hx * Ax + rod->hy * Ay);
        dydt[i] = y[n + i];
        dydt[n + i] = alpha - before;
        Ax -= alpha * rod->dy;
        Ay += alpha * rod->dx;
        before = alpha;
    }
}

const struct chain_solver chain_by_hand = {"by hand", chain_open, chain_rates, free};
