/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What live pages ask of the library: where numbers stand in a text, and texts without some of their effects.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fbd.h"
#include "fbd_export.h"

static fbd_model *parse(const char *text)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, strlen(text), "test.yaml", NULL, 0, errors);
    fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    assert_non_null(model);
    return model;
}

/* ---- without */

static void text_without(const char *text, const char *const *names, size_t count, const char *want)
{
    fbd_model *model = parse(text);
    char *got = fbd_model_without(model, names, count, NULL);
    assert_non_null(got);
    assert_string_equal(got, want);
    fbd_free(got);
    fbd_model_free(model);
}

static void entries_on_lines_of_their_own_become_comments(void **unused)
{
    (void)unused;
    const char *const both[] = {"b.friction", "b.gravity"}, *const all[] = {"b.gravity", "b.normal",
                                                                            "b.friction"};
    const char text[] = "fbd: 1\n"
                        "bodies:\n"
                        "  b:\n"
                        "    mass: 1 kg\n"
                        "    motion: slide\n"
                        "    forces:\n"
                        "      - gravity  # weight\n"
                        "      - normal\n"
                        "      - friction:\n"
                        "          static: 0.5\n"
                        "\n"
                        "          kinetic: 0.4\n"
                        "    hand: m*v_dot = -mu_k*N\n"
                        "simulate: {until: 1 s}\n";
    text_without(text, both, 2,
                 "fbd: 1\n"
                 "bodies:\n"
                 "  b:\n"
                 "    mass: 1 kg\n"
                 "    motion: slide\n"
                 "    forces:\n"
                 "      # - gravity  # weight\n"
                 "      - normal\n"
                 "      # - friction:\n"
                 "      #     static: 0.5\n"
                 "\n"
                 "      #     kinetic: 0.4\n"
                 "    # hand: m*v_dot = -mu_k*N\n"
                 "simulate: {until: 1 s}\n");
    text_without(text, all, 3,
                 "fbd: 1\n"
                 "bodies:\n"
                 "  b:\n"
                 "    mass: 1 kg\n"
                 "    motion: slide\n"
                 "    forces: []\n"
                 "      # - gravity  # weight\n"
                 "      # - normal\n"
                 "      # - friction:\n"
                 "      #     static: 0.5\n"
                 "\n"
                 "      #     kinetic: 0.4\n"
                 "    # hand: m*v_dot = -mu_k*N\n"
                 "simulate: {until: 1 s}\n");
}

static void entries_in_brackets_are_cut_out(void **unused)
{
    (void)unused;
    static const struct {
        const char *names[3];
        size_t count;
        const char *list, *left;
    } cases[] = {
        {{"b.gravity"}, 1, "[gravity, normal, drag: {linear: 1 N*s/m}]", "[normal, drag: {linear: 1 N*s/m}]"},
        {{"b.normal"}, 1, "[gravity, normal, drag: {linear: 1 N*s/m}]", "[gravity, drag: {linear: 1 N*s/m}]"},
        {{"b.drag"}, 1, "[gravity, normal, drag: {linear: 1 N*s/m}]", "[gravity, normal]"},
        {{"b.normal", "b.drag"}, 2, "[gravity, normal, drag: {linear: 1 N*s/m}]", "[gravity]"},
        {{"b.gravity", "b.normal"},
         2,
         "[\"gravity\", 'normal', drag: {linear: 1 N*s/m}]",
         "[drag: {linear: 1 N*s/m}]"},
        {{"b.gravity", "b.normal", "b.drag"}, 3, "[gravity, normal, drag: {linear: 1 N*s/m}]", "[]"},
        {{"b.gravity"}, 1, "[gravity]", "[]"},
    };
    const char frame[] =
        "fbd: 1\nbodies: {b: {mass: 1 kg, motion: slide, forces: %s}}\nsimulate: {until: 1 s}\n";
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[300], want[300];
        snprintf(text, sizeof text, frame, cases[i].list);
        snprintf(want, sizeof want, frame, cases[i].left);
        text_without(text, cases[i].names, cases[i].count, want);
    }
}

