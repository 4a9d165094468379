/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds/impact.h"
#include "numeric/tolerances.h"

#include <math.h>

/* A point of the path in terms of p, with the work of the normal impulse so far. */
struct place {
    double p, tau, v_n, v_t, work;
};

/* Derivatives by p on a segment of the path. */
struct slope {
    double f, v_n, v_t;
};

static struct slope slope_with(const struct impact_point *point, double f)
{
    const double *W = point->W;
    return (struct slope){f, W[0] + W[1] * f, W[1] + W[2] * f};
}

/* At v_t = 0 the point sticks if friction suffices, else it slips in the direction of W_nt. */
static struct slope slope_at(const struct impact_point *point, const struct place *at)
{
    const double *W = point->W;
    if (at->v_t != 0) return slope_with(point, at->v_t > 0 ? -point->mu : point->mu);
    if (fabs(W[1]) > point->mu * W[2]) return slope_with(point, W[1] > 0 ? -point->mu : point->mu);
    struct slope slope = slope_with(point, W[2] > 0 ? -W[1] / W[2] : 0);
    slope.v_t = 0;
    return slope;
}

/* The impulse until v_t = 0. */
static double until_rest(const struct place *at, const struct slope *slope)
{
    return at->v_t * slope->v_t < 0 ? -at->v_t / slope->v_t : HUGE_VAL;
}

static void go(struct place *at, const struct slope *slope, double dp, double rest)
{
    at->work += dp * (at->v_n + slope->v_n * dp / 2);
    at->p += dp;
    at->tau += slope->f * dp;
    at->v_n += slope->v_n * dp;
    at->v_t = dp >= rest ? 0 : at->v_t + slope->v_t * dp;
}

/* Is W of rank one, to rounding? */
static bool is_on_a_line(const struct impact_point *point)
{
    const double rounding = negligible_sum, *W = point->W;
    return W[2] > 0 && W[0] * W[2] - W[1] * W[1] <= rounding * W[0] * W[2];
}

/* Is the point sticking with W of rank one, so that its velocity cannot change? */
static bool is_locked(const struct impact_point *point, const struct place *at)
{
    return at->v_t == 0 && is_on_a_line(point) && fabs(point->W[1]) <= point->mu * point->W[2];
}

/* Compression. Friction of a slipping point may first increase the approach; the slip then ends, as W is
 * positive definite, and compression ends after it. False where the point is locked before. */
static bool compress(const struct impact_point *point, struct place *at)
{
    enum { most_pieces = 3 };
    const double at_once = undecided_part * -at->v_n;
    for (int piece = 0; piece < most_pieces && at->v_n < 0; piece++) {
        if (is_locked(point, at)) return false;
        struct slope slope = slope_at(point, at);
        double rest = until_rest(at, &slope), end = slope.v_n > 0 ? -at->v_n / slope.v_n : HUGE_VAL;
        go(at, &slope, fmin(rest, end), rest);
        if (end <= rest) at->v_n = 0;
        if (is_on_a_line(point) && fabs(at->v_n) <= at_once && fabs(at->v_t) <= at_once)
            at->v_n = at->v_t = 0;
    }
    return at->v_n >= 0;
}

/* The remaining impulse of restitution on a segment without an end of slip. */
static double until_end(const struct impact_point *point, const struct place *at, const struct slope *slope,
                        const struct place *compressed, double approach)
{
    double e = point->e, due;
    switch (point->law) {
    case impact_poisson: return (1 + e) * compressed->p - at->p;
    case impact_newton:
    case impact_moreau: return (e * approach - at->v_n) / slope->v_n;
    case impact_stronge: break;
    }
    due = -e * e * compressed->work - (at->work - compressed->work);
    return due > 0 ? 2 * due / (at->v_n + sqrt(at->v_n * at->v_n + 2 * slope->v_n * due)) : 0;
}

