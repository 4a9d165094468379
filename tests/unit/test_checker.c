/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a grader of somebody else needs: an answer's derivations in the scene of a key, each compared with the mechanics, and
 * the parts of a file that belong to its grading.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fbd_grade.h"
#include "fbd_view.h"

static const char key_text[] = "fbd: 1\n"
                               "parameters: {mass: 2 kg, F: 20 N, phi: 30 deg, mu: 0.2}\n"
                               "bodies:\n"
                               "  block:\n"
                               "    mass: mass\n"
                               "    motion: {slide: {along: phi}}\n"
                               "    initial: {v: 3 m/s}\n"
                               "    forces:\n"
                               "      - gravity\n"
                               "      - normal\n"
                               "      - friction: {static: mu, kinetic: mu}\n"
                               "      - applied: {name: push, value: F}\n"
                               "    hand: [\"m*v_dot = F - m*g*sin(phi) - mu*m*g*cos(phi)\"]\n"
                               "simulate: {until: 0.2 s}\n"
                               "grading:\n"
                               "  draw: {phi: [20 deg, 40 deg]}\n"
                               "  points: {force: 3, superfluous: 2}\n"
                               "  reactions: [cord]\n"
                               "  canvas: {origin: [200, 300], unit: 1 cm}\n";

/* Lines 4 to 10 are the derivations. */
static const char answer_text[] = "bodies:\n"
                                  "  block:\n"
                                  "    hand:\n"
                                  "      - \"m*v_dot = F - m*g*sin(phi) - N*mu*sign(v)\"\n"
                                  "      - \"m*v_dot = F - m*g*cos(phi) - mu*m*g*cos(phi)\"\n"
                                  "      - \"m*v_dot = m*v_dot\"\n"
                                  "      - \"N = 16.99[N]\"\n"
                                  "      - \"m*v^2/2 - m*initial(v)^2/2 = work(gravity) + work(push) + "
                                  "work(friction)\"\n"
                                  "      - \"m*v^2/2 - m*initial(v)^2/2 = work(gravity) + work(push)\"\n"
                                  "      - \"N = m g cos(phi)\"\n";

enum { of_motion, wrong, identity, of_numbers, energy, energy_without_friction, normal };

static fbd_document *document_of(const char *text, const char *name)
{
    fbd_document *document = fbd_document_parse(text, strlen(text), name, NULL);
    assert_non_null(document);
    return document;
}

static size_t states_of(const fbd_comparison *comparison)
{
    return comparison->states[0] + comparison->states[1] + comparison->states[2];
}

static size_t agreeing(const fbd_comparison *comparison)
{
    return comparison->agree[0] + comparison->agree[1] + comparison->agree[2];
}

static fbd_comparison compare(fbd_checker *checker, const fbd_model *model, size_t index, double tolerance)
{
    fbd_comparison comparison;
    const double spread = tolerance < 1e-6 ? 0.3 : 0;
    assert_true(fbd_checker_compare(checker, model, 0, index, spread, tolerance, &comparison));
    assert_true(comparison.compared && states_of(&comparison) > 0);
    return comparison;
}

static void lines_are_compared(fbd_checker *checker, const fbd_model *model)
{
    fbd_comparison right = compare(checker, model, of_motion, 1e-9);
    assert_true(right.states[0] > 0 && right.states[2] > 0); /* it slips both ways */
    assert_int_equal(agreeing(&right), states_of(&right));
    assert_true(right.names & 1U);
    fbd_comparison one = compare(checker, model, wrong, 1e-9);
    assert_int_equal(agreeing(&one), 0);
    char *mistake = fbd_checker_mistake(checker, 1);
    assert_non_null(strstr(mistake, "gravity"));
    fbd_free(mistake);
    assert_true(one.unknowns & right.unknowns);
    one = compare(checker, model, identity, 1e-9);
    assert_int_equal(one.names, 0);
    assert_int_equal(agreeing(&one), states_of(&one));
    one = compare(checker, model, of_numbers, 1e-9);
    assert_true(one.names == FBD_NAMES_NORMAL && agreeing(&one) < states_of(&one));
    one = compare(checker, model, of_numbers, 3e-3); /* for the values of the sheet, to three digits */
    assert_int_equal(agreeing(&one), states_of(&one));
    one = compare(checker, model, normal, 1e-9);
    assert_int_equal(agreeing(&one), states_of(&one));
}

