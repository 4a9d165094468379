/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scenes at rest by friction within its limits, scenes that do not stay where they are, and reactions at rest
 * beside those of dynamics.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_study.h"
#include "rest_checks.h"

static const char rough_ladder[] =
    "fbd: 1\nparameters: {mu: 0.4, mu_wall: 0.3, s: 3.5 m}\n"
    "ground: {lines: {wall: {through: [2.5, 0], along: 90 deg}}}\nbodies:\n"
    "  foot: {mass: 1 kg, motion: slide, forces: [gravity, normal, friction: mu]}\n"
    "  ladder: {shape: rod, mass: 20 kg, length: 5 m, points: {rung: [\"s - 2.5[m]\", 0]},\n"
    "    motion: {pivot: {on: foot, at: G, point: left}}, initial: {theta: 60 deg},\n"
    "    forces: [gravity, applied: {name: person, value: [0, -800 N], at: rung}]}\n"
    "  top: {mass: 1 kg, motion: {slide: {line: wall}}, initial: {assemble: true},\n"
    "    forces: [gravity, normal: {side: left}, friction: mu_wall]}\n"
    "couplings: [pin: {name: hinge, between: [ladder.right, top.G]}]\n";

static struct rest rough(double mu, double mu_wall)
{
    char text[sizeof rough_ladder + 80], *behind = text;
    behind += snprintf(text, 100, "fbd: 1\nparameters: {mu: %.17g, mu_wall: %.17g, s: 3.5 m}\n", mu, mu_wall);
    snprintf(behind, sizeof text - (size_t)(behind - text), "%s", strstr(rough_ladder, "ground:"));
    return rest_of(trial_parse(text));
}

/* With the friction f at the wall upward: N_w = N_0 - f cot(phi), F_foot = N_w, N_foot = W - f. The sum of
 * squares of all reactions (pin and hinge with it) is quadratic in f, least at f*; within the limits N_w <=
 * mu (W - f) and f <= mu_w N_w the nearest to f* counts. */
static void friction_at_both_ends_shares_within_its_limits(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    double c = cos(pi / 3) / sin(pi / 3), W = 22 * g + 800, N0 = (11 * g + 800 * 3.5 / 5) * c;
    /* Reactions: top N_w, f; hinge (N_w, g - f); pin (N_w, W - g - f); foot F = N_w, N = W - f. */
    double least = (4 * c * N0 + g + (W - g) + W) / (4 * c * c + 4);
    double mu_wall = 0.8;
    struct rest rest = rough(0.9, mu_wall);
    check_holds(&checks, &rest, 1);
    double up = mu_wall * N0 / (1 + mu_wall * c); /* f <= mu_w (N_0 - f c) */
    assert_true(least > up);                      /* so that the limit at the wall is what counts */
    check_arrow(&checks, &rest, "top", "friction", 0, up);
    rest_close(&rest);
    rest = rough(0.36, 1e3);
    check_arrow(&checks, &rest, "top", "friction", 0, least);
    check_that(&checks, "the least of all holds", fbd_statics_holds(rest.statics));
    rest_close(&rest);
    checks_end(&checks);
}

/* The most that both ends give: f = mu_w N_w there, and still N_w > mu (W - f). */
static void friction_that_is_too_little_at_both_ends_is_said(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    double c = cos(pi / 3) / sin(pi / 3), W = 22 * g + 800, N0 = (11 * g + 800 * 3.5 / 5) * c;
    double mu_wall = 0.3, f = mu_wall * N0 / (1 + mu_wall * c), needed = (N0 - f * c) / (W - f);
    struct rest rest = rough(needed * (1 + 1e-6), mu_wall);
    check_holds(&checks, &rest, 1);
    rest_close(&rest);
    rest = rough(needed * (1 - 1e-6), mu_wall);
    check_that(&checks, "it slips", !fbd_statics_holds(rest.statics));
    rest_close(&rest);
    checks_end(&checks);
}

/* ---- what moves, and what would hold it */

