/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: forces, moments and reactions as columns (output/run_columns.h).
 */
#include <stdlib.h>

#include "dynamics/diagram.h"
#include "fbd_exchange.h"
#include "output/equations.h"
#include "output/run_columns.h"

struct fbd_force_columns {
    struct run_columns columns;
    struct arrow *arrows; /* of the views */
    size_t *listed;       /* the columns that are forces */
    size_t count;
};

static bool is_force(const struct run_column *column)
{
    return column->kind == column_force && !column->extra;
}

static bool make(fbd_force_columns *forces, const fbd_model *model)
{
    struct run_columns *columns = &forces->columns;
    struct fbd_state *start = fbd_state_new(model);
    columns->model = model;
    const size_t room = diagram_most_arrows(model);
    columns->arrows = calloc(2 * room + 1, sizeof *columns->arrows);
    forces->arrows = columns->arrows ? columns->arrows + room : NULL;
    const bool made = start && columns->arrows && run_columns_make(columns, column_in_ledger, start);
    state_free(start);
    if (!made) return false;
    forces->listed = calloc(columns->count + 1, sizeof *forces->listed);
    for (size_t i = 0; forces->listed && i < columns->count; i++)
        if (is_force(&columns->list[i])) forces->listed[forces->count++] = i;
    return forces->listed != NULL;
}

fbd_force_columns *fbd_force_columns_new(const fbd_model *model)
{
    fbd_force_columns *forces = model ? calloc(1, sizeof *forces) : NULL;
    if (!forces || make(forces, model)) return forces;
    fbd_force_columns_free(forces);
    return NULL;
}

void fbd_force_columns_free(fbd_force_columns *forces)
{
    if (!forces) return;
    free(forces->columns.arrows);
    free(forces->listed);
    run_columns_free(&forces->columns);
    free(forces);
}

size_t fbd_force_columns_count(const fbd_force_columns *forces)
{
    return forces ? forces->count : 0;
}

static const struct run_column *column_at(const fbd_force_columns *forces, size_t index)
{
    return forces && index < forces->count ? &forces->columns.list[forces->listed[index]] : NULL;
}

const char *fbd_force_columns_name(const fbd_force_columns *forces, size_t index)
{
    const struct run_column *column = column_at(forces, index);
    return column ? column->name : NULL;
}

const char *fbd_force_columns_unit(const fbd_force_columns *forces, size_t index)
{
    const struct run_column *column = column_at(forces, index);
    return column ? column->unit : NULL;
}

bool fbd_force_columns_values(fbd_force_columns *forces, fbd_state *state, double *values)
{
    if (!forces || !state || !values || state->model != forces->columns.model) return false;
    state_ready(state);
    struct column_view view;
    column_view_begin(&view, state, NULL, NULL, forces->arrows);
    for (size_t i = 0; i < forces->count; i++) values[i] = run_column_value(column_at(forces, i), &view);
    return true;
}
