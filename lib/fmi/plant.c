/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/plant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "base/format.h"
#include "fbd_view.h"

static bool fail(struct plant *plant, const char *reason)
{
    plant->reason = reason;
    return false;
}

static bool no_memory(struct plant *plant)
{
    return fail(plant, "out of memory");
}

/* Set the reason to the first error. */
static bool fail_by(struct plant *plant, fbd_errors *errors)
{
    const fbd_error *first = diag_first_error(errors);
    if (!first) return no_memory(plant);
    if (first->line > 0)
        format_into(plant->own_reason, sizeof plant->own_reason, "model.yaml:%d:%d: %s", first->line,
                    first->column, first->message);
    else
        format_into(plant->own_reason, sizeof plant->own_reason, "%s", first->message);
    return fail(plant, plant->own_reason);
}

/* ---- models */

static bool has_inputs(const struct plant *plant)
{
    for (size_t i = 0; i < plant->parameter_count; i++)
        if (fbd_model_parameter(plant->first, i).input) return true;
    return false;
}

/* Is there a model for the base? */
static bool has_model(const struct plant *plant, bool holds_inputs)
{
    for (size_t i = 0; plant->model && i < plant->parameter_count; i++) {
        const fbd_parameter parameter = fbd_model_parameter(plant->model, i);
        const bool varies = parameter.derived || (parameter.input && holds_inputs);
        if (!varies && parameter.value != plant->base.values[i]) return false;
    }
    return plant->model && plant->holds_inputs == holds_inputs;
}

static void drop_held(struct plant *plant)
{
    fbd_state_free(plant->held_state);
    fbd_model_free(plant->held);
    plant->held_state = NULL;
    plant->held = NULL;
}

static bool make_model(struct plant *plant)
{
    const bool holds_inputs = !plant->base.of_file && has_inputs(plant);
    if (has_model(plant, holds_inputs)) return true;
    fbd_errors *errors = fbd_errors_new();
    if (!errors) return no_memory(plant);
    drop_held(plant);
    fbd_model_free(plant->model);
    plant->model = plant_model(plant, plant->base.values, holds_inputs, errors);
    plant->holds_inputs = holds_inputs;
    if (!plant->model) fail_by(plant, errors);
    fbd_errors_free(errors);
    return plant->model != NULL;
}

/* ---- opening */

static bool open_model(struct plant *plant, fbd_errors *errors)
{
    plant->first = fbd_model_parse(plant->text, plant->length, plant->path, plant->settings.list,
                                   plant->settings.count, errors);
    if (!plant->first) return false;
    size_t count = plant->parameter_count = fbd_model_parameter_count(plant->first);
    plant->variable_count = fbd_model_variable_count(plant->first);
    if (!extras_make(&plant->extras, plant->first, plant->settings.outputs, errors)) return false;
    size_t columns = plant->column_count = fbd_force_columns_count(plant->extras.columns);
    plant->values = calloc(2 * (count + columns) + plant->variable_count, sizeof *plant->values);
    if (!plant->values) {
        diag_out_of_memory(errors);
        return false;
    }
    plant->base.values = plant->values + count;
    plant->base.works = plant->base.values + count;
    plant->pulls = plant->base.works + columns;
    plant->shown = plant->pulls + columns;
    plant_reset(plant);
    return true;
}

struct plant *plant_open(const char *resources, fbd_errors *errors)
{
    struct plant *plant = calloc(1, sizeof *plant);
    if (plant && plant_read_files(plant, resources, errors) && open_model(plant, errors)) return plant;
    if (!plant) diag_out_of_memory(errors);
    plant_close(plant);
    return NULL;
}

/* Free simulation and state. */
static void drop_run(struct plant *plant)
{
    fbd_state_free(plant->state);
    fbd_force_columns_free(plant->columns);
    fbd_simulation_free(plant->simulation);
    plant->state = NULL;
    plant->columns = NULL;
    plant->is_shown = plant->is_pulled = false;
    plant->simulation = NULL;
}

void plant_close(struct plant *plant)
{
    if (!plant) return;
    drop_run(plant);
    drop_held(plant);
    fbd_model_free(plant->model);
    extras_free(&plant->extras);
    fbd_model_free(plant->first);
    package_settings_free(&plant->settings);
    free(plant->base.numbers);
    free(plant->values);
    free(plant->text);
    free(plant->path);
    free(plant->settings_text);
    free(plant);
}

