/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Inputs by callbacks of the program against the same laws written as expressions in the file: motion with all methods,
 * events, friction, jointed bodies, equilibrium; what is refused, and what the report says.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "fbd_export.h"
#include "fbd_grade.h"
#include "fbd_linear.h"
#include "fbd_study.h"
#include "fbd_view.h"
#include "gallery.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- a pole on a pivot, a cart with a pole, a block with friction: %s is the law */

#define POLE                                                                                                 \
    "fbd: 1\ninputs: {M: 0 N*m}\nbodies:\n  pole:\n    motion: {pivot: {at: [0, 0]}}\n"                      \
    "    parts: {rod: {shape: rod, mass: 2 kg, from: [0, 0], to: [0, 1 m]}}\n"                               \
    "    initial: {theta: 10 deg}\n    forces: [gravity]\n    moments: [applied: {name: motor, value: "      \
    "'LAW'}]\n"                                                                                              \
    "simulate: {until: 3 s, events: [{name: half, when: 'theta = 5 deg'}]}\n"
#define CART                                                                                                 \
    "fbd: 1\ninputs: {F: 0 N}\nbodies:\n  cart: {mass: 2 kg, motion: slide, forces: [applied: {value: "      \
    "'LAW'}]}\n"                                                                                             \
    "  pole:\n    motion: {pivot: {on: cart, at: [0, 0]}}\n"                                                 \
    "    parts: {rod: {shape: rod, mass: 0.5 kg, from: [0, 0], to: [0, 1 m]}}\n"                             \
    "    initial: {theta: 5 deg}\n    forces: [gravity]\nsimulate: {until: 2 s}\n"
#define BLOCK                                                                                                \
    "fbd: 1\ninputs: {F: 0 N}\nbodies:\n  block:\n    mass: 2 kg\n    motion: slide\n"                       \
    "    forces: [gravity, normal, friction: {static: 0.3, kinetic: 0.2}, applied: {value: 'LAW'}]\n"        \
    "simulate: {until: 6 s}\n"

struct law {
    double calls, gain;
};

static int pd_of_pole(void *context, double t, const double *y, double *value)
{
    struct law *law = context;
    (void)t;
    law->calls++;
    *value = -law->gain * y[0] - 8 * y[1];
    return 0;
}

static int feedback_of_cart(void *context, double t, const double *y, double *value)
{
    struct law *law = context;
    law->calls++;
    *value = 60 * sin(y[1]) + 12 * y[3] + 2 * y[0] + sin(t);
    return 0;
}

static int rising_push(void *context, double t, const double *y, double *value)
{
    struct law *law = context;
    (void)y;
    law->calls++;
    *value = 10 * sin(2 * t);
    return 0;
}

static int no_force(void *context, double t, const double *y, double *value)
{
    (void)context, (void)y;
    *value = 0;
    return t > 1;
}

static char *text_with(const char *scene, const char *law)
{
    const char *at = strstr(scene, "LAW");
    const size_t size = strlen(scene) + strlen(law) + 1;
    assert_non_null(at);
    char *text = malloc(size);
    assert_non_null(text);
    snprintf(text, size, "%.*s%s%s", (int)(at - scene), scene, law, at + strlen("LAW"));
    return text;
}

static fbd_model *model_of(const char *scene, const char *law)
{
    fbd_errors *errors = fbd_errors_new();
    char *text = text_with(scene, law);
    fbd_model *model = fbd_model_parse(text, strlen(text), "scene.yaml", NULL, 0, errors);
    if (!model) print_error("%s\n", fbd_errors_get(errors, 0).message);
    assert_non_null(model);
    free(text);
    fbd_errors_free(errors);
    return model;
}

static fbd_model *called(const char *scene, const char *input, fbd_force_callback *function, void *context)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *plain = model_of(scene, input);
    const fbd_callback callback = {input, function, context};
    fbd_model *model = fbd_model_with_callbacks(plain, &callback, 1, errors);
    assert_non_null(model);
    fbd_model_free(plain); /* the other one does not depend on it */
    fbd_errors_free(errors);
    return model;
}

