/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/csv.h"

#include <stdlib.h>
#include <string.h>

#include "output/display_units.h"
#include "output/force_columns.h"
#include "output/words.h"
#include "output/world.h"
#include "record/finite_result.h"

enum { default_rows = 500 };

/* ---- columns */

static void head(struct csv *csv, const char *name, const char *unit)
{
    text_printf(&csv->line, "%s%s [%s]", csv->line.length > 0 ? "," : "", name, unit);
    if (csv->numbers) numbers_head(csv->numbers, name, unit);
}

/* One column and, with error bars, that of its error: `a.b.part [unit],a.b.part ± [unit]`. `b` and `part` may
 * be empty. */
static void header(struct csv *csv, const char *a, const char *b, const char *part, const char *unit)
{
    for (int error = 0; error <= (csv->bars ? 1 : 0); error++) {
        struct text name = {0};
        text_printf(&name, "%s%s%s%s%s%s", a, b[0] ? "." : "", b, part[0] ? "." : "", part,
                    error ? " ±" : "");
        csv->line.failed |= name.failed;
        if (!name.failed) head(csv, name.data, unit);
        text_free(&name);
    }
}

static void diagram_headers(struct csv *csv, int b, const struct fbd_state *start)
{
    const struct fbd_model *model = csv->model;
    const struct model_body *body = &model->bodies[b];
    struct instant at = state_instant(start);
    size_t count = diagram_fill(model, b, &at, start->a, start->slots, csv->arrows);
    for (size_t i = 0; i < count; i++) {
        enum force_part parts[force_parts];
        const char *name = csv->arrows[i].name;
        size_t columns = force_columns(model, b, &csv->arrows[i], csv->recording->components, parts);
        for (size_t k = 0; k < columns; k++)
            header(csv, body->name, name, force_part_name(parts[k]), force_part_unit(model, b, parts[k]));
        if (diagram_work_column(model, b, csv->arrows, i) >= 0)
            header(csv, body->name, name, "work", energy_unit(model));
    }
    if (body->carried >= 0) header(csv, body->name, "mass", "work", energy_unit(model));
}

static void ledger_headers(struct csv *csv, const struct fbd_state *start)
{
    static const char *const energies[] = {"kinetic", "potential", "work", "residual"};
    for (size_t b = 0; b < csv->model->body_count; b++) diagram_headers(csv, (int)b, start);
    for (int k = 0; k < 4; k++) header(csv, "energy", energies[k], "", energy_unit(csv->model));
}

static void component_header(struct csv *csv, int i)
{
    const struct display display = display_of_component(csv->model, (size_t)i, csv->recording->degrees);
    header(csv, display.name, "", "", display.unit);
}

static void headers(struct csv *csv, const struct fbd_state *start)
{
    const struct fbd_model *model = csv->model;
    head(csv, "t", "s");
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        for (int k = 0; k < body->count; k++) component_header(csv, body->first + k);
        for (int k = 0; k < body->count; k++) component_header(csv, body->first_rate + k);
    }
    for (int i = 0; i < model->plan.own; i++) component_header(csv, 2 * model->plan.n + i);
    for (size_t i = 0; i < model->scene->output_point_count; i++)
        for (int part = 0; part < world_parts; part++)
            header(csv, model->scene->output_points[i].name, world_part_name((enum world_part)part), "",
                   world_part_unit(model, (enum world_part)part));
    if (csv->ledger) ledger_headers(csv, start);
}

/* ---- rows */

/* Write the next field of the row; empty if the number is not finite. */
static void field(struct csv *csv, double value)
{
    if (csv->numbers) numbers_add(csv->numbers, value);
    if (!csv->recording->csv) return;
    if (csv->line.length > 0) text_add(&csv->line, ",");
    if (isfinite(value)) text_exact(&csv->line, value);
}

static void number(struct csv *csv, double value)
{
    csv->odd |= !isfinite(value);
    field(csv, value);
}

/* Write an error, which may be unknown. */
static void error(struct csv *csv, double value)
{
    if (csv->bars) field(csv, value);
}

/* Write a quantity of the run and its difference from the companion. */
static void value(struct csv *csv, double main, double other)
{
    number(csv, main);
    if (csv->bars) error(csv, bars_difference(csv->bars, main, other));
}

static void work_value(struct csv *csv, size_t load, const struct fbd_state *state)
{
    double work = ledger_work(csv->ledger, state, load, csv->work);
    number(csv, work);
    if (csv->bars) error(csv, bars_work(csv->bars, load, work));
}

static void diagram_values(struct csv *csv, int b, const struct fbd_state *state)
{
    const struct fbd_model *model = csv->model;
    const struct model_body *body = &model->bodies[b];
    struct instant at = state_instant(state);
    struct instant other_at = csv->bars ? state_instant(csv->bars->state) : at;
    size_t count = diagram_fill(model, b, &at, state->a, state->slots, csv->arrows);
    const struct arrow *others = csv->bars ? bars_diagram(csv->bars, b) : csv->arrows;
    for (size_t i = 0; i < count; i++) {
        enum force_part parts[force_parts];
        size_t columns = force_columns(model, b, &csv->arrows[i], csv->recording->components, parts);
        for (size_t k = 0; k < columns; k++)
            value(csv, force_part_value(model, b, &at, &csv->arrows[i], parts[k]),
                  force_part_value(model, b, &other_at, &others[i], parts[k]));
        int load = diagram_work_column(model, b, csv->arrows, i);
        if (load >= 0) work_value(csv, (size_t)load, state);
    }
    if (body->carried >= 0) work_value(csv, (size_t)body->carried, state);
}

