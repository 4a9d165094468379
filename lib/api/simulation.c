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
    if (simulation) simulation->ensemble = ensemble_new(model, &chosen);
    if (!simulation || !simulation->ensemble) {
        free(simulation);
        diag_out_of_memory(errors);
        return NULL;
    }
    return simulation;
}

void fbd_simulation_free(fbd_simulation *simulation)
{
    if (!simulation) return;
    ensemble_free(simulation->ensemble);
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
    return ensemble_advance(simulation->ensemble);
}

void fbd_simulation_interval(const fbd_simulation *simulation, double *from, double *to)
{
    *from = simulation->ensemble->from;
    *to = simulation->ensemble->t;
}

bool fbd_simulation_state(fbd_simulation *simulation, double t, fbd_state *state)
{
    struct ensemble *ensemble = simulation->ensemble;
    return t >= ensemble->from && t <= ensemble->t && ensemble_look(ensemble, t, state);
}

size_t fbd_simulation_events(const fbd_simulation *simulation)
{
    return simulation->ensemble->event_count;
}

/* Texts of events are made the first time that they are asked for; NULL when memory is out. */
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
    const struct ensemble *run = simulation->ensemble;
    if (index >= run->event_count) return (fbd_event){.t = NAN, .body = "", .name = "", .detail = ""};
    const struct run_event *event = &run->events[index];
    return (fbd_event){.t = event->t,
                       .kind = event->kind,
                       .body = event_body(run->model, event),
                       .name = event_name(run->model, event),
                       .detail = detail_of(simulation, index)};
}

static void add_stats(fbd_stats *stats, const struct run *run)
{
    const struct stepper_counts counts = switcher_counts(run->stepper);
    stats->stiff_steps += switcher_stiff_steps(run->stepper);
    stats->steps += counts.accepted;
    stats->rhs += run->system.rhs;
    stats->jacobians += run->system.jacobians;
    stats->event_samples += (unsigned long)(run->timed.samples + run->moving.samples);
    for (int kind = 0; kind < rejection_kinds; kind++) stats->rejected += counts.rejected[kind];
    stats->linear += run->kind == structure_linear;
    stats->constant += run->kind == structure_constant;
    stats->velocity_free += run->kind == structure_velocity_free;
}

fbd_stats fbd_simulation_stats(const fbd_simulation *simulation)
{
    const struct ensemble *ensemble = simulation->ensemble;
    const struct run_options *options = &ensemble->options;
    fbd_stats stats = {.method = options_method(options),
                       .tolerance = options->tolerance,
                       .events = ensemble->event_count,
                       .seconds = simulation->seconds,
                       .groups = ensemble->count};
    for (size_t i = 0; i < ensemble->count; i++) add_stats(&stats, ensemble->groups[i].run);
    return stats;
}

const char *fbd_simulation_reason(const fbd_simulation *simulation)
{
    return simulation->ensemble->reason;
}

/* ---- a whole run */

/* The ledger looks at every step; its time is not that of the run. */
static bool account(void *context, struct ensemble *ensemble, size_t group)
{
    fbd_result *result = context;
    if (!ledger_integrates(&result->ledger, &ensemble->groups[group])) return true;
    double before = processor_seconds(); /* a call of the system: not for every step of a thousand groups */
    bool done = ledger_step(&result->ledger, ensemble, group);
    result->ledger_seconds += processor_seconds() - before;
    return done;
}

static void account_again(void *context, struct ensemble *ensemble, size_t group)
{
    fbd_result *result = context;
    ledger_restart(&result->ledger, ensemble, group);
}

/* Without rows there is nothing to stop for before the end. */
static bool carry(fbd_result *result, struct csv *csv)
{
    struct ensemble *ensemble = result->simulation->ensemble;
    while (ensemble->outcome == FBD_GOING) {
        size_t events = ensemble->event_count;
        double before = processor_seconds(), by_ledger = result->ledger_seconds;
        double next = csv ? csv_next(csv) : ensemble->options.until;
        ensemble_go(ensemble, next, csv ? csv->near : 0, csv != NULL);
        result->simulation->seconds += processor_seconds() - before - (result->ledger_seconds - by_ledger);
        if (csv && !csv_row(csv, ensemble, ensemble->event_count > events)) return false;
    }
    return ensemble->outcome != FBD_OUT_OF_MEMORY &&
           ledger_at(&result->ledger, ensemble, result->ledger.work);
}

fbd_result *fbd_simulation_run(fbd_simulation *simulation, const fbd_recording *recording)
{
    struct ensemble *ensemble = simulation->ensemble;
    if (ensemble->started) return NULL; /* the ledger has to see every step */
    fbd_result *result = calloc(1, sizeof *result);
    if (!result) return NULL;
    result->simulation = simulation;
    result->start = state_new(ensemble->model);
    struct csv csv = {0};
    struct fbd_state *start = ensemble_state(ensemble);
    bool works = !recording || recording->ledger || !recording->motion_only;
    bool done = result->start && ledger_init(&result->ledger, ensemble->model, start, works);
    if (done) {
        state_copy(result->start, start);
        if (result->ledger.any) ensemble->observer = (struct observer){result, account, account_again};
        bool rows = recording && recording->csv;
        if (rows)
            done =
                csv_begin(&csv, ensemble->model, &result->ledger, recording, ensemble->options.until, start);
        done = done && carry(result, rows ? &csv : NULL);
    }
    csv_free(&csv);
    ensemble->observer = (struct observer){0};
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
    return result->simulation->ensemble->outcome;
}

fbd_state *fbd_result_state(fbd_result *result)
{
    return ensemble_state(result->simulation->ensemble);
}

fbd_energy fbd_result_energy(fbd_result *result)
{
    return ledger_energy(&result->ledger, fbd_result_state(result), result->ledger.work);
}

double fbd_result_work(fbd_result *result, const char *body, const char *load)
{
    const struct fbd_model *model = result->ledger.model;
    for (size_t i = 0; i < model->load_count; i++)
        if (strcmp(model->loads[i].source->name, load) == 0 &&
            strcmp(model->bodies[model->loads[i].body].name, body) == 0)
            return ledger_work(&result->ledger, fbd_result_state(result), i, result->ledger.work);
    return NAN;
}
