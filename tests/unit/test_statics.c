/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reactions at rest against derivations by hand, written beside each test: where equilibrium determines them,
 * and where it does not.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_study.h"
#include "random_numbers.h"
#include "rest_checks.h"
#include "thorough.h"

/* ---- determinate */

static void a_beam_rests_on_two_supports_by_moments_about_one(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char *const at[] = {"a=0.25 m", "a=1 m", "a=3.9 m"};
    static const double a[] = {0.25, 1, 3.9};
    for (int i = 0; i < 3; i++) {
        struct rest rest = rest_open("statics/beam.yaml", SET(at[i]));
        double B = 20 * g / 2 + 300 * a[i] / 4, A = 20 * g + 300 - B;
        check_holds(&checks, &rest, 0);
        check_that(&checks, "no way to move", fbd_statics_mobility(rest.statics) == 0);
        check_arrow(&checks, &rest, "beam", "A", 0, A);
        check_arrow(&checks, &rest, "beam", "B", 0, B);
        rest_close(&rest);
    }
    checks_end(&checks);
}

/* The members by joints; P/2 at either support. */
static void a_truss_bears_its_load_as_the_method_of_joints_says(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct rest rest = rest_open("statics/truss.yaml", NULL);
    double P = 1000, diagonal = P / 2 / sin(pi / 3), lower = diagonal * cos(pi / 3);
    check_holds(&checks, &rest, 0);
    check_arrow(&checks, &rest, "B", "AB", diagonal * cos(pi / 3), P / 2); /* pushed away from A */
    check_arrow(&checks, &rest, "B", "BC", diagonal * cos(pi / 3), -P / 2);
    check_arrow(&checks, &rest, "B", "BD", -2 * lower, 0);
    check_arrow(&checks, &rest, "C", "AC", -lower, 0);
    check_arrow(&checks, &rest, "C", "CE", lower, 0);
    check_arrow(&checks, &rest, "E", "normal", 0, P / 2);
    check_arrow(&checks, &rest, "E", "DE", diagonal * cos(pi / 3), -P / 2);
    rest_close(&rest);
    checks_end(&checks);
}

/* A truss of 25 panels, its text: joints of 1 kg, L1 ... L25 below (L25 on a roller) and U0 ... U24 above. */
static void write_truss(char *text, size_t room)
{
    enum { panels = 25 };
    size_t at = 0;
#define ADD(...) at += (size_t)snprintf(text + at, room - at, __VA_ARGS__)
    ADD("fbd: 1\nground: {points: {L0: [0, 0]}}\nbodies:\n");
    for (int i = 1; i <= panels; i++)
        ADD("  L%d: {mass: 1, motion: %s, initial: {x: %d}, forces: [gravity%s]}\n", i,
            i == panels ? "slide" : "particle", i, i == panels ? ", normal" : "");
    for (int i = 0; i < panels; i++)
        ADD("  U%d: {mass: 1, motion: particle, initial: {x: %d.5, y: 1}, forces: [gravity]}\n", i, i);
    ADD("couplings:\n");
    for (int i = 0; i < panels; i++) {
        const char *from = i == 0 ? "ground." : "";
        ADD("  - rod: {name: low%d, between: [%sL%d, L%d]}\n", i, from, i, i + 1);
        ADD("  - rod: {name: up%d, between: [%sL%d, U%d]}\n", i, from, i, i);
        ADD("  - rod: {name: down%d, between: [U%d, L%d]}\n", i, i, i + 1);
        if (i + 1 < panels) ADD("  - rod: {name: top%d, between: [U%d, U%d]}\n", i, i, i + 1);
    }
#undef ADD
    assert_true(at < room);
}

/* By Ritter's cut through panel k, moments about U_k: R (k + 1/2) - sum of weights to the left on their arms
 * = the tension of the lower chord on its arm of 1 m. */
