/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: inputs that are set between the steps of a simulation.
 *
 * A jump of an input is a point where the forces are not smooth, and modes may change: a body that sticks breaks away.
 * So the run ends there, and another one of the same model begins at its state, with the modes decided as at a start.
 */
#include "api/set_input.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "api/record.h"
#include "base/api_check.h"
#include "fbd.h"

size_t settable_input(const struct scene *scene, const char *name, fbd_errors *errors)
{
    const char *known[32];
    size_t count = 0;
    for (size_t i = 0; i < scene->parameter_count; i++) {
        const struct parameter *parameter = &scene->parameters[i];
        const bool meant = strcmp(parameter->name, name) == 0;
        if (parameter->call.held && meant) return i;
        if (parameter->input && meant) {
            diag_add(errors, FBD_ERROR, "fixed-input", (struct pos){0, 0},
                     "fbd_model_with_callbacks with `function` NULL makes a model in which it can be set",
                     "the input `%.40s` is %s", name,
                     parameter->call.function ? "computed by a callback" : "a constant of this model");
            return SIZE_MAX;
        }
        if (parameter->call.held && count < sizeof known / sizeof *known) known[count++] = parameter->name;
    }
    diag_add(errors, FBD_ERROR, "unknown-input", (struct pos){0, 0},
             count > 0 ? diag_nearest(errors, name, known, count) : NULL,
             "the model has no input `%.40s` that can be set", name);
    return SIZE_MAX;
}

static bool has_ended(const struct ensemble *ensemble, double t)
{
    return t == ensemble->t && ensemble->outcome != FBD_GOING && ensemble->outcome != FBD_DONE;
}

static bool is_call(const fbd_simulation *simulation, double t, const char *name, double value,
                    fbd_errors *errors)
{
    const char *wrong = NULL;
    const struct ensemble *ensemble = simulation ? simulation->ensemble : NULL;
    if (!ensemble || !name)
        wrong = "there is no simulation, or no name of an input";
    else if (!isfinite(value))
        wrong = "the value of an input must be finite";
    else if (!(t >= ensemble->from && t <= ensemble->t))
        wrong = "the time at which an input is set lies outside the last step";
    else if (has_ended(ensemble, t))
        wrong = "the motion has ended";
    if (wrong) api_refuse(errors, wrong);
    return !wrong;
}

/* ---- the parts before */

static double ratio_of(struct energy_balance balance)
{
    return fabs(balance.residual) / balance.explained;
}

struct energy_balance simulation_energy_balance(fbd_simulation *simulation)
{
    const struct energy_balance now = ensemble_energy_balance(simulation->ensemble);
    const struct past_parts *past = &simulation->past;
    const double ratio = ratio_of(past->balance); /* NAN without motion, or without a bound */
    return past->parts > 0 && !isnan(ratio) && !(ratio <= ratio_of(now)) ? past->balance : now;
}

static void add_part(fbd_simulation *simulation)
{
    simulation->past.balance = simulation_energy_balance(simulation);
    stats_add(&simulation->past.cost, simulation->ensemble);
    simulation->past.parts++;
}

/* The events up to `start`, then those of the new part. */
static bool join_events(struct ensemble *before, struct ensemble *after)
{
    size_t kept = before->event_count;
    while (kept > 0 && before->events[kept - 1].t > after->from) kept--;
    const size_t count = kept + after->event_count;
    struct run_event *events = realloc(before->events, (count + 1) * sizeof *events);
    if (!events) return false;
    if (after->event_count > 0) memcpy(events + kept, after->events, after->event_count * sizeof *events);
    free(after->events);
    after->events = events;
    after->event_count = count;
    after->event_room = count + 1;
    before->events = NULL;
    before->event_count = kept;
    return true;
}

/* Texts of events that have not happened are forgotten. */
static void forget_details(fbd_simulation *simulation, size_t kept)
{
    while (simulation->detail_count > kept) free(simulation->details[--simulation->detail_count]);
}

static void replace(fbd_simulation *simulation, struct ensemble *after, struct fbd_state *start)
{
    forget_details(simulation, simulation->ensemble->event_count);
    free(simulation->event_errors);
    simulation->event_errors = NULL;
    if (simulation->bars) bars_free(simulation->bars);
    free(simulation->bars);
    simulation->bars = NULL;
    ensemble_free(simulation->ensemble);
    state_free(simulation->start);
    simulation->ensemble = after;
    simulation->start = start;
}

/* ---- the change */

static bool begin_again(fbd_simulation *simulation, struct fbd_state *start, fbd_errors *errors)
{
    struct run_options options = simulation->ensemble->options;
    options.start = start;
    options.continues = true;
    options.delays = false;
    options.ends_only = true;
    state_still(start, options.until);
    struct ensemble *after = ensemble_new(simulation->ensemble->model, &options);
    if (after && after->refused) {
        simulation_blame(after, errors);
        ensemble_free(after);
        return false;
    }
    if (!after || !join_events(simulation->ensemble, after)) {
        ensemble_free(after);
        diag_out_of_memory(errors);
        return false;
    }
    add_part(simulation);
    replace(simulation, after, start);
    return true;
}

static bool set_input(fbd_simulation *simulation, double t, const char *name, double value,
                      fbd_errors *errors)
{
    struct ensemble *ensemble = simulation->ensemble;
    const size_t input = settable_input(ensemble->model->scene, name, errors);
    if (input == SIZE_MAX) return false;
    struct fbd_state *start = state_new(ensemble->model);
    if (!start || !ensemble_look(ensemble, t, start)) {
        diag_out_of_memory(errors);
        state_free(start);
        return false;
    }
    const bool same = start->held[input] == value;
    start->held[input] = value;
    start->settled = false;
    const bool set = same || begin_again(simulation, start, errors);
    if (same || !set) state_free(start);
    return set;
}

bool fbd_simulation_set_input(fbd_simulation *simulation, double t, const char *name, double value,
                              fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    const bool set =
        is_call(simulation, t, name, value, errors) && set_input(simulation, t, name, value, errors);
    diag_end(&call);
    return set;
}
