/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The point of a slot comes to an end of it, where nothing says how the motion would go on: that ends the run by
 * name. It may have been beyond the end and be back within a step, so that where the rate turns within a step the
 * least that is left is found.
 */
#include <math.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/project.h"
#include "solve/run.h"

struct slot_end {
    struct run *run;
    int tie, end;
};

/* What is left before the end, within the last step; NAN where that is not known. */
static double left_at(const struct slot_end *slot, double t, double *rate)
{
    struct run *run = slot->run;
    struct fbd_state *state = run->during;
    *rate = NAN;
    if (switcher_partial(run->stepper, moment_at(t), run->y, run->f) != 0) return NAN;
    memcpy(state->y, run->y, 2 * (size_t)run->model->plan.n * sizeof *state->y);
    state->t = t;
    state_misfit(state); /* puts the links in their places */
    return slot_left(run->model, state->tree, slot->tie, slot->end, rate);
}

/* Beyond the end by more than rounding, of a slot without a size of its own as much as its place. */
static bool is_beyond(const struct slot_end *slot, double left)
{
    const double rounding = 1e-12;
    const struct tie *tie = &slot->run->model->tree->ties[slot->tie];
    double size = fmax(isfinite(tie->from) ? fabs(tie->from) : 0, isfinite(tie->to) ? fabs(tie->to) : 0);
    return left < -rounding * size;
}

/* A time in the step at which it is beyond, where that may be farthest; NAN without one. */
static double beyond_within(const struct slot_end *slot, double from, double to)
{
    double before, after, rate;
    left_at(slot, from, &before);
    if (is_beyond(slot, left_at(slot, to, &after))) return to;
    while (before < 0 && after > 0) {
        double middle = from + (to - from) / 2;
        if (!(middle > from && middle < to)) break;
        if (is_beyond(slot, left_at(slot, middle, &rate))) return middle;
        *(rate < 0 ? &from : &to) = middle;
    }
    return NAN;
}

static double end_time(const struct slot_end *slot, double inside, double beyond)
{
    double rate;
    for (;;) {
        double middle = inside + (beyond - inside) / 2;
        if (!(middle > inside && middle < beyond)) return inside;
        *(left_at(slot, middle, &rate) < 0 ? &beyond : &inside) = middle;
    }
}

static void watch_end(const struct slot_end *slot, struct moment *t)
{
    struct run *run = slot->run;
    double rate, beyond = beyond_within(slot, run->from, t->t);
    if (isnan(beyond)) {
        switcher_partial(run->stepper, *t, run->y, run->f);
        return;
    }
    *t = moment_at(end_time(slot, run->from, beyond));
    left_at(slot, t->t, &rate);
    run_fail(run, FBD_BROKEN,
             "at t = %.9g the point in the slot `%s` comes to the end of it. Make it longer, or end the run "
             "before, by an event",
             t->t, run->model->tree->ties[slot->tie].name);
}

void run_watch_slots(struct run *run, struct moment *t)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; tree && i < tree->tie_count && run->outcome == FBD_GOING; i++) {
        const struct tie *tie = &tree->ties[i];
        if (tie->kind != constraint_slot) continue;
        for (int end = 0; end < 2 && run->outcome == FBD_GOING; end++)
            if (isfinite(end == 0 ? tie->from : tie->to)) watch_end(&(struct slot_end){run, i, end}, t);
    }
}
