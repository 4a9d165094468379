/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Section forces by their names: outputs of sweeps, questions, and lines of derivations, against closed forms.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

#include "fbd_find.h"
#include "hand_lines.h"
#include "sweep_table.h"

static const double g = 9.81;

#define SUPPORTED(PARAMETERS, BODY)                                                                          \
    "fbd: 1\nparameters: {L: 4 m, P: 300 N, w: 90 N/m, a: 1 m, d: 0.4 m" PARAMETERS "}\n"                    \
    "ground: {points: {A: [0, 0], under_B: [L, -0.5]}}\n"                                                    \
    "bodies:\n  beam:\n    shape: rod\n    mass: 20 kg\n    length: L\n"                                     \
    "    points: {load: [a - L/2, 0], p: [d - L/2, 0]}\n    motion: planar\n    initial: {x: L/2}\n"         \
    "    forces:\n      - distributed: {name: w, from: left, to: right, value: w, angle: -90 deg}\n"         \
    "      - applied: {name: P, value: [0, -P], at: load}\n" BODY                                            \
    "couplings:\n  - pin: {name: A, between: [beam.left, ground.A]}\n"                                       \
    "  - rod: {name: B, between: [beam.right, ground.under_B]}\nsimulate: {until: 0.1 s}\n"

static const char supported[] = SUPPORTED("", "");

static const char chimney[] =
    "fbd: 1\nparameters: {L: 20 m, m: 5000 kg, start: 80 deg}\nbodies:\n  chimney:\n    shape: rod\n"
    "    mass: m\n    length: L\n    motion: {pivot: {point: left}}\n    initial: {theta: start}\n"
    "    forces: [gravity]\nsimulate:\n  until: 20 s\n"
    "  events: [{name: flat, when: theta < 0, then: stop}]\n";

/* Pushed along its axis from behind. */
static const char pushed[] =
    "fbd: 1\nparameters: {L: 2 m, F: 30 N, m: 3 kg, s: 1 m}\nbodies:\n  rod:\n    shape: rod\n    mass: m\n"
    "    length: L\n    motion: slide\n    forces: [applied: {name: F, value: F, at: left}]\n"
    "simulate: {until: 0.1 s}\n";

static void assert_near(double value, double expected, double size)
{
    if (!(fabs(value - expected) <= 1e-9 * size)) print_error("%.17g, not %.17g\n", value, expected);
    assert_true(fabs(value - expected) <= 1e-9 * size);
}

static const char on_three[] =
    "fbd: 1\nground: {points: {A: [0, 0], under_B: [2, -0.5], under_C: [4, -0.5]}}\nbodies:\n  beam:\n"
    "    shape: rod\n    mass: 20 kg\n    length: 4 m\n    motion: planar\n    initial: {x: 2 m}\n"
    "    forces: [gravity]\n    hand: [%s]\n"
    "couplings:\n  - pin: {name: A, between: [beam.left, ground.A]}\n"
    "  - rod: {name: B, between: [beam.G, ground.under_B]}\n"
    "  - rod: {name: C, between: [beam.right, ground.under_C]}\nsimulate: {until: 1 s}\n";

/* The first error is of this kind; warnings of the file may stand before it. */
static void assert_first_error(fbd_errors *errors, const char *id)
{
    size_t i = 0;
    while (i < fbd_errors_count(errors) && fbd_errors_get(errors, i).severity != FBD_ERROR) i++;
    assert_true(i < fbd_errors_count(errors));
    if (strcmp(fbd_errors_get(errors, i).id, id) != 0) fbd_errors_print(errors, stderr);
    assert_string_equal(fbd_errors_get(errors, i).id, id);
}

/* ---- sweeps */

static void a_beam_on_two_supports(void **unused)
{
    (void)unused;
    struct sweep_table table =
        sweep_of(supported, TEXTS("P=uniform(100,900):5", "a=uniform(0.5,3.5):3", "d=uniform(0,4):3"),
                 TEXTS("M(beam, d)", "V(d)", "V(beam, load)", "V(load, behind)", "M(beam, left)",
                       "max(M(L/2))"));
    const double L = 4, w = 90;
    assert_int_equal(table.counts.written, 45);
    for (size_t i = 0; i < 45; i++) {
        const double P = number(&table, i, 1), a = number(&table, i, 2), d = number(&table, i, 3);
        const double A = w * L / 2 + P * (L - a) / L, size = (P + w * L) * L;
        const double passed = d > a ? P : 0, middle = a < L / 2 ? P : 0;
        assert_near(number(&table, i, 4), A * d - w * d * d / 2 - passed * (d - a), size);
        assert_near(number(&table, i, 5), A - w * d - passed, size);
        assert_near(number(&table, i, 6), A - w * a, size);
        assert_near(number(&table, i, 7), A - w * a - P, size);
        assert_near(number(&table, i, 8), 0, size);
        assert_near(number(&table, i, 9), A * L / 2 - w * L * L / 8 - middle * (L / 2 - a), size);
    }
    close_table(&table);
}

