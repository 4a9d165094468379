/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: a linearisation with inputs and outputs (rest/linear_system.h).
 */
#include "rest/linear_system.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "api/input_slopes.h"
#include "base/api_check.h"
#include "base/diag.h"
#include "fbd_view.h"
#include "output/world.h"

/* The quantity that an output measures. */
struct output {
    fbd_variable_kind kind;
    size_t index; /* of the coordinate or user state */
    struct world_quantity place;
};

struct building {
    struct fbd_linear_system *system;
    const struct fbd_model *model;
    fbd_errors *errors;
    struct output *outputs;
    size_t *inputs; /* of the parameters of the scene */
};

/* ---- names */

static const char *full_name(struct arena *arena, const fbd_variable *variable)
{
    return variable->owner[0] ? arena_printf(arena, "%s.%s", variable->owner, variable->name)
                              : variable->name;
}

static bool is_listed(const fbd_variable *variable, bool input)
{
    if (input) return variable->kind == FBD_VARIABLE_INPUT;
    return variable->kind == FBD_VARIABLE_COORDINATE || variable->kind == FBD_VARIABLE_RATE ||
           variable->kind == FBD_VARIABLE_ACCELERATION || variable->kind == FBD_VARIABLE_STATE;
}

/* Find a variable by its full name; note an error with the nearest one otherwise. */
static bool find_variable(const struct building *building, const char *wanted, bool input,
                          fbd_variable *found)
{
    const size_t count = fbd_model_variable_count(building->model);
    struct arena *arena = &building->system->arena;
    const char **names = ARENA_ARRAY(arena, count, const char *);
    size_t known = 0;
    for (size_t i = 0; names && i < count; i++) {
        *found = fbd_model_variable(building->model, i);
        if (!is_listed(found, input)) continue;
        const char *name = names[known] = full_name(arena, found);
        if (!name) return false;
        known++;
        if (strcmp(name, wanted) == 0) return true;
    }
    if (names)
        diag_add(building->errors, FBD_ERROR, input ? "unknown-input" : "unknown-output", (struct pos){0, 0},
                 diag_nearest(building->errors, diag_hint(building->errors, "%s", wanted), names, known),
                 input ? "the file declares no input `%s`"
                       : "the model has no coordinate, rate, state or point `%s`",
                 wanted);
    return false;
}

static bool add_input(struct building *building, const char *name)
{
    struct fbd_linear_system *system = building->system;
    fbd_variable variable;
    if (!find_variable(building, name, true, &variable)) return false;
    building->inputs[system->input_count] = variable.index;
    system->inputs[system->input_count++] = (fbd_signal){variable.name, variable.unit};
    return true;
}

static bool add_output(struct building *building, const char *name)
{
    struct fbd_linear_system *system = building->system;
    struct output *output = &building->outputs[system->output_count];
    fbd_signal *signal = &system->outputs[system->output_count];
    fbd_variable variable;
    signal->name = arena_text(&system->arena, name, strlen(name));
    if (!signal->name) return false;
    const bool point = world_find(building->model, name, &output->place);
    if (point && output->place.part >= world_proper_ax) {
        diag_add(building->errors, FBD_ERROR, "unknown-output", (struct pos){0, 0},
                 "take the components in the world, `.ax` and `.ay`",
                 "`%s` is measured in axes that turn with the body, and has no transfer function here", name);
        return false;
    }
    if (point) {
        output->kind = FBD_VARIABLE_POINT;
        signal->unit = world_part_unit(building->model, output->place.part);
    } else if (find_variable(building, name, false, &variable)) {
        output->kind = variable.kind;
        output->index = variable.index;
        signal->unit = variable.unit;
    } else {
        return false;
    }
    system->output_count++;
    return true;
}

/* All of a kind, in the order of the file. */
static bool add_all(struct building *building, bool input)
{
    const size_t count = fbd_model_variable_count(building->model);
    bool fine = true;
    for (size_t i = 0; fine && i < count; i++) {
        fbd_variable variable = fbd_model_variable(building->model, i);
        bool output = variable.kind == FBD_VARIABLE_COORDINATE || variable.kind == FBD_VARIABLE_STATE;
        if (input ? variable.kind != FBD_VARIABLE_INPUT : !output) continue;
        const char *name = full_name(&building->system->arena, &variable);
        fine = name && (input ? add_input(building, name) : add_output(building, name));
    }
    return fine;
}

static bool refuse_no_inputs(const struct building *building)
{
    if (building->system->input_count > 0) return true;
    diag_add(building->errors, FBD_ERROR, "no-inputs", (struct pos){0, 0},
             "declare the force or moment as an input: `inputs: {F: 0 N}` and `applied: {value: F}`",
             "the file declares no `inputs`: there is no transfer function");
    return false;
}

