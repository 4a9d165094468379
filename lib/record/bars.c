/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/bars.h"
#include "numeric/tolerances.h"

#include <stdlib.h>
#include <string.h>

/* Enter the steps of the companion in its ledger. */
static bool account(void *context, struct ensemble *ensemble, size_t group)
{
    struct bars *bars = context;
    if (bars->is_ended && bars->is_ended(bars->watcher)) ensemble_interrupt(ensemble);
    if (!bars->ledger.any) return true;
    ledger_note(&bars->ledger, &ensemble->groups[group]);
    return ledger_step(&bars->ledger, ensemble, group);
}

static void account_again(void *context, struct ensemble *ensemble, size_t group)
{
    struct bars *bars = context;
    ledger_restart(&bars->ledger, ensemble, group);
}

bool bars_init(struct bars *bars, const struct fbd_model *model, const struct run_options *options)
{
    *bars = (struct bars){.companion = companion_new(model, options)};
    bars->work = calloc(model->load_count + 1, sizeof *bars->work);
    bars->arrows = calloc(diagram_most_arrows(model), sizeof *bars->arrows);
    bars->state = state_new(model);
    bool made = bars->companion && bars->work && bars->arrows && bars->state &&
                ledger_init(&bars->ledger, model, ensemble_state(bars->companion->ensemble), true);
    if (!made) {
        bars_free(bars);
        return false;
    }
    bars->companion->ensemble->observer = (struct observer){bars, account, account_again};
    return true;
}

void bars_free(struct bars *bars)
{
    companion_free(bars->companion);
    if (bars->ledger.model) ledger_free(&bars->ledger);
    free(bars->work);
    free(bars->arrows);
    state_free(bars->state);
    *bars = (struct bars){0};
}

/* ---- during the run */

double bars_next(const struct bars *bars)
{
    return bars->companion->next;
}

/* The companion only goes forward: take all samples up to t on the path. */
static bool sample_until(struct bars *bars, struct ensemble *main, double t)
{
    struct companion *companion = bars->companion;
    while (companion->next <= t) {
        double sample = companion->next;
        if (!companion_go(companion, main, sample)) return false;
        companion_sample(companion, main, sample);
    }
    return true;
}

bool bars_look(struct bars *bars, struct ensemble *main, double t, bool after_event, bool works)
{
    struct companion *companion = bars->companion;
    if (!sample_until(bars, main, t) || !companion_go(companion, main, t)) return false;
    bars->known = companion_look(companion, main, t, after_event, bars->state);
    bool there = works && bars->known && bars->ledger.any;
    return !there || ledger_at(&bars->ledger, companion->ensemble, bars->work);
}

bool bars_looked(const struct bars *bars, double t)
{
    return bars->known && bars->state->t == t;
}

static bool at_event(const struct ensemble *run)
{
    return run->event_count > 0 && run->events[run->event_count - 1].t == run->t;
}

bool bars_step(struct bars *bars, struct ensemble *main)
{
    return sample_until(bars, main, main->t);
}

bool bars_catch_up(struct bars *bars, struct ensemble *main)
{
    if (!bars || !bars->behind) return true;
    bars->behind = false;
    return bars_step(bars, main) && (main->outcome == FBD_GOING || bars_finish(bars, main));
}

bool bars_finish(struct bars *bars, struct ensemble *main)
{
    struct companion *companion = bars->companion;
    if (!bars_look(bars, main, main->t, at_event(main), true)) return false;
    companion_sample(companion, main, main->t);
    if (!bars->known) companion_lose(companion, main->t);
    return companion_come_to_events(companion, main);
}

/* ---- errors */

/* Two runs make the same rounding errors where they evaluate the same formulas at nearly the same numbers,
 * hence the term 3 eps. */
double bars_difference(const struct bars *bars, double main, double other)
{
    return bars->known ? fabs(main - other) + round_off(3, fabs(main)) : HUGE_VAL;
}

double bars_component(const struct bars *bars, const struct fbd_state *main, size_t i)
{
    return bars->known ? companion_error(bars->companion, i, main->y[i], bars->state->y[i]) : HUGE_VAL;
}

const struct arrow *bars_diagram(struct bars *bars, int b)
{
    struct instant at = state_instant(bars->state);
    diagram_fill(bars->ledger.model, b, &at, bars->state->slots, bars->arrows);
    return bars->arrows;
}

double bars_work(struct bars *bars, size_t index, double work)
{
    return bars_difference(bars, work, ledger_work(&bars->ledger, bars->state, index, bars->work));
}

/* The residual of the true motion is 0, so its error is its absolute value. */
double bars_residual(const struct bars *bars, double residual)
{
    return bars->known ? fabs(residual) : HUGE_VAL;
}

fbd_energy bars_energy(struct bars *bars, const fbd_energy *energy)
{
    fbd_energy other = ledger_energy(&bars->ledger, bars->state, bars->work);
    return (fbd_energy){.kinetic = bars_difference(bars, energy->kinetic, other.kinetic),
                        .potential = bars_difference(bars, energy->potential, other.potential),
                        .work = bars_difference(bars, energy->work, other.work),
                        .residual = bars_residual(bars, energy->residual)};
}