static void lines_are_compared_with_a_run(fbd_checker *checker, const fbd_model *model)
{
    fbd_comparison one = compare(checker, model, energy, 1e-9);
    assert_true(one.of_run && one.names == FBD_NAMES_RUN && one.slope_count > 0);
    assert_true(one.states[1] == 1 && one.agree[1] == 1);
    one = compare(checker, model, energy_without_friction, 1e-9);
    assert_true(one.states[1] == 1 && one.agree[1] == 0);
    char *mistake = fbd_checker_mistake(checker, 0);
    assert_non_null(strstr(mistake, "friction"));
    fbd_free(mistake);
}

/* m a + m g sin(phi) + mu N - F at the start, and its derivatives. */
static void lines_have_values(const fbd_model *model)
{
    fbd_state *state = fbd_state_new_start(model);
    const fbd_residual right = fbd_state_residual(state, 0, of_motion),
                       other = fbd_state_residual(state, 0, wrong);
    assert_true(fabs(right.value) <= 1e-9 * right.size && right.slopes[0] == 2);
    assert_true(fabs(other.value - 2 * 9.81 * (cos(0.5235987755982988) - 0.5)) <= 1e-9 * other.size);
    assert_true(isnan(fbd_state_residual(state, 0, energy).value));
    fbd_state_free(state);
}

static void derivations_of_an_answer_are_compared_in_the_scene_of_a_key(void **context)
{
    (void)context;
    const char *const path[] = {"bodies", "block", "hand"};
    fbd_document *key = document_of(key_text, "key.yaml"), *answer = document_of(answer_text, "answer.yaml");
    fbd_model *before = fbd_model_parse_document(key, NULL, 0, true, NULL);
    assert_true(fbd_document_take(key, answer, path, 3));
    assert_false(fbd_document_take(key, answer, (const char *const[]){"bodies", "crate", "hand"}, 3));
    fbd_model *model = fbd_model_parse_document(key, NULL, 0, true, NULL);
    fbd_model *bare = fbd_model_parse_document(key, NULL, 0, false, NULL);
    assert_true(model && before && bare);
    assert_int_equal(fbd_model_derivation_count(before, 0), 1);
    assert_int_equal(fbd_model_derivation_count(bare, 0), 0);
    assert_int_equal(fbd_model_derivation_count(model, 0), normal + 1);
    const fbd_derivation last = fbd_model_derivation(model, 0, normal);
    assert_true(last.line == 10 && last.column == 9 && !last.of_run);
    assert_string_equal(last.written, "N = m g cos(phi)");
    assert_string_equal(last.text, "N = m*g*cos(phi)");
    assert_true(fbd_model_derivation(model, 0, energy).of_run);
    fbd_checker *checker = fbd_checker_new();
    lines_are_compared(checker, model);
    lines_are_compared_with_a_run(checker, model);
    lines_have_values(model);
    fbd_checker_free(checker);
    fbd_model_free(before);
    fbd_model_free(model);
    fbd_model_free(bare);
    fbd_document_free(key);
    fbd_document_free(answer);
}

static void notes_have_the_positions_of_their_files(void **context)
{
    (void)context;
    const char *const path[] = {"bodies", "block", "hand"};
    static const char text[] = "bodies:\n  block:\n    hand:\n      - \"m*v_dot = G\"\n";
    fbd_document *key = document_of(key_text, NULL), *answer = document_of(text, NULL);
    fbd_errors *errors = fbd_errors_new();
    assert_true(fbd_document_take(key, answer, path, 3));
    assert_null(fbd_model_parse_document(key, NULL, 0, true, errors));
    assert_int_equal(fbd_errors_get(errors, 0).line, 4);
    fbd_errors_free(errors);
    fbd_document_free(key);
    fbd_document_free(answer);
}

struct taken {
    int count, line;
    char text[80];
};

static void take(void *context, int line, int column, const char *text)
{
    struct taken *taken = context;
    (void)column;
    taken->count++;
    taken->line = line;
    strncpy(taken->text, text, sizeof taken->text - 1);
}

static void notation_may_name_forces_that_the_scene_does_not_have(void **context)
{
    (void)context;
    static const char text[] = "bodies:\n  block:\n    hand:\n      - \"m a = R - m g sin(phi)\"\n"
                               "      - \"m*v_dot = F\"\n";
    const char *const path[] = {"bodies", "block", "hand"}, *const names[] = {"R"};
    struct taken taken = {.count = 0};
    fbd_document *key = document_of(key_text, NULL), *answer = document_of(text, NULL);
    fbd_model *model = fbd_model_parse_document(key, NULL, 0, false, NULL);
    assert_true(fbd_document_take(key, answer, path, 3));
    assert_true(fbd_document_derivations(key, NULL, 0, model, names, 1, take, &taken));
    assert_true(taken.count == 1 && taken.line == 4);
    assert_string_equal(taken.text, "m*a = R - m*g*sin(phi)");
    fbd_model_free(model);
    fbd_document_free(key);
    fbd_document_free(answer);
}

