/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/run.h"

#include <gsl/gsl_errno.h>
#include <string.h>

#include "dynamics/closed_loops.h"
#include "dynamics/constraint.h"
#include "dynamics/nonfinite.h"
#include "dynamics/plane_friction.h"
#include "dynamics/project.h"
#include "loop/switch_event.h"
#include "numeric/tolerances.h"

/* Bind the right-hand side in the modes of the next step. */
static void bind_rates(struct run *run)
{
    rates_bind(run->rates);
    run->system.inner.function = rates_call(run->rates, &run->system.inner.params);
}

/* ---- one turn */

/* Start the stepper at the present state. */
static bool restart(struct run *run)
{
    run_evaluate(run);
    memcpy(run->work.y, run->state->y, plan_size(&run->model->plan) * sizeof *run->work.y);
    scan_forget(&run->search.timed);
    run->search.knows_timed = false;
    scan_forget(&run->search.moving);
    bind_rates(run);
    run_choose_method(run);
    if (!run_is_exact(run)) {
        coupled_scales_join(&run->mechanisms, run->state);
        roundoff_estimate(run);
    }
    watchers_follow(&run->watchers, run->during);
    if (run->model->tree->plane_count > 0 && planes_set_out(run->state)) switcher_expect_stiff(run->stepper);
    int status = run_start_stepper(run);
    if (status != GSL_SUCCESS) {
        run_fail_step(run, stepper_bad_function);
        return false;
    }
    if (!run->watchers.all_affine) /* some are sampled */
        watchers_set_rounding(&run->watchers.moving, run->during, run->search.moving.series.rounding,
                              run->search.moving.series.jump);
    if (run->step.first == 0) run->step.first = run->step.h;
    if (run_is_one_step(run)) run->step.h = run->options.until - run->state->t;
    if (run->kind == structure_linear && !run_start_linear(run)) return false;
    run->step.restart = false;
    return true;
}

/* The next event that depends on time alone within reach of a step, or the end of the run. */
static struct time_dd next_time(struct run *run, bool *found)
{
    const double stretch = 1.02; /* the stepper may lengthen a step by 1 % to end at its limit */
    double until = fmin(run->options.until, run->zeno_switches.end);
    until = fmin(until, zeno_next_rest(run));
    int status = run_find_timed(run, fmin(until, run->state->t + stretch * run->step.h));
    *found = status == 1;
    /* Where functions of time vary too fast for so long a step, it ends where they have been searched. */
    if (status == 2 && run->search.timed.clear > run->state->t) return time_dd_at(run->search.timed.clear);
    struct time_dd end = time_dd_at(until);
    if (time_dd_since(end, run_end(run)) <= 0)
        end.t = nextafter(end.t, HUGE_VAL); /* a rest without duration */
    return *found ? time_dd_earlier(run_pin_timed(run), end) : end;
}

/* Fail at a coordinate that overflows although its rate is finite; the step is not accepted. */
static bool fail_beyond_numbers(struct run *run, double t)
{
    size_t n = (size_t)run->model->plan.n, size = plan_size(&run->model->plan);
    for (size_t i = 0; i < size; i++) {
        if (isfinite(run->work.y[i])) continue;
        if (i >= 2 * n) {
            run_fail(run, FBD_FAILED,
                     "the state `%s` is not finite at t = %.9g: %s. The last good state is that at t = %.9g",
                     run->model->scene->own[i - 2 * n].name, t, nonfinite_reason(run->work.y[i]),
                     run->state->t);
            return true;
        }
        const struct coordinate *c = &run->model->scene->coordinates[i % n];
        run_fail(run, FBD_FAILED,
                 "`%s.%s` is not finite at t = %.9g: %s. The last good state is that at t = %.9g",
                 run->model->bodies[c->body].name, i < n ? c->name : c->rate_name, t,
                 nonfinite_reason(run->work.y[i]), run->state->t);
        return true;
    }
    return false;
}

/* Returns whether the projection has moved the end of the step. */
static bool accept(struct run *run, struct time_dd t)
{
    size_t size = plan_size(&run->model->plan);
    double *most = run->recent.anchor + size, probe = 0; /* zero unless a coordinate is not finite */
    for (size_t i = 0; i < size; i++) {
        most[i] = larger(most[i], fabs(run->state->y[i]));
        probe += 0 * run->work.y[i];
    }
    if (probe != 0 && fail_beyond_numbers(run, t.t)) return false;
    state_set_moment(run->state, t);
    memcpy(run->state->y, run->work.y, size * sizeof *run->work.y);
    if (run->plain) return false;
    modes_hold(run->state);
    project_step(run);
    run_check_overlap(run);
    run->step.restart |= projection_has_failed(run);
    bool moved = run->projected && memcmp(run->work.y, run->state->y, size * sizeof *run->work.y) != 0;
    memcpy(run->work.y, run->state->y, size * sizeof *run->work.y);
    return moved;
}

