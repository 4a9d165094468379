/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The report of a run: equations at the start, events, final state, forces and their work, energy, cost.
 */
#include <stdlib.h>
#include <string.h>

#include "dynamics/diagram.h"
#include "dynamics/mass.h"
#include "fbd_export.h"
#include "fbd_study.h"
#include "output/couplings.h"
#include "output/display_units.h"
#include "output/equations_write.h"
#include "output/report.h"
#include "output/words.h"

enum { digits = report_digits, most_events = 40 };

static size_t column(const struct page *page, size_t plain, size_t with_bars)
{
    return page->bars ? with_bars : plain;
}

/* ` ± 3.1e-11`, or a question mark for an unknown error. */
static void plus_minus(const struct page *page, double error)
{
    if (!page->bars) return;
    if (isfinite(error))
        text_printf(page->text, " ± %.1e", error);
    else
        text_add(page->text, " ± ?");
}

/* Write a coordinate, rate or user state as `name = value unit`; `error` may be NULL. */
static void write_value(const struct page *page, const struct fbd_model *model, size_t component,
                        const char *name, double value, const double *error)
{
    const struct display display = display_of_component(model, component, page->result->degrees);
    text_printf(page->text, "%s = ", name);
    text_number(page->text, value / display.size, digits);
    if (error) plus_minus(page, *error / display.size);
    text_printf(page->text, "%s%s", unit_word(display.unit)[0] ? " " : "", unit_word(display.unit));
}

/* ---- events; switches of expressions are counted, not listed, when there are many */

/* Mark the bodies whose motion is in a condition. */
static void mark_named(const struct fbd_model *model, const struct formula *formula, bool *named)
{
    const int *slots, size = (int)plan_size(&model->plan), n = model->plan.n;
    size_t count = formula->expr ? expr_variables(formula->expr, &slots) : 0;
    for (size_t i = 0; i < count; i++) {
        int k = slots[i] - 1, absolute = k - size - hand_slots;
        if (k < 2 * n) named[model->scene->coordinates[k % n].body] = true;
        if (absolute >= 0) named[model->absolutes[absolute].body] = true;
    }
}

/* Write the positions of the bodies in the condition of a user event. */
static void write_event_state(const struct page *page, const struct run_event *event)
{
    const struct fbd_model *model = page->result->simulation->ensemble->model;
    const double *y = event_states_find(&page->result->event_states, event);
    bool *named = y ? calloc(model->body_count, sizeof *named) : NULL;
    if (y && !named) page->text->failed = true;
    if (!named) return;
    mark_named(model, &model->plan.watches[event->watch].left, named);
    mark_named(model, &model->plan.watches[event->watch].right, named);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        if (!named[b]) continue;
        text_printf(page->text, "      %s", body->name);
        for (int k = 0; k < 2 * body->count; k++) {
            const int i = body->first + k % body->count;
            const bool rate = k >= body->count;
            const struct coordinate *c = &model->scene->coordinates[i];
            size_t component = (size_t)(rate ? i + model->plan.n : i);
            text_add(page->text, k ? ", " : ": ");
            write_value(page, model, component, rate ? c->rate_name : c->name, y[component], NULL);
        }
        text_add(page->text, "\n");
    }
    free(named);
}

void report_event(const struct page *page, size_t index)
{
    struct text *text = page->text;
    const fbd_simulation *simulation = page->result->simulation;
    const struct fbd_model *model = simulation->ensemble->model;
    const struct run_event *event = &simulation->ensemble->events[index];
    char detail[event_detail_size];
    const char *body = event_body(model, event);
    event_detail(model, event, detail, sizeof detail);
    text_add(text, "  t = ");
    text_number(text, event->t, digits);
    if (page->bars) plus_minus(page, simulation->event_errors[index]);
    text_add(text, " s");
    size_t from = column(page, 24, 34);
    text_pad(text, from);
    text_add(text, body[0] ? body : "-");
    text_pad(text, from + 14);
    text_add(text, fbd_event_kind_name(event->kind));
    text_pad(text, from + 28);
    text_printf(text, "%s\n", detail);
    if (event->kind == FBD_EVENT_USER) write_event_state(page, event);
}

