/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "events/interval_roots.h"
#include "numeric/tolerances.h"

/* Result for one function over a stretch; that of a group is the largest. While one is unsure the stretch is
 * halved, even if others are negative at its end, as it may have crossed zero twice before them. */
enum verdict { clear_above, clear_rising, clear_to_rounding, negative, unsure };

/* The round-off level of g, below which its sign is undetermined. */
static double rounding_of(const struct enclosure *g)
{
    double width = interval_width(g->middle);
    return width < HUGE_VAL ? 2 * width : 0;
}

/* At an instant where g is zero to rounding: does it cross zero so steeply that it leaves the round-off level
 * within the rounding of the time? Then the computed sign can be used. */
static bool passes(const struct enclosure *end, double t)
{
    return -end->rate.high * round_off(time_roundings, fabs(t)) >= rounding_of(end) && end->rate.high < 0;
}

/* Classify g over a stretch; `end` is g at its end if required, else NULL. */
static enum verdict judge(const struct enclosure *g, const struct stretch *stretch,
                          const struct enclosure *end)
{
    double length = stretch->to - stretch->from;
    double rounding = rounding_of(g);
    if (g->value.low >= 0) return clear_above;
    if (g->rate.low >= 0 && g->rate.high > 0) return clear_rising;
    if (g->value.high < -rounding) return negative;
    if (-g->rate.low * length <= rounding) return clear_to_rounding;
    if (!end) return unsure;
    /* At the end of a stretch in which g only falls, or of one as short as the spacing of times. */
    if (end->value.low >= 0) return clear_above;
    bool below = end->value.high < -rounding_of(end) || passes(end, stretch->to);
    return below ? negative : clear_to_rounding;
}

/* The shortest stretch that is halved. */
static bool is_instant(const struct stretch *stretch)
{
    const double roundings = 4;
    double length = stretch->to - stretch->from;
    return length <= round_off(roundings, fabs(stretch->to)) ||
           !(stretch->middle > stretch->from && stretch->middle < stretch->to);
}

static enum verdict judge_group(struct prover *prover, const struct root_group *group, size_t index,
                                const struct stretch *stretch)
{
    enum verdict worst = clear_above;
    bool ends = false;
    prover->enclose(prover->context, index, stretch, prover->now);
    for (size_t i = 0; i < group->count; i++) {
        const struct enclosure *g = &prover->now[i];
        enum verdict verdict = judge(g, stretch, NULL);
        if (verdict == unsure && (g->rate.high <= 0 || is_instant(stretch))) {
            const struct stretch end = {stretch->to, stretch->to, stretch->to};
            if (!ends) prover->enclose(prover->context, index, &end, prover->end);
            ends = true;
            verdict = judge(g, stretch, &prover->end[i]);
            prover->blind += !(interval_width(prover->end[i].value) < HUGE_VAL);
        }
        if (prover->waiting[i]) {
            prover->waiting[i] = verdict != clear_above;
            if (verdict == negative) verdict = clear_to_rounding;
        }
        if (verdict > worst) worst = verdict;
    }
    return worst;
}

static void see_who_waits(struct prover *prover, const struct root_group *group, size_t index, double from,
                          const bool *waits)
{
    const struct stretch start = {from, from, from};
    bool any = false;
    for (size_t i = 0; i < group->count; i++) any |= waits[i];
    if (any) prover->enclose(prover->context, index, &start, prover->now);
    for (size_t i = 0; i < group->count; i++) prover->waiting[i] = waits[i] && prover->now[i].value.high < 0;
}

enum roots_result roots_search(struct prover *prover, struct root_group *groups, size_t index, double from,
                               double need, double far, const bool *waits)
{
    enum { most_stretches = 20000, most_blind = 8, few = 16, many = 256 };
    struct root_group *group = &groups[index];
    if (!(group->clear >= from)) {
        group->clear = group->low = from;
        group->high = HUGE_VAL;
        see_who_waits(prover, group, index, from, waits);
    }
    if (group->high < HUGE_VAL) return roots_found;
    double width = group->width > 0 ? group->width : far - group->clear;
    bool grows = true;
    double start = group->clear;
    prover->blind = 0;
    for (int k = 0; group->clear < need; k++) {
        if (k == most_stretches || prover->blind > most_blind) return roots_unfinished;
        if (k == few && prover->strict) return roots_unfinished;
        /* At this pace the search will not reach the end. */
        if (k >= many && group->clear - start < (need - start) * k / most_stretches) return roots_unfinished;
        double to = group->clear + width;
        /* A remainder of up to half a stretch is included, and no stretch is shorter than the spacing of
         * times. */
        if (!(group->clear + 1.5 * width < far)) to = far;
        if (!(to > group->clear)) to = fmin(nextafter(group->clear, HUGE_VAL), far);
        struct stretch stretch = stretch_between(group->clear, to);
        enum verdict verdict = judge_group(prover, group, index, &stretch);
        width = to - group->clear;
        if (verdict == unsure) {
            width /= 2;
            grows = false;
            continue;
        }
        if (verdict == clear_to_rounding && prover->strict) return roots_unfinished;
        group->width = width;
        if (verdict == negative) {
            group->high = to;
            return roots_found;
        }
        group->clear = to;
        if (verdict == clear_above) group->low = to;
        if (grows) width *= 2;
        grows = true;
    }
    return roots_clear;
}
