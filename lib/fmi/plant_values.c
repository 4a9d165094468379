/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plant: values of variables; forces, energies and works; states that hold the inputs.
 */
#include <math.h>
#include <stdlib.h>

#include "fmi/plant.h"

static bool fail(struct plant *plant, const char *reason)
{
    plant->reason = reason;
    return false;
}

/* The columns of the model, in the order of the description. */
static bool make_columns(struct plant *plant)
{
    if (!plant->columns) plant->columns = fbd_force_columns_new(plant->model);
    if (!plant->columns) return fail(plant, "out of memory");
    if (fbd_force_columns_count(plant->columns) == plant->column_count) return true;
    return fail(plant, "with these values of the parameters the model has other forces than the description: "
                       "give them at the export, by --set");
}

bool plant_follow(struct plant *plant)
{
    if (!make_columns(plant)) return false;
    return fbd_force_columns_follow(plant->columns, plant->simulation) || fail(plant, "out of memory");
}

bool plant_pull(struct plant *plant)
{
    if (plant->is_pulled) return true;
    if (!make_columns(plant)) return false;
    if (!fbd_force_columns_values(plant->columns, plant->state, plant->pulls))
        return fail(plant, "out of memory");
    for (size_t i = 0; i < plant->column_count; i++)
        if (fbd_force_columns_kind(plant->columns, i) == FBD_COLUMN_WORK)
            plant->pulls[i] += plant->base.works[i];
    return plant->is_pulled = true;
}

bool plant_is_given(const struct plant *plant, size_t index)
{
    const fbd_variable variable = fbd_model_variable(plant->first, index);
    if (!variable.name) return false;
    enum fmi_causality kind = package_causality(plant->first, &variable);
    return kind == fmi_parameter || kind == fmi_input;
}

/* A parameter or input has the value that was set; one defined by others has that of the model. */
bool plant_get(struct plant *plant, size_t index, double *value)
{
    const size_t shown = plant->variable_count;
    *value = NAN;
    if (plant_is_given(plant, index)) {
        *value = plant->values[fbd_model_variable(plant->first, index).index];
    } else if (index < shown) {
        if (!plant->is_shown) fbd_state_variables(plant->state, plant->shown, shown);
        plant->is_shown = true;
        *value = plant->shown[index];
    } else if (plant->extras.list[index - shown].kind == extra_column) {
        if (!plant_pull(plant)) return false;
        *value = plant->pulls[plant->extras.list[index - shown].index];
    }
    return true;
}

/* ---- states that hold the inputs */

const char plant_no_held_inputs[] =
    "an input that switches `hysteresis`, or a coupling, on and off cannot be changed";

static bool make_held(struct plant *plant)
{
    fbd_errors *errors = plant->held ? NULL : fbd_errors_new();
    if (errors) plant->held = plant_model(plant, plant->base.values, true, errors);
    fbd_errors_free(errors);
    if (plant->held && !plant->held_state) plant->held_state = fbd_state_new(plant->held);
    return plant->held_state || fail(plant, "out of memory");
}

fbd_state *plant_held_state(struct plant *plant)
{
    double *numbers = NULL;
    size_t count;
    if (plant->holds_inputs) return plant->state;
    if (!make_held(plant) || !plant_pack(plant, &numbers, &count)) return NULL;
    const bool fits = fbd_state_unpack(plant->held_state, numbers, count);
    free(numbers);
    if (!fits) fail(plant, plant_no_held_inputs);
    return fits ? plant->held_state : NULL;
}