static void what_the_file_does_not_list_cannot_be_left_out(void **unused)
{
    (void)unused;
    fbd_model *model = parse(
        "fbd: 1\nbodies: {b: {mass: 1 kg, motion: slide, forces: [gravity]}}\nsimulate: {until: 1 s}\n");
    fbd_errors *errors = fbd_errors_new();
    const char *const names[] = {"b.gravty"};
    assert_null(fbd_model_without(model, names, 1, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, "unknown-effect");
    assert_non_null(strstr(fbd_errors_get(errors, 0).hint, "b.gravity"));
    fbd_errors_free(errors);
    fbd_model_free(model);
}

/* ---- controls */

static void controls_have(const char *text, const char *part)
{
    fbd_model *model = parse(text);
    char *controls = fbd_model_controls(model, NULL);
    assert_non_null(controls);
    if (!strstr(controls, part)) fail_msg("no `%s` in %s", part, controls);
    fbd_free(controls);
    fbd_model_free(model);
}

static void numbers_are_found_in_the_text_by_utf_16_units(void **unused)
{
    (void)unused;
    /* the title has one letter of two units and one of one unit and two bytes before the number */
    const char text[] =
        "fbd: 1\n"
        "title: \xf0\x9d\x9c\x83 \xc3\xa9\n"
        "parameters: {F: {value: 3 kN, range: [1 kN, 4 kN]}, w: 2*F}\n"
        "bodies: {b: {mass: 1 kg, motion: slide, initial: {v: 2 ft/s}, forces: [applied: {value: w}]}}\n"
        "simulate: {until: 1 s}\n";
    controls_have(text, "\"value\":3000,\"low\":1000,\"high\":4000,");
    controls_have(text, "{\"from\":43,\"number\":1,\"factor\":1000,\"to\":47}");
    controls_have(text, "\"derived\": true,\"written\":{\"from\":74,\"to\":77}");
    controls_have(text, "\"before\":\", x: \",\"behind\":\"\"}");
    controls_have(text, "{\"body\":\"b\",\"name\":\"applied\",\"line\":4}");
}

static void a_place_is_found_for_what_is_not_written(void **unused)
{
    (void)unused;
    const char text[] = "fbd: 1\n"
                        "bodies:\n"
                        "  b:\n"
                        "    mass: 1 kg\n"
                        "    motion: slide # free\n"
                        "simulate:\n"
                        "  until: 1 s\n";
    controls_have(text, "{\"from\":59,\"before\":\"\\n    initial: {v: \",\"behind\":\"}\"}");
    controls_have(text, "\"before\":\"\\n  tolerance: \",\"behind\":\"\"}");
}

static void notes_are_told_as_json(void **unused)
{
    (void)unused;
    const char text[] = "fbd: 1\nbodies: {b: {mass: 1 N, motion: slide}}\nsimulate: {until: 1 s}\n";
    fbd_errors *errors = fbd_errors_new();
    assert_null(fbd_model_parse(text, strlen(text), NULL, NULL, 0, errors));
    char *json = fbd_errors_json(errors);
    assert_non_null(json);
    assert_non_null(strstr(json, "\"severity\":\"error\",\"id\":\"wrong-dimension\""));
    assert_non_null(strstr(json, "\"line\":2,\"column\":"));
    fbd_free(json);
    fbd_errors_free(errors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(entries_on_lines_of_their_own_become_comments),
        cmocka_unit_test(entries_in_brackets_are_cut_out),
        cmocka_unit_test(what_the_file_does_not_list_cannot_be_left_out),
        cmocka_unit_test(numbers_are_found_in_the_text_by_utf_16_units),
        cmocka_unit_test(a_place_is_found_for_what_is_not_written),
        cmocka_unit_test(notes_are_told_as_json),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
