/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/variables.h"

#include <math.h>

#include "model/model.h"
#include "output/world.h"

static struct fmi_variable *add(struct fmi_variables *variables, enum fmi_kind kind, const char *name,
                                const char *unit, size_t index)
{
    struct fmi_variable *variable = &variables->list[variables->count++];
    *variable =
        (struct fmi_variable){.kind = kind, .name = name, .unit = unit, .description = "", .index = index};
    return variable;
}

static void add_parameters(struct fmi_variables *variables, const struct scene *scene)
{
    for (size_t i = 0; i < scene->parameter_count; i++) {
        const struct parameter *parameter = &scene->parameters[i];
        enum fmi_kind kind = parameter->input     ? fmi_input
                             : parameter->derived ? fmi_calculated
                                                  : fmi_parameter;
        add(variables, kind, parameter->name, parameter->unit, i)->description = parameter->description;
    }
}

/* Add each coordinate, followed by its rate and its acceleration. */
static void add_motion(struct fmi_variables *variables, const struct fbd_model *model)
{
    size_t n = model->scene->coordinate_count;
    for (size_t i = 0; i < n; i++) {
        const struct label *label = &model->labels[i];
        const char *body = model->bodies[model->scene->coordinates[i].body].name;
        const char *acceleration = arena_printf(&variables->arena, "%s.%s", body, label->acceleration_name);
        add(variables, fmi_coordinate, label->name, label->unit, i);
        unsigned before = (unsigned)variables->count - 1;
        add(variables, fmi_rate, label->rate_name, label->rate_unit, n + i)->integral = before;
        add(variables, fmi_acceleration, acceleration, label->acceleration_unit, i)->integral = before + 1;
    }
}

static void add_states(struct fmi_variables *variables, const struct fbd_model *model)
{
    for (size_t i = 0; i < model->scene->own_count; i++)
        add(variables, fmi_state, model->own_labels[i].name, model->own_labels[i].unit,
            2 * model->scene->coordinate_count + i);
}

static void add_points(struct fmi_variables *variables, const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    for (size_t i = 0; i < scene->output_point_count; i++)
        for (int part = 0; part < world_parts; part++) {
            const char *name = arena_printf(&variables->arena, "%s.%s", scene->output_points[i].name,
                                            world_part_name((enum world_part)part));
            add(variables, fmi_point, name, world_part_unit(model, (enum world_part)part), i)->part = part;
        }
}

bool fmi_variables_init(struct fmi_variables *variables, const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    size_t most = 1 + scene->parameter_count + 3 * scene->coordinate_count + scene->own_count +
                  (size_t)world_parts * scene->output_point_count;
    *variables = (struct fmi_variables){0};
    variables->list = ARENA_ARRAY(&variables->arena, most, struct fmi_variable);
    if (!variables->list) return false;
    add(variables, fmi_time, "time", "s", 0);
    add_parameters(variables, scene);
    add_motion(variables, model);
    add_states(variables, model);
    add_points(variables, model);
    return !variables->arena.failed;
}

void fmi_variables_free(struct fmi_variables *variables)
{
    arena_free(&variables->arena);
    *variables = (struct fmi_variables){0};
}

bool fmi_is_output(const struct fmi_variable *variable)
{
    return variable->kind >= fmi_coordinate;
}

/* True if an expression has a memory (`hysteresis`), which a model with constant time may lack. */
static bool remembers(const struct plan *plan)
{
    for (size_t i = 0; i < plan->kink_count; i++)
        for (size_t k = 0; k < plan->kinks[i].count; k++)
            if (expr_switch_remembers(plan->kinks[i].formula.expr, k)) return true;
    return false;
}

bool fmi_has_derivatives(const struct fbd_model *model)
{
    for (size_t i = 0; i < model->plan.mode_count; i++)
        if (model->plan.modes[i].kind == mode_drive) return false;
    return model->scene->output_point_count == 0 && model->plan.own == 0 && !remembers(&model->plan);
}

static double value_of_point(const struct fmi_variable *variable, const struct fbd_state *state)
{
    double values[world_parts];
    const struct fbd_model *model = state->model;
    int body = model->scene->output_points[variable->index].body;
    world_values(state, body, model->output_points[variable->index], values);
    return values[variable->part];
}

double fmi_value(const struct fmi_variable *variable, const struct fbd_state *state)
{
    switch (variable->kind) {
    case fmi_time: return state->t;
    case fmi_coordinate:
    case fmi_rate:
    case fmi_state: return state->y[variable->index];
    case fmi_acceleration: return state->a[variable->index];
    case fmi_point: return value_of_point(variable, state);
    default: return NAN;
    }
}
