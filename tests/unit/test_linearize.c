/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Linearisation where it is not plain sailing: forces whose slope dies out, starts far away. The frequencies
 * of ordinary scenes stand with their references (test_reference_rotation.c, test_reference_vibration.c).
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

#include "fbd_study.h"
#include "looked.h"

static void assert_text_has(const fbd_linearization *linear, const char *words, bool wanted)
{
    char *text = fbd_linearization_text(linear);
    assert_non_null(text);
    if ((strstr(text, words) != NULL) != wanted) print_error("%s", text);
    assert_true((strstr(text, words) != NULL) == wanted);
    free(text);
}

#define ALONG_X(start, force)                                                                                \
    "fbd: 1\nbodies:\n  b: {mass: 1 kg, motion: slide, initial: {x: " start                                  \
    "}, forces: [applied: {name: pull, value: \"" force "\"}]}\n"

/* f = -4 x^3 about x = 0: the period grows without bound as the amplitude shrinks. */
static void a_force_without_slope_has_no_frequency(void **unused)
{
    (void)unused;
    struct looked looked = look(ALONG_X("0.1 m", "-4[N/m^3]*x^3"));
    assert_non_null(looked.linear);
    assert_string_equal(fbd_errors_get(looked.errors, 0).id, "degenerate-equilibrium");
    assert_int_equal(fbd_errors_failed_count(looked.errors), 0);
    for (size_t i = 0; i < 2; i++) assert_true(fbd_linearization_mode(looked.linear, i).frequency == 0);
    assert_text_has(looked.linear, "no linear frequency", true);
    assert_text_has(looked.linear, "oscillates", false);
    end_look(&looked);
}

/* Beside a spring of k = 9 N/m, which keeps its sqrt(k/m) = 3 rad/s. */
static void the_frequencies_beside_it_stay(void **unused)
{
    (void)unused;
    struct looked looked = look(ALONG_X("0.1 m", "-4[N/m^3]*x^3") "  c: {mass: 1 kg, motion: slide, initial: "
                                                                  "{x: 0.1 m}, forces: [spring: {stiffness: "
                                                                  "9 N/m}]}\n");
    assert_non_null(looked.linear);
    assert_int_equal(fbd_errors_count(looked.errors), 1);
    assert_text_has(looked.linear, "no linear frequency", true);
    assert_text_has(looked.linear, "w0 = 3 rad/s", true);
    end_look(&looked);
}

/* f = 1 - exp(x): from x = 20 Newton goes back by about 1 a step. The slope there is 5e8 times that at the
 * equilibrium x = 0, where it is -1: it does not die out, it is only smaller. Starts that are tried farther
 * away have forces up to 1e22 N, beside which nothing may pass for zero. */
static void a_start_far_away_finds_the_true_equilibrium(void **unused)
{
    (void)unused;
    struct looked looked = look(ALONG_X("20 m", "1[N]*(1 - exp(x/1[m]))"));
    assert_non_null(looked.linear);
    assert_int_equal(fbd_errors_count(looked.errors), 0);
    double x;
    assert_true(fbd_state_get(looked.state, "b.x", &x));
    assert_true(fabs(x) < 1e-15); /* half an ulp of exp(x) near 1, doubled */
    assert_text_has(looked.linear, "w0 = 1 rad/s", true);
    assert_int_equal(fbd_linearization_size(looked.linear), 2);
    const double *A = fbd_linearization_matrix(looked.linear);
    assert_true(A[0] == 0 && A[1] == 1 && fabs(A[2] + 1) < 1e-15 && A[3] == 0);
    end_look(&looked);
}

/* f = 1 + exp(x) is nowhere zero. */
static void where_there_is_no_equilibrium_none_is_found(void **unused)
{
    (void)unused;
    struct looked looked = look(ALONG_X("1 m", "1[N]*(1 + exp(x/1[m]))"));
    assert_null(looked.linear);
    assert_string_equal(fbd_errors_get(looked.errors, 0).id, "no-equilibrium");
    end_look(&looked);
}

/* Without gravity nothing but the forces says what an acceleration of roundings is: a rod that is pulled toward its pivot is in
 * balance there, and A is theta'' = 3 F/(m L) theta; it was taken about the other balance, half a turn away. */
static void what_starts_in_balance_is_looked_at_there(void **unused)
{
    (void)unused;
    struct looked looked =
        look("fbd: 1\ngravity: 0\nbodies:\n  rod:\n    {shape: rod, mass: 1 kg, length: 1 m,\n"
             "     motion: {pivot: {point: left}}, initial: {theta: 180 deg},\n"
             "     forces: [applied: {name: F, fx: 1 N, at: right}]}\n");
    assert_non_null(looked.linear);
    double theta;
    assert_true(fbd_state_get(looked.state, "rod.theta", &theta));
    assert_true(fabs(theta - acos(-1)) < 1e-15);
    assert_true(fabs(fbd_linearization_matrix(looked.linear)[2] - 3) < 1e-14);
    end_look(&looked);
}

/* Forces on a free body that take each other up: it was said that no balance was found, or one was looked for elsewhere. */
static void what_is_free_stays_where_it_starts_in_balance(void **unused)
{
    (void)unused;
    struct looked looked =
        look("fbd: 1\ngravity: 0\nbodies:\n  b:\n    {shape: disc, mass: 1 kg, radius: 0.1 m,\n"
             "     motion: planar, initial: {x: 0.3 m, theta: 0.7 rad}, forces: [\n"
             "     applied: {name: F, value: 0.3 N, angle: 1.1 rad, frame: body},\n"
             "     applied: {name: G, value: -0.3 N, angle: 1.8 rad}]}\n");
    assert_non_null(looked.linear);
    double x, theta;
    assert_true(fbd_state_get(looked.state, "b.x", &x) && fbd_state_get(looked.state, "b.theta", &theta));
    assert_true(x == 0.3 && theta == 0.7);
    end_look(&looked);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_force_without_slope_has_no_frequency),
        cmocka_unit_test(the_frequencies_beside_it_stay),
        cmocka_unit_test(a_start_far_away_finds_the_true_equilibrium),
        cmocka_unit_test(where_there_is_no_equilibrium_none_is_found),
        cmocka_unit_test(what_starts_in_balance_is_looked_at_there),
        cmocka_unit_test(what_is_free_stays_where_it_starts_in_balance),
    };
    return cmocka_run_group_tests_name("linearize", tests, NULL, NULL);
}
