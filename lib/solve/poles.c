/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/poles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A divisor below this part of its largest size counts as zero: whatever is infinite there has shown itself.
 */
static const double negligible = 1e-12;

bool poles_init(struct poles *poles, const struct fbd_model *model)
{
    const struct plan *plan = &model->plan;
    *poles = (struct poles){0};
    for (size_t i = 0; i < plan->pole_count; i++) poles->count += plan->poles[i].count;
    if (poles->count == 0) return true;
    poles->most = calloc(5 * poles->count + 2 * (size_t)plan->n, sizeof(double));
    if (!poles->most) return false;
    poles->start = poles->most + poles->count;
    poles->rate = poles->start + poles->count;
    poles->end = poles->rate + poles->count;
    poles->end_rate = poles->end + poles->count;
    poles->dy = poles->end_rate + poles->count;
    return true;
}

void poles_free(struct poles *poles)
{
    free(poles->most);
    *poles = (struct poles){0};
}

static void divisors_at(const struct plan *plan, const struct instant *at, const double *dy, double *divisors,
                        double *rates)
{
    for (size_t i = 0; i < plan->pole_count; i++) {
        const struct formula *formula = &plan->poles[i].formula;
        expr_divisors(formula->expr, at->t, at->y, 1, dy, formula_branches(formula, at), divisors, rates);
        divisors += plan->poles[i].count;
        rates += plan->poles[i].count;
    }
}

double poles_longest_step(struct poles *poles, const struct fbd_state *state)
{
    const double share = 0.5;
    const struct plan *plan = &state->model->plan;
    size_t n = (size_t)plan->n;
    double longest = HUGE_VAL;
    if (poles->count == 0) return longest;
    struct instant at = state_instant(state);
    memcpy(poles->dy, state->y + n, n * sizeof(double));
    memcpy(poles->dy + n, state->a, n * sizeof(double));
    divisors_at(plan, &at, poles->dy, poles->start, poles->rate);
    for (size_t i = 0; i < poles->count; i++) {
        double d = poles->start[i], rate = poles->rate[i];
        if (!isfinite(d)) continue;
        poles->most[i] = fmax(poles->most[i], fabs(d));
        if (d * rate < 0 && fabs(d) > negligible * poles->most[i])
            longest = fmin(longest, share * fabs(d / rate));
    }
    return longest;
}

/* The least value, relative to the smaller end, of the cubic with values a and b > 0 and slopes da and db at
 * the ends of [0, 1]; by samples, as a bound is enough. */
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
    const struct plan *plan = &during->model->plan;
    if (poles->count == 0) return false;
    struct instant at = {t, y, during->branch, during->slip, during->pull};
    divisors_at(plan, &at, f, poles->end, poles->end_rate);
    for (size_t i = 0; i < poles->count; i++) {
        double a = poles->start[i], b = poles->end[i], side = a < 0 ? -1 : 1;
        if (!isfinite(a) || !isfinite(b) || fabs(a) <= negligible * poles->most[i]) continue;
        if (a * b <= 0 || fabs(b) < too_deep * fabs(a)) return true;
        if (deepest(side * a, side * h * poles->rate[i], side * b, side * h * poles->end_rate[i]) < too_deep)
            return true;
    }
    return false;
}
