/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/derivative.h"

#include <stdlib.h>
#include <string.h>

#include "base/format.h"
#include "dynamics/rates.h"
#include "model/model.h"
#include "output/equations.h"

/* d(unknown)/d(known) for coordinates, rates and accelerations by coordinates, rates and inputs. */
struct jacobian {
    size_t n;     /* coordinates */
    double *dfdy; /* 2n x 2n: (rates, accelerations) by (coordinates, rates) */
    double *dfdu; /* 2n for each parameter or input */
    bool *known;  /* for each: its column was computed */
};

static bool jacobian_init(struct jacobian *jacobian, const struct plant *plant)
{
    size_t n = jacobian->n = plant->model->scene->coordinate_count, inputs = plant->parameter_count;
    jacobian->dfdy = calloc(4 * n * n + 2 * n * (inputs + 1) + 1, sizeof *jacobian->dfdy);
    jacobian->known = calloc(inputs + 1, sizeof *jacobian->known);
    jacobian->dfdu = jacobian->dfdy ? jacobian->dfdy + 4 * n * n : NULL;
    return jacobian->dfdy && jacobian->known;
}

static void jacobian_free(struct jacobian *jacobian)
{
    free(jacobian->dfdy);
    free(jacobian->known);
}

/* ---- by the state */

static bool take_state(struct jacobian *jacobian, const struct plant *plant)
{
    size_t n = jacobian->n;
    double *dfdt = calloc(2 * n + 1, sizeof *dfdt);
    fbd_state *state = state_new(plant->model);
    bool fine = dfdt && state;
    if (fine) {
        state_copy(state, plant->state);
        state_ready(state);
        struct instant at = state_instant(state);
        if (n > 0) state_jacobian(plant->model, &at, state->scratch, jacobian->dfdy, dfdt);
    }
    state_free(state);
    free(dfdt);
    return fine;
}

/* ---- by an input: see derivative.h */

static struct override *list_overrides(const struct plant *plant, size_t input, struct arena *arena,
                                       size_t *count)
{
    const struct scene *scene = plant->model->scene;
    size_t set = plant->settings.count;
    struct override *list = ARENA_ARRAY(arena, set + scene->parameter_count + 1, struct override);
    if (!list) return NULL;
    for (*count = 0; *count < set; ++*count)
        list[*count] = (struct override){.name = plant->settings.list[*count].name,
                                         .value = plant->settings.list[*count].value};
    for (size_t i = 0; i < scene->parameter_count; i++) {
        char number[40];
        if (scene->parameters[i].derived && i != input) continue;
        format_shortest(number, sizeof number, plant->values[i]);
        const char *text = arena_text(arena, number, strlen(number));
        if (!text) return NULL;
        list[(*count)++] = (struct override){.name = scene->parameters[i].name,
                                             .value = text,
                                             .as_time = i == input,
                                             .now = plant->t};
    }
    return list;
}

static struct fbd_model *model_by(const struct plant *plant, size_t input)
{
    struct arena arena = {0};
    size_t count;
    fbd_errors *errors = fbd_errors_new();
    const struct override *overrides = errors ? list_overrides(plant, input, &arena, &count) : NULL;
    struct scene *scene = NULL;
    if (overrides)
        scene = scene_read(plant->text, plant->length, plant->path, overrides, count, NULL, errors);
    struct fbd_model *model = scene ? model_compile(scene, errors) : NULL;
    arena_free(&arena);
    fbd_errors_free(errors);
    return model;
}

static bool take_input(struct jacobian *jacobian, const struct plant *plant, size_t input)
{
    size_t n = jacobian->n, count = fbd_state_pack(plant->state, NULL, 0);
    double *numbers = calloc(count + 4 * n * n + 1, sizeof *numbers);
    struct fbd_model *model = numbers ? model_by(plant, input) : NULL;
    fbd_state *state = model ? state_new(model) : NULL;
    bool fine = false;
    if (state) {
        fbd_state_pack(plant->state, numbers, count);
        numbers[0] = plant->values[input];
        fine = fbd_state_unpack(state, numbers, count);
    }
    if (fine) {
        state_ready(state);
        struct instant at = state_instant(state);
        if (n > 0)
            state_jacobian(model, &at, state->scratch, numbers + count, jacobian->dfdu + 2 * n * input);
        jacobian->known[input] = true;
    }
    state_free(state);
    model_free(model);
    free(numbers);
    return fine;
}

/* ---- entries */

static double entry(const struct jacobian *jacobian, const struct fmi_variable *unknown,
                    const struct fmi_variable *known)
{
    size_t n = jacobian->n;
    bool by_state = known->kind == fmi_coordinate || known->kind == fmi_rate;
    if (unknown->kind != fmi_acceleration)
        return unknown->kind == known->kind && unknown->index == known->index;
    size_t row = n + unknown->index;
    return by_state ? jacobian->dfdy[2 * n * row + known->index] : jacobian->dfdu[2 * n * known->index + row];
}

static const struct fmi_variable *variable_of(const struct plant *plant, unsigned reference)
{
    return reference < plant->variables.count ? &plant->variables.list[reference] : NULL;
}

static const char *why_not(const struct plant *plant, const struct derivative_call *call)
{
    if ((call->unknown_count > 0 && !call->unknowns) || (call->known_count > 0 && !call->knowns) ||
        !call->seed || !call->answer)
        return "there are no variables, or no values";
    if (!fmi_has_derivatives(plant->first))
        return "a model with points, a prescribed motion or `hysteresis` has no derivatives";
    for (size_t i = 0; i < call->unknown_count; i++) {
        const struct fmi_variable *unknown = variable_of(plant, call->unknowns[i]);
        if (!unknown || !fmi_is_output(unknown)) return "an unknown is no output";
    }
    for (size_t k = 0; k < call->known_count; k++) {
        const struct fmi_variable *known = variable_of(plant, call->knowns[k]);
        if (!known || (known->kind != fmi_input && known->kind != fmi_coordinate && known->kind != fmi_rate))
            return "a known is no input, coordinate or rate";
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
            double slope =
                entry(jacobian, variable_of(plant, call->unknowns[i]), variable_of(plant, call->knowns[k]));
            call->answer[call->adjoint ? k : i] += slope * call->seed[call->adjoint ? i : k];
        }
}

static bool make(struct jacobian *jacobian, const struct plant *plant, const struct derivative_call *call)
{
    if (!jacobian_init(jacobian, plant) || !take_state(jacobian, plant)) return false;
    for (size_t k = 0; k < call->known_count; k++) {
        const struct fmi_variable *known = variable_of(plant, call->knowns[k]);
        if (known->kind != fmi_input || jacobian->known[known->index]) continue;
        if (!take_input(jacobian, plant, known->index)) return false;
    }
    return true;
}

enum instance_status derivative_get(struct instance *instance, const struct derivative_call *call)
{
    struct plant *plant = instance->plant;
    const char *why = why_not(plant, call);
    if (why) return instance_fail(instance, call->function, why);
    if (!plant_update(plant)) return instance_fail(instance, call->function, plant->reason);
    struct jacobian jacobian = {0};
    bool made = make(&jacobian, plant, call);
    if (made) multiply(&jacobian, plant, call);
    jacobian_free(&jacobian);
    return made ? instance_ok
                : instance_fail(instance, call->function, "memory is out, or the input changes a memory");
}