static void a_long_truss_bears_its_weight_as_a_cut_through_it_says(void **unused)
{
    (void)unused;
    enum { panels = 25 };
    static char text[20000];
    struct checks checks = {0};
    write_truss(text, sizeof text);
    struct rest rest = rest_of(trial_parse(text));
    double N = 0, W = 2 * panels * g;
    for (int i = 0; i < panels; i++) N += g * (i + 1 + i + 0.5) / panels;
    check_holds(&checks, &rest, 0);
    check_arrow(&checks, &rest, "L25", "normal", 0, N);
    for (int k = 0; k < panels; k++) {
        char body[8], rod[8];
        double about = k + 0.5, moment = (W - N) * about;
        for (int i = 0; i < panels; i++) {
            if (i + 1 < about) moment -= g * (about - (i + 1));
            if (i < k) moment -= g * (k - i);
        }
        snprintf(body, sizeof body, "L%d", k + 1);
        snprintf(rod, sizeof rod, "low%d", k);
        check_close(&checks, rod, arrow(&rest, body, rod).fx, -moment, 1e-8); /* of 2 kN, by 98 equations */
    }
    rest_close(&rest);
    checks_end(&checks);
}

/* About the foot: N L sin = (m g/2 + m0 g) L cos + P s cos. */
static void a_ladder_stands_by_friction_at_its_foot(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    double phi = pi / 3, L = 5, wall = ((10 + 1) * g + 800 * 3 / L) * cos(phi) / sin(phi),
           floor = 22 * g + 800;
    struct rest rest = rest_open("statics/ladder.yaml", NULL);
    check_holds(&checks, &rest, 0);
    check_arrow(&checks, &rest, "top", "normal", -wall, 0);
    check_arrow(&checks, &rest, "foot", "normal", 0, floor);
    check_arrow(&checks, &rest, "foot", "friction", wall, 0);
    check_close(&checks, "limit", limit(&rest, "foot.friction").limit, 0.5 * floor, rounding);
    rest_close(&rest);
    checks_end(&checks);
}

static void a_ladder_slips_where_friction_ends(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    double phi = pi / 3, wall = (11 * g + 480) * cos(phi) / sin(phi), floor = 22 * g + 800;
    char just[40], not_quite[40];
    snprintf(just, sizeof just, "mu=%.17g", wall / floor);
    snprintf(not_quite, sizeof not_quite, "mu=%.17g", wall / floor * (1 - 1e-6));
    struct rest rest = rest_open("statics/ladder.yaml", SET(just));
    check_holds(&checks, &rest, 0);
    rest_close(&rest);
    rest = rest_open("statics/ladder.yaml", SET(not_quite));
    check_that(&checks, "it slips", !fbd_statics_holds(rest.statics));
    fbd_limit foot = limit(&rest, "foot.friction");
    check_that(&checks, "and says where", !foot.holds && limit(&rest, "top.normal").holds);
    check_close(&checks, "and how much it takes", foot.needed, wall, rounding);
    rest_close(&rest);
    checks_end(&checks);
}

/* T on either side of a pulley whose bearing rubs: |m1 - m2| g R <= M_s. */
static void a_rubbing_pulley_holds_unequal_weights(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nparameters: {M: 2 N*m}\nbodies:\n"
        "  left: {mass: 5 kg, motion: {slide: {along: -90 deg, through: [-0.2, -1]}}, forces: [gravity]}\n"
        "  right: {mass: 4 kg, motion: {slide: {along: -90 deg, through: [0.2, -1]}}, forces: [gravity]}\n"
        "  pulley: {mass: 3 kg, shape: disc, radius: 0.2 m, motion: pivot, forces: [gravity],\n"
        "    moments: [friction: {name: axle, coefficient: M}]}\n"
        "couplings: [rope: {name: cord, through: [left, pulley, right]}]\n";
    struct rest rest = rest_of(trial_parse(text));
    check_holds(&checks, &rest, 0);
    check_arrow(&checks, &rest, "left", "cord", 0, 5 * g);
    check_arrow(&checks, &rest, "right", "cord", 0, 4 * g);
    check_arrow(&checks, &rest, "pulley", "pin", 0, 12 * g);
    check_close(&checks, "the axle", arrow(&rest, "pulley", "axle").couple, -g * 0.2, rounding);
    check_close(&checks, "its limit", limit(&rest, "pulley.axle").limit, 2, 0);
    check_that(&checks, "in N*m", strcmp(limit(&rest, "pulley.axle").unit, "N*m") == 0);
    rest_close(&rest);
    checks_end(&checks);
}

