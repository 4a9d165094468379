/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Rows of couplings that say nothing new are named, and harm nothing; how far a run is off its couplings is
 * reported as it is.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_export.h"
#include "fbd_study.h"
#include "gallery.h"

#include <stdlib.h>
#include <string.h>

static const double g = 9.81;

/* The names at the trial's state, with commas between, in a buffer of its own. */
static const char *redundant(struct trial *trial)
{
    enum { most = 8 };
    static char all[400];
    const char *names[most];
    size_t count = fbd_redundant(trial->state, names, most);
    assert_true(count <= most);
    all[0] = '\0';
    for (size_t i = 0, length = 0; i < count; i++)
        length += (size_t)snprintf(all + length, sizeof all - length, "%s%s", i > 0 ? ", " : "", names[i]);
    return all;
}

static fbd_arrow arrow(struct trial *trial, size_t body, const char *name)
{
    enum { most = 16 };
    fbd_arrow arrows[most];
    size_t count = fbd_diagram(trial->state, body, arrows, most);
    for (size_t i = 0; i < count && i < most; i++)
        if (strcmp(arrows[i].name, name) == 0) return arrows[i];
    fail_msg("no force `%s`", name);
    return arrows[0];
}

/* Three parallel cranks of mass m and length l under one beam of mass M: four coordinates, four rows, and yet
 * it moves. With the angle theta of all cranks,
 *
 *     (3 m l^2/3 + M l^2) theta'' = -(3 m g l/2 + M g l) cos(theta).
 *
 * (At theta = 0, 0.36 s from the start, all bars lie in one line and it could fold: the run ends before.) */
static const char parallelogram[] = "fbd: 1\nground: {points: {A: [0, 0], B: [1, 0], C: [2, 0]}}\nbodies:\n"
                                    "  a: {shape: rod, mass: 2, length: 0.5, motion: {pivot: {at: A, point: "
                                    "left}}, initial: {theta: 1 rad}, forces: "
                                    "[gravity]}\n"
                                    "  b: {shape: rod, mass: 2, length: 0.5, motion: {pivot: {at: B, point: "
                                    "left}}, initial: {theta: 1 rad}, forces: "
                                    "[gravity]}\n"
                                    "  c: {shape: rod, mass: 2, length: 0.5, motion: {pivot: {at: C, point: "
                                    "left}}, initial: {theta: 1 rad}, forces: "
                                    "[gravity]}\n"
                                    "  beam: {shape: rod, mass: 3, length: 2, motion: {pivot: {on: a, at: "
                                    "right, point: left}}, initial: {theta: -1 "
                                    "rad}, forces: [gravity]}\n"
                                    "couplings:\n  - pin: {name: middle, between: [beam.G, b.right]}\n"
                                    "  - pin: {name: end, between: [beam.right, c.right]}\n"
                                    "simulate: {until: 0.3 s, tolerance: 1e-12}\n";

static void a_parallelogram_with_a_crank_too_many_moves_and_names_what_is_too_much(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(parallelogram);
    double m = 2, M = 3, l = 0.5, inertia = (m + M) * l * l, weight = (1.5 * m + M) * g * l;
    assert_string_equal(redundant(&trial), "end in y");
    check_close(&checks, "acceleration", trial_acceleration(&trial, "a.theta"), -weight / inertia * cos(1.0),
                1e-9); /* (1e-8 / s)^3 of it, with slopes s of the rows that are not redundant of some 1e-2 */
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double theta = trial_get(&trial, "a.theta"), omega = trial_get(&trial, "a.omega");
    check_that(&checks, "it has moved", theta < 0.5);
    check_close(&checks, "energy", inertia * omega * omega / 2, weight * (sin(1.0) - sin(theta)), 1e-9);
    check_close(&checks, "parallel", trial_get(&trial, "c.theta"), theta, 1e-11);
    trial_close(&trial);
    checks_end(&checks);
}

/* The same rod twice: both have the same slope, and the force of least norm is half in each. The system is
 * kept regular by 1e-8 of its diagonal, so that how they share has its rounding, 1e-16, over that. */