/* Virtual work: M dtheta = P dx, x = r cos(theta) + sqrt(l^2 - r^2 sin^2(theta)). */
static void a_slider_crank_is_held_by_virtual_work(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nbodies:\n"
        "  crank: {shape: rod, mass: 1 kg, length: 0.2 m, motion: {pivot: {point: left}}, initial: {theta: "
        "0.5}}\n"
        "  connecting_rod: {shape: rod, mass: 1 kg, length: 0.5 m, initial: {assemble: true},\n"
        "    motion: {pivot: {on: crank, at: right, point: left}}}\n"
        "  piston: {mass: 2 kg, motion: slide, initial: {x: 0.6 m, assemble: true}, forces: [applied: -100 "
        "N]}\n"
        "couplings: [pin: {name: wrist, between: [connecting_rod.right, piston.G]}]\n";
    struct rest rest = rest_of(trial_parse(text));
    double theta = 0.5, r = 0.2, l = 0.5, s = r * sin(theta), root = sqrt(l * l - s * s);
    double slope = -s - s * r * cos(theta) / root; /* dx/dtheta */
    check_that(&checks, "not in equilibrium", !fbd_statics_holds(rest.statics));
    check_that(&checks, "one way to move", fbd_statics_mobility(rest.statics) == 1);
    check_close(&checks, "at the crank", unbalanced(&rest, "crank.theta").holding, 100 * slope, rounding);
    check_close(&checks, "at the piston", unbalanced(&rest, "piston.x").holding, 100, rounding);
    check_that(&checks, "either does", unbalanced(&rest, "crank.theta").alone);
    rest_close(&rest);
    checks_end(&checks);
}

/* The moment in each joint bears the weights beyond it, on their arms. */
static void a_double_pendulum_is_held_by_a_moment_in_each_joint(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct rest rest = rest_open("trees/double_pendulum.yaml", NULL);
    double th1 = pi / 2, th2 = pi / 4, M2 = g / 2 * sin(th2), M1 = M2 + g * 1.5 * sin(th1);
    check_that(&checks, "not in equilibrium", !fbd_statics_holds(rest.statics));
    check_that(&checks, "two ways to move", fbd_statics_mobility(rest.statics) == 2);
    check_close(&checks, "lower", unbalanced(&rest, "rod2.theta").holding, M2, rounding);
    check_close(&checks, "upper", unbalanced(&rest, "rod1.theta").holding, M1, rounding);
    check_that(&checks, "both", !unbalanced(&rest, "rod1.theta").alone);
    rest_close(&rest);
    checks_end(&checks);
}

/* Two loops of one way each, side by side with a block: as many places as ways, each with what is left there
 * (for the loops by virtual work: a parallelogram's coupler of weight w on arms r needs w r cos(theta)). */
static void several_mechanisms_are_held_by_one_force_each(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nground: {points: {A: [0, 0], B: [1, 0], C: [5, 0], D: [6, 0]}}\nbodies:\n"
        "  a: {shape: rod, mass: 1e-9 kg, length: 1 m, motion: {pivot: {at: A, point: left}}, initial: "
        "{theta: 1}}\n"
        "  b: {shape: rod, mass: 1e-9 kg, length: 1 m, motion: {pivot: {at: B, point: left}}, initial: "
        "{theta: 1}}\n"
        "  top: {shape: rod, mass: 3 kg, length: 1 m, motion: {pivot: {on: a, at: right, point: left}},\n"
        "    initial: {theta: -1}, forces: [gravity]}\n"
        "  c: {shape: rod, mass: 1e-9 kg, length: 1 m, motion: {pivot: {at: C, point: left}}, initial: "
        "{theta: 2}}\n"
        "  d: {shape: rod, mass: 1e-9 kg, length: 1 m, motion: {pivot: {at: D, point: left}}, initial: "
        "{theta: 2}}\n"
        "  lid: {shape: rod, mass: 5 kg, length: 1 m, motion: {pivot: {on: c, at: right, point: left}},\n"
        "    initial: {theta: -2}, forces: [gravity]}\n"
        "  block: {mass: 2 kg, motion: slide, forces: [applied: 7 N]}\n"
        "couplings:\n  - pin: {name: p, between: [top.right, b.right]}\n"
        "  - pin: {name: q, between: [lid.right, d.right]}\n";
    struct rest rest = rest_of(trial_parse(text));
    check_that(&checks, "three ways", fbd_statics_mobility(rest.statics) == 3);
    check_close(&checks, "the block", unbalanced(&rest, "block.x").holding, -7, rounding);
    check_that(&checks, "three places", fbd_statics_unbalanced_count(rest.statics) == 3);
    for (size_t i = 0; i < fbd_statics_unbalanced_count(rest.statics); i++) {
        fbd_unbalanced one = fbd_statics_unbalanced(rest.statics, i);
        if (strcmp(one.coordinate, "block.x") == 0) continue;
        bool first = strncmp(one.coordinate, "top", 3) == 0 || one.coordinate[0] < 'c';
        double M = first ? 3 * g * cos(1) : 5 * g * cos(2);
        /* On the coupler the angle against its crank goes the other way. */
        if (one.coordinate[0] == 't' || one.coordinate[0] == 'l') M = -M;
        check_close(&checks, one.coordinate, one.holding, M, 1e-7); /* cranks of 1e-9 kg, and 1e-8 N */
    }
    rest_close(&rest);
    checks_end(&checks);
}

