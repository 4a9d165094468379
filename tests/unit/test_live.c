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

/* ---- pulls */

static const double way[] = {0.5, 0, 0, 0.75, 0.1, 0.2};

static fbd_pull pull_of(const char *body)
{
    return (fbd_pull){
        .body = body, .at = {0.25, 0}, .stiffness = 16, .from = 0.5, .to = 1, .path = way, .count = 2};
}

/* The end of a text that is pulled, whose start stays; both are parsed and run by the caller's model. */
static void pulled_text_has(const char *text, const char *body, const char *const *parts, size_t count)
{
    fbd_model *model = parse(text);
    const fbd_pull pull = pull_of(body);
    char *got = fbd_model_pulled(model, &pull, NULL);
    assert_non_null(got);
    for (size_t i = 0; i < count; i++)
        if (!strstr(got, parts[i])) fail_msg("no `%s` in %s", parts[i], got);
    fbd_model *again = parse(got);
    fbd_model_free(again);
    fbd_free(got);
    fbd_model_free(model);
}

static void a_pull_is_a_force_with_a_point_and_a_path(void **unused)
{
    (void)unused;
    static const char lines[] = "fbd: 1\n"
                                "bodies:\n"
                                "  rod:\n"
                                "    shape: rod\n"
                                "    mass: 4 kg\n"
                                "    length: 1 m\n"
                                "    motion: pivot\n"
                                "    hand: I_O*omega_dot = -0*m\n"
                                "    forces:\n"
                                "      - gravity # down\n"
                                "      - drag: {linear: 1 N*s/m}\n"
                                "simulate: {until: 2 s} # long\n";
    static const char *const in_lines[] = {
        "      - drag: {linear: 1 N*s/m}\n"
        "      - applied: {name: pull, at: pull, fx: \"pulse(t, 0.5[s], 0.5[s])*(16[N/m]*(pull_x(t) - "
        "rod.pull.x) - "
        "8[N*s/m]*rod.pull.vx)\", fy: \"pulse(",
        "    # hand: I_O",
        "\n    points: {pull: [0.25, 0]}\n",
        "simulate: {until: 2 s} # long\n"
        "tables: {pull_x: {interpolation: steffen, points: [[0.5 s, 0 m], [0.75 s, 0.1 m], [1 s, 0.1 m]]}, "
        "pull_y: {",
    };
    static const char brackets[] = "fbd: 1\ntables: {f: [[0, 0], [1, 1]]}\nbodies: {pull: {mass: 1 kg, "
                                   "motion: {slide: {along: 90 deg}}, forces: "
                                   "{applied: \"f(t)\"}, exact: {x: 0}}}\nsimulate: {until: 1 s}\n";
    /* along the line: from the grabbed point, 0.25 m before x, at y = 0.2 m */
    static const char *const in_brackets[] = {
        "forces: [{applied: \"f(t)\"}, applied: {name: pull_2, value: \"pulse(t, 0.5[s], "
        "0.5[s])*(16[N/m]*(pull_2_x(t) - "
        "x) - 4[N*s/m]*v)\"}]}",
        "tables: {f: [[0, 0], [1, 1]], pull_2_x: {interpolation: steffen, points: [[0.5 s, -0.25 m], [0.75 "
        "s, -0.05 m]",
    };
    pulled_text_has(lines, "rod", in_lines, sizeof in_lines / sizeof *in_lines);
    pulled_text_has(brackets, "pull", in_brackets, sizeof in_brackets / sizeof *in_brackets);
}

/* `pull` is free, but not the name of one of its tables: they all have another one. */
static void a_pull_has_tables_of_its_own(void **unused)
{
    (void)unused;
    static const char *const tables[] = {"pull_x", "pull_y"}, *const parts[] = {"applied: {name: pull_2, ",
                                                                                "pull_2_x: {"};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "fbd: 1\ntables: {%s: [[0, 0], [1, 1]]}\nbodies: {b: {mass: 1 kg, motion: slide, forces: "
                 "[applied: "
                 "\"%s(t)\"]}}\nsimulate: {until: 1 s}\n",
                 tables[i], tables[i]);
        pulled_text_has(text, "b", parts, 2);
    }
}

