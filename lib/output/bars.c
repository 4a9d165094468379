/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/bars.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

bool bars_init(struct bars *bars, const struct fbd_model *model, const struct run_options *options)
{
    size_t loads = model->load_count;
    *bars = (struct bars){.companion = companion_new(model, options)};
    bars->before = calloc(2 * loads + 1, sizeof *bars->before);
    bars->arrows = calloc(diagram_most_arrows(model), sizeof *bars->arrows);
    bars->state = state_new(model);
    bool made = bars->companion && bars->before && bars->arrows && bars->state &&
                ledger_init(&bars->ledger, model, bars->companion->run->state, true);
    if (!made) {
        bars_free(bars);
        return false;
    }
    bars->work = bars->before + loads;
    return true;
}

void bars_free(struct bars *bars)
{
    companion_free(bars->companion);
    if (bars->ledger.model) ledger_free(&bars->ledger);
    free(bars->before);
    free(bars->arrows);
    state_free(bars->state);
    *bars = (struct bars){0};
}

/* ---- going along */

static bool advance(struct bars *bars)
{
    struct run *own = bars->companion->run;
    memcpy(bars->before, bars->ledger.work, bars->ledger.model->load_count * sizeof *bars->before);
    run_advance(own);
    if (own->outcome == FBD_OUT_OF_MEMORY) return false;
    return own->outcome == FBD_FAILED || ledger_step(&bars->ledger, own);
}

/* The companion goes forward only: what is to be sampled up to t is sampled on the way. */
static bool advance_to(struct bars *bars, struct run *main, double t)
{
    struct companion *companion = bars->companion;
    for (;;) {
        double sample = companion_next(companion, main, fmax(bars->sampled, main->from));
        double next = fmin(sample, t);
        while (companion_behind(companion, next))
            if (!advance(bars)) return false;
        if (!(sample <= t)) return true;
        companion_sample(companion, main, sample);
        bars->sampled = sample;
    }
}

bool bars_look(struct bars *bars, struct run *main, double t, bool after_event, bool works)
{
    struct run *own = bars->companion->run;
    if (!advance_to(bars, main, t)) return false;
    bars->known = companion_look(bars->companion, main, t, after_event, bars->state);
    if (!works || !bars->known || !bars->ledger.any) return true;
    size_t loads = bars->ledger.model->load_count;
    bool within = t < own->state->t;
    memcpy(bars->work, within ? bars->before : bars->ledger.work, loads * sizeof *bars->work);
    return !within || ledger_integrate(&bars->ledger, own, own->from, t, bars->work);
}

bool bars_looked(const struct bars *bars, double t)
{
    return bars->known && bars->state->t == t;
}

static bool at_event(const struct run *run)
{
    return run->event_count > 0 && run->events[run->event_count - 1].t == run->state->t;
}

bool bars_step(struct bars *bars, struct run *main)
{
    companion_note(bars->companion, main);
    double end = main->state->t;
    bool due = companion_next(bars->companion, main, fmax(bars->sampled, main->from)) <= end;
    return !due || advance_to(bars, main, end);
}

bool bars_catch_up(struct bars *bars, struct run *main)
{
    if (!bars || !bars->behind) return true;
    bars->behind = false;
    return bars_step(bars, main) && (main->outcome == FBD_GOING || bars_finish(bars, main));
}

bool bars_finish(struct bars *bars, struct run *main)
{
    const double most = 1.1; /* later than this its event is another one */
    struct run *own = bars->companion->run;
    if (!bars_look(bars, main, main->state->t, at_event(main), true)) return false;
    if (!bars->known) companion_lose(bars->companion, main->state->t);
    double limit = most * main->state->t;
    while (own->outcome == FBD_GOING && own->event_count < main->event_count && own->state->t < limit)
        if (!advance(bars)) return false;
    return true;
}

/* ---- what the errors are */

/* Two runs round alike what they compute by the same formulas from nearly the same numbers. */
double bars_difference(const struct bars *bars, double main, double other)
{
    return bars->known ? fabs(main - other) + 3 * DBL_EPSILON * fabs(main) : HUGE_VAL;
}

double bars_component(const struct bars *bars, const struct fbd_state *main, size_t i)
{
    return bars->known ? companion_error(bars->companion, i, main->y[i], bars->state->y[i]) : HUGE_VAL;
}

const struct arrow *bars_diagram(struct bars *bars, int b)
{
    struct instant at = state_instant(bars->state);
    diagram_fill(bars->ledger.model, b, &at, bars->state->a, bars->state->slots, bars->arrows);
    return bars->arrows;
}

double bars_work(struct bars *bars, size_t index, double work)
{
    return bars_difference(bars, work, ledger_work(&bars->ledger, bars->state, index, bars->work));
}

fbd_energy bars_energy(struct bars *bars, const fbd_energy *energy)
{
    fbd_energy other = ledger_energy(&bars->ledger, bars->state, bars->work);
    /* The residual of the true motion is 0, so its error is what it is. */
    return (fbd_energy){.kinetic = bars_difference(bars, energy->kinetic, other.kinetic),
                        .potential = bars_difference(bars, energy->potential, other.potential),
                        .work = bars_difference(bars, energy->work, other.work),
                        .residual = bars->known ? fabs(energy->residual) : HUGE_VAL};
}
