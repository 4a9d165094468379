/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rest/statics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "dynamics/friction.h"
#include "dynamics/nonfinite.h"
#include "dynamics/project.h"
#include "fbd_study.h"
#include "numeric/tolerances.h"
#include "rest/members.h"
#include "rest/start.h"

/* ---- the start must satisfy its couplings */

static bool fits(struct fbd_state *state, fbd_errors *errors)
{
    if (!start_question(state, true, "the start", errors)) return false;
    if (state_project(state, false)) return true;
    diag_add(errors, FBD_ERROR, "does-not-fit", (struct pos){0, 0}, NULL,
             "the start fits its couplings to six digits, and no state near it fits better");
    return false;
}

/* At rest, before and after the computation of forces. */
static bool is_finite(const struct fbd_state *state, fbd_errors *errors)
{
    struct lack lack = {0};
    if (start_finite(state, &lack)) return true;
    lack_note(&lack, errors);
    return false;
}

static bool put_to_rest(struct fbd_state *state, fbd_errors *errors)
{
    bool settled = rest_begin(state);
    if (settled && !fits(state, errors)) return false;
    if (settled && !is_finite(state, errors)) return false;
    if (settled && rest_begin(state)) /* again at the projected state */
        return !statics_refuse_states(state, errors);
    if (!is_finite(state, errors)) return false; /* with these no modes settle */
    if (state->holds.found == holds_no_memory) {
        diag_out_of_memory(errors);
        return false;
    }
    diag_add(errors, FBD_ERROR, "unsettled", (struct pos){0, 0}, "look at another state, with --at",
             "at rest no choice of branches agrees with the forces");
    return false;
}

/* ---- results */

/* The contact feature of a limit; NULL if it belongs to another constraint. */
static const struct coupling *touching_coupling(const struct fbd_model *model, const struct rest_limit *limit)
{
    const struct plan *plan = &model->plan;
    int pair = limit->kind == limit_normal ? plan->contacts[limit->index].pair : limit->index;
    int coupling = pair >= 0 ? plan->modes[pair].coupling : -1;
    return coupling >= 0 && model->tree->couplings[coupling].kind == constraint_contact
               ? &model->tree->couplings[coupling]
               : NULL;
}

static const char *limit_name(struct fbd_statics *statics, const struct rest_limit *limit)
{
    const struct fbd_model *model = statics->model;
    const struct plan *plan = &model->plan;
    if (limit->kind == limit_rope) return model->tree->couplings[plan->modes[limit->index].coupling].name;
    const struct coupling *touching = touching_coupling(model, limit);
    if (touching) return touching->end[0].name[limit->kind == limit_normal ? 0 : 1];
    int load =
        limit->kind == limit_normal ? plan->contacts[limit->index].load : plan->modes[limit->index].load;
    const char *name = model->loads[load].source->name;
    for (int i = 0; i < model->tree->coupling_count; i++) { /* of a rolling body, or a belt */
        const struct coupling *coupling = &model->tree->couplings[i];
        if (coupling->strands > 0 && coupling->load == load)
            return coupling->end[0].name[plan->contacts[limit->index].slot == coupling->slack_slot[1]];
        if (coupling_presses(coupling) && coupling->load == load)
            return coupling_force_name(model->tree, coupling->first_row + (limit->kind != limit_normal));
    }
    return arena_printf(&statics->arena, "%s.%s", model->bodies[model->loads[load].body].name, name);
}

/* Is there a limit of this name already? */
static bool is_limit(const struct fbd_statics *statics, const char *name)
{
    size_t i = 0;
    while (i < statics->limit_count && strcmp(statics->limits[i].name, name) != 0) i++;
    return i < statics->limit_count;
}

/* Make names unique, since they are keys of the output: the pieces of a rope that is cut at pulleys are
 * `cord`, `cord_2`. NULL when memory is out. */
static const char *name_limit(struct fbd_statics *statics, const struct rest_limit *limit)
{
    const char *name = limit_name(statics, limit), *made = name;
    for (int number = 2; made && is_limit(statics, made); number++)
        made = arena_printf(&statics->arena, "%s_%d", name, number);
    return made;
}