static void take_values(struct plant *plant)
{
    if (plant->parameter_count > 0)
        memcpy(plant->base.values, plant->values, plant->parameter_count * sizeof *plant->values);
}

/* The next simulation begins at the start of the file. */
static void begin_file(struct plant *plant, double until)
{
    plant->base.of_file = true;
    plant->base.until = until;
    for (size_t i = 0; i < plant->column_count; i++) plant->base.works[i] = 0;
}

void plant_reset(struct plant *plant)
{
    drop_run(plant);
    for (size_t i = 0; i < plant->parameter_count; i++)
        plant->values[i] = fbd_model_parameter(plant->first, i).value;
    take_values(plant);
    begin_file(plant, plant->settings.run.until);
    plant->base.number_count = 0;
    plant->running = false;
    plant->start = plant->t = 0;
    plant->stop = NAN;
    plant->tolerance = 0;
    plant->reason = "";
}

void plant_set(struct plant *plant, size_t parameter, double value)
{
    plant->values[parameter] = value;
}

/* ---- the start */

fbd_options plant_options(const struct plant *plant)
{
    fbd_options options = plant->settings.run;
    options.until = plant->base.until;
    if (plant->tolerance > 0) options.tolerance = fmin(options.tolerance, plant->tolerance);
    return options;
}

void plant_begin(struct plant *plant, double start, double stop, double tolerance)
{
    const double least = 1e-14; /* the smallest meaningful one in double precision */
    drop_run(plant);
    plant->running = true;
    plant->start = plant->t = start;
    plant->stop = stop;
    plant->tolerance = tolerance > 0 ? fmax(tolerance, least) : 0;
    double length = plant->settings.run.until > 0 ? plant->settings.run.until : 1;
    begin_file(plant, !isnan(stop)                        ? stop
                      : start < plant->settings.run.until ? plant->settings.run.until
                                                          : start + length);
}

/* A state of the model with the numbers of the base, and its inputs if the model holds them. */
static fbd_state *state_of_base(struct plant *plant)
{
    const struct plant_base *base = &plant->base;
    fbd_state *state = fbd_state_new(plant->model);
    if (!state) {
        no_memory(plant);
        return NULL;
    }
    if (base->of_file) {
        fbd_state_set(state, "t", plant->start);
    } else if (!fbd_state_unpack(state, base->numbers, base->number_count)) {
        fail(plant, plant_no_held_inputs);
        fbd_state_free(state);
        return NULL;
    }
    for (size_t i = 0; plant->holds_inputs && i < plant->parameter_count; i++)
        if (fbd_model_parameter(plant->first, i).input)
            fbd_state_set(state, fbd_model_parameter(plant->first, i).name, base->values[i]);
    return state;
}

static bool start_simulation(struct plant *plant)
{
    fbd_options options = plant_options(plant);
    fbd_errors *errors = fbd_errors_new();
    if (!errors) return no_memory(plant);
    bool plain = plant->base.of_file && plant->start == 0;
    plant->state = state_of_base(plant);
    if (plant->state)
        plant->simulation = plain ? fbd_simulation_new(plant->model, &options, errors)
                                  : fbd_simulation_from(plant->state, &options, errors);
    if (plant->state && !plant->simulation) fail_by(plant, errors);
    fbd_errors_free(errors);
    return plant->simulation && (!plant->extras.works || plant_follow(plant));
}

/* ---- states and steps */

static bool has_failed(const struct plant *plant)
{
    fbd_outcome outcome = fbd_simulation_outcome(plant->simulation);
    return outcome != FBD_GOING && outcome != FBD_DONE && outcome != FBD_STOPPED;
}

static bool fail_by_run(struct plant *plant)
{
    format_into(plant->own_reason, sizeof plant->own_reason, "%s", fbd_simulation_reason(plant->simulation));
    return fail(plant, plant->own_reason);
}

static double reached(const struct plant *plant)
{
    double to;
    fbd_simulation_interval(plant->simulation, NULL, &to);
    return to;
}

