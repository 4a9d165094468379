/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The report of a run: equations at the start, events, final state, forces and their work, energy, cost.
 */
#include <stdlib.h>

#include "dynamics/diagram.h"
#include "output/equations.h"
#include "output/result.h"

enum { digits = 9, most_events = 40 };

static void value(struct text *text, const char *name, double number, const char *unit)
{
    text_printf(text, "%s = ", name);
    text_number(text, number, digits);
    text_printf(text, " %s", unit);
}

/* ---- events; switches of expressions are counted, not listed, when there are many */

static void write_event(struct text *text, const struct fbd_model *model, const struct run_event *event)
{
    char detail[event_detail_size];
    const char *body = event_body(model, event);
    event_detail(model, event, detail, sizeof detail);
    text_add(text, "  t = ");
    text_number(text, event->t, digits);
    text_add(text, " s");
    text_pad(text, 24);
    text_add(text, body[0] ? body : "-");
    text_pad(text, 38);
    text_add(text, fbd_event_kind_name(event->kind));
    text_pad(text, 52);
    text_printf(text, "%s\n", detail);
}

static void write_events(struct text *text, const struct ensemble *run)
{
    enum { most_switches = 8 };
    size_t count = run->event_count, shown = 0, switches = 0, hidden = 0;
    text_add(text, count ? "\nEvents\n" : "\nEvents: none\n");
    for (size_t i = 0; i < count; i++) switches += run->events[i].kind == FBD_EVENT_SWITCH;
    bool with_switches = switches <= most_switches;
    for (size_t i = 0; i < count; i++) {
        if (run->events[i].kind == FBD_EVENT_SWITCH && !with_switches) continue;
        if (shown < most_events || i + 1 == count) {
            write_event(text, run->model, &run->events[i]);
            shown++;
        } else {
            hidden++;
        }
    }
    if (hidden) text_printf(text, "  ... and %zu more (--json has all)\n", hidden);
    if (!with_switches)
        text_printf(text, "  and %zu switches of expressions from one branch to another\n", switches);
}

/* ---- final state and forces */

/* A body that sticks says how near it is to breaking away: |F| / (mu_s N). */
static void write_friction(struct text *text, struct fbd_state *state, const struct model_body *body)
{
    struct instant at = state_instant(state);
    force_balance(state->model, &at, state->scratch);
    struct friction_values values = friction_at(state->model, body->friction, &at, state->scratch);
    if (state->slip[body->friction] != stick)
        text_add(text, "   (slips)");
    else if (values.limit_static > 0)
        text_printf(text, "   (sticks, at %.3g %% of the limit)",
                    100 * fabs(values.force) / values.limit_static);
    else
        text_add(text, "   (sticks)");
}

static void write_final(struct text *text, const struct fbd_model *model, struct fbd_state *state)
{
    text_add(text, "\nFinal state at t = ");
    text_number(text, state->t, digits);
    text_add(text, " s\n");
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        text_printf(text, "  %s", body->name);
        for (int k = 0; k < 2 * body->count; k++) {
            int i = body->first + k % body->count;
            bool rate = k >= body->count;
            const struct coordinate *c = &model->scene->coordinates[i];
            const struct label *label = &model->labels[i];
            text_pad(text, 16 + 26 * (size_t)k);
            text_add(text, " ");
            value(text, rate ? c->rate_name : c->name, state->y[rate ? i + model->plan.n : i],
                  rate ? label->rate_unit : label->unit);
        }
        if (body->friction >= 0) write_friction(text, state, body);
        text_add(text, "\n");
    }
}

static void write_force(struct text *text, struct ledger *ledger, const struct fbd_state *state,
                        const struct arrow *arrow)
{
    const struct fbd_model *model = ledger->model;
    text_printf(text, "    %s", arrow->name);
    text_pad(text, 20);
    bool couple_only = arrow->couple != 0 && arrow->force.x == 0 && arrow->force.y == 0;
    if (!couple_only) {
        text_add(text, " (");
        text_number(text, arrow->force.x, 6);
        text_add(text, ", ");
        text_number(text, arrow->force.y, 6);
        text_printf(text, ") %s", force_unit(model));
    }
    if (arrow->couple != 0) {
        text_pad(text, couple_only ? 21 : 48);
        text_number(text, arrow->couple, 6);
        text_printf(text, " %s", moment_unit(model));
    }
    if (arrow->load < 0) {
        text_add(text, "\n");
        return;
    }
    double work = ledger_work(ledger, state, (size_t)arrow->load, ledger->work);
    text_pad(text, 60);
    text_add(text, "work ");
    if (isnan(work)) {
        text_add(text, "not integrated\n");
        return;
    }
    text_number(text, work, digits);
    text_printf(text, " %s\n", energy_unit(model));
}

