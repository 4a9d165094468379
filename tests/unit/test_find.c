/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Values of a parameter at which something changes, compared with closed forms. A value is right when it differs
 * by at most its own error, and that error is small.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fbd_find.h"

static const double g = 9.81, pi = 3.14159265358979324;

/* A block at rest on an incline of 30 degrees. */
static const char block[] = "fbd: 1\nparameters: {mu: {value: 0.5, range: [0, 1]}, twice: 2*mu}\n"
                            "bodies:\n  block:\n    mass: 2 kg\n    motion: {slide: {along: 30 deg}}\n"
                            "    forces: [gravity, normal, friction: {static: mu, kinetic: 0.8*mu}]\n"
                            "simulate: {until: 1 s}\n";

/* A crate of the breadth a, pushed at the height h. */
static const char crate[] =
    "fbd: 1\nparameters: {P: {value: 10 N, range: [0 N, 40 N]}, a: 0.4 m, h: 0.5 m, mu: 0.6}\n"
    "ground: {lines: {floor: {along: 0 deg}}}\n"
    "bodies:\n  crate:\n    shape: prism\n    a: a\n    b: 0.6 m\n    mass: 5 kg\n    motion: planar\n"
    "    initial: {y: 0.3 m}\n"
    "    forces: [gravity, applied: {name: push, value: P, angle: 0 deg, at: [-a/2, \"h - 0.3[m]\"]}]\n"
    "contacts:\n  - {name: floor, between: [crate, ground.floor], static: mu, kinetic: mu}\n"
    "simulate: {until: 0.1 s}\n";

/* A ball that is thrown at a wall; the run ends there. */
static const char ball[] =
    "fbd: 1\nparameters: {v0: {value: 12 m/s, range: [5 m/s, 20 m/s]}, angle: 45 deg, d: 10 m, fifth: d/5}\n"
    "bodies:\n  ball:\n    mass: 0.2 kg\n    motion: particle\n"
    "    initial: {vx: v0*cos(angle), vy: v0*sin(angle)}\n    forces: [gravity]\n"
    "simulate:\n  until: 10 s\n  events: [{name: wall, when: x = d, then: stop}]\n";

/* A bob on a string that is released at the side. */
static const char string[] =
    "fbd: 1\nparameters: {T: {value: 20 N, range: [1 N, 40 N]}}\nground: {points: {A: [0, 0]}}\n"
    "bodies:\n  bob: {mass: 1 kg, motion: particle, initial: {x: 1 m}, forces: [gravity]}\n"
    "couplings:\n  - rope: {name: cord, through: [bob, ground.A], until: tension > T}\nsimulate: {until: 0.8 "
    "s}\n";

/* A car on the top of a circular bump of 2 m. */
static const char bump[] =
    "fbd: 1\nparameters: {v0: {value: 1 m/s, range: [1 m/s, 6 m/s]}, R: 2 m}\n"
    "bodies:\n  car:\n    mass: 2 kg\n"
    "    motion: {track: {x: R*sin(p), y: R*cos(p), from: -80 deg, to: 80 deg}}\n"
    "    initial: {p: 0, v: v0}\n    forces: [gravity, normal]\nsimulate: {until: 1e-6 s}\n";

struct asked {
    fbd_find *find;
    fbd_errors *errors;
};

static struct asked ask(const char *text, const char *question, const fbd_find_plan *plan)
{
    struct asked asked = {.errors = fbd_errors_new()};
    assert_non_null(asked.errors);
    asked.find = fbd_find_parse(text, strlen(text), "model.yaml", question, plan, asked.errors);
    return asked;
}

static void end(struct asked *asked)
{
    fbd_find_free(asked->find);
    fbd_errors_free(asked->errors);
}