/* Limit the next step near poles of the forces; false at a pole. */
static bool heed_poles(struct run *run)
{
    const struct pole *nearest;
    if (run->poles.count == 0) return true;
    double longest = poles_longest_step(&run->poles, run->state, &nearest);
    run->step.h = fmin(run->step.h, longest);
    bool reached = nearest && longest <= round_off(4, fabs(run->state->t));
    if (reached) run_fail_pole(run, nearest);
    return !reached;
}

/* ---- the stages of a turn: each continues the previous one; false ends the turn */

struct turn {
    struct time_dd t;     /* the end of the step so far */
    struct time_dd limit; /* upper bound of t */
    bool timed;           /* events that depend on time alone happen at the limit */
    bool moving;          /* other events happen at t */
};

/* Set the start and the modes of the step, which only events and couplings change; after events the stepper
 * restarts. */
static bool begin_step(struct run *run)
{
    run->step.from = run->state->t;
    run->step.from_rest = run->state->rest;
    if (run->step.restart || !run->plain) state_copy(run->during, run->state);
    if (!run->step.restart) return true;
    run_note_sign(run);
    return restart(run);
}

/* Limit the step: to the next event that depends on time alone, and before poles. */
static bool limit_step(struct run *run, struct turn *turn)
{
    if (run->step.crawl == 0) run->step.not_finite = switcher_rejected(run->stepper, rejected_not_finite);
    run_limit_method(run);
    desync_steps(run);
    if (run->options.step == 0 && !heed_poles(run)) return false;
    turn->limit = next_time(run, &turn->timed);
    turn->t = run_start(run);
    desync_steps_from(run, turn->limit);
    return true;
}

/* A step that fails next to a switch continues past it, as after an event there. */
static bool go_beyond(struct run *run, struct turn *turn)
{
    if (!run_pass_brink(run)) return false;
    run_apply(run, NULL, run->search.moving.crossed);
    return run->end.outcome == FBD_GOING && begin_step(run) && limit_step(run, turn);
}

enum { most_times = 30 }; /* that a step is repeated */

/* Begin the step again, with a quarter of its length. */
static bool shorten(struct run *run, struct turn *turn)
{
    const double h = time_dd_since(turn->t, run_start(run)) / 4;
    if (!(run->step.from + h > run->step.from) || !restart(run)) return false;
    turn->t = run_start(run);
    turn->limit = time_dd_at(run->step.from + h);
    turn->timed = false;
    run->step.h = fmin(run->step.h, h);
    return true;
}

/* Make one accepted step, to y and its slopes. A step rejected by defect control is repeated. */
static bool make_step(struct run *run, struct turn *turn)
{
    for (int time = 0;; time++) {
        closed_loops_hold(run->during->tree->loops, false);
        closed_loops_suspend(run->during->tree->loops, false);
        enum stepper_status status = switcher_step(run->stepper, &run->system, &turn->t, run->work.y,
                                                   run->work.f, &run->step.h, turn->limit);
        closed_loops_agree(run->state->tree->loops, run->during->tree->loops);
        closed_loops_hold(run->during->tree->loops, true);
        if (status == stepper_underflow && !run->plain && go_beyond(run, turn)) continue;
        if (run->end.outcome != FBD_GOING) return false;
        if (status != stepper_ok) run_fail_step(run, status);
        if (status != stepper_ok || time == most_times || !defect_is_large(run, turn->t))
            return status == stepper_ok;
        if (!shorten(run, turn)) return run->end.outcome == FBD_GOING;
    }
}

/* Note whether an event was found; false where the search has failed. */
static bool take_found(struct run *run, struct turn *turn, int found)
{
    if (found < 0) run_fail_step(run, stepper_bad_function);
    turn->moving = found > 0;
    return found >= 0;
}

/* Find the first event within the step that changes the motion, and cut the step there. */
static bool find_event(struct run *run, struct turn *turn)
{
    turn->moving = false;
    if (run->undisturbed) return true;
    run_watch_slots(run, &turn->t);
    return run->end.outcome != FBD_GOING || take_found(run, turn, run_find_event(run, &turn->t));
}