/* ---- limits */

static void a_surface_that_would_have_to_pull_is_said(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] = "fbd: 1\nbodies:\n  block: {mass: 1 kg, motion: slide, forces: [gravity, "
                               "normal, applied: {name: lift,\n"
                               "    value: [0, 12 N]}]}\n";
    struct rest rest = rest_of(trial_parse(text));
    check_that(&checks, "does not hold", !fbd_statics_holds(rest.statics));
    check_close(&checks, "by", limit(&rest, "block.normal").needed, g - 12, rounding);
    rest_close(&rest);
    checks_end(&checks);
}

/* A mast with one stay on its right, pushed to the right: the stay would have to push, and as a rod it does.
 */
static void a_rope_does_not_push(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char format[] = "fbd: 1\nground: {points: {R: [3, 0]}}\nbodies:\n"
                                 "  mast: {shape: rod, mass: 10 kg, length: 4 m, motion: {pivot: {point: "
                                 "left}}, initial: {theta: 90 deg},\n"
                                 "    forces: [gravity, applied: {name: wind, value: [50 N, 0]}]}\n"
                                 "couplings: [%s]\n";
    char text[sizeof format + 80];
    snprintf(text, sizeof text, format, "rope: {name: stay, through: [mast.right, ground.R]}");
    struct rest rest = rest_of(trial_parse(text));
    check_that(&checks, "does not hold", !fbd_statics_holds(rest.statics));
    /* About the foot: T 4 (3/5) = -50 N 2 m. */
    check_close(&checks, "by", limit(&rest, "stay").needed, -50 * 2 / (4 * 0.6), rounding);
    rest_close(&rest);
    snprintf(text, sizeof text, format, "rod: {name: stay, between: [mast.right, ground.R]}");
    rest = rest_of(trial_parse(text));
    check_holds(&checks, &rest, 0);
    rest_close(&rest);
    checks_end(&checks);
}

/* A rope over a pulley with friction in its axle, M_f = (T_2 - T_1) R: two pieces, each with a tension of its
 * own, T_1 = 1 kg g and T_2 = 2 kg g. */
static void each_piece_of_a_rope_has_a_limit_and_a_name(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nbodies:\n"
        "  a: {mass: 1 kg, motion: {slide: {along: -90 deg, through: [-1, -2]}}, forces: "
        "[gravity]}\n"
        "  b: {mass: 2 kg, motion: {slide: {along: -90 deg, through: [1, -2]}}, forces: "
        "[gravity]}\n"
        "  pulley: {shape: disc, mass: 1 kg, radius: 1 m, motion: pivot, moments: [friction: 20]}"
        "\ncouplings: [rope: {name: cord, through: [a.G, pulley, b.G]}]\n";
    struct rest rest = rest_of(trial_parse(text));
    check_holds(&checks, &rest, 0);
    check_close(&checks, "a", limit(&rest, "cord").needed, g, rounding);
    check_close(&checks, "b", limit(&rest, "cord_2").needed, 2 * g, rounding);
    rest_close(&rest);
    checks_end(&checks);
}

/* ---- against dynamics, welded, refused */

