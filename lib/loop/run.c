/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/run.h"

#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/closed_loops.h"
#include "dynamics/constraint.h"
#include "dynamics/nonfinite.h"
#include "dynamics/project.h"
#include "loop/switch_event.h"
#include "numeric/tolerances.h"
#include "rest/start.h"

/* ---- the system of the stepper */

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    struct fbd_state *during = rates_state(params);
    struct instant at = state_instant_at(during, t, y);
    closed_loops_suspend(during->tree->loops, true);
    state_jacobian(during->model, &at, during->scratch, dfdy, dfdt);
    return GSL_SUCCESS;
}

/* Bind the right-hand side in the modes of the next step. */
static void bind_rates(struct run *run)
{
    rates_bind(run->rates);
    run->system.inner.function = rates_call(run->rates, &run->system.inner.params);
}

/* ---- allocation and start */

/* Do the works of all loads follow from potentials that are there all the time? */
static bool has_potentials(const struct fbd_model *model)
{
    for (size_t i = 0; i < model->load_count; i++)
        if (model->loads[i].potential_kind == potential_none || model->loads[i].source->lifetime.number > 0)
            return false;
    return true;
}

/* Does a step need the forces at its end? Friction of single bodies does where it changes its own normal
 * force. */
static bool asks_forces(const struct run *run)
{
    const struct plan *plan = &run->model->plan;
    if (plan->kink_count > 0 || run->poles.count > 0 || run->model->names_reactions) return true;
    for (size_t i = 0; i < plan->mode_count; i++) {
        const struct mode *mode = &plan->modes[i];
        if (mode->kind != mode_single || tree_joins(run->model->tree) ||
            (mode->two_sided && mode->normal_slot >= 0))
            return true;
    }
    return false;
}

/* The accuracy for which the projection is designed. Next to a singular position, rows with a small gradient
 * are left out where their rounding exceeds it (project.c); with the accuracy of a tolerance of 1e-14 they
 * would be left out for so long that the mechanism drifts from its couplings or loses energy. */
static double projected_accuracy(const struct run_options *options)
{
    const double least = 1e-10;
    return fmax(options->tolerance, least);
}

static bool make_linear(struct run *run)
{
    const struct fbd_model *model = run->model;
    run->keeps_force = ARENA_ARRAY(run->memory, model->load_count, bool);
    if (!run->keeps_force) return false;
    for (size_t i = 0; i < model->load_count; i++)
        run->keeps_force[i] = structure_keeps_force(model, &model->loads[i]);
    size_t modes = (size_t)model->plan.branches + 2 * model->plan.mode_count;
    return linear_pace_init(&run->pace, plan_size(&model->plan), modes);
}

static bool make_run(struct run *run, const struct state_start *begin)
{
    const struct plan *plan = &run->model->plan;
    struct arena *memory = run->memory;
    size_t size = plan_size(plan);
    run->state = state_make(run->model, begin, memory);
    run->during = state_make(run->model, NULL, memory);
    if (run->model->scene->lifetime_count > 0 && !(run->kept_modes = state_make(run->model, NULL, memory)))
        return false;
    run->work.y = ARENA_ARRAY(memory, 5 * size + roundoff_size(run->model), double);
    if (!run->state || !run->during || !run->work.y || !run_make_scans(run)) return false;
    run->state->tree->accuracy = run->during->tree->accuracy = projected_accuracy(&run->options);
    if (!poles_init(&run->poles, run->model, memory)) return false;
    if (!coupled_scales_init(&run->mechanisms, run->model, memory)) return false;
    run->work.f = run->work.y + size;
    run->work.sample = run->work.f + size;
    run->work.aside = run->work.sample + size;
    roundoff_init(run, run->work.aside + 2 * size);
    size_t functions = 2 * run->search.moving.count, timed = 3 * run->search.timed.count;
    run->work.values = ARENA_ARRAY(memory, functions > timed ? functions : timed, double);
    run->work.kept = ARENA_ARRAY(memory, 2 * size, double);
    run->work.crossed = ARENA_ARRAY(memory, run->search.moving.count, bool);
    run->recent.anchor = ARENA_ARRAY(memory, 2 * size, double);
    run->decided.branches = ARENA_ARRAY(memory, (size_t)plan->branches + 2 * plan->mode_count, bool);
    if (!contacts_work_init(&run->contacts, run->model, memory) || !zeno_switch_init(run)) return false;
    run->watchers.asleep = run->contacts.asleep;
    run->watchers.deep = run->contacts.deep;
    run->impact_work = ARENA_ARRAY(memory, run->model->load_count, double);
    run->energy.y = ARENA_ARRAY(memory, size, double);
    run->snap.pair = -1;
    if (memory->failed) return false;
    run->decided.slips = run->decided.branches + plan->branches;
    run->decided.pulls = run->decided.slips + plan->mode_count;
    const struct tree *tree = run->model->tree;
    bool meets = tree->meeting_count > 0, couples = tree->coupling_count > 0;
    run->lazy = !meets && !asks_forces(run);
    bool quiet =
        run->lazy && plan->mode_count == 0 && run->watchers.timed.count + run->watchers.moving.count == 0;
    run->plain = quiet && !couples;
    run->undisturbed = quiet && (!couples || couplings_go_on(tree));
    run->rates = rates_new(run->during, rates_by_rows);
    if (!run->rates) return false;
    gsl_odeiv2_system system = {.jacobian = jacobian, .dimension = size};
    system.function = rates_call(run->rates, &system.params);
    counted_system_init(&run->system, &system);
    if (!run_make_stepper(run)) return false;
    run->leaps = run->plain && run->kind == structure_linear && has_potentials(run->model);
    return run->kind != structure_linear || make_linear(run);
}