static void assert_solution(const fbd_find *find, size_t index, double expected, double most_error)
{
    const fbd_solution solution = fbd_find_solution(find, index);
    const double off = fabs(solution.value - expected);
    if (!(off <= solution.error + 1e-15 * fabs(expected)) || !(solution.error <= most_error))
        print_error("%.17g instead of %.17g: off by %.2g, error %.2g of at most %.2g\n", solution.value,
                    expected, off, solution.error, most_error);
    assert_true(off <= solution.error + 1e-15 * fabs(expected));
    assert_true(solution.error <= most_error);
}

static void assert_one(const char *text, const char *question, const fbd_find_plan *plan, double expected,
                       double most_error)
{
    struct asked asked = ask(text, question, plan);
    if (!asked.find) fbd_errors_print(asked.errors, stderr);
    assert_non_null(asked.find);
    assert_int_equal(fbd_find_solution_count(asked.find), 1);
    assert_solution(asked.find, 0, expected, most_error);
    end(&asked);
}

/* ---- outcomes */

static void a_block_slips_below_the_tangent_of_the_angle(void **unused)
{
    (void)unused;
    assert_one(block, "mu: block slips", NULL, tan(pi / 6), 1e-9);
    assert_one(block, "mu = 0.2 .. 0.9", NULL, tan(pi / 6), 1e-9);
}

static void the_sides_are_told(void **unused)
{
    (void)unused;
    struct asked asked = ask(block, "mu: block slips", NULL);
    assert_non_null(asked.find);
    const fbd_solution solution = fbd_find_solution(asked.find, 0);
    assert_int_equal(solution.kind, FBD_SOLUTION_CHANGE);
    assert_string_equal(solution.below, "block slips");
    assert_string_equal(solution.above, "");
    end(&asked);
}

/* P h = m g a/2 */
static void a_crate_tips_where_the_push_has_the_moment_of_its_weight(void **unused)
{
    (void)unused;
    assert_one(crate, "P: crate tips", NULL, 5 * g * 0.4 / (2 * 0.5), 1e-7);
    assert_one(crate, "P: crate lifts", NULL, 5 * g * 0.4 / (2 * 0.5), 1e-7);
    assert_one(crate, "h = 0.31..0.6 m: crate tips",
               &(fbd_find_plan){.settings = &(fbd_setting){"P", "20 N"}, .setting_count = 1},
               5 * g * 0.4 / (2 * 20), 1e-7);
}

/* mu m g; and while it slides, about G: P (h - b/2) + mu m g b/2 = m g a/2. */
static void a_crate_slides_first_where_friction_is_small(void **unused)
{
    (void)unused;
    const fbd_setting setting = {"mu", "0.3"};
    const fbd_find_plan plan = {.settings = &setting, .setting_count = 1};
    assert_one(crate, "P: crate slips", &plan, 0.3 * 5 * g, 1e-7);
    assert_one(crate, "P: crate tips", &plan, (0.2 - 0.3 * 0.3) * 5 * g / (0.5 - 0.3), 1e-7);
}

/* It reaches the wall from 0 <= y on: the least speed has d = v0^2/g at 45 degrees, and until 0.9 s it gets
 * there with v0 cos(45 deg) 0.9 s >= d. */
static void an_event_of_the_file_begins_to_happen(void **unused)
{
    (void)unused;
    assert_one(ball, "v0: wall", &(fbd_find_plan){.run = &(fbd_options){.until = 0.9}},
               10 / (0.9 * sqrt(0.5)), 1e-7);
}

/* 3 m g at the lowest point */
static void a_string_breaks(void **unused)
{
    (void)unused;
    assert_one(string, "T: cord breaks", NULL, 3 * g, 1e-7);
    assert_one(string, "T: bob breaks", NULL, 3 * g, 1e-7);
    assert_one(string, "T: breaks", NULL, 3 * g, 1e-7);
}

/* sqrt(g R): above that the run does not start. */
static void a_car_that_lifts_at_once_lifts(void **unused)
{
    (void)unused;
    assert_one(bump, "v0: car lifts", NULL, sqrt(2 * g), 1e-8);
    struct asked asked = ask(bump, "v0: car lifts", NULL);
    assert_string_equal(fbd_find_solution(asked.find, 0).below, "");
    assert_string_equal(fbd_find_solution(asked.find, 0).above, "car contact_lost");
    end(&asked);
}

