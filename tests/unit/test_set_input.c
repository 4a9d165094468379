/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Inputs that are set between the steps of a simulation, against closed forms: a motor, a spring, a block that breaks away
 * and comes to rest; events, balance of energy, states; and what is refused.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "fbd_export.h"
#include "fbd_linear.h"
#include "fbd_study.h"
#include "fbd_view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double g = 9.81;

#define WHEEL                                                                                                \
    "fbd: 1\ninputs: {M: 0 N*m}\nbodies:\n  wheel: {shape: disc, mass: 2 kg, radius: 0.5 m, motion: pivot, " \
    "moments: [applied: {name: motor, value: M}]}\nsimulate: {until: 3 s}\n"
#define SPRING                                                                                               \
    "fbd: 1\ninputs: {F: 5 N, G: 0 N}\nbodies:\n  block:\n    mass: 2 kg\n    motion: slide\n"               \
    "    forces: [spring: {stiffness: 50 N/m}, applied: {name: push, value: F}, applied: {name: pull, "      \
    "value: G}]\n"                                                                                           \
    "    initial: {x: 0.3 m}\nsimulate: {until: 4 s, events: [{name: middle, when: 'x = 0.1', direction: "   \
    "falling}]}\n"
#define BLOCK                                                                                                \
    "fbd: 1\ninputs: {F: 5 N}\nbodies:\n  block:\n    mass: 2 kg\n    motion: slide\n"                       \
    "    forces: [gravity, normal, friction: {static: 0.3, kinetic: 0.2}, applied: {value: F}]\n"            \
    "simulate: {until: 6 s}\n"

static fbd_model *settable(const char *text, const char *input, const char *second)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *plain = fbd_model_parse(text, strlen(text), "scene.yaml", NULL, 0, errors);
    if (!plain) print_error("%s\n", fbd_errors_get(errors, 0).message);
    assert_non_null(plain);
    const fbd_callback held[] = {{input, NULL, NULL}, {second, NULL, NULL}};
    fbd_model *model = fbd_model_with_callbacks(plain, held, second ? 2 : 1, errors);
    assert_non_null(model);
    fbd_model_free(plain);
    fbd_errors_free(errors);
    return model;
}

static void near(double value, double wanted, double tolerance)
{
    if (!(fabs(value - wanted) <= tolerance)) fail_msg("%.12g instead of %.12g", value, wanted);
}

static fbd_simulation *begun(const fbd_model *model)
{
    fbd_simulation *simulation = fbd_simulation_new(model, NULL, NULL);
    assert_non_null(simulation);
    return simulation;
}

/* Advance until t lies in the last step; a quantity there. */
static double at(fbd_simulation *simulation, fbd_state *state, double t, const char *name)
{
    double from, to, value = NAN;
    fbd_simulation_interval(simulation, &from, &to);
    while (to < t && fbd_simulation_advance(simulation) == FBD_GOING)
        fbd_simulation_interval(simulation, &from, &to);
    assert_true(fbd_simulation_state(simulation, t, state));
    assert_true(fbd_state_get(state, name, &value));
    return value;
}

static void set(fbd_simulation *simulation, double t, const char *name, double value)
{
    fbd_errors *errors = fbd_errors_new();
    if (!fbd_simulation_set_input(simulation, t, name, value, errors))
        fail_msg("%s", fbd_errors_get(errors, 0).message);
    fbd_errors_free(errors);
}

/* Motions under constant and linear forces are exact up to rounding, as with the input as a constant. */
static const double close_to = 1e-12;