/* Where a scene rests and equilibrium determines all, the diagrams of dynamics are the same. */
static void reactions_at_rest_are_those_of_dynamics(void **unused)
{
    (void)unused;
    enum { most = 32 };
    struct checks checks = {0};
    static const char *const models[] = {"statics/beam.yaml", "statics/truss.yaml", "statics/ladder.yaml",
                                         "couplings/n_four_bar.yaml", "kinetics/ramp_breakaway.yaml"};
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        struct rest rest = rest_open(models[i], NULL);
        for (size_t k = 0; k < fbd_model_coordinate_count(rest.trial.model); k++)
            assert_true(
                fbd_state_set(rest.trial.state, fbd_model_coordinate(rest.trial.model, k).rate_name, 0));
        for (size_t b = 0; b < fbd_model_body_count(rest.trial.model); b++) {
            fbd_arrow still[most], moving[most];
            size_t count = fbd_statics_diagram(rest.statics, b, still, most);
            assert_int_equal(fbd_diagram(rest.trial.state, b, moving, most), count);
            for (size_t a = 0; a < count; a++) {
                assert_string_equal(still[a].name, moving[a].name);
                /* The multipliers of dynamics are right to (1e-8 / s)^3, s > 1e-3 the size of a slope. */
                check_close(&checks, still[a].name, still[a].fx, moving[a].fx, 1e-7);
                check_close(&checks, still[a].name, still[a].fy, moving[a].fy, 1e-7);
                check_close(&checks, still[a].name, still[a].moment, moving[a].moment, 1e-7);
            }
        }
        rest_close(&rest);
    }
    checks_end(&checks);
}

/* A beam cut in two and welded bears the same; the weld bears what the half beyond it needs. */
static void a_weld_bears_what_is_beyond_it(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nground: {points: {under_B: [4, -0.5]}}\nbodies:\n"
        "  near: {shape: rod, mass: 10 kg, length: 2 m, motion: {pivot: {point: left}}, forces: [gravity]}\n"
        "  far: {shape: rod, mass: 10 kg, length: 2 m, motion: {weld: {on: near, at: right, point: left}},\n"
        "    forces: [gravity, applied: {name: P, value: [0, -100 N]}]}\n"
        "couplings: [rod: {name: B, between: [far.right, ground.under_B]}]\n";
    struct rest rest = rest_of(trial_parse(text));
    double B = (20 * g * 2 + 100 * 3) / 4, across = 10 * g + 100 - B;
    check_holds(&checks, &rest, 0);
    check_arrow(&checks, &rest, "near", "pin", 0, 20 * g + 100 - B);
    check_arrow(&checks, &rest, "far", "weld", 0, across);
    check_close(&checks, "couple", arrow(&rest, "far", "weld").couple, (10 * g + 100) * 1 - B * 2, rounding);
    rest_close(&rest);
    checks_end(&checks);
}

static void a_start_that_does_not_fit_is_refused_with_its_coupling(void **unused)
{
    (void)unused;
    static const char text[] =
        "fbd: 1\nground: {points: {B: [4.1, 0]}}\nbodies:\n"
        "  beam: {shape: rod, mass: 10 kg, length: 4 m, motion: {pivot: {point: left}}, forces: [gravity]}\n"
        "couplings: [pin: {name: B, between: [beam.right, ground.B]}]\n";
    struct trial trial = trial_parse(text);
    fbd_errors *errors = fbd_errors_new();
    assert_null(fbd_statics_new(trial.state, errors));
    assert_int_equal(fbd_errors_failed_count(errors), 1);
    assert_string_equal(fbd_errors_get(errors, 0).id, "does-not-fit");
    assert_non_null(strstr(fbd_errors_get(errors, 0).message, "`B` is off by 0.1"));
    assert_int_equal(fbd_errors_get(errors, 0).line, 5);
    fbd_errors_free(errors);
    trial_close(&trial);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(friction_at_both_ends_shares_within_its_limits),
        cmocka_unit_test(friction_that_is_too_little_at_both_ends_is_said),
        cmocka_unit_test(a_slider_crank_is_held_by_virtual_work),
        cmocka_unit_test(a_double_pendulum_is_held_by_a_moment_in_each_joint),
        cmocka_unit_test(several_mechanisms_are_held_by_one_force_each),
        cmocka_unit_test(a_surface_that_would_have_to_pull_is_said),
        cmocka_unit_test(a_rope_does_not_push),
        cmocka_unit_test(each_piece_of_a_rope_has_a_limit_and_a_name),
        cmocka_unit_test(reactions_at_rest_are_those_of_dynamics),
        cmocka_unit_test(a_weld_bears_what_is_beyond_it),
        cmocka_unit_test(a_start_that_does_not_fit_is_refused_with_its_coupling),
    };
    return cmocka_run_group_tests(tests, no_handler, NULL);
}