static void two_rods_in_one_place_share_by_halves(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nbodies:\n  bob: {mass: 2 kg, motion: particle, initial: {x: 0.6, y: -0.8}, forces: "
        "[gravity]}\n"
        "ground: {points: {O: [0, 0]}}\ncouplings:\n  - rod: {name: one, between: [bob, ground.O]}\n"
        "  - rod: {name: other, between: [bob, ground.O]}\nsimulate: {until: 1 s}\n";
    struct trial trial = trial_parse(text);
    double half = 2 * g * 0.8 / 2; /* m g cos of the angle from straight down */
    assert_string_equal(redundant(&trial), "other");
    check_close(&checks, "one", arrow(&trial, 0, "one").fy, half * 0.8, 1e-7);
    check_close(&checks, "other", arrow(&trial, 0, "other").fy, half * 0.8, 1e-7);
    check_close(&checks, "other", arrow(&trial, 0, "other").fx, -half * 0.6, 1e-7);
    trial_close(&trial);
    checks_end(&checks);
}

/* Two blocks on one line, pinned: across the line the slides have said it all. */
static void a_pin_across_two_slides_says_too_much(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nbodies:\n  pulled: {mass: 2 kg, motion: slide, forces: [applied: 10 N]}\n"
        "  drawn: {mass: 3 kg, motion: slide}\ncouplings: [pin: {name: hook, between: [pulled, drawn]}]\n"
        "simulate: {until: 1 s}\n";
    struct trial trial = trial_parse(text);
    assert_string_equal(redundant(&trial), "hook in y");
    check_close(&checks, "together", trial_acceleration(&trial, "drawn.x"), 2, 1e-12);
    check_close(&checks, "the hook", arrow(&trial, 1, "hook").fx, 6, 1e-12);
    check_close(&checks, "not across", arrow(&trial, 1, "hook").fy, 0, 0);
    trial_close(&trial);
    checks_end(&checks);
}

static void what_is_needed_is_not_called_redundant(void **unused)
{
    (void)unused;
    static const char *const models[] = {"couplings/four_bar.yaml", "couplings/atwood.yaml",
                                         "couplings/andrews_squeezer.yaml", "couplings/rack_and_pinion.yaml",
                                         "trees/double_pendulum.yaml"};
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        struct trial trial = trial_open(models[i], NULL);
        assert_string_equal(redundant(&trial), "");
        trial_close(&trial);
    }
}

static void explain_lists_couplings_rows_and_what_is_redundant(void **unused)
{
    (void)unused;
    fbd_options options = FBD_OPTIONS_DEFAULT;
    struct trial trial = trial_parse(parallelogram);
    char *text = fbd_explain(trial.model, &options);
    assert_non_null(text);
    assert_non_null(strstr(text, "Couplings (2)\n  pin: two points are one (4 rows)\n      middle, end\n"));
    assert_non_null(strstr(text, "4 coordinates less 3 independent rows leave 1 to move\n"));
    assert_non_null(strstr(text, "rows before them: `end in y`\n"));
    free(text);
    trial_close(&trial);
    trial = trial_open("trees/double_pendulum.yaml", NULL);
    text = fbd_explain(trial.model, &options);
    assert_null(strstr(text, "Couplings"));
    free(text);
    trial_close(&trial);
}

/* ---- drift */

/* The gap of the four-bar's knuckle, by trigonometry. */
static void gap(const struct trial *trial, double *x, double *y)
{
    double crank = trial_get(trial, "crank.theta"), coupler = crank + trial_get(trial, "coupler.theta");
    double rocker = trial_get(trial, "rocker.theta");
    *x = 0.3 * cos(crank) + 0.9 * cos(coupler) - 1 - 0.7 * cos(rocker);
    *y = 0.3 * sin(crank) + 0.9 * sin(coupler) - 0.7 * sin(rocker);
}

/* At the ends of all steps the gap that is seen from outside is the one that is reported: to the rounding of
 * positions of 1 m. Outputs between them are as near. */
