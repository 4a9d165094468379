/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls of the library that cannot be meant: every function of fbd.h, with NULL for whatever it asks for,
 * with an index past the end, with a state of another model. Each answers with its error value. A function
 * that is not called here fails the last test.
 */
#include <gsl/gsl_errno.h>

#include "bad_calls.h"
#include "fbd_export.h"
#include "fbd_grade.h"
#include "fbd_linear.h"
#include "fbd_study.h"
#include "fbd_view.h"

const char bad_calls_scene[] = "fbd: 1\n"
                               "parameters: {k: 4 N/m}\n"
                               "bodies:\n"
                               "  block:\n"
                               "    mass: 2 kg\n"
                               "    motion: slide\n"
                               "    initial: {x: 0.1 m}\n"
                               "    forces: [spring: {stiffness: k}]\n"
                               "simulate: {until: 0.2 s, events: [{name: mark, when: 'block.x = 0'}]}\n";

/* ---- what has been called */

enum { most_called = 600 };
static const char *called[most_called];
static size_t called_count;

void note(const char *name)
{
    assert_true(called_count < most_called);
    called[called_count++] = name;
}

fbd_model *model, *other;
fbd_errors *errors;

static int set_up(void **state)
{
    (void)state;
    model = fbd_model_parse(bad_calls_scene, strlen(bad_calls_scene), "scene", NULL, 0, NULL);
    other = fbd_model_parse(bad_calls_scene, strlen(bad_calls_scene), "other", NULL, 0, NULL);
    errors = fbd_errors_new();
    return model && other && errors ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    fbd_model_free(model);
    fbd_model_free(other);
    fbd_errors_free(errors);
    return 0;
}

/* ---- each part of the header */

