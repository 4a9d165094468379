/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/scan.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* A function that needs more samples of one interval is too fast for it, or noise. */
enum { most_depth = 30, most_samples = 4096 };

struct scan_point {
    double t;
    double *values, *rates;
    double *doubt; /* how far the functions may be from their cubic in the interval that ends here */
};

bool scan_init(struct scan *scan, size_t count, scan_sampler *sample, void *context)
{
    enum { points = most_depth + 4, arrays = 3 };
    *scan = (struct scan){.count = count, .sample = sample, .context = context, .known = NAN};
    scan->points = calloc(points, sizeof *scan->points);
    scan->memory = calloc(count * points * arrays + 1, sizeof *scan->memory);
    scan->rough = calloc(4 * count + 1, sizeof *scan->rough);
    if (!scan->points || !scan->memory || !scan->rough) {
        scan_free(scan);
        return false;
    }
    scan->crossed = scan->rough + count;
    scan->sampled = scan->crossed + count;
    scan->chosen = scan->sampled + count;
    for (size_t i = 0; i < count; i++) scan->sampled[i] = true;
    double *next = scan->memory;
    for (int i = 0; i < points; i++, next += arrays * count)
        scan->points[i] = (struct scan_point){0, next, next + count, next + 2 * count};
    return true;
}

void scan_free(struct scan *scan)
{
    free(scan->prover.now);
    free(scan->prover.waiting);
    free(scan->points);
    free(scan->memory);
    free(scan->rough);
    *scan = (struct scan){0};
}

bool scan_use_enclosures(struct scan *scan, struct proof_group *groups, size_t count, proof_enclose *enclose,
                         scan_follower *follow)
{
    size_t most = 0;
    for (size_t g = 0; g < count; g++)
        if (groups[g].count > most) most = groups[g].count;
    scan->prover = (struct prover){.enclose = enclose,
                                   .context = scan->context,
                                   .now = calloc(2 * most + 1, sizeof *scan->prover.now),
                                   .waiting = calloc(most + 1, sizeof *scan->prover.waiting)};
    if (!scan->prover.now || !scan->prover.waiting) return false;
    scan->prover.end = scan->prover.now + most;
    scan->groups = groups;
    scan->group_count = count;
    scan->follow = follow;
    return true;
}

/* ---- the cubic through values and rates at both ends, on s in [0, 1]: c0 + c1 s + c2 s^2 + c3 s^3 */

struct cubic {
    double c0, c1, c2, c3;
};

static struct cubic cubic_between(const struct scan_point *a, const struct scan_point *b, size_t i)
{
    double h = b->t - a->t, d = b->values[i] - a->values[i], ra = h * a->rates[i], rb = h * b->rates[i];
    return (struct cubic){a->values[i], ra, 3 * d - 2 * ra - rb, ra + rb - 2 * d};
}

static double cubic_at(const struct cubic *c, double s)
{
    return c->c0 + s * (c->c1 + s * (c->c2 + s * c->c3));
}

/* The place of the interior minimum, or -1. The minimum of a cubic is the zero of its slope where the
 * curvature is positive. */
static double cubic_minimum(const struct cubic *c)
{
    double root = c->c2 * c->c2 - 3 * c->c3 * c->c1;
    if (!(root > 0)) return -1;
    double q = c->c2 + copysign(sqrt(root), c->c2); /* the stable form of the quadratic formula */
    double first = q != 0 ? -c->c1 / q : -1, second = c->c3 != 0 ? -q / (3 * c->c3) : -1;
    const double s[2] = {first, second};
    for (int k = 0; k < 2; k++)
        if (s[k] > 0 && s[k] < 1 && c->c2 + 3 * c->c3 * s[k] > 0) return s[k];
    return -1;
}

/* A zero of a cubic that changes sign from + to - over [0, 1]: Newton kept inside a shrinking bracket. */
static double cubic_zero(const struct cubic *c)
{
    double low = 0, high = 1, s = c->c0 / (c->c0 - cubic_at(c, 1));
    for (int i = 0; i < 60 && high - low > DBL_EPSILON; i++) {
        if (!(s > low && s < high)) s = (low + high) / 2;
        double value = cubic_at(c, s), slope = c->c1 + s * (2 * c->c2 + s * 3 * c->c3);
        if (value >= 0)
            low = s;
        else
            high = s;
        double next = slope != 0 ? s - value / slope : -1;
        if (fabs(next - s) <= DBL_EPSILON) return s;
        s = next;
    }
    return s;
}

/* ---- looking */

static int take_sample(struct scan *scan, struct scan_point *point, double t)
{
    point->t = t;
    scan->samples++;
    return scan->sample(scan->context, t, point->values, point->rates);
}

