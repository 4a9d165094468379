/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * fbd_test.h: right derivations agree, and each way to be wrong is noticed.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_test.h"

/* m = 2, v_dot = (7 - 0.5 v) / 2 */
static const char block[] = "fbd: 1\n"
                            "bodies:\n"
                            "  block:\n"
                            "    mass: 2 kg\n"
                            "    motion: slide\n"
                            "    forces: [applied: {name: push, value: 7 N}, drag: {linear: 0.5 N*s/m}]\n";

static const fbd_expected right = {.at = {{"v", 3}},
                                   .coordinate = "x",
                                   .inertia = 2,
                                   .terms = {{"push", 7}, {"drag", -1.5}},
                                   .acceleration = 2.75};

static void right_equations_agree(void **unused)
{
    (void)unused;
    const fbd_expected acceleration = {.at = {{"block.v", 3}}, .coordinate = "block.x", .acceleration = 2.75};
    const fbd_expected rows[] = {right, acceleration};
    assert_true(fbd_check_table(block, rows, 2));
}

/* One member at a time is off. */
static void each_wrong_member_is_noticed(void **unused)
{
    (void)unused;
    enum { faults = 9 };
    fbd_expected wrong[faults];
    for (int i = 0; i < faults; i++) wrong[i] = right;
    wrong[0].inertia = 2.001;
    wrong[1].terms[0].value = 7.001;
    wrong[2].terms[1].name = "friction";
    wrong[3].terms[1].name = NULL; /* drag is missing */
    wrong[4].acceleration = -2.75;
    wrong[5].normal = 1;
    wrong[6].acceleration = NAN;
    wrong[7].coordinate = "y";
    wrong[8].at[0].name = "w";
    for (int i = 0; i < faults; i++)
        if (fbd_check_table(block, &wrong[i], 1)) fail_msg("fault %d is not noticed", i);
    const fbd_expected among[] = {right, wrong[4], right};
    assert_false(fbd_check_table(block, among, 3));
    fbd_expected term = {.at = {{"v", 3}}, .coordinate = "x", .terms = {{"drag", 1.5}}, .acceleration = 2.75};
    assert_false(fbd_check_table(block, &term, 1)); /* also where no inertia is derived */
}

static void a_tolerance_is_a_share_of_the_largest_term(void **unused)
{
    (void)unused;
    fbd_expected row = right;
    row.terms[1].value = -1.5 + 6e-3;
    row.acceleration = 2.75 + 3e-3;
    row.tolerance = 1e-3;
    assert_true(fbd_check_table(block, &row, 1));
    row.tolerance = 8e-4;
    assert_false(fbd_check_table(block, &row, 1));
}

static void nothing_to_compare_does_not_agree(void **unused)
{
    (void)unused;
    assert_false(fbd_check_table(block, &right, 0));
    assert_false(fbd_check_table("no file.yaml", &right, 1));
    assert_false(fbd_check_table("fbd: 1\nbodies: 3\n", &right, 1));
    assert_false(fbd_check_lines(block)); /* it has no derivation */
}

static fbd_expected by_hand(const double x[])
{
    return (fbd_expected){.coordinate = "x", .acceleration = (7 - 0.5 * x[0]) / 2};
}

static fbd_expected beyond_a_limit(const double x[])
{
    return (fbd_expected){.coordinate = "x", .acceleration = (7 - 0.5 * fmin(x[0], 9)) / 2};
}

static void a_derivation_is_compared_over_its_ranges(void **unused)
{
    (void)unused;
    const fbd_range range[] = {{"v", -10, 10}, {0}}, lower[] = {{"v", -10, 9}, {0}}, none[] = {{0}};
    assert_true(fbd_check_derivation(block, range, by_hand));
    assert_true(fbd_check_derivation(block, lower, beyond_a_limit));
    assert_false(fbd_check_derivation(block, range, beyond_a_limit));
    assert_false(fbd_check_derivation(block, none, by_hand));
}

static void a_coordinate_of_two_bodies_needs_its_body(void **unused)
{
    (void)unused;
    static const char two[] = "fbd: 1\n"
                              "bodies:\n"
                              "  a: {mass: 1, motion: slide, forces: [applied: {name: push, value: 3}]}\n"
                              "  b: {mass: 1, motion: slide}\n";
    fbd_expected row = {.coordinate = "a.x", .acceleration = 3};
    assert_true(fbd_check_table(two, &row, 1));
    row.coordinate = "x";
    assert_false(fbd_check_table(two, &row, 1));
}

/* A state that couplings do not allow has no equation. */
static void a_state_that_does_not_fit_is_refused(void **unused)
{
    (void)unused;
    static const char pulled[] = "fbd: 1\n"
                                 "ground: {points: {A: [0, 0]}}\n"
                                 "bodies:\n"
                                 "  bob: {mass: 1, motion: particle, initial: {x: 1}, forces: [gravity]}\n"
                                 "couplings: [rod: {name: arm, between: [bob, ground.A]}]\n";
    fbd_expected row = {.coordinate = "bob.y", .acceleration = -9.81};
    assert_true(fbd_check_table(pulled, &row, 1));
    row.at[0] = (fbd_term){"bob.x", 3};
    assert_false(fbd_check_table(pulled, &row, 1));
}

static void lines_of_the_file_are_compared(void **unused)
{
    (void)unused;
    char model[sizeof block + 40];
    snprintf(model, sizeof model, "%s    hand: m*a = 7[N] - 0.5[kg/s]*v\n", block);
    assert_true(fbd_check_lines(model));
    snprintf(model, sizeof model, "%s    hand: m*a = 7[N] + 0.5[kg/s]*v\n", block);
    assert_false(fbd_check_lines(model));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(right_equations_agree),
        cmocka_unit_test(each_wrong_member_is_noticed),
        cmocka_unit_test(a_tolerance_is_a_share_of_the_largest_term),
        cmocka_unit_test(nothing_to_compare_does_not_agree),
        cmocka_unit_test(a_derivation_is_compared_over_its_ranges),
        cmocka_unit_test(a_coordinate_of_two_bodies_needs_its_body),
        cmocka_unit_test(a_state_that_does_not_fit_is_refused),
        cmocka_unit_test(lines_of_the_file_are_compared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
