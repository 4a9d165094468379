/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a right model file becomes: the whole, units and gravity, the run; and what is left of a wrong one.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "scene_fixture.h"

static const double pi = 3.14159265358979323846;

/* ---- the file */

static const char incline[] = "fbd: 1\n"
                              "title: Block on an incline with dry friction\n"
                              "units: SI\n"
                              "gravity: 9.81\n"
                              "parameters:\n"
                              "  phi: 30 deg\n"
                              "  f1: 5 N\n"
                              "bodies:\n"
                              "  block:\n"
                              "    mass: 2 kg\n"
                              "    motion: {slide: {along: phi}}\n"
                              "    initial: {v: 3 m/s}\n"
                              "    forces:\n"
                              "      - gravity\n"
                              "      - normal\n"
                              "      - friction: {static: 0.5, kinetic: 0.5}\n"
                              "      - applied: {name: push, value: f1}\n"
                              "simulate: {until: 2 s}\n";

static void the_incline_is_read(void **state)
{
    (void)state;
    struct reading r = read_right(incline);
    const struct scene *scene = r.scene;
    const struct body *block = &scene->bodies[0];
    assert_string_equal(scene->title, "Block on an incline with dry friction");
    assert_int_equal(scene->body_count, 1);
    assert_string_equal(block->name, "block");
    assert_true(block->complete);
    assert_int_equal(block->at.line, 9);
    assert_int_equal(block->motion.kind, motion_slide);
    assert_int_equal(block->motion.parent, ground_body);
    assert_close(block->motion.along, pi / 6);
    assert_int_equal(block->part_count, 1);
    assert_close(block->parts[0].mass, 2);
    assert_int_equal(block->parts[0].shape, shape_point);
    assert_int_equal(block->load_count, 4);
    assert_string_equal(block->loads[3].name, "push");
    assert_int_equal(block->loads[3].value.at.line, 17);
    assert_int_equal(block->loads[3].value.at.column, 38);
    assert_close(scene->coordinates[0].initial_rate, 3);
    assert_close(expr_value(scene->simulate.until.expr), 2);
    end_reading(&r);
}

static void gravity_depends_on_the_units_and_may_be_a_vector(void **state)
{
    (void)state;
    static const struct {
        const char *top;
        double x, y;
    } cases[] = {
        {"", 0, -9.81},
        {"units: US", 0, -32.2},
        {"gravity: 1.62", 0, -1.62},
        {"gravity: 0", 0, 0},
        {"gravity: [0.5, -9 m/s^2]", 0.5, -9},
        {"gravity: 32.2 ft/s^2", 0, -32.2 * 0.3048},
        {"{units: US, gravity: 32.174}", 0, -32.174},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[200];
        const char *top = cases[i].top;
        bool braces = top[0] == '{';
        if (braces)
            snprintf(text, sizeof text, "{fbd: 1, bodies: {b: {mass: 1, motion: slide}}, %s", top + 1);
        else
            snprintf(text, sizeof text, "fbd: 1\n%s\nbodies: {b: {mass: 1, motion: slide}}", top);
        struct reading r = read_right(text);
        assert_vec(r.scene->gravity, cases[i].x, cases[i].y);
        end_reading(&r);
    }
}

static void bare_numbers_are_in_the_units_of_the_scene(void **state)
{
    (void)state;
    struct reading r = read_right("fbd: 1\n"
                                  "datum: 3 m\n" /* stands before the system that it is converted to */
                                  "units: US\n"
                                  "bodies:\n"
                                  "  b: {mass: 2, motion: slide, initial: {x: 30, v: 3 m/s}}\n"
                                  "  c: {mass: 32.17404855643044 lbm, motion: slide}\n");
    assert_int_equal(r.scene->units, unit_us);
    assert_close(r.scene->datum, 3 / 0.3048);
    assert_close(r.scene->bodies[0].parts[0].mass, 2);
    assert_close(r.scene->coordinates[0].initial, 30);
    assert_close(r.scene->coordinates[0].initial_rate, 3 / 0.3048);
    assert_close(r.scene->bodies[1].parts[0].mass, 1); /* 1 slug = 9.80665/0.3048 lbm */
    end_reading(&r);
}

