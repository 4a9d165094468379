/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Forces and couplings that begin and end during a run.
 *
 * A force begins and ends without impulse. Where it has a potential, that begins or ends with it: the energy which the
 * bodies have in it is its work at that instant, as of a spring that breaks.
 *
 * The end of a coupling changes neither positions nor velocities, and does no work. Where a coupling begins, its
 * positions must fit, and the velocities become compatible with it by a plastic impact. Its impulses are those of the
 * rows J of all two-sided couplings, J v' = 0: v' = v - M^-1 J^T (J M^-1 J^T)^-1 J v, the projection of v in the metric
 * M. Closed contacts, taut ropes and surfaces have theirs after that: the projection onto a cone within a subspace is
 * that of the projection onto the subspace, so that both together are the plastic impact with all of them.
 *
 * Friction of guides would take its share of such an impulse, which is not computed: the run ends there by name.
 *
 * Checked by the ballistic pendulum and other closed forms (tests/unit/test_ends.c).
 */
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/energy.h"
#include "dynamics/friction.h"
#include "dynamics/impulse.h"
#include "dynamics/project.h"
#include "dynamics/reactions.h"
#include "dynamics/world_refs.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

/* ---- forces */

static void change_force(struct run *run, int watch, enum life life)
{
    const struct watch *of = &run->model->plan.watches[watch];
    const struct fbd_model *model = run->model;
    struct fbd_state *state = run->state;
    const struct instant at = state_instant(state);
    double energy = 0;
    impulse_look(state);
    for (size_t i = 0; i < model->load_count; i++) {
        if (model->loads[i].source->lifetime.number != of->source->lifetime) continue;
        int *now = &state->tree->life[of->source->lifetime - 1];
        const int before = *now;
        *now = life_there;
        const double V = potential_energy(model, &model->loads[i], &at, run->work.sample);
        *now = before;
        run->impact_work[i] += life == life_there ? V : -V;
        energy += V;
    }
    state->tree->life[of->source->lifetime - 1] = (int)life;
    run->energy.lowered += life == life_there ? energy : -energy;
    struct run_event *event =
        log_event(run, life == life_there ? FBD_EVENT_FORCE_BEGINS : FBD_EVENT_FORCE_ENDS,
                  model->loads[of->load].body, of->load, watch);
    if (event) event->force = energy;
    run->ended = true;
}

/* ---- the end of a coupling */

static void end_coupling(struct run *run, int watch)
{
    const struct watch *ending = &run->model->plan.watches[watch];
    const struct tree *tree = run->model->tree;
    struct fbd_state *state = run->state;
    for (int i = ending->coupling; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling->source->lifetime.number != ending->source->lifetime) break;
        state->tree->couplings[i].feature = no_feature;
        const int modes[] = {coupling->pair, coupling->surface};
        for (int k = 0; k < 2; k++)
            if (modes[k] >= 0) state->slip[modes[k]] = slip_plus;
    }
    state->tree->life[ending->source->lifetime - 1] = life_over;
    log_event(run, FBD_EVENT_COUPLING_ENDS, constraint_first_body(tree->couplings[ending->coupling].source),
              -1, watch);
    run->ended = true;
}

/* ---- the begin of a coupling */

/* The size of the scene, for the tolerance of positions. */
static double reach_of(const struct run *run)
{
    const struct tree *tree = run->model->tree;
    double reach = 0;
    for (int i = 1; i < tree->count; i++) reach = fmax(reach, vec_norm(run->state->tree->links[i].p));
    for (int i = 0; i < tree->coupling_count; i++) reach = fmax(reach, coupling_extent(&tree->couplings[i]));
    return reach;
}

/* Do the positions fit, to the accuracy of numbers in a file? A rope may be longer than its path. */
static bool fits(struct run *run, int index, int watch)
{
    const struct coupling *coupling = &run->model->tree->couplings[index];
    const struct row *rows = &run->state->tree->rows[coupling->first_row];
    const double sign = coupling->kind == constraint_rope ? 1 : 0;
    double off = 0;
    for (int k = 0; k < coupling->row_count; k++) off = hypot(off, sign * rows[k].g.x < 0 ? 0 : rows[k].g.x);
    if (off <= contact_level * reach_of(run)) return true;
    run_fail(run, FBD_BROKEN,
             "at t = %.9g the coupling `%s` begins (%s), and does not fit: it is off by %.6g %s. Let it "
             "begin where its ends fit",
             run_time(run), coupling->name, run->model->plan.watches[watch].source->text, off,
             run->model->scene->units == unit_si ? "m" : "ft");
    return false;
}

/* Friction that would take its share of the impulse; NULL without any. */
static const char *rubbing_guide(const struct run *run)
{
    const struct plan *plan = &run->model->plan;
    for (size_t i = 0; i < plan->mode_count; i++) {
        const struct mode *mode = &plan->modes[i];
        if (mode_has_ended(run->state, (int)i) || !mode_is_friction(mode)) continue;
        if (mode->coupling < 0 && friction_takes_impulses(run->model, mode) && !friction_is_never(mode))
            return run->model->loads[mode->load].source->name;
    }
    return NULL;
}

/* Open everything one-sided, and friction. Rolling without a limit remains. */
static void open_modes(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    for (size_t i = 0; i < plan->mode_count; i++) {
        const struct mode *mode = &plan->modes[i];
        int *slip = &run->state->slip[i];
        if (mode_is_friction(mode) || mode->kind == mode_rope || mode->kind == mode_contact)
            *slip = slip_plus;
        if (mode->kind == mode_surface && *slip == stick)
            *slip = run->model->tree->couplings[mode->coupling].pair >= 0 ? slip_plus : loose;
    }
}

