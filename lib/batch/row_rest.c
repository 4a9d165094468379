/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A row of the scene at rest; reactions that equilibrium does not determine.
 */
#include <math.h>

#include "batch/row.h"
#include "rest/statics.h"

bool rows_rest(const struct rows *rows, fbd_errors *errors)
{
    for (size_t i = 0; i < rows->columns.count; i++) {
        const struct column *column = &rows->columns.list[i];
        const enum column_kind kind = column->quantity.kind;
        const bool known =
            column->kind == row_quantity && (kind == column_section || kind == column_coordinate);
        if (known || column->kind == row_parameter) continue;
        diag_add(errors, FBD_ERROR, "unknown-output", (struct pos){0, 0},
                 "at rest there are section forces, as `M(beam, 0.4 m)`, coordinates and parameters; a run, "
                 "without "
                 "--static, has all outputs",
                 "a scene at rest has no quantity `%s`", column->title);
        return false;
    }
    return true;
}

static bool has_section(const struct columns *columns)
{
    for (size_t i = 0; i < columns->count; i++)
        if (columns->list[i].quantity.kind == column_section) return true;
    return false;
}

void rows_warn_of_sections(const struct rows *rows, fbd_errors *errors)
{
    if (!has_section(&rows->columns)) return;
    fbd_errors *silent = fbd_errors_new();
    fbd_state *state = silent ? fbd_state_new(rows->base) : NULL;
    fbd_statics *statics = state ? fbd_statics_new(state, silent) : NULL;
    if (fbd_statics_undetermined_count(statics) > 0)
        diag_add(errors, FBD_WARNING, "indeterminate", (struct pos){0, 0},
                 "of all reactions that agree with the motion those of the least sum of squares are taken; "
                 "use springs in "
                 "place of rigid supports",
                 "equilibrium alone does not determine `%s`, on which section forces may depend",
                 fbd_statics_undetermined(statics, 0));
    fbd_statics_free(statics);
    fbd_state_free(state);
    fbd_errors_free(silent);
}

static double value_of(const struct column *column, struct column_view *view)
{
    if (column->kind != row_parameter) return run_column_value(&column->quantity, view);
    return view->state->model->scene->parameters[column->index].value;
}

/* The reason why there are no values, or "". */
static void take_values(const struct row_maker *maker, const struct fbd_statics *statics, double *values,
                        char *reason, size_t size, fbd_errors *errors)
{
    const struct columns *columns = &maker->table->columns;
    struct column_view view;
    column_view_begin(&view, statics->state, NULL, NULL, NULL);
    view.at_rest = true;
    view.errors = errors;
    for (size_t i = 0; i < columns->count; i++) values[i] = value_of(&columns->list[i], &view);
    row_write_reason(errors, reason, size);
}

enum row_end row_look_at_rest(struct row_maker *maker, uint64_t run, struct row_look *look)
{
    char reason[row_reason_room] = "";
    fbd_errors *errors = fbd_errors_new();
    struct fbd_model *model = errors && row_maker_set(maker, run) ? row_model(maker, errors) : NULL;
    fbd_state *state = model ? fbd_state_new(model) : NULL;
    fbd_statics *statics = state ? fbd_statics_new(state, errors) : NULL;
    const bool rests = statics && fbd_statics_holds(statics);
    look->row.length = look->story.length = 0;
    text_add(&look->story, "");
    for (size_t i = 0; i < maker->table->columns.count; i++) look->values[i] = NAN;
    if (rests)
        take_values(maker, statics, look->values, reason, sizeof reason, errors);
    else if (errors)
        row_write_reason(errors, reason, sizeof reason);
    if (!errors || errors->out_of_memory || (!statics && !reason[0])) look->row.failed = true;
    const bool failed = reason[0] != '\0';
    look->status = failed ? "failed" : rests ? "done" : "broken";
    text_add(&look->row, failed || rests ? reason : "the scene is not in equilibrium");
    look->reason = look->row.data;
    fbd_statics_free(statics);
    fbd_state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return failed ? row_failed : row_well;
}
