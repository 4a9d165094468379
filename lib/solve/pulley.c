/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A rope runs round a pulley as long as it presses on it. When the angle between its two pieces there has
 * come down to zero they are one straight line, and the rope comes off: the scene is no longer true, since
 * what pulls goes on to pull the pulley along with it.
 */
#include <math.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/project.h"
#include "solve/run.h"

/* The angle at pulley `tie` at the end of the step as it stands in run->y. */
static double wrap_now(struct run *run, int tie)
{
    struct fbd_state *state = run->during;
    memcpy(state->y, run->y, 2 * (size_t)run->model->plan.n * sizeof *state->y);
    state_misfit(state); /* puts the links in their places */
    return rope_wrap(run->model, state->tree, tie);
}

/* Off its pulley by more than rounding; from a quarter turn on it has gone round the other way. */
static bool is_off(double wrap)
{
    const double rounding = 1e-12, quarter = 1.5707963267948966;
    return wrap < -rounding && wrap > -quarter;
}

static bool is_taut(const struct run *run, const struct tie *tie)
{
    return run->during->slip[tie->pair] == stick;
}

/* Cut the step back to where the rope is just still on its pulley: halved as long as numbers can tell. */
static bool cut_step(struct run *run, int tie, struct moment *t)
{
    double on = run->from, off = t->t;
    for (;;) {
        double middle = on + (off - on) / 2;
        if (!(middle > on && middle < off)) break;
        if (switcher_partial(run->stepper, moment_at(middle), run->y, run->f) != 0) return false;
        if (is_off(wrap_now(run, tie)))
            off = middle;
        else
            on = middle;
    }
    *t = moment_at(on > run->from ? on : off);
    return switcher_partial(run->stepper, *t, run->y, run->f) == 0;
}

void run_watch_pulleys(struct run *run, struct moment *t)
{
    const struct fbd_model *model = run->model;
    const struct tree *tree = model->tree;
    for (int i = 0; tree && i + 1 < tree->tie_count; i++) {
        const struct tie *tie = &tree->ties[i];
        if (!rope_goes_on(tree, i) || !(is_taut(run, tie) || is_taut(run, tie + 1))) continue;
        if (!is_off(wrap_now(run, i)) || !cut_step(run, i, t)) continue;
        run_fail(
            run, FBD_BROKEN,
            "at t = %.9g the rope `%s` comes off its pulley `%s`: its two sides are one straight line there. "
            "End the run before, by an event, or let the rope run past the pulley",
            t->t, tie->name, model->bodies[tie->end[tie->end_count - 1].body].name);
    }
}