static bool active(const struct scan_point *a, const struct scan_point *b, size_t i)
{
    return a->values[i] < HUGE_VAL && b->values[i] < HUGE_VAL;
}

static bool crosses(const struct scan_point *a, const struct scan_point *b, size_t i)
{
    return active(a, b, i) && a->values[i] >= 0 && b->values[i] < 0;
}

static bool any_crosses(const struct scan *scan, const struct scan_point *a, const struct scan_point *b)
{
    for (size_t i = 0; i < scan->count; i++)
        if (scan->chosen[i] && crosses(a, b, i)) return true;
    return false;
}

/* Does function i ask for a sample inside (a, b)? */
static bool doubtful(const struct scan_point *a, const struct scan_point *b, size_t i)
{
    if (!active(a, b, i)) return false;
    double doubt = b->doubt[i], size = fmax(fabs(a->values[i]), fabs(b->values[i]));
    if (doubt > size / 16) return true; /* the cubic is not the function: nothing it says can be believed */
    if (a->values[i] < 0 || b->values[i] < 0) return false;
    struct cubic c = cubic_between(a, b, i);
    double s = cubic_minimum(&c);
    /* A minimum well above zero needs no second look; at zero itself (a start from rest) there is none
     * inside. */
    return s > 0 && cubic_at(&c, s) - doubt < 0;
}

static bool any_doubtful(const struct scan *scan, const struct scan_point *a, const struct scan_point *b)
{
    for (size_t i = 0; i < scan->count; i++)
        if (scan->chosen[i] && doubtful(a, b, i)) return true;
    return false;
}

/* How far function i is from its cubic at m, in value and in slope: a function that repeats itself may have
 * the right value there by chance, hardly the right slope as well. (The error K s^2 (1-s)^2 of a cubic has a
 * slope that is small beside it near the middle.) */
static double discrepancy(const struct scan_point *a, const struct scan_point *m, const struct scan_point *b,
                          size_t i)
{
    struct cubic c = cubic_between(a, b, i);
    double h = b->t - a->t, s = (m->t - a->t) / h, slope = c.c1 + s * (2 * c.c2 + s * 3 * c.c3);
    return fmax(fabs(m->values[i] - cubic_at(&c, s)), fabs(h * m->rates[i] - slope) / 4);
}

/* Compare the sample m with the cubics between a and b. The error of a cubic falls with the fourth power of
 * the interval; a quarter is a safe share for each half. Returns the largest doubt relative to how much its
 * function changes. */
static double set_doubts(const struct scan *scan, const struct scan_point *a, struct scan_point *m,
                         struct scan_point *b)
{
    double worst = 0;
    for (size_t i = 0; i < scan->count; i++) {
        m->doubt[i] = 0;
        if (!scan->chosen[i] || !scan->rough[i] || !active(a, b, i) || !(m->values[i] < HUGE_VAL)) {
            b->doubt[i] = 0;
            continue;
        }
        double off = discrepancy(a, m, b, i);
        double change = fabs(m->values[i] - a->values[i]) + fabs(b->values[i] - m->values[i]);
        double size = fabs(a->values[i]) + fabs(m->values[i]) + fabs(b->values[i]);
        if (off <= 64 * DBL_EPSILON * size) off = 0;
        if (change > 0 && off / change > worst) worst = off / change;
        m->doubt[i] = b->doubt[i] = off / 4;
    }
    return worst;
}

/* ---- the first zero between a (none negative that was not) and b (at least one negative) */

/* The estimate of the first zero from the cubics of all functions that cross. */
static double first_estimate(const struct scan *scan, const struct scan_point *a, const struct scan_point *b)
{
    double first = 1;
    for (size_t i = 0; i < scan->count; i++) {
        if (!scan->chosen[i] || !crosses(a, b, i)) continue;
        struct cubic c = cubic_between(a, b, i);
        double s = cubic_zero(&c);
        if (s < first) first = s;
    }
    return a->t + first * (b->t - a->t);
}

static void exchange(struct scan_point *x, struct scan_point *y)
{
    struct scan_point spare = *x;
    *x = *y;
    *y = spare;
}

static double roundings(const struct scan_point *a, const struct scan_point *b)
{
    return 2 * DBL_EPSILON * fmax(fabs(a->t), fabs(b->t));
}

/* Shrink [a, b] until b is within two roundings of the zero, by its cubic at least. The cubics converge to
 * the zero fast but from one side, so once an estimate stops moving the other side is fetched by steps that
 * grow from a rounding; where four steps together gain less than an eighth, one is a bisection, so that
 * nothing is slow. `m` is a spare point. */