static void a_falling_chimney(void **unused)
{
    (void)unused;
    struct sweep_table table =
        sweep_of(chimney, TEXTS("L=uniform(5,30):4", "start=uniform(20,80) deg:3"),
                 TEXTS("at(flat, M(L/3))", "max(M(L/3))", "N(chimney, L/4)", "M(L/2)"));
    const double m = 5000;
    assert_int_equal(table.counts.written, 12);
    for (size_t i = 0; i < 12; i++) {
        const double L = number(&table, i, 1), start = number(&table, i, 2) * acos(-1) / 180;
        const double square = 3 * g * sin(start) / L, size = m * g * L;
        assert_near(number(&table, i, 3), m * g * L / 27, size);
        assert_near(number(&table, i, 4), m * g * L / 27, size);
        assert_near(number(&table, i, 5), m * 0.75 * square * 0.625 * L, size);
        assert_near(number(&table, i, 6), m * g * L / 32, size);
    }
    close_table(&table);
}

static void a_rod_that_is_pushed(void **unused)
{
    (void)unused;
    struct sweep_table table = sweep_of(pushed, TEXTS("F=uniform(-50,50):4", "s=uniform(0,2):4"),
                                        TEXTS("N(s)", "max(N(s))", "V(s)"));
    assert_int_equal(table.counts.written, 16);
    for (size_t i = 0; i < 16; i++) {
        const double N = -number(&table, i, 1) * (1 - number(&table, i, 2) / 2);
        assert_near(number(&table, i, 3), N, 50);
        assert_near(number(&table, i, 4), N, 50);
        assert_near(number(&table, i, 5), 0, 50);
    }
    close_table(&table);
}

static void a_place_beyond_the_body_fails_the_run(void **unused)
{
    (void)unused;
    struct sweep_table table = sweep_of(supported, TEXTS("d=1,5"), TEXTS("M(beam, d)"));
    assert_int_equal(table.counts.failed, 1);
    assert_field(&table, 1, 2, "");
    assert_field(&table, 1, 4, "failed");
    assert_non_null(strstr(table.rows.data, "no section at x = 5: its length is 4 m [bad-place]"));
    close_table(&table);
}

static void every_run_fails_at(const char *output)
{
    struct sweep_table table = sweep_of(supported, TEXTS("P=100,200"), TEXTS(output));
    assert_int_equal(table.counts.failed, 2);
    assert_field(&table, 1, 2, "");
    assert_non_null(strstr(table.rows.data, "[bad-place]"));
    close_table(&table);
}

static void a_place_beyond_all_bodies_fails_every_run(void **unused)
{
    (void)unused;
    every_run_fails_at("M(beam, 5 m)");
    every_run_fails_at("max(M(beam, -1 m))");
}

/* The place is beyond the beam of the file, but on that of each run. */
static void places_are_those_of_the_run(void **unused)
{
    (void)unused;
    struct sweep_table table = sweep_of(supported, TEXTS("d=5,6", "L=8,9", "a=1,2"),
                                        TEXTS("M(beam, d)", "M(beam, 4.5 m)", "M(d + L/10)"));
    assert_int_equal(table.counts.written, 8);
    assert_int_equal(table.counts.failed, 0);
    for (size_t i = 0; i < 8; i++) {
        const double d = number(&table, i, 1), L = number(&table, i, 2), a = number(&table, i, 3);
        const double P = 300, w = 90, A = w * L / 2 + P * (L - a) / L, size = (P + w * L) * L;
        const double places[] = {d, 4.5, d + L / 10};
        for (size_t k = 0; k < 3; k++) {
            const double x = places[k];
            assert_near(number(&table, i, 4 + k), A * x - w * x * x / 2 - P * (x - a), size);
        }
    }
    close_table(&table);
}

static void assert_no_output(const char *text, const char *output, const char *id)
{
    const fbd_sweep_plan plan = plan_of(NULL, TEXTS(output));
    struct sweep_table table = open_table(text, &plan);
    assert_null(table.sweep);
    assert_first_error(table.errors, id);
    close_table(&table);
}

