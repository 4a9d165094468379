/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "impact_by_steps.h"

#include <math.h>
#include <stdbool.h>

enum { steps_of_an_impact = 200, most_steps = 10000000 };

/* On the way: velocities and impulses along normal and tangent, and the work of the normal one. */
struct way {
    double v[2], P[2], work;
    bool restores;
    double compression, spent; /* impulse and work of compression */
};

static double friction_on(const struct point_by_steps *point, const struct way *way)
{
    const double *W = point->W, mu = point->mu;
    if (way->v[1] != 0) return way->v[1] > 0 ? -mu : mu;
    return fmax(-mu, fmin(mu, -W[1] / W[2])); /* it holds it, or as much as it can */
}

static struct way gone_on(const struct point_by_steps *point, const struct way *way, double f, double dp)
{
    const double *W = point->W;
    struct way next = *way;
    bool sticks = way->v[1] == 0 && fabs(W[1] + W[2] * f) <= 1e-14 * W[2];
    next.v[0] += (W[0] + W[1] * f) * dp;
    next.v[1] += sticks ? 0 : (W[1] + W[2] * f) * dp;
    next.P[0] += dp;
    next.P[1] += f * dp;
    next.work += dp * (way->v[0] + next.v[0]) / 2;
    return next;
}

static bool is_over(const struct point_by_steps *point, const struct way *way, double approach)
{
    if (!way->restores) return way->v[0] >= 0;
    switch (point->law) {
    case steps_poisson: return way->P[0] >= (1 + point->e) * way->compression;
    case steps_newton: return way->v[0] >= point->e * approach;
    default: return way->work - way->spent >= -point->e * point->e * way->spent;
    }
}

static void follow(const struct point_by_steps *point, struct way *way)
{
    const double approach = -way->v[0], whole = approach / point->W[0] / steps_of_an_impact;
    for (int k = 0; k < most_steps && !(way->restores && is_over(point, way, approach)); k++) {
        double f = friction_on(point, way), low = 0, high = whole;
        struct way next = gone_on(point, way, f, high);
        bool turns = next.v[1] * way->v[1] < 0;
        if (turns) next = gone_on(point, way, f, high = -way->v[1] / (next.v[1] - way->v[1]) * high);
        bool over = is_over(point, &next, approach);
        for (int half = 0; half < 100 && over; half++) {
            double middle = (low + high) / 2;
            struct way there = gone_on(point, way, f, middle);
            if (is_over(point, &there, approach))
                high = middle;
            else
                low = middle;
        }
        if (over) next = gone_on(point, way, f, high);
        *way = next;
        if (turns && !over) way->v[1] = 0;
        if (!over) continue;
        if (way->restores) return;
        way->restores = true;
        way->compression = way->P[0];
        way->spent = way->work;
        way->v[0] = fmax(way->v[0], 0);
    }
}

/* Moreau's law: the impulses of each friction cone's edge and of sticking, and which agrees with what comes after: of
 * several, what slips on, then what sticks. */
static void choose(const struct point_by_steps *point, struct way *way)
{
    const double *W = point->W, want = -(1 + point->e) * way->v[0];
    const double ways[3] = {way->v[1] < 0 ? -1 : 1, 0, way->v[1] < 0 ? 1 : -1};
    for (int k = 0; k < 3; k++) {
        double side = ways[k], p = want / (W[0] - side * point->mu * W[1]), tau = -side * point->mu * p;
        if (side == 0) {
            double det = W[0] * W[2] - W[1] * W[1];
            p = (W[2] * want + W[1] * way->v[1]) / det;
            tau = -(W[0] * way->v[1] + W[1] * want) / det;
        }
        double after = side == 0 ? 0 : way->v[1] + W[1] * p + W[2] * tau;
        bool agrees = side == 0 ? fabs(tau) <= point->mu * p : p > 0 && after * side > 0;
        if (!agrees) continue;
        *way = (struct way){.v = {-point->e * way->v[0], after}, .P = {p, tau}};
        return;
    }
}

void impact_by_steps(const struct point_by_steps *point, double *v, double *P)
{
    struct way way = {.v = {v[0], v[1]}};
    P[0] = P[1] = 0;
    if (!(v[0] < 0)) return;
    if (point->law == steps_moreau)
        choose(point, &way);
    else
        follow(point, &way);
    for (int k = 0; k < 2; k++) v[k] = way.v[k], P[k] = way.P[k];
}
