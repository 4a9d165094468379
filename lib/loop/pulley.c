/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A rope runs around a pulley as long as its normal force there is positive. When the angle between its two
 * pieces has become zero they are one straight line, and the rope leaves the pulley: the model is no longer
 * valid, since its constraint would pull the pulley along. While one of the two is slack there is no normal
 * force, and the rope may be anywhere; it must be back when it becomes taut.
 */
#include <math.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/project.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

/* The angle of wrap at pulley `coupling` in state y. */
static double wrap_at(struct run *run, int coupling, const double *y)
{
    struct fbd_state *state = run->during;
    memcpy(state->y, y, plan_size(&run->model->plan) * sizeof *state->y);
    state_misfit(state); /* updates the positions of the links */
    return rope_wrap(run->model, state->tree, coupling);
}

/* Is the angle negative by more than rounding? */
static bool is_off(double wrap)
{
    return wrap < -negligible_sum;
}

static bool is_taut(const struct fbd_state *state, const struct coupling *coupling)
{
    return state->slip[coupling->pair] == stick;
}

/* Cut the step back to the last time at which the rope is on its pulley, by bisection. */
static bool cut_step(struct run *run, int coupling, struct time_dd *t)
{
    double on = run->step.from, off = t->t;
    for (;;) {
        double middle = on + (off - on) / 2;
        if (!(middle > on && middle < off)) break;
        if (switcher_partial(run->stepper, time_dd_at(middle), run->work.y, run->work.f) != 0) return false;
        if (is_off(wrap_at(run, coupling, run->work.y)))
            off = middle;
        else
            on = middle;
    }
    *t = time_dd_at(on > run->step.from ? on : off);
    return switcher_partial(run->stepper, *t, run->work.y, run->work.f) == 0;
}

static const char *pulley_of(const struct run *run, int coupling)
{
    const struct coupling *rope = &run->model->tree->couplings[coupling];
    return run->model->bodies[rope->end[rope->end_count - 1].body].name;
}

void run_watch_pulleys(struct run *run, struct time_dd *t)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i + 1 < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (!rope_goes_on(tree, i) || !is_taut(run->during, coupling) || !is_taut(run->during, coupling + 1))
            continue;
        if (!is_off(wrap_at(run, i, run->work.y)) || !cut_step(run, i, t)) continue;
        run_fail(run, FBD_BROKEN,
                 "at t = %.9g the rope `%s` comes off its pulley `%s`: its two sides are one straight line "
                 "there. End the run earlier by an event, or lead the rope past the pulley",
                 t->t, coupling->name, pulley_of(run, i));
    }
}

void run_check_pulleys(struct run *run)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i + 1 < tree->coupling_count && run->end.outcome == FBD_GOING; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (!rope_goes_on(tree, i) || !is_taut(run->state, coupling) || !is_taut(run->state, coupling + 1))
            continue;
        if (!is_off(wrap_at(run, i, run->state->y))) continue;
        run_fail(run, FBD_BROKEN,
                 "at t = %.9g the rope `%s` is taut beside its pulley `%s`, which it left while it was "
                 "slack. End the run earlier by an event, or lead the rope past the pulley",
                 run_time(run), coupling->name, pulley_of(run, i));
    }
}

bool close_taut_ropes(struct run *run)
{
    bool any = false;
    const struct tree *tree = run->model->tree;
    const struct instant at = state_instant(run->state);
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->kind != constraint_rope || run->state->slip[coupling->pair] == stick) continue;
        if (coupling_is_gone(run->state->tree, coupling)) continue;
        struct one_sided rope = one_sided_at(run->model, &at, coupling->pair);
        if (!(rope.excess >= -rope.rounding)) continue;
        run->state->slip[coupling->pair] = stick;
        any = true;
    }
    return any;
}
