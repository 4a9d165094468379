/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The table of columns against the outputs: each kind of column is in the outputs that its row names, with its
 * name, unit and value, and each kind occurs in one of the scenes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fbd_export.h"
#include "fbd_study.h"
#include "model/model.h"
#include "output/run_columns.h"
#include "record/result.h"
#include "scenes.h"

/* Kinds that few scenes have: a mass that varies, a user state, an output point, an axis that moves. */
static const char rare[] = "fbd: 1\n"
                           "bodies:\n"
                           "  rocket:\n"
                           "    mass: 5[kg] - 0.5[kg/s]*t\n"
                           "    motion: slide\n"
                           "    forces: [{applied: 7 N}, {thrust: {exhaust: 10 m/s}}]\n"
                           "  rod:\n"
                           "    shape: rod\n"
                           "    mass: 3 kg\n"
                           "    length: 2 m\n"
                           "    motion: {pivot: {on: rocket, at: G, point: left}}\n"
                           "    forces: [gravity]\n"
                           "states:\n"
                           "  charge: {rate: 'rod.omega', initial: 2}\n"
                           "output: {points: [rod.right]}\n"
                           "simulate: {until: 0.1 s}\n";

struct tested {
    fbd_model *model;
    fbd_result *result;
    struct run_columns columns;
    bool seen[column_kinds];
};

static void make(struct tested *tested, unsigned uses)
{
    run_columns_free(&tested->columns);
    tested->columns = (struct run_columns){.model = tested->model, .components = true};
    tested->columns.arrows = tested->result->ledger.arrows;
    assert_true(run_columns_make(&tested->columns, uses, tested->result->start));
    for (size_t i = 0; i < tested->columns.count; i++) tested->seen[tested->columns.list[i].kind] = true;
}

/* The last row has the values at the end. */
static void check_rows(struct tested *tested)
{
    make(tested, column_in_csv | column_in_ledger);
    const fbd_table table = fbd_result_table(tested->result);
    const struct run_columns *columns = &tested->columns;
    struct ledger *ledger = &tested->result->ledger;
    struct column_view view;
    double *values = calloc(columns->count, sizeof *values);
    assert_true(values && table.rows > 1 && table.columns == columns->count);
    column_view_begin(&view, fbd_result_state(tested->result), ledger, ledger->work, ledger->arrows);
    run_columns_values(columns, &view, values);
    for (size_t i = 0; i < columns->count; i++) {
        assert_string_equal(table.heads[i].name, columns->list[i].name);
        assert_string_equal(table.heads[i].unit, columns->list[i].unit);
        assert_true(table.values[(table.rows - 1) * table.columns + i] == values[i]);
    }
    free(values);
}

static void check_page(struct tested *tested)
{
    make(tested, column_in_page);
    char *data = fbd_result_page_data(tested->result, 0, NULL);
    assert_non_null(data);
    const char *at = data;
    for (size_t i = 0; i < tested->columns.count; i++) {
        char head[300];
        snprintf(head, sizeof head, "{\"n\":\"%s\",\"u\":\"%s\",", tested->columns.list[i].name,
                 tested->columns.list[i].unit);
        at = strstr(at, head);
        assert_non_null(at);
    }
    fbd_free(data);
}

static void check_head(const char *text, const char *output, const struct run_column *column)
{
    char head[300];
    const fbd_sweep_plan plan = {.outputs = &output, .output_count = 1};
    fbd_sweep *sweep = fbd_sweep_parse(text, strlen(text), NULL, &plan, NULL);
    assert_non_null(sweep);
    snprintf(head, sizeof head, ",%s [%s],", column->name, column->unit);
    assert_non_null(strstr(fbd_sweep_header(sweep), head));
    fbd_sweep_free(sweep);
}

static void check_sweep(struct tested *tested, const char *text)
{
    make(tested, column_in_sweep);
    for (size_t i = 0; i < tested->columns.count; i++)
        check_head(text, tested->columns.list[i].name, &tested->columns.list[i]);
}

/* It is in no list, and a sweep finds it by its name. */
static void check_section(struct tested *tested, const char *text)
{
    static const char *const names[] = {"N(rod, 1.5 m)", "V(rod, left)", "M(rod, 0.5 m, behind)"};
    struct arena arena = {0};
    tested->model = model_from(text);
    fbd_errors *errors = fbd_errors_new();
    for (int i = 0; i < 3; i++) {
        struct run_column column;
        assert_true(run_column_of_section(tested->model, &arena, names[i], &column, errors));
        check_head(text, names[i], &column);
        tested->seen[column.kind] = true;
    }
    fbd_errors_free(errors);
    arena_free(&arena);
    fbd_model_free(tested->model);
}

static void check_scene(struct tested *tested, const char *text)
{
    const fbd_options options = {.until = 0.1};
    const fbd_recording recording = {
        .ledger = true, .table = true, .keep = true, .rows = 10, .every = 0.05, .components = true};
    tested->model = model_from(text);
    fbd_simulation *simulation = fbd_simulation_new(tested->model, &options, NULL);
    tested->result = fbd_simulation_run(simulation, &recording);
    assert_non_null(tested->result);
    check_rows(tested);
    check_page(tested);
    check_sweep(tested, text);
    run_columns_free(&tested->columns);
    fbd_result_free(tested->result);
    fbd_simulation_free(simulation);
    fbd_model_free(tested->model);
}

static void each_column_is_in_its_outputs(void **unused)
{
    (void)unused;
    struct tested tested = {0};
    for (size_t i = 0; i < all_scenes_count; i++) check_scene(&tested, all_scenes[i].text);
    check_scene(&tested, rare);
    check_section(&tested, rare);
    for (int kind = 0; kind < column_kinds; kind++) {
        if (!tested.seen[kind]) print_message("column kind %d is in no scene\n", kind);
        assert_true(tested.seen[kind]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_column_is_in_its_outputs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
