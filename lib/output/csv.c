/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/csv.h"

#include <stdlib.h>
#include <string.h>

#include "record/finite_result.h"

enum { default_rows = 500 };

/* ---- columns */

static void head(struct csv *csv, const char *name, const char *unit)
{
    text_printf(&csv->line, "%s%s [%s]", csv->line.length > 0 ? "," : "", name, unit);
    if (csv->numbers) numbers_head(csv->numbers, name, unit);
}

/* Each column, with error bars followed by that of its error. */
static void headers(struct csv *csv)
{
    for (size_t i = 0; i < csv->columns.count; i++) {
        const struct run_column *column = &csv->columns.list[i];
        head(csv, column->name, column->unit);
        if (!csv->bars || !column_has_error(column)) continue;
        struct text name = {0};
        text_printf(&name, "%s ±", column->name);
        csv->line.failed |= name.failed;
        if (!name.failed) head(csv, name.data, column->unit);
        text_free(&name);
    }
}

/* ---- rows */

/* Write the next field of the row; empty if the number is not finite. Returns whether it is. */
static inline bool field(struct csv *csv, double value)
{
    const bool finite = isfinite(value);
    if (csv->numbers) numbers_add(csv->numbers, value);
    if (csv->recording->csv) {
        if (csv->line.length > 0) text_literal(&csv->line, ",");
        if (finite) text_exact(&csv->line, value);
    }
    return finite;
}

static bool put_line(struct csv *csv)
{
    const fbd_recording *recording = csv->recording;
    if (recording->csv) text_literal(&csv->line, "\n");
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

/* A row with a number that is not finite is not written and ends the run. */
static bool refuse_line(struct csv *csv, struct ensemble *ensemble)
{
    csv->line.length = 0;
    if (csv->numbers) numbers_drop_row(csv->numbers);
    if (result_finite(ensemble, csv->ledger, csv->work))
        ensemble_spoil(ensemble, "a number of the row at t = %.9g is not finite", ensemble->t);
    return ensemble->outcome == FBD_FAILED || ensemble->outcome == FBD_BROKEN;
}

static void error_field(struct csv *csv, size_t i, const struct column_view *view)
{
    const struct run_column *column = &csv->columns.list[i];
    if (column_has_error(column))
        field(csv, column_error(column, view, csv->bars, csv->values[i], csv->others[i]));
}

static bool row(struct csv *csv, struct ensemble *ensemble)
{
    const struct fbd_state *state = csv->evaluated ? ensemble_state(ensemble) : ensemble_placed(ensemble);
    const struct run_columns *columns = &csv->columns;
    struct bars *bars = csv->bars;
    struct column_view view, companion;
    bool odd = false;
    column_view_begin(&view, state, csv->ledger, csv->work, csv->arrows);
    run_columns_values(columns, &view, csv->values);
    if (bars) {
        column_view_begin(&companion, bars->state, &bars->ledger, bars->work, bars->arrows);
        run_columns_values(columns, &companion, csv->others);
    }
    csv->last = state->t;
    for (size_t i = 0; i < columns->count; i++) {
        odd |= !field(csv, csv->values[i]);
        if (bars) error_field(csv, i, &view);
    }
    return odd ? refuse_line(csv, ensemble) : put_row(csv);
}

/* ---- the file */

static bool needs_evaluation(const struct csv *csv)
{
    for (size_t i = 0; i < csv->columns.count; i++) {
        const struct run_column *column = &csv->columns.list[i];
        if (column->kind != column_time && !column_is_entry(column)) return true;
    }
    return csv->bars != NULL;
}

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
    csv->columns = (struct run_columns){.model = model,
                                        .components = recording->components,
                                        .degrees = recording->degrees,
                                        .arrows = csv->arrows};
    const unsigned uses = column_in_csv | (csv->ledger ? column_in_ledger : 0u);
    if (!run_columns_make(&csv->columns, uses, ensemble_state(run))) return false;
    csv->evaluated = needs_evaluation(csv);
    csv->values = calloc(csv->columns.count, sizeof *csv->values);
    csv->others = calloc(csv->columns.count, sizeof *csv->others);
    if (!csv->values || !csv->others) return false;
    headers(csv);
    if (bars && !bars_look(bars, run, start, false, csv->ledger)) return false;
    return put_line(csv) && (!csv->numbers || numbers_begin(csv->numbers)) && row(csv, run);
}

double csv_next(const struct csv *csv)
{
    const double next = csv->start + (double)csv->next * csv->every;
    return csv->every > 0 && next < csv->until ? next : csv->until;
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
    run_columns_free(&csv->columns);
    free(csv->arrows);
    free(csv->work);
    free(csv->values);
    free(csv->others);
}