static void write_forces(struct text *text, fbd_result *result, struct fbd_state *state)
{
    struct ledger *ledger = &result->ledger;
    const struct fbd_model *model = ledger->model;
    struct instant at = state_instant(state);
    text_add(text, "\nForces at the end, in the world's x and y, and their work since the start\n");
    for (size_t b = 0; b < model->body_count; b++) {
        text_printf(text, "  %s\n", model->bodies[b].name);
        size_t count = diagram_fill(model, (int)b, &at, state->a, state->slots, ledger->arrows);
        for (size_t i = 0; i < count; i++) write_force(text, ledger, state, &ledger->arrows[i]);
    }
}

/* ---- energy and cost */

static void energy_row(struct text *text, const char *name, double start, double end, const char *unit)
{
    text_printf(text, "  %s", name);
    text_pad(text, 22);
    text_number(text, start, digits);
    text_pad(text, 40);
    text_number(text, end, digits);
    text_pad(text, 58);
    text_printf(text, "%s\n", unit);
}

static void write_energy(struct text *text, fbd_result *result)
{
    fbd_energy energy = fbd_result_energy(result);
    const char *unit = energy_unit(result->ledger.model);
    text_add(text, "\nEnergy                start             end\n");
    energy_row(text, "kinetic", energy.initial_kinetic, energy.kinetic, unit);
    energy_row(text, "potential", energy.initial_potential, energy.potential, unit);
    if (isnan(energy.work)) return; /* only the motion was wanted */
    energy_row(text, "work of the others", 0, energy.work, unit);
    text_printf(text,
                "  residual %.2e %s: change of kinetic + potential, less that work (0 for the true motion)\n",
                energy.residual, unit);
}

/* "3 independent groups; constant accelerations in 1, ..."; nothing for one group without structure. */
static void write_structure(struct text *text, const fbd_stats *stats)
{
    const struct {
        size_t count;
        const char *words;
    } kinds[] = {{stats->constant, "exact parabolas"},
                 {stats->linear, "exact propagation of linear equations"},
                 {stats->velocity_free, "Nystrom method for forces free of velocity"}};
    const char *before = "\n  ";
    if (stats->groups > 1) {
        text_printf(text, "\n  %zu independent groups of bodies", stats->groups);
        before = "; ";
    }
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (kinds[i].count == 0) continue;
        text_printf(text, "%s%s", before, kinds[i].words);
        if (stats->groups > 1) text_printf(text, " in %zu", kinds[i].count);
        before = "; ";
    }
}

static void write_cost(struct text *text, const fbd_simulation *simulation)
{
    fbd_stats stats = fbd_simulation_stats(simulation);
    text_printf(text, "\nAccuracy and cost: %s at tolerance %g", stats.method, stats.tolerance);
    write_structure(text, &stats);
    text_printf(text, "\n  %lu steps (%lu rejected), %lu right-hand sides", stats.steps, stats.rejected,
                stats.rhs);
    if (stats.jacobians) text_printf(text, ", %lu Jacobians", stats.jacobians);
    if (stats.stiff_steps) text_printf(text, ", %lu steps by rodas5p (stiff)", stats.stiff_steps);
    text_printf(text, ", %lu event samples, %.3f ms\n", stats.event_samples, 1e3 * stats.seconds);
}

char *fbd_result_report(fbd_result *result)
{
    fbd_simulation *simulation = result->simulation;
    struct ensemble *run = simulation->ensemble;
    struct fbd_state *end = ensemble_state(run);
    const struct fbd_model *model = run->model;
    struct text text = {0};
    if (model->scene->title[0]) text_printf(&text, "%s\n\n", model->scene->title);
    equations_write(&text, result->start);
    state_ready(end);
    write_events(&text, run);
    if (run->reason[0]) text_printf(&text, "\nThe run ended early: %s.\n", run->reason);
    write_final(&text, model, end);
    write_forces(&text, result, end);
    write_energy(&text, result);
    write_cost(&text, simulation);
    if (text.failed) text_free(&text);
    return text.data;
}