/* It lifts at cos(p) = (2 + v^2/(g R))/3, where the run ends. */
static void a_run_that_ends_early_has_its_events(void **unused)
{
    (void)unused;
    const fbd_find_plan plan = {.run = &(fbd_options){.until = 5}};
    const double v0 = 3;
    char question[100];
    snprintf(question, sizeof question, "v0 = 1..4 m/s: at(contact_lost, car.s) = %.17g m",
             2 * acos((2 + v0 * v0 / (2 * g)) / 3));
    assert_one(bump, question, &plan, v0, 1e-8);
}

/* ---- equations */

static double height_at_wall(double v0, double angle)
{
    const double c = cos(angle);
    return 10 * tan(angle) - g * 100 / (2 * v0 * v0 * c * c);
}

static void a_ball_hits_the_wall_at_a_height(void **unused)
{
    (void)unused;
    const double v0 = sqrt(g * 100 / (2 * 0.5 * (10 - 2)));
    assert_true(fabs(height_at_wall(v0, pi / 4) - 2) < 1e-12);
    assert_one(ball, "v0: ball.y = 2 m", NULL, v0, 1e-8);
    assert_one(ball, "v0: ball.y = fifth", NULL, v0, 1e-8);
    assert_one(ball, "v0: at(wall, ball.y) + 1[m] = 3 m", NULL, v0, 1e-8);
}

/* g d^2/(2 v0^2) (1 + u^2) - d u + y = 0 for u = tan(angle) */
static void both_angles_are_found(void **unused)
{
    (void)unused;
    struct asked asked = ask(ball, "angle = 10..85 deg: ball.y = 2 m", NULL);
    assert_non_null(asked.find);
    assert_int_equal(fbd_find_solution_count(asked.find), 2);
    const double q = g * 100 / (2 * 144), root = sqrt(100 - 4 * q * (q + 2));
    assert_solution(asked.find, 0, atan((10 - root) / (2 * q)) * 180 / pi, 1e-7);
    assert_solution(asked.find, 1, atan((10 + root) / (2 * q)) * 180 / pi, 1e-7);
    end(&asked);
}

/* d = v0^2 sin(2 a)/g a little below its maximum, and at it. */
static void a_pair_between_two_runs_is_found(void **unused)
{
    (void)unused;
    static const char shot[] =
        "fbd: 1\nparameters: {angle: {value: 30 deg, range: [20 deg, 80 deg]}}\n"
        "bodies:\n  ball:\n    mass: 0.2 kg\n    motion: particle\n"
        "    initial: {vx: \"10[m/s]*cos(angle)\", vy: \"10[m/s]*sin(angle)\"}\n    forces: [gravity]\n"
        "simulate:\n  until: 10 s\n  events: [{name: land, when: y = 0 m, then: stop}]\n";
    char question[100];
    const double share[] = {1e-3, 1e-5, 1e-7, 1e-6},
                 ends[] = {80.5, 80.5, 80.5, 45.1}; /* the last between runs at an end */
    for (size_t i = 0; i < sizeof share / sizeof *share; i++) {
        snprintf(question, sizeof question, "angle = 20..%g deg: ball.x = %.17g m", ends[i],
                 100 / g * (1 - share[i]));
        struct asked asked = ask(shot, question, NULL);
        assert_int_equal(fbd_find_solution_count(asked.find), 2);
        const double angle = asin(1 - share[i]) / 2 * 180 / pi;
        assert_solution(asked.find, 0, angle, 1e-5);
        assert_solution(asked.find, 1, 90 - angle, 1e-5);
        assert_false(fbd_find_summary(asked.find).linear);
        end(&asked);
    }
    snprintf(question, sizeof question, "angle = 20..80.5 deg: ball.x = %.17g m", 100 / g);
    assert_one(shot, question, NULL, 45, 1e-3);
}