static void write_events(const struct page *page)
{
    struct text *text = page->text;
    const struct ensemble *run = page->result->simulation->ensemble;
    enum { most_switches = 8 };
    size_t count = run->event_count, display = 0, switches = 0, hidden = 0;
    text_add(text, count ? "\nEvents\n" : "\nEvents: none\n");
    for (size_t i = 0; i < count; i++) switches += run->events[i].kind == FBD_EVENT_SWITCH;
    bool with_switches = switches <= most_switches;
    for (size_t i = 0; i < count; i++) {
        if (run->events[i].kind == FBD_EVENT_SWITCH && !with_switches) continue;
        if (display < most_events || i + 1 == count) {
            report_event(page, i);
            display++;
        } else {
            hidden++;
        }
    }
    if (hidden) text_printf(text, "  ... and %zu more (--json has all)\n", hidden);
    if (!with_switches)
        text_printf(text, "  and %zu switches of expressions from one branch to another\n", switches);
}

/* ---- final state and forces */

/* Write how near a sticking body is to breaking away: |F| / (mu_s N). */
static void write_friction(struct text *text, struct fbd_state *state, int b)
{
    const struct model_body *body = &state->model->bodies[b];
    struct instant at = state_instant(state);
    state_balance_of(state, b, state->scratch);
    struct friction_values values = friction_at(state->model, body->friction, &at, state->scratch);
    double percent = 100 * fabs(values.force) / values.limit;
    if (state->slip[body->friction] != stick)
        text_add(text, "   (slips)");
    else if (isfinite(percent))
        text_printf(text, "   (sticks, at %.3g %% of the limit)", percent);
    else
        text_add(text, "   (sticks)");
}

/* For a body of varying mass, after its coordinates. */
static void write_mass(const struct page *page, const struct model_body *body, const struct fbd_state *state)
{
    const struct instant at = state_instant(state);
    text_pad(page->text, 16 + column(page, 26, 38) * 2 * (size_t)body->count);
    text_add(page->text, " m = ");
    text_number(page->text, body_mass(body, &at), digits);
    text_printf(page->text, " %s", state->model->scene->units == unit_si ? "kg" : "slug");
}

/* An entry of y, with its error bar. */
static void write_component(const struct page *page, const struct fbd_state *state, size_t component,
                            const char *name)
{
    double error = page->bars ? bars_component(page->bars, state, component) : 0;
    write_value(page, state->model, component, name, state->y[component], &error);
}

void report_body_state(const struct page *page, struct fbd_state *state, size_t b)
{
    struct text *text = page->text;
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    text_printf(text, "  %s", body->name);
    for (int k = 0; k < 2 * body->count; k++) {
        const int i = body->first + k % body->count;
        const bool rate = k >= body->count;
        const struct coordinate *c = &model->scene->coordinates[i];
        text_pad(text, 16 + column(page, 26, 38) * (size_t)k);
        text_add(text, " ");
        write_component(page, state, (size_t)(rate ? i + model->plan.n : i), rate ? c->rate_name : c->name);
    }
    if (body->varies) write_mass(page, body, state);
    if (body->friction >= 0) write_friction(text, state, (int)b);
    text_add(text, "\n");
}

void report_own_states(const struct page *page, const struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    for (size_t i = 0; i < (size_t)plan->own; i++) {
        text_printf(page->text, "  %s", state->model->own_labels[i].name);
        text_pad(page->text, 16);
        write_component(page, state, plan_own_place(plan) + i, "");
        text_add(page->text, "\n");
    }
}