static void a_motor_is_switched(void **unused)
{
    (void)unused;
    fbd_model *model = settable(WHEEL, "M", NULL);
    fbd_simulation *simulation = begun(model);
    fbd_state *state = fbd_state_new(model);
    const double I = 0.25, moments[] = {0, 2, -1, 0.5}, times[] = {0, 0.3, 0.8, 1.7, 2.5};
    double theta = 0, omega = 0;
    for (int k = 0; k < 4; k++) {
        const double h = times[k + 1] - times[k], alpha = moments[k] / I;
        set(simulation, times[k], "M", moments[k]);
        theta += omega * h + alpha * h * h / 2;
        omega += alpha * h;
        near(at(simulation, state, times[k + 1], "wheel.theta"), theta, close_to);
        near(at(simulation, state, times[k + 1], "wheel.omega"), omega, close_to);
        near(at(simulation, state, times[k + 1], "M"), moments[k], 0);
    }
    assert_true(fbd_simulation_balanced(simulation, NULL, NULL));
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

/* At the end of the run, and a rounding before it, the speed remains. */
static void an_input_is_set_at_the_end(void **unused)
{
    (void)unused;
    const double ends[] = {3, nextafter(3, 0)};
    fbd_model *model = settable(WHEEL, "M", NULL);
    fbd_state *state = fbd_state_new(model);
    for (int k = 0; k < 2; k++) {
        fbd_simulation *simulation = begun(model);
        set(simulation, 0, "M", 2);
        near(at(simulation, state, ends[k], "wheel.omega"), 24, close_to);
        set(simulation, ends[k], "M", 1);
        near(at(simulation, state, ends[k], "wheel.omega"), 24, close_to);
        near(at(simulation, state, ends[k], "wheel.theta"), 36, close_to);
        fbd_simulation_free(simulation);
    }
    fbd_state_free(state);
    fbd_model_free(model);
}

/* x'' = F/m - (k/m) x, with k/m = 25/s^2: x and v after h. */
static void swing(double *x, double *v, double F, double h)
{
    const double rest = F / 50, from = *x - rest;
    *x = rest + from * cos(5 * h) + *v / 5 * sin(5 * h);
    *v = -5 * from * sin(5 * h) + *v * cos(5 * h);
}

static void forces_of_two_inputs_are_switched(void **unused)
{
    (void)unused;
    fbd_model *model = settable(SPRING, "F", "G");
    fbd_simulation *simulation = begun(model);
    fbd_state *state = fbd_state_new(model);
    double x = 0.3, v = 0, F = 5, G = 0;
    unsigned long steps = 0;
    for (int i = 1; i <= 20; i++) {
        const double t = 0.1 * i;
        near(at(simulation, state, t, "block.x"), (swing(&x, &v, F + G, 0.1), x), close_to);
        near(at(simulation, state, t, "block.v"), v, 5 * close_to);
        F = 20 * sin(i);
        G = i % 3;
        set(simulation, t, "F", F);
        set(simulation, t, "G", G);
        assert_true(fbd_simulation_stats(simulation).steps > steps);
        steps = fbd_simulation_stats(simulation).steps;
    }
    assert_true(fbd_simulation_balanced(simulation, NULL, NULL));
    assert_null(fbd_simulation_again(simulation, false, NULL));
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

/* From x = 0.3 m at rest: 0.1 m at t1. A push before it keeps the block away from there. */
static void events_after_the_change_are_forgotten(void **unused)
{
    (void)unused;
    fbd_model *model = settable(SPRING, "F", NULL);
    fbd_simulation *simulation = begun(model);
    fbd_state *state = fbd_state_new(model);
    const double t1 = acos(-1) / 10; /* 0.1 + 0.2 cos 5t */
    at(simulation, state, t1 + 1e-6, "block.x");
    size_t count = fbd_simulation_event_count(simulation);
    assert_int_equal(count, 1);
    near(fbd_simulation_event(simulation, 0).t, t1, close_to);
    assert_string_equal(fbd_simulation_event(simulation, 0).name, "middle");
    set(simulation, t1 + 1e-6, "F", 40); /* rises from 0.1 m, and falls through it again after a period */
    assert_int_equal(fbd_simulation_event_count(simulation), 1);
    at(simulation, state, 3.9, "block.x");
    assert_true(fbd_simulation_event_count(simulation) > 1);
    assert_true(fbd_simulation_event(simulation, 1).t > t1 + 1);
    assert_string_equal(fbd_simulation_event(simulation, 1).name, "middle");
    fbd_simulation_free(simulation);

    simulation = begun(model);
    double from = 0, to = 0;
    while (fbd_simulation_event_count(simulation) == 0) fbd_simulation_advance(simulation);
    fbd_simulation_interval(simulation, &from, &to);
    assert_true(from < to && to >= t1 - close_to);
    set(simulation, (from + to) / 2, "F", 40);
    assert_int_equal(fbd_simulation_event_count(simulation), 0);
    fbd_simulation_interval(simulation, &to, NULL);
    assert_true(to < t1);
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

/* At rest under 5 N < 0.3 m g; from 1 s on 10 N; from 2 s on none, until friction has stopped it. */
static void a_block_breaks_away_and_stops(void **unused)
{
    (void)unused;
    fbd_model *model = settable(BLOCK, "F", NULL);
    fbd_simulation *simulation = begun(model);
    fbd_state *state = fbd_state_new(model);
    const double a = 10 / 2.0 - 0.2 * g, v = a, x = a / 2, stop = v / (0.2 * g);
    near(at(simulation, state, 1, "block.v"), 0, 0);
    assert_int_equal(fbd_simulation_event_count(simulation), 0);
    set(simulation, 1, "F", 10);
    assert_int_equal(fbd_simulation_event_count(simulation), 1);
    assert_int_equal(fbd_simulation_event(simulation, 0).kind, FBD_EVENT_BREAKAWAY);
    assert_true(fbd_simulation_event(simulation, 0).t == 1);
    assert_non_null(strstr(fbd_simulation_event(simulation, 0).detail, "5.886"));
    near(at(simulation, state, 2, "block.v"), v, close_to);
    near(at(simulation, state, 2, "block.x"), x, close_to);
    set(simulation, 2, "F", 0);
    near(at(simulation, state, 5.5, "block.x"), x + v * stop / 2, close_to);
    near(at(simulation, state, 5.5, "block.v"), 0, 0);
    assert_int_equal(fbd_simulation_event_count(simulation), 2);
    assert_int_equal(fbd_simulation_event(simulation, 1).kind, FBD_EVENT_STICK);
    near(fbd_simulation_event(simulation, 1).t, 2 + stop, close_to);
    set(simulation, 5.5, "F", 5.8); /* below 0.3 m g */
    near(at(simulation, state, 6, "block.v"), 0, 0);
    assert_int_equal(fbd_simulation_event_count(simulation), 2);
    set(simulation, 6, "F", 5); /* at the end */
    assert_int_equal(fbd_simulation_outcome(simulation), FBD_DONE);
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

/* v = 2 t reaches the limit, and the next limit. */
static void a_limit_is_an_input(void **unused)
{
    (void)unused;
    fbd_model *model = settable(
        "fbd: 1\ninputs: {F: 4 N, limit: 1 m/s}\nbodies:\n  block: {mass: 2 kg, motion: slide, forces: "
        "[applied: {value: F}]}\nsimulate: {until: 3 s, events: [{name: fast, when: 'v = limit'}]}\n",
        "F", "limit");
    fbd_simulation *simulation = begun(model);
    fbd_state *state = fbd_state_new(model);
    near(at(simulation, state, 1, "block.v"), 2, close_to);
    set(simulation, 1, "limit", 3);
    near(at(simulation, state, 3, "block.v"), 6, close_to);
    assert_int_equal(fbd_simulation_event_count(simulation), 2);
    near(fbd_simulation_event(simulation, 0).t, 0.5, close_to);
    near(fbd_simulation_event(simulation, 1).t, 1.5, close_to);
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

/* m x'' = -K x: the derivatives are -K/m by x and -x/m by K. */
static void derivatives_are_those_at_the_value_set(void **unused)
{
    (void)unused;
    fbd_model *model =
        settable("fbd: 1\ninputs: {K: 5 N/m}\nbodies:\n  block: {mass: 2 kg, motion: slide, forces: "
                 "[applied: {value: -K*x}]}\nsimulate: {until: 3 s}\n",
                 "K", NULL);
    fbd_state *state = fbd_state_new(model);
    size_t by[2] = {0};
    double derivatives[2];
    for (size_t i = 0; i < fbd_model_variable_count(model); i++) {
        const fbd_variable variable = fbd_model_variable(model, i);
        if (variable.kind == FBD_VARIABLE_COORDINATE) by[0] = i;
        if (variable.kind == FBD_VARIABLE_INPUT) by[1] = i;
    }
    fbd_state_set(state, "K", 30);
    fbd_state_set(state, "block.x", 0.4);
    assert_true(fbd_state_derivatives(state, by, 2, derivatives, NULL));
    near(derivatives[0], -15, close_to);
    near(derivatives[1], -0.2, close_to);
    fbd_state_free(state);
    fbd_model_free(model);
}

/* A switch in a sliding mode on v = -K x^2: the acceleration is -2 K x v, so its derivative by K is -2 x v, in which the weights
 * of the switch take part. */
static void a_derivative_is_that_of_a_sliding_mode(void **unused)
{
    (void)unused;
    fbd_model *model = settable(
        "fbd: 1\ninputs: {K: 2 1/m/s}\nbodies:\n  block: {mass: 1 kg, motion: slide, initial: {x: 1 m}, "
        "forces: [applied: {value: '-10[N]*sign(v + K*x^2)'}]}\nsimulate: {until: 3 s}\n",
        "K", NULL);
    fbd_simulation *simulation = begun(model);
    fbd_state *state = fbd_state_new(model);
    size_t by = 0;
    while (fbd_model_variable(model, by).kind != FBD_VARIABLE_INPUT) by++;
    double derivative, x = at(simulation, state, 1, "block.x"), v = at(simulation, state, 1, "block.v");
    near(v, -2 * x * x, close_to);
    assert_true(fbd_state_derivatives(state, &by, 1, &derivative, NULL));
    near(derivative, -2 * x * v, 1e-9); /* the weights vary by central differences */
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
}

/* x'' = (F + G)/m - (k/m) x at rest under 15 N. */
static void a_linear_system_has_inputs_that_are_set(void **unused)
{
    (void)unused;
    fbd_model *model = settable(SPRING, "F", NULL);
    fbd_state *state = fbd_state_new(model);
    fbd_state_set(state, "F", 15);
    fbd_linearization *linear = fbd_linearize(state, NULL);
    fbd_linear_system *system = fbd_linear_system_new(linear, NULL, NULL);
    assert_int_equal(fbd_linear_system_input_count(system), 2);
    const double *B = fbd_linear_system_input_matrix(system);
    near(B[2], 0.5, close_to);
    near(B[3], 0.5, close_to);
    fbd_linear_system_free(system);
    fbd_linearization_free(linear);
    fbd_state_free(state);
    fbd_model_free(model);
}

static void states_have_values_of_their_own(void **unused)
{
    (void)unused;
    fbd_model *model = settable(SPRING, "F", NULL);
    fbd_state *state = fbd_state_new(model), *other = fbd_state_new(model);
    double numbers[8], value;
    assert_true(fbd_state_get(state, "F", &value) && value == 5);
    assert_false(fbd_state_get(state, "G", &value));
    assert_true(fbd_state_set(state, "F", 15));
    assert_false(fbd_state_set(state, "F", INFINITY));
    assert_true(fbd_state_get(other, "F", &value) && value == 5);
    const size_t count = fbd_state_pack(state, numbers, 8);
    assert_true(count < 8 && numbers[count - 1] == 15);
    assert_true(fbd_state_unpack(other, numbers, count));
    assert_true(fbd_state_get(other, "F", &value) && value == 15);
    fbd_equations *equations = fbd_assemble(other);
    near(fbd_equations_get(equations, 0).acceleration, (15 - 50 * 0.3) / 2, 1e-12);
    fbd_equations_free(equations);
    fbd_simulation *simulation = fbd_simulation_from(other, NULL, NULL);
    near(at(simulation, state, 1, "block.x"), 0.3, close_to); /* in balance */
    assert_true(fbd_state_get(state, "F", &value) && value == 15);
    fbd_simulation_free(simulation);
    fbd_state_free(state);
    fbd_state_free(other);
    fbd_model_free(model);
}

static void refused(fbd_simulation *simulation, double t, const char *name, double value, const char *id)
{
    fbd_errors *errors = fbd_errors_new();
    assert_false(fbd_simulation_set_input(simulation, t, name, value, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, id);
    fbd_errors_free(errors);
}

static int five(void *context, double t, const double *y, double *value)
{
    (void)context, (void)t, (void)y;
    *value = 5;
    return 0;
}

static void wrong_calls_are_refused(void **unused)
{
    (void)unused;
    fbd_model *model = settable(SPRING, "F", NULL);
    const fbd_callback call = {"G", five, NULL};
    fbd_model *both = fbd_model_with_callbacks(model, &call, 1, NULL);
    fbd_simulation *simulation = begun(model), *called = begun(both);
    fbd_state *state = fbd_state_new(model);
    at(simulation, state, 0.5, "block.x");
    double from, to;
    fbd_simulation_interval(simulation, &from, &to);
    refused(simulation, 0.5, "H", 1, "unknown-input");
    refused(simulation, 0.5, "G", 1, "fixed-input");
    refused(called, 0, "G", 1, "fixed-input");
    refused(simulation, 0.5, "F", NAN, "bad-call");
    refused(simulation, 0.5, "F", INFINITY, "bad-call");
    refused(simulation, to + 1, "F", 1, "bad-call");
    refused(simulation, NAN, "F", 1, "bad-call");
    refused(simulation, 0.5, NULL, 1, "bad-call");
    refused(NULL, 0.5, "F", 1, "bad-call");
    double same;
    fbd_simulation_interval(simulation, &same, NULL);
    assert_true(same == from);
    set(simulation, 0.5, "F", 5); /* its value */
    fbd_simulation_interval(simulation, &same, NULL);
    assert_true(same == from);
    fbd_simulation_free(simulation);
    fbd_simulation_free(called);
    fbd_state_free(state);
    fbd_model_free(both);
    fbd_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_motor_is_switched),
        cmocka_unit_test(an_input_is_set_at_the_end),
        cmocka_unit_test(forces_of_two_inputs_are_switched),
        cmocka_unit_test(events_after_the_change_are_forgotten),
        cmocka_unit_test(a_block_breaks_away_and_stops),
        cmocka_unit_test(a_limit_is_an_input),
        cmocka_unit_test(derivatives_are_those_at_the_value_set),
        cmocka_unit_test(a_derivative_is_that_of_a_sliding_mode),
        cmocka_unit_test(a_linear_system_has_inputs_that_are_set),
        cmocka_unit_test(states_have_values_of_their_own),
        cmocka_unit_test(wrong_calls_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
