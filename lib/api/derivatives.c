/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: derivatives of the accelerations at a state.
 *
 * Derivatives by coordinates and rates are those of the exact Jacobian of the equations of motion. For those
 * by an input, a model is compiled in which the input replaces the time and the time is a constant: the
 * derivative by time of its dual numbers is then that by the input.
 */
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/format.h"
#include "dynamics/rates.h"
#include "fbd_view.h"
#include "model/model.h"
#include "output/equations.h"

/* ---- by the state */

/* The Jacobian of a copy of the state: dfdy[2n x 2n] and dfdt[2n]. */
static bool take_jacobian(const fbd_state *state, double *dfdy, double *dfdt)
{
    fbd_state *copy = state_new(state->model);
    if (!copy) return false;
    state_copy(copy, state);
    state_ready(copy);
    struct instant at = state_instant(copy);
    if (state->model->plan.n > 0) state_jacobian(state->model, &at, copy->scratch, dfdy, dfdt);
    state_free(copy);
    return true;
}

/* ---- by an input */

/* The values of the model as overrides: its data files, and all parameters and inputs. */
static struct override *list_overrides(const struct fbd_model *model, size_t input, double t,
                                       struct arena *arena, size_t *count)
{
    const struct scene *scene = model->scene;
    struct override *list =
        ARENA_ARRAY(arena, scene->table_count + scene->parameter_count + 1, struct override);
    if (!list) return NULL;
    *count = 0;
    for (size_t i = 0; i < scene->table_count; i++)
        if (scene->tables[i].path)
            list[(*count)++] =
                (struct override){.name = scene->tables[i].name, .value = scene->tables[i].path};
    for (size_t i = 0; i < scene->parameter_count; i++) {
        char number[40];
        format_shortest(number, sizeof number, scene->parameters[i].value);
        const char *text = arena_text(arena, number, strlen(number));
        if (!text) return NULL;
        list[(*count)++] = (struct override){.name = scene->parameters[i].name,
                                             .value = text,
                                             .as_time = i == input,
                                             .now = t};
    }
    return list;
}

static struct fbd_model *model_by(const fbd_state *state, size_t input)
{
    struct arena arena = {0};
    size_t count;
    const struct fbd_model *model = state->model;
    fbd_errors *errors = fbd_errors_new();
    const struct override *overrides = errors ? list_overrides(model, input, state->t, &arena, &count) : NULL;
    struct scene *scene = NULL;
    if (overrides)
        scene = scene_read(model->source, model->source_length, model->scene->file, overrides, count, NULL,
                           errors);
    struct fbd_model *by = scene ? model_compile(scene, errors) : NULL;
    arena_free(&arena);
    fbd_errors_free(errors);
    return by;
}

/* The derivatives of the rates and accelerations, dfdu[2n]. `dfdy` is scratch. */
static bool take_input(const fbd_state *state, size_t input, double *dfdy, double *dfdu)
{
    size_t count = fbd_state_pack(state, NULL, 0);
    double *numbers = calloc(count + 1, sizeof *numbers);
    struct fbd_model *model = numbers ? model_by(state, input) : NULL;
    fbd_state *by = model ? state_new(model) : NULL;
    bool fine = false;
    if (by) {
        fbd_state_pack(state, numbers, count);
        numbers[0] = state->model->scene->parameters[input].value;
        fine = fbd_state_unpack(by, numbers, count) && take_jacobian(by, dfdy, dfdu);
    }
    state_free(by);
    model_free(model);
    free(numbers);
    return fine;
}

/* ---- the columns */

/* True if an expression has a memory (`hysteresis`), which a model with constant time may lack. */
static bool remembers(const struct plan *plan)
{
    for (size_t i = 0; i < plan->kink_count; i++)
        for (size_t k = 0; k < plan->kinks[i].count; k++)
            if (expr_switch_remembers(plan->kinks[i].formula.expr, k)) return true;
    return false;
}

static bool has_derivatives(const struct fbd_model *model)
{
    for (size_t i = 0; i < model->plan.mode_count; i++)
        if (model->plan.modes[i].kind == mode_drive) return false;
    return model->plan.own == 0 && !remembers(&model->plan);
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

/* `work` has room for two Jacobians and two derivatives by time. */
static bool fill(const fbd_state *state, const size_t *variables, size_t count, double *work,
                 double *derivatives)
{
    size_t n = state->model->scene->coordinate_count, size = 2 * n;
    double *dfdy = work, *other = dfdy + size * size, *dfdu = other + size * size;
    if (!take_jacobian(state, dfdy, dfdu)) return false;
    for (size_t k = 0; k < count; k++) {
        const fbd_variable variable = fbd_model_variable(state->model, variables[k]);
        bool by_input = variable.kind == FBD_VARIABLE_INPUT;
        size_t column = variable.kind == FBD_VARIABLE_RATE ? n + variable.index : variable.index;
        if (by_input && !take_input(state, variable.index, other, dfdu)) return false;
        for (size_t i = 0; i < n; i++)
            derivatives[i * count + k] = by_input ? dfdu[n + i] : dfdy[(n + i) * size + column];
    }
    return true;
}

static bool derive(const fbd_state *state, const size_t *variables, size_t count, double *derivatives,
                   fbd_errors *errors)
{
    size_t size = 2 * state->model->scene->coordinate_count;
    if (!has_derivatives(state->model)) {
        diag_in_file(errors, state->model->scene->file);
        diag_add(errors, FBD_ERROR, "no-derivatives", (struct pos){0, 0}, NULL,
                 "a model with `states`, a prescribed motion or `hysteresis` has no derivatives");
        return false;
    }
    if (count == 0) return true;
    double *work = calloc(2 * size * size + size + 1, sizeof *work);
    bool fine = work && fill(state, variables, count, work, derivatives);
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