static void errors_and_models(void **state)
{
    (void)state;
    const fbd_setting nameless[] = {{NULL, "1"}}, empty[] = {{"k", NULL}};
    ANSWERS(fbd_errors_count, fbd_errors_count(NULL) == 0);
    ANSWERS(fbd_errors_failed_count, fbd_errors_failed_count(NULL) == 0);
    ANSWERS(fbd_errors_get, !fbd_errors_get(NULL, 0).id);
    ANSWERS(fbd_errors_guide, !fbd_errors_guide(NULL));
    ANSWERS(fbd_errors_guide, !fbd_errors_guide(""));
    ANSWERS(fbd_errors_file_count, fbd_errors_file_count(NULL) == 0);
    ANSWERS(fbd_errors_file, !fbd_errors_file(NULL, 0));
    ANSWERS(fbd_errors_file, !fbd_errors_file(errors, past));
    ANSWERS(fbd_errors_get, !fbd_errors_get(errors, past).message);
    char shown[4];
    ENDURES(fbd_escape, assert_int_equal(fbd_escape(NULL, shown, sizeof shown), 0));
    ENDURES(fbd_escape, assert_int_equal(fbd_escape("\x1b[", NULL, 0), 5));
    ENDURES(fbd_escape, assert_int_equal(fbd_escape("ab\xE2\x80\xAE", shown, sizeof shown), 8));
    assert_string_equal(shown, "ab"); /* whole characters only */
    ENDURES(fbd_errors_print, fbd_errors_print(NULL, stderr));
    ENDURES(fbd_errors_print, fbd_errors_print(errors, NULL));
    ENDURES(fbd_errors_free, fbd_errors_free(NULL));
    REFUSES(fbd_model_read, !fbd_model_read(NULL, NULL, 0, errors));
    REFUSES(fbd_model_read, !fbd_model_read("-", NULL, 1, errors));
    REFUSES(fbd_model_read_motion, !fbd_model_read_motion(NULL, NULL, 0, errors));
    REFUSES(fbd_model_read_motion, !fbd_model_read_motion("-", NULL, 1, errors));
    REFUSES(fbd_model_parse, !fbd_model_parse(NULL, 3, "name", NULL, 0, errors));
    REFUSES(fbd_model_parse,
            !fbd_model_parse(bad_calls_scene, strlen(bad_calls_scene), "name", NULL, 1, errors));
    REFUSES(fbd_model_parse,
            !fbd_model_parse(bad_calls_scene, strlen(bad_calls_scene), "name", nameless, 1, errors));
    REFUSES(fbd_model_parse,
            !fbd_model_parse(bad_calls_scene, strlen(bad_calls_scene), "name", empty, 1, errors));
    ANSWERS(fbd_model_parse, !fbd_model_parse(NULL, 0, NULL, NULL, 0, NULL));
    ENDURES(fbd_model_free, fbd_model_free(NULL));
    ANSWERS(fbd_model_title, strcmp(fbd_model_title(NULL), "") == 0);
    size_t length = 7;
    ANSWERS(fbd_model_source, !fbd_model_source(NULL, &length) && length == 0);
    ANSWERS(fbd_model_source, fbd_model_source(model, NULL));
    ANSWERS(fbd_model_body_count, fbd_model_body_count(NULL) == 0);
    ANSWERS(fbd_model_body_name, !fbd_model_body_name(NULL, 0));
    ANSWERS(fbd_model_body_name, !fbd_model_body_name(model, past));
    ANSWERS(fbd_model_inertia, is_nan(fbd_model_inertia(NULL, 0).mass));
    ANSWERS(fbd_model_inertia, is_nan(fbd_model_inertia(model, past).I_G));
    ANSWERS(fbd_model_coordinate_count, fbd_model_coordinate_count(NULL) == 0);
    ANSWERS(fbd_model_coordinate, !fbd_model_coordinate(NULL, 0).name);
    ANSWERS(fbd_model_coordinate, !fbd_model_coordinate(model, past).rate_unit);
    ANSWERS(fbd_model_state_count, fbd_model_state_count(NULL) == 0);
    ANSWERS(fbd_model_state, !fbd_model_state(NULL, 0).name);
    ANSWERS(fbd_model_state, !fbd_model_state(model, past).name);
    REFUSES(fbd_model_has_columns, !fbd_model_has_columns(NULL, "block.x", errors));
    REFUSES(fbd_model_has_columns, !fbd_model_has_columns(model, NULL, errors));
    ANSWERS(fbd_model_parameter_count, fbd_model_parameter_count(NULL) == 0);
    ANSWERS(fbd_model_parameter, !fbd_model_parameter(NULL, 0).name);
    ANSWERS(fbd_model_parameter, is_nan(fbd_model_parameter(model, past).value));
    ANSWERS(fbd_emit_c, !fbd_emit_c(NULL, NULL, NULL));
    char *program = fbd_emit_c(model, NULL, NULL);
    assert_non_null(program);
    free(program);
    ANSWERS(fbd_explain, !fbd_explain(NULL, NULL));
    char *plan = fbd_explain(model, NULL);
    assert_non_null(plan);
    free(plan);
}

static void a_model_may_have_no_name(void **state)
{
    (void)state;
    fbd_model *nameless = fbd_model_parse(bad_calls_scene, strlen(bad_calls_scene), NULL, NULL, 0, errors);
    assert_non_null(nameless);
    fbd_model_free(nameless);
}