static void the_drift_that_is_reported_is_the_one_that_there_is(void **unused)
{
    (void)unused;
    const double rounding = 1e-15;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/four_bar.yaml", NULL);
    double most = 0, between = 0, from, to, x, y;
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = 1e-7;
    trial_start(&trial, &options);
    while (fbd_simulation_advance(trial.simulation) == FBD_GOING) {
        fbd_simulation_interval(trial.simulation, &from, &to);
        assert_true(fbd_simulation_state(trial.simulation, to, trial.state));
        gap(&trial, &x, &y);
        most = fmax(most, fmax(fabs(x), fabs(y)));
        assert_true(fbd_simulation_state(trial.simulation, (from + to) / 2, trial.state));
        gap(&trial, &x, &y);
        between = fmax(between, fmax(fabs(x), fabs(y)));
    }
    fbd_drift drift = fbd_simulation_drift(trial.simulation);
    assert_int_equal(drift.rows, 2);
    check_close(&checks, "after a step", drift.left_position, most, rounding);
    check_that(&checks, "a step is off by something, and by less than it may",
               drift.position > 1e-12 && drift.share < 10);
    check_that(&checks, "and is brought back below the tolerance", drift.left_share < 0.1);
    check_that(&checks, "the worst is a row of the knuckle", strncmp(drift.worst, "knuckle in ", 11) == 0);
    check_close(&checks, "between the ends, by the dense output", between, 0, 10 * 1e-7);
    trial_close(&trial);
    checks_end(&checks);
}

static void report_and_json_say_the_drift(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse(parallelogram);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = "dop853"; /* the 14 steps of rk8pd are not off by any rounding */
    trial_run(&trial, &options);
    char *report = fbd_result_report(trial.result, false), *json = fbd_result_json(trial.result);
    assert_non_null(report);
    assert_non_null(json);
    assert_non_null(
        strstr(report, "\nCouplings: 4 rows, 1 redundant at the start: `end in y`\n  off by at most "));
    assert_non_null(
        strstr(json,
               "\"couplings\": {\"rows\": 4, \"redundant\": [\"end in y\"], \"drift\": {\"worst\": \""));
    free(report);
    free(json);
    trial_close(&trial);
    trial = trial_open("kinetics/incline.yaml", NULL);
    trial_run(&trial, NULL);
    json = fbd_result_json(trial.result);
    assert_null(strstr(json, "couplings"));
    assert_int_equal(fbd_simulation_drift(trial.simulation).rows, 0);
    free(json);
    trial_close(&trial);
}

/* A crank and a rod of one length, folded: they turn as one about the crank's axis, 2 (m l^2/3) theta'' = M,
 * and the piston stays there. What acts on it along its guide is rounding of forces whose direction is that
 * of the rod, and must not be followed with ever smaller steps. */
static void what_only_rounding_moves_does_not_stop_a_run(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nbodies:\n"
        "  crank: {shape: rod, mass: 1, length: 0.2, motion: {pivot: {point: left}}, initial: {theta: 180 "
        "deg}, "
        "moments: [{applied: {name: M, value: 3}}]}\n"
        "  rod: {shape: rod, mass: 1, length: 0.2, motion: {pivot: {on: crank, at: right, point: left}}, "
        "initial: {theta: 180 deg}}\n"
        "  piston: {mass: 1, motion: slide}\n"
        "couplings: [{pin: {name: wrist, between: [rod.right, piston.G]}}]\nsimulate: {until: 0.15 s}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    check_that(&checks, "the end", trial.outcome == FBD_DONE);
    check_close(&checks, "crank", trial_get(&trial, "crank.theta"), acos(-1) + 112.5 * 0.15 * 0.15 / 2, 1e-9);
    check_close(&checks, "piston", trial_get(&trial, "piston.x"), 0, 1e-12);
    check_that(&checks, "in few steps", fbd_simulation_stats(trial.simulation).steps < 200);
    trial_close(&trial);
    checks_end(&checks);
}

