/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Starts of scenes with contacts: sides of lines and bars, and starts that are off by what a file rounds.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_view.h"
#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

#include <stdio.h>
#include <string.h>

static const double g = 9.81;

/* A rod hangs by its named end on a line, above or below it, and the line is off by a rounding or by what a file
 * rounds: it is on the side of its centre of mass, or on the side that is said, whatever the sign of what it is off
 * by. Below a line that it may not pass upwards it falls; above it, it stays. */
static void a_point_on_a_line_is_on_the_side_of_its_body(void **unused)
{
    static const double offsets[] = {0, 1e-16, -1e-16, 1e-11, -1e-11};
    static const struct {
        const char *side;
        int above; /* the centre of mass */
        bool stays;
    } cases[] = {
        {"start", 1, true}, {"start", -1, false}, {"up", 1, true}, {"left", 1, true}, {"right", -1, false}};
    (void)unused;
    struct checks checks = {0};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
            char scene[800];
            snprintf(scene, sizeof scene,
                     "fbd: 1\nground: {lines: {floor: {along: 0 deg, through: [0, %.17g]}}}\nbodies:\n"
                     "  rod: {shape: rod, mass: 1 kg, length: 2 m, motion: planar, initial: {y: %d, theta: "
                     "90 deg},"
                     " forces: [gravity]}\ncontacts:\n  - {between: [rod.%s, ground.floor], side: %s}\n"
                     "simulate: {until: 0.1 s}\n",
                     offsets[i], cases[k].above, cases[k].above > 0 ? "left" : "right", cases[k].side);
            struct trial trial = trial_parse(scene);
            trial_start(&trial, NULL);
            trial_finish(&trial);
            check_that(&checks, "done", trial.outcome == FBD_DONE);
            check_close(&checks, cases[k].side, trial_get(&trial, "rod.y"),
                        cases[k].above - (cases[k].stays ? 0 : g / 2 * 0.01), 1e-9);
            trial_close(&trial);
        }
    }
    struct trial trial =
        trial_parse("fbd: 1\nground: {lines: {floor: {along: 0 deg}}}\nbodies:\n  ball: {shape: disc, "
                    "radius: 1 m, mass: 1 kg, motion: planar, initial: {y: 3}}\ncontacts:\n  - "
                    "{between: [ball, ground.floor], side: right}\nsimulate: {until: 1 s}\n");
    fbd_errors *errors = fbd_errors_new();
    check_that(&checks, "on the other side", !fbd_state_close(trial.state, errors));
    check_that(&checks, "as it says",
               strstr(fbd_errors_get(errors, 0).message, "in each other by 4") != NULL);
    fbd_errors_free(errors);
    trial_close(&trial);
    checks_end(&checks);
}

static struct trial on_a_slope(double phi, double off, bool disc, const double v[3])
{
    char scene[800];
    snprintf(scene, sizeof scene,
             "fbd: 1\nground: {lines: {floor: {along: %.17g}}}\nbodies:\n  body: {shape: %s, mass: 1 kg, "
             "motion: planar, "
             "initial: {x: %.17g, y: %.17g, theta: %.17g, vx: %.17g, vy: %.17g, omega: %.17g}, forces: "
             "[gravity]}\n"
             "contacts:\n  - {between: [body, ground.floor], static: 0.4, restitution: 0.3}\nsimulate: "
             "{until: 0.3 s}\n",
             phi, disc ? "disc, radius: 0.5 m" : "prism, a: 1 m, b: 1 m, c: 1 m", -(0.5 - off) * sin(phi),
             (0.5 - off) * cos(phi), phi, v[0], v[1], v[2]);
    struct trial trial = trial_parse(scene);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    return trial;
}

/* Bodies that start in their floor, or over it, by less than the ninth digit that a file may have rounded: at rest,
 * sliding, meeting it or leaving it they move as though they began upon it. */
static void a_start_that_is_off_by_the_digits_of_a_file_is_moved_out(void **unused)
{
    struct random_numbers numbers = {20261123};
    (void)unused;
    struct checks checks = {0};
    for (int i = 0; i < 200; i++) {
        bool disc = i % 2 == 0, rests = i / 2 % 3 == 0, slides = i / 2 % 3 == 1;
        double phi = random_between(&numbers, -0.5, 0.5), u = random_between(&numbers, -1, 1);
        double off = (i % 5 == 0 ? -1 : 1) * pow(10, random_between(&numbers, -12, -9.1));
        double up = rests || slides ? 0 : random_between(&numbers, -1, 1), along = rests ? 0 : u;
        const double v[] = {along * cos(phi) - up * sin(phi), along * sin(phi) + up * cos(phi),
                            disc && !rests ? u : 0};
        struct trial exact = on_a_slope(phi, 0, disc, v), moved = on_a_slope(phi, off, disc, v);
        check_that(&checks, "done", moved.outcome == FBD_DONE && exact.outcome == FBD_DONE);
        for (size_t k = 0; k < 3; k++) {
            const char *name = fbd_model_coordinate(exact.model, k).name;
            check_close(&checks, name, trial_get(&moved, name), trial_get(&exact, name), 1e-6);
        }
        trial_close(&exact);
        trial_close(&moved);
    }
    checks_end(&checks);
}