static void wrong_names_are_refused(void **unused)
{
    (void)unused;
    assert_no_output(supported, "M(baem, 1 m)", "unknown-body");
    assert_no_output(supported, "M(beam)", "bad-place");
    assert_no_output(supported, "M(beam, 1 m, 2 m)", "bad-place");
    assert_no_output(supported, "M(beam, lod)", "unknown-name");
    assert_no_output(supported, "M(beam, P)", "wrong-dimension");
    assert_no_output(supported, "M()", "unknown-output");
    assert_no_output(SUPPORTED(", load: 1 m", ""), "M(beam, load)", "ambiguous-name");
    assert_no_output("fbd: 1\nbodies:\n  ball: {shape: disc, mass: 1, radius: 1, motion: planar}\n"
                     "simulate: {until: 1 s}\n",
                     "M(ball, 0.5 m)", "no-section");
}

static void a_beam_on_three_supports_warns(void **unused)
{
    (void)unused;
    char text[2000];
    snprintf(text, sizeof text, on_three, "");
    const fbd_sweep_plan plan = plan_of(NULL, TEXTS("M(beam, 1 m)")), other = plan_of(NULL, TEXTS("beam.x"));
    struct sweep_table table = open_table(text, &plan), quiet = open_table(text, &other);
    assert_non_null(table.sweep);
    assert_int_equal(fbd_errors_count(table.errors), 1);
    assert_string_equal(fbd_errors_get(table.errors, 0).id, "indeterminate");
    assert_int_equal(fbd_errors_count(quiet.errors), 0);
    close_table(&table);
    close_table(&quiet);
}

/* ---- questions */

static void assert_found(const char *question, bool statics, fbd_solution_kind kind, double expected)
{
    fbd_errors *errors = fbd_errors_new();
    const fbd_find_plan plan = {.statics = statics};
    fbd_find *find = fbd_find_parse(supported, strlen(supported), "model.yaml", question, &plan, errors);
    if (!find) fbd_errors_print(errors, stderr);
    assert_non_null(find);
    assert_int_equal(fbd_find_solution_count(find), 1);
    const fbd_solution solution = fbd_find_solution(find, 0);
    assert_int_equal(solution.kind, kind);
    if (!(fabs(solution.value - expected) <= solution.error))
        print_error("%s: %.17g\n", question, solution.value);
    assert_true(fabs(solution.value - expected) <= solution.error && solution.error <= 1e-8);
    fbd_find_free(find);
    fbd_errors_free(errors);
}

static void values_of_parameters(void **unused)
{
    (void)unused;
    /* M(L/2) = w L^2/8 + P a/2; V(d) = w L/2 + P (L - a)/L - w d up to the load */
    for (int statics = 0; statics < 2; statics++) {
        assert_found("P = 0..1000 N: M(beam, L/2) = 500 N*m", statics, FBD_SOLUTION_ROOT, 640);
        assert_found("w = 0..400 N/m: M(L/2) - M(L/4) = 0.1*M(1 m)", statics, FBD_SOLUTION_ROOT, 97.5 / 0.35);
        assert_found("d = 0..4 m: V(beam, d) = 0 N", statics, FBD_SOLUTION_ROOT, 7. / 6);
    }
    assert_found("P = 0..1000 N: max(M(beam, L/2)) = 500 N*m", false, FBD_SOLUTION_ROOT, 640);
    assert_found("d = 0..4 m: V(beam, d) = 200 N", true, FBD_SOLUTION_JUMP, 1);
}

static void a_scene_at_rest_has_no_velocities(void **unused)
{
    (void)unused;
    fbd_errors *errors = fbd_errors_new();
    const fbd_find_plan plan = {.statics = true};
    assert_null(
        fbd_find_parse(supported, strlen(supported), NULL, "P = 0..1 N: beam.vx = 1 m/s", &plan, errors));
    assert_first_error(errors, "unknown-output");
    fbd_errors_free(errors);
}

/* ---- derivations */

static const char on_supports[] = SUPPORTED("", "    symbols: {A_y: A.y}\n    hand: [%s]\n");

/* The letter of the moment is M; it acts on the right of every section. */
static const char twisted[] = "fbd: 1\nparameters: {L: 2 m, C: 40 N*m, d: 0.5 m}\nbodies:\n"
                              "  wall: {mass: 1 kg, motion: {slide: {x: '0[m/s]*t'}}}\n"
                              "  beam:\n    shape: rod\n    mass: 1 kg\n    from: [0, 0]\n    to: [L, 0]\n"
                              "    points: {p: [d, 0]}\n    motion: {weld: {on: wall, point: left}}\n    "
                              "moments: [applied: {name: M, value: C, at: right}]\n"
                              "    hand: [%s]\nsimulate: {until: 1 s}\n";

static const char falling[] =
    "fbd: 1\nparameters: {L: 20 m, b: 5 m}\nbodies:\n  chimney:\n    shape: rod\n    mass: 5000 kg\n"
    "    length: L\n    points: {p: [b, 0]}\n    motion: {pivot: {point: left}}\n    initial: {theta: 80 "
    "deg}\n    forces: [gravity]\n"
    "    hand: [%s]\nsimulate: {until: 1 s}\n";