static void write_final(const struct page *page)
{
    struct fbd_state *state = fbd_result_state(page->result);
    text_add(page->text, "\nFinal state at t = ");
    text_number(page->text, state->t, digits);
    text_add(page->text, " s\n");
    for (size_t b = 0; b < state->model->body_count; b++) report_body_state(page, state, b);
    report_own_states(page, state);
}

/* A number and its error, `other` being the companion's. */
static void force(const struct page *page, double main, double other)
{
    text_number(page->text, main, 6);
    if (page->bars) plus_minus(page, bars_difference(page->bars, main, other));
}

static void write_work(const struct page *page, const struct fbd_state *state, size_t load)
{
    struct text *text = page->text;
    struct ledger *ledger = &page->result->ledger;
    double work = ledger_work(ledger, state, load, ledger->work);
    text_pad(text, column(page, 60, 92) - 1);
    text_add(text, " work ");
    if (isnan(work)) {
        text_add(text, "not integrated\n");
        return;
    }
    text_number(text, work, digits);
    if (page->bars) plus_minus(page, bars_work(page->bars, load, work));
    text_printf(text, " %s\n", energy_unit(ledger->model));
}

/* `other`: the same arrow of the companion, or `arrow`; `account`: the load whose work is written, or -1. */
static void write_force(const struct page *page, const struct fbd_state *state, const struct arrow *arrow,
                        const struct arrow *other, int account)
{
    struct text *text = page->text;
    struct ledger *ledger = &page->result->ledger;
    const struct fbd_model *model = ledger->model;
    text_printf(text, "    %s", arrow->name);
    text_pad(text, 20);
    bool couple_only = arrow->couple != 0 && arrow->force.x == 0 && arrow->force.y == 0;
    if (!couple_only) {
        text_add(text, " (");
        force(page, arrow->force.x, other->force.x);
        text_add(text, ", ");
        force(page, arrow->force.y, other->force.y);
        text_printf(text, ") %s", force_unit(model));
    }
    if (arrow->couple != 0) {
        text_pad(text, couple_only ? 20 : column(page, 48, 68) - 1);
        text_add(text, " ");
        force(page, arrow->couple, other->couple);
        text_printf(text, " %s", moment_unit(model));
    }
    if (account < 0) {
        text_add(text, "\n");
        return;
    }
    write_work(page, state, (size_t)account);
}

/* Not a force: the energy carried by varying mass. */
static void write_carried(const struct page *page, const struct fbd_state *state,
                          const struct model_body *body)
{
    text_printf(page->text, "    %s", state->model->loads[body->carried].source->name);
    text_add(page->text, " that comes or goes, at the speed of the body");
    write_work(page, state, (size_t)body->carried);
}

static void write_forces(const struct page *page)
{
    struct text *text = page->text;
    struct ledger *ledger = &page->result->ledger;
    const struct fbd_state *state = fbd_result_state(page->result);
    const struct fbd_model *model = ledger->model;
    struct instant at = state_instant(state);
    text_add(text, "\nForces at the end, in the world's x and y, and their work since the start\n");
    for (size_t b = 0; b < model->body_count; b++) {
        text_printf(text, "  %s\n", model->bodies[b].name);
        size_t count = diagram_fill(model, (int)b, &at, state->slots, ledger->arrows);
        const struct arrow *others = page->bars ? bars_diagram(page->bars, (int)b) : ledger->arrows;
        for (size_t i = 0; i < count; i++)
            write_force(page, state, &ledger->arrows[i], &others[i],
                        diagram_account(model, (int)b, ledger->arrows, i));
        if (model->bodies[b].carried >= 0) write_carried(page, state, &model->bodies[b]);
    }
}

/* ---- energy and cost */

static void energy_row(const struct page *page, const char *name, double start, double end, double error)
{
    struct text *text = page->text;
    text_printf(text, "  %s", name);
    text_pad(text, 22);
    text_number(text, start, digits);
    text_pad(text, 40);
    text_number(text, end, digits);
    plus_minus(page, error);
    text_pad(text, column(page, 58, 70));
    text_printf(text, "%s\n", energy_unit(page->result->ledger.model));
}

