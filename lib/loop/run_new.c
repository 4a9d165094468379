/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Allocation and start of a run.
 */
#include "loop/run.h"

#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/closed_loops.h"
#include "dynamics/constraint.h"
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

/* ---- allocation and start */

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
    return fmax(options->tolerance, solved_rounding);
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
    run->state->tree->tolerance = run->during->tree->tolerance = run->options.tolerance;
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
    run->decided.branches = ARENA_ARRAY(memory, (size_t)plan->branches + 3 * plan->mode_count, bool);
    if (!contacts_work_init(&run->contacts, run->model, memory) || !zeno_switch_init(run)) return false;
    run->watchers.asleep = run->contacts.asleep;
    run->watchers.deep = run->contacts.deep;
    run->impact_work = ARENA_ARRAY(memory, run->model->load_count, double);
    run->energy.y = ARENA_ARRAY(memory, size, double);
    run->snap.pair = -1;
    if (memory->failed) return false;
    run->decided.slips = run->decided.branches + plan->branches;
    run->decided.pulls = run->decided.slips + plan->mode_count;
    run->decided.aims = run->decided.pulls + plan->mode_count;
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
    run->leaps = run->plain && run->kind == structure_linear && energy_has_potentials(run->model);
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
