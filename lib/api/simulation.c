/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: simulations.
 */
#include <stdlib.h>
#include <string.h>

#include "api/record.h"
#include "base/api_check.h"
#include "fbd_study.h"
#include "fbd_view.h"
#include "loop/options.h"
#include "output/words.h"

static void bad_accuracy(fbd_errors *errors, const char *hint, const char *message)
{
    diag_add(errors, FBD_ERROR, "bad-option", (struct pos){0, 0}, hint, "%s", message);
}

/* Derive the tolerance from a requested accuracy. Options take precedence over the corresponding entries of
 * the file. */
static bool choose_accuracy(const fbd_model *model, const fbd_options *options, struct run_options *chosen,
                            double *accuracy, fbd_errors *errors)
{
    bool by_hand = options->tolerance != 0 || options->step != 0;
    size_t before = fbd_errors_failed_count(errors);
    *accuracy = options->accuracy != 0 ? options->accuracy : by_hand ? 0 : model->scene->simulate.accuracy;
    if (options->accuracy != 0 && by_hand)
        bad_accuracy(errors, "give either an accuracy, or a tolerance or step",
                     "an accuracy excludes a tolerance and a step: it chooses them");
    if (!(*accuracy >= 0 && *accuracy <= 0.1))
        bad_accuracy(errors, "1e-8 is careful, 1e-3 is quick",
                     "the accuracy must be above 0 and at most 0.1");
    if (*accuracy > 0) {
        chosen->tolerance = accuracy_first_guess(*accuracy);
        chosen->step = 0;
    }
    return fbd_errors_failed_count(errors) == before;
}

/* Start a simulation. On failure `simulation` is freed. A start in the options is copied. */
static fbd_simulation *begin(fbd_simulation *simulation, const fbd_model *model,
                             const struct run_options *options, bool error_bars, fbd_errors *errors)
{
    struct run_options own = *options;
    bool made = simulation != NULL;
    if (made && error_bars) {
        simulation->bars = calloc(1, sizeof *simulation->bars);
        made = simulation->bars != NULL;
    }
    if (made && options->start) {
        own.start = simulation->start = state_new(model);
        made = simulation->start != NULL;
        if (made) state_copy(simulation->start, options->start);
    }
    if (made && simulation_begin(simulation, model, &own)) return simulation;
    fbd_simulation_free(simulation);
    diag_out_of_memory(errors);
    return NULL;
}

static fbd_simulation *simulation_new(const fbd_model *model, const fbd_options *options, fbd_errors *errors)
{
    struct run_options chosen;
    double accuracy;
    if (!options_choose(model, options, &chosen, errors)) return NULL;
    if (!choose_accuracy(model, options, &chosen, &accuracy, errors)) return NULL;
    fbd_simulation *simulation = calloc(1, sizeof *simulation);
    if (simulation) simulation->accuracy = accuracy;
    return begin(simulation, model, &chosen, options->error_bars || accuracy > 0, errors);
}

static const fbd_options no_options = FBD_OPTIONS_DEFAULT;

void fbd_options_init(fbd_options *options, size_t size)
{
    if (options) api_fill_options(options, size, &no_options, sizeof no_options);
}

fbd_simulation *fbd_simulation_new(const fbd_model *model, const fbd_options *options, fbd_errors *list)
{
    fbd_options own = FBD_OPTIONS_DEFAULT;
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_simulation *simulation = NULL;
    if (!model)
        api_refuse(errors, "there is no model");
    else if (api_take_options(&own, sizeof own, options, errors))
        simulation = simulation_new(model, &own, errors);
    diag_end(&call);
    return simulation;
}

/* An accuracy needs runs from the start of the file, and error bars apply only to these. */
static bool no_bars(fbd_errors *errors)
{
    bad_accuracy(errors, "a tolerance can be asked for",
                 "a run from a state has no error bars and no accuracy that is made sure of");
    return false;
}

fbd_simulation *fbd_simulation_again(const fbd_simulation *simulation, bool error_bars, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_simulation *again = NULL;
    if (simulation && simulation->past.parts > 0) {
        api_refuse(errors, "inputs have been set since the start: they are not set again");
    } else if (simulation) {
        const struct ensemble *ensemble = simulation->ensemble;
        if (!error_bars || !ensemble->options.start || no_bars(errors))
            again = begin(calloc(1, sizeof *again), ensemble->model, &ensemble->options, error_bars, errors);
    } else {
        api_refuse(errors, "there is no simulation");
    }
    diag_end(&call);
    return again;
}

void fbd_simulation_free(fbd_simulation *simulation)
{
    if (!simulation) return;
    simulation_end(simulation);
    free(simulation->bars);
    state_free(simulation->start);
    free(simulation);
}

/* ---- from a state */

static bool options_from(const fbd_state *state, const fbd_options *options, struct run_options *chosen,
                         fbd_errors *errors)
{
    double accuracy;
    bool plain = !options->error_bars && options->accuracy == 0;
    if ((!plain && !no_bars(errors)) || !options_choose(state->model, options, chosen, errors) ||
        !choose_accuracy(state->model, options, chosen, &accuracy, errors))
        return false;
    if (chosen->until >= state->t) return true;
    diag_in_file(errors, NULL);
    diag_add(errors, FBD_ERROR, "bad-option", (struct pos){0, 0}, "give a later end",
             "the end time lies before the state");
    return false;
}

