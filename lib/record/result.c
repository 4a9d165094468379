/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Result of a run, and its cost.
 */
#include "record/result.h"

#include "fbd_study.h"
#include "integrate/switcher.h"
#include "loop/options.h"

fbd_outcome fbd_result_outcome(const fbd_result *result)
{
    if (!result) return FBD_FAILED;
    return result->simulation->ensemble->outcome;
}

fbd_state *fbd_result_state(fbd_result *result)
{
    if (!result) return NULL;
    return ensemble_state(result->simulation->ensemble);
}

fbd_energy fbd_result_energy(fbd_result *result)
{
    if (!result) return (fbd_energy){NAN, NAN, NAN, NAN, NAN, NAN};
    return ledger_energy(&result->ledger, fbd_result_state(result), result->ledger.work);
}

double fbd_result_residual_explained(fbd_result *result)
{
    if (!result) return NAN;
    fbd_stats stats = fbd_simulation_stats(result->simulation);
    if (result->simulation->ensemble->options.step > 0) return HUGE_VAL;
    return ledger_explained(&result->ledger, fbd_result_state(result), stats.tolerance, (double)stats.steps);
}

bool fbd_result_balanced(fbd_result *result, double *residual, double *explained)
{
    struct energy_balance balance = {NAN, NAN};
    if (result && result->ledger.works)
        balance = (struct energy_balance){fbd_result_energy(result).residual,
                                          fbd_result_residual_explained(result)};
    if (result && !(fabs(balance.residual) > balance.explained))
        balance = ensemble_energy_balance(result->simulation->ensemble);
    if (result && result->simulation->ensemble->refused)
        balance = (struct energy_balance){0, 0}; /* no motion */
    if (residual) *residual = balance.residual;
    if (explained) *explained = balance.explained;
    return result && !(fabs(balance.residual) > balance.explained);
}

double fbd_result_work(fbd_result *result, const char *body, const char *load)
{
    if (!result || !body || !load) return NAN;
    int index = model_find_load(result->ledger.model, body, load);
    if (index < 0) return NAN;
    return ledger_work(&result->ledger, fbd_result_state(result), (size_t)index, result->ledger.work);
}

bool fbd_result_accurate(const fbd_result *result)
{
    if (!result) return false;
    const fbd_simulation *simulation = result->simulation;
    fbd_outcome outcome = simulation->ensemble->outcome;
    if (simulation->accuracy == 0) return true;
    if (simulation->cut || outcome == FBD_FAILED || outcome == FBD_INTERRUPTED ||
        outcome == FBD_OUT_OF_MEMORY)
        return false;
    return companion_global(simulation->bars->companion) <= simulation->accuracy;
}

/* ---- cost */

void stats_add(fbd_stats *stats, const struct ensemble *ensemble)
{
    for (size_t i = 0; i < ensemble->count; i++) {
        const struct run_totals totals = group_totals(&ensemble->groups[i]);
        stats->stiff_steps += totals.stiff_steps;
        stats->steps += totals.steps;
        stats->rhs += totals.rhs;
        stats->jacobians += totals.jacobians;
        stats->event_samples += totals.event_samples;
        stats->rejected += totals.rejected;
        stats->linear += totals.kind == structure_linear;
        stats->constant += structure_is_one_step(totals.kind);
        stats->velocity_free += totals.kind == structure_velocity_free;
    }
}

fbd_stats fbd_simulation_stats(const fbd_simulation *simulation)
{
    if (!simulation) return (fbd_stats){.method = "", .error_estimate = NAN};
    struct ensemble *ensemble = simulation->ensemble;
    const struct run_options *options = &ensemble->options;
    fbd_stats stats = simulation->past.cost;
    stats.method = options_method(options);
    stats.tolerance = options->tolerance;
    stats.events = (unsigned long)ensemble->event_count;
    stats.seconds = simulation->seconds;
    stats.groups = ensemble->count;
    stats.linear = stats.constant = stats.velocity_free = 0; /* of the groups that there are now */
    stats.error_estimate = NAN;
    stats.accuracy = simulation->accuracy;
    stats.runs = simulation->runs;
    stats.seconds_spent = simulation->seconds_spent;
    stats_add(&stats, ensemble);
    if (simulation->bars) {
        const struct companion *companion = simulation->bars->companion;
        if (ensemble->outcome != FBD_GOING) bars_catch_up(simulation->bars, ensemble);
        stats.error_estimate = companion_global(companion);
        fbd_stats other = {0};
        stats_add(&other, companion->ensemble);
        stats.companion_steps = other.steps;
        stats.companion_rhs = other.rhs;
    }
    return stats;
}
