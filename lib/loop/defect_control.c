/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Defect control: at the ends and stages of a step a pulse may vanish, but not at an inner point at which the
 * method evaluates only the interpolant for the event search. Then the interpolant is wrong over the whole
 * step, and so is the search for the pulse. Its derivative differs from the right-hand side by far. Implicit
 * methods are not checked: the interpolants of fast components need not satisfy the equations (except after
 * bounces: falls_at_once).
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <string.h>

#include "loop/run.h"
#include "numeric/tolerances.h"

/* The derivative of the interpolant at a fraction of the step, by differences, and the right-hand side there. */
static bool take_slopes(struct run *run, double share, double h, double *slope, double *f)
{
    const double apart = 1e-3; /* of the step */
    size_t size = plan_size(&run->model->plan);
    double *above = run->work.kept, *y = above + size, t = run->step.from + share * h;
    bool taken = switcher_dense(run->stepper, time_dd_at(t - apart * h), slope) == GSL_SUCCESS &&
                 switcher_dense(run->stepper, time_dd_at(t + apart * h), above) == GSL_SUCCESS &&
                 switcher_dense(run->stepper, time_dd_at(t), y) == GSL_SUCCESS &&
                 counted_system_rhs(&run->system, t, y, f) == GSL_SUCCESS;
    for (size_t i = 0; taken && i < size; i++) slope[i] = (above[i] - slope[i]) / (2 * apart * h);
    return taken;
}

/* The largest rate or state of a kind; values below a small multiple of it are negligible. */
static double largest(const double *most, size_t from, size_t to)
{
    double size = 0;
    for (size_t i = from; i < to; i++) size = fmax(size, most[i]);
    return size;
}

static bool obeys(const struct run *run, double h, const double *slope, const double *f, size_t from,
                  size_t to)
{
    const double far_off = 0.01, nothing = undecided_part, roundings = 4;
    const size_t n = (size_t)run->model->plan.n;
    const double *most = run->recent.anchor + plan_size(&run->model->plan);
    double least = nothing * fmax(largest(most, from, to), largest(run->work.y, from, to));
    for (size_t i = from; i < to; i++) {
        double size = fmax(fmax(most[i], fabs(run->work.y[i])), least), off = fabs(f[i] - slope[i]);
        /* Accelerations of components held by couplings are rounding. */
        if (i < 2 * n && off <= roundings * run->roundoff.accelerations[i - n]) continue;
        if (h * off > far_off * size + far_off * h * fabs(run->work.f[i])) return false;
    }
    return true;
}

/* Evaluate the moving functions at the start of the step, or at a fraction of it. */
static bool look_at_functions(struct run *run, double share, double h)
{
    double *y = run->work.kept;
    const double t = run->step.from + share * h;
    if (share == 0)
        memcpy(y, run->state->y, plan_size(&run->model->plan) * sizeof *y);
    else if (switcher_dense(run->stepper, time_dd_at(t), y) != GSL_SUCCESS)
        return false;
    watchers_evaluate(&run->watchers, &run->watchers.moving, run->during, time_dd_at(t), y, NULL,
                      run->work.values, run->work.values + run->watchers.moving.count);
    return true;
}

/* The first dense output of a multistep method is linear, with the speed at the end of the step. A body that
 * has just bounced then falls through its floor at once if the step ends beyond the top of its flight: a
 * flight lower than the error of the step. */
static bool falls_at_once(struct run *run, double h)
{
    const double share = 1.0 / 16;
    const struct watcher_set *set = &run->watchers.moving;
    const double *values = run->work.values, *rates = values + set->count;
    bool *below = run->work.crossed, any = false;
    if (!look_at_functions(run, share, h)) return false;
    for (size_t i = 0; i < set->count; i++)
        any |= below[i] = set->watchers[i].kind == watch_gap && values[i] < 0;
    if (!any || !look_at_functions(run, 0, h)) return false;
    for (size_t i = 0; i < set->count; i++)
        if (below[i] && rates[i] * share * h > fabs(values[i])) return true;
    return false;
}

bool defect_is_large(struct run *run, struct time_dd end)
{
    const double shares[] = {0.31, 0.72};
    const struct method *method = run->options.method;
    bool by_ends = method->multistep && method->implicit;
    if (run->options.step > 0 || !(by_ends || run->search.wakes)) return false;
    size_t n = (size_t)run->model->plan.n, size = plan_size(&run->model->plan);
    double h = time_dd_since(end, run_start(run)), *slope = run->work.aside, *f = slope + size;
    bool meets = run->model->tree->meeting_count > 0;
    if (by_ends && meets && falls_at_once(run, h)) return true;
    bool asked = run->search.wakes && !run_is_exact(run);
    if (!asked || switcher_made_implicitly(run->stepper)) return false;
    for (size_t k = 0; k < sizeof shares / sizeof *shares; k++) {
        if (!take_slopes(run, shares[k], h, slope, f)) return false;
        if (!obeys(run, h, slope, f, n, 2 * n) || !obeys(run, h, slope, f, 2 * n, size)) return true;
    }
    return false;
}