/* A step to the next event, repeated if shapes are in each other at its end: an event was missed. */
static bool step_to_event(struct run *run, struct turn *turn)
{
    for (int time = 0; make_step(run, turn) && find_event(run, turn); time++) {
        if (time == most_times || !run_overlaps(run, turn->t.t)) return true;
        if (!shorten(run, turn)) return run->end.outcome == FBD_GOING;
    }
    return false;
}

/* Log the user events within the step, which is not repeated any more; cut it where one ends the run, and at limits of
 * couplings. */
static bool tell_events(struct run *run, struct turn *turn)
{
    if (run->undisturbed) return true;
    const bool goes = run->end.outcome == FBD_GOING;
    if (goes && !take_found(run, turn, run_tell_events(run, &turn->t, turn->moving))) return false;
    run_watch_pulleys(run, &turn->t);
    run_watch_ends(run, &turn->t);
    turn->timed = turn->timed && time_dd_equal(turn->t, turn->limit);
    return true;
}

/* Set the state to the end of the step, projected onto the couplings. */
static bool accept_step(struct run *run, const struct turn *turn)
{
    bool moved = accept(run, turn->t);
    run_check_progress(run);
    if (run->end.outcome != FBD_GOING) return false;
    if (moved) counted_system_rhs(&run->system, turn->t.t, run->work.y, run->work.f);
    return true;
}

/* Apply the events at the end of the step and settle the modes; without events evaluate the forces. */
static bool apply_events(struct run *run, const struct turn *turn)
{
    bool happens = turn->moving || turn->timed || run->contacts.due;
    if (happens) run_check_jam(run, false);
    if (run->end.outcome != FBD_GOING) return false;
    run->stale = !happens;
    run->delay = turn->moving && run->options.delays
                     ? watchers_delay(&run->watchers, run->during, run_end(run), run->state->y,
                                      run->search.moving.crossed, run->work.values)
                     : 0;
    if (happens) {
        double struck = energy_of_impacts(run);
        run_apply(run, turn->timed ? run->search.timed.crossed : NULL,
                  turn->moving ? run->search.moving.crossed : NULL);
        energy_guard_events(run, struck);
        if (turn->moving && run->end.outcome == FBD_GOING) step_past_switch(run);
    } else {
        /* Indeterminate forces are resolved for output only: run_look, run_check_balance. */
        if (!run->lazy) run_evaluate(run);
        if (!run->plain) run_check_jam(run, true);
        if (!run->plain) run_check_sides(run);
        roundoff_renew(run);
    }
    return true;
}

/* Is the balance of forces and motion checked at this event? Always where multipliers or weights of sliding modes are
 * solved for; else forces follow from the state by formulas, and the check costs as much as the event: at the first
 * events, and at one of so many. */
static bool balance_is_due(struct run *run)
{
    enum { first_events = 16, events_between = 16 };
    const struct tree *tree = run->model->tree;
    const bool solved = run->state->tree->acting_count + tree->pair_count + tree->massless_count > 0 ||
                        state_sliding(run->state);
    run->events++;
    return solved || run->events <= first_events || run->events % events_between == 0;
}

/* Log the results of the step, and prepare the watchers for the next one. */
static void end_step(struct run *run, const struct turn *turn)
{
    bool at_end = turn->t.t >= run->options.until;
    if (!run->plain) {
        run_check_friction(run);
        zeno_log_rests(run);
        zeno_switch_log(run);
    }
    if (at_end) {
        run_evaluate(run); /* including world positions in user events */
        run_apply_touched(run, false);
    }
    if (at_end || ((turn->moving || turn->timed) && balance_is_due(run))) run_check_balance(run);
    run_check_lifetimes(run);
    if (run->end.outcome == FBD_GOING && at_end) run->end.outcome = FBD_DONE;
    if (run->end.outcome == FBD_GOING && !run->plain)
        watchers_arm(&run->watchers, run->state, run->state->t - run->step.from);
    if (run->projected || run->model->plan.watch_count > 0) scan_forget(&run->search.moving);
    run_limit_flight(run);
}

fbd_outcome run_advance(struct run *run)
{
    struct turn turn;
    if (run->end.outcome == FBD_GOING && begin_step(run) && limit_step(run, &turn) &&
        step_to_event(run, &turn) && tell_events(run, &turn) && accept_step(run, &turn) &&
        apply_events(run, &turn))
        end_step(run, &turn);
    return run->end.outcome;
}
