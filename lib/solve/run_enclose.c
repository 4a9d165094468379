/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a run encloses: event functions over stretches of time, on the state along the last step.
 */
#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/absolute.h"
#include "solve/run.h"

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
    struct instant at = {t, y, during->branch, during->slip, during->pull, during->tree, during->extended};
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

bool run_use_enclosures(struct run *run)
{
    const struct watcher_set *timed = &run->watchers.timed, *moving = &run->watchers.moving;
    run->timed.horizon = run->options.until;
    return scan_use_enclosures(&run->timed, timed->groups, timed->group_count, enclose_timed, NULL) &&
           scan_use_enclosures(&run->moving, moving->groups, moving->group_count, enclose_moving,
                               follow_course) &&
           make_course(run);
}