static void states(void **context)
{
    (void)context;
    fbd_state *state = fbd_state_new(model), *foreign = fbd_state_new(other);
    double value;
    assert_non_null(state);
    ANSWERS(fbd_state_new, !fbd_state_new(NULL));
    ANSWERS(fbd_state_copy, !fbd_state_copy(NULL, state));
    ANSWERS(fbd_state_copy, !fbd_state_copy(state, NULL));
    ANSWERS(fbd_state_copy, !fbd_state_copy(state, foreign));
    ANSWERS(fbd_state_pack, fbd_state_pack(NULL, &value, 1) == 0);
    ANSWERS(fbd_state_pack, fbd_state_pack(state, NULL, past) > 0);
    ANSWERS(fbd_state_unpack, !fbd_state_unpack(NULL, &value, 1));
    ANSWERS(fbd_state_unpack, !fbd_state_unpack(state, NULL, 1));
    ANSWERS(fbd_state_unpack, !fbd_state_unpack(state, &value, 0));
    fbd_state_free(foreign);
    ENDURES(fbd_state_free, fbd_state_free(NULL));
    ANSWERS(fbd_state_set, !fbd_state_set(NULL, "block.x", 1));
    ANSWERS(fbd_state_set, !fbd_state_set(state, NULL, 1));
    ANSWERS(fbd_state_set, !fbd_state_set(state, "block.x", INFINITY));
    REFUSES(fbd_state_set_text, !fbd_state_set_text(NULL, "block.x", "1", errors));
    REFUSES(fbd_state_set_text, !fbd_state_set_text(state, NULL, "1", errors));
    REFUSES(fbd_state_set_text, !fbd_state_set_text(state, "block.x", NULL, errors));
    REFUSES(fbd_state_set_text_degrees, !fbd_state_set_text_degrees(NULL, "block.x", "1", errors));
    REFUSES(fbd_state_set_text_degrees, !fbd_state_set_text_degrees(state, "block.x", NULL, errors));
    REFUSES(fbd_model_quantity, !fbd_model_quantity(NULL, "it", "1 N", "N", &value, errors));
    REFUSES(fbd_model_quantity, !fbd_model_quantity(model, NULL, "1 N", "N", &value, errors));
    REFUSES(fbd_model_quantity, !fbd_model_quantity(model, "it", NULL, "N", &value, errors));
    REFUSES(fbd_model_quantity, !fbd_model_quantity(model, "it", "1 N", NULL, &value, errors));
    REFUSES(fbd_model_quantity, !fbd_model_quantity(model, "it", "1 N", "N", NULL, errors));
    ENDURES(fbd_state_show_degrees, fbd_state_show_degrees(NULL, true));
    REFUSES(fbd_state_close, !fbd_state_close(NULL, errors));
    ANSWERS(fbd_state_get, !fbd_state_get(NULL, "block.x", &value));
    ANSWERS(fbd_state_get, !fbd_state_get(state, NULL, &value));
    ANSWERS(fbd_state_get, !fbd_state_get(state, "block.x", NULL));
    ANSWERS(fbd_diagram, fbd_diagram(NULL, 0, NULL, 0) == 0);
    ANSWERS(fbd_diagram, fbd_diagram(state, past, NULL, 0) == 0);
    ANSWERS(fbd_diagram, fbd_diagram(state, 0, NULL, 5) > 0);
    ANSWERS(fbd_redundant, fbd_redundant(NULL, NULL, 0) == 0);
    ANSWERS(fbd_redundant, fbd_redundant(state, NULL, 5) == 0);
    REFUSES(fbd_diagram_svg, !fbd_diagram_svg(NULL, NULL, errors));
    REFUSES(fbd_find_equilibrium, !fbd_find_equilibrium(NULL, errors));
    fbd_state_free(state);
}

static void equations(void **context)
{
    (void)context;
    fbd_state *state = fbd_state_new(model);
    fbd_equations *all = fbd_assemble(state);
    assert_non_null(all);
    const fbd_equation first = fbd_equations_get(all, 0);
    ANSWERS(fbd_assemble, !fbd_assemble(NULL));
    ANSWERS(fbd_assemble_components, !fbd_assemble_components(NULL));
    ENDURES(fbd_equations_free, fbd_equations_free(NULL));
    ANSWERS(fbd_equations_count, fbd_equations_count(NULL) == 0);
    ANSWERS(fbd_equations_get, !fbd_equations_get(NULL, 0).body);
    ANSWERS(fbd_equations_get, is_nan(fbd_equations_get(all, past).sum));
    ANSWERS(fbd_equations_find, !fbd_equations_find(NULL, "block.x").body);
    ANSWERS(fbd_equations_find, !fbd_equations_find(all, NULL).body);
    ANSWERS(fbd_equation_term, is_nan(fbd_equation_term(NULL, "spring")));
    ANSWERS(fbd_equation_term, is_nan(fbd_equation_term(&first, NULL)));
    fbd_equations_options written = {.format = (fbd_format)(FBD_MATHML + 1)};
    REFUSES(fbd_equations_write, !fbd_equations_write(NULL, NULL, errors));
    REFUSES(fbd_equations_write, !fbd_equations_write(state, &written, errors));
    written = (fbd_equations_options){.size = 1};
    REFUSES(fbd_equations_write, !fbd_equations_write(state, &written, errors));
    fbd_equations_free(all);
    fbd_state_free(state);
}

