/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parameters: their order, their circles, and what is set from outside.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "scene_fixture.h"

#include <stdlib.h>

static const struct parameter *parameter_called(const struct reading *r, const char *name)
{
    for (size_t i = 0; i < r->scene->parameter_count; i++)
        if (strcmp(r->scene->parameters[i].name, name) == 0) return &r->scene->parameters[i];
    fail_msg("no parameter %s", name);
    return NULL;
}

static void parameters_stand_in_any_order(void **state)
{
    (void)state;
    struct reading r = read_right("fbd: 1\n"
                                  "parameters:\n"
                                  "  w: m*g\n"
                                  "  m: 2*m0\n"
                                  "  m0: 3 kg\n"
                                  "  gravity0: 10 m/s^2\n"
                                  "  n: 4\n"
                                  "gravity: gravity0\n"
                                  "bodies: {b: {mass: w/g, motion: slide, forces: [{applied: n}]}}\n");
    assert_close(parameter_called(&r, "w")->value, 60);
    assert_true(dim_equal(parameter_called(&r, "w")->dim, DIM_FORCE));
    assert_false(parameter_called(&r, "m0")->bare);
    assert_true(parameter_called(&r, "n")->bare);
    assert_close(r.scene->bodies[0].parts[0].mass, 6);
    end_reading(&r);
}

/* Names of coordinates that the body of the expression has not: the parameter, wherever it stands. */
static void a_parameter_may_be_called_as_a_coordinate_of_others(void **state)
{
    (void)state;
    struct reading r =
        read_text("fbd: 1\n"
                  "parameters: {x: 3 m, omega: 2 rad/s, theta: '2*x/(1[m])'}\n"
                  "bodies:\n"
                  "  arm: {mass: 1, shape: rod, length: x, motion: {pivot: {point: left}},\n"
                  "        moments: [{applied: 'x*1[N] + arm.theta*1[N*m]'}]}\n"
                  "  block: {mass: theta, motion: slide,\n"
                  "          initial: {v: '3[m]*omega/(1[rad])'}, forces: [{applied: '1[N*s]*omega'}]}\n"
                  "simulate: {until: 1, events: [{name: e, when: 'block.v = omega*3[m]'}]}\n");
    assert_int_equal(count_notes(&r, "coordinate-name"), 3);
    assert_int_equal(fbd_errors_count(r.errors), 3);
    const struct scene *scene = r.scene;
    assert_close(scene->bodies[0].parts[0].length, 3);
    assert_close(scene->bodies[1].parts[0].mass, 6);
    assert_close(scene->coordinates[1].initial_rate, 6);
    const double y[] = {0.5, 0, 0, 0}; /* theta of the arm */
    assert_close(expr_eval(scene->bodies[0].loads[0].value.expr, 0, y, NULL), 3.5);
    assert_close(expr_value(scene->bodies[1].loads[0].value.expr), 2);
    assert_close(expr_eval(scene->events[0].right, 0, y, NULL), 6);
    end_reading(&r);
}

static void a_file_may_be_read_with_other_values(void **state)
{
    (void)state;
    static const char text[] = "fbd: 1\n"
                               "parameters: {f1: 5 N, n: 2, mu: 0.5, f2: 3*f1}\n"
                               "bodies: {b: {mass: n, motion: slide, forces: [{applied: mu*(f1 + f2)}]}}\n";
    static const struct {
        const char *name, *value;
        double f1, n, f2;
    } cases[] = {
        {"f1", "50", 50, 2, 150},       {"f1", "50 N", 50, 2, 150},    {"f1", "1 kN", 1000, 2, 3000},
        {"f1", "f2/f2*8[N]", 8, 2, 15}, {"n", "3 kg", 5, 3, 15},       {"n", "7", 5, 7, 15},
        {"f2", "-2*f1", 5, 2, -10},     {"f1", "-1.5e1", -15, 2, -45},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct override override = {.name = cases[i].name, .value = cases[i].value};
        struct reading r = read_with(text, &override, 1);
        if (i == 3) { /* f2 is made of f1 */
            assert_int_equal(count_notes(&r, "circular-parameter"), 1);
            end_reading(&r);
            continue;
        }
        assert_int_equal(fbd_errors_count(r.errors), 0);
        assert_close(parameter_called(&r, "f1")->value, cases[i].f1);
        assert_close(parameter_called(&r, "n")->value, cases[i].n);
        assert_close(parameter_called(&r, "f2")->value, cases[i].f2);
        end_reading(&r);
    }
}