/* Project the velocities onto the two-sided couplings. */
static void strike_two_sided(struct run *run)
{
    struct fbd_state *state = run->state;
    const size_t bytes = run->model->plan.mode_count * sizeof *state->slip;
    memcpy(state->slip_before, state->slip, bytes);
    open_modes(run);
    state_project_velocity(state, false);
    memcpy(state->slip, state->slip_before, bytes);
    impulse_look(state);
}

/* Open one-sided constraints that separate after the impact. */
static void open_separating(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    const struct instant at = state_instant(run->state);
    impulse_look(run->state);
    for (int i = 0; i < (int)plan->mode_count; i++) {
        const struct mode *mode = &plan->modes[i];
        if (!mode_is_one_sided(mode) || run->state->slip[i] != stick) continue;
        if (!one_sided_at(run->model, &at, i).parts) continue;
        run->state->slip[i] = slip_plus;
        run->state->tree->couplings[mode->coupling].feature = no_feature;
    }
}

/* Let all its pieces begin; false where their positions do not fit. */
static bool start_pieces(struct run *run, int watch)
{
    const struct tree *tree = run->model->tree;
    const int first = run->model->plan.watches[watch].coupling,
              constraint = tree->couplings[first].constraint;
    struct fbd_state *state = run->state;
    const struct instant at = state_instant(state);
    impulse_look(state);
    state->tree->life[run->model->plan.watches[watch].source->lifetime - 1] = life_there;
    for (int i = first; i < tree->coupling_count && tree->couplings[i].constraint == constraint; i++)
        coupling_begin(run->model, &at, i);
    impulse_look(state);
    for (int i = first; i < tree->coupling_count && tree->couplings[i].constraint == constraint; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (!fits(run, i, watch)) return false;
        if (coupling->pair >= 0)
            state->slip[coupling->pair] = one_sided_at(run->model, &at, coupling->pair).excess <
                                                  -one_sided_at(run->model, &at, coupling->pair).near
                                              ? slip_plus
                                              : stick;
    }
    return true;
}

static void begin_coupling(struct run *run, int watch)
{
    const struct watch *beginning = &run->model->plan.watches[watch];
    const struct coupling *coupling = &run->model->tree->couplings[beginning->coupling];
    const double before = total_kinetic_energy(run->state);
    const char *guide = rubbing_guide(run);
    if (guide) {
        run_fail(
            run, FBD_BROKEN,
            "at t = %.9g the coupling `%s` begins by an impact, of which the friction `%s` of a guide would "
            "take its share: this is not computed. Give the guide no friction, or end the run earlier by an "
            "event",
            run_time(run), coupling->name, guide);
        return;
    }
    if (!start_pieces(run, watch)) return;
    state_project_position(run->state);
    impulse_look(run->state);
    strike_two_sided(run);
    const double after = total_kinetic_energy(run->state);
    run_strike_closed(run);
    open_separating(run);
    run->impact_work[coupling->load] += after - before;
    struct run_event *event = log_event(run, FBD_EVENT_COUPLING_BEGINS,
                                        constraint_first_body(coupling->source), coupling->load, watch);
    if (event) event->force = before - total_kinetic_energy(run->state);
    run->ended = true;
}

/* ---- all */

/* Is the begin or end of a watch still to come? An end waits for the begin. */
static bool is_to_come(const struct run *run, const struct user_event *source)
{
    const int life = run->state->tree->life[source->lifetime - 1];
    return life == (source->begins ? life_waits : life_there);
}

void run_change_lifetime(struct run *run, int watch)
{
    const struct watch *of = &run->model->plan.watches[watch];
    if (!is_to_come(run, of->source)) return;
    if (of->coupling < 0)
        change_force(run, watch, of->source->begins ? life_there : life_over);
    else if (of->source->begins)
        begin_coupling(run, watch);
    else
        end_coupling(run, watch);
}

/* Exactly at its limit a condition is true from now on if its rate leads beyond it. */
static bool is_due(const struct run *run, const struct watch *watch, const struct instant *at)
{
    if (!watch_of_lifetime(watch->source) || !is_to_come(run, watch->source)) return false;
    const double value = formula_value(&watch->left, at) - formula_value(&watch->right, at);
    const double side = value != 0 ? value : watch_rate(watch, run->state);
    return watch->source->direction * side > 0 && run->end.outcome == FBD_GOING;
}

bool run_change_lifetimes(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    const struct instant at = state_instant(run->state);
    /* First the ends: the reactions of forces and couplings that begin here are not known yet. */
    for (int begins = 0; begins < 2; begins++)
        for (size_t i = 0; i < plan->watch_count; i++)
            if (plan->watches[i].source->begins == (begins > 0) && is_due(run, &plan->watches[i], &at))
                run_change_lifetime(run, (int)i);
    const bool any = run->ended && run->end.outcome == FBD_GOING;
    run->ended = false;
    return any;
}

void run_check_lifetimes(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    if (plan->watch_count == 0) return;
    if (run->model->names_reactions) reactions_copy(run->model, run->state->y, run->state->extended);
    const struct instant now = state_instant(run->state), at = instant_extend(run->model, &now);
    for (size_t i = 0; i < plan->watch_count; i++) {
        const struct watch *watch = &plan->watches[i];
        if (run->watchers.armed[i] != 0 || !is_due(run, watch, &at)) continue;
        run_fail(
            run, FBD_BROKEN,
            "before t = %.9g the condition `%s` of `%s` has become true, from exactly its limit without a "
            "rate: its instant is not found. Give it another limit, or the condition that sets the scene in "
            "motion",
            run_time(run), watch->source->text,
            watch->coupling < 0 ? run->model->loads[watch->load].source->name
                                : run->model->tree->couplings[watch->coupling].name);
    }
}