static void ledger_values(struct csv *csv, const struct fbd_state *state)
{
    for (size_t b = 0; b < csv->model->body_count; b++) diagram_values(csv, (int)b, state);
    fbd_energy energy = ledger_energy(csv->ledger, state, csv->work), errors = energy;
    if (csv->bars) errors = bars_energy(csv->bars, &energy);
    number(csv, energy.kinetic);
    error(csv, errors.kinetic);
    number(csv, energy.potential);
    error(csv, errors.potential);
    number(csv, energy.work);
    error(csv, errors.work);
    number(csv, energy.residual);
    error(csv, errors.residual);
}

static bool put_line(struct csv *csv)
{
    const fbd_recording *recording = csv->recording;
    if (recording->csv) text_add(&csv->line, "\n");
    csv->failed |= csv->line.failed;
    if (recording->csv && !csv->failed)
        csv->failed = recording->csv(recording->csv_context, csv->line.data, csv->line.length) != 0;
    csv->line.length = 0;
    return !csv->failed;
}

static bool put_row(struct csv *csv)
{
    return (!csv->numbers || numbers_end_row(csv->numbers)) && put_line(csv);
}

static void component(struct csv *csv, const struct fbd_state *state, int i)
{
    const double size = display_of_component(csv->model, (size_t)i, csv->recording->degrees).size;
    number(csv, state->y[i] / size);
    if (csv->bars) error(csv, bars_component(csv->bars, state, (size_t)i) / size);
}

/* A row with a number that is not finite is not written and ends the run. */
static bool refuse_line(struct csv *csv, struct ensemble *ensemble)
{
    csv->line.length = 0;
    csv->odd = false;
    if (csv->numbers) numbers_drop_row(csv->numbers);
    if (result_finite(ensemble, csv->ledger, csv->work))
        ensemble_spoil(ensemble, "a number of the row at t = %.9g is not finite", ensemble->t);
    return ensemble->outcome == FBD_FAILED || ensemble->outcome == FBD_BROKEN;
}

static void point_values(struct csv *csv, const struct fbd_state *state, size_t i)
{
    const struct fbd_model *model = csv->model;
    int body = model->scene->output_points[i].body;
    double values[world_parts], others[world_parts];
    world_values(state, body, model->output_points[i], values);
    world_values(csv->bars ? csv->bars->state : state, body, model->output_points[i], others);
    for (int part = 0; part < world_parts; part++) value(csv, values[part], others[part]);
}

static bool row(struct csv *csv, struct ensemble *ensemble)
{
    const struct fbd_model *model = csv->model;
    const struct fbd_state *state = ensemble_state(ensemble);
    csv->last = state->t;
    field(csv, state->t);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        for (int k = 0; k < body->count; k++) component(csv, state, body->first + k);
        for (int k = 0; k < body->count; k++) component(csv, state, body->first_rate + k);
    }
    for (int i = 0; i < model->plan.own; i++) component(csv, state, 2 * model->plan.n + i);
    for (size_t i = 0; i < model->scene->output_point_count; i++) point_values(csv, state, i);
    if (csv->ledger) ledger_values(csv, state);
    return csv->odd ? refuse_line(csv, ensemble) : put_row(csv);
}

/* ---- the file */

bool csv_begin(struct csv *csv, fbd_result *result, const fbd_recording *recording)
{
    struct ensemble *run = result->simulation->ensemble;
    struct bars *bars = result->simulation->bars;
    const struct fbd_model *model = run->model;
    double start = run->t, until = run->options.until;
    double every = recording->every > 0 ? recording->every : model->scene->simulate.every;
    *csv = (struct csv){.model = model,
                        .ledger = recording->ledger ? &result->ledger : NULL,
                        .bars = bars,
                        .recording = recording,
                        .numbers = recording->table ? &result->numbers : NULL,
                        .start = start,
                        .until = until,
                        .every = every > 0 ? every : (until - start) / default_rows,
                        .next = 1};
    csv->near = 1e-9 * csv->every;
    csv->arrows = calloc(diagram_most_arrows(model), sizeof *csv->arrows);
    csv->work = calloc(model->load_count + 1, sizeof *csv->work);
    if (!csv->arrows || !csv->work) return false;
    struct fbd_state *state = ensemble_state(run);
    headers(csv, state);
    if (bars && !bars_look(bars, run, start, false, csv->ledger)) return false;
    return put_line(csv) && (!csv->numbers || numbers_begin(csv->numbers)) && row(csv, run);
}

double csv_next(const struct csv *csv)
{
    return csv->every > 0 ? fmin(csv->start + (double)csv->next * csv->every, csv->until) : csv->until;
}

bool csv_row(struct csv *csv, struct ensemble *ensemble, bool event)
{
    bool regular = csv->every > 0 && ensemble->t >= csv->start + (double)csv->next * csv->every - csv->near;
    if (regular) csv->next++;
    bool last = ensemble->outcome != FBD_GOING && ensemble->t > csv->last;
    if (!regular && !event && !last) return true;
    if (csv->ledger && !ledger_at(csv->ledger, ensemble, csv->work)) return false;
    if (csv->bars && !bars_look(csv->bars, ensemble, ensemble->t, event, csv->ledger)) return false;
    return row(csv, ensemble);
}

void csv_free(struct csv *csv)
{
    text_free(&csv->line);
    free(csv->arrows);
    free(csv->work);
}
