/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The values of the names of a derivation at a state, and the states at which derivations are compared.
 */
#include <stdlib.h>
#include <string.h>

#include "dynamics/diagram.h"
#include "dynamics/mass.h"
#include "output/hand.h"
#include "output/hand_forces.h"
#include "output/random_state.h"

enum { parameter_draws = 12, states_of_a_draw = 24, tries_of_a_state = 8 };

size_t hand_room(const struct fbd_model *model)
{
    return plan_size(&model->plan) + hand_slots + model->absolute_count;
}

/* Minus the sum in its slot is the normal force of a body's own surface. */
static double normal_force(const struct fbd_state *state, const struct model_body *body,
                           const struct hand_named *named)
{
    const struct fbd_model *model = state->model;
    struct instant at = state_instant(state);
    diagram_list(model, (int)(body - model->bodies), &at, state->slots, named->arrows);
    for (int i = 0; i < body->load_count; i++) /* those come first */
        if (model->loads[body->first_load + i].source->kind == load_normal)
            return vec_dot(named->arrows[i].force, surface_normal(model, body, &at));
    return 0;
}

void hand_extend(const struct fbd_state *state, int b, const struct hand_named *named, double *y)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    size_t size = plan_size(&model->plan);
    double *extra = y + size;
    struct instant at = state_instant(state);
    memcpy(y, state->y, size * sizeof *y);
    memset(extra, 0, hand_slots * sizeof *extra);
    for (int k = 0; k < body->count; k++) extra[hand_acceleration + k] = state->a[body->first + k];
    if (model->absolute_count > 0)
        memcpy(extra + hand_slots, state->y + size + hand_slots, model->absolute_count * sizeof *extra);
    hand_named_write(state, named, extra + hand_slots);
    extra[hand_mass] = body_mass(body, &at);
    extra[hand_I_G] = body_inertia(body, &at).I_G;
    extra[hand_I_O] = body_I_O(body, &at);
    extra[hand_L] = body->L;
    extra[hand_N] = normal_force(state, body, named);
    if (body->friction >= 0) {
        extra[hand_mu_s] = formula_value(&model->plan.modes[body->friction].mu_s, &at);
        extra[hand_mu_k] = formula_value(&model->plan.modes[body->friction].mu_k, &at);
    }
}

/* ---- random states */

/* Draw states of one model and visit every one that is admissible and moves (a body at rest has no equation
 * of motion). */
static bool visit_model(const fbd_model *model, gsl_rng *rng, hand_visit *visit, void *context)
{
    struct fbd_state *start = state_new(model), *state = start ? state_new(model) : NULL;
    size_t extended = hand_room(model);
    double *y = calloc(extended + random_path_room(model), sizeof *y);
    struct random_path path = {.start = start, .y = y ? y + extended : NULL};
    struct arena arena = {0};
    struct hand_named named;
    bool done = state && y && hand_named_find(model, &arena, &named), first = true;
    for (int i = 0; done && i < states_of_a_draw; i++)
        for (int k = 0; k < tries_of_a_state; k++) {
            if (!random_state(rng, state, &path) || !random_admissible(state)) continue;
            done = visit(context, state, &named, y, first);
            first = false;
            break;
        }
    free(y);
    state_free(start);
    state_free(state);
    arena_free(&arena);
    return done;
}

bool hand_each_state(const struct hand_check *check, gsl_rng *rng, hand_visit *visit, void *context)
{
    if (!visit_model(check->model, rng, visit, context)) return false;
    for (int draw = 1; draw < parameter_draws; draw++) {
        fbd_model *changed;
        bool done = random_model(&check->document, check->model, rng, check->spread, &changed) &&
                    (!changed || visit_model(changed, rng, visit, context));
        model_free(changed);
        if (!done) return false;
    }
    return true;
}