/* Restitution. A locked point has none, whatever the law. */
static void restore(const struct impact_point *point, struct place *at, double approach)
{
    enum { most_pieces = 3 };
    const struct place compressed = *at;
    for (int piece = 0; piece < most_pieces; piece++) {
        if (is_locked(point, at)) return;
        struct slope slope = slope_at(point, at);
        double rest = until_rest(at, &slope), end = until_end(point, at, &slope, &compressed, approach);
        if (end > 0) go(at, &slope, fmin(rest, end), rest);
        if (end <= rest) break;
    }
}

/* ---- the laws */

/* Laws along the path, segment by segment. */
static bool follow(const struct impact_point *point, struct place *at, struct impact *impact)
{
    double approach = -at->v_n;
    if (!compress(point, at)) return false;
    impact->compression = at->p;
    if (point->e > 0) restore(point, at, approach);
    return true;
}

/* With v_n = -e v_n before and friction -mu p for slip to `side`: is that the direction of v_t after? */
static bool slips_after(const struct impact_point *point, const struct place *before, int side,
                        struct place *after)
{
    struct slope slope = slope_with(point, -side * point->mu);
    if (!(slope.v_n > 0)) return false;
    *after = *before;
    go(after, &slope, -(1 + point->e) * before->v_n / slope.v_n, HUGE_VAL);
    return after->v_t * side > 0;
}

/* With friction that stops the point, W [p, tau] = [-(1 + e) v_n, -v_t]: is it within its limit? */
static bool sticks_after(const struct impact_point *point, const struct place *before, struct place *after)
{
    const double *W = point->W, det = W[0] * W[2] - W[1] * W[1], lift = -(1 + point->e) * before->v_n;
    if (is_on_a_line(point) || !(det > 0)) return false;
    *after = (struct place){.p = (W[2] * lift + W[1] * before->v_t) / det,
                            .tau = -(W[0] * before->v_t + W[1] * lift) / det};
    return fabs(after->tau) <= point->mu * after->p;
}

/* With W of rank one: does the line of velocities pass through rest? */
static bool leads_to_rest(const struct impact_point *point, const struct place *before)
{
    const double rounding = undecided_part, *W = point->W;
    return is_on_a_line(point) &&
           fabs(before->v_t - W[1] / W[0] * before->v_n) <= rounding * hypot(before->v_n, before->v_t);
}

/* Moreau's law. If several results are consistent it is the first along the path: continued slip, sticking,
 * reversed slip. Without friction, and at a limit, the last is any of them. */
static bool jump(const struct impact_point *point, struct place *at, struct impact *impact)
{
    const struct place before = *at;
    int side = before.v_t < 0 ? -1 : 1;
    bool to_rest = leads_to_rest(point, &before);
    if (to_rest && point->e == 0) return follow(point, at, impact);
    bool on = before.v_t != 0 && slips_after(point, &before, side, at);
    bool found = on || sticks_after(point, &before, at) || slips_after(point, &before, -side, at);
    if (!found && to_rest) {
        *at = before;
        return follow(point, at, impact);
    }
    if (!found && is_on_a_line(point)) return false;
    if (!found) slips_after(point, &before, side, at);
    at->v_n = -point->e * before.v_n;
    impact->compression = at->p / (1 + point->e);
    return true;
}

struct impact impact_at_point(const struct impact_point *point, double v_n, double v_t)
{
    struct place at = {.v_n = v_n, .v_t = v_t};
    struct impact impact = {.v_n = v_n, .v_t = v_t};
    if (!(v_n < 0)) return impact;
    bool ends = point->law == impact_moreau ? jump(point, &at, &impact) : follow(point, &at, &impact);
    if (!ends) {
        impact.slip = impact_jams;
        return impact;
    }
    impact.p = at.p;
    impact.tau = at.tau;
    impact.v_n = at.v_n;
    impact.v_t = at.v_t;
    impact.work = (at.p * (v_n + at.v_n) + at.tau * (v_t + at.v_t)) / 2;
    impact.slip = at.v_t == 0 ? impact_sticks : at.v_t * v_t < 0 ? impact_reverses : impact_slips;
    return impact;
}
