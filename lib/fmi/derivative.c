/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/derivative.h"

#include <stdlib.h>

/* ---- entries */

struct jacobian {
    double *by; /* of the accelerations, by the knowns: coordinates x knowns */
    size_t known_count;
};

static double entry(const struct jacobian *jacobian, const fbd_variable *unknown, const fbd_variable *known,
                    size_t column)
{
    if (unknown->kind == FBD_VARIABLE_ACCELERATION)
        return jacobian->by[unknown->index * jacobian->known_count + column];
    return unknown->kind == known->kind && unknown->index == known->index;
}

static fbd_variable variable_of(const struct plant *plant, unsigned reference)
{
    return fbd_model_variable(plant->first, reference);
}

static bool is_known(const fbd_variable *variable)
{
    return variable->name &&
           (variable->kind == FBD_VARIABLE_INPUT || variable->kind == FBD_VARIABLE_COORDINATE ||
            variable->kind == FBD_VARIABLE_RATE);
}

static bool has_derivatives(const fbd_model *model)
{
    fbd_state *state = fbd_state_new(model);
    bool has = state && package_has_derivatives(state);
    fbd_state_free(state);
    return has;
}

static const char *why_not(const struct plant *plant, const struct derivative_call *call)
{
    if ((call->unknown_count > 0 && !call->unknowns) || (call->known_count > 0 && !call->knowns) ||
        !call->seed || !call->answer)
        return "there are no variables, or no values";
    if (!has_derivatives(plant->first))
        return "a model with points, a prescribed motion or `hysteresis` has no derivatives";
    for (size_t i = 0; i < call->unknown_count; i++) {
        const fbd_variable unknown = variable_of(plant, call->unknowns[i]);
        if (!unknown.name || package_causality(plant->first, &unknown) != fmi_output)
            return "an unknown is no output";
    }
    for (size_t k = 0; k < call->known_count; k++) {
        const fbd_variable known = variable_of(plant, call->knowns[k]);
        if (!is_known(&known)) return "a known is no input, coordinate or rate";
    }
    return NULL;
}

static void multiply(const struct jacobian *jacobian, const struct plant *plant,
                     const struct derivative_call *call)
{
    size_t rows = call->unknown_count, columns = call->known_count;
    for (size_t i = 0; i < (call->adjoint ? columns : rows); i++) call->answer[i] = 0;
    for (size_t i = 0; i < rows; i++)
        for (size_t k = 0; k < columns; k++) {
            const fbd_variable unknown = variable_of(plant, call->unknowns[i]),
                               known = variable_of(plant, call->knowns[k]);
            double slope = entry(jacobian, &unknown, &known, k);
            call->answer[call->adjoint ? k : i] += slope * call->seed[call->adjoint ? i : k];
        }
}

/* The present state; one that holds the inputs if one of them is a known. */
static fbd_state *state_for(struct plant *plant, const struct derivative_call *call)
{
    for (size_t k = 0; k < call->known_count; k++)
        if (variable_of(plant, call->knowns[k]).kind == FBD_VARIABLE_INPUT) return plant_held_state(plant);
    return plant->state;
}

static bool make(struct jacobian *jacobian, fbd_state *state, const struct derivative_call *call)
{
    size_t n = fbd_model_coordinate_count(fbd_state_model(state)),
           count = jacobian->known_count = call->known_count;
    size_t *knowns = calloc(count + 1, sizeof *knowns);
    jacobian->by = calloc(n * count + 1, sizeof *jacobian->by);
    bool fine = knowns && jacobian->by;
    for (size_t k = 0; fine && k < count; k++) knowns[k] = call->knowns[k];
    fine = fine && fbd_state_derivatives(state, knowns, count, jacobian->by, NULL);
    free(knowns);
    return fine;
}

enum instance_status derivative_get(struct instance *instance, const struct derivative_call *call)
{
    struct plant *plant = instance->plant;
    const char *why =
        instance->continuous ? "model exchange offers no derivatives here" : why_not(plant, call);
    if (why) return instance_fail(instance, call->function, why);
    if (!plant_update(plant)) return instance_fail(instance, call->function, plant->reason);
    fbd_state *state = state_for(plant, call);
    if (!state) return instance_fail(instance, call->function, plant->reason);
    struct jacobian jacobian = {0};
    bool made = make(&jacobian, state, call);
    if (made) multiply(&jacobian, plant, call);
    free(jacobian.by);
    return made ? instance_ok : instance_fail(instance, call->function, "out of memory");
}
