/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: derivatives of the accelerations at a state. Those by coordinates and rates are from the exact
 * Jacobian of the equations of motion, those by an input from input_slopes.h.
 */
#include <stdlib.h>

#include "api/input_slopes.h"
#include "base/api_check.h"
#include "base/diag.h"
#include "fbd_view.h"
#include "model/model.h"

/* ---- the columns */

static bool has_derivatives(const struct fbd_model *model)
{
    for (size_t i = 0; i < model->plan.mode_count; i++)
        if (model->plan.modes[i].kind == mode_drive) return false;
    return model->plan.own == 0 && !plan_remembers(&model->plan);
}

static bool is_argument(const fbd_variable *variable)
{
    return variable->name && (variable->kind == FBD_VARIABLE_COORDINATE ||
                              variable->kind == FBD_VARIABLE_RATE || variable->kind == FBD_VARIABLE_INPUT);
}

static bool are_arguments(const fbd_model *model, const size_t *variables, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        const fbd_variable variable = fbd_model_variable(model, variables[k]);
        if (!is_argument(&variable)) return false;
    }
    return true;
}

/* `work` has room for a Jacobian and a derivative by time. */
static bool fill(const fbd_state *state, const size_t *variables, size_t count, double *work,
                 double *derivatives)
{
    size_t n = state->model->scene->coordinate_count, size = 2 * n;
    double *dfdy = work, *dfdu = dfdy + size * size;
    if (!state_slopes(state, dfdy, dfdu)) return false;
    for (size_t k = 0; k < count; k++) {
        const fbd_variable variable = fbd_model_variable(state->model, variables[k]);
        bool by_input = variable.kind == FBD_VARIABLE_INPUT;
        size_t column = variable.kind == FBD_VARIABLE_RATE ? n + variable.index : variable.index;
        if (by_input && !input_slopes(state, variable.index, dfdu)) return false;
        for (size_t i = 0; i < n; i++)
            derivatives[i * count + k] = by_input ? dfdu[n + i] : dfdy[(n + i) * size + column];
    }
    return true;
}

/* Is one of the variables an input that is a constant of the model? */
static bool needs_held_inputs(const fbd_model *model, const size_t *variables, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        const fbd_variable variable = fbd_model_variable(model, variables[k]);
        if (variable.kind == FBD_VARIABLE_INPUT && !model->scene->parameters[variable.index].call.held)
            return true;
    }
    return false;
}

static bool fill_by_inputs(const fbd_state *state, const size_t *variables, size_t count, double *work,
                           double *derivatives)
{
    if (!needs_held_inputs(state->model, variables, count))
        return fill(state, variables, count, work, derivatives);
    struct fbd_model *with = model_with_held_inputs(state->model);
    fbd_state *there = with ? state_with_held_inputs(state, with) : NULL;
    const bool filled = there && fill(there, variables, count, work, derivatives);
    state_free(there);
    model_free(with);
    return filled;
}

static bool derive(const fbd_state *state, const size_t *variables, size_t count, double *derivatives,
                   fbd_errors *errors)
{
    size_t size = 2 * state->model->scene->coordinate_count;
    if (scene_has_calls(state->model->scene)) {
        diag_add(errors, FBD_ERROR, "no-derivatives", (struct pos){0, 0}, NULL,
                 "a model with an input by a callback has no derivatives");
        return false;
    }
    if (!has_derivatives(state->model)) {
        diag_in_file(errors, state->model->scene->file);
        diag_add(errors, FBD_ERROR, "no-derivatives", (struct pos){0, 0}, NULL,
                 "a model with `states`, a prescribed motion or `hysteresis` has no derivatives");
        return false;
    }
    if (count == 0) return true;
    double *work = calloc(size * size + size + 1, sizeof *work);
    bool fine = work && fill_by_inputs(state, variables, count, work, derivatives);
    free(work);
    if (!fine) diag_out_of_memory(errors);
    return fine;
}

bool fbd_state_derivatives(fbd_state *state, const size_t *variables, size_t count, double *derivatives,
                           fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    bool meant =
        state && (count == 0 || (variables && derivatives)) && are_arguments(state->model, variables, count);
    if (!meant)
        api_refuse(errors,
                   "there is no state or place for the derivatives, or a variable is no coordinate, rate "
                   "or input");
    bool fine = meant && derive(state, variables, count, derivatives, errors);
    diag_end(&call);
    return fine;
}
