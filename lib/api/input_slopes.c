/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "api/input_slopes.h"

#include <stdlib.h>
#include <string.h>

#include "base/format.h"
#include "dynamics/rates.h"
#include "fbd_view.h"
#include "model/model.h"
#include "output/equations.h"

bool plan_remembers(const struct plan *plan)
{
    for (size_t i = 0; i < plan->kink_count; i++)
        for (size_t k = 0; k < plan->kinks[i].count; k++)
            if (expr_switch_remembers(plan->kinks[i].formula.expr, k)) return true;
    return false;
}

/* ---- by the state */

bool state_slopes(const fbd_state *state, double *dfdy, double *dfdt)
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

/* ---- by inputs */

struct override *model_overrides(const struct fbd_model *model, struct arena *arena, size_t *count)
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
                                             .call = scene->parameters[i].call};
    }
    return list;
}

struct fbd_model *model_with_held_inputs(const struct fbd_model *model)
{
    struct arena arena = {0};
    size_t count;
    fbd_errors *errors = fbd_errors_new();
    struct override *overrides = errors ? model_overrides(model, &arena, &count) : NULL;
    struct scene *scene = NULL;
    if (overrides) {
        struct override *parameters = overrides + count - model->scene->parameter_count;
        for (size_t i = 0; i < model->scene->parameter_count; i++)
            parameters[i].call.held = model->scene->parameters[i].input && !parameters[i].call.function;
        scene = scene_read(model->source, model->source_length, model->scene->file, overrides, count, NULL,
                           errors);
    }
    struct fbd_model *with = scene ? model_compile(scene, errors) : NULL;
    arena_free(&arena);
    fbd_errors_free(errors);
    return with;
}

struct fbd_state *state_with_held_inputs(const fbd_state *state, const struct fbd_model *with)
{
    const struct scene *scene = state->model->scene;
    const size_t packed = fbd_state_pack(state, NULL, 0);
    size_t count = packed;
    double *numbers = calloc(packed + scene->parameter_count + 1, sizeof *numbers);
    struct fbd_state *there = numbers ? state_new(with) : NULL;
    if (!there) {
        free(numbers);
        return NULL;
    }
    fbd_state_pack(state, numbers, packed);
    for (size_t i = 0; i < scene->parameter_count; i++) count -= scene->parameters[i].call.held;
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (with->scene->parameters[i].call.held)
            numbers[count++] = scene->parameters[i].call.held ? state->held[i] : scene->parameters[i].value;
    const bool fits = fbd_state_unpack(there, numbers, count);
    free(numbers);
    if (fits) return there;
    state_free(there);
    return NULL;
}

bool input_slopes(const fbd_state *state, size_t input, double *dfdu)
{
    fbd_state *copy = state_new(state->model);
    double *held = calloc(state->model->scene->parameter_count + 1, sizeof *held);
    const bool made = copy && held;
    if (made) {
        held[input] = 1;
        state_copy(copy, state);
        state_ready(copy);
        const struct instant at = state_instant(copy);
        if (state->model->plan.n > 0) state_held_slopes(state->model, &at, copy->scratch, held, dfdu);
    }
    free(held);
    state_free(copy);
    return made;
}