static void simulations(void **context)
{
    (void)context;
    fbd_simulation *simulation = fbd_simulation_new(model, NULL, errors);
    fbd_state *state = fbd_state_new(model), *foreign = fbd_state_new(other);
    double from = 1, to = 1, bars[2];
    assert_non_null(simulation);
    REFUSES(fbd_simulation_new, !fbd_simulation_new(NULL, NULL, errors));
    REFUSES(fbd_simulation_again, !fbd_simulation_again(NULL, true, errors));
    REFUSES(fbd_simulation_from, !fbd_simulation_from(NULL, NULL, errors));
    ENDURES(fbd_simulation_free, fbd_simulation_free(NULL));
    ANSWERS(fbd_simulation_advance, fbd_simulation_advance(NULL) == FBD_FAILED);
    ENDURES(fbd_simulation_interval, fbd_simulation_interval(NULL, &from, &to));
    assert_true(is_nan(from) && is_nan(to));
    ENDURES(fbd_simulation_interval, fbd_simulation_interval(simulation, NULL, NULL));
    REFUSES(fbd_simulation_set_input, !fbd_simulation_set_input(NULL, 0, "F", 1, errors));
    REFUSES(fbd_simulation_set_input, !fbd_simulation_set_input(simulation, 0, NULL, 1, errors));
    REFUSES(fbd_simulation_set_input, !fbd_simulation_set_input(simulation, 0, "F", NAN, errors));
    ANSWERS(fbd_simulation_state, !fbd_simulation_state(NULL, 0, state));
    ANSWERS(fbd_simulation_state, !fbd_simulation_state(simulation, 0, NULL));
    ANSWERS(fbd_simulation_state, !fbd_simulation_state(simulation, 0, foreign));
    ANSWERS(fbd_simulation_state, !fbd_simulation_state(simulation, NAN, state));
    ANSWERS(fbd_simulation_errors, !fbd_simulation_errors(NULL, 0, bars));
    ANSWERS(fbd_simulation_errors, !fbd_simulation_errors(simulation, 0, NULL));
    ANSWERS(fbd_simulation_event_count, fbd_simulation_event_count(NULL) == 0);
    ANSWERS(fbd_simulation_event, is_nan(fbd_simulation_event(NULL, 0).t));
    ANSWERS(fbd_simulation_event, is_nan(fbd_simulation_event(simulation, past).t));
    ANSWERS(fbd_simulation_stats, fbd_simulation_stats(NULL).steps == 0 && fbd_simulation_stats(NULL).method);
    ANSWERS(fbd_simulation_drift, fbd_simulation_drift(NULL).rows == 0 && fbd_simulation_drift(NULL).worst);
    ANSWERS(fbd_simulation_reason, strcmp(fbd_simulation_reason(NULL), "") == 0);
    ANSWERS(fbd_simulation_balanced, !fbd_simulation_balanced(NULL, NULL, NULL));
    ANSWERS(fbd_simulation_blame, !fbd_simulation_blame(NULL, NULL));
    ANSWERS(fbd_simulation_run, !fbd_simulation_run(NULL, NULL));
    ANSWERS(fbd_event_kind_name, strcmp(fbd_event_kind_name((fbd_event_kind)99), "") == 0);
    fbd_state_free(state);
    fbd_state_free(foreign);
    fbd_simulation_free(simulation);
}