static fbd_simulation *simulation_from(const fbd_state *state, const fbd_options *options, fbd_errors *errors)
{
    struct run_options chosen;
    if (!options_from(state, options, &chosen, errors)) return NULL;
    struct fbd_state *start = state_new(state->model);
    fbd_simulation *simulation = NULL;
    if (start) {
        state_copy(start, state);
        state_still(start, chosen.until);
        chosen.start = start;
        simulation = begin(calloc(1, sizeof *simulation), state->model, &chosen, false, errors);
    } else {
        diag_out_of_memory(errors);
    }
    state_free(start);
    return simulation;
}

fbd_simulation *fbd_simulation_from(const fbd_state *state, const fbd_options *options, fbd_errors *list)
{
    fbd_options own = FBD_OPTIONS_DEFAULT;
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_simulation *simulation = NULL;
    if (!state)
        api_refuse(errors, "there is no state");
    else if (api_take_options(&own, sizeof own, options, errors))
        simulation = simulation_from(state, &own, errors);
    diag_end(&call);
    return simulation;
}

/* ---- step by step */

fbd_outcome fbd_simulation_advance(fbd_simulation *simulation)
{
    if (!simulation) return FBD_FAILED;
    struct ensemble *ensemble = simulation->ensemble;
    if (!bars_catch_up(simulation->bars, ensemble))
        ensemble_fail(ensemble, FBD_OUT_OF_MEMORY, "out of memory");
    ensemble_advance(ensemble);
    if (simulation->bars) simulation->bars->behind = true;
    return ensemble->outcome;
}

fbd_outcome fbd_simulation_outcome(const fbd_simulation *simulation)
{
    return simulation ? simulation->ensemble->outcome : FBD_FAILED;
}

void fbd_simulation_interval(const fbd_simulation *simulation, double *from, double *to)
{
    if (from) *from = simulation ? simulation->ensemble->from : NAN;
    if (to) *to = simulation ? simulation->ensemble->t : NAN;
}

bool fbd_simulation_state(fbd_simulation *simulation, double t, fbd_state *state)
{
    struct ensemble *ensemble = simulation ? simulation->ensemble : NULL;
    if (!ensemble || !state || state->model != ensemble->model) return false;
    return t >= ensemble->from && t <= ensemble->t && ensemble_look(ensemble, t, state);
}

size_t fbd_simulation_event_count(const fbd_simulation *simulation)
{
    if (!simulation) return 0;
    return simulation->ensemble->event_count;
}

/* The text of an event, made at its first use; "" when memory is out. */
static const char *detail_of(fbd_simulation *simulation, size_t index)
{
    const struct ensemble *run = simulation->ensemble;
    if (index >= simulation->detail_count) {
        char **details = realloc(simulation->details, run->event_count * sizeof *details);
        if (!details) return "";
        for (size_t i = simulation->detail_count; i < run->event_count; i++) details[i] = NULL;
        simulation->details = details;
        simulation->detail_count = run->event_count;
    }
    if (!simulation->details[index]) {
        char text[event_detail_size];
        event_detail(run->model, &run->events[index], text, sizeof text);
        simulation->details[index] = strdup(text);
    }
    return simulation->details[index] ? simulation->details[index] : "";
}

fbd_event fbd_simulation_event(fbd_simulation *simulation, size_t index)
{
    const struct ensemble *run = simulation ? simulation->ensemble : NULL;
    if (!run || index >= run->event_count) return (fbd_event){.t = NAN, .t_error = NAN};
    const struct run_event *event = &run->events[index];
    return (fbd_event){.t = event->t,
                       .kind = event->kind,
                       .body = event_body(run->model, event),
                       .name = event_name(run->model, event),
                       .detail = detail_of(simulation, index),
                       .t_error = simulation_event_error(simulation, index)};
}

void simulation_blame(const struct ensemble *ensemble, fbd_errors *errors)
{
    const struct ending *end = &ensemble->refused->end;
    diag_in_file(errors, ensemble->model->scene->file);
    diag_add(errors, FBD_ERROR, end->refusal, end->refusal_at, NULL, "%s", end->reason);
}

bool fbd_simulation_blame(const fbd_simulation *simulation, fbd_errors *list)
{
    struct diag_call call;
    if (!simulation || !simulation->ensemble->refused) return false;
    simulation_blame(simulation->ensemble, diag_begin(&call, list));
    diag_end(&call);
    return true;
}

bool fbd_simulation_balanced(fbd_simulation *simulation, double *residual, double *explained)
{
    struct energy_balance balance = {NAN, NAN};
    if (simulation) balance = simulation_energy_balance(simulation);
    if (residual) *residual = balance.residual;
    if (explained) *explained = balance.explained;
    return simulation && !(fabs(balance.residual) > balance.explained);
}

const char *fbd_simulation_reason(const fbd_simulation *simulation)
{
    if (!simulation) return "";
    return simulation->ensemble->reason;
}