static int locate(struct scan *scan, struct scan_point *a, struct scan_point *b, struct scan_point *m)
{
    double reach = roundings(a, b),
           before = b->t - a->t; /* b may be far away at first, its roundings large */
    for (int step = 1; b->t - a->t > roundings(a, b); step++) {
        double t = first_estimate(scan, a, b), width = b->t - a->t;
        if (b->t - t <= roundings(a, b)) break;
        bool slow = step % 4 == 0 && width > before / 8;
        if (step % 4 == 0) before = width;
        if (slow)
            t = a->t + width / 2;
        else if (t - a->t < reach)
            t = a->t + fmin(reach, width / 2), reach *= 8;
        else if (b->t - t < reach)
            t = b->t - fmin(reach, width / 2), reach *= 8;
        if (!(t > a->t && t < b->t)) break;
        int status = take_sample(scan, m, t);
        if (status) return status;
        exchange(m, any_crosses(scan, a, m) ? b : a);
    }
    scan->t = b->t;
    for (size_t i = 0; i < scan->count; i++) scan->crossed[i] = scan->chosen[i] && crosses(a, b, i);
    return 1;
}

/* Nothing more can be learned between a and b: it is clear, or has the first zero. */
static int conclude(struct scan *scan, struct scan_point *a, struct scan_point *b, struct scan_point *spare)
{
    if (any_crosses(scan, a, b)) return locate(scan, a, b, spare);
    scan->clear = b->t;
    return 0;
}

static int look(struct scan *scan, struct scan_point *a, struct scan_point *b, int depth)
{
    struct scan_point *m = &scan->points[3 + depth];
    double t = a->t + (b->t - a->t) / 2;
    bool deeper = depth < most_depth && t > a->t && t < b->t && any_doubtful(scan, a, b);
    if (!deeper) return conclude(scan, a, b, m);
    if (scan->samples >= scan->most) return 2;
    int status = take_sample(scan, m, t);
    if (status) return status;
    set_doubts(scan, a, m, b);
    status = look(scan, a, m, depth + 1);
    return status ? status : look(scan, m, b, depth + 1);
}

/* The sample at the start of an interval, which may be the one at the end of the last. */
static int take_first_sample(struct scan *scan, double from)
{
    struct scan_point *a = &scan->points[0], *b = &scan->points[1];
    if (from != scan->known) return take_sample(scan, a, from);
    exchange(a, b);
    return 0;
}

void scan_forget(struct scan *scan)
{
    scan->known = NAN;
    for (size_t g = 0; g < scan->group_count; g++) scan->groups[g].clear = NAN;
}

/* The sampler may say something else at a start than at an end of a function that is below zero. */
static bool none_negative(const struct scan *scan, const struct scan_point *point)
{
    for (size_t i = 0; i < scan->count; i++)
        if (scan->chosen[i] && !(point->values[i] >= 0)) return false;
    return true;
}

/* One panel, by samples of the chosen functions. */
static int look_at_panel(struct scan *scan, double from, double to)
{
    struct scan_point *a = &scan->points[0], *b = &scan->points[1], *m = &scan->points[2];
    int status = take_first_sample(scan, from);
    scan->known = NAN;
    if (!status) status = take_sample(scan, b, to);
    /* Not the middle: a periodic function would fool it most easily there. */
    if (!status) status = take_sample(scan, m, from + 0.4690 * (to - from));
    if (status) return status;
    for (size_t i = 0; i < scan->count; i++) b->doubt[i] = 0;
    double off = set_doubts(scan, a, m, b);
    if (off > 0.1) scan->resolved = fmin(scan->resolved, (off > 2 ? 0.5 : 2) * (to - from));
    status = look(scan, a, m, 0);
    if (!status) status = look(scan, m, b, 0);
    if (!status && none_negative(scan, b)) scan->known = to;
    return status;
}

static int look_by_samples(struct scan *scan, double from, double to)
{
    bool any = false;
    for (size_t i = 0; i < scan->count; i++) any |= scan->chosen[i] = scan->sampled[i];
    scan->clear = any ? from : to;
    if (any) scan->located = false;
    scan->most = scan->samples + most_samples;
    double panels = scan->panels > 1 ? (double)scan->panels : 1, begin = from;
    for (double k = 1; any && k <= panels; k++) {
        double end = k < panels ? from + (to - from) * (k / panels) : to;
        if (!(end > begin)) continue;
        if (scan->samples >= scan->most) return 2;
        int status = look_at_panel(scan, begin, end);
        if (status) return status;
        begin = end;
    }
    return 0;
}

/* ---- with enclosures */

