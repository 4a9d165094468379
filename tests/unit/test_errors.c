/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lists of errors: no call of the public interface needs one, and none minds what an earlier call has left in
 * it. And numbers past the end of what they count.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <stdlib.h>
#include <string.h>

#include "fbd_export.h"
#include "fbd_study.h"
#include "fbd_view.h"
#include "scenes.h"

static const char right[] = "fbd: 1\n"
                            "parameters: {k: 8 N/m}\n"
                            "bodies:\n"
                            "  cart:\n"
                            "    mass: 2 kg\n"
                            "    motion: {slide: {along: 0 deg}}\n"
                            "    initial: {x: 0.1 m}\n"
                            "    forces: [{spring: {stiffness: k}}]\n"
                            "simulate: {until: 0.1 s}\n";

static const char wrong[] = "fbd: 1\nbodies: {cart: {mas: 1}}\n";

static fbd_model *parse(const char *text, fbd_errors *errors)
{
    return fbd_model_parse(text, strlen(text), "given.yaml", NULL, 0, errors);
}

/* A text of the library is there; it is freed. */
static void assert_text(char *text)
{
    assert_non_null(text);
    free(text);
}

static void models_and_states_need_no_list(void **unused)
{
    (void)unused;
    assert_null(parse(wrong, NULL));
    assert_null(fbd_model_read("/there/is/no/such/file", NULL, 0, NULL));
    fbd_model *model = parse(right, NULL);
    assert_non_null(model);
    assert_true(fbd_model_has_columns(model, "cart.x", NULL));
    assert_false(fbd_model_has_columns(model, "cart.y", NULL));
    fbd_state *state = fbd_state_new(model);
    assert_true(fbd_state_set_text(state, "x", "2 cm", NULL));
    assert_false(fbd_state_set_text(state, "x", "2 s", NULL));
    assert_false(fbd_state_set_text(state, "y", "2 m", NULL));
    assert_text(fbd_diagram_svg(state, NULL, NULL));
    assert_null(fbd_diagram_svg(state, &(fbd_drawing){.body = "wagon"}, NULL));
    fbd_linearization *linear = fbd_linearize(state, NULL);
    assert_non_null(linear);
    fbd_linearization_free(linear);
    fbd_statics *statics = fbd_statics_new(state, NULL);
    assert_non_null(statics);
    fbd_statics_free(statics);
    assert_true(fbd_find_equilibrium(state, NULL));
    fbd_state_free(state);
    fbd_model_free(model);
}

