/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where scenes come to rest when they are let down slowly, against places that are known; and those that have
 * no such place.
 *
 * Positions of some 1 m and 1 rad come out to 1e-9: accelerations are balanced to 1e-9 of gravity at worst,
 * and the slopes of the forces are of the size of gravity over the length.
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

static const double place = 1e-9;

static void let_down(struct trial *trial)
{
    fbd_errors *errors = fbd_errors_new();
    assert_non_null(errors);
    bool found = fbd_find_equilibrium(trial->state, errors);
    if (!found) fbd_errors_print(errors, stderr);
    assert_true(found);
    fbd_errors_free(errors);
}

/* It rests there, says statics. */
static void check_rests(struct checks *checks, struct trial *trial)
{
    struct rest rest = rest_of(*trial);
    check_holds(checks, &rest, 0);
    fbd_statics_free(rest.statics);
    fbd_errors_free(rest.errors);
}

static void a_pendulum_ends_below_its_axis_from_anywhere(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const double from[] = {-3.1, -1.5, 0.3, pi / 2, 3.14};
    for (size_t i = 0; i < sizeof from / sizeof *from; i++) {
        struct trial trial = trial_open("rotation/compound_pendulum.yaml", NULL);
        trial_set(&trial, "theta", from[i]);
        trial_set(&trial, "omega", 2);
        let_down(&trial);
        check_close(&checks, "straight down", trial_get(&trial, "theta"), 0, place);
        check_close(&checks, "at rest", trial_get(&trial, "omega"), 0, 0);
        check_rests(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Nothing pushes the scene as a whole to the side: its centre of mass stays at 0.5 x 0.6 / 2.5. */
static void an_elastic_pendulum_ends_below_its_cart_and_the_centre_of_mass_stays(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("trees/elastic_pendulum.yaml", NULL);
    let_down(&trial);
    check_close(&checks, "cart", trial_get(&trial, "cart.x"), 0.12, place);
    check_close(&checks, "bob across", trial_get(&trial, "bob.x"), 0, place);
    check_close(&checks, "bob down", trial_get(&trial, "bob.y"), -(0.9 + 0.5 * g / 40), place);
    check_rests(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

static void a_chain_of_ten_hangs_straight_down(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("trees/chain_of_ten_rods.yaml", NULL);
    let_down(&trial);
    for (size_t k = 0; k < 10; k++)
        check_close(&checks, "angle", trial_get(&trial, fbd_model_coordinate(trial.model, k).name), 0, place);
    check_rests(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* The lower bob is a million times lighter, and its accelerations as much larger. */
static void two_bobs_hang_straight_down_whatever_their_masses(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("trees/mass_ratio.yaml", NULL);
    let_down(&trial);
    check_close(&checks, "upper", trial_get(&trial, "upper.theta"), 0, place);
    check_close(&checks, "lower", trial_get(&trial, "lower.theta"), 0, place);
    check_rests(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* Three rods of 1 m between points 2 m apart: the middle one level, the others 60 deg below the horizon. */
static void three_rods_hang_between_two_points_as_a_trapezoid(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char text[] = "fbd: 1\nground: {points: {B: [2, 0]}}\nbodies:\n"
                               "  a: {shape: rod, mass: 1, length: 1, motion: {pivot: {point: left}}, "
                               "initial: {theta: -1.5 rad}, forces: "
                               "[gravity]}\n"
                               "  b: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: a, at: right, "
                               "point: left}}, initial: {theta: 1.2 "
                               "rad, assemble: true}, forces: [gravity]}\n"
                               "  c: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: b, at: right, "
                               "point: left}}, initial: {theta: 1, "
                               "assemble: true}, forces: [gravity]}\n"
                               "couplings: [pin: {name: end, between: [c.right, ground.B]}]\n";
    struct trial trial = trial_parse(text);
    let_down(&trial);
    check_close(&checks, "first", trial_get(&trial, "a.theta"), -pi / 3, place);
    check_close(&checks, "second", trial_get(&trial, "b.theta"), pi / 3, place);
    check_close(&checks, "third", trial_get(&trial, "c.theta"), pi / 3, place);
    struct rest rest = rest_of(trial);
    check_holds(&checks, &rest, 0);
    /* Half the weight at either end; about the knee of the first rod: H sin 60 = (3/2 - 1/2) g cos 60. */
    check_close(&checks, "H", arrow(&rest, "a", "pin").fx, -g * cos(pi / 3) / sin(pi / 3), 100 * place);
    check_close(&checks, "V", arrow(&rest, "a", "pin").fy, 1.5 * g, 100 * place);
    rest_close(&rest);
    checks_end(&checks);
}

static void a_bob_on_a_rope_ends_below(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/rope_pendulum.yaml", NULL);
    let_down(&trial);
    check_close(&checks, "across", trial_get(&trial, "bob.x"), 0, place);
    check_close(&checks, "down", trial_get(&trial, "bob.y"), -1, place);
    check_rests(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* A spring that nothing pulls ends at its neutral place, where every force is nothing but rounding. */
static void a_spring_without_a_load_ends_neutral(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("energy/softening_spring.yaml", NULL);
    let_down(&trial);
    check_close(&checks, "x", trial_get(&trial, "x"), 0, place);
    check_rests(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

static void check_refused(const char *path, const char *id)
{
    struct trial trial = trial_open(path, NULL);
    fbd_errors *errors = fbd_errors_new();
    assert_false(fbd_find_equilibrium(trial.state, errors));
    assert_int_equal(fbd_errors_failed_count(errors), 1);
    assert_string_equal(fbd_errors_get(errors, 0).id, id);
    fbd_errors_free(errors);
    trial_close(&trial);
}

static void what_has_no_place_of_rest_is_said(void **unused)
{
    (void)unused;
    check_refused("kinetics/drop_us.yaml", "no-equilibrium");
    check_refused("couplings/gear_pair.yaml", "no-equilibrium");
    check_refused("energy/inverse_square.yaml", "no-equilibrium"); /* attracted ever less on the other side */
    check_refused("kinetics/incline.yaml", "sticks");
    check_refused("trees/shaken_pendulum.yaml", "not-independent");
}

/* A spring k x under a push c that jumps by J at x0: balances are c/k left of it and (c + J)/k right of it, where they
 * are there; a balance of the other branch is none. */
static void a_balance_is_one_of_the_branch_that_holds_there(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {1788};
    int found = 0, none = 0;
    for (int draw = 0; draw < 200; draw++) {
        double k = random_between(&numbers, 1, 10), c = random_between(&numbers, -3, 3),
               J = random_between(&numbers, -4, 4), x0 = random_between(&numbers, -1, 1);
        bool left = c / k<x0, right = (c + J) / k> x0;
        char text[500];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    forces:\n"
                 "      - applied: {name: law, value: \"%.17g[N] + %.17g[N]*step(x - (%.17g[m])) - "
                 "%.17g[N/m]*x\"}\n"
                 "simulate: {until: 1}\n",
                 c, J, x0, k);
        struct trial trial = trial_parse(text);
        fbd_errors *errors = fbd_errors_new();
        if (fbd_find_equilibrium(trial.state, errors)) {
            double x = trial_get(&trial, "x");
            /* With J < 0 it may rest on the switch itself. */
            bool slid = J < 0 && !left && !right && fabs(x - x0) < 1e-9;
            bool good = (left && fabs(x - c / k) < 1e-9) || (right && fabs(x - (c + J) / k) < 1e-9) || slid;
            if (!good) print_message("# draw %d: x = %.9g\n%s", draw, x, text);
            assert_true(good);
            found++;
        } else {
            assert_string_equal(fbd_errors_get(errors, 0).id, "no-equilibrium");
            none += !left && !right;
        }
        fbd_errors_free(errors);
        fbd_errors *others = fbd_errors_new();
        fbd_linearization *linear = fbd_linearize(trial.state, others);
        char *report = linear ? fbd_linearization_text(linear) : NULL;
        double where = 0;
        if (report) assert_int_equal(sscanf(strstr(report, "x = "), "x = %lf", &where), 1);
        free(report);
        bool held = (left && fabs(where - c / k) < 1e-7) || (right && fabs(where - (c + J) / k) < 1e-7);
        assert_true(!linear || held || (J < 0 && !left && !right));
        fbd_linearization_free(linear);
        fbd_errors_free(others);
        trial_close(&trial);
    }
    assert_true(found >= 100 && none > 0);
}

/* A body hangs from a spring above a floor or a stop that it does not touch: it rests at a - m g/k, where the floor
 * takes no part and leaves nothing undetermined; where that is below the floor it is nowhere else than on it, or
 * there is no answer. */
static void nothing_is_let_down_through_a_floor(void **unused)
{
    (void)unused;
    static const char *const bodies[] = {
        ("slide: {along: 90 deg, min: 0}}, initial: {x: %.17g}, forces: [gravity, spring: {stiffness: %.17g, "
         "neutral: %.17g}]}\n"),
        ("particle: {}}, initial: {y: %.17g}, forces: [gravity, spring: {stiffness: %.17g, to: [0, "
         "%.17g]}]}\n"),
        "planar: {}}, initial: {y: %.17g}, forces: [gravity, spring: {stiffness: %.17g, to: [0, %.17g]}]}\n",
    };
    const double r = 0.1;
    struct random_numbers numbers = {1789};
    int above = 0, below = 0;
    for (int draw = 0; draw < 150; draw++) {
        int kind = draw % 3;
        double m = random_between(&numbers, 0.5, 2), k = random_between(&numbers, 3, 30),
               a = random_between(&numbers, 0.5, 2), floor = kind == 2 ? r : 0, rests = a - m * 9.81 / k;
        if (fabs(rests - floor) < 0.01) continue;
        char body[300], text[800];
        snprintf(body, sizeof body, bodies[kind], floor + random_between(&numbers, 0.01, 1), k, a);
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {lines: {floor: {along: 0}}}\nbodies:\n  b: {mass: %.17g, %smotion: {%s%s",
                 m, kind == 2 ? "shape: disc, radius: 0.1, " : "", body,
                 kind == 0 ? "" : "contacts: [{between: [b, ground.floor]}]\n");
        struct trial trial = trial_parse(text);
        fbd_errors *errors = fbd_errors_new();
        const char *name = kind == 0 ? "x" : "y";
        if (fbd_find_equilibrium(trial.state, errors)) {
            double is = trial_get(&trial, name);
            if (fabs(is - fmax(rests, floor)) > place) print_message("# draw %d: %.9g\n%s", draw, is, text);
            assert_true(fabs(is - fmax(rests, floor)) <= place);
            fbd_statics *statics = fbd_statics_new(trial.state, errors);
            assert_non_null(statics);
            assert_true(fbd_statics_holds(statics));
            assert_int_equal(fbd_statics_indeterminacy(statics), 0);
            fbd_statics_free(statics);
        } else {
            assert_true(rests < floor);
            assert_string_equal(fbd_errors_get(errors, 0).id, "does-not-fit");
            assert_non_null(strstr(fbd_errors_get(errors, 0).message, "the place found, "));
        }
        above += rests > floor;
        below += rests < floor;
        fbd_errors_free(errors);
        trial_close(&trial);
    }
    assert_true(above >= 30 && below >= 30);
}

/* ---- ropes that are slack at the start */

/* A bob that a spring of no length draws to C, with its weight: V = k |r - P|^2/2, P below C. Its rope leads from A over
 * the bob to B, which may be A: it can be where |r - A| + |r - B| <= L. */
struct reach {
    double A[2], B[2], C[2], start[2], L, m, k;
};

static double way_by(const struct reach *reach, double x, double y)
{
    return hypot(x - reach->A[0], y - reach->A[1]) + hypot(x - reach->B[0], y - reach->B[1]);
}

static struct reach draw_reach(struct random_numbers *numbers, bool two)
{
    struct reach reach = {.m = random_between(numbers, 0.3, 3), .k = random_between(numbers, 2, 40)};
    for (int i = 0; i < 2; i++) {
        reach.A[i] = random_between(numbers, -1, 1);
        reach.B[i] = two ? random_between(numbers, -1, 1) : reach.A[i];
        reach.C[i] = random_between(numbers, -3, 3);
        reach.start[i] = random_between(numbers, -1.5, 1.5);
    }
    reach.L = way_by(&reach, reach.start[0], reach.start[1]) * random_between(numbers, 1.01, 1.6);
    return reach;
}

/* Where it rests: P within reach, else the point nearest to it on the ellipse about A and B, by its angle there: by eye
 * from all around, then by thirds. */
static void rest_within(const struct reach *reach, double rest[2])
{
    double P[2] = {reach->C[0], reach->C[1] - reach->m * g / reach->k};
    double dx = (reach->B[0] - reach->A[0]) / 2, dy = (reach->B[1] - reach->A[1]) / 2, c = hypot(dx, dy);
    double e[2] = {c > 0 ? dx / c : 1, c > 0 ? dy / c : 0}, a = reach->L / 2, b = sqrt(a * a - c * c);
    memcpy(rest, P, sizeof P);
    if (way_by(reach, P[0], P[1]) <= reach->L) return;
    double px = (P[0] - reach->A[0] - dx) * e[0] + (P[1] - reach->A[1] - dy) * e[1],
           py = -(P[0] - reach->A[0] - dx) * e[1] + (P[1] - reach->A[1] - dy) * e[0], at = 0,
           width = pi / 180;
    for (int i = 0; i < 360; i++)
        if (hypot(a * cos(i * width) - px, b * sin(i * width) - py) <
            hypot(a * cos(at) - px, b * sin(at) - py))
            at = i * width;
    /* The slope of the square of the distance passes zero there. */
    double low = at - width, high = at + width;
    for (int i = 0; i < 100; i++) {
        double s = (low + high) / 2;
        bool before = -a * sin(s) * (a * cos(s) - px) + b * cos(s) * (b * sin(s) - py) < 0;
        *(before ? &low : &high) = s;
    }
    rest[0] = reach->A[0] + dx + a * cos(low) * e[0] - b * sin(low) * e[1];
    rest[1] = reach->A[1] + dy + a * cos(low) * e[1] + b * sin(low) * e[0];
}

static void write_reach(const struct reach *reach, bool two, char text[1000])
{
    snprintf(text, 1000,
             "fbd: 1\nground: {points: {A: [%.17g, %.17g], B: [%.17g, %.17g], C: [%.17g, %.17g]}}\nbodies:\n"
             "  b: {mass: %.17g, motion: particle, initial: {x: %.17g, y: %.17g}, forces: [gravity, spring: "
             "{stiffness: "
             "%.17g, to: C}]}\ncouplings: [rope: {name: cord, through: [ground.A, b%s], length: %.17g}]\n",
             reach->A[0], reach->A[1], reach->B[0], reach->B[1], reach->C[0], reach->C[1], reach->m,
             reach->start[0], reach->start[1], reach->k, two ? ", ground.B" : "",
             two ? reach->L : reach->L / 2);
}

static void check_place(struct checks *checks, const struct trial *trial, const double rest[2])
{
    check_close(checks, "x", trial_get(trial, "b.x"), rest[0], 10 * place);
    check_close(checks, "y", trial_get(trial, "b.y"), rest[1], 10 * place);
}

/* Whether its rope becomes taut on the way down or not. */
static void a_slack_rope_holds_where_it_becomes_taut(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const int draws = number_of("FBD_SLACK", draws_of(100)), first = number_of("FBD_SLACK_SEED", 1);
    for (int i = first; i < first + draws; i++) {
        struct random_numbers numbers = {(uint64_t)i};
        bool two = i % 2;
        struct reach reach = draw_reach(&numbers, two);
        char text[1000];
        double rest[2];
        size_t failed = checks.failed;
        write_reach(&reach, two, text);
        rest_within(&reach, rest);
        struct trial down = trial_parse(text), linear = trial_parse(text);
        fbd_linearization *found = fbd_linearize(linear.state, NULL);
        if (check_that(&checks, "is linearized", found != NULL)) check_place(&checks, &linear, rest);
        fbd_linearization_free(found);
        let_down(&down);
        check_place(&checks, &down, rest);
        check_rests(&checks, &down);
        if (checks.failed > failed) print_message("# seed %d\n%s", i, text);
        trial_close(&down);
        trial_close(&linear);
    }
    checks_end(&checks);
}

/* Nothing but its weight, straight below the end of its rope: the scene of a weight that hangs. */
static void a_weight_falls_to_the_end_of_its_rope(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nground: {points: {A: [0, 1]}}\nbodies:\n"
        "  b: {mass: 1, motion: particle, initial: {y: 0.5}, forces: [gravity, drag: {linear: 4}]}\n"
        "couplings: [rope: {through: [ground.A, b], length: 2}]\n");
    let_down(&trial);
    check_close(&checks, "x", trial_get(&trial, "b.x"), 0, place);
    check_close(&checks, "y", trial_get(&trial, "b.y"), -1, place);
    check_rests(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pendulum_ends_below_its_axis_from_anywhere),
        cmocka_unit_test(an_elastic_pendulum_ends_below_its_cart_and_the_centre_of_mass_stays),
        cmocka_unit_test(a_chain_of_ten_hangs_straight_down),
        cmocka_unit_test(two_bobs_hang_straight_down_whatever_their_masses),
        cmocka_unit_test(three_rods_hang_between_two_points_as_a_trapezoid),
        cmocka_unit_test(a_bob_on_a_rope_ends_below),
        cmocka_unit_test(a_spring_without_a_load_ends_neutral),
        cmocka_unit_test(what_has_no_place_of_rest_is_said),
        cmocka_unit_test(a_balance_is_one_of_the_branch_that_holds_there),
        cmocka_unit_test(nothing_is_let_down_through_a_floor),
        cmocka_unit_test(a_slack_rope_holds_where_it_becomes_taut),
        cmocka_unit_test(a_weight_falls_to_the_end_of_its_rope),
    };
    return cmocka_run_group_tests(tests, no_handler, NULL);
}