static void fmus(void **context)
{
    (void)context;
    size_t length = 7;
    const fbd_setting nameless = {NULL, "3"};
    fbd_fmu_options options = {.library = "binary", .library_length = 6}, wrong = options;
    REFUSES(fbd_fmu, !fbd_fmu(NULL, &options, &length, errors));
    assert_int_equal(length, 0);
    REFUSES(fbd_fmu, !fbd_fmu(model, NULL, &length, errors));
    REFUSES(fbd_fmu, !fbd_fmu(model, &options, NULL, errors));
    wrong.library = NULL;
    REFUSES(fbd_fmu, !fbd_fmu(model, &wrong, &length, errors));
    wrong = options;
    wrong.setting_count = 1;
    REFUSES(fbd_fmu, !fbd_fmu(model, &wrong, &length, errors));
    wrong.settings = &nameless;
    REFUSES(fbd_fmu, !fbd_fmu(model, &wrong, &length, errors));
    wrong = options;
    wrong.version = 1;
    ANSWERS(fbd_fmu, !fbd_fmu(model, &wrong, &length, NULL));
    char *bytes = fbd_fmu(model, &options, &length, NULL);
    assert_true(bytes && length > 1000 && memcmp(bytes, "PK", 2) == 0);
    free(bytes);
}

static void results(void **context)
{
    (void)context;
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.error_bars = true;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    assert_non_null(result);
    ENDURES(fbd_result_free, fbd_result_free(NULL));
    ANSWERS(fbd_result_outcome, fbd_result_outcome(NULL) == FBD_FAILED);
    ANSWERS(fbd_result_table, fbd_result_table(NULL).columns == 0);
    ANSWERS(fbd_result_table, !fbd_result_table(result).values); /* it was not recorded */
    ANSWERS(fbd_result_state, !fbd_result_state(NULL));
    ANSWERS(fbd_result_energy, is_nan(fbd_result_energy(NULL).kinetic));
    ANSWERS(fbd_result_residual_explained, is_nan(fbd_result_residual_explained(NULL)));
    ANSWERS(fbd_result_work, is_nan(fbd_result_work(NULL, "block", "spring")));
    ANSWERS(fbd_result_work, is_nan(fbd_result_work(result, NULL, "spring")));
    ANSWERS(fbd_result_work, is_nan(fbd_result_work(result, "block", NULL)));
    ANSWERS(fbd_result_error, is_nan(fbd_result_error(NULL, "block.x")));
    ANSWERS(fbd_result_error, is_nan(fbd_result_error(result, NULL)));
    ANSWERS(fbd_result_energy_error, is_nan(fbd_result_energy_error(NULL).kinetic));
    ANSWERS(fbd_result_work_error, is_nan(fbd_result_work_error(NULL, "block", "spring")));
    ANSWERS(fbd_result_work_error, is_nan(fbd_result_work_error(result, NULL, NULL)));
    ANSWERS(fbd_result_force_errors, fbd_result_force_errors(NULL, 0, NULL, 0) == 0);
    ANSWERS(fbd_result_force_errors, fbd_result_force_errors(result, past, NULL, 3) == 0);
    ANSWERS(fbd_result_force_errors, fbd_result_force_errors(result, 0, NULL, 3) > 0);
    ANSWERS(fbd_result_accurate, !fbd_result_accurate(NULL));
    ANSWERS(fbd_result_balanced, !fbd_result_balanced(NULL, NULL, NULL));
    ANSWERS(fbd_result_report, !fbd_result_report(NULL, false));
    ANSWERS(fbd_result_json, !fbd_result_json(NULL));
    REFUSES(fbd_result_gnuplot, !fbd_result_gnuplot(NULL, NULL, NULL, errors));
    ANSWERS(fbd_has_html, fbd_has_html() || true);
    REFUSES(fbd_result_html, !fbd_result_html(NULL, errors));
    REFUSES(fbd_note_new, !fbd_note_new(NULL, result, NULL, errors));
    REFUSES(fbd_note_new, !fbd_note_new(simulation, NULL, NULL, errors));
    REFUSES(fbd_note_new, !fbd_note_new(simulation, result, &(fbd_note_options){.setting_count = 1}, errors));
    ENDURES(fbd_note_free, fbd_note_free(NULL));
    ANSWERS(fbd_note_write, !fbd_note_write(NULL, FBD_NOTE_HTML, "note"));
    ANSWERS(fbd_note_drawing_count, fbd_note_drawing_count(NULL) == 0);
    ANSWERS(fbd_note_drawing, !fbd_note_drawing(NULL, 0));
    ANSWERS(fbd_note_check_count, fbd_note_check_count(NULL) == 0);
    ANSWERS(fbd_note_failed_check_count, fbd_note_failed_check_count(NULL) == 0);
    ANSWERS(fbd_has_live, fbd_has_live() || true);
    REFUSES(fbd_result_live_html, !fbd_result_live_html(NULL, NULL, errors));
    REFUSES(fbd_result_page_data, !fbd_result_page_data(NULL, 0, errors));
    REFUSES(fbd_model_controls, !fbd_model_controls(NULL, errors));
    REFUSES(fbd_model_without, !fbd_model_without(NULL, NULL, 0, errors));
    REFUSES(fbd_model_without, !fbd_model_without(model, NULL, 1, errors));
    const fbd_pull no_pull = {.body = "b"};
    REFUSES(fbd_model_pulled, !fbd_model_pulled(NULL, &no_pull, errors));
    REFUSES(fbd_model_pulled, !fbd_model_pulled(model, NULL, errors));
    REFUSES(fbd_model_pulled, !fbd_model_pulled(model, &no_pull, errors));
    REFUSES(fbd_model_with_callbacks, !fbd_model_with_callbacks(NULL, NULL, 0, errors));
    REFUSES(fbd_model_with_callbacks, !fbd_model_with_callbacks(model, NULL, 1, errors));
    char *no_notes = fbd_errors_json(NULL);
    ANSWERS(fbd_errors_json, no_notes && strcmp(no_notes, "[]") == 0);
    fbd_free(no_notes);
    ANSWERS(fbd_errors_fix, !fbd_errors_fix(NULL, 0).replace);
    ANSWERS(fbd_errors_fix, !fbd_errors_fix(errors, past).replace);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
}