/* N is that of the surface. */
static const char block[] =
    "fbd: 1\nparameters: {L: 2 m, d: 0.7 m, mu: 0.2}\nbodies:\n  block:\n    shape: prism\n    a: L\n"
    "    b: 0.1 m\n    points: {p: [mu*d, 0]}\n    mass: 3 kg\n    motion: slide\n    forces: [gravity, "
    "normal]\n    hand: [%s]\n"
    "simulate: {until: 1 s}\n";

static const struct hand_line lines[] = {
    {on_supports, "V(d) = A_y - w*d", true, NULL},
    {on_supports, "M(d) = A_y*d - w*d^2/2", true, NULL},
    {on_supports, "M(d) = A_y d - w d^2/2", true, "read as"},
    {on_supports, "M(L/2) = w*L^2/8 + P*a/2", true, NULL},
    {on_supports, "beam.M(0.2[m]) = 0.2[m]*A_y - w*0.02[m^2]", true, NULL},
    {on_supports, "M(L) = 0", true, NULL},
    {on_supports, "N(d) = 0", true, NULL},
    {on_supports, "M(d) = A_y*d + w*d^2/2", false, "`w*d^2/2` has the wrong sign"},
    {on_supports, "M(d) = A_y*d - w*d^2", false, "`w*d^2`"},
    {on_supports, "V(L/2) = A_y - w*L/2", false, "`P`"},
    {falling, "M(b) = m*g*cos(theta)*b*(L - b)^2/(4*L^2)", true, NULL},
    {falling, "N(b) = -m*(L - b)/L*(g*sin(theta) - omega^2*(L + b)/2)", true, NULL},
    {falling, "N(b) = -m*(L - b)/L*g*sin(theta)", false, NULL},
    {falling, "V(b) = m*g*cos(theta)*(L - b)*(L - 3*b)/(4*L^2)", true, NULL},
    {twisted, "M(d) = C", true, NULL},
    {twisted, "M(d) = M", true, NULL},
    {twisted, "M(d) = M*d/L", false, NULL},
    {twisted, "M(L - d) = 0[N*m]", false, NULL},
    {block, "N(1 - mu) = 0.8*m*g", false, "read as"},
    {block, "N(L - d) = m*g*(L - d)", true, "read as"},
    {block, "M(L/2) = 0", false, NULL},
    {on_three, "M(2[m]) = 2[m]*A.y - m*g*0.5[m]", true, NULL},
    {on_three, "M(2[m]) = 0", false, "not unique"},
};

static void lines_of_derivations(void **unused)
{
    (void)unused;
    assert_int_equal(hand_lines_wrong(lines, sizeof lines / sizeof *lines), 0);
}

static void assert_no_line(const char *scene, const char *line, const char *id)
{
    char text[2000], quoted[200];
    fbd_errors *errors = fbd_errors_new();
    snprintf(quoted, sizeof quoted, "\"%s\"", line);
    snprintf(text, sizeof text, scene, quoted);
    assert_null(fbd_model_parse(text, strlen(text), NULL, NULL, 0, errors));
    assert_first_error(errors, id);
    fbd_errors_free(errors);
}

static void wrong_lines_are_refused(void **unused)
{
    (void)unused;
    assert_no_line(on_supports, "M(5[m]) = 0", "bad-place");
    assert_no_line(on_supports, "M(beam.x) = 0", "bad-place");
    assert_no_line(on_supports, "M(P) = 0", "bad-place");
    assert_no_line(on_supports, "V(d) = M(d)", "wrong-dimension");
    assert_no_line(on_supports, "before(V(d)) = after(V(d))", "unknown-function");
    assert_no_line(twisted, "M(L - d) = 0", "ambiguous-notation");
    assert_no_line("fbd: 1\nbodies:\n  ball: {shape: disc, mass: 1, radius: 1, motion: planar, hand: [%s]}\n"
                   "simulate: {until: 1 s}\n",
                   "M(0.5[m]) = 0", "no-section");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_beam_on_two_supports),
        cmocka_unit_test(a_falling_chimney),
        cmocka_unit_test(a_rod_that_is_pushed),
        cmocka_unit_test(a_place_beyond_the_body_fails_the_run),
        cmocka_unit_test(a_place_beyond_all_bodies_fails_every_run),
        cmocka_unit_test(places_are_those_of_the_run),
        cmocka_unit_test(wrong_names_are_refused),
        cmocka_unit_test(a_beam_on_three_supports_warns),
        cmocka_unit_test(values_of_parameters),
        cmocka_unit_test(a_scene_at_rest_has_no_velocities),
        cmocka_unit_test(lines_of_derivations),
        cmocka_unit_test(wrong_lines_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
