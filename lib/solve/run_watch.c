/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a run watches: event functions at instants and over stretches of time, on the state along the last
 * step.
 */
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/absolute.h"
#include "solve/run.h"

static int sample_timed(void *context, double t, double *values, double *rate)
{
    struct run *run = context;
    watchers_evaluate(&run->watchers, &run->watchers.timed, run->during, t, run->state->y, values, rate);
    return 0;
}

/* At the start of a step no function has passed its end: one that is negative has just come from there, or
 * goes there, and is off by the rounding of the instant. Left so, one that rises would hide a zero before the
 * first sample, when the motion turns back at once, and one that falls would never be seen again, with its
 * branch on the wrong side for good. As zero the first is looked at like others and the second crosses here.
 */
static int sample_moving(void *context, double t, double *values, double *rate)
{
    struct run *run = context;
    if (switcher_dense(run->stepper, t, run->sample) != GSL_SUCCESS) return -1;
    watchers_evaluate(&run->watchers, &run->watchers.moving, run->during, t, run->sample, values, rate);
    if (t == run->from)
        for (size_t i = 0; i < run->moving.count; i++)
            if (values[i] < 0) values[i] = 0;
    return 0;
}

static void enclose_timed(void *context, size_t group, const struct stretch *stretch, struct enclosure *out)
{
    struct run *run = context;
    watchers_enclose(&run->watchers, &run->watchers.timed, group, run->during, stretch, NULL, out);
}

static void enclose_moving(void *context, size_t group, const struct stretch *stretch, struct enclosure *out)
{
    struct run *run = context;
    if (stretch->from != run->enclosed.from || stretch->to != run->enclosed.to) {
        course_enclose(&run->course, stretch);
        run->enclosed = *stretch;
    }
    watchers_enclose(&run->watchers, &run->watchers.moving, group, run->during, stretch, run->course.now,
                     out);
}

/* The state along the last step with the places that expressions name. */
static int sample_course(void *context, double t, double *y)
{
    struct run *run = context;
    const struct fbd_state *during = run->during;
    if (switcher_dense(run->stepper, t, y) != GSL_SUCCESS) return -1;
    if (run->model->absolute_count == 0) return 0;
    struct instant at = state_instant_at(during, t, y);
    at = instant_extend(run->model, &at);
    memcpy(y, at.y, extended_size(run->model) * sizeof *y);
    return 0;
}

static double follow_course(void *context, double from, double to)
{
    struct run *run = context;
    double negligible;
    int degree = switcher_degree(run->stepper, &negligible);
    if (run->model->absolute_count > 0) { /* places are functions of coordinates, and no polynomials */
        negligible = fmax(negligible, 1e-13);
        degree = course_most_degree;
    }
    run->enclosed.from = NAN;
    if (course_set(&run->course, from, to, degree, negligible, sample_course, run)) return NAN;
    return run->course.to;
}

static bool make_course(struct run *run)
{
    size_t size = extended_size(run->model);
    bool *used = calloc(size + 1, sizeof *used);
    if (!used) return false;
    watchers_mark_used(run->model, &run->watchers.moving, used);
    bool made = course_init(&run->course, size, used);
    free(used);
    return made;
}

/* Over how many radians a formula of time alone turns at most from `from` to `to`: its fastest rate against
 * half of its range. That of a narrow peak is that of its flanks. */
static double radians_of(const struct formula *formula, const struct fbd_state *during, double from,
                         double to)
{
    const int *slots;
    if (!formula->expr || !expr_uses_time(formula->expr) || expr_variables(formula->expr, &slots) > 0)
        return 0;
    const int *branch = formula->branch < 0 ? NULL : during->branch + formula->branch;
    struct stretch stretch = stretch_between(from, to);
    struct enclosure f = expr_enclose(formula->expr, &stretch, NULL, branch);
    double range = interval_width(f.value), turn = interval_size(f.rate) * (to - from);
    return turn > 0 && range > 0 ? 2 * turn / range : 0;
}

static bool has_samples(const struct watcher_set *set)
{
    for (size_t g = 0; g < set->group_count; g++)
        if (!set->groups[g].proved) return true;
    return false;
}

size_t run_sample_panels(const struct run *run, double from, double to)
{
    const double most = 256, each = 2;
    const struct plan *plan = &run->model->plan;
    double radians = run_contact_radians(run, to - from);
    if (!has_samples(&run->watchers.moving)) return 1;
    for (size_t i = 0; i < run->model->load_count; i++) {
        const struct model_load *load = &run->model->loads[i];
        const struct formula *all[] = {&load->value, &load->angle, &load->fx, &load->fy, &load->potential};
        for (int k = 0; k < 5; k++) radians = fmax(radians, radians_of(all[k], run->during, from, to));
    }
    for (size_t i = 0; i < plan->friction_count; i++) {
        const struct friction *friction = &plan->frictions[i];
        const struct formula *all[] = {&friction->mu_s, &friction->mu_k, &friction->surface_speed,
                                       &friction->position};
        for (int k = 0; k < 4; k++) radians = fmax(radians, radians_of(all[k], run->during, from, to));
    }
    return (size_t)fmin(fmax(1, ceil(radians / each)), most);
}

static bool use_enclosures(struct run *run)
{
    const struct watcher_set *timed = &run->watchers.timed, *moving = &run->watchers.moving;
    run->timed.horizon = run->options.until;
    return scan_use_enclosures(&run->timed, timed->groups, timed->group_count, enclose_timed, NULL) &&
           scan_use_enclosures(&run->moving, moving->groups, moving->group_count, enclose_moving,
                               follow_course) &&
           make_course(run);
}

bool run_make_scans(struct run *run)
{
    double tolerance = run->options.tolerance;
    bool multistep = run->options.method->multistep;
    if (!watchers_init(&run->watchers, run->model, tolerance, multistep)) return false;
    const struct watcher_set *timed = &run->watchers.timed, *moving = &run->watchers.moving;
    if (!scan_init(&run->timed, timed->count, sample_timed, run)) return false;
    if (!scan_init(&run->moving, moving->count, sample_moving, run)) return false;
    if (!use_enclosures(run)) return false;
    for (size_t i = 0; i < timed->count; i++) run->timed.rough[i] = timed->watchers[i].rough;
    for (size_t i = 0; i < moving->count; i++) run->moving.rough[i] = moving->watchers[i].rough;
    return true;
}