static void linearizations_and_derivations(void **context)
{
    (void)context;
    fbd_state *state = fbd_state_new(model);
    fbd_linearization *linear = fbd_linearize(state, errors);
    size_t differing = 7;
    assert_non_null(linear);
    REFUSES(fbd_linearize, !fbd_linearize(NULL, errors));
    ENDURES(fbd_linearization_free, fbd_linearization_free(NULL));
    ANSWERS(fbd_linearization_size, fbd_linearization_size(NULL) == 0);
    ANSWERS(fbd_linearization_model, !fbd_linearization_model(NULL));
    ANSWERS(fbd_linearization_matrix, !fbd_linearization_matrix(NULL));
    ANSWERS(fbd_linearization_coordinate, fbd_linearization_coordinate(NULL, 0) == (size_t)-1);
    ANSWERS(fbd_linearization_mode, is_nan(fbd_linearization_mode(NULL, 0).re));
    ANSWERS(fbd_linearization_mode, is_nan(fbd_linearization_mode(linear, past).im));
    ANSWERS(fbd_linearization_text, !fbd_linearization_text(NULL));
    ANSWERS(fbd_linearization_json, !fbd_linearization_json(NULL));
    ANSWERS(fbd_linearization_svg, !fbd_linearization_svg(NULL));
    REFUSES(fbd_linear_system_new, !fbd_linear_system_new(NULL, NULL, errors));
    REFUSES(fbd_linear_system_new,
            !fbd_linear_system_new(linear, &(fbd_linear_plan){.output_count = 1}, errors));
    REFUSES(fbd_transfer_new, !fbd_transfer_new(NULL, 0, 0, errors));
    ENDURES(fbd_linear_system_free, fbd_linear_system_free(NULL));
    ENDURES(fbd_transfer_free, fbd_transfer_free(NULL));
    ANSWERS(fbd_linear_system_input_count, fbd_linear_system_input_count(NULL) == 0);
    ANSWERS(fbd_linear_system_output_count, fbd_linear_system_output_count(NULL) == 0);
    ANSWERS(fbd_linear_system_input, !fbd_linear_system_input(NULL, 0).name);
    ANSWERS(fbd_linear_system_output, !fbd_linear_system_output(NULL, 0).name);
    ANSWERS(fbd_linear_system_input_matrix, !fbd_linear_system_input_matrix(NULL));
    ANSWERS(fbd_linear_system_output_matrix, !fbd_linear_system_output_matrix(NULL));
    ANSWERS(fbd_linear_system_feedthrough, !fbd_linear_system_feedthrough(NULL));
    ANSWERS(fbd_linear_system_response, !fbd_linear_system_response(NULL, 0, 0, NULL, 0, NULL));
    ANSWERS(fbd_linear_system_text, !fbd_linear_system_text(NULL));
    ANSWERS(fbd_linear_system_json, !fbd_linear_system_json(NULL));
    ANSWERS(fbd_linear_system_csv, !fbd_linear_system_csv(NULL));
    ANSWERS(fbd_linear_system_gnuplot, !fbd_linear_system_gnuplot(NULL, NULL));
    ANSWERS(fbd_check_hand, !fbd_check_hand(NULL, 1, &differing) && differing == 0);
    char *verdict = fbd_check_hand(model, 1, NULL);
    assert_non_null(verdict);
    ENDURES(fbd_free, fbd_free(verdict));
    fbd_free(NULL);
    fbd_linearization_free(linear);
    fbd_state_free(state);
}

