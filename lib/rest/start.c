/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/start.h"

#include <string.h>

#include "dynamics/contact.h"
#include "dynamics/friction.h"
#include "dynamics/modes.h"
#include "dynamics/nonfinite.h"
#include "dynamics/project.h"
#include "events/watchers.h"
#include "expr/unit.h"
#include "model/model.h"
#include "rest/balance.h"
#include "rest/fit.h"

static bool massless_lack(const struct fbd_state *state, struct lack *lack)
{
    struct unresisted motion;
    if (!state_is_unresisted(state, &motion)) return false;
    lack->id = "no-inertia";
    lack->at = motion.at;
    text_printf(&lack->text, "%s at t = ", motion.text);
    text_number(&lack->text, state->t, 9);
    text_add(&lack->text,
             ": a body without mass must be joined to one that has some, so that it moves with it");
    return true;
}

bool start_finite(const struct fbd_state *state, struct lack *lack)
{
    struct nonfinite found;
    if (massless_lack(state, lack)) return false;
    if (!nonfinite_find(state, &found)) return true;
    lack->id = "not-finite";
    lack->at = found.at;
    text_printf(&lack->text, "%s is not finite at t = ", found.what);
    text_number(&lack->text, state->t, 9);
    text_printf(&lack->text, ": %s", nonfinite_reason(found.value));
    return false;
}

/* Shapes that overlap have no side at which they could touch. */
static bool overlap_lack(struct fbd_state *state, struct pos *at, struct text *why)
{
    const struct fbd_model *model = state->model;
    double depth;
    int meeting = contacts_overlap(state, &depth);
    if (meeting < 0) return false;
    const struct constraint *source = &model->scene->constraints[model->tree->meetings[meeting].constraint];
    *at = source->at;
    text_printf(why, "the shapes of the contact `%s` are in each other by ", source->name);
    text_number(why, depth, 6);
    char unit[24];
    unit_name(DIM_LENGTH, model->scene->units, unit, sizeof unit);
    text_printf(why, " %s", unit);
    return true;
}

bool start_fits(struct fbd_state *state, struct fbd_state *other, bool modes, const char *what,
                struct lack *lack)
{
    struct text why = {0};
    *lack = (struct lack){0};
    bool fits = !fit_blocked(state, &lack->at, &why) && !overlap_lack(state, &lack->at, &why) &&
                !(modes && fit_lack(state, other, &lack->at, &why));
    if (fits) return true;
    lack->id = "does-not-fit";
    text_printf(&lack->text, "%s does not fit: %s", what, why.failed ? "" : why.data);
    lack->text.failed |= why.failed;
    text_free(&why);
    return false;
}

/* Is it friction already? The friction of a rolling coupling has the name of the coupling. */
static bool is_friction(const struct load *load)
{
    return load->kind == load_friction || load->kind == moment_friction || load->kind == load_rope ||
           strchr(load->name, '.');
}

const char *unsettled_advice(const struct fbd_model *model, int load)
{
    if (load >= 0 && model->loads[load].source->kind == load_contact)
        return "The contact opens and closes, or sticks and slips, faster than can be followed: reduce "
               "friction or restitution, or end the run earlier by an event";
    bool declared = load >= 0 ? is_friction(model->loads[load].source) : model->plan.kink_count == 0;
    return declared ? "Friction alternates between sticking and slipping at this instant; no consistent mode "
                      "exists. In a law of friction write the speed over its surface as `slip`; or end the "
                      "run earlier by an event"
                    : "A force that jumps against the motion, as c*sign(v), is dry friction: declare it as "
                      "`friction`";
}

/* A rolling coupling without limits has friction without a normal force: it could hold itself down. */
static void contradiction_words(const struct fbd_model *model, int pair, const char *when, struct text *text)
{
    const struct mode *hold = &model->plan.modes[pair];
    bool couples = hold->kind == mode_surface || hold->kind == mode_rope;
    const struct coupling *coupling = couples ? &model->tree->couplings[hold->coupling] : NULL;
    const char *name = coupling          ? model->scene->constraints[coupling->constraint].name
                       : hold->load >= 0 ? model->loads[hold->load].source->name
                                         : "a hold";
    bool unlimited = hold->kind == mode_surface && coupling && coupling->pair < 0;
    text_printf(
        text, "%s neither mode agrees with the forces for `%s` of `%s`: each of the two requires the other. ",
        when, name, model->bodies[hold->body].name);
    text_add(text, unlimited ? "Its rolling friction has no limit and could hold it down without a normal "
                               "force: give it `static` and `kinetic`"
                             : "Other constraints there are decided with it: reduce the friction, or end the "
                               "run earlier by an event");
}

