/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What fbd_view.h returns of a scene for other programs: its variables, their values and derivatives; units, options,
 * methods, data files and entries.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

#include "fbd_study.h"
#include "fbd_view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char scene[] =
    "fbd: 1\n"
    "parameters: {c: 0.5 N*s^2/m^2, d: 2*c}\n"
    "inputs: {F: 3 N}\n"
    "states: {charge: {rate: '-states.charge/2[s]', initial: 4 m}}\n"
    "bodies:\n"
    "  block:\n"
    "    mass: 2 kg\n"
    "    motion: slide\n"
    "    initial: {x: 0.1 m, v: 3 m/s}\n"
    "    points: {tip: [0.5 m, 0.25 m]}\n"
    "    forces:\n"
    "      - applied: {name: push, value: 'F*block.x^2/1[m^2]'}\n"
    "      - drag: {quadratic: d}\n"
    "  cart:\n"
    "    mass: 1 kg\n"
    "    motion: {slide: {x: 'sin(t/1[s])*1[m]'}}\n"
    "couplings: [spring: {between: [block.G, cart.G], stiffness: 7 N/m}]\n"
    "simulate: {until: 2 s, tolerance: 1e-9, method: rk8pd, output: {points: [block.tip]}}\n";

/* The index of a variable by its full name. */
static size_t index_of(const fbd_model *model, const char *name)
{
    for (size_t i = 0; i < fbd_model_variable_count(model); i++) {
        const fbd_variable variable = fbd_model_variable(model, i);
        char full[100];
        snprintf(full, sizeof full, "%s%s%s", variable.owner, *variable.owner ? "." : "", variable.name);
        if (strcmp(full, name) == 0) return i;
    }
    fail_msg("no variable %s", name);
    return 0;
}

static void variables_are_listed_with_units_and_starts(void **unused)
{
    (void)unused;
    static const struct {
        const char *name, *unit;
        fbd_variable_kind kind;
        size_t index;
        double start;
        bool start_free;
    } want[] = {
        {"t", "s", FBD_VARIABLE_TIME, 0, NAN, false},
        {"c", "kg/m", FBD_VARIABLE_PARAMETER, 0, 0.5, false},
        {"d", "kg/m", FBD_VARIABLE_PARAMETER, 1, 1, false},
        {"F", "N", FBD_VARIABLE_INPUT, 2, 3, false},
        {"block.x", "m", FBD_VARIABLE_COORDINATE, 0, 0.1, true},
        {"block.v", "m/s", FBD_VARIABLE_RATE, 0, 3, true},
        {"block.v_dot", "m/s^2", FBD_VARIABLE_ACCELERATION, 0, NAN, false},
        {"cart.x", "m", FBD_VARIABLE_COORDINATE, 1, 0, false},
        {"cart.v", "m/s", FBD_VARIABLE_RATE, 1, 0, false},
        {"cart.v_dot", "m/s^2", FBD_VARIABLE_ACCELERATION, 1, NAN, false},
        {"states.charge", "m", FBD_VARIABLE_STATE, 0, 4, true},
        {"block.tip.x", "m", FBD_VARIABLE_POINT, 0, NAN, false},
        {"block.tip.y", "m", FBD_VARIABLE_POINT, 0, NAN, false},
        {"block.tip.vx", "m/s", FBD_VARIABLE_POINT, 0, NAN, false},
        {"block.tip.vy", "m/s", FBD_VARIABLE_POINT, 0, NAN, false},
        {"block.tip.ax", "m/s^2", FBD_VARIABLE_POINT, 0, NAN, false},
        {"block.tip.ay", "m/s^2", FBD_VARIABLE_POINT, 0, NAN, false},
        {"block.tip.proper_ax", "m/s^2", FBD_VARIABLE_POINT, 0, NAN, false},
        {"block.tip.proper_ay", "m/s^2", FBD_VARIABLE_POINT, 0, NAN, false},
    };
    struct trial trial = trial_parse(scene);
    assert_int_equal(fbd_model_variable_count(trial.model), sizeof want / sizeof *want);
    for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
        const fbd_variable got = fbd_model_variable(trial.model, i);
        assert_int_equal(index_of(trial.model, want[i].name), i);
        assert_string_equal(got.unit, want[i].unit);
        assert_int_equal(got.kind, want[i].kind);
        assert_int_equal(got.index, want[i].index);
        assert_true(got.start == want[i].start || (isnan(got.start) && isnan(want[i].start)));
        assert_int_equal(got.start_free, want[i].start_free);
    }
    trial_close(&trial);
}

static void values_are_those_of_the_state(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse(scene);
    double values[24];
    trial_set(&trial, "t", 0.5);
    trial_set(&trial, "block.x", 2);
    size_t count = fbd_state_variables(trial.state, values, 24);
    assert_int_equal(count, fbd_model_variable_count(trial.model));
    assert_true(values[0] == 0.5 && values[index_of(trial.model, "F")] == 3);
    assert_true(values[index_of(trial.model, "block.x")] == 2 &&
                values[index_of(trial.model, "block.v")] == 3);
    assert_true(values[index_of(trial.model, "states.charge")] == 4);
    assert_true(values[index_of(trial.model, "block.v_dot")] == trial_acceleration(&trial, "block.x"));
    assert_true(values[index_of(trial.model, "block.tip.x")] == 2.5);
    assert_true(values[index_of(trial.model, "block.tip.y")] == 0.25);
    assert_true(values[index_of(trial.model, "block.tip.vx")] == 3);
    double first = 0, other = 7;
    assert_int_equal(fbd_state_variables(trial.state, &first, 1), count);
    assert_true(first == 0.5 && other == 7);
    assert_ptr_equal(fbd_state_model(trial.state), trial.model);
    trial_close(&trial);
}