/* The zero that group g has in its bracket, in scan->t. 0 when samples say that there is none: enclosures and
 * samples differ by roundings. */
static int locate_in_group(struct scan *scan, struct proof_group *group)
{
    struct scan_point *a = &scan->points[0], *b = &scan->points[1];
    scan->known = NAN;
    int status = take_sample(scan, a, group->low);
    if (!status) status = take_sample(scan, b, group->high);
    if (status) return status;
    for (size_t i = 0; i < scan->count; i++) {
        scan->chosen[i] = i >= group->first && i < group->first + group->count;
        if (a->values[i] < 0) a->values[i] = 0; /* to rounding, or where the search began */
    }
    if (!any_crosses(scan, a, b)) return 0;
    status = locate(scan, a, b, &scan->points[2]);
    group->clear = group->low = scan->points[0].t;
    group->high = scan->points[1].t;
    scan->located = true;
    return status;
}

/* The first zero of a group at or before *limit, which it becomes then; 2 when the search ends at *limit
 * without result. A group without bounds is left to samples. */
static int search_group(struct scan *scan, size_t g, double from, double *limit)
{
    const double least_share = 1e-3;
    struct proof_group *group = &scan->groups[g];
    for (;;) {
        double far = scan->follow ? *limit : fmax(*limit, scan->horizon);
        enum proof_result result =
            proof_search(&scan->prover, scan->groups, g, from, *limit, far, scan->resumed);
        if (result == proof_clear) return 0;
        if (result == proof_unfinished) {
            bool stuck = group->clear - from < least_share * (*limit - from);
            for (size_t i = group->first; stuck && i < group->first + group->count; i++)
                scan->sampled[i] = true;
            if (!stuck) *limit = group->clear;
            return stuck ? 0 : 2;
        }
        if (group->low >= *limit) return 0;
        int status = locate_in_group(scan, group);
        if (status < 0) return status;
        if (status == 1 && scan->t > *limit) return 0;
        if (status == 1) {
            *limit = scan->t;
            scan->found_in = group;
            return 1;
        }
        group->clear = group->low = group->high;
        group->high = HUGE_VAL;
    }
}

static int search_all(struct scan *scan, double from, double *limit)
{
    int found = 0;
    for (size_t g = 0; g < scan->group_count; g++) {
        if (!scan->groups[g].proved || scan->groups[g].aside != scan->aside) continue;
        if (scan->follow) scan->groups[g].clear = NAN, scan->groups[g].width = 0;
        int status = search_group(scan, g, from, limit);
        if (status < 0) return status;
        if (status > 0) found = status;
    }
    return found;
}

/* What has been found, and what becomes negative at the same instant. */
static int mark_crossed(struct scan *scan, double t)
{
    /* The end of the bracket that was located last, or another one. */
    bool known = scan->located && scan->points[1].t == t;
    struct scan_point *point = &scan->points[known ? 1 : 2];
    int status = known ? 0 : take_sample(scan, point, t);
    if (status) return status;
    scan->t = t;
    for (size_t g = 0; g < scan->group_count; g++) {
        const struct proof_group *group = &scan->groups[g];
        for (size_t i = group->first; i < group->first + group->count; i++)
            scan->crossed[i] =
                !scan->sampled[i] && point->values[i] < 0 && (group == scan->found_in || point->rates[i] < 0);
    }
    return 1;
}

/* Piece by piece, as far as enclosures reach. */
static int look_by_enclosures(struct scan *scan, double from, double *limit)
{
    bool any = false;
    for (size_t g = 0; g < scan->group_count; g++) {
        const struct proof_group *group = &scan->groups[g];
        bool turn = group->aside == scan->aside;
        any |= turn && group->proved;
        for (size_t i = group->first; i < group->first + group->count; i++)
            scan->sampled[i] = turn && !group->proved;
    }
    for (double begin = from, to = *limit; any && begin < to;) {
        double end = scan->follow ? scan->follow(scan->context, begin, to) : to;
        if (isnan(end)) return -1;
        *limit = end;
        int status = search_all(scan, begin, limit);
        if (status) return status;
        begin = end;
    }
    return 0;
}

int scan_interval(struct scan *scan, double from, double to)
{
    scan->resolved = HUGE_VAL;
    scan->clear = from;
    scan->located = false;
    if (scan->count == 0) return 0;
    double limit = to;
    int proved = look_by_enclosures(scan, from, &limit);
    if (proved < 0) return proved;
    int sampled = look_by_samples(scan, from, limit);
    if (sampled) return sampled;
    scan->clear = limit;
    return proved == 1 ? mark_crossed(scan, limit) : proved;
}