static void text_in_quotes_is_an_expression_where_one_is_wanted(void **state)
{
    (void)state;
    struct reading r =
        read_right("fbd: \"1\"\n"
                   "bodies: {b: {mass: '2 kg', motion: \"slide\", initial: {x: \"3[m] + 1\"}}}");
    assert_close(r.scene->bodies[0].parts[0].mass, 2);
    assert_close(r.scene->coordinates[0].initial, 4);
    end_reading(&r);
}

static void other_programs_may_leave_a_schema(void **state)
{
    (void)state;
    struct reading r = read_right("$schema: ./fbd.json\nfbd: 1\ndescription: none\n"
                                  "bodies: {b: {mass: 1, motion: slide, description: 3}}");
    assert_string_equal(r.scene->title, "");
    end_reading(&r);
}

/* ---- the run */

static void the_run_is_read(void **state)
{
    (void)state;
    struct reading r = read_right("fbd: 1\n"
                                  "parameters: {T: 3 s}\n"
                                  "bodies: {b: {mass: 1, motion: slide}}\n"
                                  "simulate: {until: 2*T, tolerance: 1e-9, method: rk8pd, step: 1 ms}\n"
                                  "output: {every: 20 ms}\n");
    const struct simulate *simulate = &r.scene->simulate;
    assert_close(expr_value(simulate->until.expr), 6);
    assert_close(simulate->tolerance, 1e-9);
    assert_close(simulate->step, 1e-3);
    assert_close(simulate->every, 0.02);
    assert_string_equal(simulate->method, "rk8pd");
    end_reading(&r);
}

static void a_file_without_a_run_is_a_model(void **state)
{
    (void)state;
    struct reading r = read_right("fbd: 1\nbodies: {b: {mass: 1, motion: slide}}\n");
    assert_null(r.scene->simulate.until.expr);
    assert_null(r.scene->simulate.method);
    end_reading(&r);
}

static void an_event_has_a_direction_and_an_outcome(void **state)
{
    (void)state;
    struct reading r = read_right("fbd: 1\n"
                                  "bodies: {object: {mass: 1, motion: slide}}\n"
                                  "simulate:\n"
                                  "  until: 2 s\n"
                                  "  events:\n"
                                  "    - {name: platform, when: \"object.x < 10[ft]\", then: stop}\n"
                                  "    - when: x > 2[m]\n"
                                  "    - {when: v = 0, stop: true}\n"
                                  "    - {when: x, direction: falling, then: go_on}\n"
                                  "    - x*v = 3\n");
    static const struct {
        const char *name;
        int direction;
        bool stop, right;
    } wanted[] = {{"platform", -1, true, true},
                  {"event", 1, false, true},
                  {"event_2", 0, true, true},
                  {"event_3", -1, false, false},
                  {"event_4", 0, false, true}};
    assert_int_equal(r.scene->event_count, 5);
    for (size_t i = 0; i < 5; i++) {
        const struct user_event *event = &r.scene->events[i];
        assert_string_equal(event->name, wanted[i].name);
        assert_int_equal(event->direction, wanted[i].direction);
        assert_int_equal(event->stop, wanted[i].stop);
        assert_non_null(event->left);
        assert_int_equal(event->right != NULL, wanted[i].right);
    }
    const double y[] = {7, 5};
    assert_string_equal(r.scene->events[0].text, "object.x < 10[ft]");
    assert_close(expr_eval(r.scene->events[0].left, 0, y, NULL), 7);
    assert_close(expr_value(r.scene->events[0].right), 3.048);
    assert_close(expr_eval(r.scene->events[2].left, 0, y, NULL), 5);
    end_reading(&r);
}