static void statics(void **context)
{
    (void)context;
    fbd_state *state = fbd_state_new(model);
    fbd_statics *at_rest = fbd_statics_new(state, NULL);
    assert_non_null(at_rest);
    REFUSES(fbd_statics_new, !fbd_statics_new(NULL, errors));
    ENDURES(fbd_statics_free, fbd_statics_free(NULL));
    ANSWERS(fbd_statics_holds, !fbd_statics_holds(NULL));
    ANSWERS(fbd_statics_indeterminacy, fbd_statics_indeterminacy(NULL) == 0);
    ANSWERS(fbd_statics_mobility, fbd_statics_mobility(NULL) == 0);
    ANSWERS(fbd_statics_undetermined_count, fbd_statics_undetermined_count(NULL) == 0);
    ANSWERS(fbd_statics_undetermined, !fbd_statics_undetermined(NULL, 0));
    ANSWERS(fbd_statics_undetermined, !fbd_statics_undetermined(at_rest, past));
    ANSWERS(fbd_statics_unbalanced_count, fbd_statics_unbalanced_count(NULL) == 0);
    ANSWERS(fbd_statics_unbalanced, is_nan(fbd_statics_unbalanced(NULL, 0).holding));
    ANSWERS(fbd_statics_unbalanced, is_nan(fbd_statics_unbalanced(at_rest, past).holding));
    ANSWERS(fbd_statics_limit_count, fbd_statics_limit_count(NULL) == 0);
    ANSWERS(fbd_statics_limit, is_nan(fbd_statics_limit(NULL, 0).needed));
    ANSWERS(fbd_statics_limit, is_nan(fbd_statics_limit(at_rest, past).needed));
    ANSWERS(fbd_statics_member_count, fbd_statics_member_count(NULL) == 0);
    ANSWERS(fbd_statics_member, is_nan(fbd_statics_member(NULL, 0).tension));
    ANSWERS(fbd_statics_member, is_nan(fbd_statics_member(at_rest, past).tension));
    ANSWERS(fbd_statics_diagram, fbd_statics_diagram(NULL, 0, NULL, 0) == 0);
    ANSWERS(fbd_statics_diagram, fbd_statics_diagram(at_rest, past, NULL, 0) == 0);
    ANSWERS(fbd_statics_diagram, fbd_statics_diagram(at_rest, 0, NULL, 4) > 0);
    ANSWERS(fbd_statics_text, !fbd_statics_text(NULL));
    ANSWERS(fbd_statics_json, !fbd_statics_json(NULL));
    fbd_statics_free(at_rest);
    fbd_state_free(state);
}

