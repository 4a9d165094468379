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

/* ---- by an input */

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

struct fbd_model *model_by_input(const fbd_state *state, size_t input)
{
    struct arena arena = {0};
    size_t count;
    const struct fbd_model *model = state->model;
    fbd_errors *errors = fbd_errors_new();
    struct override *overrides = errors ? model_overrides(model, &arena, &count) : NULL;
    struct scene *scene = NULL;
    if (overrides) {
        struct override *time = &overrides[count - model->scene->parameter_count + input];
        time->as_time = true;
        time->now = state->t;
        scene = scene_read(model->source, model->source_length, model->scene->file, overrides, count, NULL,
                           errors);
    }
    struct fbd_model *by = scene ? model_compile(scene, errors) : NULL;
    arena_free(&arena);
    fbd_errors_free(errors);
    return by;
}

bool input_slopes(const fbd_state *state, const struct fbd_model *by, size_t input, double *dfdy,
                  double *dfdu)
{
    size_t count = fbd_state_pack(state, NULL, 0);
    double *numbers = calloc(count + 1, sizeof *numbers);
    fbd_state *there = numbers ? state_new(by) : NULL;
    bool fine = false;
    if (there) {
        fbd_state_pack(state, numbers, count);
        const struct parameter *parameter = &state->model->scene->parameters[input];
        numbers[0] = parameter->call.held ? state->held[input] : parameter->value;
        fine = fbd_state_unpack(there, numbers, count) && state_slopes(there, dfdy, dfdu);
    }
    state_free(there);
    free(numbers);
    return fine;
}