/* ---- wrong files */

static void a_wrong_body_leaves_the_others_complete(void **state)
{
    (void)state;
    struct reading r =
        read_text("fbd: 1\nbodies:\n"
                  "  a: {mass: 1 m, motion: slide}\n"
                  "  b: {mass: 1, motion: slide, forces: [{spring: {stiffness: 3, neutral: a.x}}]}\n"
                  "  c: {mass: 1, motion: slide, forces: [{applied: \"1[N/m]*a.x\"}]}\n");
    assert_non_null(r.scene);
    assert_int_equal(fbd_errors_failed_count(r.errors), 2);
    assert_first_note(&r, "wrong-dimension", 3, 15);
    assert_int_equal(count_notes(&r, "not-constant"), 1);
    assert_false(r.scene->bodies[0].complete);
    assert_false(r.scene->bodies[1].complete);
    assert_true(r.scene->bodies[2].complete);
    end_reading(&r);
}

static void a_body_of_unknown_motion_has_no_second_error(void **state)
{
    (void)state;
    struct reading r = read_text("fbd: 1\nbodies:\n"
                                 "  a:\n"
                                 "    mass: 1\n"
                                 "    motion: slidr\n"
                                 "    initial: {x: 1}\n"
                                 "    forces: [gravity, normal, {friction: 0.3}, {applied: -3[N/m]*x}]\n"
                                 "    hand: m*v_dot = -3[N/m]*x\n"
                                 "  b: {mass: 1, motion: slide, forces: [{applied: a.x}]}\n");
    /* The unit in brackets needs quotes inside the list. */
    assert_first_note(&r, "unquoted-unit", 7, 60);
    end_reading(&r);
    r = read_text("fbd: 1\nbodies:\n"
                  "  a:\n"
                  "    mass: 1\n"
                  "    motion: slidr\n"
                  "    initial: {x: 1}\n"
                  "    forces: [gravity, normal, {friction: 0.3}, {applied: \"-3[N/m]*x\"}]\n"
                  "    hand: m*v_dot = -3[N/m]*x\n"
                  "  b: {mass: 1, motion: slide, forces: [{applied: a.x}]}\n");
    assert_first_note(&r, "unknown-kind", 5, 13);
    assert_int_equal(fbd_errors_count(r.errors), 1);
    end_reading(&r);
}

static void notes_outlive_the_text_and_the_scene(void **state)
{
    (void)state;
    char text[] = "fbd: 1\nbodies: {b: {mas: 1, motion: slide}}\n", file[] = "model.yaml";
    fbd_errors *errors = fbd_errors_new();
    struct scene *scene = scene_read(text, strlen(text), file, NULL, 0, NULL, errors);
    scene_free(scene);
    memset(text, 'x', sizeof text - 1);
    memset(file, 'x', sizeof file - 1);
    const fbd_error note = fbd_errors_get(errors, 1);
    assert_string_equal(note.file, "model.yaml");
    assert_string_equal(note.hint, "did you mean `mass`?");
    fbd_errors_free(errors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_incline_is_read),
        cmocka_unit_test(gravity_depends_on_the_units_and_may_be_a_vector),
        cmocka_unit_test(bare_numbers_are_in_the_units_of_the_scene),
        cmocka_unit_test(text_in_quotes_is_an_expression_where_one_is_wanted),
        cmocka_unit_test(other_programs_may_leave_a_schema),
        cmocka_unit_test(the_run_is_read),
        cmocka_unit_test(a_file_without_a_run_is_a_model),
        cmocka_unit_test(an_event_has_a_direction_and_an_outcome),
        cmocka_unit_test(a_wrong_body_leaves_the_others_complete),
        cmocka_unit_test(a_body_of_unknown_motion_has_no_second_error),
        cmocka_unit_test(notes_outlive_the_text_and_the_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
