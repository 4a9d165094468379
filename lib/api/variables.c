/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the variables of a scene and their values at a state.
 */
#include <math.h>

#include "fbd_view.h"
#include "output/equations.h"
#include "output/world.h"

/* The place of a variable in the list, see fbd_view.h. */
struct place {
    fbd_variable_kind kind;
    size_t index;
    enum world_part part; /* of a point */
};

enum { per_coordinate = 3 };

size_t fbd_model_variable_count(const fbd_model *model)
{
    if (!model) return 0;
    const struct scene *scene = model->scene;
    return 1 + scene->parameter_count + per_coordinate * scene->coordinate_count + scene->own_count +
           (size_t)world_parts * scene->output_point_count;
}

static struct place place_of(const struct scene *scene, size_t at)
{
    static const fbd_variable_kind motion[per_coordinate] = {FBD_VARIABLE_COORDINATE, FBD_VARIABLE_RATE,
                                                             FBD_VARIABLE_ACCELERATION};
    if (at == 0) return (struct place){.kind = FBD_VARIABLE_TIME};
    at--;
    if (at < scene->parameter_count)
        return (struct place){scene->parameters[at].input ? FBD_VARIABLE_INPUT : FBD_VARIABLE_PARAMETER, at,
                              world_x};
    at -= scene->parameter_count;
    if (at < per_coordinate * scene->coordinate_count)
        return (struct place){motion[at % per_coordinate], at / per_coordinate, world_x};
    at -= per_coordinate * scene->coordinate_count;
    if (at < scene->own_count) return (struct place){FBD_VARIABLE_STATE, at, world_x};
    at -= scene->own_count;
    return (struct place){FBD_VARIABLE_POINT, at / world_parts, (enum world_part)(at % world_parts)};
}

/* May the file give initial values? */
static bool starts_freely(const struct body *body)
{
    return !body->assemble && !body->motion.curve && !body->motion.prescribed.expr;
}

static fbd_variable of_motion(const struct fbd_model *model, struct place place)
{
    const struct coordinate *coordinate = &model->scene->coordinates[place.index];
    const struct label *label = &model->labels[place.index];
    const struct body *body = &model->scene->bodies[coordinate->body];
    fbd_variable variable = {.kind = place.kind,
                             .owner = body->name,
                             .name = coordinate->name,
                             .unit = label->unit,
                             .index = place.index,
                             .start = coordinate->initial,
                             .start_free = starts_freely(body)};
    if (place.kind == FBD_VARIABLE_RATE) {
        variable.name = coordinate->rate_name;
        variable.unit = label->rate_unit;
        variable.start = coordinate->initial_rate;
    } else if (place.kind == FBD_VARIABLE_ACCELERATION) {
        variable.name = label->acceleration_name;
        variable.unit = label->acceleration_unit;
        variable.start = NAN;
        variable.start_free = false;
    }
    return variable;
}

static fbd_variable of_place(const struct fbd_model *model, struct place place)
{
    const struct scene *scene = model->scene;
    size_t i = place.index;
    fbd_variable variable = {.kind = place.kind, .owner = "", .index = i, .start = NAN};
    switch (place.kind) {
    case FBD_VARIABLE_TIME:
        variable.name = "t";
        variable.unit = "s";
        break;
    case FBD_VARIABLE_PARAMETER:
    case FBD_VARIABLE_INPUT:
        variable.name = scene->parameters[i].name;
        variable.unit = scene->parameters[i].unit;
        variable.start = fbd_model_parameter(model, i).value;
        break;
    case FBD_VARIABLE_STATE:
        variable.owner = "states";
        variable.name = scene->own[i].name;
        variable.unit = model->own_labels[i].unit;
        variable.start = scene->own[i].initial;
        variable.start_free = true;
        break;
    case FBD_VARIABLE_POINT:
        variable.owner = scene->output_points[i].name;
        variable.name = world_part_name(place.part);
        variable.unit = world_part_unit(model, place.part);
        break;
    default: return of_motion(model, place);
    }
    return variable;
}

fbd_variable fbd_model_variable(const fbd_model *model, size_t index)
{
    if (index >= fbd_model_variable_count(model)) return (fbd_variable){.start = NAN};
    return of_place(model, place_of(model->scene, index));
}

static double parameter_at(const struct fbd_state *state, size_t index)
{
    const struct parameter *parameter = &state->model->scene->parameters[index];
    double value = NAN;
    if (!parameter->call.function) return parameter->value;
    return parameter->call.function(parameter->call.context, state->t, state->y, &value) == 0 ? value
                                                                                              : (double)NAN;
}

static double value_of(const struct fbd_state *state, struct place place)
{
    const struct fbd_model *model = state->model;
    size_t n = model->scene->coordinate_count;
    double values[world_parts];
    switch (place.kind) {
    case FBD_VARIABLE_TIME: return state->t;
    case FBD_VARIABLE_PARAMETER:
    case FBD_VARIABLE_INPUT: return parameter_at(state, place.index);
    case FBD_VARIABLE_COORDINATE: return state->y[place.index];
    case FBD_VARIABLE_RATE: return state->y[n + place.index];
    case FBD_VARIABLE_ACCELERATION: return state->a[place.index];
    case FBD_VARIABLE_STATE: return state->y[2 * n + place.index];
    case FBD_VARIABLE_POINT: break;
    }
    int body = model->scene->output_points[place.index].body;
    world_values(state, body, model->output_points[place.index], values);
    return values[place.part];
}

size_t fbd_state_variables(fbd_state *state, double *values, size_t room)
{
    size_t count = state ? fbd_model_variable_count(state->model) : 0;
    if (!values || room == 0 || count == 0) return count;
    state_ready(state);
    for (size_t i = 0; i < count && i < room; i++)
        values[i] = value_of(state, place_of(state->model->scene, i));
    return count;
}