/* A swinging bar between a wall and a block that friction holds: bringing the loop back to its couplings
 * after a step must not push the block. */
static void a_sticking_block_in_a_loop_stays_exactly_where_it_is(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nbodies:\n"
        "  block: {mass: 9, motion: slide, initial: {x: 0.7}, forces: [gravity, normal, {friction: 0.9}]}\n"
        "  link: {shape: rod, mass: 1, length: 0.5, motion: {pivot: {on: block, at: G, point: left}}, "
        "initial: {theta: -100 deg, assemble: true}, forces: [gravity]}\n"
        "  wall_link: {shape: rod, mass: 1, length: 0.5, motion: {pivot: {point: left}}, initial: {theta: "
        "-70 deg}, "
        "forces: [gravity]}\n"
        "  bar: {shape: rod, mass: 1, length: 0.6, motion: {pivot: {on: wall_link, at: right, point: left}}, "
        "initial: {theta: 60 deg, assemble: true}, forces: [gravity]}\n"
        "couplings: [{pin: {name: end, between: [bar.right, link.right]}}]\nsimulate: {until: 5 s}\n");
    trial_start(&trial, NULL);
    double swing = 0;
    for (int i = 0; i <= 50; i++) {
        if (i > 0) trial_to(&trial, 0.1 * i);
        swing = fmax(swing, fabs(trial_get(&trial, "wall_link.omega")));
        check_that(&checks, "the block stays",
                   trial_get(&trial, "block.x") == 0.7 && trial_get(&trial, "block.v") == 0);
    }
    check_that(&checks, "the bar swings", swing > 1);
    check_that(&checks, "nothing slips", fbd_simulation_event_count(trial.simulation) == 0);
    trial_close(&trial);
    checks_end(&checks);
}

/* Atwood's machine: T1 - T2 = M a/2 and a = (m1 - m2) g/(m1 + m2 + M/2). With a pulley of 1e-8 of the weights
 * that it joins, doubles cannot tell the tensions: no number is better than a wrong one. */
static void forces_that_cannot_be_told_are_refused(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial light = trial_open("couplings/atwood.yaml", SET("M=1e-5"));
    fbd_errors *errors = fbd_errors_new();
    assert_true(fbd_state_close(light.state, errors));
    double a = g / (5 + 1e-5 / 2);
    check_close(&checks, "acceleration", trial_acceleration(&light, "m1.x"), a, 1e-8);
    check_close(&checks, "tension", trial_term(&light, "m1.x", "cable"), 3 * (a - g), 1e-7);
    trial_run(&light, NULL);
    check_that(&checks, "a light pulley runs", light.outcome == FBD_DONE);
    trial_close(&light);

    struct trial dust = trial_open("couplings/atwood.yaml", SET("M=1e-15"));
    assert_false(fbd_state_close(dust.state, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, "masses-apart");
    assert_int_equal(fbd_errors_get(errors, 0).line, 32); /* of the rope */
    trial_start(&dust, NULL);
    check_that(&checks, "dust fails", fbd_simulation_advance(dust.simulation) == FBD_FAILED);
    check_that(&checks, "and says why", strstr(fbd_simulation_reason(dust.simulation), "`cable`"));
    fbd_errors_free(errors);
    trial_close(&dust);
    checks_end(&checks);
}

/* A particle does not turn: what a rod beside its centre would do is taken up by a couple, which belongs into
 * its diagram. Without it the moments about G do not add up. */
static void a_particle_held_beside_its_centre_has_the_couple_that_keeps_it_from_turning(void **unused)
{
    (void)unused;
    static const char *const held[] = {
        "  - rod: {between: [ground.A, bob.P]}\n",
        "  - pin: {between: [ground.B, bob.P]}\n",
        "  - rope: {through: [ground.A, bob.P]}\n",
    };
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof held / sizeof *held; i++) {
        char text[600];
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {A: [0, 2], B: [0.5, 0]}}\nbodies:\n  bob:\n    shape: disc\n"
                 "    mass: 2\n    radius: 0.5\n    points: {P: [0.5, 0]}\n    motion: particle\n"
                 "    forces: [gravity]\ncouplings:\n%s",
                 held[i]);
        struct trial trial = trial_parse(text);
        fbd_arrow arrows[8];
        size_t count = fbd_diagram(trial.state, 0, arrows, 8);
        double moment = 0, size = 0;
        for (size_t k = 0; k < count; k++) {
            moment += arrows[k].moment;
            size = fmax(size, fabs(arrows[k].moment));
        }
        check_that(&checks, "the rod turns", size > 1);
        check_close(&checks, "moments about G", moment, 0, 1e-12 * size);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A pin between two points of what is welded together says nothing, also where both sit on the axis but for
 * rounding. */
