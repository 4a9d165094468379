/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/continuous.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "base/format.h"

static bool fail(struct continuous *continuous, const char *reason)
{
    format_into(continuous->own_reason, sizeof continuous->own_reason, "%s", reason);
    continuous->reason = continuous->own_reason;
    return false;
}

static bool fail_by(struct continuous *continuous, fbd_errors *errors)
{
    const fbd_error *first = diag_first_error(errors);
    return fail(continuous, first ? first->message : "out of memory");
}

/* ---- life */

struct continuous *continuous_new(struct plant *plant)
{
    struct continuous *continuous = calloc(1, sizeof *continuous);
    if (!continuous) return NULL;
    continuous->plant = plant;
    continuous->reason = "";
    return continuous;
}

void continuous_drop(struct continuous *continuous)
{
    fbd_force_columns_free(continuous->forces);
    fbd_exchange_free(continuous->exchange);
    fbd_state_free(continuous->state);
    fbd_model_free(continuous->model);
    free(continuous->numbers);
    *continuous = (struct continuous){.plant = continuous->plant, .reason = ""};
}

void continuous_free(struct continuous *continuous)
{
    if (!continuous) return;
    continuous_drop(continuous);
    free(continuous);
}

static bool make_memory(struct continuous *continuous)
{
    const struct plant *plant = continuous->plant;
    const size_t count = continuous->count = fbd_exchange_number_count(continuous->exchange);
    const size_t functions = fbd_exchange_indicator_count(continuous->exchange);
    const size_t indicators = functions > plant->extras.indicators ? functions : plant->extras.indicators;
    const size_t forces = fbd_force_columns_count(continuous->forces);
    continuous->coordinates = fbd_model_coordinate_count(continuous->model);
    continuous->numbers = calloc(2 * count + plant->variable_count + forces + indicators + 1, sizeof(double));
    if (!continuous->numbers) return false;
    continuous->spare = continuous->numbers + count;
    continuous->shown = continuous->spare + count;
    continuous->pulls = continuous->shown + plant->variable_count;
    continuous->indicators = continuous->pulls + forces;
    fbd_exchange_get(continuous->exchange, &continuous->t, continuous->numbers);
    return true;
}

static bool make_motion(struct continuous *continuous, fbd_errors *errors)
{
    struct plant *plant = continuous->plant;
    const fbd_options options = plant_options(plant);
    continuous->model = plant_model(plant, plant->values, true, errors);
    if (continuous->model) continuous->state = fbd_state_new(continuous->model);
    if (!continuous->state) return false;
    fbd_state_set(continuous->state, "t", plant->start);
    continuous->exchange = fbd_exchange_new(continuous->state, &options, errors);
    if (continuous->exchange) continuous->forces = fbd_force_columns_new(continuous->model);
    return continuous->forces && make_memory(continuous);
}

static bool is_going(struct continuous *continuous)
{
    const fbd_outcome outcome = fbd_exchange_outcome(continuous->exchange);
    if (outcome == FBD_GOING || outcome == FBD_STOPPED) return true;
    return fail(continuous, fbd_exchange_reason(continuous->exchange));
}

bool continuous_ready(struct continuous *continuous)
{
    if (continuous->numbers) return is_going(continuous);
    if (!continuous->plant->extras.exchanges) return fail(continuous, continuous->plant->extras.why);
    fbd_errors *errors = fbd_errors_new();
    const bool made = errors && make_motion(continuous, errors);
    if (!made) fail_by(continuous, errors);
    fbd_errors_free(errors);
    if (!made) return false;
    if (fbd_exchange_indicator_count(continuous->exchange) > continuous->plant->extras.indicators)
        return fail(continuous, "with these values of the parameters the model has more events than the "
                                "description has indicators: give them at the export, by --set");
    return is_going(continuous);
}

/* ---- within a step */

static void put(struct continuous *continuous)
{
    fbd_exchange_set(continuous->exchange, continuous->t, continuous->numbers);
    continuous->is_shown = false;
}

void continuous_set_input(struct continuous *continuous, size_t parameter, double value)
{
    if (!continuous->numbers) return;
    fbd_exchange_set_input(continuous->exchange, fbd_model_parameter(continuous->model, parameter).name,
                           value, NULL);
    continuous->is_shown = false;
}

void continuous_set_time(struct continuous *continuous, double t)
{
    continuous->t = t;
    put(continuous);
}

/* The place in fbd_exchange of state k. */
static size_t place(const struct continuous *continuous, size_t k)
{
    if (k >= 2 * continuous->coordinates) return k;
    return k / 2 + (k % 2) * continuous->coordinates;
}

void continuous_set(struct continuous *continuous, const double *states)
{
    for (size_t k = 0; k < continuous->count; k++) continuous->numbers[place(continuous, k)] = states[k];
    put(continuous);
}

void continuous_get(struct continuous *continuous, double *states)
{
    for (size_t k = 0; k < continuous->count; k++) states[k] = continuous->numbers[place(continuous, k)];
}

bool continuous_derivatives(struct continuous *continuous, double *derivatives)
{
    const bool finite = fbd_exchange_derivatives(continuous->exchange, continuous->spare);
    for (size_t k = 0; k < continuous->count; k++) derivatives[k] = continuous->spare[place(continuous, k)];
    return finite || fail(continuous, "a derivative is not finite");
}

void continuous_indicators(struct continuous *continuous, double *indicators)
{
    const size_t described = continuous->plant->extras.indicators,
                 count = fbd_exchange_indicator_count(continuous->exchange);
    fbd_exchange_indicators(continuous->exchange, continuous->indicators);
    for (size_t i = 0; i < described; i++) indicators[i] = i < count ? continuous->indicators[i] : 1;
}

double continuous_value(struct continuous *continuous, size_t index)
{
    const struct plant *plant = continuous->plant;
    if (!continuous->is_shown) {
        fbd_exchange_state(continuous->exchange, continuous->state);
        fbd_state_variables(continuous->state, continuous->shown, plant->variable_count);
        fbd_force_columns_values(continuous->forces, continuous->state, continuous->pulls);
        continuous->is_shown = true;
    }
    if (index < plant->variable_count) return continuous->shown[index];
    const struct extra *extra = &plant->extras.list[index - plant->variable_count];
    if (extra->kind == extra_column) return continuous->pulls[extra->index];
    if (extra->kind == extra_rate) {
        fbd_exchange_derivatives(continuous->exchange, continuous->spare);
        return continuous->spare[2 * continuous->coordinates + extra->index];
    }
    continuous_indicators(continuous, continuous->indicators);
    return continuous->indicators[extra->index];
}

/* ---- events */

void continuous_complete(struct continuous *continuous, bool *event)
{
    *event = fbd_exchange_complete(continuous->exchange);
    if (fbd_exchange_outcome(continuous->exchange) != FBD_GOING) *event = true;
    continuous->is_shown = false;
}

bool continuous_update(struct continuous *continuous, struct continuous_event *event)
{
    const size_t size = continuous->count * sizeof *continuous->numbers;
    memcpy(continuous->spare, continuous->numbers, size);
    const fbd_outcome outcome = fbd_exchange_update(continuous->exchange, &event->next);
    fbd_exchange_get(continuous->exchange, NULL, continuous->numbers);
    continuous->is_shown = false;
    event->jumps = memcmp(continuous->spare, continuous->numbers, size) != 0;
    event->ends = outcome == FBD_STOPPED;
    return is_going(continuous);
}