/* List the contributions to the potential energy. */
static void write_potentials(const struct page *page)
{
    const struct fbd_model *model = page->result->ledger.model;
    const char *before = "  potential is that of ";
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        const char *effect = load_law(load->source)->effect;
        size_t earlier = 0;
        if (load->potential_kind == potential_none || load->potential_kind == potential_workless) continue;
        while (earlier < i && (model->loads[earlier].potential_kind == potential_none ||
                               strcmp(load_law(model->loads[earlier].source)->effect, effect) != 0))
            earlier++;
        if (earlier < i) continue;
        text_printf(page->text, "%s%s", before, effect);
        before = ", ";
    }
    if (before[0] == ',') text_add(page->text, "\n");
}

void report_energy(const struct page *page)
{
    fbd_energy energy = fbd_result_energy(page->result), error = fbd_result_energy_error(page->result);
    text_add(page->text, "\nEnergy                start             end\n");
    energy_row(page, "kinetic", energy.initial_kinetic, energy.kinetic, error.kinetic);
    energy_row(page, "potential", energy.initial_potential, energy.potential, error.potential);
    if (isnan(energy.work)) return; /* only the motion was computed */
    energy_row(page, "work of the others", 0, energy.work, error.work);
    text_printf(page->text,
                "  residual %.2e %s: change of kinetic + potential, less that work (0 for the true motion)\n",
                energy.residual, energy_unit(page->result->ledger.model));
    write_potentials(page);
    double explained = fbd_result_residual_explained(page->result);
    if (fabs(energy.residual) > explained)
        text_printf(page->text,
                    "  the tolerance explains %.2e %s of it: the steps have missed a short event or pulse\n",
                    explained, energy_unit(page->result->ledger.model));
}

/* "3 independent groups; constant accelerations in 1, ..."; empty for one group without structure. */
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

/* Write the error bars of the whole run, their cost, and the requested accuracy. */
static void write_accuracy(const struct page *page, const fbd_stats *stats)
{
    const double all = 0.1;
    struct text *text = page->text;
    if (!page->bars) return;
    if (isfinite(stats->error_estimate))
        text_printf(text, "  global error about %.1e of the size of the motion", stats->error_estimate);
    else
        text_add(text, "  global error not known: the companion could not follow");
    text_printf(text, "; the estimate took %lu steps, %lu right-hand sides\n", stats->companion_steps,
                stats->companion_rhs);
    if (stats->error_estimate > all && isfinite(stats->error_estimate))
        text_add(text,
                 "  two runs of different accuracy part: a chaotic motion, a run that is too long, or a "
                 "tolerance that is too large\n");
    if (stats->accuracy == 0) return;
    fbd_outcome outcome = fbd_result_outcome(page->result);
    bool cut = outcome == FBD_FAILED || outcome == FBD_INTERRUPTED,
         reached = fbd_result_accurate(page->result);
    text_printf(text, "  requested accuracy %g: %s, with %lu run%s in %.3f ms in total\n", stats->accuracy,
                reached                         ? "reached"
                : cut                           ? "NOT known, the run did not come to its end"
                : page->result->simulation->cut ? "NOT reached when it was interrupted, this is the best"
                                                : "NOT reached, this is the best",
                stats->runs, stats->runs == 1 ? "" : "s", 1e3 * stats->seconds_spent);
}

