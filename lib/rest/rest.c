/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Equilibrium of a scene: conditions, search and stability.
 */
#include <math.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "dynamics/modes.h"
#include "dynamics/statics.h"
#include "dynamics/user_states.h"
#include "expr/table.h"
#include "fbd_study.h"
#include "numeric/tolerances.h"
#include "rest/balance.h"
#include "rest/equilibrium.h"
#include "rest/start.h"
#include "rest/statics.h"

/* ---- user states */

/* Is the rate of a user state nonzero, and independent of positions and user states, as that of a clock? */
static bool goes_on(const struct fbd_state *state, int own)
{
    const struct plan *plan = &state->model->plan;
    const int *slots;
    if (state->a[plan->n + own] == 0) return false;
    size_t count = plan->rates[own].expr ? expr_variables(plan->rates[own].expr, &slots) : 0;
    for (size_t k = 0; k < count; k++)
        if (slots[k] <= plan->n || slots[k] > 2 * plan->n) return false;
    return true;
}

bool equilibrium_refuse_states(struct fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    size_t n = (size_t)model->plan.n;
    if (model->plan.own > 0) {
        memset(state->y + n, 0, n * sizeof *state->y);
        state_evaluate(state);
    }
    for (int i = 0; i < model->plan.own; i++) {
        if (!goes_on(state, i)) continue;
        diag_add(errors, FBD_ERROR, "not-at-rest", model->scene->own[i].rate.at,
                 "leave the state out, or simulate it",
                 "the state `%s` is never at rest: its rate is not zero at any position",
                 model->scene->own[i].name);
        return true;
    }
    return false;
}

bool statics_refuse_states(const struct fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    for (int i = 0; i < model->plan.own; i++) {
        double rate = state->a[model->plan.n + i];
        if (fabs(rate) <= six_digits * user_state_rate_size(state, i)) continue;
        diag_add(errors, FBD_ERROR, "not-at-rest", model->scene->own[i].rate.at,
                 "look where it rests (--settle), or give it an `initial` value at which its rate is zero",
                 "the state `%s` changes while all bodies are at rest, by %.6g %s: forces that depend on it "
                 "do not last",
                 model->scene->own[i].name, rate, unit_word(model->own_labels[i].rate_unit));
        return true;
    }
    return false;
}

/* ---- equilibrium */

bool equilibrium_refuse_reels(const struct fbd_model *model, fbd_errors *errors)
{
    for (int i = 0; i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        if (!coupling->reels) continue;
        diag_add(errors, FBD_ERROR, "not-independent",
                 model->scene->constraints[coupling->constraint].reel.at, "give it a constant `length`",
                 "the length of the rope `%s` depends on time: it is never at rest", coupling->name);
        return true;
    }
    return false;
}

/* Refuse scenes without a unique position of rest: dry friction sticks in a range of positions, and a motion
 * prescribed as a function of time does not rest. */
static bool refuse(const struct fbd_state *state, fbd_errors *errors)
{
    const struct fbd_model *model = state->model;
    for (size_t pair = 0; pair < model->plan.mode_count; pair++) {
        const struct mode *mode = &model->plan.modes[pair];
        if (mode->coupling >= 0) continue;
        const struct expr *drive = model->bodies[mode->body].source->motion.prescribed.expr;
        if (mode->kind == mode_drive && !expr_uses_time(drive)) continue;
        diag_add(errors, FBD_ERROR, mode->kind == mode_drive ? "not-independent" : "sticks",
                 mode->kind == mode_drive ? model->bodies[mode->body].source->motion.at
                                          : model->loads[mode->load].source->at,
                 mode->kind == mode_drive ? "give it a place, --at, or a motion without `theta` or `x`"
                                          : "leave the friction out to find the balance of the other forces",
                 mode->kind == mode_drive
                     ? "the motion of `%s` is prescribed: it is never at rest"
                     : "`%s` has dry friction: it rests in a range of places, not in one",
                 model->bodies[mode->body].name);
        return true;
    }
    return equilibrium_refuse_reels(model, errors);
}