/* m a = F x^2 - c v |v|, so da/dx = 2 F x/m, da/dv = -2 c |v|/m, da/dF = x^2/m. */
static void derivatives_of_accelerations_are_those_of_the_law(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse("fbd: 1\n"
                                     "parameters: {c: 0.5 N*s^2/m^2}\n"
                                     "inputs: {F: 3 N}\n"
                                     "bodies:\n"
                                     "  block:\n"
                                     "    mass: 2 kg\n"
                                     "    motion: slide\n"
                                     "    initial: {x: 0.1 m, v: 3 m/s}\n"
                                     "    forces:\n"
                                     "      - applied: {name: push, value: 'F*x^2/1[m^2]'}\n"
                                     "      - drag: {quadratic: c}\n"
                                     "simulate: {until: 2 s}\n");
    const size_t by[] = {index_of(trial.model, "F"), index_of(trial.model, "block.v"),
                         index_of(trial.model, "block.x")},
                 by_parameter = index_of(trial.model, "c");
    double slopes[3], none;
    assert_true(fbd_state_derivatives(trial.state, by, 3, slopes, NULL));
    assert_true(fabs(slopes[0] - 0.1 * 0.1 / 2) < 1e-15);
    assert_true(fabs(slopes[1] + 2 * 0.5 * 3 / 2) < 1e-15);
    assert_true(fabs(slopes[2] - 2 * 3 * 0.1 / 2) < 1e-15);
    assert_true(fbd_state_derivatives(trial.state, NULL, 0, NULL, NULL));
    assert_false(fbd_state_derivatives(trial.state, &by_parameter, 1, &none, NULL));
    trial_close(&trial);
}

static void a_scene_with_states_has_no_derivatives(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse(scene);
    fbd_errors *errors = fbd_errors_new();
    assert_false(fbd_state_derivatives(trial.state, NULL, 0, NULL, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, "no-derivatives");
    fbd_errors_free(errors);
    trial_close(&trial);
}

static void units_are_products_of_base_units(void **unused)
{
    (void)unused;
    fbd_unit unit;
    assert_true(fbd_unit_read(NULL, "lbf*ft/rad and more", 10, &unit));
    assert_true(unit.mass == 1 && unit.length == 2 && unit.time == -2 && unit.current == 0);
    assert_true(fabs(unit.factor - 1.3558179483314004) < 1e-15);
    assert_false(fbd_unit_read(NULL, "furlong", 7, &unit));
    struct trial us = trial_parse("fbd: 1\nunits: US\nbodies: {b: {mass: 1 slug, motion: slide}}\n");
    assert_true(fbd_unit_read(us.model, "in", 2, &unit) && fabs(unit.factor - 1.0 / 12) < 1e-17);
    trial_close(&us);
}

static void options_of_the_file_and_methods_are_listed(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse(scene);
    fbd_options options;
    fbd_model_options(trial.model, &options, sizeof options);
    assert_true(options.until == 2 && options.tolerance == 1e-9 && options.step == 0 &&
                options.accuracy == 0);
    assert_string_equal(options.method, "rk8pd");
    size_t found = 0;
    for (size_t i = 0; i < fbd_method_count(); i++) found += strcmp(fbd_method_get(i).name, "rk8pd") == 0;
    assert_int_equal(found, 1);
    trial_start(&trial, NULL);
    assert_int_equal(fbd_simulation_outcome(trial.simulation), FBD_GOING);
    trial_finish(&trial);
    assert_int_equal(fbd_simulation_outcome(trial.simulation), FBD_DONE);
    trial_close(&trial);
}

static void entries_are_listed_at_their_lines(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse(scene);
    fbd_entry entries[8];
    size_t count = fbd_model_entries(trial.model, entries, 8);
    assert_true(count >= 3 && count <= 8);
    assert_string_equal(entries[0].body, "block");
    assert_string_equal(entries[0].name, "push");
    assert_int_equal(entries[0].line, 12);
    assert_string_equal(entries[1].name, "drag");
    assert_int_equal(entries[1].line, 13);
    assert_string_equal(entries[count - 1].body, "");
    assert_string_equal(entries[count - 1].name, "spring");
    assert_int_equal(entries[count - 1].line, 17);
    trial_close(&trial);
}

static void data_files_are_listed_by_their_tables(void **unused)
{
    (void)unused;
    const char path[] = "./test_variables_data.csv";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("t [s],F [N]\n0,1\n1,3\n", file);
    assert_int_equal(fclose(file), 0);
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "tables: {flat: {points: [[0, 2], [1, 2]]}, push: {file: test_variables_data.csv}}\n"
        "bodies: {b: {mass: 1 kg, motion: slide, forces: [applied: {value: 'push(t)*flat(t)'}]}}\n"
        "simulate: {until: 1 s}\n");
    assert_int_equal(fbd_model_data_file_count(trial.model), 1);
    assert_string_equal(fbd_model_data_file(trial.model, 0).table, "push");
    assert_string_equal(fbd_model_data_file(trial.model, 0).path, path);
    assert_null(fbd_model_data_file(trial.model, 1).path);
    trial_close(&trial);
    remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(variables_are_listed_with_units_and_starts),
        cmocka_unit_test(values_are_those_of_the_state),
        cmocka_unit_test(derivatives_of_accelerations_are_those_of_the_law),
        cmocka_unit_test(a_scene_with_states_has_no_derivatives),
        cmocka_unit_test(units_are_products_of_base_units),
        cmocka_unit_test(options_of_the_file_and_methods_are_listed),
        cmocka_unit_test(entries_are_listed_at_their_lines),
        cmocka_unit_test(data_files_are_listed_by_their_tables),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