struct ran {
    fbd_simulation *simulation;
    fbd_result *result;
};

static struct ran run(const fbd_model *model, const char *method, bool bars)
{
    fbd_errors *errors = fbd_errors_new();
    const fbd_options options = {sizeof options, NAN, 0, 0, method, bars, 0, false, false};
    const fbd_recording recording = {.size = sizeof recording, .ledger = true};
    struct ran ran = {fbd_simulation_new(model, &options, errors), NULL};
    assert_non_null(ran.simulation);
    ran.result = fbd_simulation_run(ran.simulation, &recording);
    assert_non_null(ran.result);
    fbd_errors_free(errors);
    return ran;
}

static void end(struct ran *ran)
{
    fbd_result_free(ran->result);
    fbd_simulation_free(ran->simulation);
}

/* Both runs have the same outcome, events at the same times, and the same end. */
static void compare(struct checks *checks, const fbd_model *by_call, const fbd_model *by_law,
                    const char *method, double tolerance)
{
    struct ran got = run(by_call, method, false), want = run(by_law, method, false);
    const size_t events = fbd_simulation_event_count(want.simulation), n = fbd_model_coordinate_count(by_law);
    assert_int_equal(fbd_result_outcome(got.result), FBD_DONE);
    assert_int_equal(fbd_result_outcome(want.result), FBD_DONE);
    assert_true(n > 0);
    assert_int_equal(fbd_simulation_event_count(got.simulation), events);
    for (size_t i = 0; i < events; i++) {
        const fbd_event a = fbd_simulation_event(got.simulation, i),
                        b = fbd_simulation_event(want.simulation, i);
        assert_int_equal(a.kind, b.kind);
        check_close(checks, "time of an event", a.t, b.t, tolerance);
    }
    for (size_t k = 0; k < 2 * n; k++) {
        const fbd_coordinate c = fbd_model_coordinate(by_law, k % n);
        double x = NAN, y = NAN;
        fbd_state_get(fbd_result_state(got.result), k < n ? c.name : c.rate_name, &x);
        fbd_state_get(fbd_result_state(want.result), k < n ? c.name : c.rate_name, &y);
        check_close(checks, k < n ? c.name : c.rate_name, x, y, tolerance);
    }
    const fbd_energy a = fbd_result_energy(got.result), b = fbd_result_energy(want.result);
    check_close(checks, "work", a.work, b.work, 100 * tolerance);
    assert_true(fbd_result_balanced(got.result, NULL, NULL));
    end(&got);
    end(&want);
}

/* Explicit and implicit methods, at the tolerance 1e-10 of a step: motions of size 1, so ends within 1e-7. */
static void a_callback_moves_as_its_law(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct law pole = {0, 40}, cart = {0, 0}, block = {0, 0};
    const char *const methods[] = {"auto", "rk8pd", "msbdf", "rk4imp"};
    fbd_model *got[] = {called(POLE, "M", pd_of_pole, &pole), called(CART, "F", feedback_of_cart, &cart),
                        called(BLOCK, "F", rising_push, &block)};
    fbd_model *want[] = {
        model_of(POLE, "-40[N*m]*theta - 8[N*m*s]*omega"),
        model_of(CART, "60[N]*sin(pole.theta) + 12[N*s]*pole.omega + 2[N/m]*x + 1[N]*sin(t*1[1/s])"),
        model_of(BLOCK, "10[N]*sin(2[1/s]*t)")};
    for (size_t i = 0; i < 3; i++)
        for (size_t k = 0; k < 4; k++) compare(&checks, got[i], want[i], methods[k], 1e-7);
    assert_true(pole.calls > 100 && cart.calls > 100 && block.calls > 100);
    for (size_t i = 0; i < 3; i++) {
        fbd_model_free(got[i]);
        fbd_model_free(want[i]);
    }
    checks_end(&checks);
}