/* See dynamics/journals.h. */
static void journal_words(const struct fbd_model *model, const struct holds_trouble *holds, const char *when,
                          struct text *text)
{
    const struct mode *mode = &model->plan.modes[holds->pair];
    text_printf(text, "%s the friction `%s` of the bearing of `%s` is not determined: ", when,
                model->loads[mode->load].source->name, model->bodies[mode->body].name);
    if (holds->answer == 0) {
        text_add(text,
                 "the reaction of its pin is statically indeterminate. Leave out redundant constraints, "
                 "or give the bearing a moment, `coefficient`");
        return;
    }
    text_add(text, "each newton metre of it changes the limit mu r R by ");
    text_number(text, holds->answer, 4);
    text_add(text, " N*m, and from 1 on there may be several solutions or none. Reduce the radius of the "
                   "journal or its coefficient");
}

static bool is_journal(const struct mode *mode)
{
    return mode->moment && mode->normal_slot >= 0 && mode->coupling < 0;
}

void unsettled_words(const struct fbd_state *state, const char *when, struct text *text)
{
    const struct fbd_model *model = state->model;
    const struct holds_trouble *holds = &state->holds;
    if (holds->found == holds_none && holds->pair >= 0 && is_journal(&model->plan.modes[holds->pair])) {
        journal_words(model, holds, when, text);
    } else if (holds->found == holds_none) {
        text_printf(text,
                    "%s no forces within the limits of friction and contacts agree with the motion: there is "
                    "no solution",
                    when);
        if (holds->pair < 0) return;
        const struct mode *mode = &model->plan.modes[holds->pair];
        text_printf(text,
                    ", as in Painleve's paradox. On `%s` each additional newton of the normal force "
                    "increases `%s`, which reduces the normal force by ",
                    model->bodies[mode->body].name, model->loads[mode->load].source->name);
        text_number(text, holds->answer, 4);
        text_add(text, " N, or increases it by as much. Rigid bodies do not determine the motion: reduce the "
                       "friction, or end the run earlier by an event");
    } else if (holds->found == holds_lost) {
        text_printf(text,
                    "%s no forces were found that agree with all constraints, and there are too many "
                    "combinations of modes to try all",
                    when);
    } else if (holds->contradicts >= 0) {
        contradiction_words(model, holds->contradicts, when, text);
    } else {
        text_printf(text, "%s no choice of branches and of stick or slip agrees with the forces. %s", when,
                    unsettled_advice(model, -1));
    }
}

static bool is_solved(struct fbd_state *state, struct lack *lack)
{
    bool masses;
    if (!fit_unsolved(state, &masses, &lack->at, &lack->text)) return true;
    lack->id = masses ? "masses-apart" : "singular-start";
    return false;
}

/* Modes may be inconsistent with the forces because the forces are too inaccurate. */
static bool is_settled(struct fbd_state *state, bool settled, struct lack *lack)
{
    if (settled) return true;
    if (state->holds.found == holds_no_memory) return false;
    const struct holds_trouble trouble = state->holds;
    if (!is_solved(state, lack) && strcmp(lack->id, "masses-apart") == 0) return false;
    state->holds = trouble;
    text_free(&lack->text);
    lack->at = (struct pos){0, 0};
    const double ratio = tree_joins(state->model->tree) ? state->model->tree->mass_ratio : 0;
    lack->id = ratio > masses_too_far_apart  ? "masses-apart"
               : trouble.found == holds_none ? "no-solution"
                                             : "unsettled";
    unsettled_words(state, "at the start", &lack->text);
    if (ratio > masses_too_far_apart)
        text_printf(&lack->text,
                    ". The heaviest of the jointed bodies has %.2g times the mass of the lightest, and up to "
                    "about 1e12 can be solved",
                    ratio);
    return false;
}

void start_contact_words(const struct fbd_model *model, const struct contact *contact, double t, double N,
                         struct text *text)
{
    const struct load *belt = model->loads[contact->load].source;
    text_add(text, "at t = ");
    text_number(text, t, 9);
    if (belt->kind == load_belt) {
        text_printf(text, " a strand of the belt `%s` becomes slack: its tension is ", belt->name);
        text_number(text, N, 6);
        text_add(text,
                 ". Increase its `tension`, or the force that separates its axes, or end the run earlier");
        return;
    }
    if (belt->kind == load_contact) {
        text_printf(text, " `%s` comes off its slot `%s`, which would have to pull (N = ",
                    model->bodies[contact->body].name, belt->name);
        text_number(text, N, 6);
        text_add(text, "). Leave `side` out if it is guided on both sides, add a spring that presses it on, "
                       "or end the run earlier by an event");
        return;
    }
    text_printf(text, " `%s` leaves its surface: the normal force would have to pull (N = ",
                model->bodies[contact->body].name);
    text_number(text, N, 6);
    /* The surface of a `roll`, which is identified by its name and is no entry of the body, has no other
     * side. */
    bool listed = !strchr(model->loads[contact->load].source->name, '.');
    text_add(text, listed ? "). Declare the normal force `two_sided` if it is a guide, or end the run earlier"
                          : "). A rolling body is not held to its line: end the run earlier by an event");
}

