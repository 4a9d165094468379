/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Error bars of a result.
 */
#include <stdlib.h>

#include "fbd_study.h"
#include "record/result.h"

bool simulation_match_events(fbd_simulation *simulation)
{
    struct ensemble *main = simulation->ensemble;
    const struct companion *companion = simulation->bars->companion;
    bool fresh = simulation->event_errors && simulation->main_events == main->event_count &&
                 simulation->other_events == companion->ensemble->event_count;
    if (fresh) return true;
    double *errors = realloc(simulation->event_errors, (main->event_count + 1) * sizeof *errors);
    if (!errors) return false;
    companion_event_errors(companion, main, errors);
    simulation->event_errors = errors;
    simulation->main_events = main->event_count;
    simulation->other_events = companion->ensemble->event_count;
    return true;
}

double simulation_event_error(fbd_simulation *simulation, size_t index)
{
    struct ensemble *main = simulation->ensemble;
    if (!simulation->bars || index >= main->event_count) return NAN;
    bool fine = main->outcome == FBD_GOING || bars_catch_up(simulation->bars, main);
    return fine && simulation_match_events(simulation) ? simulation->event_errors[index] : NAN;
}

bool fbd_simulation_errors(fbd_simulation *simulation, double t, double *errors)
{
    if (!simulation || !errors) return false;
    struct ensemble *run = simulation->ensemble;
    struct bars *bars = simulation->bars;
    size_t size = plan_size(&run->model->plan);
    struct fbd_state *state = bars && t >= run->from && t <= run->t ? state_new(run->model) : NULL;
    if (!state) return false;
    bool event = t == run->t && run->event_count > 0 && run->events[run->event_count - 1].t == t;
    bool fine = ensemble_look(run, t, state);
    if (fine && !bars_looked(bars, t)) fine = bars_look(bars, run, t, event, false);
    for (size_t i = 0; fine && i < size; i++) errors[i] = bars_component(bars, state, i);
    state_free(state);
    return fine;
}

/* ---- at the end of a run */

double fbd_result_error(fbd_result *result, const char *name)
{
    if (!result || !name) return NAN;
    const struct bars *bars = result->simulation->bars;
    int index = model_find_component(result->ledger.model, name, false);
    return bars && index >= 0 ? bars_component(bars, fbd_result_state(result), (size_t)index) : NAN;
}

fbd_energy fbd_result_energy_error(fbd_result *result)
{
    if (!result) return (fbd_energy){NAN, NAN, NAN, NAN, NAN, NAN};
    fbd_energy energy = fbd_result_energy(result);
    if (result->simulation->bars) return bars_energy(result->simulation->bars, &energy);
    return (fbd_energy){NAN, NAN, NAN, NAN, NAN, NAN};
}

double fbd_result_work_error(fbd_result *result, const char *body, const char *load)
{
    if (!result || !body || !load) return NAN;
    struct bars *bars = result->simulation->bars;
    int index = model_find_load(result->ledger.model, body, load);
    return bars && index >= 0 ? bars_work(bars, (size_t)index, fbd_result_work(result, body, load)) : NAN;
}