/* The error of a run is within a few times its error bar, whose second run calls the callback as well. */
static void error_bars_call_it_again(void **unused)
{
    (void)unused;
    struct law law = {0, 40};
    fbd_model *model = called(POLE, "M", pd_of_pole, &law);
    struct ran plain = run(model, NULL, false);
    const double alone = law.calls;
    law.calls = 0;
    struct ran bars = run(model, NULL, true);
    const fbd_stats stats = fbd_simulation_stats(bars.simulation);
    assert_true(law.calls > 1.5 * alone);
    assert_true(stats.error_estimate > 0 && stats.error_estimate < 1e-7);
    char *report = fbd_result_report(bars.result, true);
    assert_non_null(report);
    assert_non_null(strstr(report, "an input by a callback of the program"));
    assert_non_null(strstr(report, "come from outside the file"));
    fbd_free(report);
    end(&plain);
    end(&bars);
    fbd_model_free(model);
}

static void its_value_is_that_at_the_state(void **unused)
{
    (void)unused;
    struct law law = {0, 40};
    fbd_model *model = called(POLE, "M", pd_of_pole, &law);
    fbd_state *state = fbd_state_new(model);
    double values[32];
    fbd_state_set(state, "pole.theta", 0.5);
    fbd_state_set(state, "pole.omega", 0.25);
    fbd_state_variables(state, values, 32);
    assert_string_equal(fbd_model_variable(model, 1).name, "M");
    assert_true(values[1] == -40 * 0.5 - 8 * 0.25);
    assert_true(isnan(fbd_model_parameter(model, 0).value));
    fbd_equations *equations = fbd_assemble(state);
    const fbd_equation equation = fbd_equations_find(equations, "pole.theta");
    assert_true(fbd_equation_term(&equation, "motor") == values[1]);
    fbd_equations_free(equations);
    fbd_state_free(state);
    fbd_model_free(model);
}

/* The closed loop, linearized: a22 = -8/I_O with I_O = m L^2/3; central differences are exact for a linear law. */
static void it_is_linearized_by_differences(void **unused)
{
    (void)unused;
    struct law law = {0, 40};
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = called(POLE, "M", pd_of_pole, &law);
    fbd_state *state = fbd_state_new(model);
    fbd_state_set(state, "pole.theta", 0);
    fbd_linearization *linear = fbd_linearize(state, errors);
    assert_non_null(linear);
    const double *A = fbd_linearization_matrix(linear), I_O = 2.0 / 3;
    assert_true(fabs(A[3] + 8 / I_O) < 1e-8);
    assert_true(fabs(A[2] - (2 * 9.81 * 0.5 - 40) / I_O) < 1e-7);
    assert_null(fbd_linear_system_new(linear, NULL, errors));
    assert_string_equal(fbd_errors_get(errors, fbd_errors_count(errors) - 1).id, "no-derivatives");
    const size_t input = 1;
    double derivative;
    assert_false(fbd_state_derivatives(state, &input, 1, &derivative, errors));
    assert_null(fbd_emit_c(model, NULL, errors));
    fbd_linearization_free(linear);
    fbd_state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
}

#define DERIVED(LINE)                                                                                        \
    "fbd: 1\nparameters: {m: 2 kg, k: 50 N/m}\ninputs: {F: 5 N}\nbodies:\n  block:\n    mass: m\n    "       \
    "motion: slide\n"                                                                                        \
    "    forces: [spring: {stiffness: k}, applied: {value: 'LAW'}]\n"                                        \
    "    hand: '" LINE "'\nsimulate: {until: 1 s}\n"

static int rising_with_x(void *context, double t, const double *y, double *value)
{
    (void)context;
    *value = 5 + 20 * y[0] * y[0] + t;
    return 0;
}

static size_t differing(const fbd_model *model)
{
    size_t count = 99;
    fbd_free(fbd_check_hand(model, 1, &count));
    return count;
}

