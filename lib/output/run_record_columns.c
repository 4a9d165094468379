/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The columns of a record (output/run_columns.h), their places by body and arrow, and the numbers of one row.
 */
#include "output/run_record.h"

/* ---- places: that of a kind is the place of its first part */

static void place_of_body(struct record_of_body *body, const struct run_column *column, int place)
{
    if (column->part > 0) return;
    switch (column->kind) {
    case column_coordinate: body->coordinate = place; return;
    case column_rate: body->rate = place; return;
    case column_acceleration: body->acceleration = body->equation = place; return;
    case column_in_equation: body->equation = place; return;
    case column_newton: body->newton = place; return;
    case column_moving_axis: body->moving_axis = place; return;
    case column_mass: body->mass = place; return;
    case column_frame: body->pose = place; return;
    default: return;
    }
}

static void place_of_force(struct record_of_arrow *arrow, const struct run_column *column, int place)
{
    if (column->part == force_x) arrow->components = place;
    if (column->extra) return;
    if (arrow->force_count++ == 0) arrow->force = place;
}

static void place_of_arrow(struct record_of_arrow *arrow, const struct run_column *column, int place)
{
    if (column->kind == column_force) place_of_force(arrow, column, place);
    if (column->part > 0) return;
    if (column->kind == column_arrow) arrow->arrow = place;
    if (column->kind == column_term) arrow->term = place;
    if (column->kind == column_work) arrow->work = place;
}

static bool begin_arrows(struct record *record, const struct fbd_state *start, int b)
{
    const struct instant at = state_instant(start);
    struct record_of_body *body = &record->bodies[b];
    body->moving_axis = body->mass = -1;
    body->arrow_count = diagram_fill(record->model, b, &at, start->slots, record->arrows);
    body->arrows = ARENA_ARRAY(&record->all.arena, body->arrow_count, struct record_of_arrow);
    for (size_t i = 0; body->arrows && i < body->arrow_count; i++)
        body->arrows[i] = (struct record_of_arrow){.name = record->arrows[i].name,
                                                   .load = record->arrows[i].load,
                                                   .term = -1,
                                                   .work = -1};
    return body->arrows != NULL || body->arrow_count == 0;
}

bool record_define(struct record *record, const struct fbd_state *start)
{
    struct run_columns *all = &record->all;
    all->model = record->model;
    all->components = record->components;
    all->arrows = record->arrows;
    if (!run_columns_make(all, column_in_page, start)) return false;
    record->column_count = all->count;
    record->columns = ARENA_ARRAY(&all->arena, all->count, struct record_column);
    record->bodies = ARENA_ARRAY(&all->arena, record->model->body_count, struct record_of_body);
    if (!record->columns || !record->bodies) return false;
    for (size_t b = 0; b < record->model->body_count; b++)
        if (!begin_arrows(record, start, (int)b)) return false;
    for (size_t c = 0; c < all->count; c++) {
        const struct run_column *column = &all->list[c];
        record->columns[c] = (struct record_column){.name = column->name,
                                                    .unit = column->unit,
                                                    .kind = column_quantity(column),
                                                    .body = column->body,
                                                    .is_constant = true,
                                                    .least = HUGE_VAL,
                                                    .greatest = -HUGE_VAL};
        if (column->kind == column_energy && column->part == 0) record->energy = (int)c;
        if (column->body < 0) continue;
        struct record_of_body *body = &record->bodies[column->body];
        if (column_is_of_arrow(column))
            place_of_arrow(&body->arrows[column->index], column, (int)c);
        else
            place_of_body(body, column, (int)c);
    }
    return true;
}

/* ---- one row */

void record_fill(struct record *record, const struct fbd_state *state, bool energies)
{
    struct column_view view;
    column_view_begin(&view, state, energies ? record->ledger : NULL, record->work, record->arrows);
    run_columns_values(&record->all, &view, record->values);
}