/* Unit of the force, or of a bearing's moment. */
static const char *limit_unit(const struct fbd_model *model, const struct rest_limit *limit)
{
    bool si = model->scene->units == unit_si;
    bool moment = limit->kind == limit_friction && model->plan.modes[limit->index].moment;
    return moment ? (si ? "N*m" : "lbf*ft") : (si ? "N" : "lbf");
}

static bool find_limits(struct fbd_statics *statics, const struct rest_system *system)
{
    size_t count = rest_limits(system);
    statics->within_limits = system->within_limits;
    statics->limits = ARENA_ARRAY(&statics->arena, count + 1, fbd_limit);
    for (size_t i = 0; statics->limits && i < count; i++) {
        struct rest_limit limit = rest_limit_at(system, i);
        if (limit.kind != limit_normal && statics->state->slip[limit.index] != stick) continue;
        if (limit.kind != limit_normal && !rest_has_limit(&statics->model->plan.modes[limit.index])) continue;
        double slack = 2 * rest_limit_slack(system);
        bool holds =
            limit.kind == limit_friction ? limit.needed <= limit.may + slack : limit.needed >= -slack;
        const char *name = name_limit(statics, &limit);
        if (!name) return false;
        statics->limits[statics->limit_count++] = (fbd_limit){.name = name,
                                                              .unit = limit_unit(statics->model, &limit),
                                                              .kind = (fbd_limit_kind)limit.kind,
                                                              .needed = limit.needed,
                                                              .limit = limit.may,
                                                              .holds = holds};
    }
    return !statics->arena.failed;
}

static bool draw_diagrams(struct fbd_statics *statics)
{
    const struct fbd_model *model = statics->model;
    struct instant at = state_instant(statics->state);
    statics->diagrams = ARENA_ARRAY(&statics->arena, model->body_count, struct rest_diagram);
    for (size_t b = 0; statics->diagrams && b < model->body_count; b++) {
        struct rest_diagram *diagram = &statics->diagrams[b];
        diagram->arrows = ARENA_ARRAY(&statics->arena, diagram_arrows(model, (int)b) + 1, struct arrow);
        if (!diagram->arrows) return false;
        diagram->count = diagram_fill(model, (int)b, &at, statics->state->slots, diagram->arrows);
    }
    return statics->diagrams != NULL;
}

static bool solve(struct fbd_statics *statics)
{
    struct rest_system system;
    bool solved = rest_solve(&system, statics->state, &statics->arena);
    statics->force = system.force;
    statics->length = system.length;
    solved = solved && find_limits(statics, &system) && rest_name_undetermined(statics, &system) &&
             rest_find_unbalanced(statics, &system) && draw_diagrams(statics) && rest_find_members(statics);
    rest_free(&system);
    return solved;
}

/* Are the results besides the forces of the diagrams finite? */
static bool is_known(const struct fbd_statics *statics, fbd_errors *errors)
{
    struct nonfinite found;
    struct pos nowhere = {0, 0};
    bool odd = nonfinite_note(&found, statics->left, nowhere, "what is out of balance");
    for (size_t i = 0; !odd && i < statics->limit_count; i++) {
        const fbd_limit *limit = &statics->limits[i];
        odd = nonfinite_note(&found, limit->needed + limit->limit, nowhere, "what `%s` has to bear, or may",
                             limit->name);
    }
    for (size_t i = 0; !odd && i < statics->unbalanced_count; i++)
        odd = nonfinite_note(&found, statics->unbalanced[i].holding, nowhere, "what would hold `%s`",
                             statics->unbalanced[i].coordinate);
    if (odd) diag_add(errors, FBD_ERROR, "not-finite", nowhere, NULL, "%s is not finite at rest", found.what);
    return !odd && is_finite(statics->state, errors);
}