/* A derivation that names the input is compared with the value of the callback; one with the number of the file differs. */
static void a_derivation_has_its_value(void **unused)
{
    (void)unused;
    const char *scenes[] = {DERIVED("m*v_dot = F - k*x"), DERIVED("m*v_dot = 5[N] - k*x")};
    for (size_t wrong = 0; wrong < 2; wrong++) {
        fbd_model *model = called(scenes[wrong], "F", rising_with_x, NULL),
                  *held = called(scenes[wrong], "F", NULL, NULL);
        assert_int_equal(differing(model), wrong);
        assert_int_equal(differing(held), wrong);
        fbd_model_free(model);
        fbd_model_free(held);
    }
}

/* A closed form of the file holds for its constants. */
static void a_closed_form_is_that_of_constants(void **unused)
{
    (void)unused;
    static const char push[] =
        "fbd: 1\n"
        "inputs: {F: 2 N}\n"
        "bodies:\n"
        "  b: {mass: 1 kg, motion: {slide: {along: 0 deg}},\n"
        "      forces: [{applied: {name: F, value: LAW}}], exact: {x: \"1[m/s^2]*t^2\"}}\n"
        "simulate: {until: 1 s}\n";
    double value, derivative;
    fbd_model *constant = model_of(push, "F"), *model = called(push, "F", no_force, NULL);
    assert_true(fbd_model_exact(constant, 0, 1, &value, &derivative) && value == 1 && derivative == 2);
    assert_false(fbd_model_exact(model, 0, 1, &value, &derivative));
    fbd_model_free(constant);
    fbd_model_free(model);
}

static void a_callback_that_fails_ends_the_run(void **unused)
{
    (void)unused;
    fbd_model *model = called(POLE, "M", no_force, NULL);
    struct ran ran = run(model, NULL, false);
    assert_int_equal(fbd_result_outcome(ran.result), FBD_FAILED);
    assert_non_null(strstr(fbd_simulation_reason(ran.simulation), "not finite"));
    end(&ran);
    fbd_model_free(model);
}

static void wrong_names_are_refused(void **unused)
{
    (void)unused;
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = model_of(POLE, "M");
    const fbd_callback unknown = {"N", pd_of_pole, NULL}, none = {NULL, pd_of_pole, NULL};
    assert_null(fbd_model_with_callbacks(model, &unknown, 1, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, "unknown-input");
    assert_null(fbd_model_with_callbacks(model, &none, 1, errors));
    assert_string_equal(fbd_errors_get(errors, 1).id, "bad-call");
    assert_null(fbd_model_with_callbacks(NULL, &unknown, 1, NULL));
    fbd_model_free(model);
    fbd_errors_free(errors);
}

/* An FMU would have the value of the file, which it is not. */
static void an_fmu_is_refused(void **unused)
{
    (void)unused;
    size_t length;
    fbd_errors *errors = fbd_errors_new();
    fbd_model *plain = model_of(POLE, "M"), *model = called(POLE, "M", no_force, NULL);
    const fbd_callback held = {"M", NULL, NULL};
    fbd_model *set = fbd_model_with_callbacks(plain, &held, 1, errors);
    const fbd_fmu_options options = {.library = "binary", .library_length = 6};
    assert_null(fbd_fmu(model, &options, &length, errors));
    assert_non_null(strstr(fbd_errors_get(errors, 0).message, "the input `M` is computed by a callback"));
    char *bytes = fbd_fmu(set, &options, &length, errors);
    assert_non_null(bytes);
    fbd_free(bytes);
    fbd_model_free(set);
    fbd_model_free(model);
    fbd_model_free(plain);
    fbd_errors_free(errors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_callback_moves_as_its_law),
        cmocka_unit_test(error_bars_call_it_again),
        cmocka_unit_test(its_value_is_that_at_the_state),
        cmocka_unit_test(it_is_linearized_by_differences),
        cmocka_unit_test(a_derivation_has_its_value),
        cmocka_unit_test(a_closed_form_is_that_of_constants),
        cmocka_unit_test(a_callback_that_fails_ends_the_run),
        cmocka_unit_test(wrong_names_are_refused),
        cmocka_unit_test(an_fmu_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
