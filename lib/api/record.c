/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: whole runs.
 */
#include "api/record.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "draw/record.h"

/* ---- a run of a simulation */

bool simulation_begin(fbd_simulation *simulation, const struct fbd_model *model,
                      const struct run_options *options)
{
    simulation->run = run_new(model, options);
    return simulation->run && (!simulation->bars || bars_init(simulation->bars, model, options));
}

void simulation_end(fbd_simulation *simulation)
{
    run_free(simulation->run);
    if (simulation->bars) bars_free(simulation->bars);
    for (size_t i = 0; i < simulation->detail_count; i++) free(simulation->details[i]);
    free(simulation->details);
    free(simulation->event_errors);
    simulation->run = NULL;
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

/* Tell how far the run is, and end it when that is answered by a stop. */
static void tell_progress(struct run *run, const fbd_recording *recording)
{
    fbd_progress progress = run_progress(run, run->state->t);
    if (recording->progress(recording->progress_context, &progress) != 0)
        run_cut(run, run->state->t, run->event_count);
}

static bool carry(fbd_result *result, const fbd_recording *recording, struct csv *csv)
{
    struct run *run = result->simulation->run;
    struct bars *bars = result->simulation->bars;
    while (run->outcome == FBD_GOING) {
        size_t events = run->event_count;
        double before = processor_seconds();
        run_advance(run);
        result->simulation->seconds += processor_seconds() - before;
        if (!(run->state->t > run->from) && run->outcome != FBD_GOING) break; /* no step was made */
        if (recording && recording->progress && run->outcome == FBD_GOING) tell_progress(run, recording);
        if (csv && !csv_step(csv, run, events)) return false;
        if (!ledger_step(&result->ledger, run)) return false;
        if (result->record && !record_step(result->record, run, events)) return false;
        if (bars && !bars_step(bars, run)) return false;
    }
    if (run->outcome == FBD_OUT_OF_MEMORY) return false;
    return !bars || (bars_finish(bars, run) && simulation_match_events(result->simulation));
}

static bool begin_record(fbd_result *result, const fbd_recording *recording)
{
    result->record = calloc(1, sizeof *result->record);
    return result->record &&
           record_begin(result->record, result->simulation->run, &result->ledger, recording->every);
}

static bool record_into(fbd_result *result, const fbd_recording *recording)
{
    struct run *run = result->simulation->run;
    struct bars *bars = result->simulation->bars;
    bool works = !recording || recording->ledger || recording->keep || !recording->motion_only;
    result->start = state_new(run->model);
    if (!result->start || !ledger_init(&result->ledger, run->model, run->state, works)) return false;
    if (bars && !works) bars->ledger.any = false;
    state_copy(result->start, run->state);
    if (recording && recording->keep && !begin_record(result, recording)) return false;
    if (!recording || !recording->csv) return carry(result, recording, NULL);
    struct csv csv = {0};
    bool done = csv_begin(&csv, run, &result->ledger, bars, recording) && carry(result, recording, &csv);
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
    simulation->runs++;
    simulation->seconds_spent += processor_seconds() - begin;
    if (done) return result;
    fbd_result_free(result);
    return NULL;
}

fbd_result *fbd_simulation_run(fbd_simulation *simulation, const fbd_recording *recording)
{
    if (simulation->run->state->t > 0) return NULL; /* the ledger has to see every step */
    return simulation->accuracy > 0 ? record_accurately(simulation, recording)
                                    : record(simulation, recording);
}

void fbd_result_free(fbd_result *result)
{
    if (!result) return;
    if (result->record) record_free(result->record);
    free(result->record);
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