/* ---- all of them */

static bool was_called(const char *name, size_t length)
{
    for (size_t i = 0; i < called_count; i++)
        if (strlen(called[i]) == length && strncmp(called[i], name, length) == 0) return true;
    return false;
}

/* Each declaration begins with FBD_API, and its name stands before the first parenthesis. */
static size_t check_header(const char *name, size_t *forgotten)
{
    char path[1000];
    static char text[200000];
    const char *root = getenv("FBD_SOURCE_ROOT");
    size_t functions = 0;
    snprintf(path, sizeof path, "%s/lib/%s", root ? root : ".", name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    size_t length = fread(text, 1, sizeof text - 1, file);
    assert_true(length < sizeof text - 1);
    text[length] = '\0';
    fclose(file);
    for (const char *at = text; (at = strstr(at, "\nFBD_API ")) != NULL;) {
        const char *end = at = strchr(at, '(');
        while (at[-1] == '_' || (at[-1] >= 'a' && at[-1] <= 'z')) at--;
        functions++;
        if (was_called(at, (size_t)(end - at))) continue;
        ++*forgotten;
        print_error("not called: %.*s\n", (int)(end - at), at);
    }
    return functions;
}

static void no_function_is_forgotten(void **context)
{
    (void)context;
    note("fbd_errors_new"); /* which ask for nothing */
    note("fbd_version");
    char *schema = fbd_schema();
    assert_non_null(schema);
    free(schema);
    note("fbd_schema");
    size_t forgotten = 0;
    size_t functions = 0;
    static const char *const headers[] = {"fbd.h",        "fbd_study.h", "fbd_grade.h",
                                          "fbd_export.h", "fbd_view.h",  "fbd_exchange.h"};
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        const size_t own = check_header(headers[i], &forgotten);
        assert_true(own > 10);
        functions += own;
    }
    assert_true(functions > 100);
    assert_int_equal(check_header("fbd_workers.h", &forgotten), 4);
    assert_int_equal(forgotten, 0);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_and_models),
        cmocka_unit_test(a_model_may_have_no_name),
        cmocka_unit_test(contents),
        cmocka_unit_test(views),
        cmocka_unit_test(states),
        cmocka_unit_test(equations),
        cmocka_unit_test(simulations),
        cmocka_unit_test(fmus),
        cmocka_unit_test(exchanges),
        cmocka_unit_test(results),
        cmocka_unit_test(linearizations_and_derivations),
        cmocka_unit_test(statics),
        cmocka_unit_test(sweeps_that_cannot_be_made),
        cmocka_unit_test(sections),
        cmocka_unit_test(searches),
        cmocka_unit_test(fits),
        cmocka_unit_test(sweeps),
        cmocka_unit_test(studies),
        cmocka_unit_test(methods_and_simplifications),
        cmocka_unit_test(grades),
        cmocka_unit_test(a_key_without_an_answer),
        cmocka_unit_test(derivations),
        cmocka_unit_test(bodies_and_forces),
        cmocka_unit_test(states_for_comparison),
        cmocka_unit_test(options_have_a_size),
        cmocka_unit_test(options_are_filled_with_defaults),
        cmocka_unit_test(progress_ends_what_is_under_way),
        cmocka_unit_test(no_function_is_forgotten),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