/* Limits of journals grow with their reactions, of which there are many then. */
static bool knows_journals(const struct fbd_statics *statics, fbd_errors *errors)
{
    const struct plan *plan = &statics->model->plan;
    if (statics->indeterminacy == 0 || statics->model->tree->journal_count == 0) return true;
    for (size_t i = 0; i < plan->mode_count; i++) {
        const struct mode *mode = &plan->modes[i];
        const struct load *load = mode->load < 0 ? NULL : statics->model->loads[mode->load].source;
        if (!load || !load->journal || friction_is_never(mode)) continue;
        diag_add(
            errors, FBD_ERROR, "unsettled", load->at,
            "leave out redundant constraints, or give the bearing a moment, `coefficient`",
            "the reactions are statically indeterminate: the friction `%s`, which depends on them, is not "
            "determined",
            load->name);
        return false;
    }
    return true;
}

static void warn(const struct fbd_statics *statics, fbd_errors *errors)
{
    if (statics->indeterminacy == 0 || !fbd_statics_holds(statics)) return;
    diag_add(errors, FBD_WARNING, "indeterminate", (struct pos){0, 0},
             "of all reactions that balance those of the least sum of squares are shown; the elasticity of "
             "the parts decides: use springs in place of rigid supports",
             "statically indeterminate to degree %zu: equilibrium alone does not determine `%s`%s",
             statics->indeterminacy, statics->undetermined_count > 0 ? statics->undetermined[0] : "",
             statics->undetermined_count > 1 ? " and others" : "");
}

static fbd_statics *statics_new(const fbd_state *state, fbd_errors *errors)
{
    struct fbd_statics *statics = calloc(1, sizeof *statics);
    diag_in_file(errors, state->model->scene->file);
    if (statics) statics->state = state_new(state->model);
    if (!statics || !statics->state) {
        diag_out_of_memory(errors);
        free(statics);
        return NULL;
    }
    statics->model = state->model;
    state_copy(statics->state, state);
    if (put_to_rest(statics->state, errors)) {
        bool solved = solve(statics) && statics->state->holds.found != holds_no_memory;
        if (!solved) diag_out_of_memory(errors);
        if (solved && is_known(statics, errors) && knows_journals(statics, errors)) {
            warn(statics, errors);
            return statics;
        }
    }
    fbd_statics_free(statics);
    return NULL;
}

fbd_statics *fbd_statics_new(const fbd_state *state, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_statics *statics = state ? statics_new(state, errors) : api_refuse(errors, "there is no state");
    diag_end(&call);
    return statics;
}

void fbd_statics_free(fbd_statics *statics)
{
    if (!statics) return;
    state_free(statics->state);
    arena_free(&statics->arena);
    free(statics);
}

bool fbd_statics_holds(const fbd_statics *statics)
{
    return statics && statics->within_limits && statics->left <= six_digits;
}

size_t fbd_statics_indeterminacy(const fbd_statics *statics)
{
    if (!statics) return 0;
    return statics->indeterminacy;
}

size_t fbd_statics_mobility(const fbd_statics *statics)
{
    if (!statics) return 0;
    return statics->mobility;
}

size_t fbd_statics_undetermined_count(const fbd_statics *statics)
{
    if (!statics) return 0;
    return statics->undetermined_count;
}

const char *fbd_statics_undetermined(const fbd_statics *statics, size_t index)
{
    return statics && index < statics->undetermined_count ? statics->undetermined[index] : NULL;
}

size_t fbd_statics_unbalanced_count(const fbd_statics *statics)
{
    if (!statics) return 0;
    return statics->unbalanced_count;
}

fbd_unbalanced fbd_statics_unbalanced(const fbd_statics *statics, size_t index)
{
    return statics && index < statics->unbalanced_count ? statics->unbalanced[index]
                                                        : (fbd_unbalanced){.holding = NAN};
}

size_t fbd_statics_limit_count(const fbd_statics *statics)
{
    if (!statics) return 0;
    return statics->limit_count;
}

fbd_limit fbd_statics_limit(const fbd_statics *statics, size_t index)
{
    return statics && index < statics->limit_count ? statics->limits[index]
                                                   : (fbd_limit){.needed = NAN, .limit = NAN};
}
