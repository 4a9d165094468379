/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: whole runs.
 */
#include "api/record.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- a run of a simulation */

bool simulation_begin(fbd_simulation *simulation, const struct fbd_model *model,
                      const struct run_options *options)
{
    simulation->ensemble = ensemble_new(model, options);
    return simulation->ensemble && (!simulation->bars || bars_init(simulation->bars, model, options));
}

void simulation_end(fbd_simulation *simulation)
{
    ensemble_free(simulation->ensemble);
    if (simulation->bars) bars_free(simulation->bars);
    for (size_t i = 0; i < simulation->detail_count; i++) free(simulation->details[i]);
    free(simulation->details);
    free(simulation->event_errors);
    simulation->ensemble = NULL;
    simulation->details = NULL;
    simulation->detail_count = 0;
    simulation->event_errors = NULL;
}

static double processor_seconds(void)
{
    struct timespec now;
    return clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now) == 0
               ? (double)now.tv_sec + 1e-9 * (double)now.tv_nsec
               : 0;
}

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

/* Carry the run on to the next time at which there is something to do. A row's time and a sample's that are
 * the same but for rounding are two: what is written does not depend on error bars. */
static bool carry_on(fbd_result *result, struct csv *csv)
{
    fbd_simulation *simulation = result->simulation;
    struct ensemble *ensemble = simulation->ensemble;
    struct bars *bars = simulation->bars;
    size_t events = ensemble->event_count;
    double before = processor_seconds(), by_ledger = result->ledger_seconds;
    double next = csv ? csv_next(csv) : ensemble->options.until;
    bool sample = bars && bars_next(bars) < next;
    ensemble_go(ensemble, sample ? bars_next(bars) : next, csv && !sample ? csv->near : 0, csv != NULL);
    simulation->seconds += processor_seconds() - before - (result->ledger_seconds - by_ledger);
    bool event = ensemble->event_count > events;
    bool due = csv && (!sample || event || ensemble->outcome != FBD_GOING);
    if (due && !csv_row(csv, ensemble, event)) return false;
    return !bars || bars_step(bars, ensemble);
}

/* Without rows and error bars there is nothing to stop for before the end. */
static bool carry(fbd_result *result, struct csv *csv)
{
    fbd_simulation *simulation = result->simulation;
    struct ensemble *ensemble = simulation->ensemble;
    struct bars *bars = simulation->bars;
    while (ensemble->outcome == FBD_GOING)
        if (!carry_on(result, csv)) return false;
    if (ensemble->outcome == FBD_OUT_OF_MEMORY) return false;
    if (!ledger_at(&result->ledger, ensemble, result->ledger.work)) return false;
    return !bars || (bars_finish(bars, ensemble) && simulation_match_events(simulation));
}

static bool record_into(fbd_result *result, const fbd_recording *recording)
{
    struct ensemble *ensemble = result->simulation->ensemble;
    struct bars *bars = result->simulation->bars;
    struct fbd_state *start = ensemble_state(ensemble);
    bool works = !recording || recording->ledger || !recording->motion_only;
    result->start = state_new(ensemble->model);
    if (!result->start || !ledger_init(&result->ledger, ensemble->model, start, works)) return false;
    if (bars && !works) bars->ledger.any = false;
    state_copy(result->start, start);
    if (result->ledger.any) ensemble->observer = (struct observer){result, account, account_again};
    if (!recording || !recording->csv) return carry(result, NULL);
    struct csv csv = {0};
    bool done = csv_begin(&csv, ensemble, &result->ledger, bars, recording) && carry(result, &csv);
    csv_free(&csv);
    return done;
}

fbd_result *record(fbd_simulation *simulation, const fbd_recording *recording)
{
    fbd_result *result = calloc(1, sizeof *result);
    if (!result) return NULL;
    double begin = processor_seconds();
    result->simulation = simulation;
    simulation->seconds = 0;
    bool done = record_into(result, recording);
    simulation->ensemble->observer = (struct observer){0};
    simulation->runs++;
    simulation->seconds_spent += processor_seconds() - begin;
    if (done) return result;
    fbd_result_free(result);
    return NULL;
}

fbd_result *fbd_simulation_run(fbd_simulation *simulation, const fbd_recording *recording)
{
    if (simulation->ensemble->started) return NULL; /* the ledger has to see every step */
    return simulation->accuracy > 0 ? record_accurately(simulation, recording)
                                    : record(simulation, recording);
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