static void a_value_from_outside_is_checked_like_one_of_the_file(void **state)
{
    (void)state;
    static const char text[] =
        "fbd: 1\n"
        "parameters: {phi: 30 deg, f1: 5 N}\n"
        "bodies: {b: {mass: 1, motion: {slide: {along: phi}}, forces: [{applied: f1}]}}\n";
    static const struct {
        const char *name, *value, *id;
    } cases[] = {
        {"f1", "50 m", "wrong-dimension"},  {"f1", "", "missing-value"},
        {"f1", "1,5", "number-format"},     {"f1", "50 Nm", "unknown-unit"},
        {"f1", "nan", "not-finite"},        {"f1", "2*q", "unknown-name"},
        {"F1", "50", "unknown-parameter"},  {"phi", "45", "bare-angle"},
        {"phi", "45 N", "wrong-dimension"}, {"f1", "4*t", "not-constant"},
        {"f1", "5 +", "expression-syntax"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct override override = {.name = cases[i].name, .value = cases[i].value};
        struct reading r = read_with(text, &override, 1);
        const fbd_error note = fbd_errors_get(r.errors, 0);
        assert_non_null(note.id);
        assert_string_equal(note.id, cases[i].id);
        assert_int_equal(note.line, 0); /* not a place of the file */
        assert_non_null(strstr(note.file, "--set "));
        assert_non_null(strstr(note.file, cases[i].name));
        assert_int_equal(fbd_errors_count(r.errors), 1);
        end_reading(&r);
    }
}

static void an_unknown_parameter_is_answered_by_the_nearest(void **state)
{
    (void)state;
    static const char text[] = "fbd: 1\nparameters: {phi: 1, force: 5}\n"
                               "bodies: {b: {mass: phi, motion: slide, forces: [{applied: force}]}}\n";
    const struct override override = {.name = "forcee", .value = "2"};
    struct reading r = read_with(text, &override, 1);
    assert_string_equal(fbd_errors_get(r.errors, 0).hint, "did you mean `force`?");
    end_reading(&r);
}

static void a_circle_is_named_once_and_from_its_start(void **state)
{
    (void)state;
    struct reading r = read_text("fbd: 1\n"
                                 "parameters: {p: a, a: b, b: 2*c, c: a}\n"
                                 "bodies: {b: {mass: p, motion: slide}}\n");
    assert_int_equal(fbd_errors_count(r.errors), 1);
    assert_first_note(&r, "circular-parameter", 2, 37);
    assert_non_null(strstr(fbd_errors_get(r.errors, 0).message, ": a -> b -> c -> a"));
    end_reading(&r);
}

static char *chain(int count, bool forward)
{
    char *text = malloc(200 + 40 * (size_t)count);
    assert_non_null(text);
    size_t used = (size_t)sprintf(text, "fbd: 1\nparameters:\n");
    for (int i = 0; i < count; i++) {
        int k = forward ? i : count - 1 - i;
        used += (size_t)(k == 0 ? sprintf(text + used, "  p0: 1 kg\n")
                                : sprintf(text + used, "  p%d: p%d + 1\n", k, k - 1));
    }
    sprintf(text + used, "bodies: {b: {mass: p%d, motion: slide}}\n", count - 1);
    return text;
}

static void long_chains_are_read_in_the_order_of_use(void **state)
{
    (void)state;
    char *text = chain(10000, true);
    struct reading r = read_right(text);
    assert_close(r.scene->bodies[0].parts[0].mass, 10000);
    end_reading(&r);
    free(text);
}

static void chains_against_the_order_are_limited(void **state)
{
    (void)state;
    char *text = chain(40, false);
    struct reading r = read_right(text);
    end_reading(&r);
    free(text);
    text = chain(10000, false);
    r = read_text(text);
    assert_int_equal(fbd_errors_count(r.errors), count_notes(&r, "parameter-chain"));
    assert_true(fbd_errors_count(r.errors) > 0);
    end_reading(&r);
    free(text);
}

static void unused_parameters_are_told_of_right_files_only(void **state)
{
    (void)state;
    struct reading r = read_text("fbd: 1\nparameters: {a: 1, b: 2*a}\n"
                                 "bodies: {b: {mass: 1, motion: slide}}\n");
    assert_int_equal(fbd_errors_failed_count(r.errors), 0);
    assert_int_equal(count_notes(&r, "unused-parameter"), 1); /* b; a is used by it */
    end_reading(&r);
    r = read_text("fbd: 1\nparameters: {a: 1}\n"
                  "bodies: {b: {mass: 1, motion: slide, forces: [{aplied: a}]}}\n");
    assert_int_equal(count_notes(&r, "unused-parameter"), 0);
    end_reading(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parameters_stand_in_any_order),
        cmocka_unit_test(a_parameter_may_be_called_as_a_coordinate_of_others),
        cmocka_unit_test(a_file_may_be_read_with_other_values),
        cmocka_unit_test(a_value_from_outside_is_checked_like_one_of_the_file),
        cmocka_unit_test(an_unknown_parameter_is_answered_by_the_nearest),
        cmocka_unit_test(a_circle_is_named_once_and_from_its_start),
        cmocka_unit_test(long_chains_are_read_in_the_order_of_use),
        cmocka_unit_test(chains_against_the_order_are_limited),
        cmocka_unit_test(unused_parameters_are_told_of_right_files_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
