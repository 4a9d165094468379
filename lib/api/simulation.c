/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: simulations and whole runs.
 */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "output/csv.h"
#include "output/result.h"
#include "solve/options.h"

fbd_simulation *fbd_simulation_new(const fbd_model *model, const fbd_options *options, fbd_errors *errors)
{
    struct run_options chosen;
    if (!options_choose(model, options, &chosen, errors)) return NULL;
    fbd_simulation *simulation = calloc(1, sizeof *simulation);
    if (simulation) simulation->run = run_new(model, &chosen);
    if (!simulation || !simulation->run) {
        free(simulation);
        diag_out_of_memory(errors);
        return NULL;
    }
    return simulation;
}

void fbd_simulation_free(fbd_simulation *simulation)
{
    if (!simulation) return;
    run_free(simulation->run);
    for (size_t i = 0; i < simulation->detail_count; i++) free(simulation->details[i]);
    free(simulation->details);
    free(simulation);
}

/* ---- step by step */

static double processor_seconds(void)
{
    struct timespec now;
    return clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now) == 0
               ? (double)now.tv_sec + 1e-9 * (double)now.tv_nsec
               : 0;
}

fbd_outcome fbd_simulation_advance(fbd_simulation *simulation)
{
    return run_advance(simulation->run);
}

void fbd_simulation_interval(const fbd_simulation *simulation, double *from, double *to)
{
    *from = simulation->run->from;
    *to = simulation->run->state->t;
}

bool fbd_simulation_state(fbd_simulation *simulation, double t, fbd_state *state)
{
    struct run *run = simulation->run;
    if (t == run->state->t) {
        state_copy(state, run->state);
        return true;
    }
    return t >= run->from && t < run->state->t && run_look(run, t, state);
}

size_t fbd_simulation_events(const fbd_simulation *simulation)
{
    return simulation->run->event_count;
}

/* Texts of events are made the first time that they are asked for; NULL when memory is out. */
static const char *detail_of(fbd_simulation *simulation, size_t index)
{
    const struct run *run = simulation->run;
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
    const struct run *run = simulation->run;
    if (index >= run->event_count) return (fbd_event){.t = NAN, .body = "", .name = "", .detail = ""};
    const struct run_event *event = &run->events[index];
    return (fbd_event){.t = event->t,
                       .kind = event->kind,
                       .body = event_body(run->model, event),
                       .name = event_name(run->model, event),
                       .detail = detail_of(simulation, index)};
}

fbd_stats fbd_simulation_stats(const fbd_simulation *simulation)
{
    const struct run *run = simulation->run;
    const struct stepper_counts counts = switcher_counts(run->stepper);
    fbd_stats stats = {.method = options_method(&run->options),
                       .stiff_steps = switcher_stiff_steps(run->stepper),
                       .tolerance = run->options.tolerance,
                       .steps = counts.accepted,
                       .rhs = run->system.rhs,
                       .jacobians = run->system.jacobians,
                       .events = run->event_count,
                       .event_samples = (unsigned long)(run->timed.samples + run->moving.samples),
                       .seconds = simulation->seconds};
    for (int kind = 0; kind < rejection_kinds; kind++) stats.rejected += counts.rejected[kind];
    return stats;
}

const char *fbd_simulation_reason(const fbd_simulation *simulation)
{
    return simulation->run->reason;
}

/* ---- a whole run */

static bool carry(fbd_result *result, struct csv *csv)
{
    struct run *run = result->simulation->run;
    while (run->outcome == FBD_GOING) {
        size_t events = run->event_count;
        double before = processor_seconds();
        run_advance(run);
        result->simulation->seconds += processor_seconds() - before;
        if (!(run->state->t > run->from) && run->outcome != FBD_GOING) break; /* no step was made */
        if (csv && !csv_step(csv, run, run->event_count > events)) return false;
        if (!ledger_step(&result->ledger, run)) return false;
    }
    return run->outcome != FBD_OUT_OF_MEMORY;
}

fbd_result *fbd_simulation_run(fbd_simulation *simulation, const fbd_recording *recording)
{
    struct run *run = simulation->run;
    if (run->state->t > 0) return NULL; /* the ledger has to see every step */
    fbd_result *result = calloc(1, sizeof *result);
    if (!result) return NULL;
    result->simulation = simulation;
    result->start = state_new(run->model);
    struct csv csv = {0};
    bool works = !recording || recording->ledger || !recording->motion_only;
    bool done = result->start && ledger_init(&result->ledger, run->model, run->state, works);
    if (done) {
        state_copy(result->start, run->state);
        bool rows = recording && recording->csv;
        if (rows)
            done = csv_begin(&csv, run->model, &result->ledger, recording, run->options.until, run->state);
        done = done && carry(result, rows ? &csv : NULL);
    }
    csv_free(&csv);
    if (done) return result;
    fbd_result_free(result);
    return NULL;
}

void fbd_result_free(fbd_result *result)
{
    if (!result) return;
    ledger_free(&result->ledger);
    state_free(result->start);
    free(result);
}

fbd_outcome fbd_result_outcome(const fbd_result *result)
{
    return result->simulation->run->outcome;
}

fbd_state *fbd_result_state(fbd_result *result)
{
    return result->simulation->run->state;
}

fbd_energy fbd_result_energy(fbd_result *result)
{
    return ledger_energy(&result->ledger, result->simulation->run->state, result->ledger.work);
}

double fbd_result_work(fbd_result *result, const char *body, const char *load)
{
    const struct fbd_model *model = result->ledger.model;
    for (size_t i = 0; i < model->load_count; i++)
        if (strcmp(model->loads[i].source->name, load) == 0 &&
            strcmp(model->bodies[model->loads[i].body].name, body) == 0)
            return ledger_work(&result->ledger, result->simulation->run->state, i, result->ledger.work);
    return NAN;
}
