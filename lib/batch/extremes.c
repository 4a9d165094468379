/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "batch/extremes.h"

#include <math.h>

static double value_of(const struct extreme *extreme, const struct fbd_state *state, fbd_errors *errors)
{
    struct column_view view;
    column_view_begin(&view, state, NULL, NULL, NULL);
    view.errors = errors;
    return run_column_value(&extreme->column, &view);
}

void extremes_start(struct extreme *extremes, size_t count, const struct fbd_state *state, fbd_errors *errors)
{
    for (size_t i = 0; i < count; i++) extremes[i].value = value_of(&extremes[i], state, errors);
}

/* The function sign * y[index], to be maximized. */
struct look {
    struct ensemble *run;
    struct fbd_state *probe;
    const struct extreme *extreme;
    fbd_errors *errors;
    bool failed;
};

static double value_at(struct look *look, double t)
{
    if (!ensemble_look(look->run, t, look->probe)) look->failed = true;
    const double value = value_of(look->extreme, look->probe, look->errors);
    if (isnan(value)) look->failed = true;
    return look->extreme->sign * value;
}

/* The maximum in [a, b], assumed to be the only one there. */
static double golden_section(struct look *look, double a, double b)
{
    const double ratio = (sqrt(5) - 1) / 2;
    enum { most = 30 }; /* 0.618^30 = 5e-7 */
    double x = b - ratio * (b - a), y = a + ratio * (b - a), fx = value_at(look, x), fy = value_at(look, y);
    for (int i = 0; i < most && !look->failed; i++) {
        if (fx > fy) {
            b = y;
            y = x;
            fy = fx;
            x = b - ratio * (b - a);
            fx = value_at(look, x);
        } else {
            a = x;
            x = y;
            fx = fy;
            y = a + ratio * (b - a);
            fy = value_at(look, y);
        }
    }
    return fmax(fx, fy);
}

enum { parts = 8 };

static bool one(struct look *look, struct extreme *extreme, const double *samples)
{
    const struct ensemble *run = look->run;
    double from = run->from, width = (run->t - from) / parts, best = extreme->sign * extreme->value;
    int at = 0;
    for (int k = 1; k <= parts; k++)
        if (samples[k] > samples[at]) at = k;
    best = fmax(best, samples[at]);
    /* Search between the neighbours only if the maximum there can exceed the present extreme, by an estimate
     * from their differences. */
    int low = at > 0 ? at - 1 : 0, high = at < parts ? at + 1 : parts;
    double reach = samples[at] + fmax(samples[at] - samples[low], samples[at] - samples[high]);
    if (!(reach < best)) best = fmax(best, golden_section(look, from + low * width, from + high * width));
    extreme->value = extreme->sign * best;
    return !look->failed;
}

bool extremes_step(struct extreme *extremes, size_t count, struct ensemble *run, struct fbd_state *probe,
                   fbd_errors *errors)
{
    double from = run->from, to = run->t;
    if (!(to > from)) return true;
    for (size_t i = 0; i < count; i++) {
        struct look look = {run, probe, &extremes[i], errors, false};
        double samples[parts + 1];
        for (int k = 0; k <= parts; k++)
            samples[k] = value_at(&look, k == parts ? to : from + k * ((to - from) / parts));
        if (look.failed || !one(&look, &extremes[i], samples)) return false;
    }
    return true;
}