static void refuse(struct run *run, struct lack *lack)
{
    if (!lack->id || lack->text.failed) {
        run_fail(run, FBD_OUT_OF_MEMORY, "out of memory");
    } else {
        run->end.refusal = lack->id;
        run->end.refusal_at = lack->at;
        if (strcmp(lack->id, "leaves-surface") == 0) run_check_contacts(run, NULL); /* logs the event, too */
        run_fail(run, FBD_FAILED, "%s", lack->text.data);
    }
    text_free(&lack->text);
}

/* A scene that cannot move has no equations of motion: one step, whatever its loads. Tested once the initial
 * positions are final. */
static bool hold_fixed(struct run *run)
{
    size_t n = (size_t)run->model->plan.n;
    bool varies = run->kind == structure_general || run->kind == structure_flights;
    bool asks = run_chooses_structure(run) && varies;
    if (!asks || !state_is_fixed(run->state)) return true;
    run->kind = structure_fixed;
    memset(run->state->y + n, 0, n * sizeof *run->state->y);
    switcher_free(run->stepper);
    rates_free(run->rates);
    run->rates = rates_new(run->during, rates_none);
    run->stepper = NULL;
    return run->rates && run_make_stepper(run);
}

static void start(struct run *run)
{
    struct lack lack;
    run->step.restart = true;
    run->step.from = run->state->t;
    run->recent.moment = run_end(run);
    run->progress.start = run->progress.t = run->state->t;
    if (!run_start_contacts(run, &lack)) {
        refuse(run, &lack);
        return;
    }
    if (!start_ready(run->state, run->during, "the start", &lack)) {
        refuse(run, &lack);
        return;
    }
    log_several(run);
    if (!hold_fixed(run)) {
        run_fail(run, FBD_OUT_OF_MEMORY, "out of memory");
        return;
    }
    run_release_contacts(run);
    if (run->options.continues) {
        state_copy(run->during, run->options.start);
        log_mode_changes(run, run->log.count, NULL);
    } else {
        log_lifts_at_start(run);
    }
    run_check_counts(run);
    run_apply_endings(run);
    /* Energies are those after it. */
    memset(run->impact_work, 0, run->model->load_count * sizeof *run->impact_work);
    energy_guard_begin(run);
    projection_begin(run);
    watchers_arm(&run->watchers, run->state, 0);
    if (!(run->options.until > run->state->t)) run->end.outcome = FBD_DONE;
}

struct run *run_new(const struct fbd_model *model, const struct run_options *options,
                    const struct state_start *begin, struct arena *memory)
{
    struct run *run = arena_take(memory, 1, sizeof *run, false);
    if (!run) return NULL;
    *run = (struct run){.memory = memory,
                        .model = model,
                        .options = *options,
                        .recent = {.time = -HUGE_VAL, .interval = {HUGE_VAL, HUGE_VAL}},
                        .end = {.reason = ""}};
    if (!make_run(run, begin)) {
        run_free(run);
        return NULL;
    }
    start(run);
    return run;
}

void run_free(struct run *run)
{
    if (!run) return;
    switcher_free(run->stepper);
    linear_pace_free(&run->pace);
    state_free(run->contacts.trial);
    state_free(run->state);
    state_free(run->during);
    state_free(run->kept_modes);
    rates_free(run->rates);
    free(run->log.events);
}

/* ---- one turn of the loop */

/* Start the stepper at the present state. */
static bool restart(struct run *run)
{
    run_evaluate(run);
    memcpy(run->work.y, run->state->y, plan_size(&run->model->plan) * sizeof *run->work.y);
    scan_forget(&run->search.timed);
    run->search.knows_timed = false;
    scan_forget(&run->search.moving);
    coupled_scales_join(&run->mechanisms, run->state);
    bind_rates(run);
    run_choose_method(run);
    if (!run_is_exact(run)) roundoff_estimate(run);
    watchers_follow(&run->watchers, run->during);
    int status = switcher_reset(run->stepper, &run->system, run_end(run), run->work.y, run->work.f,
                                time_dd_at(run->options.until), &run->step.h);
    if (status != GSL_SUCCESS) {
        run_fail_step(run, stepper_bad_function);
        return false;
    }
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

/* Find the first event within the step and cut the step there; likewise at limits of couplings. */
static bool find_events(struct run *run, struct turn *turn)
{
    turn->moving = false;
    if (run->undisturbed) return true;
    run_watch_slots(run, &turn->t);
    int found = run->end.outcome == FBD_GOING ? run_find_event(run, &turn->t) : 0;
    if (found < 0) {
        run_fail_step(run, stepper_bad_function);
        return false;
    }
    turn->moving = found > 0;
    run_watch_pulleys(run, &turn->t);
    run_watch_ends(run, &turn->t);
    turn->timed = turn->timed && time_dd_equal(turn->t, turn->limit);
    return true;
}

/* A step to the next event, repeated if shapes are in each other at its end: an event was missed. */
static bool step_to_event(struct run *run, struct turn *turn)
{
    for (int time = 0; make_step(run, turn) && find_events(run, turn); time++) {
        if (time == most_times || !run_overlaps(run, turn->t.t)) return true;
        if (!shorten(run, turn)) return run->end.outcome == FBD_GOING;
    }
    return false;
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
    if (turn->moving || turn->timed || at_end) run_check_balance(run);
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
        step_to_event(run, &turn) && accept_step(run, &turn) && apply_events(run, &turn))
        end_step(run, &turn);
    return run->end.outcome;
}