/* ---- marks and connections */

static void grading_is_that_of_the_file_or_its_defaults(void **context)
{
    (void)context;
    fbd_document *key = document_of(key_text, NULL);
    fbd_model *model = fbd_model_parse_document(key, NULL, 0, true, NULL);
    const fbd_grading grading = fbd_model_grading(model);
    assert_true(grading.given && grading.draw_count == 1 && grading.digits == 2);
    assert_string_equal(grading.draws[0].name, "phi");
    assert_true(grading.draws[0].low == 20 && grading.draws[0].high == 40 && grading.draws[0].line == 16);
    assert_string_equal(grading.draws[0].unit, "deg");
    assert_true(grading.tolerance == 0.01 && grading.partial == 0.5 && grading.pass == 1);
    assert_true(grading.points.force == 3 && grading.points.derivation == 2 &&
                grading.points.superfluous == 2);
    assert_true(grading.reactions == FBD_REACTIONS_NAMED && grading.reaction_count == 1);
    assert_string_equal(grading.reaction_names[0], "cord");
    assert_true(grading.canvas.origin[0] == 200 && grading.canvas.origin[1] == 300 &&
                grading.canvas.unit == 0.01);
    fbd_model_free(model);
    fbd_document_free(key);
}

static const char connected[] =
    "fbd: 1\n"
    "ground: {points: {hook: [0, 0]}}\n"
    "bodies:\n"
    "  drum:\n"
    "    mass: 2 kg\n"
    "    shape: disc\n"
    "    radius: 0.2 m\n"
    "    motion: {pivot: {at: [0, 0], point: G}}\n"
    "  load:\n"
    "    mass: 3 kg\n"
    "    motion: particle\n"
    "    initial: {x: 0.2 m, y: -1 m}\n"
    "    forces: [gravity]\n"
    "  ball:\n"
    "    mass: 1 kg\n"
    "    motion: particle\n"
    "    initial: {x: 3 m, y: 4 m}\n"
    "    forces: [gravity]\n"
    "couplings:\n"
    "  - rope: {name: cord, through: [drum, load], wound: {on: drum, side: right}}\n"
    "  - rod: {name: stick, between: [ball, ground.hook], length: 5 m}\n"
    "  - spring: {name: coil, between: [load.G, ball.G], stiffness: 7 N/m, "
    "free_length: 2 m}\n"
    "simulate: {until: 0.1 s}\n";

static void connections_are_those_of_the_file(void **context)
{
    (void)context;
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(connected, strlen(connected), NULL, NULL, 0, errors);
    if (!model) fail_msg("%d: %s", fbd_errors_get(errors, 0).line, fbd_errors_get(errors, 0).message);
    assert_int_equal(fbd_model_connection_count(model), 3);
    const fbd_connection rope = fbd_model_connection(model, 0), rod = fbd_model_connection(model, 1),
                         spring = fbd_model_connection(model, 2);
    assert_string_equal(rope.kind, "rope");
    assert_true(rope.line == 20 && rope.end_count == 2 && !rope.friction && isnan(rope.length));
    assert_true(rope.ends[0].body == 0 && rope.ends[0].wound == 2 && isinf(rope.ends[0].spare));
    assert_true(rope.ends[1].body == 1 && rope.ends[1].wound == 0 && rope.ends[1].spare == 0);
    assert_string_equal(rod.kind, "rod");
    assert_string_equal(rod.name, "stick");
    assert_true(rod.length == 5 && rod.ends[1].body == FBD_GROUND);
    assert_string_equal(spring.kind, "spring");
    assert_true(spring.stiffness == 7 && spring.free_length == 2 && spring.coefficient == 0);
    assert_true(spring.ends[0].center && spring.ends[0].body == 1 && spring.ends[1].body == 2);
    fbd_model_free(model);
    fbd_errors_free(errors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivations_of_an_answer_are_compared_in_the_scene_of_a_key),
        cmocka_unit_test(notes_have_the_positions_of_their_files),
        cmocka_unit_test(notation_may_name_forces_that_the_scene_does_not_have),
        cmocka_unit_test(grading_is_that_of_the_file_or_its_defaults),
        cmocka_unit_test(connections_are_those_of_the_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