/* No normal force of a surface is negative. */
static bool rests_on_surfaces(const struct fbd_state *state, struct lack *lack)
{
    const struct fbd_model *model = state->model;
    for (size_t i = 0; i < model->plan.contact_count; i++) {
        const struct contact *contact = &model->plan.contacts[i];
        if (contact->pair >= 0) continue;
        double N = -state->slots[contact->slot];
        if (N >= -watchers_contact_slack(model, state->tree, contact)) continue;
        lack->id = "leaves-surface";
        lack->at = model->loads[contact->load].source->at;
        start_contact_words(model, contact, state->t, N, &lack->text);
        return false;
    }
    return true;
}

static bool is_free_to_move(struct fbd_state *state, struct fbd_state *other, struct lack *lack)
{
    if (!fit_locked(state, other, &lack->at, &lack->text)) return true;
    lack->id = "singular-start";
    return false;
}

/* The forces balance the accelerations. */
static bool is_balanced(struct fbd_state *state, struct lack *lack)
{
    if (!balance_lack(state, &lack->text)) return true;
    lack->id = "forces-unbalanced";
    return false;
}

void negative_friction_words(const struct fbd_model *model, int pair, double mu, double t, struct text *text)
{
    const struct mode *mode = &model->plan.modes[pair];
    const char *name =
        mode->load >= 0 ? model->loads[mode->load].source->name
                        : model->scene->constraints[model->tree->couplings[mode->coupling].constraint].name;
    text_add(text, "at t = ");
    text_number(text, t, 9);
    text_printf(text, " a coefficient of `%s` is ", name);
    text_number(text, mu, 4);
    text_add(text, ": below zero friction would push; write `max(0, ...)` where it is to end");
}

static bool rubs_against_motion(const struct fbd_state *state, struct lack *lack)
{
    const struct instant at = state_instant(state);
    for (int pair = 0; pair < (int)state->model->plan.mode_count; pair++) {
        double mu = friction_below_zero(state->model, pair, &at);
        if (mu == 0) continue;
        lack->id = "negative-friction";
        negative_friction_words(state->model, pair, mu, state->t, &lack->text);
        return false;
    }
    return true;
}

bool start_ready(struct fbd_state *state, struct fbd_state *other, const char *what, struct lack *lack)
{
    bool settled = modes_settle(state, NULL);
    *lack = (struct lack){0};
    if (state->holds.found == holds_no_memory) return false;
    if (!start_fits(state, other, settled, what, lack)) return false;
    /* Settle again: the projection may have changed positions, and speeds of branches. */
    bool again = !settled || tree_joins(state->model->tree) || state->model->plan.kink_count > 0;
    if (settled) state_project(state, false);
    if (again) settled = modes_settle(state, NULL);
    return start_finite(state, lack) && rubs_against_motion(state, lack) &&
           is_settled(state, settled, lack) && rests_on_surfaces(state, lack) && is_solved(state, lack) &&
           is_free_to_move(state, other, lack) && is_balanced(state, lack);
}

bool start_question(struct fbd_state *state, bool modes, const char *what, fbd_errors *errors)
{
    struct lack lack = {0};
    struct fbd_state *other = state_new(state->model);
    bool fine = other && start_fits(state, other, modes, what, &lack);
    if (fine) {
        state_evaluate(state);
        fine = start_finite(state, &lack);
    }
    if (!fine) lack_note(&lack, errors);
    state_free(other);
    return fine;
}

void lack_note(struct lack *lack, fbd_errors *errors)
{
    if (!lack->id || lack->text.failed)
        diag_out_of_memory(errors);
    else
        diag_add(errors, FBD_ERROR, lack->id, lack->at, NULL, "%s", lack->text.data);
    text_free(&lack->text);
}

bool start_check(struct fbd_state *state, const char *what, fbd_errors *errors)
{
    struct lack lack = {0};
    struct fbd_state *other = state_new(state->model);
    diag_in_file(errors, state->model->scene->file);
    bool ready = other && start_ready(state, other, what, &lack);
    if (!ready) lack_note(&lack, errors);
    text_free(&lack.text);
    state_free(other);
    return ready;
}