static void runs_need_no_list(void **unused)
{
    (void)unused;
    fbd_model *model = model_from(right);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = "dop854";
    assert_null(fbd_simulation_new(model, &options, NULL));
    options.method = NULL;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    assert_non_null(simulation);
    fbd_result *result = fbd_simulation_run(simulation, &(fbd_recording){.keep = true});
    assert_non_null(result);
    assert_text(fbd_result_gnuplot(result, NULL, NULL, NULL));
    assert_null(fbd_result_gnuplot(result, NULL, "cart.y", NULL));
    char *page = fbd_result_html(result, NULL);
    assert_true(fbd_has_html() == (page != NULL));
    free(page);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

static void studies_need_no_list(void **unused)
{
    (void)unused;
    const char *vary = "k=1:2 N/m:2", *unknown = "c=1,2", *quantity = "cart.y", *method = "rkf45";
    const fbd_sweep_plan plan = {.vary = &vary, .vary_count = 1};
    const fbd_sweep_plan bad = {.vary = &unknown, .vary_count = 1};
    fbd_sweep *sweep = fbd_sweep_parse(right, strlen(right), "given.yaml", &plan, NULL);
    assert_non_null(sweep);
    fbd_sweep_free(sweep);
    assert_null(fbd_sweep_parse(right, strlen(right), "given.yaml", &bad, NULL));
    assert_null(fbd_sweep_read("/there/is/no/such/file", &plan, NULL));

    fbd_model *model = model_from(right);
    fbd_cost_options options = FBD_COST_OPTIONS_DEFAULT;
    options.budget = 0.1;
    options.methods = &method;
    options.method_count = 1;
    fbd_cost *cost = fbd_cost_new(model, &options, NULL);
    assert_non_null(cost);
    fbd_cost_free(cost);
    fbd_effects *effects = fbd_effects_new(model, &options, NULL);
    assert_non_null(effects);
    fbd_effects_free(effects);
    options.quantities = &quantity;
    options.quantity_count = 1;
    assert_null(fbd_cost_new(model, &options, NULL));
    assert_null(fbd_effects_new(model, &options, NULL));
    fbd_model_free(model);
}

static void a_list_that_is_not_there_is_empty(void **unused)
{
    (void)unused;
    assert_int_equal(fbd_errors_count(NULL), 0);
    assert_int_equal(fbd_errors_failed_count(NULL), 0);
    assert_null(fbd_errors_get(NULL, 0).id);
    fbd_errors_print(NULL, stderr);
    fbd_errors_free(NULL);
}

static void errors_of_an_earlier_call_do_not_count_in_the_next(void **unused)
{
    (void)unused;
    fbd_errors *errors = fbd_errors_new();
    assert_null(parse(wrong, errors));
    size_t failed = fbd_errors_failed_count(errors);
    assert_true(failed > 0);
    fbd_model *model = parse(right, errors);
    assert_non_null(model);
    assert_int_equal(fbd_errors_failed_count(errors), failed);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = -1;
    assert_null(fbd_simulation_new(model, &options, errors));
    assert_int_equal(fbd_errors_failed_count(errors), failed + 1);
    fbd_model_free(model);
    fbd_errors_free(errors);
}

/* The list is printed last, when model and state are gone (under the sanitizers this would show). */
static void notes_outlive_what_they_are_about(void **unused)
{
    (void)unused;
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = parse(right, errors);
    fbd_state *state = fbd_state_new(model);
    assert_false(fbd_state_set_text(state, "x", "2 s", errors));
    assert_false(fbd_model_has_columns(model, "cart.y", errors));
    fbd_state_free(state);
    fbd_model_free(model);
    assert_int_equal(fbd_errors_count(errors), 2);
    for (size_t i = 0; i < 2; i++) assert_string_equal(fbd_errors_get(errors, i).file, "given.yaml");
    fbd_errors_free(errors);
}

/* ---- past the end */

static void what_is_past_the_end_is_nothing(void **unused)
{
    (void)unused;
    const size_t past = 1, far_past = SIZE_MAX;
    fbd_model *model = model_from(right);
    fbd_state *state = fbd_state_new(model);
    fbd_arrow arrow;
    assert_null(fbd_model_body_name(model, past));
    assert_true(isnan(fbd_model_inertia(model, past).mass));
    assert_null(fbd_model_coordinate(model, past).name);
    assert_int_equal(fbd_model_coordinate(model, far_past).body, fbd_model_body_count(model));
    assert_int_equal(fbd_diagram(state, past, &arrow, 1), 0);
    fbd_linearization *linear = fbd_linearize(state, NULL);
    assert_true(isnan(fbd_linearization_mode(linear, 2).frequency));
    fbd_linearization_free(linear);
    fbd_equations *equations = fbd_assemble(state);
    assert_null(fbd_equations_get(equations, past).body);
    fbd_equations_free(equations);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.error_bars = true;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    assert_true(isnan(fbd_simulation_event(simulation, 0).t));
    assert_int_equal(fbd_result_force_errors(result, past, &arrow, 1), 0);
    assert_true(isnan(fbd_result_work(result, "cart", "rope")) && isnan(fbd_result_error(result, "cart.y")));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void a_study_has_nothing_past_its_end(void **unused)
{
    (void)unused;
    const char *method = "rkf45";
    fbd_model *model = model_from(right);
    fbd_cost_options options = FBD_COST_OPTIONS_DEFAULT;
    options.budget = 0.1;
    options.methods = &method;
    options.method_count = 1;
    fbd_cost *cost = fbd_cost_new(model, &options, NULL);
    assert_int_equal(fbd_cost_series_count(cost), 1);
    assert_int_equal(fbd_cost_series(cost, 1).count, 0);
    assert_null(fbd_cost_point(cost, fbd_cost_point_count(cost)).method);
    fbd_cost_free(cost);
    fbd_effects *effects = fbd_effects_new(model, &options, NULL);
    assert_null(fbd_effects_get(effects, fbd_effects_count(effects)).name);
    fbd_effects_free(effects);
    fbd_model_free(model);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_and_states_need_no_list),
        cmocka_unit_test(runs_need_no_list),
        cmocka_unit_test(studies_need_no_list),
        cmocka_unit_test(a_list_that_is_not_there_is_empty),
        cmocka_unit_test(errors_of_an_earlier_call_do_not_count_in_the_next),
        cmocka_unit_test(notes_outlive_what_they_are_about),
        cmocka_unit_test(what_is_past_the_end_is_nothing),
        cmocka_unit_test(a_study_has_nothing_past_its_end),
    };
    return cmocka_run_group_tests_name("errors", tests, NULL, NULL);
}