static void a_pin_on_the_axis_but_for_rounding_holds_nothing(void **unused)
{
    (void)unused;
    static const char scene[] = "fbd: 1\nbodies:\n  arm:\n    shape: rod\n    mass: 2\n    length: 1\n"
                                "    points: {P: [9.1e-18, 2.6e-17]}\n    motion: pivot\n"
                                "    forces: [{applied: {value: 3 N, angle: 90 deg, at: right}}]\n  plate:\n"
                                "    shape: disc\n    mass: 1\n    radius: 0.5\n    center: [-0.2, 0]\n"
                                "    points: {P: [0, 0]}\n    motion: {weld: {on: arm, angle: 1.5}}\n";
    static const char pin[] = "couplings:\n  - pin: {between: [plate.P, arm.P]}\n";
    char text[800];
    struct checks checks = {0};
    struct trial bare = trial_parse(scene);
    snprintf(text, sizeof text, "%s%s", scene, pin);
    struct trial pinned = trial_parse(text);
    double alpha = trial_acceleration(&bare, "arm.theta");
    check_that(&checks, "it turns", alpha > 1);
    check_close(&checks, "alpha", trial_acceleration(&pinned, "arm.theta"), alpha, 1e-12);
    trial_close(&bare);
    trial_close(&pinned);
    checks_end(&checks);
}

/* Where all is held and gravity does not act, what the couplings take is the size of the forces. */
static void what_is_held_altogether_is_not_refused_for_rounding(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial held =
        trial_parse("fbd: 1\ngravity: [0, 0]\nground: {points: {A: [0.474, -1.653]}}\nbodies:\n  bob:\n"
                    "    mass: 0.962\n    shape: disc\n    radius: 1\n    center: [0.244, -0.029]\n"
                    "    points: {P: [0.438, -0.313]}\n    motion: particle\n"
                    "    initial: {x: 0.036, y: -1.34}\n"
                    "    forces: [{spring: {stiffness: 18, to: [6.505, 3.459], free_length: 3.165}}]\n"
                    "couplings: [pin: {between: [bob.P, ground.A]}]\nsimulate: {until: 1}\n");
    trial_start(&held, NULL);
    fbd_simulation_advance(held.simulation);
    check_that(&checks, "its force can be told",
               strstr(fbd_simulation_reason(held.simulation), "cannot be computed") == NULL);
    trial_close(&held);
    checks_end(&checks);
}

/* The plate stands still but for rounding, as its joint takes back what the arm does; its rope, which the
 * moment slackens, does not push: I_O alpha = M, with I_O = 2 * 1^2 / 2. */
static void a_rope_on_what_two_joints_keep_at_rest_does_not_push(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial slack = trial_parse(
        "fbd: 1\nground: {points: {Q: [2, 1]}}\nbodies:\n  arm: {shape: disc, mass: 1, radius: 1, motion: "
        "pivot, initial: {omega: 1}}\n  plate:\n    shape: disc\n    mass: 2\n    radius: 1\n"
        "    points: {P: [0, 1]}\n    motion: {pivot: {on: arm}}\n    initial: {omega: -0.9999999999999981}\n"
        "    moments: [applied: -3]\ncouplings: [rope: {through: [plate.P, ground.Q]}]\n");
    check_close(&checks, "alpha", trial_acceleration(&slack, "plate.theta"), -3, 1e-12);
    trial_close(&slack);
    checks_end(&checks);
}