static bool choose_signals(struct building *building, const fbd_linear_plan *plan)
{
    bool fine = true;
    for (size_t i = 0; fine && i < plan->input_count; i++) fine = add_input(building, plan->inputs[i]);
    if (fine && plan->input_count == 0) fine = add_all(building, true) && refuse_no_inputs(building);
    for (size_t i = 0; fine && i < plan->output_count; i++) fine = add_output(building, plan->outputs[i]);
    if (fine && plan->output_count == 0) fine = add_all(building, false);
    return fine;
}

/* ---- B */

static bool refuse_inputs(const struct building *building)
{
    diag_add(building->errors, FBD_ERROR, "no-derivatives", (struct pos){0, 0}, NULL,
             "the linear motion by the inputs is not determined: the file has `hysteresis`");
    return false;
}

static bool refuse_called(const struct building *building, const char *name)
{
    diag_add(building->errors, FBD_ERROR, "no-derivatives", (struct pos){0, 0},
             "linearize the model in which it is a constant", "the input `%s` is computed by a callback",
             name);
    return false;
}

/* A column of B, from the derivatives of the rates of all coordinates and user states. */
static void take_column(struct fbd_linear_system *system, size_t column, const double *dfdu)
{
    const struct fbd_linearization *linear = system->linear;
    const size_t n = (size_t)linear->model->plan.n, f = linear->count, own = linear->size - 2 * f,
                 m = system->input_count;
    for (size_t k = 0; k < f; k++) system->B[(f + k) * m + column] = dfdu[n + (size_t)linear->which[k]];
    for (size_t i = 0; i < own; i++) system->B[(2 * f + i) * m + column] = dfdu[2 * n + i];
}

static bool make_columns(const struct building *building, const fbd_state *state)
{
    double *dfdu = calloc(plan_size(&building->model->plan) + 1, sizeof *dfdu);
    bool fine = dfdu != NULL;
    for (size_t k = 0; fine && k < building->system->input_count; k++) {
        fine = input_slopes(state, building->inputs[k], dfdu);
        if (fine) take_column(building->system, k, dfdu);
    }
    free(dfdu);
    return fine;
}

/* False with a note where a callback computes one of the inputs. */
static bool are_constants(const struct building *building)
{
    for (size_t k = 0; k < building->system->input_count; k++)
        if (building->model->scene->parameters[building->inputs[k]].call.function)
            return refuse_called(building, building->system->inputs[k].name);
    return true;
}

static bool make_B(const struct building *building)
{
    if (plan_remembers(&building->model->plan)) return refuse_inputs(building);
    if (!are_constants(building)) return false;
    struct fbd_model *with = model_with_held_inputs(building->model);
    if (!with) return false;
    fbd_state *state = state_with_held_inputs(building->system->linear->state, with);
    const bool made = state && make_columns(building, state);
    state_free(state);
    model_free(with);
    return made;
}

/* ---- C and D */

/* The row of a motion: weights[count] of the independent coordinates; order 0 a place, 1 a velocity, 2 an acceleration. */
static void take_row(struct fbd_linear_system *system, size_t row, const double *weights, int order)
{
    const struct fbd_linearization *linear = system->linear;
    const size_t f = linear->count, size = linear->size, m = system->input_count;
    double *C = system->C + row * size, *D = system->D + row * m;
    for (size_t k = 0; k < f; k++) {
        if (order < 2) C[(size_t)order * f + k] = weights[k];
        for (size_t j = 0; order == 2 && j < size; j++) C[j] += weights[k] * linear->A[(f + k) * size + j];
        for (size_t j = 0; order == 2 && j < m; j++) D[j] += weights[k] * system->B[(f + k) * m + j];
    }
}

/* T of coordinate i. */
static double share_of(const struct fbd_linearization *linear, size_t i, size_t k)
{
    return linear->way ? linear->way[i * linear->count + k] : i == (size_t)linear->which[k];
}

/* The velocities of a point for z' = e_k. */
static void point_weights(const struct fbd_linearization *linear, struct fbd_state *probe,
                          const struct world_quantity *place, double *weights)
{
    const size_t n = (size_t)linear->model->plan.n;
    for (size_t k = 0; k < linear->count; k++) {
        double values[world_parts];
        for (size_t i = 0; i < n; i++) probe->y[n + i] = share_of(linear, i, k);
        state_evaluate(probe);
        world_values(probe, place->body, world_point(linear->model, place->body, place->point), values);
        weights[k] = values[place->part % 2 ? world_vy : world_vx];
    }
}

static void make_row(const struct building *building, size_t row, struct fbd_state *probe, double *weights)
{
    const struct fbd_linearization *linear = building->system->linear;
    const struct output *output = &building->outputs[row];
    int order = output->kind == FBD_VARIABLE_RATE ? 1 : output->kind == FBD_VARIABLE_ACCELERATION ? 2 : 0;
    if (output->kind == FBD_VARIABLE_STATE) {
        building->system->C[row * linear->size + 2 * linear->count + output->index] = 1;
        return;
    }
    if (output->kind == FBD_VARIABLE_POINT) {
        order = (int)output->place.part / 2;
        point_weights(linear, probe, &output->place, weights);
    } else {
        for (size_t k = 0; k < linear->count; k++) weights[k] = share_of(linear, output->index, k);
    }
    take_row(building->system, row, weights, order);
}