static bool look(struct plant *plant, double t)
{
    plant->is_shown = plant->is_pulled = false;
    if (!fbd_simulation_state(plant->simulation, t, plant->state))
        return fail(plant, "the state cannot be had: memory is out, or a force is not finite");
    plant->t = t;
    return true;
}

/* Make the simulation of the base, and advance it to the step that contains t. */
static bool make_run(struct plant *plant)
{
    drop_run(plant);
    if (!make_model(plant) || !start_simulation(plant)) return false;
    while (reached(plant) < plant->t && fbd_simulation_outcome(plant->simulation) == FBD_GOING)
        fbd_simulation_advance(plant->simulation);
    if (reached(plant) < plant->t || (has_failed(plant) && reached(plant) <= plant->t))
        return fail_by_run(plant);
    return look(plant, plant->t);
}

static bool values_differ(const struct plant *plant)
{
    for (size_t i = 0; i < plant->parameter_count; i++)
        if (plant->values[i] != plant->base.values[i]) return true;
    return false;
}

/* The inputs come last. */
bool plant_pack(struct plant *plant, double **numbers, size_t *count)
{
    const size_t packed = fbd_state_pack(plant->state, NULL, 0);
    double *grown = realloc(*numbers, (packed + plant->parameter_count + 1) * sizeof *grown);
    if (!grown) return no_memory(plant);
    fbd_state_pack(plant->state, grown, packed);
    *numbers = grown;
    *count = packed;
    for (size_t i = 0; !plant->holds_inputs && i < plant->parameter_count; i++)
        if (fbd_model_parameter(plant->first, i).input) grown[(*count)++] = plant->base.values[i];
    return true;
}

/* Make the present state the base. */
static bool take_state(struct plant *plant, double until)
{
    if (plant->extras.works && !plant_pull(plant)) return false;
    for (size_t i = 0; i < plant_work_count(plant); i++) plant->base.works[i] = plant->pulls[i];
    if (!plant_pack(plant, &plant->base.numbers, &plant->base.number_count)) return false;
    plant->base.of_file = false;
    plant->base.until = until;
    return true;
}

bool plant_update(struct plant *plant)
{
    const bool differ = values_differ(plant);
    const bool started = plant->running && !(plant->base.of_file && plant->t == plant->start);
    /* The state must first be reached with the previous values. */
    if (started && !plant->simulation && !make_run(plant)) return false;
    if (plant->simulation && !differ) return true;
    if (started && !take_state(plant, plant->base.until)) return false;
    take_values(plant);
    return make_run(plant);
}

/* Prolong the simulation by its length, when the importer steps beyond its end. */
static bool prolong(struct plant *plant)
{
    double until = plant->base.until, length = fmax(until - plant->start, plant->settings.run.until);
    if (!(length > 0)) length = 1;
    return look(plant, until) && take_state(plant, until + length) && make_run(plant);
}

/* The first event after t that the simulation has reached, or NAN. */
static double next_event(const struct plant *plant)
{
    double next = NAN, t;
    size_t i = fbd_simulation_event_count(plant->simulation);
    for (; i > 0 && (t = fbd_simulation_event(plant->simulation, i - 1).t) > plant->t; i--) next = t;
    return next;
}

static enum plant_step arrive(struct plant *plant, double t, enum plant_step how)
{
    return look(plant, t) ? how : plant_failed;
}

enum plant_step plant_step(struct plant *plant, double target, bool pause)
{
    if (!plant_update(plant)) return plant_failed;
    for (;;) {
        double to = reached(plant), event = next_event(plant);
        fbd_outcome outcome = fbd_simulation_outcome(plant->simulation);
        bool happens = event <= target && event <= to;
        if (pause && happens && event < target) return arrive(plant, event, plant_event);
        if (outcome == FBD_STOPPED && to <= target) return arrive(plant, to, plant_stopped);
        if (to >= target && !(to == target && has_failed(plant)))
            return arrive(plant, target, happens && event == target ? plant_event : plant_arrived);
        if (has_failed(plant)) return fail_by_run(plant) ? plant_arrived : plant_failed;
        if (outcome == FBD_DONE && !prolong(plant)) return plant_failed;
        if (outcome == FBD_GOING) fbd_simulation_advance(plant->simulation);
    }
}

/* ---- saving */