/* It rests up to mu m g. */
static void an_interval_of_solutions_has_two_ends(void **unused)
{
    (void)unused;
    const fbd_setting setting = {"mu", "0.3"};
    struct asked asked = ask(crate, "P = 1..40 N: crate.vx = 0 m/s",
                             &(fbd_find_plan){.settings = &setting, .setting_count = 1});
    assert_int_equal(fbd_find_solution_count(asked.find), 2);
    assert_solution(asked.find, 0, 1, 1e-9);
    assert_solution(asked.find, 1, 0.3 * 5 * g, 1e-7);
    assert_string_equal(fbd_find_solution(asked.find, 0).above, "0 up to the next value");
    assert_false(fbd_find_summary(asked.find).linear);
    end(&asked);
}

/* Without friction nothing slips; that is no value at which it begins to. */
static void an_end_with_another_outcome_is_no_solution(void **unused)
{
    (void)unused;
    struct asked asked = ask(crate, "mu = 0..1: crate slips", NULL);
    assert_int_equal(fbd_find_solution_count(asked.find), 1);
    assert_solution(asked.find, 0, 10 / (5 * g), 1e-9);
    char *text = fbd_find_text(asked.find);
    assert_non_null(strstr(text, "with 0 alone   crate contact"));
    fbd_free(text);
    end(&asked);
}

/* x = P t^2/(2 m) */
static void a_linear_difference_is_told(void **unused)
{
    (void)unused;
    static const char pushed[] =
        "fbd: 1\nparameters: {P: {value: 1 N, range: [0 N, 10 N]}}\n"
        "bodies: {block: {mass: 2 kg, motion: slide, forces: [applied: {name: push, value: P}]}}\n"
        "simulate: {until: 2 s}\n";
    struct asked asked = ask(pushed, "P: block.x = 3 m", NULL);
    assert_true(fbd_find_summary(asked.find).linear);
    assert_solution(asked.find, 0, 3, 1e-9);
    char *text = fbd_find_text(asked.find);
    assert_non_null(strstr(text, "is linear there, and there is no other value"));
    fbd_free(text);
    end(&asked);
}

/* The limit depends on the parameter itself, and on one that follows from it: max(y) = v0^2/(4 g) = d/5. */
static void both_sides_may_depend_on_the_parameter(void **unused)
{
    (void)unused;
    const fbd_setting setting = {"v0", "12 m/s"};
    const fbd_find_plan plan = {.settings = &setting, .setting_count = 1};
    assert_one(ball, "d = 8..22 m: max(ball.y) = fifth", &plan, 5 * 144 / (4 * g), 1e-7);
    assert_one(ball, "d = 8..22 m: max(ball.y) = d/5", &plan, 5 * 144 / (4 * g), 1e-7);
}

static void a_jump_is_no_solution(void **unused)
{
    (void)unused;
    struct asked asked = ask(block, "mu: count(block.slips) = 0.5", NULL);
    assert_non_null(asked.find);
    assert_int_equal(fbd_find_solution_count(asked.find), 1);
    assert_int_equal(fbd_find_solution(asked.find, 0).kind, FBD_SOLUTION_JUMP);
    assert_solution(asked.find, 0, tan(pi / 6), 1e-9);
    end(&asked);
}

/* x = 0.5 g t^2 (sin - 0.8 mu cos): a run of the scan, mu = 0.5, solves it exactly as itself. */
static void a_run_of_the_scan_may_be_the_solution(void **unused)
{
    (void)unused;
    assert_one(block, "mu = 0..1: twice = 1", NULL, 0.5, 1e-9);
}

/* ---- statics */

