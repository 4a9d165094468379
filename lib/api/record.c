/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: whole runs.
 */
#include "api/record.h"

#include <stdlib.h>
#include <time.h>

#include "base/api_check.h"
#include "fbd_export.h"
#include "output/run_record.h"
#include "record/finite_result.h"

/* ---- a run of a simulation */

bool simulation_begin(fbd_simulation *simulation, const struct fbd_model *model,
                      const struct run_options *options)
{
    struct run_options own = *options;
    own.ends_only = !simulation->bars;
    own.delays = simulation->bars != NULL;
    simulation->ensemble = ensemble_new(model, &own);
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

/* ---- during the run */

struct going {
    fbd_result *result;
    const fbd_recording *recording; /* or NULL */
    unsigned long steps;
    bool whole;   /* no rows, record or error bars: no stops before the end */
    double slice; /* fraction of the run to the next common time of the islands */
    double check; /* the next time at which the balance of forces and motion is checked */
};

/* After an interruption the islands continue to the end of a slice: a thousandth of the run, less where a stiff island
 * would need millions of steps for that, and more where most islands would make no step: each slice costs a look at
 * every island. Slices start short, and double as long as they take few steps. */
static const double first_slice = 1e-9, usual_slice = 1e-3;

static void adapt_slice(struct going *going, unsigned long made)
{
    const size_t islands = going->result->simulation->ensemble->count, most = 1000 * islands;
    if (made > most)
        going->slice *= (double)most / (double)made;
    else if (made < islands || going->slice < usual_slice)
        going->slice *= 2;
}

static double begin_of(const struct ensemble *ensemble)
{
    return ensemble->options.start ? ensemble->options.start->t : 0;
}

/* Report the progress; returns true if the run is to end. */
static bool tell(const struct going *going, double t)
{
    const fbd_recording *recording = going->recording;
    const struct ensemble *ensemble = going->result->simulation->ensemble;
    if (!recording || !recording->progress) return false;
    double begin = begin_of(ensemble), end = ensemble->options.until;
    double share = t < end ? (t - begin) / (end - begin) : 1;
    fbd_progress progress = {.what = "run",
                             .share = share > 0 ? share : 0,
                             .t = t,
                             .until = end,
                             .steps = going->steps,
                             .events = ensemble->event_count};
    return recording->progress(recording->progress_context, &progress) != 0;
}

static void tell_progress(const struct going *going, double t)
{
    struct ensemble *ensemble = going->result->simulation->ensemble;
    if (ensemble->outcome == FBD_GOING && tell(going, t)) ensemble_interrupt(ensemble);
}

/* Report the progress; also called while the companion continues after the end of the run. */
static bool is_ended(void *context)
{
    const struct going *going = context;
    struct ensemble *ensemble = going->result->simulation->ensemble;
    bool ended = ensemble->outcome == FBD_INTERRUPTED || tell(going, ensemble->t);
    if (ended && ensemble->outcome == FBD_GOING) ensemble_interrupt(ensemble);
    return ended;
}

/* Update the ledger after a step; its time does not count as that of the run. */
static bool observe(void *context, struct ensemble *ensemble, size_t group)
{
    struct going *going = context;
    fbd_result *result = going->result;
    going->steps++;
    /* a single island without stops has no common time to wait for */
    bool alone = ensemble->count == 1 && going->whole;
    tell_progress(going, alone ? ensemble->groups[group].run->state->t : ensemble->t);
    if (ensemble->groups[group].run->log.count > 0 &&
        !event_states_note(&result->event_states, ensemble, group)) {
        ensemble_fail(ensemble, FBD_OUT_OF_MEMORY, "out of memory");
        return false;
    }
    if (result->ledger.works) ledger_note(&result->ledger, &ensemble->groups[group]);
    if (!result->ledger.any || !ledger_counts(&result->ledger, &ensemble->groups[group])) return true;
    double before = processor_seconds(); /* a system call: only where the ledger has work to do */
    bool done = ledger_step(&result->ledger, ensemble, group);
    result->ledger_seconds += processor_seconds() - before;
    return done;
}

static void observe_again(void *context, struct ensemble *ensemble, size_t group)
{
    struct going *going = context;
    event_states_restart(&going->result->event_states, group);
    if (going->result->ledger.any) ledger_restart(&going->result->ledger, ensemble, group);
}

static double end_of_slice(const struct going *going, const struct ensemble *ensemble)
{
    double end = ensemble->t + going->slice * ensemble->options.until;
    return end > ensemble->t ? end : nextafter(ensemble->t, HUGE_VAL);
}

/* The next time at which something other than a row is due: a sample of the errors, the end of a step for the
 * record, or the end of a slice, so that the progress function is called. No slices are needed for a single
 * island without stops, or with a record, since progress is then reported after each step. */
static double next_stop(const struct going *going)
{
    const struct bars *bars = going->result->simulation->bars;
    struct ensemble *ensemble = going->result->simulation->ensemble;
    double next = bars ? bars_next(bars) : HUGE_VAL;
    if (going->result->record) next = fmin(next, ensemble_next_end(ensemble));
    bool told = going->recording && going->recording->progress;
    if (told && !going->result->record && !(ensemble->count == 1 && going->whole))
        return bars ? fmin(next, end_of_slice(going, ensemble)) : end_of_slice(going, ensemble);
    return next;
}

/* Go to t (see ensemble_go), and measure the time of the steps; if t is reached already, the clock, a system
 * call, is not read. */
static void go(struct going *going, double t, double near, bool pause)
{
    fbd_result *result = going->result;
    fbd_simulation *simulation = result->simulation;
    struct ensemble *ensemble = simulation->ensemble;
    bool timed = !ensemble_has_reached(ensemble, t);
    double before = timed ? processor_seconds() : 0, by_ledger = result->ledger_seconds;
    ensemble_go(ensemble, t, near, pause);
    if (timed) simulation->seconds += processor_seconds() - before - (result->ledger_seconds - by_ledger);
}

/* Check the balance at a row or a step of the record: at each event, at the end, and at the others at most so many
 * times in a run, since it costs as much as to write the row. */
static void check_balance(struct going *going, bool event)
{
    const double most = 500;
    struct ensemble *ensemble = going->result->simulation->ensemble;
    if (!event && ensemble->outcome == FBD_GOING && ensemble->t < going->check) return;
    ensemble_check_balance(ensemble);
    going->check = ensemble->t + (ensemble->options.until - begin_of(ensemble)) / most;
}

/* Carry the run to the next such time. A row's time and another one that differ only by rounding are
 * distinct, so that the output does not depend on error bars. */
static bool carry_on(struct going *going, struct csv *csv)
{
    fbd_result *result = going->result;
    fbd_simulation *simulation = result->simulation;
    struct ensemble *ensemble = simulation->ensemble;
    size_t events = ensemble->event_count;
    double from = ensemble->t;
    double row = csv ? csv_next(csv) : ensemble->options.until, stop = next_stop(going);
    bool other = stop < row;
    unsigned long before = going->steps;
    go(going, other ? stop : row, csv && !other ? csv->near : 0, csv || result->record);
    adapt_slice(going, going->steps - before);
    tell_progress(going, ensemble->t);
    bool event = ensemble->event_count > events;
    bool due = csv && (!other || event || ensemble->outcome != FBD_GOING);
    if (due || result->record) check_balance(going, event);
    if (due && !csv_row(csv, ensemble, event)) return false;
    if (result->record && !record_step(result->record, ensemble, from, event)) return false;
    if (result->record && result->record->odd)
        ensemble_spoil(ensemble, "`%s` is not finite at t = %.9g", result->record->odd,
                       result->record->odd_time);
    return !simulation->bars || bars_step(simulation->bars, ensemble);
}

/* Check that all results at the end are finite, or else the run has failed. Returns false when memory is out. */
static bool is_whole(fbd_result *result)
{
    struct ensemble *ensemble = result->simulation->ensemble;
    return ensemble->outcome == FBD_FAILED || result_finite(ensemble, &result->ledger, result->ledger.work) ||
           ensemble->outcome == FBD_FAILED;
}

/* Carry the run to its end; without rows, record and error bars there are no stops before. */
static bool carry(fbd_result *result, const fbd_recording *recording, struct csv *csv)
{
    fbd_simulation *simulation = result->simulation;
    struct ensemble *ensemble = simulation->ensemble;
    struct bars *bars = simulation->bars;
    bool whole = !csv && !result->record && !bars;
    struct going going = {result, recording, 0, whole, first_slice, 0};
    ensemble->options.ends_only = whole;
    if (result->ledger.works || (recording && recording->progress))
        ensemble->observer = (struct observer){&going, observe, observe_again};
    if (bars && recording && recording->progress) {
        bars->is_ended = is_ended;
        bars->watcher = &going;
    }
    bool fine = true;
    while (fine && ensemble->outcome == FBD_GOING) fine = carry_on(&going, csv);
    fine = fine && ensemble->outcome != FBD_OUT_OF_MEMORY &&
           ledger_at(&result->ledger, ensemble, result->ledger.work) && is_whole(result);
    ensemble->observer = (struct observer){0};
    fine = fine && (!bars || (bars_finish(bars, ensemble) && simulation_match_events(simulation)));
    if (bars) bars->is_ended = NULL;
    return fine;
}

static bool begin_record(fbd_result *result, const fbd_recording *recording)
{
    result->record = calloc(1, sizeof *result->record);
    return result->record &&
           record_begin(result->record, result->simulation->ensemble, &result->ledger, recording);
}

static bool record_into(fbd_result *result, const fbd_recording *recording)
{
    struct ensemble *ensemble = result->simulation->ensemble;
    struct bars *bars = result->simulation->bars;
    struct fbd_state *start = ensemble_state(ensemble);
    bool works = !recording || recording->ledger || recording->keep || !recording->motion_only;
    result->start = state_new(ensemble->model);
    if (!result->start || !ledger_init(&result->ledger, ensemble->model, start, works)) return false;
    if (bars && !works) bars->ledger.any = false;
    state_copy(result->start, start);
    if (recording && recording->keep && !begin_record(result, recording)) return false;
    if (!recording || !(recording->csv || recording->table)) return carry(result, recording, NULL);
    struct csv csv = {0};
    bool done = csv_begin(&csv, result, recording) && carry(result, recording, &csv);
    csv_free(&csv);
    return done;
}

fbd_result *record(fbd_simulation *simulation, const fbd_recording *recording)
{
    fbd_result *result = calloc(1, sizeof *result);
    if (!result) return NULL;
    double begin = processor_seconds();
    result->simulation = simulation;
    result->degrees = recording && recording->degrees;
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
    fbd_recording own = {0};
    if (!simulation || !api_take_options(&own, sizeof own, recording, NULL)) return NULL;
    if (recording) recording = &own;
    if (simulation->ensemble->started || simulation->past.parts > 0)
        return NULL; /* the ledger needs every step */
    return simulation->accuracy > 0 ? record_accurately(simulation, recording)
                                    : record(simulation, recording);
}

void fbd_result_free(fbd_result *result)
{
    if (!result) return;
    if (result->record) record_free(result->record);
    free(result->record);
    ledger_free(&result->ledger);
    numbers_free(&result->numbers);
    event_states_free(&result->event_states);
    state_free(result->start);
    free(result);
}

fbd_table fbd_result_table(const fbd_result *result)
{
    if (!result || result->numbers.columns == 0) return (fbd_table){.rows = 0};
    const struct numbers *numbers = &result->numbers;
    return (fbd_table){.rows = numbers->whole / numbers->columns,
                       .columns = numbers->columns,
                       .heads = numbers->heads,
                       .values = numbers->values};
}
