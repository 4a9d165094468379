/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "events/scan.h"

#include <math.h>
#include <string.h>

#include "events/cubic.h"
#include "numeric/tolerances.h"

/* Limits of samples and of their work in one interval. A function that needs more is too fast for the
 * interval, or round-off. The work is that of a thousand attempts of a step by bsimp at its longest, or two
 * thousand by others: where dense output repeats parts of the step, a sample may cost 64 of them, and an
 * interval without limit took minutes without a chance to interrupt the run. */
enum { most_samples = 4096 };
static const unsigned long most_work = 300000;

static int take_counted(void *context, double t, const bool *asked, double *values, double *rates)
{
    struct scan *scan = context;
    scan->samples++;
    return scan->sample(scan->context, t, asked, values, rates);
}

/* ---- samples */

static int take_sample(struct scan *scan, struct scan_point *point, double t, const bool *asked)
{
    point->t = t;
    return take_counted(scan, t, asked, point->values, point->rates);
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

/* ---- the first zero between a (no function has crossed) and b (at least one is negative) */

/* The estimate of the first zero from the cubics of all functions that cross. */
static double first_estimate(const struct scan *scan, const struct scan_point *a, const struct scan_point *b)
{
    double first = 1;
    for (size_t i = 0; i < scan->count; i++) {
        if (!scan->chosen[i] || !crosses(a, b, i)) continue;
        struct cubic c = cubic_between(b->t - a->t, a->values[i], a->rates[i], b->values[i], b->rates[i]);
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
    return round_off(2, fmax(fabs(a->t), fabs(b->t)));
}

/* Shrink [a, b] until b is within two roundings of the zero. The cubics converge to the zero fast but from
 * one side, so once an estimate stagnates the other side is moved by steps that grow from a rounding; where
 * four steps together gain less than an eighth, one is a bisection, which bounds the number of steps. `m` is
 * a spare point. */
static int locate(struct scan *scan, struct scan_point *a, struct scan_point *b, struct scan_point *m)
{
    double reach = roundings(a, b),
           before = b->t - a->t; /* b may be far away at first, with large roundings */
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
        int status = take_sample(scan, m, t, scan->chosen);
        if (status) return status;
        exchange(m, any_crosses(scan, a, m) ? b : a);
    }
    scan->t = b->t;
    return 1;
}

/* ---- search with bounds */

/* Panels and pieces begin where the last ones ended: functions that have been seen positive are no longer
 * waiting. */
static void note_seen(struct scan *scan, const struct root_group *group)
{
    for (size_t k = 0; k < group->count; k++) scan->waits[group->first + k] &= scan->prover.waiting[k];
}

/* Locate the zero of a group in its bracket; result in scan->t. 0 if the samples do not change sign: bounds
 * and samples differ by roundings. */
static int locate_in_group(struct scan *scan, struct root_group *group)
{
    struct scan_point *a = &scan->points[0], *b = &scan->points[1];
    for (size_t i = 0; i < scan->count; i++)
        scan->chosen[i] = i >= group->first && i < group->first + group->count;
    int status = take_sample(scan, a, group->low, scan->chosen);
    if (!status) status = take_sample(scan, b, group->high, scan->chosen);
    if (status) return status;
    for (size_t i = group->first; i < group->first + group->count; i++)
        if (a->values[i] < 0) a->values[i] = 0; /* round-off, or the beginning of the search */
    if (!any_crosses(scan, a, b)) return 0;
    status = locate(scan, a, b, &scan->points[2]);
    group->clear = group->low = scan->points[0].t;
    group->high = scan->points[1].t;
    scan->located = true;
    return status;
}

/* The same without samples, for functions with `zero`; not at the very end of the search, where a sample must
 * show that the function has crossed. */
static bool tell_in_group(struct scan *scan, const struct root_group *group, double limit)
{
    const double roundings = 64;
    double first = HUGE_VAL;
    size_t which = 0;
    for (size_t i = group->first; scan->zero && i < group->first + group->count; i++) {
        double t = scan->zero(scan->context, i, group->low, group->high);
        if (!(t < first)) continue;
        first = t;
        which = i;
    }
    if (!(first < limit - round_off(roundings, fabs(limit)))) return false;
    memset(scan->crossed, 0, scan->count * sizeof *scan->crossed);
    scan->crossed[which] = true;
    scan->t = first;
    return true;
}

static void note_found(struct scan *scan, const struct root_group *group, bool told, double *limit)
{
    *limit = scan->t;
    scan->found_in = group;
    scan->told = told;
}

/* Search the first zero of a group at or before *limit, and set *limit to it: 1, else 0. If the bounds are
 * inconclusive the group remains open. */
static int search_group(struct scan *scan, struct root_group *groups, size_t g, double from, double *limit)
{
    enum { most_refuted = 8 };
    struct root_group *group = &groups[g];
    bool ahead = groups == scan->groups && !scan->follow;
    for (int refuted = 0; refuted < most_refuted; refuted++) {
        double far = ahead ? fmax(*limit, scan->horizon) : *limit;
        enum roots_result result =
            roots_search(&scan->prover, groups, g, from, *limit, far, scan->waits + group->first);
        group->open = result == roots_unfinished;
        if (result == roots_clear) note_seen(scan, group);
        if (result != roots_found || group->low >= *limit) return 0;
        if (groups == scan->groups && tell_in_group(scan, group, *limit)) {
            note_found(scan, group, true, limit);
            return 1;
        }
        int status = locate_in_group(scan, group);
        if (status < 0) return status;
        if (status == 1 && scan->t > *limit) return 0;
        if (status == 1) {
            note_found(scan, group, false, limit);
            return 1;
        }
        group->clear = group->low = group->high;
        group->high = HUGE_VAL;
    }
    group->open = true;
    return 0;
}

/* ---- search by enclosures */

static void leave_to_samples(struct scan *scan, const struct root_group *group, bool sampled)
{
    for (size_t i = group->first; i < group->first + group->count; i++) scan->sampled[i] = sampled;
}

/* Set the round-off level of the functions of a stuck group to the width of their enclosure at an instant. */
static void note_rounding(struct scan *scan, size_t g)
{
    const struct root_group *group = &scan->groups[g];
    const struct stretch instant = {group->clear, group->clear, group->clear};
    scan->enclose(scan->context, g, &instant, scan->prover.now);
    for (size_t i = 0; i < group->count; i++) {
        double width = interval_width(scan->prover.now[i].middle);
        scan->series.rounding[group->first + i] = width < HUGE_VAL ? width : 0;
    }
}

/* Search all open groups. 1 found at *limit, 0 no zero, 2: the search ends at *limit without result. Groups
 * that make no progress are sampled instead. */
static int search_open(struct scan *scan, double from, double *limit, bool strict)
{
    int found = 0;
    scan->prover.enclose = scan->enclose;
    scan->prover.context = scan->context;
    scan->prover.strict = strict;
    for (size_t g = 0; g < scan->group_count; g++) {
        struct root_group *group = &scan->groups[g];
        if (!group->open) continue;
        if (scan->follow) group->clear = NAN, group->width = 0;
        int status = search_group(scan, scan->groups, g, from, limit);
        if (status < 0) return status;
        if (status > 0) found = status;
        if (strict || !group->open) continue;
        if (group->clear - from >= least_panel * (*limit - from)) {
            *limit = group->clear;
            found = 2;
            continue;
        }
        group->stuck = true;
        leave_to_samples(scan, group, true);
        note_rounding(scan, g);
    }
    return found;
}

static bool is_silent(const struct scan *scan, const struct root_group *group)
{
    bool all = true;
    for (size_t i = group->first; i < group->first + group->count; i++) all &= scan->silent[i];
    return all;
}

static bool any_open(const struct scan *scan)
{
    bool any = false;
    for (size_t g = 0; g < scan->group_count; g++) any |= scan->groups[g].open;
    return any;
}

/* Search piece by piece, with close enclosures, the groups that the coarse search has left open. After too
 * many pieces the search ends where it is, so that the caller can interrupt the run. */
static int look_in_pieces(struct scan *scan, double from, double *limit)
{
    enum { most_pieces = 10000 };
    int pieces = 0;
    for (double begin = from; begin < *limit;) {
        if (pieces++ == most_pieces) {
            *limit = begin;
            return 2;
        }
        double end = scan->follow(scan->context, begin, *limit, false), piece = end;
        if (isnan(end)) return -1;
        int status = search_open(scan, begin, &piece, false);
        if (status) {
            *limit = piece;
            return status;
        }
        for (size_t g = 0; g < scan->group_count; g++) {
            struct root_group *group = &scan->groups[g];
            group->open = group->aside == scan->aside && group->proved && !group->stuck && group->again;
        }
        begin = end;
    }
    return 0;
}

/* A first search with cheap, wide bounds decides where functions are far from zero or cross it steeply. */
static int look_by_enclosures(struct scan *scan, double from, double *limit)
{
    for (size_t g = 0; g < scan->group_count; g++) {
        struct root_group *group = &scan->groups[g];
        bool turn = group->aside == scan->aside && !group->idle && !is_silent(scan, group),
             proved = group->proved && !group->stuck;
        group->open = turn && proved;
        leave_to_samples(scan, group, turn && !proved);
    }
    if (!any_open(scan)) return 0;
    if (!scan->follow) return search_open(scan, from, limit, false);
    int found = 0;
    double end = scan->follow(scan->context, from, *limit, true);
    if (isnan(end)) return -1;
    if (end >= *limit) found = search_open(scan, from, limit, true);
    for (size_t g = 0; g < scan->group_count; g++) scan->groups[g].again = scan->groups[g].open;
    if (found < 0 || !any_open(scan)) return found;
    int closer = look_in_pieces(scan, from, limit);
    return closer ? closer : found;
}

/* ---- search by series */

static void enclose_series(void *context, size_t i, const struct stretch *stretch, struct enclosure *out)
{
    const struct scan *scan = context;
    *out = series_enclose(&scan->series, i, stretch);
}

/* Search function i with the samples of the present level; close it if they suffice. */
static int search_series(struct scan *scan, size_t i, double end, double *limit, bool halved)
{
    struct root_group *alone = &scan->lone[i];
    enum series_state state = series_fit(&scan->series, i, halved);
    bool positive = state != series_inactive && series_is_positive(&scan->series, i);
    scan->waits[i] &= !positive;
    alone->open = state != series_inactive && !positive;
    if (!alone->open || state == series_unresolved) return 0;
    alone->clear = NAN;
    alone->width = 0;
    scan->prover.strict = state == series_rough;
    double to = fmin(end, *limit);
    int status = search_group(scan, scan->lone, i, scan->series.from, &to);
    if (status == 1) *limit = to;
    return status;
}

/* Returns 0, or 2 if some function is not resolved; *found becomes true with a zero, at *limit. */
static int look_at_panel(struct scan *scan, double from, double to, double *limit, bool halved, bool *found)
{
    bool open = true;
    series_open(&scan->series, from, to);
    for (size_t i = 0; i < scan->count; i++) scan->lone[i].open = scan->sampled[i] && !scan->silent[i];
    for (int level = 0; level < series_levels && open; level++) {
        for (size_t i = 0; i < scan->count; i++) scan->unfinished[i] = scan->lone[i].open;
        int status = series_refine(&scan->series, take_counted, scan, scan->unfinished);
        if (status) return status;
        open = false;
        for (size_t i = 0; i < scan->count; i++) {
            if (!scan->lone[i].open) continue;
            status = search_series(scan, i, to, limit, halved);
            if (status < 0) return status;
            *found |= status == 1;
            open |= scan->lone[i].open;
        }
    }
    return open ? 2 : 0;
}

static bool any_sampled(const struct scan *scan)
{
    bool any = false;
    for (size_t i = 0; i < scan->count; i++) any |= scan->sampled[i];
    return any;
}

/* Exclude functions that use up all samples without progress: they are round-off there. False if there are
 * none. */
static bool leave_out_noise(struct scan *scan)
{
    bool any = false;
    for (size_t i = 0; i < scan->count; i++) {
        if (!scan->sampled[i] || !scan->lone[i].open) continue;
        scan->sampled[i] = false;
        any = true;
    }
    return any;
}

/* Limits at which the search by samples is given up. */
struct budget {
    long samples;
    unsigned long work;
};

static struct budget budget_from_here(const struct scan *scan)
{
    return (struct budget){scan->samples + most_samples,
                           scan->work ? scan->work(scan->context) + most_work : 0};
}

static bool is_spent(const struct scan *scan, const struct budget *budget)
{
    return scan->samples >= budget->samples || (scan->work && scan->work(scan->context) >= budget->work);
}

/* Search panel by panel. A panel with unresolved functions is halved; one that cannot be halved further is
 * skipped, as the functions are round-off there. */
static int look_by_series(struct scan *scan, double from, double *limit)
{
    double length = *limit - from;
    bool halved = false, found = false, soon = scan->soon > 0 && scan->soon < length;
    if (!any_sampled(scan)) return 0;
    if (soon) length = scan->soon;
    scan->prover.enclose = enclose_series;
    scan->prover.context = scan;
    if (!scan->resumed) series_start(&scan->series);
    struct budget budget = budget_from_here(scan);
    for (double begin = from; begin < *limit;) {
        double end = *limit - begin > 1.5 * length ? begin + length : *limit;
        double wanted = end;
        if (scan->panel) end = scan->panel(scan->context, begin, end);
        scan->clear = begin;
        if (is_spent(scan, &budget)) {
            if (begin - from >= least_panel * (*limit - from) || !leave_out_noise(scan)) return 2;
            budget = budget_from_here(scan);
        }
        int status = look_at_panel(scan, begin, end, limit, halved, &found);
        if (status < 0) return status;
        double half = begin + (end - begin) / 2;
        halved = status == 2 && half - begin > round_off(time_roundings, fabs(end));
        /* Panels are cut by bounds of rates, which are more pessimistic for short panels. */
        double growth = end < wanted || soon ? 16 : 2;
        soon = soon && !halved;
        length = halved ? half - begin : growth * (end - begin);
        if (halved) scan->resolved = fmin(scan->resolved, 16 * length);
        if (!halved) begin = end;
    }
    return found;
}

/* ---- both searches */

/* Sample all functions at the end of the bracket that was located last, and at its beginning those that may have
 * crossed as well. */
static int sample_bracket(struct scan *scan)
{
    struct scan_point *a = &scan->points[0], *b = &scan->points[1];
    bool all = true, more = false;
    for (size_t i = 0; i < scan->count; i++) all &= scan->chosen[i];
    if (all) return 0;
    int status = take_sample(scan, b, b->t, NULL);
    for (size_t i = 0; i < scan->count; i++) more |= !scan->chosen[i] && b->values[i] < 0;
    return status || !more ? status : take_sample(scan, a, a->t, NULL);
}

/* Mark the function found, and those that become negative at the same instant. */
static int mark_crossed(struct scan *scan, double t)
{
    if (scan->told) return 1;
    /* The end of the bracket that was located last, or another one. */
    bool known = scan->located && scan->points[1].t == t;
    struct scan_point *point = &scan->points[known ? 1 : 2];
    int status = known ? sample_bracket(scan) : take_sample(scan, point, t, NULL);
    if (status) return status;
    scan->t = t;
    /* Functions of the other pass may have been negative before. */
    bool ahead = scan->groups && !scan->follow;
    const struct root_group *group = scan->groups;
    for (size_t i = 0; i < scan->count; i++) {
        size_t first = scan->found_in->first;
        while (group && i >= group->first + group->count) group++;
        bool found = i >= first && i < first + scan->found_in->count;
        bool falls = ahead ? point->rates[i] < 0 : known && crosses(&scan->points[0], point, i);
        falls = falls && (!group || group->aside == scan->aside);
        scan->crossed[i] = point->values[i] < 0 && (found || falls);
    }
    return 1;
}

int scan_interval(struct scan *scan, double from, double to)
{
    scan->resolved = HUGE_VAL;
    scan->clear = from;
    scan->located = scan->told = false;
    if (scan->count == 0) return 0;
    memcpy(scan->waits, scan->dipped, scan->count * sizeof *scan->waits);
    double limit = to;
    int enclosed = look_by_enclosures(scan, from, &limit);
    if (enclosed < 0) return enclosed;
    int sampled = look_by_series(scan, from, &limit);
    if (sampled < 0 || sampled == 2) return sampled;
    scan->clear = limit;
    return sampled == 1 || enclosed == 1 ? mark_crossed(scan, limit) : enclosed;
}