static void a_linear_margin_has_a_closed_form(void **unused)
{
    (void)unused;
    const fbd_find_plan plan = {.statics = true};
    struct asked asked = ask(block, "mu", &plan);
    assert_non_null(asked.find);
    assert_int_equal(fbd_find_solution_count(asked.find), 1);
    assert_true(fbd_find_solution(asked.find, 0).closed_form);
    assert_solution(asked.find, 0, tan(pi / 6), 1e-9);
    end(&asked);
    assert_one(block, "mu: block.friction", &plan, tan(pi / 6), 1e-9);
    assert_one(crate, "P: floor.normal", &plan, 5 * g * 0.4 / (2 * 0.5), 1e-8);
}

/* Two frictions under the crate: equilibrium is decided to 2e-6 of its loads, and the error says so. */
static void an_indeterminate_scene_has_a_larger_error(void **unused)
{
    (void)unused;
    assert_one(crate, "P", &(fbd_find_plan){.statics = true}, 5 * g * 0.4 / (2 * 0.5), 2e-4);
}

/* ---- what has no value */

static void wrong_runs_are_listed(void **unused)
{
    (void)unused;
    struct asked asked = ask(block, "mu = -0.5..1: block slips", NULL);
    assert_non_null(asked.find);
    assert_int_equal(fbd_find_solution_count(asked.find), 1);
    assert_true(fbd_find_gap_count(asked.find) > 0);
    const fbd_find_gap gap = fbd_find_gap_get(asked.find, 0);
    assert_true(gap.value == -0.5 && gap.failed);
    assert_string_equal(gap.status, "wrong");
    assert_non_null(strstr(gap.reason, "zero or above"));
    assert_true(fbd_find_summary(asked.find).failed == fbd_find_gap_count(asked.find));
    end(&asked);
}

/* The time of an event that does not happen. */
static void a_missing_value_is_listed_but_no_failure(void **unused)
{
    (void)unused;
    struct asked asked =
        ask(ball, "v0: time(wall) = 0.8 s", &(fbd_find_plan){.run = &(fbd_options){.until = 0.9}});
    assert_non_null(asked.find);
    assert_int_equal(fbd_find_solution_count(asked.find), 1);
    assert_solution(asked.find, 0, 10 / (0.8 * sqrt(0.5)), 1e-7);
    assert_true(fbd_find_gap_count(asked.find) > 0);
    assert_false(fbd_find_gap_get(asked.find, 0).failed);
    assert_int_equal(fbd_find_summary(asked.find).failed, 0);
    end(&asked);
}

static void assert_refused(const char *text, const char *question, const fbd_find_plan *plan, const char *id,
                           const char *words)
{
    struct asked asked = ask(text, question, plan);
    assert_null(asked.find);
    assert_true(fbd_errors_failed_count(asked.errors) > 0);
    size_t first = 0;
    while (fbd_errors_get(asked.errors, first).severity != FBD_ERROR)
        first++; /* after warnings of the file */
    const fbd_error error = fbd_errors_get(asked.errors, first);
    if (strcmp(error.id, id) != 0) print_error("%s: %s [%s]\n", question, error.message, error.id);
    assert_string_equal(error.id, id);
    if (!strstr(error.message, words) && !(error.hint && strstr(error.hint, words)))
        print_error("%s: %s, %s\n", question, error.message, error.hint ? error.hint : "");
    assert_true(strstr(error.message, words) || (error.hint && strstr(error.hint, words)));
    end(&asked);
}