static void every_way_to_list_forces_has_a_place_for_a_pull(void **unused)
{
    (void)unused;
    static const struct {
        const char *list, *want;
    } cases[] = {
        {"", "motion: particle, forces: [applied: {name: pull, fx"},
        {", forces: []", "forces: [applied: {name: pull, fx"},
        {", forces: gravity", "forces: [gravity, applied: {name: pull, fx"},
        {", forces: [gravity]", "forces: [gravity, applied: {name: pull, fx"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[300];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies: {b: {mass: 1 kg, motion: particle%s}}\nsimulate: {until: 1 s}\n",
                 cases[i].list);
        pulled_text_has(text, "b", &cases[i].want, 1);
    }
}

static void pull_is_refused(const char *text, const char *body, const char *id, const char *part)
{
    fbd_model *model = parse(text);
    fbd_errors *errors = fbd_errors_new();
    const fbd_pull pull = pull_of(body);
    assert_null(fbd_model_pulled(model, &pull, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, id);
    if (!strstr(fbd_errors_get(errors, 0).message, part)) fail_msg("%s", fbd_errors_get(errors, 0).message);
    fbd_errors_free(errors);
    fbd_model_free(model);
}

static void what_cannot_be_pulled_is_refused_by_name(void **unused)
{
    (void)unused;
    static const char driven[] =
        "fbd: 1\nbodies: {b: {mass: 1 kg, motion: {slide: {x: \"t*1[m/s]\"}}}}\nsimulate: {until: 1 s}\n";
    static const char alias[] =
        "fbd: 1\nbodies: {b: &b {mass: 1 kg, motion: particle}, c: *b}\nsimulate: {until: 1 s}\n";
    static const char single[] = "fbd: 1\nbodies:\n  b:\n    mass: 1 kg\n    motion: particle\n    forces:\n"
                                 "      drag:\n        linear: 1 N*s/m\nsimulate: {until: 1 s}\n";
    pull_is_refused(driven, "b", "not-pulled", "`b` cannot be pulled: its motion is prescribed");
    pull_is_refused(driven, "c", "unknown-body", "no body `c`");
    pull_is_refused(alias, "c", "not-pulled", "alias");
    pull_is_refused(single, "b", "not-pulled", "no place for a new entry of `forces`");
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

static void masses_and_slopes_are_found_where_they_are_written(void **unused)
{
    (void)unused;
    const char text[] = "fbd: 1\n"
                        "ground: {lines: {ramp: {along: 30 deg}}}\n"
                        "bodies:\n"
                        "  a: {mass: 2 kg, motion: {slide: {line: ramp}}}\n"
                        "  b: {mass: 3 kg, motion: {slide: {along: 0.5}}}\n"
                        "  c: {parts: {p: {shape: sphere, radius: 1 m, mass: 1 kg}}, motion: particle}\n"
                        "simulate: {until: 1 s}\n";
    controls_have(text, "{\"name\":\"a\",\"unit\":\"kg\",\"value\":2,\"written\":{\"from\":68,\"number\":1,");
    controls_have(text, "{\"name\":\"c\",\"unit\":\"kg\",\"value\":1,\"written\":null}");
    controls_have(text, "{\"from\":38,\"number\":2,");
    controls_have(text, "{\"name\":\"b\",\"unit\":\"rad\",\"value\":0.5,");
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
        cmocka_unit_test(a_pull_is_a_force_with_a_point_and_a_path),
        cmocka_unit_test(a_pull_has_tables_of_its_own),
        cmocka_unit_test(every_way_to_list_forces_has_a_place_for_a_pull),
        cmocka_unit_test(what_cannot_be_pulled_is_refused_by_name),
        cmocka_unit_test(masses_and_slopes_are_found_where_they_are_written),
        cmocka_unit_test(numbers_are_found_in_the_text_by_utf_16_units),
        cmocka_unit_test(a_place_is_found_for_what_is_not_written),
        cmocka_unit_test(notes_are_told_as_json),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
