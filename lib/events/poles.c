/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "events/poles.h"

#include <math.h>
#include <string.h>

#include "dynamics/tree.h"
#include "dynamics/world_refs.h"
#include "numeric/tolerances.h"

/* A divisor below this part of its largest size is zero unless there is a pole. */
static const double negligible = negligible_sum;

bool poles_init(struct poles *poles, const struct fbd_model *model, struct arena *memory)
{
    const struct plan *plan = &model->plan;
    *poles = (struct poles){0};
    for (size_t i = 0; i < plan->pole_count; i++) poles->count += plan->poles[i].count;
    if (poles->count == 0) return true;
    size_t count = poles->count;
    poles->most = ARENA_ARRAY(memory, 7 * count + plan_size(plan), double);
    poles->grows = ARENA_ARRAY(memory, count, bool);
    if (memory->failed) return false;
    poles->before = poles->most + count;
    poles->part = poles->before + count;
    poles->start = poles->part + count;
    poles->rate = poles->start + count;
    poles->end = poles->rate + count;
    poles->end_rate = poles->end + count;
    poles->dy = poles->end_rate + count;
    return true;
}

/* At an instant and along a direction, both extended (world_refs.h). A force that has not begun, or has ended,
 * divides by nothing. */
static void divisors_at(const struct fbd_model *model, const struct instant *at,
                        const struct direction *along, double *divisors, double *rates)
{
    const struct plan *plan = &model->plan;
    for (size_t i = 0; i < plan->pole_count; i++) {
        const struct formula *formula = &plan->poles[i].formula;
        const int load = plan->poles[i].load;
        if (load >= 0 && !is_there(at->tree, model->loads[load].source->lifetime.number))
            for (size_t k = 0; k < plan->poles[i].count; k++) divisors[k] = HUGE_VAL, rates[k] = 0;
        else
            expr_divisors(formula->expr, at->t, at->y, along->dt, along->dy, formula_branches(formula, at),
                          divisors, rates);
        divisors += plan->poles[i].count;
        rates += plan->poles[i].count;
    }
}

/* Record divisor k, which falls, of a formula with the rate `change`. */
static void follow(struct poles *poles, size_t k, double change)
{
    const double nearer = 0.9;
    double d = fabs(poles->start[k]), part = fabs(change * poles->start[k] / poles->rate[k]);
    if (poles->before[k] > 0 && d > nearer * poles->before[k] && d <= poles->before[k]) return;
    poles->grows[k] = poles->before[k] > 0 && d < poles->before[k] && part > poles->part[k];
    poles->before[k] = d;
    poles->part[k] = part;
}

/* The longest step for divisor k of a formula with the rate `change`. */
static double longest_for(struct poles *poles, size_t k, double change)
{
    const double share = 0.5;
    double d = poles->start[k], rate = poles->rate[k];
    if (!isfinite(d) || !isfinite(rate)) return HUGE_VAL;
    poles->most[k] = fmax(poles->most[k], fabs(d));
    if (!(d * rate < 0)) return HUGE_VAL;
    follow(poles, k, change);
    return fabs(d) > negligible * poles->most[k] || poles->grows[k] ? share * fabs(d / rate) : HUGE_VAL;
}

double poles_longest_step(struct poles *poles, const struct fbd_state *state, const struct pole **nearest)
{
    const struct plan *plan = &state->model->plan;
    size_t n = (size_t)plan->n, k = 0;
    double longest = HUGE_VAL;
    *nearest = NULL;
    if (poles->count == 0) return longest;
    struct instant now = state_instant(state), at = instant_extend(state->model, &now);
    memcpy(poles->dy, state->y + n, n * sizeof(double));
    memcpy(poles->dy + n, state->a, plan_rates(plan) * sizeof(double));
    const struct direction motion = {.dt = 1, .dy = poles->dy},
                           flow = direction_extend(state->model, &at, &motion);
    divisors_at(state->model, &at, &flow, poles->start, poles->rate);
    for (size_t i = 0; i < plan->pole_count; i++) {
        double change;
        formula_along(&plan->poles[i].formula, &at, &flow, &change);
        for (size_t last = k + plan->poles[i].count; k < last; k++) {
            double h = longest_for(poles, k, change);
            if (h < longest) longest = h, *nearest = &plan->poles[i];
        }
    }
    return longest;
}

/* The least value, relative to the smaller end, of the cubic with values a and b > 0 and slopes da and db at
 * the ends of [0, 1]; by samples, as an estimate suffices. */
static double deepest(double a, double da, double b, double db)
{
    enum { samples = 8 };
    double least = 1, c2 = 3 * (b - a) - 2 * da - db, c3 = da + db - 2 * (b - a);
    for (int k = 1; k < samples; k++) {
        double s = (double)k / samples;
        least = fmin(least, (a + s * (da + s * (c2 + s * c3))) / fmin(a, b));
    }
    return least;
}

bool poles_passed(struct poles *poles, const struct fbd_state *during, double h, double t, const double *y,
                  const double *f)
{
    const double too_deep = 0.2;
    if (poles->count == 0) return false;
    struct instant end = state_instant_at(during, t, y);
    struct instant at = instant_extend(during->model, &end);
    const struct direction motion = {.dt = 1, .dy = f}, flow = direction_extend(during->model, &at, &motion);
    divisors_at(during->model, &at, &flow, poles->end, poles->end_rate);
    for (size_t i = 0; i < poles->count; i++) {
        double a = poles->start[i], b = poles->end[i], side = a < 0 ? -1 : 1;
        bool zero = fabs(a) <= negligible * poles->most[i] && !poles->grows[i];
        if (!isfinite(a) || !isfinite(b) || zero) continue;
        if (a * b <= 0 || fabs(b) < too_deep * fabs(a)) return true;
        if (deepest(side * a, side * h * poles->rate[i], side * b, side * h * poles->end_rate[i]) < too_deep)
            return true;
    }
    return false;
}