void report_parameters(const struct page *page, size_t most)
{
    const struct scene *scene = page->result->ledger.model->scene;
    struct text *text = page->text;
    if (scene->parameter_count > 0) text_add(text, "\nParameters\n");
    for (size_t i = 0; i < scene->parameter_count && i < most; i++) {
        const struct parameter *parameter = &scene->parameters[i];
        text_printf(text, "  %s", parameter->name);
        text_pad(text, 16);
        text_add(text, " = ");
        if (parameter->call.function) {
            text_add(text, "u(t, y), an input by a callback of the program\n");
            continue;
        }
        text_number(text, parameter->value, digits);
        text_printf(text, "%s%s%s\n", unit_word(parameter->unit)[0] ? " " : "", unit_word(parameter->unit),
                    parameter->input ? ", an input" : "");
    }
    if (scene->parameter_count > most) text_printf(text, "  and %zu more\n", scene->parameter_count - most);
    if (scene_has_calls(scene))
        text_add(text, "  Inputs by callbacks come from outside the file: they are taken to be smooth "
                       "between events and the "
                       "same function in\n  each call; the second run for error bars calls them, too, so "
                       "their own errors are "
                       "in no error bar.\n");
}

void report_cost(const struct page *page)
{
    struct text *text = page->text;
    fbd_stats stats = fbd_simulation_stats(page->result->simulation);
    text_printf(text, "\nAccuracy and cost: %s at tolerance %g", stats.method, stats.tolerance);
    write_structure(text, &stats);
    text_printf(text, "\n  %lu steps (%lu rejected), %lu right-hand sides", stats.steps, stats.rejected,
                stats.rhs);
    if (stats.jacobians) text_printf(text, ", %lu Jacobians", stats.jacobians);
    if (stats.stiff_steps) text_printf(text, ", %lu steps by rodas5p (stiff)", stats.stiff_steps);
    text_printf(text, ", %lu event samples, %.3f ms\n", stats.event_samples, 1e3 * stats.seconds);
    write_accuracy(page, &stats);
}

/* Write the positions found by `assemble: true`. */
static void write_assembled(const struct page *page, const struct fbd_model *model,
                            const struct fbd_state *start)
{
    struct text *text = page->text;
    if (!model->assembles) return;
    text_add(text, "Assembled at the start\n");
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        for (int k = 0; body->source->assemble && k < 2 * body->count; k++) {
            int i = body->first + k % body->count;
            bool rate = k >= body->count;
            const struct coordinate *c = &model->scene->coordinates[i];
            size_t component = (size_t)(rate ? i + model->plan.n : i);
            const struct display display = display_of_component(model, component, page->result->degrees);
            text_printf(text, "  %s = ", display.name);
            text_number(text, start->y[component] / display.size, digits);
            text_printf(text, " %s, looked for near ", display.unit);
            text_number(text, (rate ? c->initial_rate : c->initial) / display.size, digits);
            text_add(text, "\n");
        }
    }
    text_add(text, "\n");
}

/* Write the full report. */
static void write_full(const struct page *page)
{
    enum { most_parameters = 40 };
    fbd_result *result = page->result;
    const struct ensemble *run = result->simulation->ensemble;
    write_assembled(page, run->model, result->start);
    equations_put(page->text, result->start, FBD_TEXT, false);
    state_ready(fbd_result_state(result));
    write_events(page);
    report_early_end(page);
    write_final(page);
    write_forces(page);
    report_energy(page);
    couplings_report(page->text, result);
    report_parameters(page, most_parameters);
    report_cost(page);
}

void report_early_end(const struct page *page)
{
    const char *reason = page->result->simulation->ensemble->reason;
    if (reason[0]) text_printf(page->text, "\nThe run ended early: %s.\n", reason);
}

char *fbd_result_report(fbd_result *result, bool full)
{
    if (!result) return NULL;
    const struct ensemble *run = result->simulation->ensemble;
    struct text text = {0};
    const struct page page = {&text, result, result->simulation->bars};
    text_heading(&text, run->model->scene->title);
    if (run->refused) /* no motion was computed, and its equations may have no numbers */
        text_printf(&text, "The run did not start: %s.\n", run->reason);
    else if (full || run->model->body_count <= report_few_bodies)
        write_full(&page);
    else
        report_short(&page);
    if (text.failed) text_free(&text);
    return text.data;
}