/* Indices of the numbers saved before the state. */
enum {
    save_running,
    save_start,
    save_stop,
    save_has_stop,
    save_t,
    save_tolerance,
    save_of_file,
    save_until,
    save_values
};

static size_t saved_before_states(const struct plant *plant)
{
    return save_values + 2 * plant->parameter_count + plant_work_count(plant);
}

size_t plant_save(const struct plant *plant, double *numbers)
{
    const struct plant_base *base = &plant->base;
    const size_t parameters = plant->parameter_count, works = plant_work_count(plant);
    const size_t states = base->of_file ? 0 : base->number_count, before = saved_before_states(plant);
    const size_t count = before + states;
    if (!numbers) return count;
    numbers[save_running] = plant->running;
    numbers[save_start] = plant->start;
    numbers[save_has_stop] = !isnan(plant->stop);
    numbers[save_stop] = isnan(plant->stop) ? 0 : plant->stop;
    numbers[save_t] = plant->t;
    numbers[save_tolerance] = plant->tolerance;
    numbers[save_of_file] = base->of_file;
    numbers[save_until] = base->until;
    for (size_t i = 0; i < parameters; i++) {
        numbers[save_values + i] = plant->values[i];
        numbers[save_values + parameters + i] = base->values[i];
    }
    for (size_t i = 0; i < works; i++) numbers[save_values + 2 * parameters + i] = base->works[i];
    for (size_t i = 0; i < states; i++) numbers[before + i] = base->numbers[i];
    return count;
}

static bool are_finite(const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(numbers[i])) return false;
    return true;
}

/* True if the existing simulation is that of these numbers, and its last step contains their time. */
static bool is_there(const struct plant *plant, const double *numbers, size_t count)
{
    const size_t parameters = plant->parameter_count, works = plant_work_count(plant);
    const size_t before = saved_before_states(plant), one = sizeof *numbers;
    double from;
    if (!plant->simulation || plant->state == NULL) return false;
    const struct plant_base *base = &plant->base;
    const size_t states = base->of_file ? 0 : base->number_count;
    const double *values = numbers + save_values + parameters;
    bool same = count == before + states && plant->running == (numbers[save_running] != 0) &&
                plant->start == numbers[save_start] && plant->tolerance == numbers[save_tolerance] &&
                base->of_file == (numbers[save_of_file] != 0) && base->until == numbers[save_until] &&
                memcmp(base->values, values, parameters * one) == 0 &&
                memcmp(base->works, values + parameters, works * one) == 0;
    if (!same || memcmp(base->numbers ? base->numbers : numbers, numbers + before, states * one) != 0)
        return false;
    fbd_simulation_interval(plant->simulation, &from, NULL);
    return from <= numbers[save_t] && numbers[save_t] <= reached(plant);
}

static void take_saved_values(struct plant *plant, const double *values)
{
    const size_t parameters = plant->parameter_count;
    for (size_t i = 0; i < parameters; i++) {
        plant->values[i] = values[i];
        plant->base.values[i] = values[parameters + i];
    }
    for (size_t i = 0; i < plant_work_count(plant); i++) plant->base.works[i] = values[2 * parameters + i];
}

bool plant_restore(struct plant *plant, const double *numbers, size_t count)
{
    const size_t before = saved_before_states(plant), works = plant_work_count(plant);
    struct plant_base *base = &plant->base;
    if (count < before || !are_finite(numbers, before - works) ||
        !are_finite(numbers + before, count - before))
        return false;
    bool there = is_there(plant, numbers, count), of_file = numbers[save_of_file] != 0;
    double *states = of_file ? NULL : malloc((count - before + 1) * sizeof *states);
    if (!of_file && !states) return false;
    plant->running = numbers[save_running] != 0;
    plant->start = numbers[save_start];
    plant->stop = numbers[save_has_stop] != 0 ? numbers[save_stop] : NAN;
    plant->tolerance = numbers[save_tolerance];
    base->of_file = of_file;
    base->until = numbers[save_until];
    take_saved_values(plant, numbers + save_values);
    if (!of_file) {
        memcpy(states, numbers + before, (count - before) * sizeof *states);
        free(base->numbers);
        base->numbers = states;
        base->number_count = count - before;
    }
    plant->t = numbers[save_t];
    if (!there)
        drop_run(plant);
    else if (!look(plant, plant->t))
        return false;
    return true;
}