/* Is the state beyond the end of a table or a track? */
static bool is_beyond_an_end(const struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    for (size_t i = 0; i < plan->kink_count; i++)
        for (size_t part = 0; part < plan->kinks[i].count; part++) {
            const struct table *table = expr_switch_table(plan->kinks[i].formula.expr, part);
            int piece = state->branch[(size_t)plan->kinks[i].formula.branch + part];
            if (table && plan->kinks[i].body >= 0 && table_has_ended(table, piece)) return true;
        }
    return false;
}

bool equilibrium_holds(struct fbd_state *state)
{
    const double rounding = distinct_part;
    double most = 0;
    if (state->model->plan.kink_count == 0) return true;
    if (!modes_settle(state, NULL) || is_beyond_an_end(state)) return false;
    for (int i = 0; i < state->model->plan.n; i++) most = larger(most, fabs(state->a[i]));
    for (int i = 0; i < state->model->plan.own; i++)
        if (!(fabs(state->a[state->model->plan.n + i]) <= rounding * user_state_rate_size(state, i)))
            return false;
    if (most <= rounding * equilibrium_size(state)) return true;
    return most <= undecided_part * balance_size(state);
}

void equilibrium_refuse(fbd_errors *errors)
{
    diag_add(errors, FBD_ERROR, "no-equilibrium", (struct pos){0, 0}, "look from another state, with --at",
             "forces balance only on a branch of an expression that has been left by then");
}

static bool find_equilibrium(fbd_state *state, fbd_errors *errors)
{
    diag_in_file(errors, state->model->scene->file);
    if (refuse(state, errors)) return false;
    if (!rest_begin(state)) {
        if (state->holds.found == holds_no_memory)
            diag_out_of_memory(errors);
        else
            diag_add(errors, FBD_ERROR, "unsettled", (struct pos){0, 0}, "look from another state, with --at",
                     "at rest no choice of branches agrees with the forces");
        return false;
    }
    if (equilibrium_refuse_states(state, errors)) return false;
    if (!start_question(state, false, "the start", errors))
        return false; /* ropes and modes may be violated at the start */
    int found = equilibrium_settle(state);
    if (state->holds.found == holds_no_memory) found = -1;
    state->settled = false;
    if (found > 0 && !start_question(state, true, place_found, errors)) return false;
    if (found > 0 && equilibrium_holds(state)) return true;
    if (found > 0) equilibrium_refuse(errors);
    if (found < 0) diag_out_of_memory(errors);
    if (found == 0)
        diag_add(errors, FBD_ERROR, "no-equilibrium", (struct pos){0, 0},
                 "start nearer to it: set the initial values, or give --at",
                 "no equilibrium was found near the start");
    return false;
}

/* Warn where the linear motion about the equilibrium grows. False when memory is out. */
static bool warn_of_instability(const fbd_state *state, fbd_errors *errors)
{
    const double rounding =
        distinct_part; /* of the highest frequency: rounding splits a double eigenvalue zero */
    fbd_errors *refusals = fbd_errors_new(); /* of scenes that cannot be linearized; not reported */
    fbd_state *there = state_new(state->model);
    if (there) state_copy(there, state);
    fbd_linearization *linear = there && refusals ? fbd_linearize(there, refusals) : NULL;
    bool done = there && refusals && !refusals->out_of_memory;
    double growth = 0, fastest = 0;
    for (size_t i = 0; i < fbd_linearization_size(linear); i++) {
        const fbd_mode mode = fbd_linearization_mode(linear, i);
        growth = fmax(growth, mode.re);
        fastest = fmax(fastest, mode.frequency);
    }
    if (growth > rounding * fastest)
        diag_add(errors, FBD_WARNING, "unstable-equilibrium", (struct pos){0, 0},
                 "start at a neighbouring position, with --at, to find where the scene comes to rest",
                 "the equilibrium is unstable: a small deviation grows by a factor of e in %.3g s",
                 1 / growth);
    fbd_linearization_free(linear);
    state_free(there);
    fbd_errors_free(refusals);
    return done;
}

bool fbd_find_equilibrium(fbd_state *state, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    bool found = false;
    if (!state) {
        api_refuse(errors, "there is no state");
    } else if (find_equilibrium(state, errors)) {
        found = warn_of_instability(state, errors);
        if (!found) diag_out_of_memory(errors);
    }
    diag_end(&call);
    return found;
}
