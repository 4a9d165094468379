/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Analysis of the points of a study: the Pareto front, the observed orders, the cheapest setting for an
 * accuracy.
 */
#include <math.h>
#include <string.h>

#include "fbd_study.h"
#include "study/cost.h"

/* The error, but at least the floor, below which errors are indistinguishable. */
static double certain_error(const struct fbd_cost *cost, const fbd_point *point)
{
    return fmax(point->error, cost->reference.floor);
}

/* False for an error as large as the motion itself. */
static bool is_answer(const fbd_point *point)
{
    return point->state == FBD_POINT_MEASURED && point->error < 1 && point->seconds > 0;
}

static void mark_front(struct fbd_cost *cost)
{
    for (size_t i = 0; i < cost->point_count; i++) {
        fbd_point *point = &cost->points[i];
        point->front = is_answer(point);
        for (size_t k = 0; point->front && k < cost->point_count; k++) {
            const fbd_point *other = &cost->points[k];
            if (k == i || !is_answer(other)) continue;
            double error = certain_error(cost, point), others = certain_error(cost, other);
            bool better = others < error || other->seconds < point->seconds;
            if (others <= error && other->seconds <= point->seconds && better) point->front = false;
        }
    }
}

/* The most accurate point of a ladder: beyond it rounding errors accumulate. */
static size_t best_of(const struct fbd_cost *cost, const fbd_series *series)
{
    size_t best = series->first;
    for (size_t i = series->first; i < series->first + series->count; i++) {
        const fbd_point *point = &cost->points[i];
        if (is_answer(point) && (!is_answer(&cost->points[best]) || point->error < cost->points[best].error))
            best = i;
    }
    return best;
}

/* Sums for a line y = a + p x. */
struct fit {
    double n, x, y, xx, xy, yy;
};

static void fit_add(struct fit *fit, double x, double y)
{
    fit->n += 1, fit->x += x, fit->y += y;
    fit->xx += x * x, fit->xy += x * y, fit->yy += y * y;
}

/* The slope, or NAN if the points are too few, too close, or not on a line (r^2 below 0.9). */
static double fit_slope(const struct fit *fit)
{
    const double least_spread = 0.5; /* of log(steps), squared and summed: a factor of 2 over three points */
    double xx = fit->n * fit->xx - fit->x * fit->x, xy = fit->n * fit->xy - fit->x * fit->y,
           yy = fit->n * fit->yy - fit->y * fit->y;
    if (fit->n < 3 || !(xx > least_spread) || !(xy * xy > 0.9 * xx * yy)) return NAN;
    return xy / xx;
}

/* p in error ~ (mean step)^p by least squares, over points that are neither coarse nor at the floor. Where
 * stability instead of accuracy limits the steps, these hardly depend on the tolerance; the slope is then far
 * too steep and meaningless. */
static double observed_order(const struct fbd_cost *cost, const fbd_series *series)
{
    const double coarse = 0.03, above_floor = 10, highest = 13;
    struct fit fit = {0};
    for (size_t i = series->first; i <= best_of(cost, series); i++) {
        const fbd_point *point = &cost->points[i];
        bool tells = is_answer(point) && point->error < coarse && point->stats.steps > 0 &&
                     point->error > above_floor * cost->reference.floor && point->same_events;
        if (tells) fit_add(&fit, -log((double)point->stats.steps), log(point->error));
    }
    fbd_method method = fbd_method_find(series->method);
    double slope = fit_slope(&fit), most = method.name ? 1.5 * method.order + 1 : highest;
    return slope <= most ? slope : NAN;
}

void cost_analyse(struct fbd_cost *cost)
{
    mark_front(cost);
    for (size_t s = 0; s < cost->series_count; s++)
        cost->series[s].order = observed_order(cost, &cost->series[s]);
}

/* ---- the cheapest setting */

/* True if the error is met here and, to exclude coincidence, at every tighter measured setting. */
static bool meets(const struct fbd_cost *cost, const fbd_series *series, size_t index, double error)
{
    if (!is_answer(&cost->points[index])) return false;
    for (size_t i = index; i < series->first + series->count; i++) {
        const fbd_point *point = &cost->points[i];
        if (point->state == FBD_POINT_SKIPPED) break;
        if (!is_answer(point) || !(certain_error(cost, point) <= error)) return false;
    }
    return true;
}

const fbd_point *cost_cheapest(const struct fbd_cost *cost, double error)
{
    const double alike = 1.03;
    const fbd_point *best = NULL, *by_default = NULL;
    for (size_t s = 0; s < cost->series_count; s++) {
        const fbd_series *series = &cost->series[s];
        const fbd_point **place = strcmp(series->method, "auto") == 0 ? &by_default : &best;
        for (size_t i = series->first; i < series->first + series->count; i++) {
            const fbd_point *point = &cost->points[i];
            bool cheaper = !*place || point->seconds < (*place)->seconds;
            if (cheaper && meets(cost, series, i, error)) *place = point;
        }
    }
    bool take_default = by_default && (!best || by_default->seconds <= alike * best->seconds);
    return take_default ? by_default : best;
}

fbd_point fbd_cost_cheapest(const fbd_cost *cost, double error)
{
    const fbd_point *point = cost ? cost_cheapest(cost, error) : NULL;
    return point ? *point : no_point;
}