/* M = m g L/2 cos(theta) + P L cos(theta). */
static void a_drive_holds_what_its_motion_bears(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nbodies:\n  arm: {shape: rod, mass: 2 kg, length: 1.5 m, motion: {pivot: {point: left, "
        "theta: "
        "\"0.4 + 1[rad/s]*t\"}},\n    forces: [gravity, applied: {name: P, value: [0, -7 N], at: right}]}\n";
    struct rest rest = rest_of(trial_parse(text));
    check_holds(&checks, &rest, 0);
    check_close(&checks, "drive", arrow(&rest, "arm", "drive").couple, (2 * g * 0.75 + 7 * 1.5) * cos(0.4),
                rounding);
    check_arrow(&checks, &rest, "arm", "pin", 0, 2 * g + 7);
    rest_close(&rest);
    checks_end(&checks);
}

/* A belt that runs to the right draws the block with mu_k m g, whatever mu_s is, and a spring holds that. */
static void a_block_on_a_running_belt_is_drawn_by_kinetic_friction(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nbodies:\n  block: {mass: 2 kg, motion: slide, initial: {x: 0.029430 m}, forces: [gravity, "
        "normal,\n"
        "    friction: {static: 0.6, kinetic: 0.3, surface_speed: 0.2 m/s}, spring: {stiffness: 200 N/m}]}\n";
    struct rest rest = rest_of(trial_parse(text));
    check_holds(&checks, &rest, 0);
    check_arrow(&checks, &rest, "block", "friction", 0.3 * 2 * g, 0);
    rest_close(&rest);
    checks_end(&checks);
}

/* ---- indeterminate */

/* Of F_i at x_i = 0, L/2, L the least sum of squares with sum F = W and sum F x = W x_G is linear in x. */
static void three_supports_share_by_least_squares(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct rest rest = rest_open("statics/beam_on_three_supports.yaml", NULL);
    double W = 20 * g + 300, x_G = (20 * g * 2 + 300 * 1) / W, L = 4, F[3];
    for (int i = 0; i < 3; i++) F[i] = W / 3 + (L / 2 * i - L / 2) * W * (x_G - L / 2) * 2 / (L * L);
    check_holds(&checks, &rest, 1);
    check_arrow(&checks, &rest, "beam", "A", 0, F[0]);
    check_arrow(&checks, &rest, "beam", "B", 0, F[1]);
    check_arrow(&checks, &rest, "beam", "C", 0, F[2]);
    static const char *const names[] = {"A in y", "B", "C"};
    assert_int_equal(fbd_statics_undetermined_count(rest.statics), 3);
    for (size_t i = 0; i < 3; i++) assert_string_equal(fbd_statics_undetermined(rest.statics, i), names[i]);
    assert_int_equal(fbd_errors_count(rest.errors), 1);
    assert_string_equal(fbd_errors_get(rest.errors, 0).id, "indeterminate");
    rest_close(&rest);
    checks_end(&checks);
}

/* The same beam by another formulation: a tree that ends in the pin at A. The least sum of squares is that of
 * all reactions, so that it does not matter which of them a tree has for its joint. */
static void what_is_least_does_not_depend_on_the_tree(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] = "fbd: 1\nground: {points: {under_B: [2, -0.5], under_C: [4, -0.5]}}\nbodies:\n"
                               "  beam: {shape: rod, mass: 20 kg, length: 4 m, points: {load: [-1 m, 0]}, "
                               "motion: {pivot: {point: left}},\n"
                               "    forces: [gravity, applied: {name: P, value: [0, -300 N], at: load}]}\n"
                               "couplings:\n  - rod: {name: B, between: [beam.G, ground.under_B]}\n"
                               "  - rod: {name: C, between: [beam.right, ground.under_C]}\n";
    struct rest by_pin = rest_open("statics/beam_on_three_supports.yaml", NULL),
                by_pivot = rest_of(trial_parse(text));
    check_holds(&checks, &by_pivot, 1);
    fbd_arrow A = arrow(&by_pin, "beam", "A"), B = arrow(&by_pin, "beam", "B");
    check_arrow(&checks, &by_pivot, "beam", "pin", A.fx, A.fy);
    check_arrow(&checks, &by_pivot, "beam", "B", B.fx, B.fy);
    assert_string_equal(fbd_statics_undetermined(by_pivot.statics, 0), "beam.pin in y");
    rest_close(&by_pin);
    rest_close(&by_pivot);
    checks_end(&checks);
}

/* Two pins on one line: along it nothing says how much each bears; across it all is determined. */
static void a_beam_between_two_pins_is_determined_across_it(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] =
        "fbd: 1\nground: {points: {B: [4, 0]}}\nbodies:\n"
        "  beam: {shape: rod, mass: 10 kg, length: 4 m, motion: {pivot: {point: left}},\n"
        "    forces: [gravity, applied: {name: pull, value: [60 N, 0]}]}\n"
        "couplings: [pin: {name: B, between: [beam.right, ground.B]}]\n";
    struct rest rest = rest_of(trial_parse(text));
    check_holds(&checks, &rest, 1);
    check_arrow(&checks, &rest, "beam", "pin", -30, 5 * g);
    check_arrow(&checks, &rest, "beam", "B", -30, 5 * g);
    assert_string_equal(fbd_statics_undetermined(rest.statics, 0), "beam.pin in x");
    assert_string_equal(fbd_statics_undetermined(rest.statics, 1), "B in x");
    rest_close(&rest);
    checks_end(&checks);
}

/* A particle that has come to rest on a floor through the origin by random times: at 0 but for something between 1e-15 and
 * 1e-300 m, on either side. A spring lifts a part of its weight. */
static void what_rests_at_the_origin_rests_whatever_it_is_off_by(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const int draws = number_of("FBD_ORIGIN", draws_of(60)), first = number_of("FBD_ORIGIN_SEED", 1);
    for (int i = first; i < first + draws; i++) {
        struct random_numbers numbers = {(uint64_t)i};
        double m = random_between(&numbers, 0.3, 3), a = random_between(&numbers, 0.2, 1),
               k = random_between(&numbers, 0.1, 0.8) * m * g / a, until = random_between(&numbers, 5, 80);
        char text[600];
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {A: [0, %.17g]}, lines: {floor: {along: 0}}}\nbodies:\n  b: "
                 "{mass: %.17g, "
                 "motion: particle, initial: {y: %.17g}, forces: [gravity, drag: {linear: %.17g}, spring: "
                 "{stiffness: "
                 "%.17g, to: A}]}\ncontacts: [{name: c, between: [b, ground.floor], restitution: "
                 "%.17g}]\nsimulate: "
                 "{until: 90}\n",
                 a, m, random_between(&numbers, 0.05, 1), random_between(&numbers, 1, 8), k,
                 random_perhaps(&numbers, 0.5, 0, 0.4));
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        trial_to(&trial, until);
        fbd_errors *errors = fbd_errors_new();
        struct rest rest = {trial, errors, fbd_statics_new(trial.state, errors)};
        if (!rest.statics) print_message("# seed %d, y = %g: %s\n", i, trial_get(&trial, "b.y"), text);
        if (check_that(&checks, "is answered", rest.statics != NULL)) {
            check_holds(&checks, &rest, 0);
            check_arrow(&checks, &rest, "b", "c.normal", 0, m * g - k * a);
        }
        rest_close(&rest);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_beam_rests_on_two_supports_by_moments_about_one),
        cmocka_unit_test(a_truss_bears_its_load_as_the_method_of_joints_says),
        cmocka_unit_test(a_long_truss_bears_its_weight_as_a_cut_through_it_says),
        cmocka_unit_test(a_ladder_stands_by_friction_at_its_foot),
        cmocka_unit_test(a_ladder_slips_where_friction_ends),
        cmocka_unit_test(a_rubbing_pulley_holds_unequal_weights),
        cmocka_unit_test(a_drive_holds_what_its_motion_bears),
        cmocka_unit_test(a_block_on_a_running_belt_is_drawn_by_kinetic_friction),
        cmocka_unit_test(three_supports_share_by_least_squares),
        cmocka_unit_test(what_is_least_does_not_depend_on_the_tree),
        cmocka_unit_test(a_beam_between_two_pins_is_determined_across_it),
        cmocka_unit_test(what_rests_at_the_origin_rests_whatever_it_is_off_by),
    };
    return cmocka_run_group_tests(tests, no_handler, NULL);
}