/* Without gravity only the disc's turning tells what its speed is the rounding of: its rope, which the force
 * pulls, holds. */
static void a_rope_on_what_only_turns_holds(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial taut = trial_parse(
        "fbd: 1\ngravity: [0, 0]\nground: {points: {Q: [0, 0]}}\nbodies:\n  disc:\n    shape: disc\n    "
        "mass: 2\n"
        "    radius: 0.1\n    motion: planar\n    initial: {x: 1, vx: -1e-21, omega: 0.9}\n"
        "    forces: [applied: {fx: 3, fy: 0}]\ncouplings: [rope: {through: [disc.G, ground.Q]}]\n");
    check_close(&checks, "a_x", trial_acceleration(&taut, "disc.G.x"), 0, 1e-12);
    trial_close(&taut);
    checks_end(&checks);
}

/* The only one of a kind by that alone, several by what they join; what is taken, by a file that means to clash, is
 * left. */
static void names_say_which(void **unused)
{
    static const char *const wanted[] = {"gravity",    "spring_a_b_2",    "spring_a_b_3", "spring_a_b_4",
                                         "spring_a_b", "spring_ground_a", "damper"};
    struct checks checks = {0};
    fbd_arrow arrows[10];
    (void)unused;
    struct trial trial = trial_parse("fbd: 1\n"
                                     "ground: {points: {P: [0, 1]}}\n"
                                     "bodies:\n"
                                     "  a: {mass: 1, motion: particle, forces: [gravity]}\n"
                                     "  b: {mass: 1, motion: particle, initial: {x: 1}}\n"
                                     "couplings:\n"
                                     "  - spring: {between: [a, b], stiffness: 1}\n"
                                     "  - spring: {between: [a, b], stiffness: 1}\n"
                                     "  - spring: {between: [a, b], stiffness: 1}\n"
                                     "  - spring: {name: spring_a_b, between: [a, b], stiffness: 1}\n"
                                     "  - spring: {between: [ground.P, a], stiffness: 1}\n"
                                     "  - damper: {between: [ground.P, a], coefficient: 1}\n"
                                     "simulate: {until: 1}\n");
    size_t count = fbd_diagram(trial.state, 0, arrows, 10);
    check_that(&checks, "all", count == sizeof wanted / sizeof *wanted);
    for (size_t i = 0; i < count && i < sizeof wanted / sizeof *wanted; i++)
        check_that(&checks, wanted[i], strcmp(arrows[i].name, wanted[i]) == 0);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_held_altogether_is_not_refused_for_rounding),
        cmocka_unit_test(a_rope_on_what_two_joints_keep_at_rest_does_not_push),
        cmocka_unit_test(a_rope_on_what_only_turns_holds),
        cmocka_unit_test(a_pin_on_the_axis_but_for_rounding_holds_nothing),
        cmocka_unit_test(a_particle_held_beside_its_centre_has_the_couple_that_keeps_it_from_turning),
        cmocka_unit_test(a_parallelogram_with_a_crank_too_many_moves_and_names_what_is_too_much),
        cmocka_unit_test(two_rods_in_one_place_share_by_halves),
        cmocka_unit_test(a_pin_across_two_slides_says_too_much),
        cmocka_unit_test(what_is_needed_is_not_called_redundant),
        cmocka_unit_test(explain_lists_couplings_rows_and_what_is_redundant),
        cmocka_unit_test(the_drift_that_is_reported_is_the_one_that_there_is),
        cmocka_unit_test(report_and_json_say_the_drift),
        cmocka_unit_test(a_sticking_block_in_a_loop_stays_exactly_where_it_is),
        cmocka_unit_test(what_only_rounding_moves_does_not_stop_a_run),
        cmocka_unit_test(forces_that_cannot_be_told_are_refused),
        cmocka_unit_test(names_say_which),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
