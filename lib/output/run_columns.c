/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/run_columns.h"

#include <stdlib.h>
#include <string.h>

#include "output/column_table.h"
#include "output/words.h"

/* ---- lists */

static void append(struct run_columns *columns, const struct run_column *column)
{
    if (columns->count == columns->room) {
        const size_t room = columns->room ? 2 * columns->room : 64;
        struct run_column *list = realloc(columns->list, room * sizeof *list);
        if (!list) {
            columns->arena.failed = true;
            return;
        }
        columns->list = list;
        columns->room = room;
    }
    columns->list[columns->count++] = *column;
}

/* Append the columns of a scope that one of the outputs has: of a body, or -1; of its arrow, the state or the
 * point `index`. */
static void append_scope(struct run_columns *columns, unsigned uses, enum column_scope scope, int body,
                         int index)
{
    for (int kind = 0; kind < column_kinds; kind++) {
        if (column_rows[kind].scope != scope || !(column_rows[kind].uses & uses)) continue;
        const size_t first = columns->count;
        for (int part = 0; part < column_rows[kind].parts; part++) {
            struct run_column column = {.kind = (enum column_kind)kind,
                                        .body = body,
                                        .index = index,
                                        .part = part,
                                        .entry = -1,
                                        .size = 1};
            if (!column_rows[kind].define(columns, &column)) continue;
            if (!column.extra || (uses & column_in_page)) append(columns, &column);
        }
        if (columns->count > first) columns->list[first].group = (int)(columns->count - first);
    }
}

/* Append those of the arrows of a body, if an output has them, and of its other works. */
static void append_forces(struct run_columns *columns, unsigned uses, const struct fbd_state *start, int b)
{
    if (!(uses & (column_in_ledger | column_in_page))) return;
    const struct instant at = state_instant(start);
    const size_t count = diagram_fill(columns->model, b, &at, start->slots, columns->arrows);
    for (size_t i = 0; i < count; i++) append_scope(columns, uses, of_arrow, b, (int)i);
    append_scope(columns, uses, of_works, b, -1);
}

/* Entries of y are evaluated together, whichever body they belong to. */
static void join_entries(struct run_columns *columns)
{
    int count = 0; /* of entries from i on */
    for (size_t i = columns->count; i-- > 0;) {
        struct run_column *column = &columns->list[i];
        count = column_is_entry(column) ? count + 1 : 0;
        if (count > 0) column->group = count;
    }
}

bool run_columns_make(struct run_columns *columns, unsigned uses, const struct fbd_state *start)
{
    const struct fbd_model *model = columns->model;
    const int bodies = (int)model->body_count, points = (int)model->scene->output_point_count;
    append_scope(columns, uses, of_run, -1, -1);
    for (int b = 0; b < bodies; b++) {
        append_scope(columns, uses, of_body, b, -1);
        if (uses & column_in_page) append_forces(columns, uses, start, b);
    }
    if (uses & column_in_page) append_scope(columns, uses, of_energy, -1, -1);
    for (int i = 0; i < model->plan.own; i++) append_scope(columns, uses, of_state, -1, i);
    for (int i = 0; i < points; i++) append_scope(columns, uses, of_point, -1, i);
    if (!(uses & column_in_page)) {
        for (int b = 0; b < bodies; b++) append_forces(columns, uses, start, b);
        append_scope(columns, uses, of_energy, -1, -1);
    }
    join_entries(columns);
    return !columns->arena.failed;
}

void run_columns_free(struct run_columns *columns)
{
    free(columns->list);
    arena_free(&columns->arena);
    *columns = (struct run_columns){0};
}

static bool find_work(struct run_columns *columns, const char *name, struct run_column *column)
{
    const char *load = strchr(name, '.'), *work = strrchr(name, '.');
    if (!load || work == load || strcmp(work, ".work") != 0) return false;
    const char *body = arena_text(&columns->arena, name, (size_t)(load - name));
    load = arena_text(&columns->arena, load + 1, (size_t)(work - load) - 1);
    if (!body || !load) return false;
    *column = (struct run_column){.name = name,
                                  .unit = energy_unit(columns->model),
                                  .kind = column_work,
                                  .body = -1,
                                  .index = -1,
                                  .entry = model_find_load(columns->model, body, load),
                                  .size = 1};
    return column->entry >= 0;
}

static bool find_point(const struct run_columns *columns, const char *name, struct run_column *column)
{
    struct world_quantity found;
    if (!world_find(columns->model, name, &found)) return false;
    *column = (struct run_column){.name = name,
                                  .unit = world_part_unit(columns->model, found.part),
                                  .kind = column_point,
                                  .body = found.body,
                                  .index = -1,
                                  .part = (int)found.part,
                                  .entry = -1,
                                  .size = 1,
                                  .point = found.point};
    return true;
}

bool run_columns_find(struct run_columns *columns, const char *name, struct run_column *column)
{
    const int entry = model_find_component(columns->model, name, true);
    for (size_t i = 0; i < columns->count; i++) {
        const struct run_column *listed = &columns->list[i];
        if (strcmp(listed->name, name) != 0 && !(column_is_entry(listed) && listed->entry == entry)) continue;
        *column = *listed;
        return true;
    }
    return find_point(columns, name, column) || find_work(columns, name, column);
}

bool run_column_of_section(const struct fbd_model *model, struct arena *arena, const char *name,
                           struct run_column *column, fbd_errors *errors)
{
    struct section_name *section = ARENA_ARRAY(arena, 1, struct section_name);
    if (!section || !section_name_read(model, arena, name, section, errors)) return false;
    *column =
        (struct run_column){.name = section->title,
                            .unit = section->force == section_M ? moment_unit(model) : force_unit(model),
                            .kind = column_section,
                            .body = section->body,
                            .index = -1,
                            .entry = -1,
                            .size = 1,
                            .section = section};
    return true;
}

/* ---- rows */

void column_view_begin(struct column_view *view, const struct fbd_state *state, struct ledger *works,
                       const double *work, struct arrow *arrows)
{
    view->state = state;
    view->at = state_instant(state);
    view->at_rest = false;
    view->errors = NULL;
    view->ledger = works;
    view->work = work;
    view->arrows = arrows;
    view->with_arrows = view->with_pose = -1;
}

enum column_quantity column_quantity(const struct run_column *column)
{
    return column_rows[column->kind].quantity;
}

bool column_is_entry(const struct run_column *column)
{
    return column->kind == column_coordinate || column->kind == column_rate || column->kind == column_state;
}

bool column_is_of_arrow(const struct run_column *column)
{
    return column_rows[column->kind].scope == of_arrow;
}

void run_columns_values(const struct run_columns *columns, struct column_view *view, double *values)
{
    const struct run_column *c = columns->list, *end = c + columns->count;
    for (; c < end; values += c->group, c += c->group) column_rows[c->kind].values(c, c->group, view, values);
}

double run_column_value(const struct run_column *column, struct column_view *view)
{
    double value;
    column_rows[column->kind].values(column, 1, view, &value);
    return value;
}

bool column_has_error(const struct run_column *column)
{
    return column_rows[column->kind].error != NULL;
}

double column_error(const struct run_column *column, const struct column_view *view, const struct bars *bars,
                    double value, double other)
{
    return column_rows[column->kind].error(column, view, bars, value, other);
}