/* Moved out with the couplings that they have, but a coupling that does not fit is not mended by the way. */
static void moving_out_assembles_nothing(void **unused)
{
    static const char *const x[] = {"3.5", "3.51"};
    (void)unused;
    struct checks checks = {0};
    for (int i = 0; i < 2; i++) {
        char scene[800];
        snprintf(scene, sizeof scene,
                 "fbd: 1\nground: {lines: {floor: {along: 0 deg}}, points: {P: [3, 1]}}\nbodies:\n  ball: "
                 "{shape: disc, radius: "
                 "0.5, mass: 1, motion: planar, initial: {y: 0.4999999999}, forces: [gravity]}\n  rod: "
                 "{shape: rod, length: 1, "
                 "mass: 1, motion: planar, initial: {x: %s, y: 1}, forces: [gravity]}\ncontacts: [{between: "
                 "[ball, "
                 "ground.floor]}]\ncouplings:\n  - pin: {between: [rod.left, ground.P]}\n  - spring: "
                 "{between: [ball, rod.right], "
                 "stiffness: 1}\nsimulate: {until: 0.1}\n",
                 x[i]);
        struct trial trial = trial_parse(scene);
        fbd_errors *errors = fbd_errors_new();
        fbd_simulation *simulation = fbd_simulation_new(trial.model, NULL, errors);
        fbd_result *result = simulation ? fbd_simulation_run(simulation, NULL) : NULL;
        bool done = result && fbd_result_outcome(result) == FBD_DONE;
        check_that(&checks, x[i], done == (i == 0));
        fbd_result_free(result);
        fbd_simulation_free(simulation);
        fbd_errors_free(errors);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A rod slides along a wall that nothing presses it on: its ends touch, by rounding, and so does its turning. */
static void a_rod_slides_on_along_a_wall(void **unused)
{
    struct random_numbers numbers = {20261126};
    struct checks checks = {0};
    (void)unused;
    for (int draw = 0; draw < draws_of(400); draw++) {
        double angle = random_between(&numbers, -3, 3), v = random_between(&numbers, 0.1, 3),
               x = random_between(&numbers, -1, 1), y = random_between(&numbers, -1, 1),
               length = random_between(&numbers, 0.2, 1), c = cos(angle), s = sin(angle);
        char scene[900], what[60];
        snprintf(
            scene, sizeof scene,
            "fbd: 1\nground: {lines: {wall: {along: %.17g, through: [%.17g, %.17g]}}}\nbodies:\n"
            "  rod: {shape: rod, mass: 1 kg, length: %.17g, motion: planar, initial: {x: %.17g, y: %.17g, "
            "theta: %.17g, vx: %.17g, vy: %.17g}, forces: [applied: {value: 0, angle: 0}]}\n"
            "contacts:\n  - {between: [rod, ground.wall], side: left}\nsimulate: {until: 1 s}\n",
            angle, x - length / 2 * c, y - length / 2 * s, length, x, y, angle, v * c, v * s);
        struct trial trial = trial_parse(scene);
        trial_run(&trial, NULL);
        snprintf(what, sizeof what, "rod %d", draw);
        check_that(&checks, what, trial.outcome == FBD_DONE);
        check_close(&checks, what, trial_get(&trial, "rod.x"), x + v * c, 1e-9);
        check_close(&checks, what, trial_get(&trial, "rod.theta"), angle, 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- on a bar */

#define BEAM "  beam: {shape: rod, mass: 1 kg, length: 2 m, motion: {pivot: {theta: 0}}}\n"
#define BALL "  ball: {mass: 1 kg, motion: particle, initial: {x: 0.3 m"

/* Exactly on a bar: at rest a body that is pulled onto it lies there; a moving one is on the side to which it moves. */
static void what_starts_on_a_bar_has_a_side(void **unused)
{
    static const struct {
        const char *what, *bodies, *between, *coordinate;
        double end; /* at 1 s */
    } cases[] = {
        {"on top", BALL "}, forces: [gravity]}\n" BEAM, "ball, beam", "ball.y", 0},
        {"on top, the other way round", BALL "}, forces: [gravity]}\n" BEAM, "beam, ball", "ball.y", 0},
        {"pushed up from below", BALL "}, forces: [applied: {value: 3 N, angle: 90 deg}]}\n" BEAM,
         "ball, beam", "ball.y", 0},
        {"leaves upwards", BALL ", vy: 2 m/s}}\n" BEAM, "ball, beam", "ball.y", 2},
        {"leaves downwards", BALL ", vy: -2 m/s}}\n" BEAM, "ball, beam", "ball.y", -2},
        {"a rod on a peg",
         "  rod: {shape: rod, mass: 1 kg, length: 2 m, motion: planar, forces: [gravity]}\n", "rod, ground.P",
         "rod.y", 0},
        {"a rod on a rod",
         "  rod: {shape: rod, mass: 1 kg, length: 2 m, motion: planar, forces: [gravity]}\n" BEAM,
         "beam, rod", "rod.y", 0},
        {"end to end, pushed together",
         "  rod: {shape: rod, mass: 1 kg, length: 2 m, motion: planar, initial: {x: -2 m}, forces: "
         "[applied: {value: 3 N, angle: 0}]}\n" BEAM,
         "rod, beam", "rod.x", -2},
    };
    (void)unused;
    struct checks checks = {0};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char scene[900];
        snprintf(scene, sizeof scene,
                 "fbd: 1\nground: {points: {P: [0, 0]}}\nbodies:\n%scontacts:\n  - {between: [%s]}\n"
                 "simulate: {until: 1 s}\n",
                 cases[k].bodies, cases[k].between);
        struct trial trial = trial_parse(scene);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, cases[k].what, trial.outcome == FBD_DONE);
        check_close(&checks, cases[k].what, trial_get(&trial, cases[k].coordinate), cases[k].end, 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Only what moves to the side from which its forces pull it is warned of, once. */
static void what_leaves_against_its_forces_is_warned_of(void **unused)
{
    static const struct {
        const char *more;
        size_t warnings;
    } cases[] = {{", vy: 2 m/s}, forces: [gravity]}\n", 0},
                 {"}, forces: [gravity]}\n", 0},
                 {", vy: -2 m/s}}\n", 0},
                 {", y: 1 mm, vy: -2 m/s}, forces: [gravity]}\n", 0},
                 {", vy: -2 m/s}, forces: [gravity]}\n", 1}};
    (void)unused;
    struct checks checks = {0};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char scene[600];
        snprintf(scene, sizeof scene,
                 "fbd: 1\nbodies:\n" BALL "%s" BEAM
                 "contacts: [{between: [ball, beam]}]\nsimulate: {until: 1 s}\n",
                 cases[k].more);
        fbd_errors *errors = fbd_errors_new();
        fbd_model *model = fbd_model_parse(scene, strlen(scene), "scene", NULL, 0, errors);
        check_that(&checks, "a model", model != NULL);
        check_that(&checks, cases[k].more, fbd_errors_count(errors) == cases[k].warnings);
        if (cases[k].warnings > 0 && fbd_errors_count(errors) > 0)
            check_that(&checks, "by name", strcmp(fbd_errors_get(errors, 0).id, "side-by-motion") == 0);
        fbd_model_free(model);
        fbd_errors_free(errors);
    }
    checks_end(&checks);
}

/* A ball that has come to rest at a bar from below, where nothing pulls it, falls off it when it is pulled down 0.2 s later,
 * also in a motion that goes on from numbers: x = F t^2 / (2 m). Only the state holds the side. */
static void a_side_goes_with_the_state(void **unused)
{
    enum { most_numbers = 200 };
    static const char *scene =
        "fbd: 1\nbodies:\n" BALL
        ", y: -0.5 m, vy: 1 m/s}, forces: [applied: {value: \"2[N]*step(t - 1[s])\", "
        "angle: -90 deg}]}\n" BEAM "contacts:\n  - {between: [ball, beam]}\nsimulate: {until: 2 s}\n";
    double numbers[most_numbers];
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(scene), other = trial_parse(scene);
    trial_start(&trial, NULL);
    trial_to(&trial, 0.8);
    check_close(&checks, "at rest", trial_get(&trial, "ball.y"), 0, 1e-9);
    size_t count = fbd_state_pack(trial.state, numbers, most_numbers);
    assert_true(count <= most_numbers && fbd_state_unpack(other.state, numbers, count));
    other.simulation = fbd_simulation_from(other.state, NULL, NULL);
    assert_non_null(other.simulation);
    other.outcome = FBD_GOING;
    trial_to(&trial, 2);
    trial_to(&other, 2);
    check_close(&checks, "the run", trial_get(&trial, "ball.y"), -1, 1e-9);
    check_close(&checks, "the one that goes on", trial_get(&other, "ball.y"), -1, 1e-9);
    trial_close(&trial);
    trial_close(&other);
    checks_end(&checks);
}

static void bars_that_cross_are_refused(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\nbodies:\n  rod: {shape: rod, mass: 1 kg, length: 2 m, motion: planar, "
                    "initial: {y: 0.9 m, theta: 90 deg}}\n" BEAM
                    "contacts:\n  - {between: [rod, beam]}\nsimulate: {until: 1 s}\n");
    fbd_errors *errors = fbd_errors_new();
    check_that(&checks, "refused", !fbd_state_close(trial.state, errors));
    check_that(&checks, "as it says",
               strstr(fbd_errors_get(errors, 0).message, "in each other by 0.1") != NULL);
    fbd_errors_free(errors);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_on_a_line_is_on_the_side_of_its_body),
        cmocka_unit_test(a_rod_slides_on_along_a_wall),
        cmocka_unit_test(a_start_that_is_off_by_the_digits_of_a_file_is_moved_out),
        cmocka_unit_test(moving_out_assembles_nothing),
        cmocka_unit_test(what_starts_on_a_bar_has_a_side),
        cmocka_unit_test(what_leaves_against_its_forces_is_warned_of),
        cmocka_unit_test(a_side_goes_with_the_state),
        cmocka_unit_test(bars_that_cross_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