static void wrong_questions_are_refused(void **unused)
{
    (void)unused;
    assert_refused(block, "nu: block slips", NULL, "unknown-parameter", "`mu`");
    assert_refused(block, "", NULL, "bad-find", "PARAMETER");
    assert_refused(block, "mu:", NULL, "bad-find", "PARAMETER");
    assert_refused(block, "mu = 1..0: block slips", NULL, "bad-find", "smaller");
    assert_refused(block, "mu = 0:1:5", NULL, "bad-find", "no range");
    assert_refused(block, "mu = 0..1, block slips", NULL, "bad-find", "no range");
    assert_refused(block, "mu = 0 m..1 s: block slips", NULL, "bad-find", "two units");
    assert_refused(block, "mu = 0..1 kg: block slips", NULL, "wrong-dimension", "kg");
    assert_refused(block, "mu: brick slips", NULL, "unknown-output", "count(");
    assert_refused(block, "mu: block.z = 1", NULL, "unknown-output", "block.z");
    assert_refused(block, "mu: block.x = 1 s", NULL, "wrong-dimension", "length");
    assert_refused(block, "mu: block.x = 1 m = 2 m", NULL, "bad-find", "no equation");
    assert_refused(block, "mu: block.x > 1 m", NULL, "bad-find", "no equation");
    assert_refused(ball, "d: ball.y = 2 m", NULL, "bad-find", "range");
    assert_refused(block, "mu: brick.friction", &(fbd_find_plan){.statics = true}, "bad-find",
                   "block.friction");
    assert_refused("fbd: 1\n", "mu: block slips", NULL, "unknown-parameter", "mu");
}

static int stop_at_ten(void *context, const fbd_progress *progress)
{
    (void)context;
    return progress->written >= 10;
}

static void a_search_can_be_stopped(void **unused)
{
    (void)unused;
    assert_refused(block, "mu: block slips", &(fbd_find_plan){.progress = stop_at_ten}, "stopped", "stopped");
}

static void the_scan_is_as_fine_as_asked(void **unused)
{
    (void)unused;
    struct asked asked = ask(block, "mu: block slips", &(fbd_find_plan){.runs = 5});
    const fbd_found found = fbd_find_summary(asked.find);
    assert_int_equal(found.scan, 5);
    assert_true(found.step == 0.25 && found.from == 0 && found.to == 1);
    assert_string_equal(found.parameter, "mu");
    end(&asked);
}

static void nothing_is_found_in_nothing(void **unused)
{
    (void)unused;
    assert_int_equal(fbd_find_solution_count(NULL), 0);
    assert_int_equal(fbd_find_gap_count(NULL), 0);
    assert_null(fbd_find_solution(NULL, 0).below);
    assert_null(fbd_find_gap_get(NULL, 0).reason);
    assert_null(fbd_find_summary(NULL).parameter);
    assert_null(fbd_find_text(NULL));
    assert_null(fbd_find_json(NULL));
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_block_slips_below_the_tangent_of_the_angle),
        cmocka_unit_test(the_sides_are_told),
        cmocka_unit_test(a_crate_tips_where_the_push_has_the_moment_of_its_weight),
        cmocka_unit_test(a_crate_slides_first_where_friction_is_small),
        cmocka_unit_test(an_event_of_the_file_begins_to_happen),
        cmocka_unit_test(a_string_breaks),
        cmocka_unit_test(a_car_that_lifts_at_once_lifts),
        cmocka_unit_test(a_run_that_ends_early_has_its_events),
        cmocka_unit_test(a_ball_hits_the_wall_at_a_height),
        cmocka_unit_test(a_pair_between_two_runs_is_found),
        cmocka_unit_test(a_linear_difference_is_told),
        cmocka_unit_test(an_interval_of_solutions_has_two_ends),
        cmocka_unit_test(an_end_with_another_outcome_is_no_solution),
        cmocka_unit_test(both_angles_are_found),
        cmocka_unit_test(both_sides_may_depend_on_the_parameter),
        cmocka_unit_test(a_jump_is_no_solution),
        cmocka_unit_test(a_run_of_the_scan_may_be_the_solution),
        cmocka_unit_test(a_linear_margin_has_a_closed_form),
        cmocka_unit_test(an_indeterminate_scene_has_a_larger_error),
        cmocka_unit_test(wrong_runs_are_listed),
        cmocka_unit_test(a_missing_value_is_listed_but_no_failure),
        cmocka_unit_test(wrong_questions_are_refused),
        cmocka_unit_test(a_search_can_be_stopped),
        cmocka_unit_test(the_scan_is_as_fine_as_asked),
        cmocka_unit_test(nothing_is_found_in_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