static bool make_C(const struct building *building)
{
    const struct fbd_linearization *linear = building->system->linear;
    struct fbd_state *probe = state_new(building->model);
    double *weights = calloc(linear->count + 1, sizeof *weights);
    bool fine = probe && weights;
    if (fine) state_copy(probe, linear->state);
    for (size_t row = 0; fine && row < building->system->output_count; row++)
        make_row(building, row, probe, weights);
    state_free(probe);
    free(weights);
    return fine;
}

/* ---- the system */

static bool allocate(struct building *building, const fbd_linear_plan *plan)
{
    struct fbd_linear_system *system = building->system;
    struct arena *arena = &system->arena;
    size_t variables = fbd_model_variable_count(building->model), inputs = plan->input_count + variables,
           outputs = plan->output_count + variables;
    system->inputs = ARENA_ARRAY(arena, inputs, fbd_signal);
    system->outputs = ARENA_ARRAY(arena, outputs, fbd_signal);
    building->inputs = ARENA_ARRAY(arena, inputs, size_t);
    building->outputs = ARENA_ARRAY(arena, outputs, struct output);
    return !arena->failed;
}

static bool allocate_matrices(struct fbd_linear_system *system)
{
    const size_t size = system->linear->size, m = system->input_count, p = system->output_count;
    system->B = ARENA_ARRAY(&system->arena, size * m + 1, double);
    system->C = ARENA_ARRAY(&system->arena, p * size + 1, double);
    system->D = ARENA_ARRAY(&system->arena, p * m + 1, double);
    return !system->arena.failed;
}

static bool is_finite(const struct building *building)
{
    const struct fbd_linear_system *system = building->system;
    const size_t m = system->input_count, p = system->output_count, size = system->linear->size;
    bool finite = true;
    for (size_t i = 0; i < size * m; i++) finite &= (bool)isfinite(system->B[i]);
    for (size_t i = 0; i < p * size; i++) finite &= (bool)isfinite(system->C[i]);
    for (size_t i = 0; i < p * m; i++) finite &= (bool)isfinite(system->D[i]);
    if (!finite)
        diag_add(building->errors, FBD_ERROR, "not-finite", (struct pos){0, 0}, NULL,
                 "at the equilibrium the derivative by an input or of an output is not finite");
    return finite;
}

static bool build(struct building *building, const fbd_linear_plan *plan)
{
    return allocate(building, plan) && choose_signals(building, plan) &&
           allocate_matrices(building->system) && make_B(building) && make_C(building) && is_finite(building);
}

static fbd_linear_system *make_system(const fbd_linearization *linear, const fbd_linear_plan *plan,
                                      fbd_errors *errors)
{
    fbd_linear_system *system = calloc(1, sizeof *system);
    struct building building = {.system = system, .model = linear->model, .errors = errors};
    diag_in_file(errors, linear->model->scene->file);
    if (system) system->linear = linear;
    if (system && build(&building, plan)) return system;
    if (fbd_errors_failed_count(errors) == 0) diag_out_of_memory(errors);
    fbd_linear_system_free(system);
    return NULL;
}

fbd_linear_system *fbd_linear_system_new(const fbd_linearization *linearization, const fbd_linear_plan *given,
                                         fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_linear_plan plan = {0};
    fbd_linear_system *system = NULL;
    bool sized = api_take_options(&plan, sizeof plan, given, errors);
    if (sized && linearization && api_has_texts(plan.inputs, plan.input_count) &&
        api_has_texts(plan.outputs, plan.output_count))
        system = make_system(linearization, &plan, errors);
    else if (sized)
        api_refuse(errors, "there is no linearisation, or a name of an input or output is NULL");
    diag_end(&call);
    return system;
}

void fbd_linear_system_free(fbd_linear_system *system)
{
    if (!system) return;
    arena_free(&system->arena);
    free(system);
}

/* ---- access */

size_t fbd_linear_system_input_count(const fbd_linear_system *system)
{
    return system ? system->input_count : 0;
}

size_t fbd_linear_system_output_count(const fbd_linear_system *system)
{
    return system ? system->output_count : 0;
}

fbd_signal fbd_linear_system_input(const fbd_linear_system *system, size_t index)
{
    return system && index < system->input_count ? system->inputs[index] : (fbd_signal){0};
}

fbd_signal fbd_linear_system_output(const fbd_linear_system *system, size_t index)
{
    return system && index < system->output_count ? system->outputs[index] : (fbd_signal){0};
}

const double *fbd_linear_system_input_matrix(const fbd_linear_system *system)
{
    return system ? system->B : NULL;
}

const double *fbd_linear_system_output_matrix(const fbd_linear_system *system)
{
    return system ? system->C : NULL;
}

const double *fbd_linear_system_feedthrough(const fbd_linear_system *system)
{
    return system ? system->D : NULL;
}
